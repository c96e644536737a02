mod log2_offset;

use crate::error::{Error, ErrorKind};
use log2_offset::Log2Offset;
pub(crate) use log2_offset::LogNumbers;

/// A monotone map from a scene-linear value in `[0, max]` to a table coordinate in `[0, 1]`, and back.
///
/// A table is sampled uniformly in the coordinate, so the shaper decides where its nodes lie. The same shaper
/// serves all three channels.
///
/// Outside its range a shaper clamps: negative values and NaN encode to 0, values above `max` and `+inf` to 1.
/// `decode` clamps its coordinate likewise, so both directions are total and finite.
///
/// ```
/// # use onelight_lut::Shaper;
/// let shaper = Shaper::log2(0.02, 4.0)?;
/// assert_eq!(shaper.encode(0.0), 0.0);
/// assert_eq!(shaper.encode(4.0), 1.0);
/// assert!((shaper.decode(shaper.encode(0.18)) - 0.18).abs() < 1e-12);
/// assert_eq!(shaper.encode(f64::NAN), 0.0);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaper(ShaperCurve);

/// What a [`Shaper`] computes, with its parameters: enough to write the same curve elsewhere.
///
/// ```
/// use onelight_lut::{Shaper, ShaperKind};
/// let shaper = Shaper::log2(0.02, 11.52)?;
/// assert!(matches!(shaper.kind(), ShaperKind::Log2Offset { max, .. } if max == 11.52));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ShaperKind {
    /// `log2(1 + u / offset) / log2(1 + max / offset)`.
    Log2Offset {
        /// Where the curve turns from linear to logarithmic, scene-linear.
        offset: f64,
        /// The value that encodes to 1, scene-linear.
        max: f64,
    },
}

/// The curve of each [`ShaperKind`], with what it has worked out in advance.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ShaperCurve {
    Log2Offset(Log2Offset),
}

impl Shaper {
    /// The offset of the talk's shaper, scene-linear \[Gotanda2010\].
    pub const GOTANDA_OFFSET: f64 = 0.191406;

    /// The last value of the talk's shaper, scene-linear \[Gotanda2010\].
    pub const GOTANDA_MAX: f64 = 4.0;

    /// The logarithm with an offset: `t = log2(1 + u / offset) / log2(1 + max / offset)`.
    ///
    /// Near 0 it is linear, far above `offset` it spends the same part of the table on every stop. An offset
    /// near 0.02 suits film looks baked to display code values; the talk's, ten times as large, leaves the
    /// shadows with too few nodes.
    ///
    /// # Errors
    ///
    /// If `offset` or `max` is not a number from 1e-30 to 1e30 (so that both live in `f32`), or the two are so
    /// far apart that the curve degenerates (`max / offset` has to lie between 1e-6 and 1e12).
    pub fn log2(offset: f64, max: f64) -> Result<Self, Error> {
        positive("offset of a log2 shaper", offset)?;
        positive("maximum of a log2 shaper", max)?;
        let ratio = max / offset;
        if !(1e-6..=1e12).contains(&ratio) {
            return Err(ErrorKind::Parameter {
                what: "maximum over offset of a log2 shaper",
                found: ratio,
                expected: "a ratio from 1e-6 to 1e12",
            }
            .into());
        }
        Ok(Self(ShaperCurve::Log2Offset(Log2Offset::new(offset, max))))
    }

    /// The shaper of the talk, over `[0, 4]` \[Gotanda2010\].
    ///
    /// The talk prints `0.534577 + 0.217563 log2(u + 0.191406)`. That is this shaper,
    /// `0.535692 + 0.224581 log2(u + 0.191406)`, followed by [`texel_centre`] for a texture of 32: its 0 and 1
    /// are moved to the centres of the first and last texel. The half-texel belongs to whatever samples a
    /// texture, once and for its own size, so it is no part of a shaper here.
    pub fn gotanda() -> Self {
        Self(ShaperCurve::Log2Offset(Log2Offset::new(Self::GOTANDA_OFFSET, Self::GOTANDA_MAX)))
    }

    /// The formula and its parameters.
    pub fn kind(&self) -> ShaperKind {
        match &self.0 {
            ShaperCurve::Log2Offset(curve) => ShaperKind::Log2Offset { offset: curve.offset(), max: curve.max() },
        }
    }

    /// The scene-linear value that encodes to 1.
    pub fn max(&self) -> f64 {
        match &self.0 {
            ShaperCurve::Log2Offset(curve) => curve.max(),
        }
    }

    /// The table coordinate, in `[0, 1]`, of a scene-linear value.
    pub fn encode(&self, linear: f64) -> f64 {
        match &self.0 {
            ShaperCurve::Log2Offset(curve) => curve.encode(linear),
        }
    }

    /// The scene-linear value, in `[0, max]`, at a table coordinate.
    pub fn decode(&self, coordinate: f64) -> f64 {
        match &self.0 {
            ShaperCurve::Log2Offset(curve) => curve.decode(coordinate),
        }
    }

    /// [`Shaper::encode`] for pixel loops, within 3e-7 of it for shapers in use (`max / offset` of 20 and more).
    #[inline]
    pub fn encode_f32(&self, linear: f32) -> f32 {
        self.numbers().encode(linear)
    }

    /// The curve's numbers in float32, worked out once.
    #[inline]
    pub(crate) fn numbers(&self) -> &LogNumbers {
        match &self.0 {
            ShaperCurve::Log2Offset(curve) => curve.numbers(),
        }
    }
}

