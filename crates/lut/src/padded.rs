/// The entries of a 3D table, a zero after each, with more zeros behind them up to one of the lengths of [`with_padded!`]. The
/// pixel loops take an index modulo that length, which is a power of two known where the loop is compiled: no index misses,
/// none is checked, and what lanes without a pixel point at does no harm. A check for each costs a fifth to a half of a lookup.
///
/// Zeros that nobody reads take no memory.
#[derive(Debug)]
pub(crate) struct Padded {
    entries: Vec<[f32; 4]>,
    /// The entries that are not padding.
    count: usize,
}

/// The lengths: a table of up to 40, 80 and 256 nodes a side. Each is compiled for itself.
pub(crate) const LENGTHS: [usize; 3] = [1 << 16, 1 << 19, 1 << 24];

impl Padded {
    /// At most 2^24 entries, as many as the largest table has; those beyond are left out.
    pub(crate) fn new(entries: &[[f32; 3]]) -> Self {
        let length = LENGTHS.into_iter().find(|length| entries.len() <= *length).unwrap_or(LENGTHS[2]);
        let mut padded = zeros(length);
        for (to, &[r, g, b]) in padded.iter_mut().zip(entries) {
            *to = [r, g, b, 0.0];
        }
        Self { entries: padded, count: entries.len().min(length) }
    }

    /// The entries without the padding.
    #[inline]
    pub(crate) fn entries(&self) -> &[[f32; 4]] {
        &self.entries[..self.count]
    }

    /// The entries with the padding, as long as one of [`LENGTHS`].
    pub(crate) fn with_padding(&self) -> &[[f32; 4]] {
        &self.entries
    }
}

/// Asked for as zeros, which the system hands out without touching them.
fn zeros(length: usize) -> Vec<[f32; 4]> {
    vec![[0.0; 4]; length]
}

/// Copies the entries and leaves the padding untouched.
impl Clone for Padded {
    fn clone(&self) -> Self {
        let mut entries = zeros(self.entries.len());
        entries[..self.count].copy_from_slice(self.entries());
        Self { entries, count: self.count }
    }
}

impl PartialEq for Padded {
    fn eq(&self, other: &Self) -> bool {
        self.entries() == other.entries()
    }
}

/// Runs the same expression on the entries as an array of whichever length they have.
macro_rules! with_padded {
    ($padded:expr, $entries:ident => $run:expr) => {{
        use $crate::padded::LENGTHS;
        let all = $padded.with_padding();
        if let Some($entries) = all.first_chunk::<{ LENGTHS[2] }>() {
            $run
        } else if let Some($entries) = all.first_chunk::<{ LENGTHS[1] }>() {
            $run
        } else if let Some($entries) = all.first_chunk::<{ LENGTHS[0] }>() {
            $run
        }
    }};
}
pub(crate) use with_padded;
