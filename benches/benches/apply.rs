//! Whole pictures, RGBA, through each form, between the types of sample that matter. A copy of the picture read is the floor.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use half::f16;
use onelight_benches::{FULL_HD, Forms, NEGATIVE, Size, Threads, ULTRA_HD, coded, film, natural, pool};
use onelight_lut::{Channels, PixelMap, Pixels, PixelsMut, Sample};
use rayon::ThreadPool;
use rayon::prelude::*;

/// Samples of a piece that one task copies.
const COPY_BLOCK: usize = 1 << 16;

/// Everything at one size on one number of threads.
struct Bench<'a> {
    group: BenchmarkGroup<'a, WallTime>,
    pool: &'a ThreadPool,
    size: Size,
}

impl Bench<'_> {
    fn map<S: Sample, T: Sample>(&mut self, name: &str, lut: &impl PixelMap, from: &[S]) {
        let mut to = vec![T::default(); from.len()];
        let from = Pixels::new(from, Channels::Rgba, self.size).expect("as many samples as it says");
        let mut to = PixelsMut::new(&mut to, Channels::Rgba, self.size).expect("as many samples as it says");
        self.group.bench_function(name, |b| {
            b.iter(|| self.pool.install(|| lut.map(black_box(&from), &mut to)).expect("pictures of one size"));
        });
    }

    fn in_place(&mut self, name: &str, lut: &impl PixelMap, from: &[f32]) {
        let size = self.size;
        self.group.bench_function(name, |b| {
            let apply = |samples: &mut Vec<f32>| {
                let mut pixels = PixelsMut::new(samples, Channels::Rgba, size).expect("as many samples as it says");
                self.pool.install(|| lut.map_in_place(&mut pixels));
            };
            b.iter_batched_ref(|| from.to_vec(), apply, BatchSize::PerIteration);
        });
    }

    fn copy<S: Sample>(&mut self, name: &str, from: &[S]) {
        let mut to = from.to_vec();
        let blocks = |from: &[S], to: &mut [S]| {
            let pieces = to.par_chunks_mut(COPY_BLOCK).zip(from.par_chunks(COPY_BLOCK));
            pieces.for_each(|(to, from)| to.copy_from_slice(from));
        };
        self.group.bench_function(name, |b| b.iter(|| self.pool.install(|| blocks(black_box(from), &mut to))));
    }

    /// The types a viewer and a renderer use.
    fn float(&mut self, form: &str, lut: &impl PixelMap, picture: &[f32]) {
        self.map::<f32, f32>(&format!("{form}, f32 to f32"), lut, picture);
        self.map::<f32, u8>(&format!("{form}, f32 to u8"), lut, picture);
    }

    /// The rest.
    fn other(&mut self, form: &str, lut: &impl PixelMap, picture: &[f32]) {
        self.map::<f32, u16>(&format!("{form}, f32 to u16"), lut, picture);
        self.map::<f16, f16>(&format!("{form}, f16 to f16"), lut, &coded::<f16>(picture));
        self.map::<u16, u16>(&format!("{form}, u16 to u16"), lut, &coded::<u16>(picture));
        self.in_place(&format!("{form}, f32 in place"), lut, picture);
    }
}

fn apply(c: &mut Criterion) {
    let film = film(NEGATIVE).expect("a built-in process compiles");
    let Forms { plain, structured, direct } = Forms::new(&film).expect("a built-in film is finite");
    for (name, size) in [("1080p", FULL_HD), ("4K", ULTRA_HD)] {
        let picture = natural(size);
        for threads in Threads::EACH {
            let pool = pool(threads).expect("the system gives threads");
            let mut group = c.benchmark_group(format!("apply to {name}, {}", threads.name()));
            group.throughput(Throughput::Elements((size[0] * size[1]) as u64));
            group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(800));
            let mut bench = Bench { group, pool: &pool, size };
            bench.copy("copy, f32", &picture);
            bench.float("plain", &plain, &picture);
            bench.float("structured", &structured, &picture);
            bench.float("direct", &direct, &picture);
            if size == FULL_HD {
                bench.copy("copy, f16", &coded::<f16>(&picture));
                bench.other("plain", &plain, &picture);
                bench.other("structured", &structured, &picture);
                bench.other("direct", &direct, &picture);
            }
        }
    }
}

criterion_group!(benches, apply);
criterion_main!(benches);