/// Where a texture of `size` texels has to be read for the table coordinate `coordinate`.
///
/// Texture coordinates run from edge to edge, table coordinates from the centre of the first texel to that of
/// the last: `(coordinate * (size - 1) + 0.5) / size`. A `size` of 0 is taken as 1.
///
/// ```
/// # use onelight_lut::texel_centre;
/// assert_eq!(texel_centre(0.0, 32), 0.5 / 32.0);
/// assert_eq!(texel_centre(1.0, 32), 31.5 / 32.0);
/// ```
pub fn texel_centre(coordinate: f64, size: usize) -> f64 {
    let size = size.max(1) as f64;
    (coordinate * (size - 1.0) + 0.5) / size
}

fn positive(what: &'static str, found: f64) -> Result<(), Error> {
    if (1e-30..=1e30).contains(&found) {
        Ok(())
    } else {
        Err(ErrorKind::Parameter { what, found, expected: "a number above 0, from 1e-30 to 1e30" }.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// Half a unit of the sixth printed decimal, twice: once for the coefficient, once for the offset in it.
    const PRINTED: f64 = 1e-6;

    fn shapers() -> [Shaper; 4] {
        [
            Shaper::gotanda(),
            Shaper::log2(0.02, 4.0).unwrap(),
            Shaper::log2(0.005, 11.52).unwrap(),
            Shaper::log2(1.0, 1.0).unwrap(),
        ]
    }

    /// Intercept and slope of a coordinate as a function of log2(u + offset).
    fn line_in_log2(coordinate: impl Fn(f64) -> f64) -> (f64, f64) {
        let x = |u: f64| (u + Shaper::GOTANDA_OFFSET).log2();
        let slope = (coordinate(4.0) - coordinate(0.0)) / (x(4.0) - x(0.0));
        (coordinate(0.0) - slope * x(0.0), slope)
    }

    #[test]
    fn talk_constants_are_the_shaper_proper() {
        let (intercept, slope) = line_in_log2(|u| Shaper::gotanda().encode(u));
        assert_abs_diff_eq!(intercept, 0.535692, epsilon = PRINTED);
        assert_abs_diff_eq!(slope, 0.224581, epsilon = PRINTED);
        let middle = intercept + slope * (1.0 + Shaper::GOTANDA_OFFSET).log2();
        assert_abs_diff_eq!(Shaper::gotanda().encode(1.0), middle, epsilon = 1e-12);
    }

    #[test]
    fn printed_constants_are_texel_centres_of_32() {
        let (intercept, slope) = line_in_log2(|u| texel_centre(Shaper::gotanda().encode(u), 32));
        assert_abs_diff_eq!(intercept, 0.534577, epsilon = PRINTED);
        assert_abs_diff_eq!(slope, 0.217563, epsilon = PRINTED);
    }

    #[test]
    fn ends_are_exact() {
        for shaper in shapers() {
            assert_eq!(shaper.encode(0.0), 0.0);
            assert_eq!(shaper.encode(shaper.max()), 1.0);
            assert_eq!(shaper.decode(0.0), 0.0);
            assert_eq!(shaper.decode(1.0), shaper.max());
        }
    }

    #[test]
    fn encoding_grows_and_decoding_undoes_it() {
        for shaper in shapers() {
            let mut last = -1.0;
            for i in 0..=2000 {
                let u = shaper.max() * (f64::from(i) / 2000.0).powi(3);
                let t = shaper.encode(u);
                assert!(t > last, "{shaper:?} at {u}");
                last = t;
                assert_abs_diff_eq!(shaper.decode(t), u, epsilon = 1e-14 * shaper.max());
            }
        }
    }

    #[test]
    fn odd_inputs_clamp() {
        for shaper in shapers() {
            for (u, t) in [
                (f64::NAN, 0.0),
                (-1.0, 0.0),
                (-0.0, 0.0),
                (f64::NEG_INFINITY, 0.0),
                (f64::INFINITY, 1.0),
                (f64::MAX, 1.0),
            ] {
                assert_eq!(shaper.encode(u), t, "{u}");
                assert_eq!(shaper.encode_f32(u as f32), t as f32, "{u} in f32");
            }
            assert_eq!(shaper.decode(f64::NAN), 0.0);
            assert_eq!(shaper.decode(-1.0), 0.0);
            assert_eq!(shaper.decode(f64::INFINITY), shaper.max());
        }
    }

    #[test]
    fn f32_follows_f64() {
        for shaper in &shapers()[..3] {
            for i in 0..=20_000 {
                let u = (shaper.max() * (f64::from(i) / 20_000.0).powi(4)) as f32;
                let t = shaper.encode_f32(u);
                assert!((0.0..=1.0).contains(&t));
                assert_abs_diff_eq!(f64::from(t), shaper.encode(u.into()), epsilon = 3e-7);
            }
        }
    }

    #[test]
    fn parameters_are_checked() {
        for bad in [0.0, -1.0, 1e-40, 1e40, f64::NAN, f64::INFINITY] {
            assert!(Shaper::log2(bad, 4.0).is_err());
            assert!(Shaper::log2(0.02, bad).is_err());
        }
        assert!(Shaper::log2(1e-300, 1e300).is_err());
        assert!(Shaper::log2(1e300, 1e-300).is_err());
        let error = Shaper::log2(-1.0, 4.0).unwrap_err().to_string();
        assert_eq!(error, "offset of a log2 shaper: found -1, expected a number above 0, from 1e-30 to 1e30");
    }

    #[test]
    fn kind_rebuilds_the_shaper() {
        for shaper in shapers() {
            let ShaperKind::Log2Offset { offset, max } = shaper.kind();
            assert_eq!(Shaper::log2(offset, max).unwrap(), shaper);
        }
    }
}
