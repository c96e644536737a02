//! The texture unit's filter: what its 8-bit weights cost.

use std::sync::OnceLock;

use onelight::spectra::{DisplayDifference, RgbSpace, TransferCurve};
use onelight::{Entries, Process, StructuredSettings};
use onelight_gpu::{Fetch, FilmPass, Form, LookSettings};
use onelight_lut::{Interpolation, Lut3d, Shaper, Storage, StructuredLut};
use wgpu::Features;
use wgpu::TextureFormat::Rgba32Float;

use crate::adapter::gpu;
use crate::looks::{colours, looks};
use crate::picture::{Verb, develop, floats, source};

/// What the 8 bits of a filter's weights cost a structured table of 32^3, CIEDE2000.
const LARGEST: f64 = 0.08;
const MEAN: f64 = 0.01;

/// A table as a filter with 8-bit weights reads it.
fn filtered(table: &Lut3d, coordinates: [f32; 3]) -> [f32; 3] {
    let last = (table.size() - 1) as f32;
    let held = coordinates.map(|c| (c.clamp(0.0, 1.0) * last * 256.0).round() / (256.0 * last));
    table.apply(held, Interpolation::Trilinear)
}

fn negative() -> &'static StructuredLut {
    static LUT: OnceLock<StructuredLut> = OnceLock::new();
    LUT.get_or_init(|| {
        let film = Process::default().compile().unwrap();
        let settings = StructuredSettings {
            interpolation: Interpolation::Trilinear,
            entries: Entries::Sampled,
            ..Default::default()
        };
        film.structured(&settings).unwrap()
    })
}

#[test]
fn eight_bits_cost_little() {
    let lut = negative();
    let difference = DisplayDifference::new(&RgbSpace::SRGB).unwrap();
    let linear = |coded: [f32; 3]| TransferCurve::Srgb.decode_rgb(coded.map(f64::from));
    let (mut largest, mut sum, colours) = (0.0_f64, 0.0, colours(1 << 16));
    for &[r, g, b, _] in &colours {
        let coordinates = lut.coordinates([r, g, b]);
        let [exact, rough] =
            [lut.parts().table.apply(coordinates, Interpolation::Trilinear), filtered(&lut.parts().table, coordinates)];
        let step = difference.between(linear(lut.decode(exact)), linear(lut.decode(rough)));
        largest = largest.max(step);
        sum += step;
    }
    let mean = sum / colours.len() as f64;
    eprintln!("8-bit weights: dE mean {mean:.4}, largest {largest:.4}");
    assert!(largest <= LARGEST && mean <= MEAN, "{mean} {largest}");
    // The claim is not an empty one.
    assert!(largest > LARGEST / 4.0 && mean > MEAN / 4.0, "{mean} {largest}");
}

#[test]
fn a_filter_stays_within_its_steps() {
    let Some(gpu) = gpu() else { return };
    let pixels = colours(128 * 128);
    let source = source(gpu, [128, 128], Rgba32Float, &pixels);
    let float32 = gpu.device.features().contains(Features::FLOAT32_FILTERABLE);
    for storage in [Storage::F16, Storage::F32] {
        let settings = LookSettings { fetch: Fetch::Filtered, storage, ..Default::default() };
        for look in looks() {
            let stored = look.stored(storage);
            for form in [Form::from(&stored.plain), Form::from(&stored.structured)] {
                let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, form, Rgba32Float, &settings);
                if storage == Storage::F32 && !float32 {
                    assert!(pass.unwrap_err().to_string().contains("FLOAT32_FILTERABLE"));
                    continue;
                }
                let found = floats(&develop(gpu, &pass.unwrap(), &source, Verb::Encode));
                let worst = found.iter().zip(&pixels).map(|(found, &[r, g, b, _])| over(form, [r, g, b], found));
                let worst = worst.fold(f32::NEG_INFINITY, f32::max);
                assert!(worst <= 0.0, "{} {} {storage:?}: {worst:e} beyond its steps", look.name, form.kind());
            }
        }
    }
}

/// By how much a pixel lies further from the trilinear value than half a step of the weights moves it, in its worst channel.
fn over(form: Form<'_>, linear: [f32; 3], found: &[f32; 4]) -> f32 {
    let (table, coordinates) = match form {
        Form::Plain(lut) => (lut.table(), linear.map(|u| Shaper::encode_f32(lut.shaper(), u))),
        Form::Structured(lut) => (&lut.parts().table, lut.coordinates(linear)),
        Form::Direct(_) => panic!("a direct form has no table"),
    };
    let decode = |entry| if let Form::Structured(lut) = form { lut.decode(entry) } else { entry };
    let step = 1.0 / (512.0 * (table.size() - 1) as f32);
    let at = |signs: [f32; 3]| {
        let moved = std::array::from_fn(|c| coordinates[c] + step * signs[c]);
        decode(table.apply(moved, Interpolation::Trilinear))
    };
    let exact = at([0.0; 3]);
    let corners = (0..8).map(|i| at([0, 1, 2].map(|c| if i >> c & 1 == 1 { 1.0 } else { -1.0 })));
    let reach =
        corners.fold([0.0_f32; 3], |reach, corner| std::array::from_fn(|c| reach[c].max((corner[c] - exact[c]).abs())));
    // Parity besides.
    (0..3).map(|c| (found[c] - exact[c]).abs() - reach[c] - 1e-5).fold(f32::NEG_INFINITY, f32::max)
}
