//! How long the film takes: compiling a process, developing colours exactly, baking and applying a table.

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use onelight::{Process, Reference};
use onelight_lut::{Interpolation, PlainLut, SceneSampler, Shaper, bake};

const PROCESSES: [(&str, &str); 2] = [("negative", "kodak-5207"), ("reversal", "fuji-velvia-50")];

fn film(camera: &str) -> Reference {
    Process::for_camera(camera).and_then(|process| process.compile()).expect("a built-in process compiles")
}

fn scene(count: usize) -> Vec<[f32; 3]> {
    let colours = SceneSampler::new(-8.0..=6.0).expect("the range is in bounds");
    colours.take(count).map(|rgb| rgb.map(|v| v as f32)).collect()
}

fn compile(c: &mut Criterion) {
    let mut group = c.benchmark_group("compile");
    for (name, camera) in PROCESSES {
        group.bench_function(name, |b| b.iter(|| film(black_box(camera))));
    }
}

fn develop(c: &mut Criterion) {
    let mut group = c.benchmark_group("develop one pixel at a time, reference, one thread");
    let colours = scene(1 << 10);
    group.throughput(Throughput::Elements(colours.len() as u64));
    for (name, camera) in PROCESSES {
        let film = film(camera);
        group.bench_function(name, |b| {
            b.iter(|| {
                for rgb in &colours {
                    black_box(film.develop(rgb.map(f64::from)));
                }
            });
        });
    }
}

fn table(c: &mut Criterion) {
    let film = film("kodak-5207");
    let shaper = Shaper::log2(0.02, 11.52).expect("the shaper is valid");
    let mut group = c.benchmark_group("plain table of 33^3, all threads");
    group.sample_size(10);
    group.bench_function("bake", |b| b.iter(|| bake(33, &shaper, |rgb| film.develop(rgb), |_| {})));
    let lut = bake(33, &shaper, |rgb| film.develop(rgb), |_| {}).expect("the table is finite");
    let lut = PlainLut::new(shaper, lut, Interpolation::Tetrahedral);
    let picture = scene(1920 * 1080);
    group.throughput(Throughput::Elements(picture.len() as u64));
    group.bench_function("apply to 1080p", |b| {
        b.iter_batched_ref(|| picture.clone(), |p| lut.apply_to_slice(p), BatchSize::LargeInput);
    });
    group.bench_function("copy of 1080p, the floor", |b| {
        let mut to = picture.clone();
        b.iter(|| to.copy_from_slice(black_box(&picture)));
    });
}

criterion_group!(benches, compile, develop, table);
criterion_main!(benches);
