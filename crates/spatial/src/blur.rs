//! The loops of symmetric blurs over rows.
//!
//! A blurred number is the pixel's own plus weighted differences to its neighbours, so that a uniform field comes out to the bit as it went
//! in. Sums are in one order for every vector length: results are the same on all machines.

/// Numbers that are worked on together: whole vectors of every machine.
pub(crate) const LANES: usize = 16;

/// `f` of the pixel's own number and of the weighted differences to its neighbours along the row. `padded` begins `side.len()` pixels before
/// `out` and ends as many after it.
#[inline(always)]
pub(crate) fn along_row(side: &[f32], padded: &[f32], out: &mut [f32]) {
    let radius = side.len();
    for (block, out) in out.chunks_mut(LANES).enumerate() {
        let start = block * LANES + radius;
        let len = out.len();
        let own = lanes(&padded[start..], len);
        let mut sum = [0.0; LANES];
        for (distance, &tap) in (1..).zip(side) {
            let (before, after) = (lanes(&padded[start - distance..], len), lanes(&padded[start + distance..], len));
            add_differences(&mut sum, tap, &before, &after, &own);
        }
        for i in 0..len {
            out[i] = own[i] + sum[i];
        }
    }
}

/// The weighted differences of the rows about row 0 to that row, added up: what a blur across rows adds to it.
#[inline(always)]
pub(crate) fn across_rows<'a>(
    side: &[f32],
    row: impl Fn(isize) -> &'a [f32],
    start: usize,
    len: usize,
) -> [f32; LANES] {
    let own = lanes(&row(0)[start..], len);
    let mut sum = [0.0; LANES];
    for (distance, &tap) in (1..).zip(side) {
        let (before, after) = (lanes(&row(-distance)[start..], len), lanes(&row(distance)[start..], len));
        add_differences(&mut sum, tap, &before, &after, &own);
    }
    sum
}

/// The first `LANES` numbers, or `len` of them and zeros.
#[inline(always)]
pub(crate) fn lanes(numbers: &[f32], len: usize) -> [f32; LANES] {
    if let Some(all) = numbers.first_chunk::<LANES>() {
        return *all;
    }
    let mut some = [0.0; LANES];
    some[..len].copy_from_slice(&numbers[..len]);
    some
}

#[inline(always)]
fn add_differences(sum: &mut [f32; LANES], tap: f32, before: &[f32; LANES], after: &[f32; LANES], own: &[f32; LANES]) {
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
