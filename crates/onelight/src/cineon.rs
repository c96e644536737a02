//! The digital negative of film scanners and recorders: 10-bit codes of printing density.

use onelight_spectra::MID_GREY;

/// Printing density above D-min for a code (\[Kennel1995\]).
pub(crate) const DENSITY_PER_CODE: f64 = 0.002;
/// The code of D-min.
pub(crate) const BLACK_CODE: f64 = 95.0;
/// The code of the grey patch of the digital LAD (\[KodakH387\]): a grey card.
pub(crate) const GREY_CODE: f64 = 445.0;
/// The largest code.
pub(crate) const LAST_CODE: f64 = 1023.0;
/// Density for a factor of ten of the light that codes stand for where light is asked for: the usual slope of a camera negative.
const GAMMA: f64 = 0.6;

/// Printing density above D-min of a code from 0 to 1 (full range, 1023 codes); may lie a little below 0.
pub(crate) fn density(coded: f64) -> f64 {
    (coded * LAST_CODE - BLACK_CODE) * DENSITY_PER_CODE
}

/// The light of a code: 0.18 at the LAD's grey, ten times as much for each 0.6 of density. No more than a scale for what takes light.
pub(crate) fn light(coded: f64) -> f64 {
    MID_GREY * 10f64.powf((coded * LAST_CODE - GREY_CODE) * DENSITY_PER_CODE / GAMMA)
}

/// The code of light, held to 0 to 1; light that is not above 0 and NaN are code 0.
pub(crate) fn code(light: f64) -> f64 {
    if light > 0.0 {
        ((GREY_CODE + (light / MID_GREY).log10() * GAMMA / DENSITY_PER_CODE) / LAST_CODE).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The code of a 90 % white as it is usually scanned.
    const WHITE_CODE: f64 = 685.0;

    #[test]
    fn codes_are_densities_and_light() {
        assert!(density(BLACK_CODE / LAST_CODE).abs() < 1e-12);
        assert!((density(GREY_CODE / LAST_CODE) - 0.7).abs() < 1e-12);
        assert!((density(WHITE_CODE / LAST_CODE) - 1.18).abs() < 1e-12);
        // A 90 % white is 2.3 stops over a grey card: 240 codes at this slope are 2.66.
        assert!((light(WHITE_CODE / LAST_CODE) / light(GREY_CODE / LAST_CODE) - 10f64.powf(0.8)).abs() < 1e-9);
        for i in 0..=1023 {
            let coded = f64::from(i) / 1023.0;
            assert!((code(light(coded)) - coded).abs() < 1e-12, "{i}");
        }
        for (hard, expected) in [(f64::NAN, 0.0), (-1.0, 0.0), (0.0, 0.0), (f64::INFINITY, 1.0), (1e30, 1.0)] {
            assert_eq!(code(hard), expected);
        }
    }
}
