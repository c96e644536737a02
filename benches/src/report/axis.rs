//! Axes of charts: values to positions, and the values that are written beside them.

use super::text::plain;

/// An axis: its name with the unit, and how values lie on it.
pub(super) struct Axis {
    pub(super) name: String,
    pub(super) scale: Scale,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// In equal steps from 0.
    Linear,
    /// By factors. Values that are not above 0 have a place of their own at the lower edge.
    Log,
}

/// An axis laid out for its values.
pub(super) struct Placed {
    scale: Scale,
    /// Values at the ends, logarithms on a log axis.
    ends: (f64, f64),
    /// Places of the ends; beyond the first lies that of 0 on a log axis.
    positions: (f64, f64),
    zero: f64,
    ticks: Vec<(f64, String)>,
}

/// Space that a log axis keeps between its lower end and the place of 0, in pixels.
const ZERO_GAP: f64 = 26.0;

impl Axis {
    pub(super) fn log(name: &str) -> Self {
        Self { name: name.to_owned(), scale: Scale::Log }
    }

    pub(super) fn linear(name: &str) -> Self {
        Self { name: name.to_owned(), scale: Scale::Linear }
    }

    /// Lays the axis out between two positions for some values.
    pub(super) fn placed(&self, positions: (f64, f64), values: impl Iterator<Item = f64>) -> Placed {
        let values: Vec<f64> = values.filter(|v| v.is_finite()).collect();
        let direction = (positions.1 - positions.0).signum();
        match self.scale {
            Scale::Linear => {
                let most = values.iter().copied().fold(0.0, f64::max);
                let step = nice_step(if most > 0.0 { most } else { 1.0 });
                let count = (1.04 * most / step).ceil().max(1.0);
                let ticks = (0..=count as usize).map(|i| i as f64 * step).map(|v| (v, plain(v))).collect();
                Placed { scale: Scale::Linear, ends: (0.0, count * step), positions, zero: positions.0, ticks }
            }
            Scale::Log => {
                let above = || values.iter().copied().filter(|v| *v > 0.0);
                let (least, most) = above().fold((f64::INFINITY, 0f64), |(a, b), v| (a.min(v), b.max(v)));
                let (least, most) = if least <= most { (least, most) } else { (0.1, 10.0) };
                let margin = 0.05 * (most / least).log10() + 0.06;
                let ends = (least.log10() - margin, most.log10() + margin);
                let has_zero = values.len() > above().count();
                let from = if has_zero { positions.0 + direction * ZERO_GAP } else { positions.0 };
                let zero = positions.0 + direction * 0.4 * ZERO_GAP;
                let mut ticks = log_ticks(ends);
                if has_zero {
                    ticks.insert(0, (0.0, "0".to_owned()));
                }
                Placed { scale: Scale::Log, ends, positions: (from, positions.1), zero, ticks }
            }
        }
    }
}

impl Placed {
    /// The place of a value.
    pub(super) fn at(&self, value: f64) -> f64 {
        let value = match self.scale {
            Scale::Linear => value,
            Scale::Log if value > 0.0 => value.log10(),
            Scale::Log => return self.zero,
        };
        let part = (value - self.ends.0) / (self.ends.1 - self.ends.0);
        self.positions.0 + part * (self.positions.1 - self.positions.0)
    }

    pub(super) fn ticks(&self) -> &[(f64, String)] {
        &self.ticks
    }
}

/// 1, 2 or 5 times a power of ten: about five to the largest value.
fn nice_step(most: f64) -> f64 {
    let power = 10f64.powf((most / 5.0).log10().floor());
    let wanted = most / 5.0 / power;
    power
        * if wanted <= 1.0 {
            1.0
        } else if wanted <= 2.0 {
            2.0
        } else if wanted <= 5.0 {
            5.0
        } else {
            10.0
        }
}

/// Powers of ten, with 2 and 5 times them where there are few.
fn log_ticks((low, high): (f64, f64)) -> Vec<(f64, String)> {
    let multiples: &[f64] = if high - low < 2.6 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let powers = low.floor() as i32..=high.ceil() as i32;
    let all = powers.flat_map(|power| multiples.iter().map(move |m| m * 10f64.powi(power)));
    all.filter(|v| (low..=high).contains(&v.log10())).map(|v| (v, plain(v))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_follow_values_and_zero_lies_beyond() {
        let placed = Axis::log("").placed((300.0, 0.0), [0.01, 1.0, 0.0].into_iter());
        assert!(placed.at(0.01) > placed.at(0.1) && placed.at(0.1) > placed.at(1.0) && placed.at(1.0) > 0.0);
        assert!(placed.at(0.0) > placed.at(0.01) && placed.at(0.0) < 300.0);
        let half = (placed.at(0.01) + placed.at(1.0)) / 2.0;
        assert!((placed.at(0.1) - half).abs() < 1e-9);
        let names: Vec<&str> = placed.ticks().iter().map(|(_, name)| name.as_str()).collect();
        assert_eq!(names, ["0", "0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]);
    }

    #[test]
    fn steps_of_a_linear_axis_are_round() {
        let placed = Axis::linear("").placed((0.0, 100.0), [3.7, 0.2].into_iter());
        let values: Vec<f64> = placed.ticks().iter().map(|t| t.0).collect();
        assert_eq!(values, [0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!((placed.at(0.0), placed.at(4.0)), (0.0, 100.0));
        // Nothing to show is no reason to fail.
        assert!(Axis::log("").placed((0.0, 1.0), std::iter::empty()).at(1.0).is_finite());
        assert!(Axis::linear("").placed((0.0, 1.0), [f64::NAN].into_iter()).at(1.0).is_finite());
    }
}
