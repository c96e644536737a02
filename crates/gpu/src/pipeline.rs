//! The two pipelines of a pass: each binds its textures, which is where wgpu looks at views, and then writes.

use std::borrow::Cow;

use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, ColorTargetState, CommandEncoder, ComputePassDescriptor, ComputePipeline,
    ComputePipelineDescriptor, Device, FragmentState, PipelineLayoutDescriptor, RenderPass, RenderPipeline,
    RenderPipelineDescriptor, ShaderModule, ShaderModuleDescriptor, ShaderSource, ShaderStages, StorageTextureAccess,
    TextureSampleType, TextureView, TextureViewDimension, VertexState,
};

use crate::bound::BoundLook;
use crate::check::checked;
use crate::error::{Error, Refused};
use crate::shader;
use crate::target::Target;

/// Pixels of a work group along each side, as `compute.wgsl` says.
const GROUP: u32 = 8;

/// Writes a target by a full-screen triangle in a render pass.
#[derive(Debug)]
pub(crate) struct DrawPipeline {
    source: BindGroupLayout,
    pipeline: RenderPipeline,
}

/// Writes a target from a compute shader.
#[derive(Debug)]
pub(crate) struct TexturePipeline {
    textures: BindGroupLayout,
    pipeline: ComputePipeline,
}

impl DrawPipeline {
    pub(crate) fn new(device: &Device, look: &BoundLook, target: Target) -> Self {
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

    pub(crate) fn bind(&self, device: &Device, source: &TextureView) -> Result<BindGroup, Error> {
        checked(device, Refused::Source, || {
            device.create_bind_group(&BindGroupDescriptor {
                label: Some("onelight source"),
                layout: &self.source,
                entries: &[texture_entry(0, source)],
            })
        })
    }

    pub(crate) fn draw(&self, pass: &mut RenderPass<'_>, look: &BoundLook, source: &BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, look.bind_group(), &[]);
        pass.set_bind_group(1, source, &[]);
        pass.draw(0..3, 0..1);
    }
}

impl TexturePipeline {
    /// None where the format has no compute shader.
    pub(crate) fn new(device: &Device, look: &BoundLook, target: Target) -> Option<Self> {
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

    pub(crate) fn bind(&self, device: &Device, source: &TextureView, target: &TextureView) -> Result<BindGroup, Error> {
        checked(device, Refused::SourceAndTarget, || {
            device.create_bind_group(&BindGroupDescriptor {
                label: Some("onelight source and target"),
                layout: &self.textures,
                entries: &[texture_entry(0, source), texture_entry(1, target)],
            })
        })
    }

    pub(crate) fn encode(
        &self,
        encoder: &mut CommandEncoder,
        look: &BoundLook,
        textures: &BindGroup,
        [width, height]: [u32; 2],
    ) {
        let mut pass =
            encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("onelight"), timestamp_writes: None });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, look.bind_group(), &[]);
        pass.set_bind_group(1, textures, &[]);
        pass.dispatch_workgroups(width.div_ceil(GROUP), height.div_ceil(GROUP), 1);
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

fn texture_entry(binding: u32, view: &TextureView) -> BindGroupEntry<'_> {
    BindGroupEntry { binding, resource: BindingResource::TextureView(view) }
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
