use super::Certificate;
use super::hue_steps::ALLOWED_RATIO;

/// A largest hue step that is above the reference's by less than this part of the limit is no failure: near white
/// and near black the reference's own steps are next to nothing.
const HUE_SLACK: f64 = 0.1;

/// How much further than the reference a candidate's neutral axis may fall, luminance 1 at white: a few roundings
/// of float32 after decoding, and a hundredth of a CIELAB unit at black.
const FALL_SLACK: f64 = 1e-5;

impl Certificate {
    /// Whether nothing fails; see [`Certificate::failures`].
    #[must_use]
    pub fn passed(&self, limit: f64) -> bool {
        self.failures(limit).is_empty()
    }

    /// What fails and why, a sentence each:
    /// - a largest difference above the limit, be it of the law, on the neutral axis, in a set of named colours
    ///   or on a circle of hues;
    /// - a neutral axis that falls further than the reference's;
    /// - folds;
    /// - a largest hue step above one and a half times the reference's on the same circle, or a step that is above
    ///   one and a half times the reference's at the same hue by more than the limit.
    ///
    /// The limit has the unit of [`Maps::difference`](crate::Maps::difference).
    #[must_use]
    pub fn failures(&self, limit: f64) -> Vec<String> {
        let mut failures = self.differences_above(limit);
        let axis = &self.neutral_axis;
        if let Some(stops) = axis.fall.stops
            && axis.fall.luminance > axis.reference_fall.luminance + FALL_SLACK
        {
            failures.push(format!(
                "neutral axis: luminance falls by {:.1e} up to {stops:+} stops, the reference's by at most {:.1e}",
                axis.fall.luminance, axis.reference_fall.luminance
            ));
        }
        if let Some(first) = self.folds.first {
            let counted = self.folds.places - self.folds.clipped - self.folds.flat;
            failures.push(format!(
                "folds: found at {} of {counted} places, the first at scene-linear {}",
                self.folds.folds,
                triple(first)
            ));
        }
        for circle in &self.hue_steps {
            let allowed = (ALLOWED_RATIO * circle.reference).max(circle.reference + HUE_SLACK * limit);
            if circle.candidate > allowed {
                failures.push(format!(
                    "hue steps at {:+} stops: found {:.3} at {} degrees, expected at most {allowed:.3}, the reference's being {:.3}",
                    circle.stops, circle.candidate, circle.candidate_hue, circle.reference
                ));
            }
            if circle.excess > limit {
                failures.push(format!(
                    "hue step at {:+} stops, {} degrees: found {:.3} above {ALLOWED_RATIO} times the reference's there, expected at most {limit}",
                    circle.stops, circle.excess_hue, circle.excess
                ));
            }
        }
        failures
    }

    fn differences_above(&self, limit: f64) -> Vec<String> {
        let axis = &self.neutral_axis;
        let mut found = vec![
            (self.max_found, "largest difference".into(), format!("scene-linear {}", triple(self.max_found_at))),
            (axis.max, "neutral axis".into(), format!("{:+} stops", axis.worst_stops)),
        ];
        found.extend(self.colour_sets.iter().map(|set| {
            (set.max, format!("colours of {}", set.name), format!("{} at {:+} stops", set.worst_name, set.worst_stops))
        }));
        found.extend(self.hue_steps.iter().map(|circle| {
            (circle.max, format!("saturated hues at {:+} stops", circle.stops), format!("{} degrees", circle.max_hue))
        }));
        let above = found.into_iter().filter(|(max, ..)| *max > limit);
        above.map(|(max, what, at)| format!("{what}: found {max:.3} at {at}, expected at most {limit}")).collect()
    }
}

fn triple([r, g, b]: [f64; 3]) -> String {
    format!("[{r:.3e}, {g:.3e}, {b:.3e}]")
}
