use std::sync::Arc;

/// Entries for the loops, with zeros behind them up to one of the lengths of [`with_padded!`]. Taken modulo that length,
/// which is a power of two known where the loop is compiled, no index misses: none is checked, and what lanes without a
/// pixel point at does no harm.
///
/// Zeros that nobody reads take no memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Padded<E>(Arc<Vec<E>>);

/// The lengths: a table of up to 40, 80 and 256 nodes a side. Each is compiled for itself.
pub(super) const LENGTHS: [usize; 3] = [1 << 16, 1 << 19, 1 << 24];

impl<E: Copy + Default> Padded<E> {
    /// At most 2^24 entries, more than any table or curve has; those beyond are left out.
    pub(crate) fn new(entries: impl ExactSizeIterator<Item = E>) -> Self {
        let length = LENGTHS.into_iter().find(|length| entries.len() <= *length).unwrap_or(LENGTHS[2]);
        // Asked for as zeros, which the system hands out without touching them.
        let mut padded = vec![E::default(); length];
        for (to, entry) in padded.iter_mut().zip(entries) {
            *to = entry;
        }
        Self(Arc::new(padded))
    }
}

impl<E> Padded<E> {
    pub(super) fn entries(&self) -> &[E] {
        &self.0
    }
}

/// Runs the same expression on the entries as an array of whichever length they have.
macro_rules! with_padded {
    ($padded:expr, $entries:ident => $run:expr) => {{
        use $crate::kernel::padded::LENGTHS;
        let all = $padded.entries();
        if let Some($entries) = all.first_chunk::<{ LENGTHS[2] }>() {
            $run
        } else if let Some($entries) = all.first_chunk::<{ LENGTHS[1] }>() {
            $run
        } else if let Some($entries) = all.first_chunk::<{ LENGTHS[0] }>() {
            $run
        }
    }};
}
pub(super) use with_padded;
