//! Forms on a graphics card; nothing where this build knows none.

#[cfg(feature = "gpu")]
pub use with::Card;
#[cfg(not(feature = "gpu"))]
pub use without::Card;

#[cfg(not(feature = "gpu"))]
mod without {
    use crate::error::{Error, Result};
    use crate::form::Form;

    /// A graphics card, of which this build knows none.
    pub struct Card;

    impl Card {
        /// None: the feature `gpu` is off.
        ///
        /// # Errors
        /// Never.
        pub fn open() -> Result<Option<Self>> {
            Ok(None)
        }

        /// A text that says so.
        pub fn name(&self) -> &'static str {
            "no card"
        }

        pub(in super::super) fn develop(&self, _: &Form, _: &[[f32; 3]]) -> Result<Vec<[f64; 3]>> {
            Err(Error::new("this build knows no graphics cards"))
        }
    }
}

#[cfg(feature = "gpu")]
mod with {
    use onelight::lut::Storage;
    use onelight_gpu::wgpu::TextureFormat;
    use onelight_gpu::{Fetch, FilmPass, Headless, HeadlessSettings, LookSettings};

    use crate::error::Result;
    use crate::form::Form;

    /// Pixels of a row.
    const WIDTH: u32 = 256;
    const PIXEL_BYTES: u32 = 16;

    /// A graphics card, or software that stands in for one.
    pub struct Card {
        gpu: Headless,
        name: String,
    }

    impl Card {
        /// The system's fastest adapter, or software where there is no other; `None` where there is neither.
        ///
        /// # Errors
        /// If there is an adapter that gives no device.
        pub fn open() -> Result<Option<Self>> {
            let gpu = match Headless::open(&HeadlessSettings::default()) {
                Err(error) if error.is_no_adapter() => return Ok(None),
                opened => opened?,
            };
            Ok(Some(Self { name: gpu.name(), gpu }))
        }

        /// The name by which the adapter calls itself.
        pub fn name(&self) -> &str {
            &self.name
        }

        /// Display-coded colours, by 32-bit floats throughout.
        pub(in super::super) fn develop(&self, form: &Form, colours: &[[f32; 3]]) -> Result<Vec<[f64; 3]>> {
            let form = match form {
                Form::Plain(lut) => onelight_gpu::Form::from(lut),
                Form::Structured(lut) => onelight_gpu::Form::from(lut.as_ref()),
                Form::Direct(direct) => onelight_gpu::Form::from(direct.as_ref()),
            };
            let settings = LookSettings { storage: Storage::F32, fetch: Fetch::Texels, ..Default::default() };
            let pass = FilmPass::with_settings(
                &self.gpu.device,
                &self.gpu.queue,
                form,
                TextureFormat::Rgba32Float,
                &settings,
            )?;
            let rows = (colours.len() as u32).div_ceil(WIDTH);
            let mut bytes: Vec<u8> =
                colours.iter().flat_map(|&[r, g, b]| [r, g, b, 1.0]).flat_map(f32::to_ne_bytes).collect();
            bytes.resize((PIXEL_BYTES * WIDTH * rows) as usize, 0);
            let source = self.gpu.upload([WIDTH, rows], TextureFormat::Rgba32Float, &bytes)?;
            let bytes = self.gpu.develop(&pass, &source)?;
            let float = |bytes: &[u8]| f64::from(bytes.try_into().map_or(f32::NAN, f32::from_ne_bytes));
            let pixels = bytes.chunks_exact(PIXEL_BYTES as usize).take(colours.len());
            Ok(pixels.map(|p| [float(&p[0..4]), float(&p[4..8]), float(&p[8..12])]).collect())
        }
    }
}
