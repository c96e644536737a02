//! How bright a picture is, and how much light it is given.

use onelight::LightSeen;

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

/// What the user should know of a picture's light, after an exposure of `ev` stops.
pub(super) fn notes(seen: &LightSeen, exposure: Exposure, ev: f64) -> Vec<String> {
    let mut notes = Vec::new();
    if seen.hard > 0 {
        notes.push(format!(
            "{} pixels hold NaN or infinity: NaN counts as 0, infinity as {:e}",
            seen.hard,
            onelight::SCENE_MAX
        ));
    }
    match seen.meter.stops_off() {
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
#[cfg(test)]
mod tests {
    use onelight::spectra::MID_GREY;

    use super::*;

    #[test]
    fn hard_pixels_and_dark_pictures_are_told() {
        let mut seen = LightSeen { hard: 1, ..LightSeen::default() };
        (0..9).for_each(|_| seen.meter.add(MID_GREY * (-6.0_f64).exp2()));
        assert!((seen.meter.exposure() - 6.0).abs() < 0.01);
        assert_eq!(notes(&seen, Exposure::Stops(0.0), 0.0).len(), 2);
        assert_eq!(notes(&seen, Exposure::Stops(6.0), 6.0).len(), 1);
        assert_eq!(notes(&LightSeen::default(), Exposure::Auto, 0.0).len(), 1);
    }
}
