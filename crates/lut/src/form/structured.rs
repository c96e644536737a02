use glam::{Mat3, Vec3};

use crate::coding::PowerCoding;
use crate::error::{Error, Kind};
use crate::interpolate::Interpolation;
use crate::kernel::cells::Axes;
use crate::kernel::coding::decode_density;
use crate::kernel::curves::Curves;
use crate::kernel::expose::{affine, expose};
use crate::kernel::log2_exp2::{exp2, log2};
use crate::kernel::lookup::{interleave, lookup, lookup_to};
use crate::kernel::{Block, BlockMap, Level};
use crate::lut1d::Lut1d;
use crate::lut3d::Lut3d;
use crate::pixels::map_colours;

/// The brightest input: more would overflow `f32` in the matrices.
pub const INPUT_MAX: f32 = 1e30;

/// Smallest value whose logarithm is taken: no logarithm of 0.
pub const LOG_FLOOR: f32 = 1e-12;

/// A 3x3 matrix, row by row: `out[i] = sum over k of rows[i][k] in[k]`.
pub type Rows = [[f32; 3]; 3];

/// The structured form: one fetch from a 3D table whose axes are bent and mixed to fit, so that few nodes do and any input
/// is in range.
///
/// 1. `input` matrix, clamped to [0, [`INPUT_MAX`]]
/// 2. `exposure` matrix, log2 (of at least [`LOG_FLOOR`]), a curve on each channel
/// 3. where there is a `mix`: a matrix with offset, and a second curve on each channel
/// 4. the 3D table
/// 5. [`Decode`]
///
/// NaN counts as 0 and infinities as ±[`INPUT_MAX`] before the first matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct StructuredLut {
    parts: StructuredParts,
    input: Mat3,
    exposure: Mat3,
    mix: Option<(Mat3, Vec3)>,
    curves: Curves,
    mix_curves: Option<Curves>,
}

/// What a [`StructuredLut`] is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct StructuredParts {
    /// From the picture's primaries to those of the exposure matrix.
    pub input: Rows,
    /// To the exposure of each channel.
    pub exposure: Rows,
    /// Curves over log2 exposure.
    pub curves: Lut1d,
    /// A second mix of the channels, with its curves.
    pub mix: Option<Mix>,
    /// The table.
    pub table: Lut3d,
    /// How entries of the table become the output.
    pub decode: Decode,
    /// How the table is read.
    pub interpolation: Interpolation,
}

/// A matrix with offset, then a curve on each channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Mix {
    /// The matrix.
    pub matrix: Rows,
    /// Added after the matrix.
    pub offset: [f32; 3],
    /// The curves.
    pub curves: Lut1d,
}

/// How entries of a table become the output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decode {
    /// They are the output.
    Coded,
    /// They are densities: 10^-entry, a matrix to linear RGB, then the output's coding.
    Density {
        /// From the three transmittances to linear RGB.
        matrix: Rows,
        /// From linear to coded RGB.
        coding: PowerCoding,
    },
}

impl StructuredLut {
    /// Puts the parts together.
    ///
    /// # Errors
    /// If a matrix holds a number that is not finite.
    pub fn new(parts: StructuredParts) -> Result<Self, Error> {
        check("input matrix", &parts.input)?;
        check("exposure matrix", &parts.exposure)?;
        if let Some(Mix { matrix, offset, .. }) = &parts.mix {
            check("mix matrix", matrix)?;
            check("mix offset", &[*offset; 3])?;
        }
        if let Decode::Density { matrix, .. } = &parts.decode {
            check("decode matrix", matrix)?;
        }
        let mix = parts.mix.as_ref().map(|mix| (matrix(&mix.matrix), Vec3::from(mix.offset)));
        let curves = Curves::new(&parts.curves);
        let mix_curves = parts.mix.as_ref().map(|mix| Curves::new(&mix.curves));
        Ok(Self { input: matrix(&parts.input), exposure: matrix(&parts.exposure), mix, curves, mix_curves, parts })
    }

    /// What it is made of.
    pub fn parts(&self) -> &StructuredParts {
        &self.parts
    }

    /// The same with another table, such as a fitted or a stored one.
    #[must_use]
    pub fn with_table(&self, table: Lut3d) -> Self {
        Self { parts: StructuredParts { table, ..self.parts.clone() }, ..self.clone() }
    }

    /// Coordinates in the table of one scene-linear colour.
    #[inline]
    pub fn coordinates(&self, linear: [f32; 3]) -> [f32; 3] {
        let finite = linear.map(|v| if v.is_nan() { 0.0 } else { v.clamp(-INPUT_MAX, INPUT_MAX) });
        let scene = (self.input * Vec3::from(finite)).clamp(Vec3::ZERO, Vec3::splat(INPUT_MAX));
        let exposure = self.exposure * scene;
        let first = self.parts.curves.apply(exposure.to_array().map(|e| log2(e.max(LOG_FLOOR))));
        match (&self.mix, &self.parts.mix) {
            (Some((matrix, offset)), Some(Mix { curves, .. })) => {
                curves.apply((*matrix * Vec3::from(first) + *offset).to_array())
            }
            _ => first,
        }
    }

