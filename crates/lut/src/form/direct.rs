use glam::{Mat3, Vec3};

use super::structured::{INPUT_MAX, LOG_FLOOR, Rows, check, matrix};
use crate::coding::PowerCoding;
use crate::error::{Error, Kind};
use crate::kernel::curves::Curves;
use crate::kernel::expose::expose;
use crate::kernel::log2_exp2::{exp2, log2};
use crate::kernel::sum::{coded_sum, log2_of_sum};
use crate::kernel::{Block, BlockMap, Level};
use crate::lut1d::Lut1d;
use crate::pixels::map_colours;

/// The direct form: no 3D table. Sums of a few exponentials stand for the light through each film.
///
/// 1. `input` matrix, clamped to [0, [`INPUT_MAX`]]
/// 2. `exposure` matrix, log2 (of at least [`LOG_FLOOR`]), a curve on each channel
/// 3. where there is a `print`: its sum of exponentials, log2 (of at least [`LOG_FLOOR`]), a second curve on each channel
/// 4. the `projection`, a sum of exponentials that gives linear RGB
/// 5. `coding`
///
/// NaN counts as 0 and infinities as ±[`INPUT_MAX`] before the first matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectForm {
    parts: DirectParts,
    input: Mat3,
    exposure: Mat3,
    curves: Curves,
    print_curves: Option<Curves>,
}

/// What a [`DirectForm`] is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectParts {
    /// From the picture's primaries to those of the exposure matrix.
    pub input: Rows,
    /// To the exposure of each channel.
    pub exposure: Rows,
    /// Curves over log2 exposure.
    pub curves: Lut1d,
    /// A second film behind the first.
    pub print: Option<DirectPrint>,
    /// To linear RGB.
    pub projection: ExponentialSum,
    /// From linear to coded RGB.
    pub coding: PowerCoding,
}

/// What a second film adds: its exposure, and its curves over log2 of it.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectPrint {
    /// From the first curves' values to the exposure of each channel.
    pub exposure: ExponentialSum,
    /// Curves over log2 exposure.
    pub curves: Lut1d,
}

/// Three sums of exponentials over three variables: `out[j] = sum over terms of weight[j] 2^-(rate . x)`.
#[derive(Clone, Debug, PartialEq)]
pub struct ExponentialSum {
    terms: Vec<ExponentialTerm>,
}

/// One exponential of an [`ExponentialSum`]: for a film, its dyes' densities at one wavelength and the light found there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialTerm {
    /// Halvings for each unit of the three variables.
    pub rate: [f32; 3],
    /// What it adds to each sum where the variables are 0; may be negative.
    pub weight: [f32; 3],
}

impl ExponentialSum {
    /// The most terms: the visible wavelengths and more, by 1 nm.
    pub const MAX_TERMS: usize = 1024;

    /// A sum of these terms.
    ///
    /// # Errors
    /// If there are none or more than [`ExponentialSum::MAX_TERMS`], or a number is not finite.
    pub fn new(terms: Vec<ExponentialTerm>) -> Result<Self, Error> {
        if terms.is_empty() || terms.len() > Self::MAX_TERMS {
            let (found, max) = (terms.len(), Self::MAX_TERMS);
            return Err(Kind::Size { what: "sum of exponentials", found, min: 1, max }.into());
        }
        for term in &terms {
            check("term of a sum of exponentials", &[term.rate, term.weight, [0.0; 3]])?;
        }
        Ok(Self { terms })
    }

    /// The terms.
    pub fn terms(&self) -> &[ExponentialTerm] {
        &self.terms
    }

    /// The three sums.
    #[inline]
    pub fn apply(&self, x: [f32; 3]) -> [f32; 3] {
        let x = Vec3::from(x);
        let add =
            |sum: Vec3, term: &ExponentialTerm| sum + Vec3::from(term.weight) * exp2(-Vec3::from(term.rate).dot(x));
        self.terms.iter().fold(Vec3::ZERO, add).to_array()
    }
}

impl DirectForm {
    /// Puts the parts together.
    ///
    /// # Errors
    /// If a matrix holds a number that is not finite.
    pub fn new(parts: DirectParts) -> Result<Self, Error> {
        check("input matrix", &parts.input)?;
        check("exposure matrix", &parts.exposure)?;
        let curves = Curves::new(&parts.curves);
        let print_curves = parts.print.as_ref().map(|print| Curves::new(&print.curves));
        Ok(Self { input: matrix(&parts.input), exposure: matrix(&parts.exposure), curves, print_curves, parts })
    }

