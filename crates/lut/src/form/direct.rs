use crate::coding::PowerCoding;
use crate::error::{Error, ErrorKind};
use crate::exponential_sum::ExponentialSum;
use crate::form::develop::{Develop, DevelopCurves};
use crate::form::expose::Expose;
use crate::kernel::block::{Block, BlockMap};
use crate::kernel::coding::code;
use crate::kernel::curves::Curves;
use crate::kernel::expose::expose;
use crate::kernel::steps::{BlockSteps, widened};
use crate::kernel::sum::{Exponentials, log2_of_light};
use crate::lut1d::Lut1d;
use crate::number::Number;
use crate::scene_light::log2_above_floor;
use fearless_simd::Level;

/// The direct form: no 3D table. Sums of a few exponentials stand for the light through each film.
///
/// 1. [`Expose`]: scene light to log2 exposure
/// 2. [`Develop`]: a curve on each channel, and what channels do to each other
/// 3. where there is a `print`: its sum of exponentials, log2 (of at least [`LOG_FLOOR`](crate::LOG_FLOOR)), a second curve on each channel
/// 4. the `projection`, a sum of exponentials that gives linear RGB
/// 5. `coding`
///
/// ```
/// use onelight_lut::{Develop, DirectForm, DirectParts, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding};
/// // A reversal film whose dye falls by half a unit for each stop, seen through three narrow filters.
/// let unit = |c: usize, v: f32| std::array::from_fn(|k| if k == c { v } else { 0.0 });
/// let terms = (0..3).map(|c| ExponentialTerm { rate: unit(c, 2.0), weight: unit(c, 1.0) }).collect();
/// let form = DirectForm::new(DirectParts {
///     expose: Expose::by(IDENTITY),
///     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| -0.5 * stops)? },
///     print: None,
///     projection: ExponentialSum::new(terms)?,
///     coding: PowerCoding::LINEAR,
/// })?;
/// assert!((form.apply([0.25, 0.18, 1.0])[0] - 0.25).abs() < 1e-5);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DirectForm {
    parts: DirectParts,
    develop: DevelopCurves,
    print: Option<PrintSteps>,
    projection: Exponentials,
}

/// A [`DirectPrint`] as the loops compute it.
#[derive(Clone, Debug, PartialEq)]
struct PrintSteps {
    exposure: Exponentials,
    curves: Curves,
}

/// What a [`DirectForm`] is made of, in the order in which it is applied.
///
/// ```
/// # use onelight_lut::{Develop, DirectForm, DirectParts, DirectPrint, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding};
/// # let unit = |c: usize, v: f32| std::array::from_fn(|k| if k == c { v } else { 0.0 });
/// # let sum = |rate: f32| ExponentialSum::new((0..3).map(|c| ExponentialTerm { rate: unit(c, rate), weight: unit(c, 1.0) }).collect());
/// let film = DirectParts {
///     expose: Expose::by(IDENTITY),
///     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| -0.5 * stops)? },
///     print: None,
///     projection: sum(2.0)?,
///     coding: PowerCoding::LINEAR,
/// };
/// // A stop brighter: the matrix before the film doubled.
/// let brighter = DirectParts { expose: Expose::by(IDENTITY.map(|row| row.map(|v| 2.0 * v))), ..film.clone() };
/// let [film, brighter] = [DirectForm::new(film)?, DirectForm::new(brighter)?];
/// assert!((brighter.apply([0.1; 3])[0] - film.apply([0.2; 3])[0]).abs() < 1e-6);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DirectParts {
    /// From scene light to log2 exposure.
    pub expose: Expose,
    /// The first film.
    pub develop: Develop,
    /// A second film behind the first.
    pub print: Option<DirectPrint>,
    /// From the last film's values to linear RGB.
    pub projection: ExponentialSum,
    /// From linear to coded RGB.
    pub coding: PowerCoding,
}

