use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};

use crate::blackbody::{Kelvin, black_body};
use crate::error::{Error, ErrorKind};
use crate::observer::Observer;
use crate::shape::SpectralShape;

/// A CIE 1931 xy chromaticity: a colour without its brightness.
///
/// ```
/// use onelight_spectra::{Chromaticity, Illuminant, Observer, SpectralShape, illuminant};
/// let daylight = illuminant(Illuminant::D65, SpectralShape::VISIBLE);
/// let found = Chromaticity::of(&Observer::cie_1931().xyz(&daylight));
/// // The standards round it to four digits.
/// assert!((found.x - Chromaticity::D65.x).abs() < 1e-4 && (found.y - Chromaticity::D65.y).abs() < 1e-4);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chromaticity {
    /// The share of X in X + Y + Z, 0 to 1 for colours that exist.
    pub x: f64,
    /// The share of Y in X + Y + Z, above 0 to 1 for colours that exist.
    pub y: f64,
}

impl Chromaticity {
    /// The CIE's D65 as RGB standards round it.
    pub const D65: Self = Self::new(0.3127, 0.3290);
    /// The CIE's D50 as RGB standards round it.
    pub const D50: Self = Self::new(0.3457, 0.3585);
    /// The white of film projection (\[RP431-2\]).
    pub const DCI: Self = Self::new(0.314, 0.351);
    /// The white of ACES (\[TB2014-004\]).
    pub const ACES: Self = Self::new(0.32168, 0.33767);

    /// A chromaticity from its coordinates.
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The white of the model: the 6500 K black body on the grid 380..780 nm.
    #[must_use]
    pub fn black_body_6500_k() -> Self {
        static WHITE: OnceLock<Chromaticity> = OnceLock::new();
        *WHITE.get_or_init(|| Self::of(&Observer::cie_1931().xyz(&black_body(Kelvin::WHITE, SpectralShape::VISIBLE))))
    }

    /// The chromaticity of tristimulus values whose sum is not 0.
    #[must_use]
    pub fn of(xyz: &Vector3<f64>) -> Self {
        Self::new(xyz.x / xyz.sum(), xyz.y / xyz.sum())
    }

    /// Tristimulus values of this chromaticity with Y = 1; y must not be 0.
    #[must_use]
    pub fn xyz(self) -> Vector3<f64> {
        Vector3::new(self.x / self.y, 1.0, (1.0 - self.x - self.y) / self.y)
    }
}

/// Linear RGB: three primaries and the white that (1, 1, 1) stands for.
///
/// ```
/// use onelight_spectra::{Chromaticity, RgbSpace};
/// let srgb = RgbSpace::SRGB.with_white(Chromaticity::black_body_6500_k());
/// let xyz = srgb.to_xyz()? * nalgebra::Vector3::new(1.0, 1.0, 1.0);
/// assert!((xyz.y - 1.0).abs() < 1e-12);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RgbSpace {
    /// The chromaticities of red, green and blue.
    pub primaries: [Chromaticity; 3],
    /// What (1, 1, 1) looks like.
    pub white: Chromaticity,
}

