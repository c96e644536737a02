//! Making a look ready: compiling a process, and setting the printer's lights.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use onelight::film::{AmountCurve, PerLayer};
use onelight::printing::{Duplication, Printer};
use onelight::stock;
use onelight_benches::{NEGATIVE, PROCESSES, film};

fn compile(c: &mut Criterion) {
    let mut group = c.benchmark_group("compile a process");
    group.sample_size(10);
    for (name, camera) in PROCESSES {
        group.bench_function(name, |b| b.iter(|| film(black_box(camera)).expect("a built-in process compiles")));
    }
}

fn calibrate(c: &mut Criterion) {
    let film = film(NEGATIVE).expect("a built-in process compiles");
    let stock = |id| stock(id).expect("a built-in stock");
    let printer = Duplication::new(&stock(NEGATIVE), &stock("kodak-2383"), Printer::default())
        .expect("a negative prints on a print film");
    let grey = film.camera_curves().zip_map(film.mid_grey(), AmountCurve::amount);
    let target = film.print_target().unwrap_or(PerLayer::all(film.mid_grey().red));
    c.bench_function("calibrate the printer's lights", |b| {
        b.iter(|| printer.calibrate(black_box(grey), black_box(target)).expect("the aim can be reached"));
    });
}

criterion_group!(benches, compile, calibrate);
criterion_main!(benches);
