//! Pictures to textures, through a pass, and back.

use half::f16;
use onelight_gpu::{FilmPass, Headless};
use wgpu::{
    CommandEncoder, LoadOp, Operations, RenderPassColorAttachment, RenderPassDescriptor, StoreOp, Texture,
    TextureFormat, TextureUsages, TextureView,
};

/// A texture of `Rgba32Float` or `Rgba16Float` with these pixels.
pub(crate) fn source(gpu: &Headless, size: [u32; 2], format: TextureFormat, pixels: &[[f32; 4]]) -> Texture {
    let bytes: Vec<u8> = match format {
        TextureFormat::Rgba16Float => pixels.iter().flatten().flat_map(|&v| f16::from_f32(v).to_ne_bytes()).collect(),
        _ => pixels.iter().flatten().flat_map(|v| v.to_ne_bytes()).collect(),
    };
    gpu.upload(size, format, &bytes).unwrap()
}

/// Which of a pass's two verbs is tried.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Verb {
    Encode,
    Draw,
}

/// `source` through a pass; the bytes of the target.
pub(crate) fn develop(gpu: &Headless, pass: &FilmPass, source: &Texture, verb: Verb) -> Vec<u8> {
    match verb {
        Verb::Encode => gpu.develop(pass, source).unwrap(),
        Verb::Draw => {
            let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
            let target = gpu.texture([source.width(), source.height()], pass.target_format(), usage).unwrap();
            let [from, to] = [source, &target].map(view);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            draw(&mut encoder, pass, &from, &to);
            gpu.queue.submit([encoder.finish()]);
            gpu.read_back(&target).unwrap()
        }
    }
}

pub(crate) fn view(texture: &Texture) -> TextureView {
    texture.create_view(&Default::default())
}

fn draw(encoder: &mut CommandEncoder, pass: &FilmPass, from: &TextureView, to: &TextureView) {
    let mut render = encoder.begin_render_pass(&RenderPassDescriptor {
        color_attachments: &[Some(RenderPassColorAttachment {
            view: to,
            depth_slice: None,
            resolve_target: None,
            ops: Operations { load: LoadOp::Clear(wgpu::Color::GREEN), store: StoreOp::Store },
        })],
        ..Default::default()
    });
    pass.draw(&mut render, from).unwrap();
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
