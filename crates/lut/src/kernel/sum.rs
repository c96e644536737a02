use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, MOST_LANES, Plane, load_rgb, map_plane, store_rgb, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::{exp2s, exp2s_within, log2s};
use crate::exponential_sum::{ExponentialSum, ExponentialTerm};
use crate::scene_light::LOG_FLOOR;

/// A sum of exponentials as the loops compute it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Exponentials {
    terms: Vec<TermLanes>,
    range: ExponentRange,
}

/// A term with each number in all lanes of the widest vector: an instruction takes them from memory as they are, while a single
/// number would first take a load and a register.
#[derive(Clone, Debug, PartialEq)]
#[repr(align(64))]
struct TermLanes {
    /// Rates with their sign turned: what 2 is raised to.
    rate: [[f32; MOST_LANES]; 3],
    weight: [[f32; MOST_LANES]; 3],
}

impl TermLanes {
    fn new(&ExponentialTerm { rate, weight }: &ExponentialTerm) -> Self {
        Self { rate: rate.map(|v| [-v; MOST_LANES]), weight: weight.map(|v| [v; MOST_LANES]) }
    }
}

/// Where the exponents of a sum lie.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ExponentRange {
    /// Where powers of two are normal numbers.
    Normal,
    /// Anywhere: they are held within the ends of [`exp2s`].
    Any,
}

/// The largest exponent of a sum that is not held within the ends, 126: numbers read from a curve may leave its entries by a rounding.
const NORMAL_EXPONENT: f64 = 125.0;

impl Exponentials {
    /// Of variables within these ends.
    pub(crate) fn new(sum: &ExponentialSum, ends: [[f32; 2]; 3]) -> Self {
        let largest = |rate: [f32; 3]| -> f64 {
            let most =
                |(rate, ends): (f32, [f32; 2])| f64::from(rate.abs()) * f64::from(ends[0].abs().max(ends[1].abs()));
            rate.into_iter().zip(ends).map(most).sum()
        };
        let is_normal = sum.terms().iter().all(|term| largest(term.rate) <= NORMAL_EXPONENT);
        let terms = sum.terms().iter().map(TermLanes::new).collect();
        Self { terms, range: if is_normal { ExponentRange::Normal } else { ExponentRange::Any } }
    }

    /// The sums at the block's colours, in place of them.
    pub(crate) fn apply(&self, level: Level, Block { rgb, .. }: &mut Block, count: usize) {
        dispatch!(level, simd => match self.range {
            ExponentRange::Normal => sums(simd, &self.terms, rgb, count,
                #[inline(always)]
                |x: _| exp2s_within(simd, x)),
            ExponentRange::Any => sums(simd, &self.terms, rgb, count,
                #[inline(always)]
                |x: _| exp2s(simd, x)),
        });
    }
}

/// One vector of pixels after the other, its colours and its sums in registers all the while.
#[inline(always)]
fn sums<S: Simd>(simd: S, terms: &[TermLanes], rgb: &mut [Plane; 3], count: usize, exp2: impl Fn(S::f32s) -> S::f32s) {
    for i in vector_starts::<S>(count) {
        let [x, y, z] = load_rgb(simd, rgb, i);
        let zero = S::f32s::splat(simd, 0.0);
        let [mut red, mut green, mut blue] = [zero; 3];
        for TermLanes { rate, weight } in terms {
            let exponent =
                z.mul_add(lanes(simd, &rate[2]), y.mul_add(lanes(simd, &rate[1]), x * lanes(simd, &rate[0])));
            let power = exp2(exponent);
            red = power.mul_add(lanes(simd, &weight[0]), red);
            green = power.mul_add(lanes(simd, &weight[1]), green);
            blue = power.mul_add(lanes(simd, &weight[2]), blue);
        }
        store_rgb::<S>([red, green, blue], rgb, i);
    }
}

/// As many of them as a vector has lanes.
#[inline(always)]
fn lanes<S: Simd>(simd: S, numbers: &[f32; MOST_LANES]) -> S::f32s {
    S::f32s::from_slice(simd, &numbers[..S::f32s::LEN])
}

/// The log2 of the block's colours, of at least [`LOG_FLOOR`].
pub(crate) fn log2_of_light(level: Level, Block { rgb, .. }: &mut Block, count: usize) {
    dispatch!(level, simd => for plane in rgb.iter_mut() {
        map_plane(simd, plane, count,
            #[inline(always)]
            |v: _| log2_above_floor(simd, v));
    });
}

#[inline(always)]
fn log2_above_floor<S: Simd>(simd: S, v: S::f32s) -> S::f32s {
    log2s(simd, v.max(LOG_FLOOR))
}
