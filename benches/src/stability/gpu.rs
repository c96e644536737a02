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
        pub fn open() -> Option<Self> {
            None
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
    use onelight_gpu::{Fetch, FilmPass, LookSettings, wgpu};
    use pollster::block_on;
    use wgpu::{
        BufferDescriptor, BufferUsages, Device, DeviceDescriptor, Extent3d, Instance, InstanceDescriptor, MapMode,
        PollType, Queue, TexelCopyBufferInfo, TexelCopyBufferLayout, TextureDescriptor, TextureDimension,
        TextureFormat, TextureUsages,
    };

    use crate::error::{Error, Result};
    use crate::form::Form;

    /// Pixels of a row: whole multiples of 256 bytes, as copies want them.
    const WIDTH: u32 = 256;
    const PIXEL_BYTES: u32 = 16;

    /// A graphics card, or software that stands in for one.
    pub struct Card {
        device: Device,
        queue: Queue,
        name: String,
    }

    impl Card {
        /// The system's first adapter, software ones included; `None` where there is none.
        pub fn open() -> Option<Self> {
            let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
            let adapter = block_on(instance.request_adapter(&Default::default())).ok()?;
            let (device, queue) = block_on(adapter.request_device(&DeviceDescriptor::default())).ok()?;
            Some(Self { device, queue, name: adapter.get_info().name })
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
            let pass = FilmPass::with_settings(&self.device, &self.queue, form, TextureFormat::Rgba32Float, &settings)?;
            let rows = (colours.len() as u32).div_ceil(WIDTH);
            let size = Extent3d { width: WIDTH, height: rows, depth_or_array_layers: 1 };
            let texture = |usage| {
                self.device.create_texture(&TextureDescriptor {
                    label: None,
                    size,
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: TextureDimension::D2,
                    format: TextureFormat::Rgba32Float,
                    usage,
                    view_formats: &[],
                })
            };
            let source = texture(TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST);
            let target = texture(pass.target_usage() | TextureUsages::COPY_SRC);
            let mut bytes: Vec<u8> =
                colours.iter().flat_map(|&[r, g, b]| [r, g, b, 1.0]).flat_map(f32::to_ne_bytes).collect();
            bytes.resize((PIXEL_BYTES * WIDTH * rows) as usize, 0);
            let layout = TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(PIXEL_BYTES * WIDTH),
                rows_per_image: Some(rows),
            };
            self.queue.write_texture(source.as_image_copy(), &bytes, layout, size);
            let read = self.device.create_buffer(&BufferDescriptor {
                label: None,
                size: bytes.len() as u64,
                usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let mut encoder = self.device.create_command_encoder(&Default::default());
            let [from, to] = [&source, &target].map(|texture| texture.create_view(&Default::default()));
            pass.encode(&mut encoder, &from, &to)?;
            encoder.copy_texture_to_buffer(target.as_image_copy(), TexelCopyBufferInfo { buffer: &read, layout }, size);
            self.queue.submit([encoder.finish()]);
            read.slice(..).map_async(MapMode::Read, |_| ());
            self.device.poll(PollType::wait_indefinitely())?;
            let bytes = read.slice(..).get_mapped_range();
            let bytes = bytes.map_err(|error| Error::of("what the card made cannot be read", error))?.to_vec();
            let float = |bytes: &[u8]| f64::from(bytes.try_into().map_or(f32::NAN, f32::from_ne_bytes));
            let pixels = bytes.chunks_exact(PIXEL_BYTES as usize).take(colours.len());
            Ok(pixels.map(|p| [float(&p[0..4]), float(&p[4..8]), float(&p[8..12])]).collect())
        }
    }
}
