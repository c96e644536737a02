use fearless_simd::Level;

use crate::coding::PowerCoding;
use crate::error::Error;
use crate::form::develop::{Develop, DevelopCurves};
use crate::form::expose::Expose;
use crate::interpolate::Interpolation;
use crate::kernel::block::{Block, BlockMap, interleave};
use crate::kernel::cells::Axes;
use crate::kernel::coding::decode_density;
use crate::kernel::curves::Curves;
use crate::kernel::expose::{affine, expose};
use crate::kernel::lookup::{lookup, lookup_to};
use crate::kernel::steps::BlockSteps;
use crate::lut1d::Lut1d;
use crate::lut3d::Lut3d;
use crate::number::Number;
use crate::scene_light::{Rows, check_rows, times};

/// The structured form: one fetch from a 3D table whose axes are bent and mixed to fit, so that few nodes do and any input
/// is in range.
///
/// 1. [`Expose`]: scene light to log2 exposure
/// 2. [`Develop`]: a curve on each channel, and what channels do to each other
/// 3. where there is a `mix`: a matrix with offset, and a second curve on each channel
/// 4. the 3D table
/// 5. [`Decode`]
///
/// ```
/// use onelight_lut::{Decode, Develop, Expose, IDENTITY, Interpolation, Lut1d, Lut3d, StructuredLut, StructuredParts};
/// let form = StructuredLut::new(StructuredParts {
///     expose: Expose::by(IDENTITY),
///     // The table's axes are stops from -10 to 0.
///     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| 1.0 + stops / 10.0)? },
///     mix: None,
///     table: Lut3d::identity(5)?,
///     decode: Decode::Coded,
///     interpolation: Interpolation::Tetrahedral,
/// })?;
/// assert!((form.apply([0.5, 0.25, 1.0])[0] - 0.9).abs() < 1e-5);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StructuredLut {
    parts: StructuredParts,
    develop: DevelopCurves,
    mix_curves: Option<Curves>,
}

/// What a [`StructuredLut`] is made of, in the order in which it is applied.
///
/// ```
/// # use onelight_lut::{Decode, Develop, Expose, IDENTITY, Interpolation, Lut1d, Lut3d, Mix, PowerCoding, StructuredLut, StructuredParts};
/// // The curves of a film from -10 stops to white, and a table that leaves them as they are.
/// let parts = StructuredParts {
///     expose: Expose::by(IDENTITY),
///     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| 1.0 + 0.1 * stops)? },
///     mix: None,
///     table: Lut3d::identity(2)?,
///     decode: Decode::Coded,
///     interpolation: Interpolation::Tetrahedral,
/// };
/// assert!((StructuredLut::new(parts)?.apply([0.25; 3])[0] - 0.8).abs() < 1e-5);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StructuredParts {
    /// From scene light to log2 exposure.
    pub expose: Expose,
    /// The first film, whose values are the coordinates, or what `mix` makes them of.
    pub develop: Develop,
    /// A second mix of the channels, with its curves.
    pub mix: Option<Mix>,
    /// The table, read at coordinates from 0 to 1.
    pub table: Lut3d,
    /// How entries of the table become the output.
    pub decode: Decode,
    /// How the table is read.
    pub interpolation: Interpolation,
}

/// A matrix with offset, then a curve on each channel.
///
/// ```
/// # use onelight_lut::{Decode, Develop, Expose, IDENTITY, Interpolation, Lut1d, Lut3d, Mix, PowerCoding, StructuredLut, StructuredParts};
/// // What a print's layers see of a negative's: half a unit less where it has one unit more.
/// let mix = Mix {
///     matrix: IDENTITY.map(|row| row.map(|v| -0.5 * v)),
///     offset: [1.0; 3],
///     curves: Lut1d::sample(2, [0.0, 1.0], |v| v)?,
/// };
/// assert_eq!(mix.curves.apply([mix.matrix[0][0] + mix.offset[0]; 3]), [0.5; 3]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mix {
    /// From the first curves' values to those that the second take.
    pub matrix: Rows,
    /// Added to what the matrix gives.
    pub offset: [f32; 3],
    /// A curve for each channel, whose values are the table's coordinates.
    pub curves: Lut1d,
}

/// How entries of a table become the output.
///
/// ```
/// # use onelight_lut::{Decode, Develop, Expose, IDENTITY, Interpolation, Lut1d, Lut3d, Mix, PowerCoding, StructuredLut, StructuredParts};
/// let parts = StructuredParts {
///     expose: Expose::by(IDENTITY),
///     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| -0.1 * stops)? },
///     mix: None,
///     table: Lut3d::identity(2)?,
///     decode: Decode::Density { matrix: IDENTITY, coding: PowerCoding::LINEAR },
///     interpolation: Interpolation::Tetrahedral,
/// };
/// // White has no dye, so density 0, so all of the light.
/// assert!((StructuredLut::new(parts)?.apply([1.0; 3])[0] - 1.0).abs() < 1e-5);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decode {
    /// The entries are the output as they are.
    Coded,
    /// The entries are densities: 10^-entry, a matrix to linear RGB, then the output's coding.
    Density {
        /// From the three transmittances to linear RGB.
        matrix: Rows,
        /// From linear to coded RGB.
        coding: PowerCoding,
    },
}

