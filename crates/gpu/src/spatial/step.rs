//! One dispatch of a compute shader, with all that it is bound to.

use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Buffer, BufferBindingType, ComputePass, ComputePipeline, Device, ShaderStages,
    StorageTextureAccess, TextureFormat, TextureSampleType, TextureView, TextureViewDimension,
};

/// Pixels of a work group along each side, as the shaders say.
const GROUP: u32 = 8;

/// What a binding holds.
#[derive(Clone, Copy)]
pub(super) enum Slot<'a> {
    Uniform(&'a Buffer),
    Numbers(&'a Buffer),
    Floats(&'a TextureView),
    Integers(&'a TextureView),
    Written(&'a TextureView, TextureFormat),
}

impl<'a> Slot<'a> {
    fn kind(self) -> BindingType {
        let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
        let texture = |sample_type| BindingType::Texture {
            sample_type,
            view_dimension: TextureViewDimension::D2,
            multisampled: false,
        };
        match self {
            Self::Uniform(_) => buffer(BufferBindingType::Uniform),
            Self::Numbers(_) => buffer(BufferBindingType::Storage { read_only: true }),
            Self::Floats(_) => texture(TextureSampleType::Float { filterable: false }),
            Self::Integers(_) => texture(TextureSampleType::Sint),
            Self::Written(_, format) => BindingType::StorageTexture {
                access: StorageTextureAccess::WriteOnly,
                format,
                view_dimension: TextureViewDimension::D2,
            },
        }
    }

    fn resource(self) -> BindingResource<'a> {
        match self {
            Self::Uniform(buffer) | Self::Numbers(buffer) => buffer.as_entire_binding(),
            Self::Floats(view) | Self::Integers(view) | Self::Written(view, _) => BindingResource::TextureView(view),
        }
    }
}

pub(super) fn layout(device: &Device, slots: &[Slot<'_>]) -> BindGroupLayout {
    let entry = |(binding, slot): (u32, &Slot<'_>)| BindGroupLayoutEntry {
        binding,
        visibility: ShaderStages::COMPUTE,
        ty: slot.kind(),
        count: None,
    };
    let entries: Vec<_> = (0..).zip(slots).map(entry).collect();
    device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some("onelight step"), entries: &entries })
}

pub(super) fn group(device: &Device, layout: &BindGroupLayout, slots: &[Slot<'_>]) -> BindGroup {
    let slots = (0..).zip(slots.iter().copied());
    let entries: Vec<_> = slots.map(|(binding, slot)| BindGroupEntry { binding, resource: slot.resource() }).collect();
    device.create_bind_group(&BindGroupDescriptor { label: Some("onelight step"), layout, entries: &entries })
}

/// A step that binds neither the look nor the user's textures.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) pipeline: ComputePipeline,
    pub(super) group: BindGroup,
    pub(super) size: [u32; 2],
}

impl Step {
    pub(super) fn run(&self, pass: &mut ComputePass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        dispatch(pass, self.size);
    }
}

pub(super) fn dispatch(pass: &mut ComputePass<'_>, [width, height]: [u32; 2]) {
    pass.dispatch_workgroups(width.div_ceil(GROUP), height.div_ceil(GROUP), 1);
}
