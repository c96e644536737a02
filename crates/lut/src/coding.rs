use crate::error::{Error, ErrorKind};
use crate::number::Number;

/// The transfer curve of an output as two numbers: a power with a straight foot, odd about 0.
///
/// `encode(v) = (1 + offset) v^(1 / exponent) - offset` above the point where a line through the origin touches it, and that
/// line below: the "moncurve" of the Common LUT Format \[S2014-006\]. sRGB is (2.4, 0.055), a pure power has offset 0, and
/// linear light is (1, 0).
///
/// ```
/// use onelight_lut::{CodingStandard, PowerCoding};
///
/// let srgb = PowerCoding::new(2.4, 0.055)?;
/// assert_eq!(srgb.standard(), CodingStandard::Srgb);
/// assert!((srgb.encode(0.18) - 0.4614).abs() < 1e-4);
/// assert!((srgb.decode(srgb.encode(-0.5)) + 0.5).abs() < 1e-12);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerCoding {
    standard: CodingStandard,
    exponent: f64,
    offset: f64,
    /// Slope of the line, and where it ends in linear light.
    slope: f64,
    end: f64,
}

/// Whether the hardware can do the work of a [`PowerCoding`]: a frame buffer with an sRGB format encodes linear light itself.
///
/// ```
/// use onelight_lut::{CodingStandard, PowerCoding};
/// assert_eq!(PowerCoding::new(2.4, 0.055)?.standard(), CodingStandard::Srgb);
/// assert_eq!(PowerCoding::LINEAR.standard(), CodingStandard::Linear);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CodingStandard {
    /// Linear light is stored as it is: exponent 1.
    Linear,
    /// The curve of IEC 61966-2-1: exponent 2.4, offset 0.055.
    Srgb,
    /// Any other exponent and offset, such as a pure power of 2.4.
    Other,
}

/// Exponent and offset of sRGB.
const SRGB: (f64, f64) = (2.4, 0.055);

impl PowerCoding {
    /// The coding that leaves linear light as it is.
    pub const LINEAR: Self =
        Self { standard: CodingStandard::Linear, exponent: 1.0, offset: 0.0, slope: 1.0, end: 0.0 };

    /// A curve from its exponent and offset.
    ///
    /// # Errors
    /// If the exponent is outside 1 to 10, or the offset outside 0 to 0.9; an exponent of 1 needs an offset of 0.
    pub fn new(exponent: f64, offset: f64) -> Result<Self, Error> {
        let refuse = |what, found, expected| Err(ErrorKind::Parameter { what, found, expected }.into());
        if !(1.0..=10.0).contains(&exponent) {
            return refuse("exponent of a coding", exponent, "a number from 1 to 10");
        }
        if !(0.0..=0.9).contains(&offset) {
            return refuse("offset of a coding", offset, "a number from 0 to 0.9");
        }
        match (exponent == 1.0, offset == 0.0) {
            (true, true) => return Ok(Self::LINEAR),
            (true, false) => return refuse("offset of a coding with exponent 1", offset, "0"),
            (false, true) => return Ok(Self { standard: CodingStandard::Other, exponent, offset, ..Self::LINEAR }),
            (false, false) => (),
        }
        // The line through the origin that touches the power.
        let coded_end = offset / (exponent - 1.0);
        let end = ((coded_end + offset) / (1.0 + offset)).powf(exponent);
        let standard = if (exponent, offset) == SRGB { CodingStandard::Srgb } else { CodingStandard::Other };
        Ok(Self { standard, exponent, offset, slope: coded_end / end, end })
    }

    /// Which published curve it is, decided once by [`PowerCoding::new`].
    pub fn standard(&self) -> CodingStandard {
        self.standard
    }

    /// The exponent of the power, from 1 to 10, such as 2.4.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// The offset of the power, from 0 to 0.9, such as 0.055.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The slope of the straight foot: coded for linear.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Where the foot ends, in linear light.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// From linear light, 1 at white, to its code; odd about 0.
    pub fn encode(&self, linear: f64) -> f64 {
        self.encode_in(linear)
    }

