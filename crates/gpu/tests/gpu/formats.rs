//! Targets of every format.

use onelight_gpu::{FilmPass, Form, Headless, LookSettings};
use onelight_lut::{DirectForm, DirectParts, PowerCoding, Sample as _, Storage};
use wgpu::TextureFormat::{
    self, Bgra8Unorm, Bgra8UnormSrgb, Rgb10a2Unorm, Rgba8Unorm, Rgba8UnormSrgb, Rgba16Float, Rgba32Float,
};

use crate::adapter::gpu;
use crate::looks::{apply, coded, colours, looks};
use crate::picture::{Verb, develop, halves, source};

/// How far a stored code may lie from the exact value, in codes: half of one for rounding, 1e-5 of the largest code for parity,
/// and what Vulkan leaves to the rounding of conversions.
const UNORM8: f32 = 0.5 + 255e-5 + 0.01;
const UNORM10: f32 = 0.5 + 1023e-5 + 0.04;

/// Through an sRGB view: another conversion in the card, which Vulkan allows an error of 0.6 of a code, rounding included, and lavapipe takes 0.66.
const SRGB8: f32 = 0.7;

const SIZE: [u32; 2] = [128, 64];

fn pixels() -> Vec<[f32; 4]> {
    colours((SIZE[0] * SIZE[1]) as usize)
}

/// Target's bytes for a form with its table in 32-bit floats.
fn through(gpu: &Headless, form: Form<'_>, target: TextureFormat, verb: Verb) -> Vec<u8> {
    let settings = LookSettings { storage: Storage::F32, ..Default::default() };
    let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, form, target, &settings).unwrap();
    develop(gpu, &pass, &source(gpu, SIZE, Rgba32Float, &pixels()), verb)
}

/// Codes of red, green, blue, alpha, as fractions of nothing: whole numbers.
fn codes(bytes: &[u8], target: TextureFormat) -> Vec<[f32; 4]> {
    let pixel = |pixel: &[u8]| match target {
        Rgb10a2Unorm => {
            let word = u32::from_ne_bytes(pixel.try_into().unwrap());
            [word & 1023, word >> 10 & 1023, word >> 20 & 1023, word >> 30].map(|code| code as f32)
        }
        Bgra8Unorm | Bgra8UnormSrgb => [pixel[2], pixel[1], pixel[0], pixel[3]].map(f32::from),
        _ => [pixel[0], pixel[1], pixel[2], pixel[3]].map(f32::from),
    };
    bytes.chunks(4).map(pixel).collect()
}

fn furthest(codes: &[[f32; 4]], form: Form<'_>, count: f32) -> f32 {
    let pixel = |(found, [r, g, b, _]): (&[f32; 4], [f32; 4])| {
        let expected = apply(form, [r, g, b]).map(|v| count * v.clamp(0.0, 1.0));
        (0..3).map(|c| (found[c] - expected[c]).abs()).fold(0.0, f32::max)
    };
    codes.iter().zip(pixels()).map(pixel).fold(0.0, f32::max)
}

#[test]
fn integers_are_the_nearest_codes() {
    let Some(gpu) = gpu() else { return };
    let formats = [(Rgba8Unorm, 255.0, UNORM8), (Bgra8Unorm, 255.0, UNORM8), (Rgb10a2Unorm, 1023.0, UNORM10)];
    for (target, count, bound) in formats {
        for verb in [Verb::Encode, Verb::Draw] {
            for form in looks().iter().flat_map(|look| look.forms()) {
                let codes = codes(&through(gpu, form, target, verb), target);
                let furthest = furthest(&codes, form, count);
                assert!(furthest <= bound, "{target:?} {verb:?} {}: {furthest} codes", form.kind());
                for (code, pixel) in codes.iter().zip(pixels()) {
                    let most = if target == Rgb10a2Unorm { 3.0 } else { 255.0 };
                    assert!((code[3] - most * pixel[3]).abs() <= 0.51, "alpha {} became {}", pixel[3], code[3]);
                }
            }
        }
    }
}

#[test]
fn an_srgb_view_stores_the_same_bytes() {
    let Some(gpu) = gpu() else { return };
    for look in looks() {
        let coded = coded(look);
        let gamma = PowerCoding::new(2.4, 0.0).unwrap();
        let gamma = DirectForm::new(DirectParts { coding: gamma, ..look.direct.parts().clone() }).unwrap();
        for form in look.forms().into_iter().chain([(&coded).into(), (&gamma).into()]) {
            for target in [Rgba8UnormSrgb, Bgra8UnormSrgb] {
                let furthest = furthest(&codes(&through(gpu, form, target, Verb::Encode), target), form, 255.0);
                assert!(furthest <= SRGB8, "{target:?} {}: {furthest} codes", form.kind());
            }
        }
    }
}

#[test]
fn half_floats_are_next_to_the_value() {
    let Some(gpu) = gpu() else { return };
    for verb in [Verb::Encode, Verb::Draw] {
        for form in looks().iter().flat_map(|look| look.forms()) {
            for (found, [r, g, b, a]) in halves(&through(gpu, form, Rgba16Float, verb)).into_iter().zip(pixels()) {
                let [x, y, z] = apply(form, [r, g, b]);
                for (found, v) in found.into_iter().zip([x, y, z, a]) {
                    // Rounded either way: within one step of a half float, which has 11 bits.
                    let step = (v.abs() / 1024.0).max(6e-8);
                    assert!((found.to_f32() - v).abs() <= step + 1e-5, "{v} became {found}");
                }
            }
        }
    }
}

#[test]
fn integers_of_the_cpu_are_the_same_codes() {
    let Some(gpu) = gpu() else { return };
    let form = (&looks()[0].direct).into();
    let found = codes(&through(gpu, form, Rgba8Unorm, Verb::Encode), Rgba8Unorm);
    let same = |(found, [r, g, b, _]): (&[f32; 4], [f32; 4])| {
        let expected = apply(form, [r, g, b]).map(u8::from_f32).map(f32::from);
        (0..3).all(|c| (found[c] - expected[c]).abs() <= 1.0)
            && (0..3).filter(|&c| found[c] == expected[c]).count() == 3
    };
    let equal = found.iter().zip(pixels()).filter(|&(found, pixel)| same((found, pixel))).count();
    // Values within 0.0026 codes of a boundary may fall on either side: 1.5 % of pixels at most.
    assert!(equal as f64 >= 0.98 * found.len() as f64, "{equal} of {}", found.len());
}

#[test]
fn linear_light_is_encoded_by_an_srgb_view() {
    let Some(gpu) = gpu() else { return };
    let coded = &looks()[0].direct;
    let linear = DirectForm::new(DirectParts { coding: PowerCoding::LINEAR, ..coded.parts().clone() }).unwrap();
    let found = codes(&through(gpu, (&linear).into(), Rgba8UnormSrgb, Verb::Encode), Rgba8UnormSrgb);
    assert!(furthest(&found, coded.into(), 255.0) <= SRGB8);
}
