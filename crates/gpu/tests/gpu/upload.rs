//! Another look in the same resources.

use onelight_gpu::{FilmPass, Headless, LookSettings, wgpu};
use onelight_lut::Storage;
use wgpu::TextureFormat::{Rgba8Unorm, Rgba16Float, Rgba32Float};

use crate::adapter::gpu;
use crate::looks::{colours, looks};
use crate::picture::{Verb, develop, source, view};

/// How many there are of what takes time to make.
fn made(gpu: &Headless) -> [isize; 7] {
    let hal = gpu.device.get_internal_counters().hal;
    [
        hal.compute_pipelines.read(),
        hal.render_pipelines.read(),
        hal.shader_modules.read(),
        hal.pipeline_layouts.read(),
        hal.bind_groups.read(),
        hal.textures.read(),
        hal.samplers.read(),
    ]
}

/// Other tests make things at the same time: a device of its own.
fn alone() -> Option<Headless> {
    crate::adapter::another()
}

#[test]
fn a_look_change_makes_nothing_and_shows() {
    let Some(gpu) = alone() else { return };
    let [negative, reversal] = looks();
    let source = source(&gpu, [64, 64], Rgba16Float, &colours(64 * 64));
    for (first, second) in negative.forms().into_iter().zip(reversal.forms()) {
        for target in [Rgba8Unorm, Rgba32Float] {
            let new = |form| FilmPass::new(&gpu.device, &gpu.queue, form, target).unwrap();
            let (pass, fresh) = (new(first), new(second));
            let before = develop(&gpu, &pass, &source, Verb::Encode);
            let there = made(&gpu);
            pass.upload(&gpu.queue, second).unwrap();
            assert_eq!(made(&gpu), there, "{}", first.kind());
            let after = develop(&gpu, &pass, &source, Verb::Encode);
            assert_ne!(before, after);
            assert!(after == develop(&gpu, &fresh, &source, Verb::Encode), "{} to {target:?}", first.kind());
            // And back.
            pass.upload(&gpu.queue, first).unwrap();
            assert!(before == develop(&gpu, &pass, &source, Verb::Encode), "{}", first.kind());
        }
    }
    assert!(made(&gpu)[0] > 0, "the counters count");
}

#[test]
fn an_upload_in_mid_frame_does_not_wait() {
    let Some(gpu) = gpu() else { return };
    // Work that was submitted but not waited for: the upload is queued behind it, and each submission shows its own look.
    let [negative, reversal] = looks();
    let settings = LookSettings { storage: Storage::F32, ..Default::default() };
    let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, &negative.direct, Rgba32Float, &settings).unwrap();
    let source = source(gpu, [64, 64], Rgba16Float, &colours(64 * 64));
    let expected = develop(gpu, &pass, &source, Verb::Encode);
    let usage = pass.target_usage() | wgpu::TextureUsages::COPY_SRC;
    let target = gpu.texture([64, 64], Rgba32Float, usage).unwrap();
    let [from, to] = [&source, &target].map(view);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder, &from, &to).unwrap();
    gpu.queue.submit([encoder.finish()]);
    pass.upload(&gpu.queue, &reversal.direct).unwrap();
    let found = gpu.read_back(&target).unwrap();
    assert!(found == expected);
}
