use wgpu::{
    BindGroup, Color, CommandEncoder, Device, LoadOp, Operations, Queue, RenderPass, RenderPassColorAttachment,
    RenderPassDescriptor, StoreOp, TextureFormat, TextureUsages, TextureView,
};

use crate::bound::BoundLook;
use crate::check::{check_pair, check_source, checked};
use crate::error::{Error, Refused};
use crate::form::Form;
use crate::pipeline::{DrawPipeline, TexturePipeline};
use crate::settings::{Bindings, LookSettings};
use crate::target::{Target, WriteMethod};

/// One look, ready to be applied to textures in the user's own frame.
///
/// Scene-linear RGB is read pixel by pixel from a texture of floats (`Rgba16Float`, `Rgba32Float`, or any other colour format
/// that WGSL reads as `f32`), at its first mip level. What the form yields is written to a target of the same size:
///
/// | format | written by [`FilmPass::encode`] |
/// |---|---|
/// | `Rgba8Unorm`, `Rgba16Float`, `Rgba32Float` | compute; a draw where the device does not compute |
/// | `Rgba8UnormSrgb`, `Bgra8Unorm`, `Bgra8UnormSrgb`, `Rgb10a2Unorm` | a draw: WebGPU lets no shader write them |
///
/// Through a view with `Srgb` the same bytes are stored as without: display-coded values are decoded for the target to
/// encode. Only forms that yield linear light (`PowerCoding::LINEAR`) have theirs encoded by the target.
///
/// ```no_run
/// use onelight_gpu::wgpu::{TextureFormat::Rgba8Unorm, TextureUsages};
/// use onelight_gpu::{FilmPass, Headless};
///
/// let gpu = Headless::open(&Default::default())?;
/// let form = onelight::Process::for_camera("kodak-5219")?.compile()?.direct(&Default::default())?;
/// let film = FilmPass::new(&gpu.device, &gpu.queue, &form, Rgba8Unorm)?;
///
/// // An engine has these two already.
/// # let float = onelight_gpu::wgpu::TextureFormat::Rgba16Float;
/// let hdr = gpu.texture([1920, 1080], float, TextureUsages::TEXTURE_BINDING)?;
/// let display = gpu.texture([1920, 1080], film.target_format(), film.target_usage())?;
///
/// let mut encoder = gpu.device.create_command_encoder(&Default::default());
/// film.encode(&mut encoder, &hdr.create_view(&Default::default()), &display.create_view(&Default::default()))?;
/// gpu.queue.submit([encoder.finish()]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FilmPass {
    device: Device,
    look: BoundLook,
    target: Target,
    draw: DrawPipeline,
    compute: Option<TexturePipeline>,
}