    /// The output for one entry of the table, or a value between entries.
    #[inline]
    pub fn decode(&self, entry: [f32; 3]) -> [f32; 3] {
        match &self.parts.decode {
            Decode::Coded => entry,
            Decode::Density { matrix: rows, coding } => {
                let passed = Vec3::from(entry.map(|d| exp2(-std::f32::consts::LOG2_10 * d)));
                (matrix(rows) * passed).to_array().map(|v| coding.encode_f32(v))
            }
        }
    }

    /// The output for one scene-linear colour.
    #[inline]
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.decode(self.parts.table.apply(self.coordinates(linear), self.parts.interpolation))
    }

    /// [`StructuredLut::apply`] to every pixel in place, on all threads.
    pub fn apply_to_slice(&self, pixels: &mut [[f32; 3]]) {
        map_colours(self, pixels);
    }

    /// The block's coordinates in the table.
    fn find_block(&self, level: Level, block: &mut Block, count: usize) {
        expose(level, &self.parts.input, &self.parts.exposure, block, count);
        self.curves.apply(level, block, count);
        if let (Some(mix), Some(curves)) = (&self.parts.mix, &self.mix_curves) {
            affine(level, &mix.matrix, mix.offset, block, count);
            curves.apply(level, block, count);
        }
    }
}

impl BlockMap for StructuredLut {
    fn map_block(&self, level: Level, block: &mut Block, count: usize) {
        self.find_block(level, block, count);
        lookup(level, Axes::Coordinates, &self.parts.table, self.parts.interpolation, block, count);
        if let Decode::Density { matrix, coding } = &self.parts.decode {
            decode_density(level, matrix, &coding.numbers(), block, count);
        }
    }

    fn map_block_to(&self, level: Level, block: &mut Block, to: &mut [[f32; 4]]) {
        match &self.parts.decode {
            Decode::Coded => {
                self.find_block(level, block, to.len());
                lookup_to(level, Axes::Coordinates, &self.parts.table, self.parts.interpolation, block, to);
            }
            Decode::Density { .. } => {
                self.map_block(level, block, to.len());
                interleave(level, block, to);
            }
        }
    }
}

pub(super) fn matrix(rows: &Rows) -> Mat3 {
    Mat3::from_cols_array_2d(rows).transpose()
}

pub(super) fn check(what: &'static str, rows: &Rows) -> Result<(), Error> {
    match rows.iter().flatten().find(|v| !v.is_finite()) {
        Some(&found) => Err(Kind::Parameter { what, found: f64::from(found), expected: "a finite number" }.into()),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;

    const IDENTITY: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// log2 from -10 to 0 becomes 0 to 1 through the curve.
    fn parts() -> StructuredParts {
        let curve = |size: usize| (0..size).map(|i| [i as f32 / (size - 1) as f32; 3]).collect();
        StructuredParts {
            input: IDENTITY,
            exposure: IDENTITY,
            curves: Lut1d::new(Domain::common(-10.0, 0.0).unwrap(), curve(11)).unwrap(),
            mix: None,
            table: Lut3d::identity(5).unwrap(),
            decode: Decode::Coded,
            interpolation: Interpolation::Tetrahedral,
        }
    }

    #[test]
    fn each_step_does_what_it_says() {
        let lut = StructuredLut::new(parts()).unwrap();
        let out = lut.apply([1.0, 0.5, 2f32.powi(-10)]);
        for (found, expected) in out.into_iter().zip([1.0, 0.9, 0.0]) {
            assert!((found - expected).abs() < 1e-6);
        }
        // Channels exchanged by the mix, and halved.
        let curves = Lut1d::new(Domain::UNIT, vec![[0.0; 3], [0.5; 3]]).unwrap();
        let matrix = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let mix = Some(Mix { matrix, offset: [0.0, 0.0, 0.5], curves });
        let mixed = StructuredLut::new(StructuredParts { mix, ..parts() }).unwrap();
        for (found, expected) in mixed.apply([1.0, 0.5, 2f32.powi(-10)]).into_iter().zip([0.45, 0.5, 0.25]) {
            assert!((found - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn densities_decode_to_light() {
        let decode = Decode::Density { matrix: IDENTITY, coding: PowerCoding::LINEAR };
        let lut = StructuredLut::new(StructuredParts { decode, ..parts() }).unwrap();
        let [r, _, b] = lut.apply([1.0, 1.0, 1e-9]);
        assert!((r - 0.1).abs() < 1e-6 && (b - 1.0).abs() < 1e-6);
    }

    #[test]
    fn any_input_has_a_finite_result() {
        let lut = StructuredLut::new(parts()).unwrap();
        for v in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e-40, f32::MAX] {
            assert!(lut.apply([v, 0.18, v]).iter().all(|v| v.is_finite()), "{v}");
        }
        assert_eq!(lut.apply([f32::NAN; 3]), lut.apply([0.0; 3]));
        assert_eq!(lut.apply([-5.0; 3]), lut.apply([0.0; 3]));
        assert_eq!(lut.apply([f32::INFINITY; 3]), lut.apply([1e30; 3]));
        let bad = StructuredParts { input: [[f32::NAN; 3]; 3], ..parts() };
        assert!(StructuredLut::new(bad).is_err());
    }
}