impl RgbSpace {
    /// The primaries of sRGB and BT.709 (\[IEC61966-2-1\]).
    pub const SRGB: Self = Self::new([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)], Chromaticity::D65);
    /// Display P3 (\[EG432-1\] primaries with D65).
    pub const DISPLAY_P3: Self = Self::new([(0.680, 0.320), (0.265, 0.690), (0.150, 0.060)], Chromaticity::D65);
    /// BT.2020, the wide gamut of television (\[BT2020\]).
    pub const REC2020: Self = Self::new([(0.708, 0.292), (0.170, 0.797), (0.131, 0.046)], Chromaticity::D65);
    /// ACEScg, the AP1 primaries (\[S2014-004\]).
    pub const ACESCG: Self = Self::new([(0.713, 0.293), (0.165, 0.830), (0.128, 0.044)], Chromaticity::ACES);
    /// ACES2065-1, the AP0 primaries (\[ST2065-1\]).
    pub const ACES2065_1: Self = Self::new([(0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.0770)], Chromaticity::ACES);
    /// P3 with the white of film projection (\[RP431-2\]).
    pub const DCI_P3: Self = Self::DISPLAY_P3.with_white(Chromaticity::DCI);
    /// Adobe RGB (1998) (\[AdobeRGB1998\]).
    pub const ADOBE_RGB: Self = Self::new([(0.64, 0.33), (0.21, 0.71), (0.15, 0.06)], Chromaticity::D65);
    /// ProPhoto RGB, which is ROMM RGB, with its white D50 (\[ISO22028-2\]).
    pub const PROPHOTO: Self = Self::new([(0.7347, 0.2653), (0.1596, 0.8404), (0.0366, 0.0001)], Chromaticity::D50);
    /// CIE 1931 XYZ as if it were red, green and blue, about equal energy.
    pub const XYZ: Self = Self::new([(1.0, 0.0), (0.0, 1.0), (0.0, 0.0)], Chromaticity::new(1.0 / 3.0, 1.0 / 3.0));
    /// ARRI Wide Gamut 4, the primaries of LogC4 (\[ArriLogC4\]).
    pub const ARRI_WIDE_GAMUT_4: Self =
        Self::new([(0.7347, 0.2653), (0.1424, 0.8576), (0.0991, -0.0308)], Chromaticity::D65);
    /// ARRI Wide Gamut 3, the primaries of LogC3 (\[ArriLogC3\]).
    pub const ARRI_WIDE_GAMUT_3: Self =
        Self::new([(0.684, 0.313), (0.221, 0.848), (0.0861, -0.102)], Chromaticity::D65);
    /// Panasonic V-Gamut, the primaries of V-Log (\[PanasonicVLog\]).
    pub const V_GAMUT: Self = Self::new([(0.730, 0.280), (0.165, 0.840), (0.100, -0.030)], Chromaticity::D65);
    /// Canon Cinema Gamut, the primaries of Canon Log 2 and 3 (\[CanonLog\]).
    pub const CINEMA_GAMUT: Self = Self::new([(0.740, 0.270), (0.170, 1.140), (0.080, -0.100)], Chromaticity::D65);
    /// REDWideGamutRGB, the primaries of Log3G10 (\[RedLog3G10\]).
    pub const RED_WIDE_GAMUT: Self =
        Self::new([(0.780_308, 0.304_253), (0.121_595, 1.493_994), (0.095_612, -0.084_589)], Chromaticity::D65);
    /// DJI D-Gamut, the primaries of D-Log (\[DjiDLog\]).
    pub const D_GAMUT: Self = Self::new([(0.71, 0.31), (0.21, 0.88), (0.09, -0.08)], Chromaticity::D65);
    /// Sony S-Gamut3, wider than the Cine variant (\[SonySLog3\]).
    pub const S_GAMUT3: Self = Self::new([(0.730, 0.280), (0.140, 0.855), (0.100, -0.050)], Chromaticity::D65);
    /// Sony S-Gamut3.Cine, the one that usually goes with S-Log3 (\[SonySLog3\]).
    pub const S_GAMUT3_CINE: Self = Self::new([(0.766, 0.275), (0.225, 0.800), (0.089, -0.087)], Chromaticity::D65);
    /// DaVinci Wide Gamut, the working space of DaVinci Intermediate (\[DaVinciIntermediate\]).
    pub const DAVINCI_WIDE_GAMUT: Self =
        Self::new([(0.8000, 0.3130), (0.1682, 0.9877), (0.0790, -0.1155)], Chromaticity::D65);

    /// A space from the xy of its primaries and its white.
    #[must_use]
    pub const fn new(primaries: [(f64, f64); 3], white: Chromaticity) -> Self {
        let [(rx, ry), (gx, gy), (bx, by)] = primaries;
        let primaries = [Chromaticity::new(rx, ry), Chromaticity::new(gx, gy), Chromaticity::new(bx, by)];
        Self { primaries, white }
    }

    /// The same primaries about another white.
    #[must_use]
    pub const fn with_white(self, white: Chromaticity) -> Self {
        Self { white, ..self }
    }

    /// Linear RGB to XYZ, Y of (1, 1, 1) being 1.
    ///
    /// # Errors
    /// If the primaries do not span a triangle or a number is not finite.
    pub fn to_xyz(&self) -> Result<Matrix3<f64>, Error> {
        let refuse = |what, c: Chromaticity| Error::from(ErrorKind::Chromaticity { what, x: c.x, y: c.y });
        if !(self.white.x.is_finite() && self.white.y.is_finite() && self.white.y > 0.0) {
            return Err(refuse("white of an RGB space", self.white));
        }
        // Columns x, y, z: a primary may have y = 0 or below (AP0 blue), so they are not divided by it.
        let columns = self.primaries.map(|c| Vector3::new(c.x, c.y, 1.0 - c.x - c.y));
        let primaries = Matrix3::from_columns(&columns);
        let inverse = primaries.try_inverse().filter(|m| m.iter().all(|v| v.is_finite() && v.abs() < 1e6));
        let inverse = inverse.ok_or_else(|| refuse("primaries of an RGB space", self.primaries[0]))?;
        Ok(primaries * Matrix3::from_diagonal(&(inverse * self.white.xyz())))
    }

    /// XYZ to linear RGB: the inverse of [`RgbSpace::to_xyz`].
    ///
    /// # Errors
    /// The same as those of [`RgbSpace::to_xyz`].
    pub fn from_xyz(&self) -> Result<Matrix3<f64>, Error> {
        let refuse = || ErrorKind::Chromaticity { what: "RGB space", x: self.white.x, y: self.white.y };
        self.to_xyz()?.try_inverse().ok_or_else(|| refuse().into())
    }

    /// Linear RGB of this space to linear RGB of `target` with both about `white`: (1, 1, 1) stays (1, 1, 1), whatever
    /// the whites of the two. Between the same primaries it is the identity to the last bit.
    ///
    /// # Errors
    /// The same as those of [`RgbSpace::to_xyz`].
    pub fn to_about(&self, target: &Self, white: Chromaticity) -> Result<Matrix3<f64>, Error> {
        let (to_xyz, from_xyz) = (self.with_white(white).to_xyz()?, target.with_white(white).from_xyz()?);
        // Not what rounding makes of it: 1e-17 of a channel at 1e30 drowns the other two.
        Ok(if self.primaries == target.primaries { Matrix3::identity() } else { from_xyz * to_xyz })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const ALL: [RgbSpace; 14] = [
        RgbSpace::SRGB,
        RgbSpace::DISPLAY_P3,
        RgbSpace::REC2020,
        RgbSpace::ACESCG,
        RgbSpace::ACES2065_1,
        RgbSpace::ARRI_WIDE_GAMUT_4,
        RgbSpace::S_GAMUT3,
        RgbSpace::S_GAMUT3_CINE,
        RgbSpace::DAVINCI_WIDE_GAMUT,
        RgbSpace::ARRI_WIDE_GAMUT_3,
        RgbSpace::V_GAMUT,
        RgbSpace::CINEMA_GAMUT,
        RgbSpace::RED_WIDE_GAMUT,
        RgbSpace::D_GAMUT,
    ];

    #[test]
    fn the_same_primaries_need_no_conversion() {
        for space in ALL {
            assert_eq!(space.to_about(&space, Chromaticity::black_body_6500_k()).unwrap(), Matrix3::identity());
        }
        assert!(RgbSpace::SRGB.to_about(&RgbSpace::SRGB, Chromaticity::new(0.3, f64::NAN)).is_err());
    }

    #[test]
    fn ones_are_the_white() {
        for space in ALL {
            let c = Chromaticity::of(&(space.to_xyz().unwrap() * Vector3::repeat(1.0)));
            assert_relative_eq!(c.x, space.white.x, epsilon = 1e-12);
            assert_relative_eq!(c.y, space.white.y, epsilon = 1e-12);
        }
    }

    #[test]
    fn there_and_back_is_identity() {
        for a in ALL {
            for b in ALL {
                let round = b.to_about(&a, Chromaticity::D65).unwrap() * a.to_about(&b, Chromaticity::D65).unwrap();
                assert_relative_eq!(round, Matrix3::identity(), epsilon = 1e-12);
                let white = a.to_about(&b, Chromaticity::D65).unwrap() * Vector3::repeat(1.0);
                assert_relative_eq!(white, Vector3::repeat(1.0), epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn srgb_matrix_is_the_published_one() {
        // [IEC61966-2-1], four digits as printed.
        let published = Matrix3::new(0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505);
        assert_relative_eq!(RgbSpace::SRGB.to_xyz().unwrap(), published, epsilon = 5.1e-5);
    }

    #[test]
    #[rustfmt::skip]
    fn camera_matrices_are_the_published_ones() {
        let published = [
            // [ArriLogC4]; the other three as their makers print them.
            (RgbSpace::ARRI_WIDE_GAMUT_4, [
                0.704858320407, 0.129760295170, 0.115837311473,
                0.254524176404, 0.781477732712, -0.036001909116,
                0.0, 0.0, 1.089057750759,
            ]),
            (RgbSpace::S_GAMUT3, [
                0.7064827132, 0.1288010498, 0.1151721641,
                0.2709796708, 0.7866064112, -0.0575860820,
                -0.0096778454, 0.0046000375, 1.0941355587,
            ]),
            (RgbSpace::S_GAMUT3_CINE, [
                0.5990839208, 0.2489255161, 0.1024464902,
                0.2150758201, 0.8850685017, -0.1001443219,
                -0.0320658495, -0.0276583907, 1.1487819910,
            ]),
            (RgbSpace::DAVINCI_WIDE_GAMUT, [
                0.70062239, 0.14877482, 0.10105872,
                0.27411851, 0.87363190, -0.14775041,
                -0.09896291, -0.13789533, 1.32591599,
            ]),
        ];
        for (space, rows) in published {
            assert_relative_eq!(space.to_xyz().unwrap(), Matrix3::from_row_slice(&rows), epsilon = 6e-9);
        }
        // [ArriLogC3], [PanasonicVLog], [RedLog3G10], [DjiDLog] to the digits that they print.
        let rounded = [
            (RgbSpace::ARRI_WIDE_GAMUT_3, 5.1e-7, [
                0.638008, 0.214704, 0.097744,
                0.291954, 0.823841, -0.115795,
                0.002798, -0.067034, 1.153294,
            ]),
            (RgbSpace::V_GAMUT, 5.1e-7, [
                0.679644, 0.152211, 0.118600,
                0.260686, 0.774894, -0.035580,
                -0.009310, -0.004612, 1.102980,
            ]),
            (RgbSpace::RED_WIDE_GAMUT, 5.1e-7, [
                0.735275, 0.068609, 0.146571,
                0.286694, 0.842979, -0.129673,
                -0.079681, -0.347343, 1.516082,
            ]),
            // Its last digits are moved so that rows sum to a white of four digits.
            (RgbSpace::D_GAMUT, 2e-4, [
                0.6482, 0.1940, 0.1082,
                0.2830, 0.8132, -0.0962,
                -0.0183, -0.0832, 1.1903,
            ]),
        ];
        for (space, digits, rows) in rounded {
            assert_relative_eq!(space.to_xyz().unwrap(), Matrix3::from_row_slice(&rows), epsilon = digits);
        }
    }

    #[test]
    fn degenerate_primaries_are_refused() {
        let line = RgbSpace::new([(0.3, 0.3), (0.4, 0.4), (0.5, 0.5)], Chromaticity::D65);
        assert!(line.to_xyz().is_err());
        assert!(RgbSpace::SRGB.with_white(Chromaticity::new(0.3, 0.0)).to_xyz().is_err());
        assert!(RgbSpace::new([(f64::NAN, 0.3), (0.3, 0.6), (0.1, 0.1)], Chromaticity::D65).to_xyz().is_err());
    }
}
