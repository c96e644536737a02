//! Codings that a table takes instead of scene-linear light: those of cameras, displays and engines.

use nalgebra::Matrix3;
use onelight_lut::Lut3d;
use onelight_spectra::{Chromaticity, RgbSpace, SceneCurve};

use crate::cineon;
use crate::error::Error;
use crate::look::Look;
use crate::process::ColourSpaces;
use crate::scene::{MID_GREY, multiply};
use crate::word::Word as _;

/// A coding of light that a table takes as its coordinates.
///
/// ```
/// use onelight::Process;
/// use onelight::baked::{BakedForm, Recipe, ShaperChoice};
/// let recipe = Recipe { shaper: ShaperChoice::Acescct, ..Recipe::cube(9) };
/// let baked = Process::default().look()?.baked(&recipe)?;
/// let BakedForm::Coded { coordinate, .. } = baked.form() else { return Ok(()) };
/// assert!((coordinate.encode([0.18; 3])[0] - 0.4136).abs() < 1e-4);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Coordinate {
    word: &'static str,
    name: &'static str,
    primaries: &'static str,
    curve: CodingCurve,
    /// From the look's input primaries to those of the coding, and back.
    there: Matrix3<f64>,
    back: Matrix3<f64>,
}

#[derive(Debug, Clone, Copy)]
enum CodingCurve {
    Scene(SceneCurve),
    /// log2 of light over mid grey, between two stops.
    Stops(f64, f64),
    /// Codes of a scanned negative.
    Cineon,
}

/// The range of Bevy's tone-mapping tables, in stops about mid grey.
const BEVY_STOPS: (f64, f64) = (-11.0, 12.0);

impl Coordinate {
    /// A published coding with its own primaries; `word` is what a recipe calls it.
    pub(super) fn of_curve(word: &'static str, curve: SceneCurve, spaces: &ColourSpaces) -> Result<Self, Error> {
        Self::new([word, curve.name(), curve.space_name()], CodingCurve::Scene(curve), &curve.space(), spaces)
    }

    /// The coordinate of Bevy's tone-mapping tables, in the look's input primaries.
    pub(super) fn bevy(spaces: &ColourSpaces) -> Result<Self, Error> {
        Self::new(
            ["bevy", "log2(x / 0.18) from -11 to +12", spaces.input_space.word()],
            CodingCurve::Stops(BEVY_STOPS.0, BEVY_STOPS.1),
            &spaces.input_space.space(),
            spaces,
        )
    }

    /// Codes of a scanned negative, which have no primaries.
    pub(super) fn cineon(spaces: &ColourSpaces) -> Result<Self, Error> {
        let primaries = "printing density, no";
        Self::new(["cineon", "Cineon", primaries], CodingCurve::Cineon, &spaces.input_space.space(), spaces)
    }

    /// Whether coordinates are codes of a scanned negative and not of a scene's light.
    pub(super) fn is_scan(&self) -> bool {
        matches!(self.curve, CodingCurve::Cineon)
    }

    fn new(
        [word, name, primaries]: [&'static str; 3],
        curve: CodingCurve,
        space: &RgbSpace,
        spaces: &ColourSpaces,
    ) -> Result<Self, Error> {
        let (input, white) = (spaces.input_space.space(), Chromaticity::black_body_6500_k());
        Ok(Self {
            word,
            name,
            primaries,
            curve,
            there: input.to_about(space, white)?,
            back: space.to_about(&input, white)?,
        })
    }

    /// Scene-linear RGB of the look's input space at coordinates.
    fn decode(&self, coordinates: [f64; 3]) -> [f64; 3] {
        let linear = coordinates.map(|v| match self.curve {
            CodingCurve::Scene(curve) => curve.decode(v),
            CodingCurve::Stops(low, high) => MID_GREY * (low + v * (high - low)).exp2(),
            CodingCurve::Cineon => cineon::light(v),
        });
        multiply(&self.back, linear)
    }

    /// What a recipe calls the coding, such as `acescct`: the middle of file names.
    #[must_use]
    pub fn word(&self) -> &'static str {
        self.word
    }

    /// The primaries that belong to the coding, for people, such as `AP1`.
    #[must_use]
    pub fn primaries(&self) -> &'static str {
        self.primaries
    }

    /// The coding's name for people, such as `ACEScct`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Coordinates of scene-linear RGB of the look's input space; not clamped, finite for finite light.
    #[must_use]
    pub fn encode(&self, linear: [f64; 3]) -> [f64; 3] {
        multiply(&self.there, linear).map(|v| match self.curve {
            CodingCurve::Scene(curve) => curve.encode(v),
            CodingCurve::Stops(low, high) => ((v.max(1e-12) / MID_GREY).log2() - low) / (high - low),
            CodingCurve::Cineon => cineon::code(v),
        })
    }

    /// The table of a look in this coding.
    pub(super) fn bake(&self, look: &Look, size: usize) -> Result<Lut3d, Error> {
        look.bake(size, |t| self.decode(t))
    }

    /// What the coding holds of scene-linear RGB of the look's input space: the colour itself, or the nearest coordinates from
    /// 0 to 1, decoded.
    #[must_use]
    pub fn held(&self, linear: [f64; 3]) -> [f64; 3] {
        let held = self.decode(self.encode(linear).map(|v| v.clamp(0.0, 1.0)));
        // A coding that ends, as PQ does, has codes for what it does not hold.
        let most = linear.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let same = linear.iter().zip(held).all(|(v, held)| (v - held).abs() <= 1e-9 * most);
        if same { linear } else { held }
    }

    /// The code of an 18 % grey.
    #[must_use]
    pub fn grey(&self) -> f64 {
        self.encode([MID_GREY; 3])[0]
    }

    /// The brightest grey that the coding holds.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.decode([1.0; 3]).into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codings_go_there_and_back() {
        let spaces = ColourSpaces { input_space: crate::WorkingSpace::AcesCg, ..Default::default() };
        let mut all: Vec<Coordinate> =
            SceneCurve::ALL.iter().map(|curve| Coordinate::of_curve("", *curve, &spaces).unwrap()).collect();
        all.push(Coordinate::bevy(&spaces).unwrap());
        all.push(Coordinate::cineon(&spaces).unwrap());
        for coordinate in all {
            for rgb in [[0.18; 3], [0.5, 0.2, 0.1], [0.02, 0.05, 0.04]] {
                let back = coordinate.decode(coordinate.encode(rgb));
                for c in 0..3 {
                    assert!((back[c] - rgb[c]).abs() < 1e-9, "{}: {back:?} for {rgb:?}", coordinate.name);
                }
                assert_eq!(coordinate.held(rgb), rgb, "{}", coordinate.name);
            }
            for beyond in [[1e5; 3], [-0.5, 1e6, 0.2]] {
                let held = coordinate.held(beyond);
                // In light, as codes that begin with a root are infinitely steep at 0.
                let again = coordinate.decode(coordinate.encode(held).map(|v| v.clamp(0.0, 1.0)));
                for c in 0..3 {
                    let slack = 1e-9 * held[c].abs().max(1.0);
                    assert!((again[c] - held[c]).abs() < slack, "{}: {held:?} {again:?}", coordinate.name);
                }
            }
        }
    }
}
