//! The pass that does nothing but read and write: the floor of every other.

use onelight_gpu::wgpu;
use wgpu::{
    BindGroupDescriptor, BindGroupEntry, BindingResource, Color, ColorTargetState, CommandEncoder, ComputePipeline,
    ComputePipelineDescriptor, FragmentState, LoadOp, Operations, RenderPassColorAttachment, RenderPassDescriptor,
    RenderPipeline, RenderPipelineDescriptor, ShaderModuleDescriptor, ShaderSource, StoreOp, TextureFormat,
    TextureView, VertexState,
};

use super::card::Card;

/// A copy by the way that a film pass takes for the same format.
pub(super) enum Copy {
    Compute(ComputePipeline),
    Draw(RenderPipeline),
}

impl Copy {
    pub(super) fn new(card: &Card, target: TextureFormat) -> Self {
        let compute = |text: &str| {
            Self::Compute(card.gpu.device.create_compute_pipeline(&ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &card.gpu.device.create_shader_module(shader(text)),
                entry_point: None,
                compilation_options: Default::default(),
                cache: None,
            }))
        };
        match target {
            TextureFormat::Rgba8Unorm => compute(include_str!("copy_compute_8.wgsl")),
            TextureFormat::Rgba16Float => compute(include_str!("copy_compute_16.wgsl")),
            _ => Self::draw(card, target),
        }
    }

    fn draw(card: &Card, target: TextureFormat) -> Self {
        let module = card.gpu.device.create_shader_module(shader(include_str!("copy_draw.wgsl")));
        Self::Draw(card.gpu.device.create_render_pipeline(&RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: VertexState {
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(FragmentState {
                module: &module,
                entry_point: None,
                compilation_options: Default::default(),
                targets: &[Some(ColorTargetState::from(target))],
            }),
            multiview_mask: None,
            cache: None,
        }))
    }

    pub(super) fn encode(&self, card: &Card, encoder: &mut CommandEncoder, from: &TextureView, to: &TextureView) {
        let entry = |binding, view| BindGroupEntry { binding, resource: BindingResource::TextureView(view) };
        match self {
            Self::Compute(pipeline) => {
                let layout = pipeline.get_bind_group_layout(0);
                let entries = [entry(0, from), entry(1, to)];
                let descriptor = BindGroupDescriptor { label: None, layout: &layout, entries: &entries };
                let textures = card.gpu.device.create_bind_group(&descriptor);
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &textures, &[]);
                pass.dispatch_workgroups(to.texture().width().div_ceil(8), to.texture().height().div_ceil(8), 1);
            }
            Self::Draw(pipeline) => {
                let layout = pipeline.get_bind_group_layout(0);
                let entries = [entry(0, from)];
                let descriptor = BindGroupDescriptor { label: None, layout: &layout, entries: &entries };
                let textures = card.gpu.device.create_bind_group(&descriptor);
                let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
                    color_attachments: &[Some(RenderPassColorAttachment {
                        view: to,
                        depth_slice: None,
                        resolve_target: None,
                        ops: Operations { load: LoadOp::Clear(Color::BLACK), store: StoreOp::Store },
                    })],
                    ..Default::default()
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &textures, &[]);
                pass.draw(0..3, 0..1);
            }
        }
    }
}

fn shader(text: &str) -> ShaderModuleDescriptor<'_> {
    ShaderModuleDescriptor { label: None, source: ShaderSource::Wgsl(text.into()) }
}
