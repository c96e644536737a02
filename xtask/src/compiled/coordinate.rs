//! Codings that a table takes instead of scene-linear light: those of cameras, displays and engines.

use anyhow::Result;
use onelight::lut::Lut3d;
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Chromaticity, MID_GREY, RgbSpace, SceneCurve};
use onelight::{Look, Process};

/// What the coordinates of a table stand for.
#[derive(Debug, Clone)]
pub(crate) struct Coordinate {
    pub(crate) name: &'static str,
    curve: Curve,
    /// From the look's input primaries to those of the coding, and back.
    there: Matrix3<f64>,
    back: Matrix3<f64>,
}

#[derive(Debug, Clone, Copy)]
enum Curve {
    Scene(SceneCurve),
    /// log2 of light over mid grey, between two stops.
    Stops(f64, f64),
}

/// The range of Bevy's tone-mapping tables, in stops about mid grey.
const BEVY_STOPS: (f64, f64) = (-11.0, 12.0);

impl Coordinate {
    /// A published coding, with its own primaries.
    pub(crate) fn of_curve(curve: SceneCurve, process: &Process) -> Result<Self> {
        Self::new(curve.name(), Curve::Scene(curve), &curve.space(), process)
    }

    /// The coordinate of Bevy's tone-mapping tables, in the look's input primaries.
    pub(crate) fn bevy(process: &Process) -> Result<Self> {
        Self::new(
            "log2(x / 0.18) from -11 to +12",
            Curve::Stops(BEVY_STOPS.0, BEVY_STOPS.1),
            &process.input_space.space(),
            process,
        )
    }

    fn new(name: &'static str, curve: Curve, space: &RgbSpace, process: &Process) -> Result<Self> {
        let (input, white) = (process.input_space.space(), Chromaticity::black_body_6500_k());
        Ok(Self { name, curve, there: input.to_about(space, white)?, back: space.to_about(&input, white)? })
    }

    /// Scene-linear RGB of the look's input space at coordinates.
    fn decode(&self, coordinates: [f64; 3]) -> [f64; 3] {
        let linear = coordinates.map(|v| match self.curve {
            Curve::Scene(curve) => curve.decode(v),
            Curve::Stops(low, high) => MID_GREY * (low + v * (high - low)).exp2(),
        });
        (self.back * Vector3::from(linear)).into()
    }

    /// Coordinates of scene-linear RGB of the look's input space; not clamped, finite for finite light.
    pub(crate) fn encode(&self, linear: [f64; 3]) -> [f64; 3] {
        <[f64; 3]>::from(self.there * Vector3::from(linear)).map(|v| match self.curve {
            Curve::Scene(curve) => curve.encode(v),
            Curve::Stops(low, high) => ((v.max(1e-12) / MID_GREY).log2() - low) / (high - low),
        })
    }

    /// The table of a film in this coding.
    pub(crate) fn bake(&self, film: &Look, size: usize) -> Result<Lut3d> {
        Ok(film.bake(size, |t| self.decode(t))?)
    }

    /// The brightest grey that the coding holds.
    pub(crate) fn max(&self) -> f64 {
        self.decode([1.0; 3]).into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codings_go_there_and_back() {
        let process = Process { input_space: onelight::WorkingSpace::AcesCg, ..Process::default() };
        let mut all: Vec<Coordinate> =
            SceneCurve::ALL.iter().map(|curve| Coordinate::of_curve(*curve, &process).unwrap()).collect();
        all.push(Coordinate::bevy(&process).unwrap());
        for coordinate in all {
            for rgb in [[0.18; 3], [0.5, 0.2, 0.1], [0.02, 0.05, 0.04]] {
                let back = coordinate.decode(coordinate.encode(rgb));
                for c in 0..3 {
                    assert!((back[c] - rgb[c]).abs() < 1e-9, "{}: {back:?} for {rgb:?}", coordinate.name);
                }
            }
        }
    }
}
