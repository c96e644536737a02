use std::future::Future;
use std::pin::pin;
use std::sync::{Arc, mpsc};
use std::task::{Context, Poll, Wake, Waker};
use std::thread::{self, Thread};

use wgpu::{
    Adapter, Buffer, BufferDescriptor, BufferUsages, Device, DeviceDescriptor, Extent3d, Features, Instance,
    InstanceDescriptor, Limits, MapMode, PollType, PowerPreference, Queue, RequestAdapterOptions, TexelCopyBufferInfo,
    TexelCopyBufferLayout, Texture, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages,
};

use crate::check::checked;
use crate::error::{Error, ErrorKind, Refused};
use crate::pass::FilmPass;

/// A device without a window: for batches, tests and measurements, which wait for the GPU and read back what it made.
///
/// With the feature `native`. A program with a frame of its own has a device, and needs none of this.
///
/// ```no_run
/// use onelight_gpu::wgpu::TextureFormat::{Rgba8Unorm, Rgba32Float};
/// use onelight_gpu::{FilmPass, Headless};
///
/// let gpu = Headless::open(&Default::default())?;
/// let form = onelight::Process::for_camera("fuji-velvia-50")?.compile()?.direct(&Default::default())?;
/// let film = FilmPass::new(&gpu.device, &gpu.queue, &form, Rgba8Unorm)?;
/// // Two pixels of scene-linear light, red, green, blue, alpha.
/// let light = [[0.18, 0.18, 0.18, 1.0_f32], [2.0, 0.5, 0.1, 1.0]];
/// let bytes: Vec<u8> = light.iter().flatten().flat_map(|v| v.to_ne_bytes()).collect();
/// let display = gpu.develop(&film, &gpu.upload([2, 1], Rgba32Float, &bytes)?)?;
/// assert_eq!(display.len(), 2 * 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Headless {
    /// The graphics card and driver, or software that stands in for one.
    pub adapter: Adapter,
    /// Makes textures, buffers and pipelines.
    pub device: Device,
    /// Takes uploads and what encoders recorded.
    pub queue: Queue,
}

/// Which adapter [`Headless::open`] takes, and what it asks of it.
///
/// ```
/// use onelight_gpu::{HeadlessSettings, wgpu};
///
/// // Mesa's software driver, with time stamps.
/// let settings = HeadlessSettings {
///     adapter: "llvmpipe",
///     required_features: wgpu::Features::TIMESTAMP_QUERY,
///     ..Default::default()
/// };
/// assert!(settings.optional_features.contains(wgpu::Features::FLOAT32_FILTERABLE));
/// ```
#[derive(Clone, Debug)]
pub struct HeadlessSettings<'a> {
    /// Part of the adapter's name, in any case of letters. Empty, as by default: the fastest one.
    pub adapter: &'a str,
    /// What the device must have; by default nothing.
    pub required_features: Features,
    /// What the device is to have where its adapter does; by default `FLOAT32_FILTERABLE`, which filtered tables of 32-bit
    /// floats need.
    pub optional_features: Features,
    /// What the device is to allow, each as far as its adapter does; by default wgpu's, and textures as large as there are.
    pub limits: Limits,
}

impl Default for HeadlessSettings<'_> {
    fn default() -> Self {
        Self {
            adapter: "",
            required_features: Features::empty(),
            optional_features: Features::FLOAT32_FILTERABLE,
            limits: Limits { max_texture_dimension_2d: u32::MAX, ..Limits::default() },
        }
    }
}

impl Headless {
    /// Opens a device, and waits for it.
    ///
    /// # Errors
    /// If no adapter has that name ([`Error::is_no_adapter`]), or it lacks a required feature.
    pub fn open(settings: &HeadlessSettings<'_>) -> Result<Self, Error> {
        let adapter = adapter(settings.adapter)?;
        let device = |found: String| Error::from(ErrorKind::Device { found });
        let missing = settings.required_features - adapter.features();
        if !missing.is_empty() {
            let names: Vec<_> = missing.iter_names().map(|(name, _)| name).collect();
            return Err(device(format!("{} has no {}", adapter.get_info().name, names.join(", "))));
        }
        let descriptor = DeviceDescriptor {
            required_features: settings.required_features | (adapter.features() & settings.optional_features),
            required_limits: settings.limits.clone().or_worse_values_from(&adapter.limits()),
            ..Default::default()
        };
        let opened = block_on(adapter.request_device(&descriptor)).map_err(|error| device(one_line(&error)));
        let (device, queue) = opened?;
        Ok(Self { adapter, device, queue })
    }

