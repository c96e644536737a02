use onelight_lut::Storage;
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Buffer, BufferBindingType, BufferDescriptor, BufferUsages, Device, Extent3d,
    Features, FilterMode, Origin3d, Queue, SamplerBindingType, SamplerDescriptor, ShaderStages, TexelCopyBufferLayout,
    TexelCopyTextureInfo, Texture, TextureAspect, TextureDescriptor, TextureDimension, TextureFormat,
    TextureSampleType, TextureUsages, TextureViewDescriptor, TextureViewDimension,
};

use crate::bytes::{CURVE_ROWS, LookBytes, MAX_POINTS, TableBytes};
use crate::error::{Error, Kind};
use crate::form::{Form, FormKind};
use crate::shader::Fetch;
use crate::uniform::After;

/// How a look's table is kept and read; nothing to a direct form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LookSettings {
    /// How it is read.
    pub fetch: Fetch,
    /// What the entries of its texture are: [`Storage::F16`] or [`Storage::F32`]. The CPU's twin of a stored table is
    /// [`Storage::stored`].
    pub storage: Storage,
}

impl Default for LookSettings {
    /// Single texels of half floats.
    fn default() -> Self {
        Self { fetch: Fetch::Texels, storage: Storage::F16 }
    }
}

/// A look's numbers on the GPU: what the shader text of [`wgsl`](crate::wgsl) reads.
#[derive(Debug)]
pub struct BoundLook {
    kind: FormKind,
    settings: LookSettings,
    after: After,
    uniform: Buffer,
    table: Option<Table>,
    points: Option<Texture>,
    layout: BindGroupLayout,
    bind_group: BindGroup,
}

/// The texture of a table.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) texture: Texture,
    pub(crate) size: usize,
}

impl BoundLook {
    /// Makes the resources for a form and uploads it.
    ///
    /// # Errors
    /// As [`LookBytes::new`], or if a table of 32-bit floats is to be filtered on a device that cannot.
    pub fn new<'a>(
        device: &Device,
        queue: &Queue,
        form: impl Into<Form<'a>>,
        settings: &LookSettings,
    ) -> Result<Self, Error> {
        Self::before(device, queue, form.into(), settings, After::Stored)
    }

    /// The same for a target that may encode.
    pub(crate) fn before(
        device: &Device,
        queue: &Queue,
        form: Form<'_>,
        settings: &LookSettings,
        after: After,
    ) -> Result<Self, Error> {
        let look = LookBytes::before(form, settings.storage, after)?;
        let table = look.table.as_ref().map(|table| Table::new(device, table));
        let filtered = settings.fetch == Fetch::Filtered && table.is_some();
        if filtered && settings.storage == Storage::F32 && !device.features().contains(Features::FLOAT32_FILTERABLE) {
            return Err(Kind::NotFilterable.into());
        }
        let points = (!look.curves.is_empty()).then(|| points_texture(device));
        let uniform = device.create_buffer(&BufferDescriptor {
            label: Some("onelight look"),
            size: look.uniform.len() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = layout(device, look.kind, filtered);
        let bind_group = bind_group(device, &layout, &uniform, table.as_ref(), points.as_ref(), filtered);
        let bound = Self { kind: look.kind, settings: *settings, after, uniform, table, points, layout, bind_group };
        bound.write(queue, &look);
        Ok(bound)
    }

    /// Uploads another look into the same resources: no pipeline, no texture, no wait. It shows from the next submission on.
    ///
    /// # Errors
    /// If it has another form or another size of table, or as [`LookBytes::new`]. The resources then hold what they held.
    pub fn swap<'a>(&self, queue: &Queue, form: impl Into<Form<'a>>) -> Result<(), Error> {
        let form = form.into();
        if form.kind() != self.kind {
            return Err(Kind::OtherForm { found: form.kind(), expected: self.kind }.into());
        }
        let look = LookBytes::before(form, self.settings.storage, self.after)?;
        if let (Some(new), Some(table)) = (&look.table, &self.table)
            && new.size != table.size
        {
            return Err(Kind::TableSize { found: new.size, expected: table.size }.into());
        }
        self.write(queue, &look);
        Ok(())
    }

    fn write(&self, queue: &Queue, look: &LookBytes) {
        queue.write_buffer(&self.uniform, 0, &look.uniform);
        if let (Some(new), Some(table)) = (&look.table, &self.table) {
            write(queue, &table.texture, [0; 3], [new.size as u32; 3], &new.bytes);
        }
        for curves in &look.curves {
            if let Some(points) = &self.points {
                write(queue, points, [0, curves.row, 0], [curves.points as u32, 3, 1], &curves.bytes);
            }
        }
    }

    /// Which form it holds.
    pub fn kind(&self) -> FormKind {
        self.kind
    }

    /// How its table is kept and read.
    pub fn settings(&self) -> &LookSettings {
        &self.settings
    }

    /// The layout of [`BoundLook::bind_group`], for pipelines of the user's: uniform buffer 0, table 1, points of curves 2,
    /// filter 3, as far as the form has them; for compute and fragment shaders.
    pub fn layout(&self) -> &BindGroupLayout {
        &self.layout
    }

    /// The resources, to be set as the group that the shader text names.
    pub fn bind_group(&self) -> &BindGroup {
        &self.bind_group
    }

    pub(crate) fn uniform(&self) -> &Buffer {
        &self.uniform
    }

    pub(crate) fn table(&self) -> Option<&Table> {
        self.table.as_ref()
    }
}

