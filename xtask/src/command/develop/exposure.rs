//! How bright a picture is, and how much light it is given.

use onelight::spectra::MID_GREY;

/// A picture that is metered further from mid grey, in stops, gets a note.
const FAR_STOPS: f64 = 4.0;

/// How a picture is exposed before it meets the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Exposure {
    /// Brighter by so many stops.
    Stops(f64),
    /// So that what is metered of it comes to mid grey.
    Auto,
}

impl Default for Exposure {
    fn default() -> Self {
        Self::Stops(0.0)
    }
}

impl std::str::FromStr for Exposure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse::<f64>() {
            _ if text == "auto" => Ok(Self::Auto),
            Ok(stops) if (-60.0..=60.0).contains(&stops) => Ok(Self::Stops(stops)),
            _ => Err("expected a number of stops from -60 to 60, or auto".to_owned()),
        }
    }
}

/// What has been seen of a picture's light.
///
/// Metered is the log average of the pixels that lie not far below the brightest but a few ([`HIGHLIGHTS`]): they count in
/// full down to [`FULL_STOPS`], and less and less down to [`NO_STOPS`]. So a photographer meters what the picture is about:
/// neither a black background, whose noise rules an average of all logarithms, nor lamps and the sun, which rule an average
/// of light. docs/using.md compares them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Meter {
    /// Pixels that hold NaN or infinity.
    hard: usize,
    /// Pixels that have luminance and are not fully transparent.
    lit: u64,
    /// How many of them have each log2 luminance, in steps of [`STEP`] from [`LOWEST`].
    steps: Vec<u64>,
}

/// The share of lit pixels that may be highlights.
const HIGHLIGHTS: f64 = 0.02;
/// Stops below the highlights that count in full: about what a print shows.
const FULL_STOPS: f64 = 6.0;
/// Stops below the highlights that count no more.
const NO_STOPS: f64 = 10.0;
/// The least log2 luminance that is told from less, and the steps from there to the largest float.
const LOWEST: f64 = -150.0;
const STEP: f64 = 1.0 / 256.0;
const STEPS: usize = 280 * 256;

impl Meter {
    /// Adds what one row shows. Pixels are counted, so that the result depends neither on the bands nor on the number of
    /// threads.
    pub(super) fn add(&mut self, row: &RowLight) {
        self.hard += row.hard;
        self.lit += row.logs.len() as u64;
        self.steps.resize(STEPS, 0);
        for log in &row.logs {
            let step = ((log - LOWEST) / STEP).round().max(0.0) as usize;
            self.steps[step.min(STEPS - 1)] += 1;
        }
    }

    /// Stops from mid grey to what is metered; `None` where there is no light.
    fn off(&self) -> Option<f64> {
        let highlights = (self.lit as f64 * HIGHLIGHTS) as u64;
        let mut above = 0;
        let brightest = self.steps.iter().rposition(|count| {
            above += count;
            above > highlights
        })?;
        let log = |step: usize| LOWEST + step as f64 * STEP;
        let metered = self.steps.iter().enumerate().map(|(step, count)| {
            let below = log(brightest) - log(step);
            let weight = ((NO_STOPS - below) / (NO_STOPS - FULL_STOPS)).clamp(0.0, 1.0) * *count as f64;
            (weight, weight * log(step))
        });
        let (weights, sum) = metered.fold((0.0, 0.0), |(weights, sum), (weight, log)| (weights + weight, sum + log));
        Some(sum / weights - MID_GREY.log2())
    }

    /// The exposure that brings what is metered to mid grey; none where there is no light.
    pub(super) fn auto(&self) -> f64 {
        self.off().map_or(0.0, |off| -off)
    }

    /// What the user should know of the light, after an exposure of `ev` stops.
    pub(super) fn notes(&self, exposure: Exposure, ev: f64) -> Vec<String> {
        let mut notes = Vec::new();
        if self.hard > 0 {
            notes.push(format!(
                "{} pixels hold NaN or infinity: NaN counts as 0, infinity as {:e}",
                self.hard,
                onelight::SCENE_MAX
            ));
        }
        match self.off() {
            None if exposure == Exposure::Auto => {
                notes.push("the picture holds no light to expose for: --ev auto leaves it as it is".to_owned());
            }
            Some(off) if (off + ev).abs() > FAR_STOPS => {
                let left = off + ev;
                let (what, side) = if left < 0.0 { ("dark", "under") } else { ("bright", "over") };
                notes.push(format!(
                    "the picture is {what}, {:.1} stops {side} mid grey by the meter (--ev auto would use --ev {:+.1})",
                    left.abs(),
                    ev - left
                ));
            }
            _ => {}
        }
        notes
    }
}

/// What one row of a picture adds to the meter.
#[derive(Debug, Default)]
pub(super) struct RowLight {
    pub(super) hard: usize,
    /// log2 luminance of its lit pixels.
    pub(super) logs: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn auto(logs: impl Iterator<Item = f64>) -> f64 {
        let mut meter = Meter::default();
        meter.add(&RowLight { hard: 0, logs: logs.collect() });
        meter.auto()
    }

    /// Stops about mid grey, evenly spread.
    fn ramp(count: usize, stops: f64) -> impl Iterator<Item = f64> {
        (0..count).map(move |i| MID_GREY.log2() + stops * (2.0 * (i as f64 + 0.5) / count as f64 - 1.0))
    }

    #[test]
    fn a_grey_card_and_an_even_picture_stay() {
        assert!(auto(ramp(1000, 0.0)).abs() < STEP);
        assert!(auto(ramp(10_000, 3.0)).abs() < 2.0 * STEP);
        assert!((auto(ramp(10_000, 3.0).map(|log| log - 5.0)) - 5.0).abs() < 2.0 * STEP);
        assert_eq!(auto(std::iter::empty()), 0.0);
    }

    #[test]
    fn black_with_noise_and_a_sun_change_little() {
        let lit = || ramp(10_000, 3.0);
        let noise = (0..30_000).map(|i| -16.0 - f64::from(i % 7));
        assert!(auto(lit().chain(noise)).abs() < 1.0);
        let sun = (0..100).map(|_| 16.0);
        assert!(auto(lit().chain(sun)).abs() < 0.5);
    }

    #[test]
    fn the_ends_of_floats_are_counted() {
        let mut meter = Meter::default();
        let logs = [f64::from(f32::from_bits(1)).log2(), f64::from(f32::MAX).log2() + 2.0];
        meter.add(&RowLight { hard: 1, logs: logs.to_vec() });
        assert!(meter.auto().is_finite());
        assert_eq!(meter.notes(Exposure::Stops(0.0), 0.0).len(), 2);
    }
}
