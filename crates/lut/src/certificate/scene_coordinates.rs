use crate::scene_sampler::SceneSampler;

/// Where a scene-linear colour lies in the domain of [`SceneSampler`]: three numbers that can be moved one by one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SceneCoordinates {
    /// The largest channel, in stops about mid grey.
    pub(super) stops: f64,
    /// One minus the smallest channel over the largest, 0 to 1.
    pub(super) saturation: f64,
    /// Red 0, yellow 1, green 2, cyan 3, blue 4, magenta 5, and round again at 6.
    pub(super) hue: f64,
}

impl SceneCoordinates {
    pub(super) fn of(rgb: [f64; 3]) -> Self {
        let sixth = SceneSampler::ORDERS.iter().position(|&[a, b, c]| rgb[a] >= rgb[b] && rgb[b] >= rgb[c]);
        let sixth = sixth.unwrap_or(0);
        let [high, middle, low] = SceneSampler::ORDERS[sixth].map(|channel| rgb[channel]);
        let position = if high > low { (middle - low) / (high - low) } else { 0.0 };
        Self {
            stops: (high / SceneSampler::MID_GREY).log2(),
            saturation: if high > 0.0 { 1.0 - low / high } else { 0.0 },
            hue: sixth as f64 + if sixth.is_multiple_of(2) { position } else { 1.0 - position },
        }
    }

    pub(super) fn rgb(self) -> [f64; 3] {
        let hue = self.hue.rem_euclid(6.0);
        let sixth = (hue as usize).min(5);
        let along = hue - sixth as f64;
        // The middle channel rises from a primary to the next mix, then falls from the mix to the next primary.
        let position = if sixth.is_multiple_of(2) { along } else { 1.0 - along };
        let high = grey(self.stops);
        let low = high * (1.0 - self.saturation);
        let mut rgb = [0.0; 3];
        for (channel, value) in SceneSampler::ORDERS[sixth].into_iter().zip([high, low + position * (high - low), low])
        {
            rgb[channel] = value;
        }
        rgb
    }
}

/// The channel value of a grey, scene-linear.
pub(super) fn grey(stops: f64) -> f64 {
    SceneSampler::MID_GREY * stops.exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn there_and_back() {
        for rgb in SceneSampler::new(-10.0..=10.0).unwrap().take(2000) {
            let coordinates = SceneCoordinates::of(rgb);
            assert!((0.0..=1.0).contains(&coordinates.saturation) && (0.0..=6.0).contains(&coordinates.hue));
            for (found, want) in coordinates.rgb().into_iter().zip(rgb) {
                assert_relative_eq!(found, want, max_relative = 1e-9, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn the_circle_is_closed_and_has_its_corners() {
        let at = |hue| SceneCoordinates { stops: 0.0, saturation: 1.0, hue }.rgb().map(|u| u / 0.18);
        let corners = [[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1], [1, 0, 0]];
        for (hue, corner) in corners.into_iter().enumerate() {
            for side in [-1e-9, 0.0, 1e-9] {
                for (found, want) in at(hue as f64 + side).into_iter().zip(corner) {
                    assert!((found - f64::from(want)).abs() < 2e-9);
                }
            }
        }
        assert_eq!(SceneCoordinates::of([0.36; 3]), SceneCoordinates { stops: 1.0, saturation: 0.0, hue: 0.0 });
    }
}