impl Table {
    fn new(device: &Device, table: &TableBytes) -> Self {
        let side = table.size as u32;
        // To be baked into, where the device computes.
        let computes = device.limits().max_compute_invocations_per_workgroup >= 64;
        let baked = if computes { TextureUsages::STORAGE_BINDING } else { TextureUsages::empty() };
        let texture = device.create_texture(&TextureDescriptor {
            label: Some("onelight table"),
            size: Extent3d { width: side, height: side, depth_or_array_layers: side },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D3,
            format: if table.storage == Storage::F16 { TextureFormat::Rgba16Float } else { TextureFormat::Rgba32Float },
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC | baked,
            view_formats: &[],
        });
        Self { texture, size: table.size }
    }
}

fn write(queue: &Queue, texture: &Texture, [x, y, z]: [u32; 3], size: [u32; 3], bytes: &[u8]) {
    let texel = texture.format().block_copy_size(None).unwrap_or(0);
    let [width, height, depth_or_array_layers] = size;
    let to = TexelCopyTextureInfo { texture, mip_level: 0, origin: Origin3d { x, y, z }, aspect: TextureAspect::All };
    let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * texel), rows_per_image: Some(height) };
    queue.write_texture(to, bytes, layout, Extent3d { width, height, depth_or_array_layers });
}

/// Values and rises of up to six curves, one a row.
fn points_texture(device: &Device) -> Texture {
    device.create_texture(&TextureDescriptor {
        label: Some("onelight curves"),
        size: Extent3d { width: MAX_POINTS as u32, height: CURVE_ROWS, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format: TextureFormat::Rg32Float,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn layout(device: &Device, kind: FormKind, filtered: bool) -> BindGroupLayout {
    let visibility = ShaderStages::FRAGMENT | ShaderStages::COMPUTE;
    let entry = |binding, ty| BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let texture = |view_dimension, filterable| BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable },
        view_dimension,
        multisampled: false,
    };
    let uniform =
        BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let mut entries = vec![entry(0, uniform)];
    if kind != FormKind::Direct {
        entries.push(entry(1, texture(TextureViewDimension::D3, filtered)));
    }
    if kind != FormKind::Plain {
        entries.push(entry(2, texture(TextureViewDimension::D2, false)));
    }
    if filtered {
        entries.push(entry(3, BindingType::Sampler(SamplerBindingType::Filtering)));
    }
    device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some("onelight look"), entries: &entries })
}

fn bind_group(
    device: &Device,
    layout: &BindGroupLayout,
    uniform: &Buffer,
    table: Option<&Table>,
    points: Option<&Texture>,
    filtered: bool,
) -> BindGroup {
    let view = |texture: &Texture| texture.create_view(&TextureViewDescriptor::default());
    let table = table.map(|table| view(&table.texture));
    let points = points.map(view);
    let sampler = filtered.then(|| {
        device.create_sampler(&SamplerDescriptor {
            label: Some("onelight filter"),
            mag_filter: FilterMode::Linear,
            min_filter: FilterMode::Linear,
            ..Default::default()
        })
    });
    let resources = [
        Some(uniform.as_entire_binding()),
        table.as_ref().map(BindingResource::TextureView),
        points.as_ref().map(BindingResource::TextureView),
        sampler.as_ref().map(BindingResource::Sampler),
    ];
    let entries =
        (0..).zip(resources).filter_map(|(binding, resource)| Some(BindGroupEntry { binding, resource: resource? }));
    let entries: Vec<_> = entries.collect();
    device.create_bind_group(&BindGroupDescriptor { label: Some("onelight look"), layout, entries: &entries })
}
