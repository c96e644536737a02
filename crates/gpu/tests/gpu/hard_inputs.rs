//! Numbers that drivers treat differently have one result.

use half::f16;
use onelight_gpu::{FilmPass, LookSettings};
use onelight_lut::Storage;
use wgpu::TextureFormat::{Rgba8Unorm, Rgba16Float, Rgba32Float};

use crate::adapter::gpu;
use crate::looks::{apply, looks};
use crate::picture::{Verb, develop, floats, halves, largest, source};

/// As in the parity tests.
const PARITY: f32 = 1e-5;

const HARD: [f32; 14] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    -1.0,
    -0.0,
    0.0,
    1e-40,
    -1e-40,
    1e-13,
    0.18,
    65504.0,
    1e30,
    f32::MAX,
    f32::MIN,
];

/// Every three of them, with the first as alpha.
fn pixels() -> Vec<[f32; 4]> {
    let pair = |r| HARD.iter().map(move |&g| (r, g));
    HARD.iter().flat_map(|&r| pair(r)).flat_map(|(r, g)| HARD.iter().map(move |&b| [r, g, b, r])).collect()
}

const SIZE: [u32; 2] = [196, 14];

#[test]
fn hard_pixels_are_those_of_the_twin() {
    let Some(gpu) = gpu() else { return };
    let pixels = pixels();
    let settings = LookSettings { storage: Storage::F32, ..Default::default() };
    for (look, format) in looks().iter().flat_map(|look| [Rgba32Float, Rgba16Float].map(|format| (look, format))) {
        let source = source(gpu, SIZE, format, &pixels);
        let read = |v: f32| if format == Rgba16Float { f16::from_f32(v).to_f32() } else { v };
        for (form, verb) in
            look.forms().into_iter().flat_map(|form| [Verb::Encode, Verb::Draw].map(|verb| (form, verb)))
        {
            let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, form, Rgba32Float, &settings).unwrap();
            let found = floats(&develop(gpu, &pass, &source, verb));
            let difference = largest(&found, pixels.iter().map(|&[r, g, b, _]| apply(form, [r, g, b].map(read))));
            assert!(difference <= PARITY, "{} {} {format:?} {verb:?}: {difference:e}", look.name, form.kind());
            for (found, given) in found.iter().zip(&pixels) {
                let alpha = read(given[3]);
                let alpha = if alpha.is_nan() { 0.0 } else { alpha.clamp(-1e30, 1e30) };
                assert!((found[3] - alpha).abs() <= 1e-37, "alpha {alpha} became {}", found[3]);
            }
        }
    }
}

#[test]
fn nothing_overflows_a_half() {
    let Some(gpu) = gpu() else { return };
    let pixels = pixels();
    let source = source(gpu, SIZE, Rgba32Float, &pixels);
    let look = &looks()[0];
    for (form, verb) in look.forms().into_iter().flat_map(|form| [Verb::Encode, Verb::Draw].map(|verb| (form, verb))) {
        let pass = FilmPass::new(&gpu.device, &gpu.queue, form, Rgba16Float).unwrap();
        let found = halves(&develop(gpu, &pass, &source, verb));
        for (found, given) in found.iter().zip(&pixels) {
            assert!(found.iter().all(|v| v.is_finite()), "{given:?} became {found:?}");
            if given[3] > 65504.0 {
                assert_eq!(found[3], f16::MAX, "alpha {}", given[3]);
            }
        }
    }
}

#[test]
fn alpha_saturates_in_integers() {
    let Some(gpu) = gpu() else { return };
    let pixels = pixels();
    let source = source(gpu, SIZE, Rgba32Float, &pixels);
    for verb in [Verb::Encode, Verb::Draw] {
        let pass = FilmPass::new(&gpu.device, &gpu.queue, &looks()[0].direct, Rgba8Unorm).unwrap();
        let found = develop(gpu, &pass, &source, verb);
        for (found, given) in found.chunks(4).zip(&pixels) {
            let expected = (given[3] * 255.0 + 0.5) as u8;
            assert!(found[3].abs_diff(expected) <= 1, "alpha {} became {}", given[3], found[3]);
        }
    }
}
