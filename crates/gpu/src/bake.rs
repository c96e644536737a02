use onelight_lut::DirectForm;
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingResource,
    BindingType, BufferBindingType, CommandEncoder, ComputePassDescriptor, ComputePipeline, Device, Queue,
    ShaderStages, StorageTextureAccess, TextureViewDescriptor, TextureViewDimension,
};

use crate::bound::BoundLook;
use crate::error::{Error, ErrorKind};
use crate::form::FormKind;
use crate::pipeline::compute_pipeline;
use crate::settings::LookSettings;
use crate::shader;

/// Nodes of a work group along each side.
const GROUP: u32 = 4;

/// Fills the table of a plain look from a direct form, on the GPU: the look may change in every frame and still cost one
/// fetch a pixel.
///
/// The entries are the direct form's at the nodes of the plain look's shaper; half floats are rounded as the device does.
///
/// ```no_run
/// # fn frame(
/// #     device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder,
/// #     plain: &onelight_lut::PlainLut, direct: &onelight_lut::DirectForm, next: &onelight_lut::DirectForm,
/// # ) -> Result<(), onelight_gpu::Error> {
/// use onelight_gpu::{FilmPass, TableBake};
///
/// let film = FilmPass::new(device, queue, plain, wgpu::TextureFormat::Rgba8Unorm)?;
/// let bake = TableBake::new(device, queue, direct, film.look())?;
/// // In a frame whose look differs from the last one's, before `film.encode`.
/// bake.upload(queue, next)?;
/// bake.encode(encoder);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct TableBake {
    look: BoundLook,
    into: BindGroup,
    size: u32,
    pipeline: ComputePipeline,
}

impl TableBake {
    /// A bake of a direct form into the table of a plain look, which keeps its shaper.
    ///
    /// # Errors
    /// If `into` is not a plain look, the device has no compute shaders, or as [`BoundLook::upload`].
    pub fn new(device: &Device, queue: &Queue, form: &DirectForm, into: &BoundLook) -> Result<Self, Error> {
        let (FormKind::Plain, Some(table)) = (into.kind(), into.table()) else {
            return Err(ErrorKind::OtherForm { found: into.kind(), expected: FormKind::Plain }.into());
        };
        if device.limits().max_compute_invocations_per_workgroup < GROUP.pow(3) {
            return Err(ErrorKind::NoCompute.into());
        }
        let look = BoundLook::new(device, queue, form, &LookSettings::default())?;
        let format = table.texture.format();
        let entry = |binding, ty| BindGroupLayoutEntry { binding, visibility: ShaderStages::COMPUTE, ty, count: None };
        let uniform =
            BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
        let written = BindingType::StorageTexture {
            access: StorageTextureAccess::WriteOnly,
            format,
            view_dimension: TextureViewDimension::D3,
        };
        let layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor {
            label: Some("onelight bake"),
            entries: &[entry(0, uniform), entry(1, written)],
        });
        let view = table.texture.create_view(&TextureViewDescriptor::default());
        let into = device.create_bind_group(&BindGroupDescriptor {
            label: Some("onelight bake"),
            layout: &layout,
            entries: &[
                BindGroupEntry { binding: 0, resource: into.uniform().as_entire_binding() },
                BindGroupEntry { binding: 1, resource: BindingResource::TextureView(&view) },
            ],
        });
        let pipeline = compute_pipeline(device, shader::bake(format), "onelight_bake_table", &[look.layout(), &layout]);
        Ok(Self { look, into, size: table.size as u32, pipeline })
    }

    /// Uploads another direct form; see [`BoundLook::upload`].
    ///
    /// # Errors
    /// As there. The look that is there stays.
    pub fn upload(&self, queue: &Queue, form: &DirectForm) -> Result<(), Error> {
        self.look.upload(queue, form)
    }

    /// Fills the table, in the order of the encoder's other work: passes encoded after this one see the new entries.
    pub fn encode(&self, encoder: &mut CommandEncoder) {
        let groups = self.size.div_ceil(GROUP);
        let mut pass =
            encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("onelight bake"), ..Default::default() });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, self.look.bind_group(), &[]);
        pass.set_bind_group(1, &self.into, &[]);
        pass.dispatch_workgroups(groups, groups, groups);
    }
}
