use half::f16;
use onelight_lut::{Lut1d, Lut3d, Storage};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, Buffer, BufferBindingType, BufferDescriptor, BufferUsages, Device, Extent3d,
    Features, FilterMode, Origin3d, Queue, SamplerBindingType, SamplerDescriptor, ShaderStages, TexelCopyBufferLayout,
    TexelCopyTextureInfo, Texture, TextureAspect, TextureDescriptor, TextureDimension, TextureFormat,
    TextureSampleType, TextureUsages, TextureViewDescriptor, TextureViewDimension,
};

use crate::error::{Error, Kind};
use crate::form::{Form, FormKind};
use crate::shader::Fetch;
use crate::uniform::{self, After, Words};

/// The most points that a form's curves may have.
pub const MAX_POINTS: usize = 2048;

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
    /// If the form does not fit (see [`BoundLook::swap`]), the storage is neither `F16` nor `F32`, or a table of 32-bit
    /// floats is to be filtered on a device that cannot.
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
        let kind = form.kind();
        let filtered = settings.fetch == Fetch::Filtered && kind != FormKind::Direct;
        let table = match table(form) {
            Some(table) => Some(Table::new(device, table.size(), settings.storage)?),
            None => None,
        };
        if filtered && settings.storage == Storage::F32 && !device.features().contains(Features::FLOAT32_FILTERABLE) {
            return Err(Kind::NotFilterable.into());
        }
        let points = (kind != FormKind::Plain).then(|| points_texture(device));
        let bytes = match kind {
            FormKind::Plain => uniform::PLAIN_BYTES,
            FormKind::Structured => uniform::STRUCTURED_BYTES,
            FormKind::Direct => uniform::DIRECT_BYTES,
        };
        let uniform = device.create_buffer(&BufferDescriptor {
            label: Some("onelight look"),
            size: bytes,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = layout(device, kind, filtered);
        let bind_group = bind_group(device, &layout, &uniform, table.as_ref(), points.as_ref(), filtered);
        let bound = Self { kind, settings: *settings, after, uniform, table, points, layout, bind_group };
        bound.swap(queue, form)?;
        Ok(bound)
    }

    /// Uploads another look into the same resources: no pipeline, no texture, no wait. It shows from the next submission on.
    ///
    /// # Errors
    /// If it has another form or another size of table; if a curve has more than [`MAX_POINTS`] points, a sum more than
    /// [`MAX_TERMS`](crate::MAX_TERMS) terms, an entry does not fit a half float, or steps of a curve leave the
    /// range of 32-bit floats. The resources then hold what they held.
    pub fn swap<'a>(&self, queue: &Queue, form: impl Into<Form<'a>>) -> Result<(), Error> {
        let form = form.into();
        if form.kind() != self.kind {
            return Err(Kind::OtherForm { found: form.kind(), expected: self.kind }.into());
        }
        let words = self.words(form)?;
        let entries = match (table(form), &self.table) {
            (Some(table), Some(to)) => Some((to, to.bytes(table)?)),
            _ => None,
        };
        let curves = curves(form).into_iter().flatten().map(|(row, curves)| Ok((row, curves.size(), points(curves)?)));
        let curves = curves.collect::<Result<Vec<_>, Error>>()?;
        // All is checked; nothing below fails.
        queue.write_buffer(&self.uniform, 0, &words.bytes());
        if let Some((to, bytes)) = entries {
            to.write(queue, &bytes);
        }
        for (row, size, bytes) in curves {
            if let Some(points) = &self.points {
                write(queue, points, [0, row, 0], [size as u32, 3, 1], 8, &bytes);
            }
        }
        Ok(())
    }

    /// The words of the uniform buffer.
    fn words(&self, form: Form<'_>) -> Result<Words, Error> {
        match form {
            Form::Plain(lut) => uniform::plain(lut, self.after),
            Form::Structured(lut) => uniform::structured(lut, self.after),
            Form::Direct(form) => uniform::direct(form, self.after),
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

fn table(form: Form<'_>) -> Option<&Lut3d> {
    match form {
        Form::Plain(lut) => Some(lut.table()),
        Form::Structured(lut) => Some(&lut.parts().table),
        Form::Direct(_) => None,
    }
}

/// The curves of a form with the first of their rows in the texture of points.
fn curves(form: Form<'_>) -> [Option<(u32, &Lut1d)>; 2] {
    let (first, second) = match form {
        Form::Plain(_) => return [None; 2],
        Form::Structured(lut) => (&lut.parts().curves, lut.parts().mix.as_ref().map(|mix| &mix.curves)),
        Form::Direct(form) => (&form.parts().curves, form.parts().print.as_ref().map(|print| &print.curves)),
    };
    [Some((0, first)), second.map(|second| (uniform::SECOND_ROW, second))]
}

fn points(curves: &Lut1d) -> Result<Vec<u8>, Error> {
    match curves.size() {
        found if found > MAX_POINTS => Err(Kind::Points { found, max: MAX_POINTS }.into()),
        _ => uniform::points(curves),
    }
}

impl Table {
    fn new(device: &Device, size: usize, storage: Storage) -> Result<Self, Error> {
        let format = match storage {
            Storage::F16 => TextureFormat::Rgba16Float,
            Storage::F32 => TextureFormat::Rgba32Float,
            found => return Err(Kind::Storage { found }.into()),
        };
        // To be baked into, where the device computes.
        let computes = device.limits().max_compute_invocations_per_workgroup >= 64;
        let baked = if computes { TextureUsages::STORAGE_BINDING } else { TextureUsages::empty() };
        let texture = device.create_texture(&TextureDescriptor {
            label: Some("onelight table"),
            size: Extent3d { width: size as u32, height: size as u32, depth_or_array_layers: size as u32 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D3,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC | baked,
            view_formats: &[],
        });
        Ok(Self { texture, size })
    }

    fn bytes(&self, table: &Lut3d) -> Result<Vec<u8>, Error> {
        if table.size() != self.size {
            return Err(Kind::TableSize { found: table.size(), expected: self.size }.into());
        }
        let entries = table.entries();
        if self.texture.format() == TextureFormat::Rgba32Float {
            let texels = entries.iter().flat_map(|&[r, g, b]| [r, g, b, 1.0]);
            return Ok(texels.flat_map(f32::to_ne_bytes).collect());
        }
        if let Some(&found) = entries.iter().flatten().find(|v| f16::from_f32(**v).is_infinite()) {
            return Err(Kind::Half { found }.into());
        }
        let texels = entries.iter().flat_map(|&[r, g, b]| [r, g, b, 1.0]);
        Ok(texels.flat_map(|v| f16::from_f32(v).to_ne_bytes()).collect())
    }

    fn write(&self, queue: &Queue, bytes: &[u8]) {
        let texel = self.texture.format().block_copy_size(None).unwrap_or(0);
        write(queue, &self.texture, [0; 3], [self.size as u32; 3], texel, bytes);
    }
}

fn write(queue: &Queue, texture: &Texture, [x, y, z]: [u32; 3], size: [u32; 3], texel: u32, bytes: &[u8]) {
    let [width, height, depth_or_array_layers] = size;
    let to = TexelCopyTextureInfo { texture, mip_level: 0, origin: Origin3d { x, y, z }, aspect: TextureAspect::All };
    let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * texel), rows_per_image: Some(height) };
    queue.write_texture(to, bytes, layout, Extent3d { width, height, depth_or_array_layers });
}

/// Values and rises of up to six curves, one a row.
fn points_texture(device: &Device) -> Texture {
    device.create_texture(&TextureDescriptor {
        label: Some("onelight curves"),
        size: Extent3d { width: MAX_POINTS as u32, height: 2 * uniform::SECOND_ROW, depth_or_array_layers: 1 },
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
