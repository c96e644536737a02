//! Tables filled on the GPU.

use onelight_gpu::{FilmPass, LookSettings, TableBake};
use onelight_lut::{PlainLut, Storage, bake};
use wgpu::TextureFormat::{Rgba16Float, Rgba32Float};

use crate::adapter::gpu;
use crate::looks::{SIZE, apply, colours, looks};
use crate::picture::{Verb, develop, floats, largest, source};

/// As in the parity tests; a baked entry has the error of the direct form, a read one is a mean of four.
const PARITY: f32 = 1e-5;

/// Half floats may be rounded either way: one step above 1, where colours brighter than clear film in a channel lie.
const HALF_STEP: f32 = 9.8e-4;

#[test]
fn a_baked_table_is_that_of_the_cpu() {
    let Some(gpu) = gpu() else { return };
    let [first, second] = looks();
    let pixels = colours(128 * 128);
    let source = source(gpu, [128, 128], Rgba32Float, &pixels);
    for (storage, bound) in [(Storage::F32, PARITY), (Storage::F16, HALF_STEP + PARITY)] {
        let settings = LookSettings { storage, ..Default::default() };
        let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, &first.plain, Rgba32Float, &settings).unwrap();
        let filled = TableBake::new(&gpu.device, &gpu.queue, &first.direct, pass.look()).unwrap();
        for look in [first, second] {
            filled.upload(&gpu.queue, &look.direct).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            filled.encode(&mut encoder);
            gpu.queue.submit([encoder.finish()]);
            let found = floats(&develop(gpu, &pass, &source, Verb::Encode));

            let shaper = first.plain.shaper();
            let film = |rgb: [f64; 3]| look.direct.apply(rgb.map(|v| v as f32)).map(f64::from);
            let table = bake(SIZE, shaper, film, |_| {}).unwrap();
            let twin = PlainLut::new(*shaper, table, first.plain.interpolation());
            let difference = largest(&found, pixels.iter().map(|&[r, g, b, _]| apply((&twin).into(), [r, g, b])));
            eprintln!("{}: bake of {} into {storage:?}: {difference:.1e}", gpu.name(), look.name);
            assert!(difference <= bound, "{} {storage:?}: {difference:e}", look.name);
        }
    }
}

#[test]
fn only_plain_looks_are_baked_into() {
    let Some(gpu) = gpu() else { return };
    let look = &looks()[0];
    for form in [(&look.structured).into(), (&look.direct).into()] {
        let form: onelight_gpu::Form<'_> = form;
        let pass = FilmPass::new(&gpu.device, &gpu.queue, form, Rgba16Float).unwrap();
        let error = TableBake::new(&gpu.device, &gpu.queue, &look.direct, pass.look()).unwrap_err();
        assert!(error.to_string().ends_with("expected plain as in these resources"), "{error}");
    }
}
