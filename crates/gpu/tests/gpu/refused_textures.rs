//! Textures and views that a pass cannot use are refused in one sentence; the encoder stays good.

use std::pin::pin;
use std::task::{Context, Poll, Waker};

use onelight_gpu::{FilmPass, Headless};
use wgpu::TextureFormat::{
    self, Depth32Float, R8Unorm, Rgba8Unorm, Rgba8UnormSrgb, Rgba16Float, Rgba16Uint, Rgba32Float,
};
use wgpu::{
    BufferDescriptor, BufferUsages, Extent3d, Texture, TextureDescriptor, TextureDimension, TextureUsages, TextureView,
    TextureViewDescriptor,
};

use crate::adapter::gpu;
use crate::looks::{colours, looks};
use crate::picture::{Verb, develop, source, view};

/// What a texture needs to be read, and to be written by either method.
const READ: TextureUsages = TextureUsages::TEXTURE_BINDING;

/// A texture of 4x4 pixels that a pass can use, but for what a test changes.
fn sound(format: TextureFormat, usage: TextureUsages) -> TextureDescriptor<'static> {
    TextureDescriptor {
        label: None,
        size: Extent3d { width: 4, height: 4, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    }
}

/// What a pass says to two views. The encoder must end without a fault afterwards, and the pass still develop.
fn refusal(gpu: &Headless, pass: &FilmPass, from: &TextureView, to: &TextureView) -> String {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let error = pass.encode(&mut encoder, from, to).unwrap_err();
    assert!(error.is_texture(), "{error}");
    let good = gpu.device.create_texture(&sound(Rgba16Float, READ));
    let target = gpu.device.create_texture(&sound(pass.target_format(), pass.target_usage()));
    pass.encode(&mut encoder, &view(&good), &view(&target)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    let text = error.to_string();
    assert!(!text.contains('\n') && text.contains("found") && text.contains("expected"), "{text}");
    text
}

/// A pass that writes from a compute shader, and one that draws.
fn passes(gpu: &Headless) -> [FilmPass; 2] {
    let pass = |format| FilmPass::new(&gpu.device, &gpu.queue, &looks()[0].direct, format).unwrap();
    let passes = [pass(Rgba8Unorm), pass(Rgba8UnormSrgb)];
    assert_eq!(
        passes.each_ref().map(FilmPass::target_usage),
        [TextureUsages::STORAGE_BINDING, TextureUsages::RENDER_ATTACHMENT]
    );
    passes
}

#[test]
fn textures_to_write_are_checked() {
    let Some(gpu) = gpu() else { return };
    let from = view(&gpu.device.create_texture(&sound(Rgba16Float, READ)));
    for pass in &passes(gpu) {
        let (format, usage) = (pass.target_format(), pass.target_usage());
        let make = |descriptor: &TextureDescriptor<'_>| view(&gpu.device.create_texture(descriptor));
        let refuse = |descriptor: &TextureDescriptor<'_>| refusal(gpu, pass, &from, &make(descriptor));
        let needed = if usage == TextureUsages::STORAGE_BINDING { "STORAGE_BINDING" } else { "RENDER_ATTACHMENT" };
        assert_eq!(
            refuse(&sound(format, TextureUsages::COPY_SRC | READ)),
            format!("usage of the texture to write: found COPY_SRC | TEXTURE_BINDING, expected {needed} among it")
        );
        assert_eq!(
            refuse(&sound(Rgba16Float, usage)),
            format!("format of the texture to write: found Rgba16Float, expected {format:?} as the pass was made for")
        );
        let tall = Extent3d { width: 4, height: 5, depth_or_array_layers: 1 };
        assert_eq!(
            refuse(&TextureDescriptor { size: tall, ..sound(format, usage) }),
            "size of the texture to write: found 4x5, expected 4x4 as in the one to read"
        );
        assert_eq!(
            refuse(&TextureDescriptor { mip_level_count: 3, ..sound(format, usage) }),
            "mip levels of the texture to write: found 3, expected 1"
        );
        let layers = Extent3d { width: 4, height: 4, depth_or_array_layers: 2 };
        let text = refuse(&TextureDescriptor { size: layers, ..sound(format, usage) });
        assert!(text.starts_with("view") && text.contains("the texture"), "{text}");
    }
    let [compute, draw] = passes(gpu);
    let usage = TextureUsages::STORAGE_BINDING;
    let deep = TextureDescriptor { dimension: TextureDimension::D3, ..sound(Rgba8Unorm, usage) };
    let deep = view(&gpu.device.create_texture(&deep));
    assert_eq!(refusal(gpu, &compute, &from, &deep), "dimension of the texture to write: found D3, expected D2");
    let samples = TextureDescriptor { sample_count: 4, ..sound(Rgba8UnormSrgb, draw.target_usage()) };
    let samples = view(&gpu.device.create_texture(&samples));
    assert_eq!(
        refusal(gpu, &draw, &from, &samples),
        "samples of a pixel of the texture to write: found 4, expected 1: resolve it before"
    );
}

#[test]
fn textures_to_read_are_checked() {
    let Some(gpu) = gpu() else { return };
    for pass in &passes(gpu) {
        let to = view(&gpu.device.create_texture(&sound(pass.target_format(), pass.target_usage())));
        let refuse =
            |descriptor: &TextureDescriptor<'_>| refusal(gpu, pass, &view(&gpu.device.create_texture(descriptor)), &to);
        assert_eq!(
            refuse(&sound(Rgba32Float, TextureUsages::COPY_DST)),
            "usage of the texture to read: found COPY_DST, expected TEXTURE_BINDING among it"
        );
        for format in [Rgba16Uint, Depth32Float] {
            assert_eq!(
                refuse(&sound(format, READ)),
                format!(
                    "format of the texture to read: found {format:?}, expected a colour format that shaders read as floats, such as Rgba16Float"
                )
            );
        }
        assert_eq!(
            refuse(&TextureDescriptor { dimension: TextureDimension::D3, ..sound(Rgba16Float, READ) }),
            "dimension of the texture to read: found D3, expected D2"
        );
        let samples = READ | TextureUsages::RENDER_ATTACHMENT;
        assert_eq!(
            refuse(&TextureDescriptor { sample_count: 4, ..sound(Rgba16Float, samples) }),
            "samples of a pixel of the texture to read: found 4, expected 1: resolve it before"
        );
        let layers = Extent3d { width: 4, height: 4, depth_or_array_layers: 6 };
        let layered = gpu.device.create_texture(&TextureDescriptor { size: layers, ..sound(Rgba16Float, READ) });
        let text = refusal(gpu, pass, &view(&layered), &to);
        assert!(text.starts_with("view") && text.contains("D2Array"), "{text}");
        // One of its layers is a picture, and one channel is enough of a colour.
        let layer = |texture: &Texture| {
            texture.create_view(&TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: 3,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        let single = gpu.device.create_texture(&sound(R8Unorm, READ));
        for from in [layer(&layered), view(&single)] {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            pass.encode(&mut encoder, &from, &to).unwrap();
            gpu.queue.submit([encoder.finish()]);
        }
    }
}

#[test]
fn views_of_another_format_are_checked() {
    let Some(gpu) = gpu() else { return };
    let from = view(&gpu.device.create_texture(&sound(Rgba16Float, READ)));
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT;
    let [compute, draw] = passes(gpu);
    let formats = [Rgba8UnormSrgb];
    let both = TextureDescriptor { view_formats: &formats, ..sound(Rgba8Unorm, usage) };
    let both = gpu.device.create_texture(&both);
    let srgb =
        |usage| both.create_view(&TextureViewDescriptor { format: Some(Rgba8UnormSrgb), usage, ..Default::default() });
    let srgb = srgb(Some(TextureUsages::RENDER_ATTACHMENT));
    // Each pass takes its own view of the texture, and not the other's.
    for (pass, good, bad) in [(&compute, &view(&both), &srgb), (&draw, &srgb, &view(&both))] {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        pass.encode(&mut encoder, &from, good).unwrap();
        gpu.queue.submit([encoder.finish()]);
        let text = refusal(gpu, pass, &from, bad);
        assert!(text.starts_with("view"), "{text}");
    }
}

#[test]
fn views_of_all_levels_are_read_at_the_first() {
    let Some(gpu) = gpu() else { return };
    let pixels = colours(16 * 16);
    let plain = source(gpu, [16, 16], Rgba16Float, &pixels);
    let size = plain.size();
    let usage = READ | TextureUsages::COPY_DST;
    let levels = TextureDescriptor { size, mip_level_count: 5, ..sound(Rgba16Float, usage) };
    let levels = gpu.device.create_texture(&levels);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_texture_to_texture(plain.as_image_copy(), levels.as_image_copy(), size);
    gpu.queue.submit([encoder.finish()]);
    for pass in &passes(gpu) {
        assert!(develop(gpu, pass, &levels, Verb::Encode) == develop(gpu, pass, &plain, Verb::Encode));
    }
}

#[test]
fn one_texture_is_not_both() {
    let Some(gpu) = gpu() else { return };
    let pass = FilmPass::new(&gpu.device, &gpu.queue, &looks()[0].direct, Rgba16Float).unwrap();
    let both = gpu.device.create_texture(&sound(Rgba16Float, READ | pass.target_usage()));
    let text = refusal(gpu, &pass, &view(&both), &view(&both));
    assert_eq!(text, "textures to read and to write: found the same, expected two");
}

#[test]
fn textures_of_another_device_are_refused() {
    let Some(gpu) = gpu() else { return };
    let opened = pin!(gpu.adapter.request_device(&Default::default()));
    let Poll::Ready(opened) = opened.poll(&mut Context::from_waker(Waker::noop())) else { panic!("not open at once") };
    let (other, _) = opened.unwrap();
    for pass in &passes(gpu) {
        let descriptors = [sound(Rgba16Float, READ), sound(pass.target_format(), pass.target_usage())];
        let [from, to] = descriptors.each_ref().map(|descriptor| view(&gpu.device.create_texture(descriptor)));
        let [strange_from, strange_to] =
            descriptors.each_ref().map(|descriptor| view(&other.create_texture(descriptor)));
        for (from, to) in [(&strange_from, &to), (&from, &strange_to)] {
            let text = refusal(gpu, pass, from, to);
            assert!(text.starts_with("view") && text.contains("device"), "{text}");
        }
    }
}

#[test]
fn headless_textures_are_checked() {
    let Some(gpu) = gpu() else { return };
    let refusals = [
        (gpu.texture([0, 4], Rgba8Unorm, READ).map(drop), "texture on the GPU: found that "),
        (gpu.texture([u32::MAX, 4], Rgba8Unorm, READ).map(drop), "texture on the GPU: found that "),
        (
            gpu.upload([4, 4], Rgba8Unorm, &[0; 63]).map(drop),
            "bytes of a picture to upload: found 63, expected 64 for its size and format",
        ),
        (
            gpu.read_back(&gpu.texture([4, 4], Rgba8Unorm, READ).unwrap()).map(drop),
            "texture or buffer to read back: found that ",
        ),
    ];
    for (refused, sentence) in refusals {
        let text = refused.unwrap_err().to_string();
        assert!(text.starts_with(sentence) && !text.contains('\n'), "{text}");
    }
    let buffer =
        |usage| gpu.device.create_buffer(&BufferDescriptor { label: None, size: 16, usage, mapped_at_creation: false });
    let text = gpu.read_buffer(&buffer(BufferUsages::COPY_DST)).unwrap_err().to_string();
    assert!(text.starts_with("texture or buffer to read back: found that ") && text.contains("MAP_READ"), "{text}");
    // A buffer may be read again and again.
    let read = buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ);
    for value in [7, 8] {
        gpu.queue.write_buffer(&read, 0, &[value; 16]);
        gpu.queue.submit([]);
        assert_eq!(gpu.read_buffer(&read).unwrap(), [value; 16]);
    }
    // Rows that are no multiple of 256 bytes come back without gaps.
    let bytes: Vec<u8> = (0..5 * 3 * 4).collect();
    let texture = gpu.upload([5, 3], Rgba8Unorm, &bytes).unwrap();
    assert_eq!(gpu.read_back(&texture).unwrap(), bytes);
}

#[test]
fn missing_adapters_are_named() {
    let Some(_) = gpu() else { return };
    let settings = onelight_gpu::HeadlessSettings { adapter: "no such card", ..Default::default() };
    let error = Headless::open(&settings).unwrap_err();
    assert!(error.is_no_adapter());
    let text = error.to_string();
    assert!(
        text.starts_with("graphics adapter: found ") && text.contains("expected one with \"no such card\""),
        "{text}"
    );
}
