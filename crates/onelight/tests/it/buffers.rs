//! Step 2: what low-precision frame buffers do to a grey ramp before the film (M5).

use onelight::Reference;
use onelight::spectra::BufferFormat;

use crate::films::talk::film;

/// All values of a small float, from the definition of its bits.
fn floats(mantissa_bits: i32, bias: i32, exponents: i32) -> Vec<f64> {
    let fraction = |m: i32| f64::from(m) / f64::from(1 << mantissa_bits);
    let value = |e: i32, m: i32| match e {
        0 => fraction(m) * f64::from(1 - bias).exp2(),
        _ => (1.0 + fraction(m)) * f64::from(e - bias).exp2(),
    };
    (0..exponents).flat_map(|e| (0..1 << mantissa_bits).map(move |m| value(e, m))).collect()
}

/// Largest visible step between neighbouring values of a buffer that stores scene light times `scale`, -8 to +4 stops.
fn largest_step(film: &Reference, values: &[f64], scale: f64) -> f64 {
    let difference = film.difference().unwrap();
    let in_range = |v: &&f64| (0.18 * 2f64.powi(-8)..=0.18 * 16.0).contains(&(**v / scale));
    let first = values.iter().rposition(|v| *v / scale < 0.18 * 2f64.powi(-8)).unwrap_or(0);
    let shown: Vec<_> = values[first..first + 1]
        .iter()
        .chain(values.iter().filter(in_range))
        .map(|v| film.develop_linear([v / scale; 3]))
        .collect();
    shown.windows(2).map(|pair| difference.between(pair[0], pair[1])).fold(0.0, f64::max)
}

/// The same through the library's own buffers.
fn by_library(film: &Reference, format: BufferFormat, scale: f64) -> f64 {
    let mut values: Vec<f64> = (0..=48_000)
        .map(|i| 0.18 * (f64::from(i) / 4000.0 - 8.0).exp2() * scale)
        .map(|v| format.quantise([v; 3])[0])
        .collect();
    values.dedup();
    let difference = film.difference().unwrap();
    let shown: Vec<_> = values.iter().map(|v| film.develop_linear([v / scale; 3])).collect();
    shown.windows(2).map(|pair| difference.between(pair[0], pair[1])).fold(0.0, f64::max)
}

#[test]
fn the_scale_factor_buys_what_is_stated() {
    let film = film("kodak-5207");
    let unorm: Vec<f64> = (0..=255).map(|i| f64::from(i) / 255.0).collect();
    let (float10, half) = (floats(7, 3, 8), floats(10, 15, 31));
    // Stated: 5.6, 0.8, 0.22, 0.06, on a ramp of steps of its own.
    for (name, values, format, scale, low, high) in [
        ("8 bit, white at 4", &unorm, BufferFormat::Unorm8, 0.25, 4.8, 6.0),
        ("7e3, grey at 0.18", &float10, BufferFormat::Float7e3, 1.0, 0.65, 0.85),
        ("7e3, grey at 0.72", &float10, BufferFormat::Float7e3, 4.0, 0.2, 0.24),
        ("half", &half, BufferFormat::Half, 1.0, 0.02, 0.07),
    ] {
        let (own, library) = (largest_step(&film, values, scale), by_library(&film, format, scale));
        assert!((low..=high).contains(&own), "{name}: {own}");
        assert!((own - library).abs() < 0.1 * own + 0.01, "{name}: {own} against {library}");
    }
}
