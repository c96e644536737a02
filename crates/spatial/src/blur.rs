//! The loops of symmetric blurs over rows.
//!
//! A blurred number is the pixel's own plus weighted differences to its neighbours, so that a uniform field comes out to the bit as it went
//! in. Sums are in one order for every vector length: results are the same on all machines.

/// Numbers that are worked on together: several whole vectors of every machine, so that finding the rows costs little beside them.
pub(crate) const LANES: usize = 32;

/// So many numbers that whole groups of [`LANES`] cover `count` of them.
pub(crate) fn whole_lanes(count: usize) -> usize {
    count.next_multiple_of(LANES)
}

/// The row blurred along itself. `padded` begins `side.len()` pixels before `out`; `out` is whole groups of [`LANES`], `padded` at least
/// `2 * side.len()` longer.
#[inline(always)]
pub(crate) fn along_row(side: &[f32], padded: &[f32], out: &mut [f32]) {
    let radius = side.len();
    for (block, out) in out.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let start = block * LANES + radius;
        let own = lanes(padded, start);
        let mut sum = *own;
        for (i, &tap) in side.iter().enumerate() {
            add_differences(&mut sum, tap, lanes(padded, start - i - 1), lanes(padded, start + i + 1), own);
        }
        *out = sum;
    }
}

/// The group at `start` of row `y`, blurred across the rows of `plane`, which are `stride` long.
#[inline(always)]
pub(crate) fn across_rows(side: &[f32], plane: &[f32], stride: usize, y: usize, start: usize) -> [f32; LANES] {
    let at = y * stride + start;
    let own = lanes(plane, at);
    let mut sum = *own;
    for (i, &tap) in side.iter().enumerate() {
        let distance = (i + 1) * stride;
        add_differences(&mut sum, tap, lanes(plane, at - distance), lanes(plane, at + distance), own);
    }
    sum
}

/// The group that begins at `start`; zeros where there is no whole one, which no caller asks for.
#[inline(always)]
pub(crate) fn lanes(numbers: &[f32], start: usize) -> &[f32; LANES] {
    const NONE: [f32; LANES] = [0.0; LANES];
    numbers.get(start..).and_then(|from| from.first_chunk()).unwrap_or(&NONE)
}

#[inline(always)]
pub(crate) fn add_differences(
    sum: &mut [f32; LANES],
    tap: f32,
    before: &[f32; LANES],
    after: &[f32; LANES],
    own: &[f32; LANES],
) {
    for i in 0..LANES {
        sum[i] += tap * ((before[i] + after[i]) - (own[i] + own[i]));
    }
}

/// Copies a row's part from `start` (which may be before the row) into all of `padded`, the edge pixels repeated.
#[inline(always)]
pub(crate) fn copy_padded(row: &[f32], start: isize, padded: &mut [f32]) {
    let (first, last) = (row[0], row[row.len() - 1]);
    let before = ((-start).max(0) as usize).min(padded.len());
    let from = (start.max(0) as usize).min(row.len());
    let inside = (row.len() - from).min(padded.len() - before);
    padded[..before].fill(first);
    padded[before..before + inside].copy_from_slice(&row[from..from + inside]);
    padded[before + inside..].fill(last);
}