    /// The adapter's name, as its driver gives it.
    pub fn name(&self) -> String {
        self.adapter.get_info().name
    }

    /// A two-dimensional texture of one mip level and one sample a pixel.
    ///
    /// # Errors
    /// If a side is 0 or larger than the device allows, or the device has no such format for that usage.
    pub fn texture(
        &self,
        [width, height]: [u32; 2],
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<Texture, Error> {
        checked(&self.device, Refused::Texture, || {
            self.device.create_texture(&TextureDescriptor {
                label: Some("onelight headless"),
                size: Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        })
    }

    /// A texture to read from, filled with rows of pixels without gaps between them.
    ///
    /// # Errors
    /// If there are more or fewer bytes than the size and format take, or as [`Headless::texture`].
    pub fn upload(&self, size: [u32; 2], format: TextureFormat, bytes: &[u8]) -> Result<Texture, Error> {
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC;
        let texture = self.texture(size, format, usage)?;
        let layout = Rows::of(&texture).ok_or(ErrorKind::SourceFormat { found: format })?;
        if bytes.len() as u64 != layout.bytes() {
            return Err(ErrorKind::ByteCount { found: bytes.len(), expected: layout.bytes() }.into());
        }
        self.queue.write_texture(texture.as_image_copy(), bytes, layout.with_row(layout.row), texture.size());
        Ok(texture)
    }

    /// `source` through a pass, read back: rows of pixels in the pass's format without gaps between them.
    ///
    /// # Errors
    /// The same as those of [`FilmPass::encode`] and [`Headless::read_back`].
    pub fn develop(&self, pass: &FilmPass, source: &Texture) -> Result<Vec<u8>, Error> {
        let size = [source.width(), source.height()];
        let target = self.texture(size, pass.target_format(), pass.target_usage() | TextureUsages::COPY_SRC)?;
        let [from, to] = [source, &target].map(|texture| texture.create_view(&Default::default()));
        let mut encoder = self.device.create_command_encoder(&Default::default());
        pass.encode(&mut encoder, &from, &to)?;
        self.queue.submit([encoder.finish()]);
        self.read_back(&target)
    }

    /// Waits for all that was submitted, and reads a texture's first mip level: its rows, without gaps between them.
    ///
    /// # Errors
    /// If the texture has no `COPY_SRC` among its usages, several samples a pixel, a format other than plain colour, or more bytes
    /// than a buffer of the device holds; or if the device was lost.
    pub fn read_back(&self, texture: &Texture) -> Result<Vec<u8>, Error> {
        let rows = Rows::of(texture).ok_or_else(|| {
            Error::from(ErrorKind::Refused {
                what: Refused::ReadBack,
                found: format!("its format is {:?}", texture.format()),
            })
        })?;
        let padded = rows.row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let (size, max) = (u64::from(padded) * rows.count, self.device.limits().max_buffer_size);
        if size > max {
            return Err(ErrorKind::BufferLimit { found: size, max }.into());
        }
        let (buffer, commands) = checked(&self.device, Refused::ReadBack, || {
            let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
            let descriptor =
                BufferDescriptor { label: Some("onelight read back"), size, usage, mapped_at_creation: false };
            let buffer = self.device.create_buffer(&descriptor);
            let mut encoder = self.device.create_command_encoder(&Default::default());
            let to = TexelCopyBufferInfo { buffer: &buffer, layout: rows.with_row(padded) };
            encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
            (buffer, encoder.finish())
        })?;
        self.queue.submit([commands]);
        let bytes = self.read_buffer(&buffer)?;
        Ok(bytes.chunks(padded as usize).filter_map(|line| line.get(..rows.row as usize)).flatten().copied().collect())
    }

    /// Waits for all that was submitted, and reads the whole of a buffer, which is unmapped before and after.
    ///
    /// # Errors
    /// If the buffer has no `MAP_READ` among its usages or is mapped, or the device was lost.
    pub fn read_buffer(&self, buffer: &Buffer) -> Result<Vec<u8>, Error> {
        let failed = |found: String| Error::from(ErrorKind::Refused { what: Refused::ReadBack, found });
        let (sender, receiver) = mpsc::channel();
        checked(&self.device, Refused::ReadBack, || {
            buffer.slice(..).map_async(MapMode::Read, move |mapped| {
                // Nobody waits for it any more where the poll failed.
                let _ = sender.send(mapped);
            });
        })?;
        self.device.poll(PollType::wait_indefinitely()).map_err(|error| failed(one_line(&error)))?;
        // Another thread's poll may be the one that answers, and still be at it.
        match receiver.recv() {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(failed(one_line(&error))),
            Err(_) => return Err(failed("the device did not answer".to_owned())),
        }
        let bytes = buffer.slice(..).get_mapped_range().map(|mapped| mapped.to_vec());
        buffer.unmap();
        bytes.map_err(|error| failed(one_line(&error)))
    }
}

/// A texture's rows as copies take them.
#[derive(Clone, Copy)]
struct Rows {
    /// Bytes of a row of texels.
    row: u32,
    /// Rows of a layer or slice.
    rows_per_image: u32,
    /// Rows of all layers or slices together.
    count: u64,
}

impl Rows {
    /// None for formats whose texels are not numbers of bytes side by side.
    fn of(texture: &Texture) -> Option<Self> {
        let format = texture.format();
        let texel = format.block_copy_size(None).filter(|_| format.block_dimensions() == (1, 1))?;
        let count = u64::from(texture.height()) * u64::from(texture.depth_or_array_layers());
        Some(Self { row: texture.width().checked_mul(texel)?, rows_per_image: texture.height(), count })
    }

    fn bytes(self) -> u64 {
        u64::from(self.row) * self.count
    }

    fn with_row(self, bytes_per_row: u32) -> TexelCopyBufferLayout {
        let (bytes_per_row, rows_per_image) = (Some(bytes_per_row), Some(self.rows_per_image));
        TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image }
    }
}

/// The fastest adapter, or the first with `word` in its name.
fn adapter(word: &str) -> Result<Adapter, Error> {
    let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
    let missing = |found| Error::from(ErrorKind::NoAdapter { found, expected: word.to_owned() });
    if word.is_empty() {
        let options =
            RequestAdapterOptions { power_preference: PowerPreference::HighPerformance, ..Default::default() };
        return block_on(instance.request_adapter(&options)).map_err(|_| missing(Vec::new()));
    }
    let adapters = block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let names: Vec<_> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let index = names.iter().position(|name| name.to_lowercase().contains(&word.to_lowercase()));
    index.and_then(|index| adapters.into_iter().nth(index)).ok_or_else(|| missing(names))
}

/// Runs a future on this thread, which sleeps while there is nothing to do. On the native back ends wgpu's are done at once.
fn block_on<F: Future>(future: F) -> F::Output {
    struct Unpark(Thread);

    impl Wake for Unpark {
        fn wake(self: Arc<Self>) {
            self.0.unpark();
        }
    }

    let waker = Waker::from(Arc::new(Unpark(thread::current())));
    let mut context = Context::from_waker(&waker);
    let mut future = pin!(future);
    loop {
        match future.as_mut().poll(&mut context) {
            Poll::Ready(output) => return output,
            Poll::Pending => thread::park(),
        }
    }
}

fn one_line(error: &dyn std::error::Error) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use std::future::poll_fn;

    use super::*;

    #[test]
    fn futures_that_are_woken_later_are_waited_for() {
        let mut asked = 0;
        let future = poll_fn(|context| {
            asked += 1;
            let waker = context.waker().clone();
            if asked == 3 {
                return Poll::Ready(asked);
            }
            thread::spawn(move || waker.wake());
            Poll::Pending
        });
        assert_eq!(block_on(future), 3);
    }
}
