//! Making tables from the exact film, on all threads.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use onelight::{DirectSettings, Reference, StructuredSettings};
use onelight_benches::{NEGATIVE, film, shaper};
use onelight_lut::{bake, bake_form};

/// Nodes along each side.
const SIZES: [usize; 4] = [16, 32, 33, 64];

fn negative() -> Reference {
    film(NEGATIVE).expect("a built-in process compiles")
}

fn plain(c: &mut Criterion) {
    let (film, shaper) = (negative(), shaper().expect("its numbers are in range"));
    let form = film.direct(&DirectSettings::BAKING).expect("a built-in film is finite");
    let at = |coordinates: [f64; 3]| coordinates.map(|t| shaper.decode(t));
    let mut group = c.benchmark_group("bake a plain table, all threads");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    for size in SIZES {
        group.throughput(Throughput::Elements(size.pow(3) as u64));
        group.bench_function(BenchmarkId::new("reference", size), |b| {
            b.iter(|| bake(size, &shaper, |rgb| film.develop(rgb), |_| {}));
        });
        group.bench_function(BenchmarkId::new("usual", size), |b| b.iter(|| film.bake(size, at)));
        group.bench_function(BenchmarkId::new("usual, its form made before", size), |b| {
            b.iter(|| bake_form(size, at, &form));
        });
    }
}

fn structured(c: &mut Criterion) {
    let film = negative();
    let mut group = c.benchmark_group("fit a structured table, all threads");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    for size in [16, 32] {
        let settings = StructuredSettings { size, ..Default::default() };
        group.bench_function(BenchmarkId::from_parameter(size), |b| b.iter(|| film.structured(&settings)));
    }
}

fn direct(c: &mut Criterion) {
    let film = negative();
    let mut group = c.benchmark_group("make the direct form, all threads");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    for (name, settings) in [("fitted", DirectSettings::default()), ("to bake with", DirectSettings::BAKING)] {
        group.bench_function(name, |b| b.iter(|| film.direct(&settings)));
    }
}

criterion_group!(benches, plain, structured, direct);
criterion_main!(benches);
