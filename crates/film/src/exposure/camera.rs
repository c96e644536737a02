use onelight_spectra::MID_GREY;

use crate::error::{Error, ErrorKind};
use crate::metering::MID_GREY_LUX_S;

/// A real camera: what its settings let through to the film.
///
/// ```
/// use onelight_film::Camera;
/// // A 4000 cd/m^2 sky at 1/60 s and f/8: H in lux s.
/// let h = Camera::new(1.0 / 60.0, 8.0)?.focal_plane_exposure(4000.0);
/// assert!((h - 0.65 * 4000.0 / 60.0 / 64.0).abs() < 1e-12);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    shutter_s: f64,
    f_number: f64,
}

/// Fraction of the light that a usual lens brings to the film, vignetting and cos^4 included (\[ISO2720\]: 0.65).
const LENS_TRANSMISSION: f64 = 0.65;

impl Camera {
    /// Shutter time in s and f-number.
    ///
    /// # Errors
    /// If the time is not within 1e-9 s to 1e9 s or the f-number not within 1e-3 to 1e6.
    pub fn new(shutter_s: f64, f_number: f64) -> Result<Self, Error> {
        Ok(Self { shutter_s: SHUTTER_S.check(shutter_s)?, f_number: F_NUMBER.check(f_number)? })
    }

    /// Exposure of the film: H = q L t / N^2. Luminance in cd/m^2 gives lux s, radiance in W/(m^2 sr) gives J/m^2.
    #[must_use]
    pub fn focal_plane_exposure(self, luminance: f64) -> f64 {
        LENS_TRANSMISSION * luminance * self.shutter_s / (self.f_number * self.f_number)
    }

    /// Scene value (0.18 is a properly exposed grey card) of a matte surface that sends back `lux`, its illuminance times its
    /// reflectance, for a film of this speed: the exposure H over that of a metered mid grey, 8.1 lux s / `exposure_index`.
    ///
    /// ```
    /// use onelight_film::Camera;
    /// // A meter of K = 12.5 on a grey card: L = K N^2 / (t S), which exposes for mid grey.
    /// let (t, n, speed) = (1.0 / 60.0, 4.0, 250.0);
    /// let luminance = 12.5 * n * n / (t * speed);
    /// let scene = Camera::new(t, n)?.scene_value(std::f64::consts::PI * luminance, speed)?;
    /// assert!((scene / 0.18 - 1.0).abs() < 0.005);
    /// # Ok::<(), onelight_film::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the exposure index is not within 1e-3 to 1e9.
    pub fn scene_value(self, lux: f64, exposure_index: f64) -> Result<f64, Error> {
        let mid_grey_lux_s = MID_GREY_LUX_S / EXPOSURE_INDEX.check(exposure_index)?;
        Ok(MID_GREY * self.focal_plane_exposure(lux / std::f64::consts::PI) / mid_grey_lux_s)
    }
}

/// The scale of a frame buffer, step 2 of \[Gotanda2010\] taken literally: c = 1000 t / (F ISO/100), so that the stored
/// number is in mJ/m^2 per F per ISO 100 and keeps its size whatever the camera's settings.
///
/// `F` divides the exposure as it stands; physically that is the square of the f-number.
///
/// ```
/// use onelight_film::FrameBufferScale;
/// // 1/60 s at f/8, ISO 400.
/// let scale = FrameBufferScale::new(1.0 / 60.0, 64.0, 400.0)?;
/// let film = scale.film_exposure_mj_per_m2(scale.stored(2.0));
/// assert!((film - 2000.0 / 60.0 / 64.0).abs() < 1e-12, "the film's speed cancels in the film: {film} mJ/m^2");
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameBufferScale {
    factor: f64,
    speed: f64,
}

impl FrameBufferScale {
    /// Shutter time in s, exposure divisor F, exposure index (ISO).
    ///
    /// # Errors
    /// If the time is not within 1e-9 s to 1e9 s, F not within 1e-6 to 1e12, or the index not within 1e-3 to 1e9.
    pub fn new(shutter_s: f64, exposure_divisor: f64, exposure_index: f64) -> Result<Self, Error> {
        let t = SHUTTER_S.check(shutter_s)?;
        let f = EXPOSURE_DIVISOR.check(exposure_divisor)?;
        let speed = EXPOSURE_INDEX.check(exposure_index)? / 100.0;
        Ok(Self { factor: 1000.0 * t / (f * speed), speed })
    }

