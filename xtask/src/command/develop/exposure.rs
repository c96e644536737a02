//! How bright a picture is, and how much light it is given.

use onelight::spectra::MID_GREY;

/// A picture whose log average lies further from mid grey, in stops, gets a note.
const FAR_STOPS: f64 = 4.0;

/// How a picture is exposed before it meets the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Exposure {
    /// Brighter by so many stops.
    Stops(f64),
    /// So that its log average comes to mid grey.
    Auto,
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
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Meter {
    /// Pixels that hold NaN or infinity.
    hard: usize,
    /// Pixels that have luminance and are not fully transparent.
    lit: usize,
    /// The sum of their log2 luminance.
    log_sum: f64,
}

impl Meter {
    /// Adds what one row shows. Its logarithms are summed one after the other, from the first row to the last: the
    /// result depends neither on the bands nor on the number of threads.
    pub(super) fn add(&mut self, row: &RowLight) {
        self.hard += row.hard;
        self.lit += row.logs.len();
        row.logs.iter().for_each(|log| self.log_sum += log);
    }

    /// Stops from mid grey to the geometric mean of luminance; `None` where there is no light.
    fn off(&self) -> Option<f64> {
        (self.lit > 0).then(|| ((self.log_sum / self.lit as f64).exp2() / MID_GREY).log2())
    }

    /// The exposure that brings the log average to mid grey; none where there is no light.
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
                let side = if left < 0.0 { "under" } else { "over" };
                notes.push(format!(
                    "the picture lies {:.1} stops {side} mid grey; --ev auto would use --ev {:+.1}",
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
