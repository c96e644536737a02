//! Pictures to textures, through a pass, and back.

use half::f16;
use onelight_gpu::FilmPass;
use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoder, Extent3d, LoadOp, MapMode, Operations, PollType,
    RenderPassColorAttachment, RenderPassDescriptor, StoreOp, TexelCopyBufferInfo, TexelCopyBufferLayout, Texture,
    TextureDescriptor, TextureDimension, TextureFormat, TextureUsages,
};

use crate::adapter::Gpu;

pub(crate) fn texture(gpu: &Gpu, size: [u32; 2], format: TextureFormat, usage: TextureUsages) -> Texture {
    gpu.device.create_texture(&TextureDescriptor {
        label: None,
        size: extent(size),
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// A texture of `Rgba32Float` or `Rgba16Float` with these pixels.
pub(crate) fn source(gpu: &Gpu, size: [u32; 2], format: TextureFormat, pixels: &[[f32; 4]]) -> Texture {
    let bytes: Vec<u8> = match format {
        TextureFormat::Rgba16Float => pixels.iter().flatten().flat_map(|&v| f16::from_f32(v).to_ne_bytes()).collect(),
        _ => pixels.iter().flatten().flat_map(|v| v.to_ne_bytes()).collect(),
    };
    let texture = texture(gpu, size, format, TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST);
    gpu.queue.write_texture(texture.as_image_copy(), &bytes, row_layout(&texture), extent(size));
    texture
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    Encode,
    Draw,
}

/// `source` through a pass; the bytes of the target.
pub(crate) fn develop(gpu: &Gpu, pass: &FilmPass, source: &Texture, way: Way) -> Vec<u8> {
    let size = [source.width(), source.height()];
    let usage = match way {
        Way::Encode => pass.target_usage(),
        Way::Draw => TextureUsages::RENDER_ATTACHMENT,
    };
    let target = texture(gpu, size, pass.target_format(), usage | TextureUsages::COPY_SRC);
    let [from, to] = [source, &target].map(|texture| texture.create_view(&Default::default()));
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    match way {
        Way::Encode => pass.encode(&mut encoder, &from, &to).unwrap(),
        Way::Draw => {
            let mut render = encoder.begin_render_pass(&RenderPassDescriptor {
                color_attachments: &[Some(RenderPassColorAttachment {
                    view: &to,
                    depth_slice: None,
                    resolve_target: None,
                    ops: Operations { load: LoadOp::Clear(wgpu::Color::GREEN), store: StoreOp::Store },
                })],
                ..Default::default()
            });
            pass.draw(&mut render, &from).unwrap();
        }
    }
    read(gpu, encoder, &target)
}

/// Ends the encoder, submits it, and reads the texture's rows.
pub(crate) fn read(gpu: &Gpu, mut encoder: CommandEncoder, texture: &Texture) -> Vec<u8> {
    let row = texture.width() * texel(texture);
    let padded = row.next_multiple_of(256);
    let rows = texture.height() * texture.depth_or_array_layers();
    let buffer = gpu.device.create_buffer(&BufferDescriptor {
        label: None,
        size: u64::from(padded) * u64::from(rows),
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout =
        TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: Some(texture.height()) };
    let to = TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
    gpu.queue.submit([encoder.finish()]);
    mapped(gpu, &buffer, row as usize, padded as usize)
}

fn mapped(gpu: &Gpu, buffer: &Buffer, row: usize, padded: usize) -> Vec<u8> {
    buffer.slice(..).map_async(MapMode::Read, |result| result.unwrap());
    gpu.device.poll(PollType::wait_indefinitely()).unwrap();
    let bytes = buffer.slice(..).get_mapped_range().unwrap().to_vec();
    bytes.chunks(padded).flat_map(|line| &line[..row]).copied().collect()
}

fn texel(texture: &Texture) -> u32 {
    texture.format().block_copy_size(None).unwrap()
}

fn row_layout(texture: &Texture) -> TexelCopyBufferLayout {
    let bytes_per_row = Some(texture.width() * texel(texture));
    TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: Some(texture.height()) }
}

fn extent([width, height]: [u32; 2]) -> Extent3d {
    Extent3d { width, height, depth_or_array_layers: 1 }
}

/// Bytes as pixels of 32-bit floats.
pub(crate) fn floats(bytes: &[u8]) -> Vec<[f32; 4]> {
    let float = |bytes: &[u8]| f32::from_ne_bytes(bytes.try_into().unwrap());
    bytes.chunks(16).map(|pixel| std::array::from_fn(|c| float(&pixel[4 * c..4 * c + 4]))).collect()
}

/// Bytes as pixels of half floats.
pub(crate) fn halves(bytes: &[u8]) -> Vec<[f16; 4]> {
    let half = |bytes: &[u8]| f16::from_ne_bytes(bytes.try_into().unwrap());
    bytes.chunks(8).map(|pixel| std::array::from_fn(|c| half(&pixel[2 * c..2 * c + 2]))).collect()
}

/// Largest difference of the colours; NaN counts as infinite.
pub(crate) fn largest(found: &[[f32; 4]], expected: impl Iterator<Item = [f32; 3]>) -> f32 {
    let pixel = |(found, expected): (&[f32; 4], [f32; 3])| {
        let of = |c: usize| (found[c] - expected[c]).abs();
        (0..3).map(|c| if of(c).is_nan() { f32::INFINITY } else { of(c) }).fold(0.0, f32::max)
    };
    found.iter().zip(expected).map(pixel).fold(0.0, f32::max)
}