impl StructuredLut {
    /// A table of these parts, checked so that applying it cannot fail.
    ///
    /// # Errors
    /// If a matrix holds a number that is not finite.
    pub fn new(parts: StructuredParts) -> Result<Self, Error> {
        parts.expose.check()?;
        parts.develop.check()?;
        if let Some(Mix { matrix, offset, .. }) = &parts.mix {
            check_rows("mix matrix", matrix)?;
            check_rows("mix offset", &[*offset; 3])?;
        }
        if let Decode::Density { matrix, .. } = &parts.decode {
            check_rows("decode matrix", matrix)?;
        }
        let develop = DevelopCurves::new(&parts.develop);
        let mix_curves = parts.mix.as_ref().map(|mix| Curves::new(&mix.curves));
        Ok(Self { develop, mix_curves, parts })
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

    /// The same with another first step, such as [`Expose::brighter`] or [`Expose::after`] of the one it has: no copy and no fit, so
    /// that an exposure or a white balance can follow a hand. What lies behind the first film, such as a printer's lights, is in the
    /// table, which must then be baked again.
    ///
    /// # Errors
    /// If a matrix holds a number that is not finite.
    pub fn with_expose(mut self, expose: Expose) -> Result<Self, Error> {
        expose.check()?;
        self.parts.expose = expose;
        Ok(self)
    }

    /// The coordinates, 0 to 1 within the table, of one scene-linear colour.
    #[inline]
    pub fn coordinates(&self, linear: [f32; 3]) -> [f32; 3] {
        self.coordinates_in(linear)
    }

    /// The output for one entry of the table, or a value between entries.
    #[inline]
    pub fn decode(&self, entry: [f32; 3]) -> [f32; 3] {
        self.decode_in(entry)
    }

    /// The output for one scene-linear colour.
    #[inline]
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.decode(self.parts.table.apply(self.coordinates(linear), self.parts.interpolation))
    }

    /// [`StructuredLut::apply`] in float64, from the same stored numbers.
    pub(crate) fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        self.decode_in(self.parts.table.apply_f64(self.coordinates_in(linear), self.parts.interpolation))
    }

    #[inline]
    fn coordinates_in<N: Number>(&self, linear: [N; 3]) -> [N; 3] {
        let StructuredParts { expose, develop, mix, .. } = &self.parts;
        let first = develop.apply_in(expose.log2_in(linear));
        match mix {
            Some(Mix { matrix, offset, curves }) => {
                let [r, g, b] = times(matrix, first);
                curves.apply_in([r + N::of(offset[0]), g + N::of(offset[1]), b + N::of(offset[2])])
            }
            None => first,
        }
    }

    #[inline]
    fn decode_in<N: Number>(&self, entry: [N; 3]) -> [N; 3] {
        match &self.parts.decode {
            Decode::Coded => entry,
            Decode::Density { matrix, coding } => {
                times(matrix, entry.map(N::transmittance)).map(|light| coding.encode_in(light))
            }
        }
    }

    /// The block's coordinates in the table.
    fn find_block(&self, level: Level, block: &mut Block, count: usize) {
        self.expose_block(level, block, count);
        self.develop_block(level, block, count);
        self.mix_block(level, block, count);
    }

    /// What the first film holds to coordinates.
    fn mix_block(&self, level: Level, block: &mut Block, count: usize) {
        if let (Some(mix), Some(curves)) = (&self.parts.mix, &self.mix_curves) {
            affine(level, &mix.matrix, mix.offset, block, count);
            curves.apply(level, block, count);
        }
    }
}

impl BlockMap for StructuredLut {
    fn map_block(&self, level: Level, block: &mut Block, count: usize) {
        self.expose_block(level, block, count);
        self.develop_block(level, block, count);
        self.finish_block(level, block, count);
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

impl BlockSteps for StructuredLut {
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
        self.mix_block(level, block, count);
        lookup(level, Axes::Coordinates, &self.parts.table, self.parts.interpolation, block, count);
        if let Decode::Density { matrix, coding } = &self.parts.decode {
            decode_density(level, matrix, &coding.numbers(), block, count);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;
    use crate::scene_light::IDENTITY;

    /// log2 from -10 to 0 becomes 0 to 1 through the curve.
    fn parts() -> StructuredParts {
        let curve = |size: usize| (0..size).map(|i| [i as f32 / (size - 1) as f32; 3]).collect();
        StructuredParts {
            expose: Expose::by(IDENTITY),
            develop: Develop {
                coupling: None,
                curves: Lut1d::new(Domain::common(-10.0, 0.0).unwrap(), curve(11)).unwrap(),
            },
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
        let bad = StructuredParts { expose: Expose::by([[f32::NAN; 3]; 3]), ..parts() };
        assert!(StructuredLut::new(bad).is_err());
    }
}
