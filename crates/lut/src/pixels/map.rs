use super::run;
use super::sample::Sample;
use super::vectors::Vectors;
use super::view::{Pixels, PixelsMut};
use crate::error::{Error, Kind};
use crate::form::direct::DirectForm;
use crate::form::double;
use crate::form::plain::PlainLut;
use crate::form::structured::StructuredLut;
use crate::kernel::Level;

/// A compiled form as a map of whole pictures, on all threads of the current rayon pool and the machine's vector
/// instructions.
///
/// Scene-linear RGB in, what the form yields out. Alpha goes through unchanged, bit for bit where its type stays; where
/// only the output has it, it is 1.
///
/// Floats come within 1e-5 of [`PixelMap::apply`] and codes of 8 bits within one of its, for forms whose output changes by
/// less than 30 across the table: what differs is rounding, about 3e-7 in a table's coordinates.
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
        self.map_on(Vectors::best(), from, to)
    }

    /// [`PixelMap::map`] by certain instructions.
    ///
    /// # Errors
    /// As there.
    fn map_on<S: Sample, T: Sample>(
        &self,
        vectors: Vectors,
        from: &Pixels<'_, S>,
        to: &mut PixelsMut<'_, T>,
    ) -> Result<(), Error> {
        if from.size() != to.size() {
            return Err(Kind::PictureSizes { from: from.size(), to: to.size() }.into());
        }
        let (from, to) = ((from.samples, from.layout), (&mut *to.samples, to.layout));
        run::map(self.blocks().0, vectors.level(), from, to);
        Ok(())
    }

    /// Every pixel in place.
    fn map_in_place<S: Sample>(&self, pixels: &mut PixelsMut<'_, S>) {
        run::map_in_place(self.blocks().0, Level::new(), pixels.samples, pixels.layout);
    }
}

mod sealed {
    use crate::kernel::BlockMap;

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
        double::plain(self, linear)
    }
}

impl PixelMap for StructuredLut {
    fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.apply(linear)
    }

    fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        double::structured(self, linear)
    }
}

impl PixelMap for DirectForm {
    fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        self.apply(linear)
    }

    fn apply_f64(&self, linear: [f64; 3]) -> [f64; 3] {
        double::direct(self, linear)
    }
}

#[cfg(test)]
mod tests;
