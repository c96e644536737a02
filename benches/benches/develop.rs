//! Single colours through the film on one thread: exposure alone, and every form to the display.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use onelight::film::LogExposure;
use onelight_benches::{Forms, PROCESSES, film, natural};

/// A piece of the picture small enough for the exact film.
const PIECE: [usize; 2] = [64, 36];

fn develop(c: &mut Criterion) {
    let colours: Vec<[f32; 3]> = natural(PIECE).chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
    for (name, camera) in PROCESSES {
        let film = film(camera).expect("a built-in process compiles");
        let forms = Forms::new(&film).expect("a built-in film is finite");
        let mut group = c.benchmark_group(format!("develop colours, {name}, one thread"));
        group.throughput(Throughput::Elements(colours.len() as u64));
        group.sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(1));
        let mut each = |name: &str, develop: &dyn Fn([f32; 3])| {
            group.bench_function(name, |b| b.iter(|| colours.iter().for_each(|&rgb| develop(black_box(rgb)))));
        };
        each("expose: matrix and logarithm", &|rgb| {
            black_box(film.exposure_matrix().expose(rgb.map(f64::from)).map(LogExposure::of));
        });
        each("reference", &|rgb| {
            black_box(film.develop(rgb.map(f64::from)));
        });
        each("direct", &|rgb| {
            black_box(forms.direct.apply(rgb));
        });
        each("structured", &|rgb| {
            black_box(forms.structured.apply(rgb));
        });
        each("plain", &|rgb| {
            black_box(forms.plain.apply(rgb));
        });
    }
}

criterion_group!(benches, develop);
criterion_main!(benches);
