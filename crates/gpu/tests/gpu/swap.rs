//! Another look in the same resources.

use onelight_gpu::{FilmPass, LookSettings, wgpu};
use onelight_lut::Storage;
use wgpu::TextureFormat::{Rgba8Unorm, Rgba16Float, Rgba32Float};

use crate::adapter::{Gpu, gpu};
use crate::looks::{colours, looks};
use crate::picture::{Way, develop, source};

/// How many there are of what takes time to make.
fn made(gpu: &Gpu) -> [isize; 7] {
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
fn alone() -> Option<Gpu> {
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
            let before = develop(&gpu, &pass, &source, Way::Encode);
            let there = made(&gpu);
            pass.swap(&gpu.queue, second).unwrap();
            assert_eq!(made(&gpu), there, "{}", first.kind());
            let after = develop(&gpu, &pass, &source, Way::Encode);
            assert_ne!(before, after);
            assert!(after == develop(&gpu, &fresh, &source, Way::Encode), "{} to {target:?}", first.kind());
            // And back.
            pass.swap(&gpu.queue, first).unwrap();
            assert!(before == develop(&gpu, &pass, &source, Way::Encode), "{}", first.kind());
        }
    }
    assert!(made(&gpu)[0] > 0, "the counters count");
}

#[test]
fn a_swap_in_mid_frame_does_not_wait() {
    let Some(gpu) = gpu() else { return };
    // Work that was submitted but not waited for: the swap is queued behind it, and each submission shows its own look.
    let [negative, reversal] = looks();
    let settings = LookSettings { storage: Storage::F32, ..Default::default() };
    let pass = FilmPass::with_settings(&gpu.device, &gpu.queue, &negative.direct, Rgba32Float, &settings).unwrap();
    let source = source(gpu, [64, 64], Rgba16Float, &colours(64 * 64));
    let expected = develop(gpu, &pass, &source, Way::Encode);
    let target =
        crate::picture::texture(gpu, [64, 64], Rgba32Float, pass.target_usage() | wgpu::TextureUsages::COPY_SRC);
    let [from, to] = [&source, &target].map(|texture| texture.create_view(&Default::default()));
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder, &from, &to).unwrap();
    gpu.queue.submit([encoder.finish()]);
    pass.swap(&gpu.queue, &reversal.direct).unwrap();
    let found = crate::picture::read(gpu, gpu.device.create_command_encoder(&Default::default()), &target);
    assert!(found == expected);
}
