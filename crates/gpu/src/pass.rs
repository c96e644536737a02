use std::borrow::Cow;

use wgpu::{
    BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Color, ColorTargetState, CommandEncoder, ComputePassDescriptor, ComputePipeline,
    ComputePipelineDescriptor, Device, FragmentState, LoadOp, Operations, PipelineLayoutDescriptor, Queue, RenderPass,
    RenderPassColorAttachment, RenderPassDescriptor, RenderPipeline, RenderPipelineDescriptor, ShaderModule,
    ShaderModuleDescriptor, ShaderSource, ShaderStages, StorageTextureAccess, StoreOp, TextureFormat,
    TextureSampleType, TextureUsages, TextureView, TextureViewDimension, VertexState,
};

use crate::MAX_SIDE;
use crate::bound::{BoundLook, LookSettings};
use crate::error::{Error, Kind};
use crate::form::Form;
use crate::shader;
use crate::target::{Target, Way};
use crate::uniform::After;

/// Pixels of a work group along each side.
const GROUP: u32 = 8;

/// One look, ready to be applied to textures in the user's own frame.
///
/// Scene-linear RGB is read pixel by pixel from a texture of floats (`Rgba16Float`, `Rgba32Float`, or any other that
/// WGSL reads as `f32`), at its first mip level. What the form yields is written to a target of the same size:
///
/// | format | written by [`FilmPass::encode`] |
/// |---|---|
/// | `Rgba8Unorm`, `Rgba16Float`, `Rgba32Float` | compute; a draw where the device does not compute |
/// | `Rgba8UnormSrgb`, `Bgra8Unorm`, `Bgra8UnormSrgb`, `Rgb10a2Unorm` | a draw: WebGPU lets no shader write them |
///
/// Through a view with `Srgb` the same bytes are stored as without: display-coded values are decoded for the target to
/// encode. Only forms that yield linear light (`PowerCoding::LINEAR`) have theirs encoded by the target.
#[derive(Debug)]
pub struct FilmPass {
    device: Device,
    look: BoundLook,
    target: Target,
    draw: Drawn,
    compute: Option<Computed>,
}

#[derive(Debug)]
struct Drawn {
    source: BindGroupLayout,
    pipeline: RenderPipeline,
}

#[derive(Debug)]
struct Computed {
    textures: BindGroupLayout,
    pipeline: ComputePipeline,
}

impl FilmPass {
    /// A pass for one form and one format of target, with [`LookSettings::default`].
    ///
    /// # Errors
    /// As [`FilmPass::with_settings`].
    pub fn new<'a>(
        device: &Device,
        queue: &Queue,
        form: impl Into<Form<'a>>,
        target: TextureFormat,
    ) -> Result<Self, Error> {
        Self::with_settings(device, queue, form, target, &LookSettings::default())
    }

    /// A pass for one form and one format of target.
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
        let after = if matches!(target, Target::Srgb(_)) { After::Encoded } else { After::Stored };
        let look = BoundLook::before(device, queue, form.into(), settings, after)?;
        let draw = Drawn::new(device, &look, target);
        let compute = match target.way(device) {
            Way::Compute => Computed::new(device, &look, target),
            Way::Draw => None,
        };
        Ok(Self { device: device.clone(), look, target, draw, compute })
    }

    /// Uploads another look of the same form into the resources that are there: no pipeline, no texture, no wait. It shows
    /// from the next submission on.
    ///
    /// # Errors
    /// As [`BoundLook::swap`].
    pub fn swap<'a>(&self, queue: &Queue, form: impl Into<Form<'a>>) -> Result<(), Error> {
        self.look.swap(queue, form)
    }

    /// Develops `source` into `target`, which allows [`FilmPass::target_usage`].
    ///
    /// # Errors
    /// If the textures differ in size, are larger than [`MAX_SIDE`], or `target` has another format than the pass was made
    /// for. Nothing is encoded then.
    pub fn encode(
        &self,
        encoder: &mut CommandEncoder,
        source: &TextureView,
        target: &TextureView,
    ) -> Result<(), Error> {
        self.check(source, target)?;
        match &self.compute {
            Some(compute) => compute.encode(&self.device, &self.look, encoder, source, target),
            None => {
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
                self.draw.draw(&self.device, &self.look, &mut pass, source);
            }
        }
        Ok(())
    }

    /// Draws over the whole of a render pass: one colour target of the pass's format and `source`'s size, no depth, one
    /// sample. A scissor rectangle of the user's holds. Pixels beyond `source` repeat its edge.
    ///
    /// # Errors
    /// If `source` is larger than [`MAX_SIDE`]. Nothing is drawn then.
    pub fn draw(&self, pass: &mut RenderPass<'_>, source: &TextureView) -> Result<(), Error> {
        let texture = source.texture();
        check_side(texture.width(), texture.height())?;
        self.draw.draw(&self.device, &self.look, pass, source);
        Ok(())
    }

    /// What [`FilmPass::encode`] needs a target to allow.
    pub fn target_usage(&self) -> TextureUsages {
        if self.compute.is_some() { Way::Compute.usage() } else { Way::Draw.usage() }
    }

    /// The format of its targets.
    pub fn target_format(&self) -> TextureFormat {
        self.target.format()
    }

    /// Its look, to be bound to shaders of the user's.
    pub fn look(&self) -> &BoundLook {
        &self.look
    }

    fn check(&self, source: &TextureView, target: &TextureView) -> Result<(), Error> {
        let (from, to) = (source.texture(), target.texture());
        let sizes = [from, to].map(|texture| [texture.width(), texture.height()]);
        for [width, height] in sizes {
            check_side(width, height)?;
        }
        if sizes[0] != sizes[1] {
            return Err(Kind::Sizes { from: sizes[0], to: sizes[1] }.into());
        }
        let (found, expected) = (to.format(), self.target.format());
        // Views may add or take away the sRGB curve.
        if found.remove_srgb_suffix() != expected.remove_srgb_suffix() {
            return Err(Kind::OtherTarget { found, expected }.into());
        }
        Ok(())
    }
}