impl FilmPass {
    /// A pass for one form and one format of target, with [`LookSettings::default`].
    ///
    /// # Errors
    /// The same as those of [`FilmPass::with_settings`].
    pub fn new<'a>(
        device: &Device,
        queue: &Queue,
        form: impl Into<Form<'a>>,
        target: TextureFormat,
    ) -> Result<Self, Error> {
        Self::with_settings(device, queue, form, target, &LookSettings::default())
    }

    /// A pass for one form and one format of target. Its shaders are its own, so [`LookSettings::bindings`] plays no part.
    ///
    /// # Errors
    /// If the format is not one of those above, or as [`BoundLook::new`].
    pub fn with_settings<'a>(
        device: &Device,
        queue: &Queue,
        form: impl Into<Form<'a>>,
        target: TextureFormat,
        settings: &LookSettings,
    ) -> Result<Self, Error> {
        let target = Target::new(target)?;
        let settings = LookSettings { bindings: Bindings::default(), ..*settings };
        let look = BoundLook::for_target(device, queue, form.into(), &settings, target.coding())?;
        let draw = DrawPipeline::new(device, &look, target);
        let compute = match target.write_method(device) {
            WriteMethod::Compute => TexturePipeline::new(device, &look, target),
            WriteMethod::Draw => None,
        };
        Ok(Self { device: device.clone(), look, target, draw, compute })
    }

    /// Uploads another look of the same form into the resources that are there: no pipeline, no texture, no wait. It shows
    /// from the next submission on.
    ///
    /// # Errors
    /// The same as those of [`BoundLook::upload`].
    pub fn upload<'a>(&self, queue: &Queue, form: impl Into<Form<'a>>) -> Result<(), Error> {
        self.look.upload(queue, form)
    }

    /// Develops `source` into `target`: two textures of the same size and of the pass's device, of one sample a pixel. `source` is
    /// a view of `TEXTURE_BINDING` usage that begins at the first mip level; `target` allows [`FilmPass::target_usage`] and has one
    /// level.
    ///
    /// # Errors
    /// If a texture is larger than [`MAX_SIDE`](crate::MAX_SIDE), the two differ in size or are one, or one of them or its view has a
    /// format, usage, dimension, sample count, number of levels or of layers that the pass cannot use. Nothing is encoded then, and
    /// the encoder stays good. A browser does not answer in time what it thinks of a view: there, what a view hides of its texture is
    /// for the page's console.
    pub fn encode(
        &self,
        encoder: &mut CommandEncoder,
        source: &TextureView,
        target: &TextureView,
    ) -> Result<(), Error> {
        check_pair(source, target, self.target.format(), self.target_usage())?;
        let size = [target.texture().width(), target.texture().height()];
        match &self.compute {
            Some(compute) => {
                let textures = compute.bind(&self.device, source, target)?;
                compute.encode(encoder, &self.look, &textures, size);
            }
            None => {
                let source = self.draw.bind(&self.device, source)?;
                self.check_attachment(target, &source)?;
                self.draw_to(encoder, target, &source);
            }
        }
        Ok(())
    }

    /// Draws over the whole of a render pass: one colour target of the pass's format and `source`'s size, no depth, one
    /// sample. A scissor rectangle of the user's holds. Pixels beyond `source` repeat its edge.
    ///
    /// # Errors
    /// If `source` cannot be read, as in [`FilmPass::encode`]. Nothing is drawn then. A render pass does not tell its format: whether
    /// that is the pass's is for wgpu to say, when the encoder finishes.
    pub fn draw(&self, pass: &mut RenderPass<'_>, source: &TextureView) -> Result<(), Error> {
        check_source(source)?;
        let source = self.draw.bind(&self.device, source)?;
        self.draw.draw(pass, &self.look, &source);
        Ok(())
    }

    /// The usage that [`FilmPass::encode`] needs a target to allow: `STORAGE_BINDING` or `RENDER_ATTACHMENT`.
    pub fn target_usage(&self) -> TextureUsages {
        if self.compute.is_some() { WriteMethod::Compute.usage() } else { WriteMethod::Draw.usage() }
    }

    /// The format of its targets' views, as it was made for.
    pub fn target_format(&self) -> TextureFormat {
        self.target.format()
    }

    /// The look on the GPU, as shaders of the user's can bind it and [`TableBake`](crate::TableBake) fill its table.
    pub fn look(&self) -> &BoundLook {
        &self.look
    }

    /// That wgpu takes the target's view as an attachment. It says so only when an encoder finishes, and spoils that encoder if
    /// not: here one of our own, which is never submitted.
    fn check_attachment(&self, target: &TextureView, source: &BindGroup) -> Result<(), Error> {
        checked(&self.device, Refused::Target, || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            self.draw_to(&mut encoder, target, source);
            drop(encoder.finish());
        })
    }

    fn draw_to(&self, encoder: &mut CommandEncoder, target: &TextureView, source: &BindGroup) {
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some("onelight"),
            color_attachments: &[Some(RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load: LoadOp::Clear(Color::BLACK), store: StoreOp::Store },
            })],
            ..Default::default()
        });
        self.draw.draw(&mut pass, &self.look, source);
    }
}