/// What a second film adds: its exposure, and its curves over log2 of it.
///
/// ```
/// # use onelight_lut::{Develop, DirectForm, DirectParts, DirectPrint, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding};
/// # let unit = |c: usize, v: f32| std::array::from_fn(|k| if k == c { v } else { 0.0 });
/// # let sum = |rate: f32| ExponentialSum::new((0..3).map(|c| ExponentialTerm { rate: unit(c, rate), weight: unit(c, 1.0) }).collect());
/// // A negative's dye grows with light, and the print behind it turns that round.
/// let negative = Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| 0.5 * (stops + 10.0))? };
/// let print = DirectPrint { exposure: sum(2.0)?, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| 0.5 * (stops + 10.0))? };
/// let form = DirectForm::new(DirectParts {
///     expose: Expose::by(IDENTITY),
///     develop: negative,
///     print: Some(print),
///     projection: sum(2.0)?,
///     coding: PowerCoding::LINEAR,
/// })?;
/// assert!(form.apply([0.5; 3])[0] > form.apply([0.1; 3])[0]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DirectPrint {
    /// From the first curves' values to the exposure of each channel.
    pub exposure: ExponentialSum,
    /// A curve over log2 exposure for each channel.
    pub curves: Lut1d,
}

impl DirectForm {
    /// A form of these parts, checked so that applying it cannot fail.
    ///
    /// # Errors
    /// If a matrix holds a number that is not finite.
    pub fn new(parts: DirectParts) -> Result<Self, Error> {
        parts.expose.check()?;
        parts.develop.check()?;
        let develop = DevelopCurves::new(&parts.develop);
        let first = widened(parts.develop.curves.ends());
        let print = parts.print.as_ref().map(|DirectPrint { exposure, curves }| PrintSteps {
            exposure: Exponentials::new(exposure, first),
            curves: Curves::new(curves),
        });
        let last = parts.print.as_ref().map_or(first, |print| print.curves.ends());
        let projection = Exponentials::new(&parts.projection, last);
        Ok(Self { develop, print, projection, parts })
    }

    /// What it is made of.
    pub fn parts(&self) -> &DirectParts {
        &self.parts
    }

    /// The same with another first step, such as [`Expose::brighter`] or [`Expose::after`] of the one it has: no copy and no fit, so
    /// that an exposure or a white balance can follow a hand.
    ///
    /// ```
    /// # use onelight_lut::{Develop, DirectForm, DirectParts, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding};
    /// # let parts = DirectParts {
    /// #     expose: Expose::by(IDENTITY),
    /// #     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| -0.5 * stops)? },
    /// #     print: None,
    /// #     projection: ExponentialSum::new(vec![ExponentialTerm { rate: [1.0; 3], weight: [1.0; 3] }])?,
    /// #     coding: PowerCoding::LINEAR,
    /// # };
    /// let form = DirectForm::new(parts)?;
    /// let expose = form.parts().expose;
    /// let darker = form.clone().with_expose(expose.brighter(-1.0))?;
    /// assert!((darker.apply([0.5; 3])[0] - form.apply([0.25; 3])[0]).abs() < 1e-6);
    /// # Ok::<(), onelight_lut::Error>(())
    /// ```
    ///
    /// # Errors
    /// If a matrix holds a number that is not finite.
    pub fn with_expose(mut self, expose: Expose) -> Result<Self, Error> {
        expose.check()?;
        self.parts.expose = expose;
        Ok(self)
    }

    /// The same with each channel's exposure of the print multiplied by a number above 0: as if its light were so much brighter. A
    /// form without a print stays as it is.
    ///
    /// # Errors
    /// If a factor is no number above 0, or a weight of the sum is not finite any more.
    pub fn with_print_exposed(mut self, factors: [f32; 3]) -> Result<Self, Error> {
        if let Some(&found) = factors.iter().find(|v| !(**v > 0.0 && v.is_finite())) {
            let (what, found) = ("factor of a print's exposure", f64::from(found));
            return Err(ErrorKind::Parameter { what, found, expected: "a number above 0" }.into());
        }
        if let (Some(print), Some(steps)) = (&mut self.parts.print, &mut self.print) {
            print.exposure = print.exposure.scaled(factors)?;
            steps.exposure = Exponentials::new(&print.exposure, self.develop.held());
        }
        Ok(self)
    }

