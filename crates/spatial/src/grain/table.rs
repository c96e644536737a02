//! Strength of grain by amount of dye, as the pixel loops read it.

/// Intervals of a table.
const INTERVALS: usize = 512;

/// Standard deviation and mean shift over amount, evenly spaced, linear between, flat outside.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StrengthTable {
    low: f32,
    per_unit: f32,
    /// Standard deviation and mean shift at the start of each interval, and what is added across it.
    intervals: Vec<[f32; 4]>,
}

impl StrengthTable {
    pub(crate) fn new([low, high]: [f64; 2], strength: impl Fn(f64) -> [f64; 2]) -> Self {
        let step = (high - low) / INTERVALS as f64;
        let nodes: Vec<[f32; 2]> = (0..=INTERVALS).map(|i| strength(low + i as f64 * step).map(|v| v as f32)).collect();
        let interval = |ends: &[[f32; 2]]| {
            let [[s, m], [t, n]] = [ends[0], ends[1]];
            [s, t - s, m, n - m]
        };
        let per_unit = if step > 0.0 { 1.0 / step } else { 0.0 };
        Self { low: low as f32, per_unit: per_unit as f32, intervals: nodes.windows(2).map(interval).collect() }
    }

    /// Standard deviation and mean shift at an amount.
    #[inline(always)]
    pub(crate) fn at(&self, amount: f32) -> [f32; 2] {
        let place = ((amount - self.low) * self.per_unit).max(0.0).min(INTERVALS as f32);
        let interval = (place as i32 as usize).min(INTERVALS - 1);
        let t = place - interval as f32;
        let [s, s_step, m, m_step] = self.intervals[interval];
        [s + t * s_step, m + t * m_step]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_exact_and_outside_is_flat() {
        let table = StrengthTable::new([0.0, 2.0], |a| [0.01 + 0.02 * a, -0.001 * a]);
        for (amount, sigma) in [(-1.0, 0.01), (0.0, 0.01), (0.7, 0.024), (2.0, 0.05), (99.0, 0.05), (f32::NAN, 0.01)] {
            let [found, shift] = table.at(amount);
            assert!((found - sigma).abs() < 1e-7, "{amount}: {found}");
            assert!((shift + 0.05 * (sigma - 0.01)).abs() < 1e-7, "{amount}: {shift}");
        }
    }
}