    /// From a code back to linear light: undoes [`PowerCoding::encode`].
    pub fn decode(&self, coded: f64) -> f64 {
        let v = coded.abs();
        let linear = if v <= self.slope * self.end {
            v / self.slope
        } else {
            ((v + self.offset) / (1.0 + self.offset)).powf(self.exponent)
        };
        linear.copysign(coded)
    }

    /// [`PowerCoding::encode`] for pixel loops, within 1e-6 of it.
    #[inline]
    pub fn encode_f32(&self, linear: f32) -> f32 {
        self.encode_in(linear)
    }

    /// The one definition of [`PowerCoding::encode`], for float32 and float64.
    #[inline]
    pub(crate) fn encode_in<N: Number>(&self, linear: N) -> N {
        self.numbers().encode(linear)
    }

    /// The curve's numbers, each rounded once.
    #[inline]
    pub(crate) fn numbers<N: Number>(&self) -> PowerNumbers<N> {
        PowerNumbers {
            power: N::rounded(1.0 / self.exponent),
            scale: N::rounded(1.0 + self.offset),
            offset: N::rounded(self.offset),
            slope: N::rounded(self.slope),
            end: N::rounded(self.end),
        }
    }
}

/// A [`PowerCoding`] as it is computed: `scale v^power - offset` above `end`, `slope v` below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PowerNumbers<N> {
    pub(crate) power: N,
    pub(crate) scale: N,
    pub(crate) offset: N,
    pub(crate) slope: N,
    pub(crate) end: N,
}

impl<N: Number> PowerNumbers<N> {
    /// Whether there is no coding.
    #[inline]
    pub(crate) fn is_linear(&self) -> bool {
        self.power == N::ONE
    }

    #[inline]
    fn encode(&self, linear: N) -> N {
        if self.is_linear() {
            return linear;
        }
        let v = linear.abs();
        let coded = if v <= self.end { self.slope * v } else { self.scale * v.pow(self.power) - self.offset };
        coded.copysign(linear)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn srgb_is_the_published_curve() {
        // The standard rounds slope and end: 12.92 and 0.0031308.
        let srgb = PowerCoding::new(2.4, 0.055).unwrap();
        assert_relative_eq!(srgb.slope, 12.92, epsilon = 4e-3);
        assert_relative_eq!(srgb.end, 0.003_130_8, epsilon = 1e-4);
        assert_relative_eq!(srgb.encode(0.18), 0.461_356_129_5, epsilon = 1e-9);
        assert_relative_eq!(srgb.encode(1.0), 1.0, epsilon = 1e-12);
    }

    #[test]
    fn decode_undoes_encode_and_f32_follows() {
        for (exponent, offset) in [(1.0, 0.0), (2.4, 0.0), (2.4, 0.055), (2.6, 0.1)] {
            let coding = PowerCoding::new(exponent, offset).unwrap();
            for i in -2000..=2000 {
                let v = f64::from(i) / 1000.0;
                assert_relative_eq!(coding.decode(coding.encode(v)), v, epsilon = 1e-12);
                assert_relative_eq!(f64::from(coding.encode_f32(v as f32)), coding.encode(v), epsilon = 1e-6);
            }
        }
        assert!(PowerCoding::new(0.5, 0.0).is_err());
        assert!(PowerCoding::new(2.4, -0.1).is_err());
        assert!(PowerCoding::new(1.0, 0.1).is_err());
    }

    #[test]
    fn published_curves_are_known() {
        for (exponent, offset, expected) in [
            (1.0, 0.0, CodingStandard::Linear),
            (2.4, 0.055, CodingStandard::Srgb),
            (2.4, 0.0, CodingStandard::Other),
            (2.2, 0.055, CodingStandard::Other),
            (2.6, 0.1, CodingStandard::Other),
        ] {
            assert_eq!(PowerCoding::new(exponent, offset).unwrap().standard(), expected, "{exponent} {offset}");
        }
        assert_eq!(PowerCoding::new(1.0, 0.0).unwrap(), PowerCoding::LINEAR);
    }
}