    /// The output for one scene-linear colour.
    #[inline]
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.apply_in(linear)
    }

    /// The one definition of [`DirectForm::apply`], for float32 and float64.
    #[inline]
    pub(crate) fn apply_in<N: Number>(&self, linear: [N; 3]) -> [N; 3] {
        let DirectParts { expose, develop, print, projection, coding } = &self.parts;
        let first = develop.apply_in(expose.log2_in(linear));
        let shown = match print {
            Some(print) => print.curves.apply_in(print.exposure.apply_in(first).map(log2_above_floor)),
            None => first,
        };
        projection.apply_in(shown).map(|v| coding.encode_in(v))
    }
}

impl BlockMap for DirectForm {
    fn map_block(&self, level: Level, block: &mut Block, count: usize) {
        self.expose_block(level, block, count);
        self.develop_block(level, block, count);
        self.finish_block(level, block, count);
    }
}

impl BlockSteps for DirectForm {
    fn held(&self) -> [[f32; 2]; 3] {
        self.develop.held()
    }

    fn expose_block(&self, level: Level, block: &mut Block, count: usize) {
        expose(level, &self.parts.expose, block, count);
    }

    fn develop_block(&self, level: Level, block: &mut Block, count: usize) {
        self.develop.apply(level, block, count);
    }

    fn finish_block(&self, level: Level, block: &mut Block, count: usize) {
        if let Some(PrintSteps { exposure, curves }) = &self.print {
            exposure.apply(level, block, count);
            log2_of_light(level, block, count);
            curves.apply(level, block, count);
        }
        self.projection.apply(level, block, count);
        code(level, &self.parts.coding.numbers(), block, count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;
    use crate::exponential_sum::ExponentialTerm;
    use crate::scene_light::IDENTITY;

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
            expose: Expose::by(IDENTITY),
            develop: Develop { coupling: None, curves: falling() },
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
    fn moved_forms_are_forms_of_moved_parts() {
        let print = Some(DirectPrint { exposure: separate(2.0), curves: falling() });
        let direct = DirectForm::new(DirectParts { print: print.clone(), ..parts() }).unwrap();
        let moved = direct.clone().with_print_exposed([2.0, 0.5, 1.0]).unwrap();
        let exposure = print.as_ref().unwrap().exposure.scaled([2.0, 0.5, 1.0]).unwrap();
        let print = Some(DirectPrint { exposure, curves: falling() });
        assert_eq!(moved, DirectForm::new(DirectParts { print, ..parts() }).unwrap());
        // Twice the light is one stop of the print's curve, half a unit of dye: two halvings a unit make that a factor of two.
        let (before, after) = (direct.apply([64.0; 3]), moved.apply([64.0; 3]));
        for (factor, (before, after)) in [2.0, 0.5, 1.0].into_iter().zip(before.into_iter().zip(after)) {
            assert!((after / before / factor - 1.0).abs() < 1e-5, "{before} {after}");
        }
        assert_eq!(moved.with_print_exposed([0.5, 2.0, 1.0]).unwrap(), direct);
        // Exponents beyond those of normal numbers only where grain takes dye off the ends of its curve.
        let print = Some(DirectPrint { exposure: separate(8.0), curves: falling() });
        let steep = DirectForm::new(DirectParts { print, ..parts() }).unwrap();
        assert_eq!(steep.clone().with_print_exposed([1.0; 3]).unwrap(), steep);
        assert!(direct.clone().with_print_exposed([0.0, 1.0, 1.0]).is_err());
        assert!(direct.clone().with_expose(Expose::by([[f32::NAN; 3]; 3])).is_err());
        let expose = Expose::by(IDENTITY).brighter(0.7);
        assert_eq!(
            direct.clone().with_expose(expose).unwrap(),
            DirectForm::new(DirectParts { expose, ..direct.parts().clone() }).unwrap()
        );
    }

    #[test]
    fn any_input_has_a_finite_result() {
        let direct = DirectForm::new(parts()).unwrap();
        for v in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e-40, f32::MAX] {
            assert!(direct.apply([v, 1.0, v]).iter().all(|v| v.is_finite()), "{v}");
        }
    }
}
