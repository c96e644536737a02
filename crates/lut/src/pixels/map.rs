use super::run;
use super::sample::Sample;
use super::simd_level::SimdLevel;
use super::view::{Channels, Layout, Pixels, PixelsMut};
use crate::error::{Error, ErrorKind};
use crate::form::direct::DirectForm;
use crate::form::plain::PlainLut;
use crate::form::structured::StructuredLut;

/// A compiled form as a map of whole pictures, on all threads of the current rayon pool and the machine's vector
/// instructions.
///
/// Scene-linear RGB in, what the form yields out. Alpha goes through unchanged, bit for bit where its type stays; where
/// only the output has it, it is 1.
///
/// Floats come within 1e-5 of [`PixelMap::apply`] and codes of 8 bits within one of its, for forms whose output changes by
/// less than 30 across the table: what differs is rounding, about 3e-7 in a table's coordinates.
///
/// ```
/// use onelight_lut::{Channels, Interpolation, Lut3d, PixelMap, Pixels, PixelsMut, PlainLut, Shaper};
///
/// let form = PlainLut::new(Shaper::log2(0.02, 4.0)?, Lut3d::identity(17)?, Interpolation::Tetrahedral);
/// let frame = vec![0.18_f32; 4 * 64 * 32];
/// let mut shown = vec![0_u8; 3 * 64 * 32];
/// let from = Pixels::new(&frame, Channels::Rgba, [64, 32])?;
/// form.map(&from, &mut PixelsMut::new(&mut shown, Channels::Rgb, [64, 32])?)?;
/// assert_eq!(shown[0], (form.apply([0.18; 3])[0] * 255.0).round() as u8);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
pub trait PixelMap: sealed::Sealed + Sync {
    /// The output for one colour.
    fn apply(&self, linear: [f32; 3]) -> [f32; 3];

    /// The output for one colour in float64, from the same numbers: what [`PixelMap::apply`] would be if float32 did not round.
    fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3];

    /// Every pixel of `from` to `to`.
    ///
    /// # Errors
    /// If the pictures differ in size.
    fn map<S: Sample, T: Sample>(&self, from: &Pixels<'_, S>, to: &mut PixelsMut<'_, T>) -> Result<(), Error> {
        self.map_on(SimdLevel::best(), from, to)
    }

    /// The same as [`PixelMap::map`], by the instructions of one level.
    ///
    /// # Errors
    /// The same as those of [`PixelMap::map`].
    fn map_on<S: Sample, T: Sample>(
        &self,
        level: SimdLevel,
        from: &Pixels<'_, S>,
        to: &mut PixelsMut<'_, T>,
    ) -> Result<(), Error> {
        if from.size() != to.size() {
            return Err(ErrorKind::PictureSizes { from: from.size(), to: to.size() }.into());
        }
        let (from, to) = ((from.samples, from.layout), (&mut *to.samples, to.layout));
        run::map(self.blocks().0, level.level(), from, to);
        Ok(())
    }

    /// Every pixel of a picture in place: what is read is overwritten.
    fn map_in_place<S: Sample>(&self, pixels: &mut PixelsMut<'_, S>) {
        self.map_in_place_on(SimdLevel::best(), pixels);
    }

    /// The same as [`PixelMap::map_in_place`], by the instructions of one level.
    fn map_in_place_on<S: Sample>(&self, level: SimdLevel, pixels: &mut PixelsMut<'_, S>) {
        run::map_in_place(self.blocks().0, level.level(), pixels.samples, pixels.layout);
    }

    /// Every colour of a list in place.
    fn map_colours(&self, colours: &mut [[f32; 3]]) {
        let (width, samples) = (colours.len(), colours.as_flattened_mut());
        let layout = Layout { channels: Channels::Rgb, width, height: 1, stride: samples.len() };
        run::map_in_place(self.blocks().0, SimdLevel::best().level(), samples, layout);
    }
}

mod sealed {
    use crate::kernel::block::BlockMap;

    /// A form as the pixel loops see it.
    pub struct Blocks<'a>(pub(super) &'a dyn BlockMap);

    pub trait Sealed {
        fn blocks(&self) -> Blocks<'_>;
    }

    impl Sealed for super::PlainLut {
        fn blocks(&self) -> Blocks<'_> {
            Blocks(self)
        }
    }

    impl Sealed for super::StructuredLut {
        fn blocks(&self) -> Blocks<'_> {
            Blocks(self)
        }
    }

    impl Sealed for super::DirectForm {
        fn blocks(&self) -> Blocks<'_> {
            Blocks(self)
        }
    }
}

impl PixelMap for PlainLut {
    fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.apply(linear)
    }

    fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        self.apply_f64(linear)
    }
}

impl PixelMap for StructuredLut {
    fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.apply(linear)
    }

    fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        self.apply_f64(linear)
    }
}

impl PixelMap for DirectForm {
    fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.apply(linear)
    }

    fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        self.apply_in(linear)
    }
}

#[cfg(test)]
mod tests;