    /// What the frame buffer stores for an irradiance in W/m^2.
    #[must_use]
    pub fn stored(self, w_per_m2: f64) -> f64 {
        w_per_m2 * self.factor
    }

    /// The radiant exposure in mJ/m^2 that the film gets for a stored value.
    #[must_use]
    pub fn film_exposure_mj_per_m2(self, stored: f64) -> f64 {
        stored * self.speed
    }
}

/// A setting and the values it may have: all that a camera has and much more, but none that makes an exposure infinite.
struct Setting {
    what: &'static str,
    allowed: std::ops::RangeInclusive<f64>,
    expected: &'static str,
}

const SHUTTER_S: Setting = Setting { what: "shutter time in s", allowed: 1e-9..=1e9, expected: "1e-9 to 1e9" };
const F_NUMBER: Setting = Setting { what: "f-number", allowed: 1e-3..=1e6, expected: "1e-3 to 1e6" };
/// The squares of the f-numbers.
const EXPOSURE_DIVISOR: Setting =
    Setting { what: "exposure divisor F", allowed: 1e-6..=1e12, expected: "1e-6 to 1e12" };
const EXPOSURE_INDEX: Setting = Setting { what: "exposure index", allowed: 1e-3..=1e9, expected: "1e-3 to 1e9" };

impl Setting {
    fn check(&self, found: f64) -> Result<f64, Error> {
        let Self { what, expected, .. } = *self;
        if self.allowed.contains(&found) { Ok(found) } else { Err(ErrorKind::Camera { what, found, expected }.into()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_stop_is_a_stop() {
        let h = |t, n| Camera::new(t, n).unwrap().focal_plane_exposure(100.0);
        assert_relative_eq!(h(1.0 / 30.0, 4.0), 2.0 * h(1.0 / 60.0, 4.0));
        assert_relative_eq!(h(1.0 / 60.0, 4.0), 2.0 * h(1.0 / 60.0, 4.0 * 2f64.sqrt()), max_relative = 1e-12);
    }

    #[test]
    fn settings_that_no_camera_has_are_refused_and_all_others_give_finite_exposures() {
        for hard in [0.0, -1.0, f64::MIN_POSITIVE, f64::MAX, f64::INFINITY, f64::NAN] {
            assert!(Camera::new(hard, 4.0).is_err() && Camera::new(1.0, hard).is_err(), "{hard}");
            assert!(
                FrameBufferScale::new(hard, 4.0, 100.0).is_err() && FrameBufferScale::new(1.0, hard, 100.0).is_err()
            );
            assert!(FrameBufferScale::new(1.0, 4.0, hard).is_err(), "{hard}");
        }
        let error = Camera::new(1.0, 0.0).unwrap_err().to_string();
        assert_eq!(error, "f-number: found 0, expected 1e-3 to 1e6");
        for t in [1e-9, 1e9] {
            for f in [1e-3, 1e6] {
                let h = Camera::new(t, f).unwrap().focal_plane_exposure(1e6);
                assert!(h.is_finite() && h > 0.0);
                for speed in [1e-3, 1e9] {
                    let stored = FrameBufferScale::new(t, f * f, speed).unwrap().stored(1e6);
                    assert!(stored.is_finite() && stored > 0.0);
                }
            }
        }
    }

    #[test]
    fn film_speed_cancels_in_the_film() {
        for iso in [50.0, 100.0, 800.0] {
            let scale = FrameBufferScale::new(1.0 / 60.0, 8.0, iso).unwrap();
            // t/F in seconds, in mJ.
            assert_relative_eq!(scale.film_exposure_mj_per_m2(scale.stored(3.0)), 3000.0 / 480.0, max_relative = 1e-12);
        }
        assert_relative_eq!(FrameBufferScale::new(0.01, 4.0, 200.0).unwrap().stored(1.0), 1.25, max_relative = 1e-12);
    }
}