    /// What it is made of.
    pub fn parts(&self) -> &DirectParts {
        &self.parts
    }

    /// The output for one scene-linear colour.
    #[inline]
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        let finite = linear.map(|v| if v.is_nan() { 0.0 } else { v.clamp(-INPUT_MAX, INPUT_MAX) });
        let scene = (self.input * Vec3::from(finite)).clamp(Vec3::ZERO, Vec3::splat(INPUT_MAX));
        let log2 = |exposure: [f32; 3]| exposure.map(|e| log2(e.max(LOG_FLOOR)));
        let first = self.parts.curves.apply(log2((self.exposure * scene).to_array()));
        let shown = match &self.parts.print {
            Some(DirectPrint { exposure, curves }) => curves.apply(log2(exposure.apply(first))),
            None => first,
        };
        self.parts.projection.apply(shown).map(|v| self.parts.coding.encode_f32(v))
    }

    /// [`DirectForm::apply`] to every pixel in place, on all threads.
    pub fn apply_to_slice(&self, pixels: &mut [[f32; 3]]) {
        map_colours(self, pixels);
    }
}

impl BlockMap for DirectForm {
    fn map_block(&self, level: Level, block: &mut Block, count: usize) {
        expose(level, &self.parts.input, &self.parts.exposure, block, count);
        self.curves.apply(level, block, count);
        if let (Some(print), Some(curves)) = (&self.parts.print, &self.print_curves) {
            log2_of_sum(level, print.exposure.terms(), block, count);
            curves.apply(level, block, count);
        }
        coded_sum(level, self.parts.projection.terms(), &self.parts.coding.numbers(), block, count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;

    const IDENTITY: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// One exponential for each channel.
    fn separate(rate: f32) -> ExponentialSum {
        let unit = |c: usize, v: f32| std::array::from_fn(|k| if k == c { v } else { 0.0 });
        let terms = (0..3).map(|c| ExponentialTerm { rate: unit(c, rate), weight: unit(c, 1.0) });
        ExponentialSum::new(terms.collect()).unwrap()
    }

    /// log2 from -10 to 10 becomes dye from 10 to 0.
    fn falling() -> Lut1d {
        Lut1d::new(Domain::common(-10.0, 10.0).unwrap(), vec![[10.0; 3], [0.0; 3]]).unwrap()
    }

    fn parts() -> DirectParts {
        DirectParts {
            input: IDENTITY,
            exposure: IDENTITY,
            curves: falling(),
            print: None,
            projection: separate(2.0),
            coding: PowerCoding::LINEAR,
        }
    }

    #[test]
    fn a_straight_film_is_a_power() {
        // Gamma 0.5 on the sheet and two halvings a unit of dye: light passes in proportion.
        let direct = DirectForm::new(parts()).unwrap();
        for (c, v) in [(0, 1.0), (1, 0.125), (2, 700.0)] {
            let mut rgb = [1.0; 3];
            rgb[c] = v;
            assert!((direct.apply(rgb)[c] / (v / 1024.0) - 1.0).abs() < 1e-4, "{v}");
        }
    }

    #[test]
    fn a_print_turns_the_picture_round() {
        let print = Some(DirectPrint { exposure: separate(2.0), curves: falling() });
        // The negative passes v / 2^10; of that the print's dye is 10 - (log2 + 10) / 2.
        let direct = DirectForm::new(DirectParts { print, ..parts() }).unwrap();
        let out = direct.apply([1.0, 4.0, 1.0]);
        assert!((out[1] / out[0] - 4.0).abs() < 1e-3, "{out:?}");
    }

    #[test]
    fn any_input_has_a_finite_result() {
        let direct = DirectForm::new(parts()).unwrap();
        for v in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e-40, f32::MAX] {
            assert!(direct.apply([v, 1.0, v]).iter().all(|v| v.is_finite()), "{v}");
        }
    }

    #[test]
    fn sums_are_checked() {
        assert!(ExponentialSum::new(Vec::new()).is_err());
        let term = |v| ExponentialTerm { rate: [v; 3], weight: [1.0; 3] };
        assert!(ExponentialSum::new(vec![term(1.0); ExponentialSum::MAX_TERMS + 1]).is_err());
        assert!(ExponentialSum::new(vec![term(f32::NAN)]).is_err());
    }
}
