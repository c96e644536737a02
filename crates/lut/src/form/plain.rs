use fearless_simd::Level;

use crate::interpolate::Interpolation;
use crate::kernel::block::{Block, BlockMap};
use crate::kernel::cells::Axes;
use crate::kernel::lookup::{lookup, lookup_to};
use crate::lut3d::Lut3d;
use crate::shaper::Shaper;

/// The plain form: a shaper on every channel, then one fetch from a 3D table.
///
/// Input is scene-linear, output is whatever coding was baked. Any input, NaN and infinities included, reads a
/// place in the table.
///
/// ```
/// use onelight_lut::{Interpolation, PlainLut, Shaper, bake};
/// let shaper = Shaper::log2(0.02, 4.0)?;
/// let table = bake(33, &shaper, |rgb| rgb.map(|u| u / (u + 0.18)), |_nodes_done| {})?;
/// let form = PlainLut::new(shaper, table, Interpolation::Tetrahedral);
/// assert!((form.apply([0.18; 3])[1] - 0.5).abs() < 1e-3);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PlainLut {
    shaper: Shaper,
    table: Lut3d,
    interpolation: Interpolation,
}

impl PlainLut {
    /// A table with the shaper it was baked with, and the way to read it.
    pub fn new(shaper: Shaper, table: Lut3d, interpolation: Interpolation) -> Self {
        Self { shaper, table, interpolation }
    }

    /// What leads from scene-linear values to the table's coordinates.
    pub fn shaper(&self) -> &Shaper {
        &self.shaper
    }

    /// The table that is read at the shaper's coordinates.
    pub fn table(&self) -> &Lut3d {
        &self.table
    }

    /// How the table is read.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The baked coding of one scene-linear colour.
    #[inline]
    pub fn apply(&self, [red, green, blue]: [f32; 3]) -> [f32; 3] {
        let coordinate = |u| self.shaper.encode_f32(u);
        self.table.read(coordinate(red), coordinate(green), coordinate(blue), self.interpolation)
    }

    /// [`PlainLut::apply`] in float64, from the same stored numbers.
    pub(crate) fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        self.table.apply_f64(linear.map(|u| self.shaper.encode(u)), self.interpolation)
    }
}

impl BlockMap for PlainLut {
    fn map_block(&self, level: Level, block: &mut Block, count: usize) {
        lookup(level, Axes::Light(self.shaper.numbers()), &self.table, self.interpolation, block, count);
    }

    fn map_block_to(&self, level: Level, block: &mut Block, to: &mut [[f32; 4]]) {
        lookup_to(level, Axes::Light(self.shaper.numbers()), &self.table, self.interpolation, block, to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PixelMap, SceneSampler, bake};
    use approx::assert_abs_diff_eq;

    fn look(rgb: [f64; 3]) -> [f64; 3] {
        rgb.map(|u| u / (u + 0.18))
    }

    fn lut(size: usize, interpolation: Interpolation) -> PlainLut {
        let shaper = Shaper::log2(0.02, 4.0).unwrap();
        let table = bake(size, &shaper, look, |_| {}).unwrap();
        PlainLut::new(shaper, table, interpolation)
    }

    #[test]
    fn nodes_return_the_function() {
        // The f32 shaper moves a node by up to 3e-7 of the table; `look` rises less than 5 over it.
        let lut = lut(33, Interpolation::Tetrahedral);
        for i in 0..33 {
            let u = lut.shaper().decode(f64::from(i) / 32.0);
            let out = lut.apply([u as f32, 0.0, 4.0]);
            assert_abs_diff_eq!(f64::from(out[0]), look([u; 3])[0], epsilon = 2e-6);
            assert_eq!(out[1], 0.0);
            assert_eq!(out[2], look([4.0; 3])[2] as f32);
        }
    }

    #[test]
    fn error_falls_with_the_square_of_the_cell() {
        let worst = |size| {
            let lut = lut(size, Interpolation::Trilinear);
            (1..2000)
                .map(|i| {
                    let u = 4.0 * (f64::from(i) / 2000.0).powi(3);
                    (f64::from(lut.apply([u as f32; 3])[0]) - look([u; 3])[0]).abs()
                })
                .fold(0.0, f64::max)
        };
        let [coarse, fine] = [worst(9), worst(17)];
        assert!((3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
    }

    #[test]
    fn slices_follow_single_pixels() {
        let lut = lut(9, Interpolation::Tetrahedral);
        let mut pixels: Vec<_> =
            SceneSampler::new(-8.0..=6.0).unwrap().take(20_017).map(|rgb| rgb.map(|u| u as f32)).collect();
        pixels[5] = [f32::NAN, f32::INFINITY, -1.0];
        let want: Vec<_> = pixels.iter().map(|&rgb| lut.apply(rgb)).collect();
        lut.map_colours(&mut pixels);
        for (found, want) in pixels.as_flattened().iter().zip(want.as_flattened()) {
            assert_abs_diff_eq!(found, want, epsilon = 1e-5);
        }
    }
}