fn check_side(width: u32, height: u32) -> Result<(), Error> {
    if width.max(height) > MAX_SIDE { Err(Kind::Side { width, height }.into()) } else { Ok(()) }
}

impl Drawn {
    fn new(device: &Device, look: &BoundLook, target: Target) -> Self {
        let source = device.create_bind_group_layout(&BindGroupLayoutDescriptor {
            label: Some("onelight source"),
            entries: &[source_entry(ShaderStages::FRAGMENT)],
        });
        let module = module(device, shader::draw(look.kind(), look.settings().fetch, target));
        let pipeline = device.create_render_pipeline(&RenderPipelineDescriptor {
            label: Some("onelight draw"),
            layout: Some(&device.create_pipeline_layout(&PipelineLayoutDescriptor {
                label: Some("onelight draw"),
                bind_group_layouts: &[Some(look.layout()), Some(&source)],
                immediate_size: 0,
            })),
            vertex: VertexState {
                module: &module,
                entry_point: Some("onelight_vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(FragmentState {
                module: &module,
                entry_point: Some("onelight_fragment"),
                compilation_options: Default::default(),
                targets: &[Some(ColorTargetState::from(target.format()))],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { source, pipeline }
    }

    fn draw(&self, device: &Device, look: &BoundLook, pass: &mut RenderPass<'_>, source: &TextureView) {
        let textures = device.create_bind_group(&BindGroupDescriptor {
            label: Some("onelight source"),
            layout: &self.source,
            entries: &[BindGroupEntry { binding: 0, resource: BindingResource::TextureView(source) }],
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, look.bind_group(), &[]);
        pass.set_bind_group(1, &textures, &[]);
        pass.draw(0..3, 0..1);
    }
}

impl Computed {
    /// None where the format has no compute shader.
    fn new(device: &Device, look: &BoundLook, target: Target) -> Option<Self> {
        let text = shader::compute(look.kind(), look.settings().fetch, target)?;
        let written = BindGroupLayoutEntry {
            binding: 1,
            visibility: ShaderStages::COMPUTE,
            ty: BindingType::StorageTexture {
                access: StorageTextureAccess::WriteOnly,
                format: target.format(),
                view_dimension: TextureViewDimension::D2,
            },
            count: None,
        };
        let textures = device.create_bind_group_layout(&BindGroupLayoutDescriptor {
            label: Some("onelight source and target"),
            entries: &[source_entry(ShaderStages::COMPUTE), written],
        });
        let pipeline = compute_pipeline(device, text, "onelight_compute", &[look.layout(), &textures]);
        Some(Self { textures, pipeline })
    }

    fn encode(
        &self,
        device: &Device,
        look: &BoundLook,
        encoder: &mut CommandEncoder,
        source: &TextureView,
        target: &TextureView,
    ) {
        let textures = device.create_bind_group(&BindGroupDescriptor {
            label: Some("onelight source and target"),
            layout: &self.textures,
            entries: &[
                BindGroupEntry { binding: 0, resource: BindingResource::TextureView(source) },
                BindGroupEntry { binding: 1, resource: BindingResource::TextureView(target) },
            ],
        });
        let size = target.texture();
        let mut pass =
            encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("onelight"), timestamp_writes: None });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, look.bind_group(), &[]);
        pass.set_bind_group(1, &textures, &[]);
        pass.dispatch_workgroups(size.width().div_ceil(GROUP), size.height().div_ceil(GROUP), 1);
    }
}

fn source_entry(visibility: ShaderStages) -> BindGroupLayoutEntry {
    BindGroupLayoutEntry {
        binding: 0,
        visibility,
        ty: BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable: false },
            view_dimension: TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

pub(crate) fn compute_pipeline(
    device: &Device,
    text: String,
    entry: &str,
    layouts: &[&BindGroupLayout],
) -> ComputePipeline {
    let layouts: Vec<_> = layouts.iter().copied().map(Some).collect();
    device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: Some("onelight"),
        layout: Some(&device.create_pipeline_layout(&PipelineLayoutDescriptor {
            label: Some("onelight"),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        })),
        module: &module(device, text),
        entry_point: Some(entry),
        compilation_options: Default::default(),
        cache: None,
    })
}

fn module(device: &Device, text: String) -> ShaderModule {
    device.create_shader_module(ShaderModuleDescriptor {
        label: Some("onelight"),
        source: ShaderSource::Wgsl(Cow::Owned(text)),
    })
}
