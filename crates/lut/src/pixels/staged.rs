//! A form in three steps, for what happens to a picture between them.

use super::samples::{Samples, SamplesMut};
use super::simd_level::SimdLevel;
use super::transfer::{read, write};
use super::view::Channels;
use crate::form::direct::DirectForm;
use crate::form::structured::StructuredLut;
use crate::kernel::block::{BLOCK, Block};
use crate::kernel::steps::{exp2_of_block, log2_of_block};

/// A form that can be stopped where its first film is exposed and where it is developed: what a film does to a picture rather than to
/// a colour happens there. A plain table knows neither place.
///
/// Colours are interleaved, layers are a plane each. What is longer than the shortest of the slices is left alone. All three steps run
/// on the calling thread. One after the other they come within 1e-5 of [`PixelMap::apply`](crate::PixelMap::apply), as exposures are
/// handed over in float32.
///
/// ```
/// use onelight_lut::{Develop, DirectForm, DirectParts, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding, StagedMap};
/// # let unit = |c: usize, v: f32| std::array::from_fn(|k| if k == c { v } else { 0.0 });
/// # let terms = (0..3).map(|c| ExponentialTerm { rate: unit(c, 2.0), weight: unit(c, 1.0) }).collect();
/// let form = DirectForm::new(DirectParts {
///     expose: Expose::by(IDENTITY),
///     // Half a unit less dye for each stop.
///     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-10.0, 0.0], |stops| -0.5 * stops)? },
///     print: None,
///     projection: ExponentialSum::new(terms)?,
///     coding: PowerCoding::LINEAR,
/// })?;
/// let (mut red, mut green, mut blue) = ([0.0], [0.0], [0.0]);
/// form.expose(&[[0.25, 0.5, 1.0]], [&mut red, &mut green, &mut blue]);
/// assert!((red[0] - 0.25).abs() < 1e-6);
/// form.develop([&mut red, &mut green, &mut blue]);
/// assert!((red[0] - 1.0).abs() < 1e-5 && (green[0] - 0.5).abs() < 1e-5);
/// let mut shown = [[0.0; 3]];
/// form.finish([&red, &green, &blue], &mut shown);
/// assert!((shown[0][0] - 0.25).abs() < 1e-5);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
pub trait StagedMap: sealed::Sealed + Sync {
    /// Scene-linear RGB to the exposure of each layer, from 0 to 1e31.
    fn expose(&self, linear: &[[f32; 3]], layers: [&mut [f32]; 3]) {
        let (steps, level, block) = (self.steps().0, SimdLevel::best().level(), &mut Block::new());
        let [red, green, blue] = layers;
        let layers = red.chunks_mut(BLOCK).zip(green.chunks_mut(BLOCK)).zip(blue.chunks_mut(BLOCK));
        for (linear, ((red, green), blue)) in linear.chunks(BLOCK).zip(layers) {
            read(level, Samples::F32(linear.as_flattened()), Channels::Rgb, block);
            steps.expose_block(level, block, linear.len());
            exp2_of_block(level, block, linear.len());
            unload(block, linear.len(), [red, green, blue]);
        }
    }

    /// Exposures to what the first film holds, in place; NaN and what is below 0 count as 0.
    fn develop(&self, layers: [&mut [f32]; 3]) {
        let (steps, level, block) = (self.steps().0, SimdLevel::best().level(), &mut Block::new());
        let [red, green, blue] = layers;
        for ((red, green), blue) in red.chunks_mut(BLOCK).zip(green.chunks_mut(BLOCK)).zip(blue.chunks_mut(BLOCK)) {
            let count = load(block, [red, green, blue]);
            log2_of_block(level, block, count);
            steps.develop_block(level, block, count);
            unload(block, count, [red, green, blue]);
        }
    }

    /// What the first film holds to the form's output. What lies further beyond the values of the first film's curves than these reach is held
    /// there.
    fn finish(&self, layers: [&[f32]; 3], shown: &mut [[f32; 3]]) {
        let (steps, level, block) = (self.steps().0, SimdLevel::best().level(), &mut Block::new());
        let ([red, green, blue], held) = (layers, steps.held());
        let layers = red.chunks(BLOCK).zip(green.chunks(BLOCK)).zip(blue.chunks(BLOCK));
        for (shown, ((red, green), blue)) in shown.chunks_mut(BLOCK).zip(layers) {
            let count = load(block, [red, green, blue]).min(shown.len());
            for (plane, [low, high]) in block.rgb.iter_mut().zip(held) {
                plane[..count].iter_mut().for_each(|v| *v = v.max(low).min(high));
            }
            steps.finish_block(level, block, count);
            write(level, block, SamplesMut::F32(shown[..count].as_flattened_mut()), Channels::Rgb);
        }
    }
}

impl StagedMap for DirectForm {}

impl StagedMap for StructuredLut {}

/// Layers to the block; how many pixels all of them have.
fn load(block: &mut Block, layers: [&[f32]; 3]) -> usize {
    let count = layers.iter().map(|layer| layer.len()).min().unwrap_or(0).min(BLOCK);
    for (plane, layer) in block.rgb.iter_mut().zip(layers) {
        plane[..count].copy_from_slice(&layer[..count]);
    }
    count
}

/// The block's first pixels to layers.
fn unload(block: &Block, count: usize, layers: [&mut [f32]; 3]) {
    for (plane, layer) in block.rgb.iter().zip(layers) {
        let count = count.min(layer.len());
        layer[..count].copy_from_slice(&plane[..count]);
    }
}

mod sealed {
    use crate::kernel::steps::BlockSteps;

    /// A form as these steps see it.
    pub struct Steps<'a>(pub(super) &'a dyn BlockSteps);

    pub trait Sealed {
        fn steps(&self) -> Steps<'_>;
    }

    impl Sealed for super::DirectForm {
        fn steps(&self) -> Steps<'_> {
            Steps(self)
        }
    }

    impl Sealed for super::StructuredLut {
        fn steps(&self) -> Steps<'_> {
            Steps(self)
        }
    }
}
