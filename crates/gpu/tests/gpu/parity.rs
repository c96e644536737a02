//! Each shader against its twin in 32-bit floats.

use onelight::{DirectSettings, Entries, Nodes, Process, StructuredSettings, TransferCurve, WorkingSpace};
use onelight_gpu::{Fetch, FilmPass, Form, Headless, LookSettings};
use onelight_lut::Storage;
use wgpu::TextureFormat::{Rgba16Float, Rgba32Float};

use crate::adapter::gpu;
use crate::looks::{apply, coded, colours, looks};
use crate::picture::{Verb, develop, floats, largest, source};

/// Largest difference from the twin, in coded values of 0 to 1.
///
/// The steps that differ are `log2` and `exp2`. WGSL asks of `log2` 3 units in the last place, or 2^-21 near 1: at 10 stops
/// from 1 an error of 2^-21 stops either way. Film steepens that by its gamma, on a print the product of two, 3 at most; coded
/// for a display it comes to gamma * ln 2 / 2.4 times the value: 4e-7. `exp2` may be off by (3 + 2 |x|) units: at the 10 halvings
/// of the densest dye, 1.4e-6 of a term. Sums with terms of either sign multiply that by the ratio of their absolute to
/// their real size, below 4 for the fitted forms. Those are below 1e-5 together.
const PARITY: f32 = 1e-5;

const SIZE: [u32; 2] = [256, 128];

fn through(gpu: &Headless, form: Form<'_>, storage: Storage, verb: Verb) -> Vec<[f32; 4]> {
    let settings = LookSettings { fetch: Fetch::Texels, storage, ..Default::default() };
    let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, form, Rgba32Float, &settings).unwrap();
    let pixels = colours((SIZE[0] * SIZE[1]) as usize);
    floats(&develop(gpu, &pass, &source(gpu, SIZE, Rgba32Float, &pixels), verb))
}

fn difference(gpu: &Headless, form: Form<'_>, storage: Storage, verb: Verb, twin: Form<'_>) -> f32 {
    let found = through(gpu, form, storage, verb);
    let pixels = colours((SIZE[0] * SIZE[1]) as usize);
    for (found, given) in found.iter().zip(&pixels) {
        assert_eq!(found[3], given[3], "alpha");
    }
    largest(&found, pixels.iter().map(|&[r, g, b, _]| apply(twin, [r, g, b])))
}

#[test]
fn every_form_is_its_twin() {
    let Some(gpu) = gpu() else { return };
    for look in looks() {
        for verb in [Verb::Encode, Verb::Draw] {
            for form in look.forms() {
                let difference = difference(gpu, form, Storage::F32, verb, form);
                eprintln!("{}: {} {} {verb:?}: {difference:.1e}", gpu.name(), look.name, form.kind());
                assert!(difference <= PARITY, "{} {} {verb:?}: {difference:e}", look.name, form.kind());
            }
        }
        let coded = coded(look);
        let difference = difference(gpu, (&coded).into(), Storage::F32, Verb::Encode, (&coded).into());
        assert!(difference <= PARITY, "{} structured, coded: {difference:e}", look.name);
    }
}

#[test]
fn tables_of_half_floats_read_as_stored() {
    let Some(gpu) = gpu() else { return };
    for look in looks() {
        let stored = look.stored(Storage::F16);
        for (form, twin) in look.forms().into_iter().zip(stored.forms()) {
            let difference = difference(gpu, form, Storage::F16, Verb::Encode, twin);
            assert!(difference <= PARITY, "{} {}: {difference:e}", look.name, form.kind());
        }
    }
}

#[test]
fn half_floats_in_are_what_they_say() {
    let Some(gpu) = gpu() else { return };
    let look = &looks()[0];
    let pixels = colours((SIZE[0] * SIZE[1]) as usize);
    let source = source(gpu, SIZE, Rgba16Float, &pixels);
    for form in look.forms() {
        let settings = LookSettings { storage: Storage::F32, ..Default::default() };
        let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, form, Rgba32Float, &settings).unwrap();
        let found = floats(&develop(gpu, &pass, &source, Verb::Encode));
        let rounded = |v: f32| half::f16::from_f32(v).to_f32();
        let difference = largest(&found, pixels.iter().map(|&[r, g, b, _]| apply(form, [r, g, b].map(rounded))));
        assert!(difference <= PARITY, "{}: {difference:e}", form.kind());
    }
}

#[test]
fn other_spaces_and_many_terms_are_too() {
    let Some(gpu) = gpu() else { return };
    // A first matrix that is not the identity, a coding with no foot, sums longer than those of fitted forms.
    let mut process = Process::for_camera("kodak-5219").unwrap();
    process.spaces_mut().input_space = WorkingSpace::Rec2020;
    process.spaces_mut().output_coding = TransferCurve::Gamma24;
    let film = process.compile().unwrap();
    let settings = StructuredSettings { size: 8, entries: Entries::Sampled, ..Default::default() };
    let structured = film.structured(&settings).unwrap();
    let direct = film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 5 } }).unwrap();
    // Without a foot the coding's slope at black has no limit, and with it a coded difference: linear light is compared.
    let linear = |coded: f32| coded.signum() * coded.abs().powf(2.4);
    for form in [Form::from(&structured), Form::from(&direct)] {
        let found = through(gpu, form, Storage::F32, Verb::Encode);
        let found: Vec<_> = found.into_iter().map(|pixel| pixel.map(linear)).collect();
        let pixels = colours((SIZE[0] * SIZE[1]) as usize);
        let difference = largest(&found, pixels.iter().map(|&[r, g, b, _]| apply(form, [r, g, b]).map(linear)));
        eprintln!("{}: Rec.2020 to gamma 2.4, {}: {difference:.1e}", gpu.name(), form.kind());
        assert!(difference <= PARITY, "{}: {difference:e}", form.kind());
    }
}
