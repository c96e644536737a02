//! Strength of grain by amount of dye, as the pixel loops read it.

use crate::blur::LANES;

/// Intervals of a table.
const INTERVALS: usize = 512;
const END: f32 = INTERVALS as f32 - 0.000_1;
/// 2^23: a float of this size has no bits behind the point.
const ROUNDER: f32 = 8_388_608.0;

/// Standard deviation and mean shift over amount, evenly spaced, linear between, flat outside.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StrengthTable {
    low: f32,
    per_unit: f32,
    /// Standard deviation and mean shift at the start of each interval, and what is added across it.
    intervals: Box<[[f32; 4]; INTERVALS]>,
}

impl StrengthTable {
    pub(crate) fn new([low, high]: [f64; 2], strength: impl Fn(f64) -> [f64; 2]) -> Self {
        let step = (high - low) / INTERVALS as f64;
        let node = |i: usize| strength(low + i as f64 * step).map(|v| v as f32);
        let interval = |i| {
            let ([s, m], [t, n]) = (node(i), node(i + 1));
            [s, t - s, m, n - m]
        };
        let per_unit = if step > 0.0 { 1.0 / step } else { 0.0 };
        Self { low: low as f32, per_unit: per_unit as f32, intervals: Box::new(std::array::from_fn(interval)) }
    }

    /// Where it begins, and intervals in a unit of amount.
    pub(crate) fn axis(&self) -> [f32; 2] {
        [self.low, self.per_unit]
    }

    pub(crate) fn intervals(&self) -> Vec<[f32; 4]> {
        self.intervals.to_vec()
    }

    /// Adds `sigma * noise + shift` to a group of amounts.
    #[inline(always)]
    pub(crate) fn add_grain(&self, noise: &[f32; LANES], amounts: &mut [f32; LANES]) {
        let (mut interval, mut t, mut ends) = ([0i32; LANES], [0.0f32; LANES], [[0.0f32; 4]; LANES]);
        for i in 0..LANES {
            let place = ((amounts[i] - self.low) * self.per_unit).clamp(0.0, END);
            // Adding a large number rounds to a whole one, which then stands in the lowest bits.
            let whole = ((place - 0.5) + ROUNDER).max(ROUNDER);
            interval[i] = whole.to_bits() as i32;
            t[i] = place - (whole - ROUNDER);
        }
        for (ends, interval) in ends.iter_mut().zip(interval) {
            *ends = self.intervals[interval as usize % INTERVALS];
        }
        for i in 0..LANES {
            let [s, s_step, m, m_step] = ends[i];
            amounts[i] += (s + t[i] * s_step) * noise[i] + (m + t[i] * m_step);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_exact_and_outside_is_flat() {
        let table = StrengthTable::new([0.0, 2.0], |a| [0.01 + 0.02 * a, -0.001 * a]);
        let at = |amount: f32, noise: f32| {
            let mut amounts = [amount; LANES];
            table.add_grain(&[noise; LANES], &mut amounts);
            amounts[7] - amount
        };
        for (amount, sigma) in
            [(-1.0, 0.01), (0.0, 0.01), (0.002, 0.01004), (0.7, 0.024), (1.9999, 0.049_998), (2.0, 0.05), (9.0, 0.05)]
        {
            let (shift, with_noise) = (at(amount, 0.0), at(amount, 1.0));
            assert!((with_noise - shift - sigma).abs() < 1e-6, "{amount}: {with_noise} {shift}");
            assert!((shift + 0.05 * (sigma - 0.01)).abs() < 1e-6, "{amount}: {shift}");
        }
    }
}
