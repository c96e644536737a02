use onelight_lut::{Lut3d, Storage};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Buffer, BufferBindingType, BufferDescriptor, BufferUsages, Device, Extent3d,
    Features, FilterMode, Limits, Origin3d, Queue, SamplerBindingType, SamplerDescriptor, ShaderStages,
    TexelCopyBufferLayout, TexelCopyTextureInfo, Texture, TextureAspect, TextureDescriptor, TextureDimension,
    TextureFormat, TextureSampleType, TextureUsages, TextureViewDescriptor, TextureViewDimension,
};

use crate::bytes::{CURVE_ROWS, LookBytes, MAX_POINTS, TableBytes};
use crate::error::{Error, ErrorKind};
use crate::form::{Form, FormKind};
use crate::settings::{Fetch, LookSettings};
use crate::target::TargetCoding;

/// A look's numbers on the GPU: what the shader text of [`wgsl`](crate::wgsl) reads.
///
/// ```no_run
/// use onelight_gpu::{Bindings, BoundLook, Headless, LookSettings, wgsl};
///
/// let gpu = Headless::open(&Default::default())?;
/// let form = onelight::Process::default().compile()?.direct(&Default::default())?;
/// let settings = LookSettings { bindings: Bindings { group: 1, first: 0 }, ..Default::default() };
/// let look = BoundLook::new(&gpu.device, &gpu.queue, &form, &settings)?;
/// // The text calls `onelight_develop(rgb)`; the pipeline's layout has `look.layout()` at group 1, and each pass calls
/// // `pass.set_bind_group(1, look.bind_group(), &[])`.
/// let shader = format!("{}\n{}", wgsl(look.kind(), &settings), "/* the engine's own shader */");
/// # let _ = shader;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct BoundLook {
    kind: FormKind,
    settings: LookSettings,
    target: TargetCoding,
    uniform: Buffer,
    table: Option<Table>,
    points: Option<Texture>,
    layout: BindGroupLayout,
    bind_group: BindGroup,
}

/// A table's texture, with its nodes a side.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) texture: Texture,
    pub(crate) size: usize,
}

impl BoundLook {
    /// Makes the resources for a form and uploads it.
    ///
    /// # Errors
    /// As [`LookBytes::new`], or if the device has no bindings of those numbers, no 3D textures of the table's size, or no filter for
    /// 32-bit floats and the settings ask for one.
    pub fn new<'a>(
        device: &Device,
        queue: &Queue,
        form: impl Into<Form<'a>>,
        settings: &LookSettings,
    ) -> Result<Self, Error> {
        Self::for_target(device, queue, form.into(), settings, TargetCoding::Stored)
    }

    /// [`BoundLook::new`] for a target that may encode what is stored in it.
    pub(crate) fn for_target(
        device: &Device,
        queue: &Queue,
        form: Form<'_>,
        settings: &LookSettings,
        target: TargetCoding,
    ) -> Result<Self, Error> {
        check_limits(&device.limits(), form, settings)?;
        let look = LookBytes::for_target(form, settings.storage, target)?;
        let table = look.table.as_ref().map(|table| Table::new(device, table));
        let filtered = settings.fetch == Fetch::Filtered && table.is_some();
        if filtered && settings.storage == Storage::F32 && !device.features().contains(Features::FLOAT32_FILTERABLE) {
            return Err(ErrorKind::NotFilterable.into());
        }
        let points = (!look.curves.is_empty()).then(|| points_texture(device));
        let uniform = device.create_buffer(&BufferDescriptor {
            label: Some("onelight look"),
            size: look.uniform.len() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = layout(device, look.kind, filtered, settings.bindings.first);
        let bind_group =
            bind_group(device, &layout, settings.bindings.first, &uniform, table.as_ref(), points.as_ref(), filtered);
        let bound = Self { kind: look.kind, settings: *settings, target, uniform, table, points, layout, bind_group };
        bound.write_all(queue, &look);
        Ok(bound)
    }

    /// Uploads another look into the same resources: no pipeline, no texture, no wait. It shows from the next submission on.
    ///
    /// # Errors
    /// If it has another form or another size of table, or as [`LookBytes::new`]. The resources then hold what they held.
    pub fn upload<'a>(&self, queue: &Queue, form: impl Into<Form<'a>>) -> Result<(), Error> {
        let form = form.into();
        if form.kind() != self.kind {
            return Err(ErrorKind::OtherForm { found: form.kind(), expected: self.kind }.into());
        }
        let look = LookBytes::for_target(form, self.settings.storage, self.target)?;
        if let (Some(new), Some(table)) = (&look.table, &self.table)
            && new.size != table.size
        {
            return Err(ErrorKind::TableSize { found: new.size, expected: table.size }.into());
        }
        self.write_all(queue, &look);
        Ok(())
    }

    fn write_all(&self, queue: &Queue, look: &LookBytes) {
        queue.write_buffer(&self.uniform, 0, &look.uniform);
        if let (Some(new), Some(table)) = (&look.table, &self.table) {
            write_texels(queue, &table.texture, [0; 3], [new.size as u32; 3], &new.bytes);
        }
        for curves in &look.curves {
            if let Some(points) = &self.points {
                write_texels(queue, points, [0, curves.row, 0], [curves.points as u32, 3, 1], &curves.bytes);
            }
        }
    }

    /// Which of the three forms it holds.
    pub fn kind(&self) -> FormKind {
        self.kind
    }

    /// How its table is stored and read, and where a shader finds it.
    pub fn settings(&self) -> &LookSettings {
        &self.settings
    }

    /// The layout of [`BoundLook::bind_group`], for pipelines of the user's: uniform buffer, table, points of curves and filter, as
    /// far as the form has them, from [`Bindings::first`](crate::Bindings::first) on; for compute and fragment shaders.
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

/// That the device can hold what is about to be made.
fn check_limits(limits: &Limits, form: Form<'_>, settings: &LookSettings) -> Result<(), Error> {
    let max = limits.max_bindings_per_bind_group.saturating_sub(4);
    if settings.bindings.first > max {
        return Err(ErrorKind::Binding { found: settings.bindings.first, max }.into());
    }
    let (found, max) = (form.table().map_or(0, Lut3d::size), limits.max_texture_dimension_3d);
    if found > max as usize { Err(ErrorKind::TableLimit { found, max }.into()) } else { Ok(()) }
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

fn write_texels(queue: &Queue, texture: &Texture, [x, y, z]: [u32; 3], size: [u32; 3], bytes: &[u8]) {
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

fn layout(device: &Device, kind: FormKind, filtered: bool, first: u32) -> BindGroupLayout {
    let visibility = ShaderStages::FRAGMENT | ShaderStages::COMPUTE;
    let entry = |offset, ty| BindGroupLayoutEntry { binding: first + offset, visibility, ty, count: None };
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
    first: u32,
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
    let entries = (first..)
        .zip(resources)
        .filter_map(|(binding, resource)| Some(BindGroupEntry { binding, resource: resource? }));
    let entries: Vec<_> = entries.collect();
    device.create_bind_group(&BindGroupDescriptor { label: Some("onelight look"), layout, entries: &entries })
}
