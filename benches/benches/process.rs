//! Making a look ready: compiling a process, setting the printer's lights, and following a setting that moves.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use onelight::film::{AmountCurve, PerLayer};
use onelight::lut::DirectForm;
use onelight::printing::{Duplication, Printer, White};
use onelight::{Aim, DirectSettings, FilmProcess, LiveDirect, stock};
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

/// From a setting that was moved, and moved back, to the numbers that draw: two direct forms, with the feature `gpu` one as bytes for a card.
fn follow(c: &mut Criterion) {
    let mut group = c.benchmark_group("follow a setting");
    group.sample_size(10);
    let usual = FilmProcess::for_camera(NEGATIVE).expect("a built-in film");
    let changed = |change: fn(&mut FilmProcess)| {
        let mut process = usual.clone();
        change(&mut process);
        process
    };
    let points = |process: &mut FilmProcess| {
        if let Some(print) = &mut process.print {
            print.points = [2.0, 0.0, -1.0];
        }
    };
    let white = |process: &mut FilmProcess| process.white = White::Lamp;
    for (name, moved) in [
        ("points", changed(points)),
        ("aim", changed(|process| process.aim = Aim::Sheet)),
        ("white", changed(white)),
        ("density of grey", changed(|process| process.neutral_density = 0.9)),
    ] {
        let mut live = LiveDirect::new(&usual, DirectSettings::default()).expect("a built-in process is fitted");
        group.bench_function(name, |b| {
            b.iter(|| {
                live.change(black_box(&moved)).expect("the setting is allowed");
                for_card(live.form());
                live.change(black_box(&usual)).expect("the setting is allowed");
            });
        });
    }
}

#[cfg(feature = "gpu")]
fn for_card(form: &DirectForm) {
    black_box(onelight_gpu::LookBytes::new(form, onelight::lut::Storage::F32).expect("the form fits a card"));
}

#[cfg(not(feature = "gpu"))]
fn for_card(form: &DirectForm) {
    black_box(form);
}

criterion_group!(benches, compile, calibrate, follow);
criterion_main!(benches);
