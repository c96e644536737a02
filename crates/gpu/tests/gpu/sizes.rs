//! Pictures of awkward sizes, to the last pixel.

use half::f16;
use onelight_gpu::{FilmPass, MAX_SIDE};
use onelight_lut::{Channels, PixelMap as _, Pixels, PixelsMut, Storage};
use wgpu::TextureFormat::{Rgb10a2Unorm, Rgba8Unorm, Rgba16Float};
use wgpu::TextureUsages;

use crate::adapter::gpu;
use crate::looks::looks;
use crate::picture::{Verb, develop, source, view};

/// Different for neighbours in both directions, so that a pixel out of place is seen.
fn pixels([width, height]: [u32; 2]) -> Vec<[f32; 4]> {
    let part = |n: u32| (n.wrapping_mul(0x9e37_79b9) >> 8) as f32 / 16_777_216.0;
    let pixel = |i: u32| [part(i), 4.0 * part(i ^ 0x55_5555), 0.3 * part(i.wrapping_mul(7)), 1.0];
    (0..width * height).map(pixel).collect()
}

#[test]
fn odd_sizes_are_whole() {
    let Some(gpu) = gpu() else { return };
    let stored = looks()[0].stored(Storage::F16);
    let pass = FilmPass::new(&gpu.device, &gpu.queue, &stored.plain, Rgba8Unorm).unwrap();
    for size in [[1, 1], [17, 3], [3839, 2161], [MAX_SIDE, 1], [1, MAX_SIDE]] {
        let pixels = pixels(size);
        let source = source(gpu, size, Rgba16Float, &pixels);
        let halves: Vec<f16> = pixels.iter().flatten().map(|&v| f16::from_f32(v)).collect();
        let mut expected = vec![0u8; halves.len()];
        let [width, height] = size.map(|side| side as usize);
        let from = Pixels::new(&halves, Channels::Rgba, [width, height]).unwrap();
        let mut to = PixelsMut::new(&mut expected, Channels::Rgba, [width, height]).unwrap();
        stored.plain.map(&from, &mut to).unwrap();
        for verb in [Verb::Encode, Verb::Draw] {
            let found = develop(gpu, &pass, &source, verb);
            let far = found.iter().zip(&expected).position(|(found, expected)| found.abs_diff(*expected) > 1);
            assert_eq!(far, None, "{size:?} {verb:?}");
            assert_eq!(found.len(), expected.len());
        }
    }
}

#[test]
fn larger_pictures_are_refused() {
    let Some(gpu) = gpu() else { return };
    if gpu.device.limits().max_texture_dimension_2d <= MAX_SIDE {
        return;
    }
    for size in [[MAX_SIDE + 1, 1], [1, MAX_SIDE + 1]] {
        for format in [Rgba8Unorm, Rgb10a2Unorm] {
            let pass = FilmPass::new(&gpu.device, &gpu.queue, &looks()[0].direct, format).unwrap();
            let source = gpu.texture(size, Rgba16Float, TextureUsages::TEXTURE_BINDING).unwrap();
            let target = gpu.texture(size, format, pass.target_usage()).unwrap();
            let [from, to] = [&source, &target].map(view);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let error = pass.encode(&mut encoder, &from, &to).unwrap_err();
            assert!(error.is_texture());
            let [width, height] = size;
            let expected = format!("picture on the GPU: found {width}x{height} pixels, expected at most 8192 a side");
            assert_eq!(error.to_string(), expected);
        }
    }
}
