use onelight_film::LogExposure;
use onelight_spatial::{FilmFormat, Finish, Frame, MtfFit, Pitch, Planes, Sharpness, SpatialStage, Taps};

use crate::film::{Film, reference, stock};

const VISION3: [&str; 4] = ["kodak-5203", "kodak-5207", "kodak-5213", "kodak-5219"];

/// Names of the films in the reference.
fn id_of(name: &str) -> String {
    let vision = ["_vision3_50d", "_vision3_250d", "_vision3_200t", "_vision3_500t", "_vision_320t", "_exr_100t"];
    vision.iter().fold(name.to_owned(), |name, part| name.replace(part, "")).replace('_', "-")
}

#[test]
fn fits_are_as_near_as_those_of_an_independent_implementation() {
    let mut compared = 0;
    for (name, layers) in reference()["mtf_fits"].as_object().unwrap() {
        let Ok(fits) = MtfFit::of_stock(&stock(&id_of(name))) else {
            assert_eq!(name, "fuji_provia_100f", "refused");
            continue;
        };
        for (layer, theirs) in layers.as_object().unwrap() {
            let fit = match layer.as_str() {
                "g" => fits.green,
                "b" => fits.blue,
                _ => fits.red,
            };
            // The strength of adjacency has a share in what is made least: a fit may be a little further for less of it.
            assert!(fit.rms < 1.02 * theirs["rms"].as_f64().unwrap() + 1e-4, "{name} {layer}: {fit:?}");
            for (f, model) in [10.0, 20.0, 40.0].iter().zip(theirs["model_10_20_40"].as_array().unwrap()) {
                assert!((fit.response(*f) - model.as_f64().unwrap()).abs() < 0.003, "{name} {layer} at {f}: {fit:?}");
            }
            compared += 1;
        }
    }
    assert!(compared >= 27, "{compared}");
}

#[test]
fn the_sheets_own_numbers() {
    // Read off the sheets at 10, 20 and 40 cycles per mm: red, green, blue.
    let sheets = [
        ("kodak-5207", [[0.97, 0.77, 0.41], [1.02, 0.93, 0.62], [1.05, 1.02, 0.73]]),
        ("kodak-5219", [[1.03, 0.79, 0.42], [1.05, 0.97, 0.65], [1.09, 1.06, 0.70]]),
    ];
    for (id, layers) in sheets {
        let fits = MtfFit::of_stock(&stock(id)).unwrap().to_array();
        for (fit, sheet) in fits.iter().zip(layers) {
            for (f, published) in [10.0, 20.0, 40.0].into_iter().zip(sheet) {
                assert!((fit.response(f) - published).abs() < 0.025, "{id} at {f}: {fit:?}");
            }
        }
    }
    for id in VISION3 {
        for fit in MtfFit::of_stock(&stock(id)).unwrap().to_array() {
            assert!(fit.rms < 0.0165 && fit.worst < 0.0405, "{id}: {fit:?}");
            assert_eq!(fit.response(0.0), 1.0);
        }
    }
}

#[test]
fn curves_that_are_not_the_films_own_are_refused() {
    let message = |id: &str| MtfFit::of_stock(&stock(id)).unwrap_err();
    assert_eq!(
        message("fuji-provia-100f").to_string(),
        "fuji-provia-100f: modulation transfer of the red layer: found 1.1709 at its lowest frequency, 1.3438 cycles per mm, \
         expected 0.85 to 1.15: 1 must stand for large areas"
    );
    assert!(message("fuji-velvia-50").to_string().contains("the points of Fuji FP-100C"));
    assert!(message("kodak-2383").is_not_published());
    let jagged = [(5.0, 1.0), (10.0, 0.6), (20.0, 0.9), (40.0, 0.3)];
    assert!(MtfFit::of_points(&jagged).unwrap_err().to_string().contains("from the best fit, expected at most 0.06"));
    for wrong in [
        vec![(5.0, 1.0)],
        vec![(5.0, 1.0), (5.0, 0.9)],
        vec![(f64::NAN, 1.0), (9.0, 1.0)],
        vec![(5.0, 1.0), (9.0, f64::NAN)],
    ] {
        assert!(MtfFit::of_points(&wrong).is_err(), "{wrong:?}");
    }
    for wrong in [-1.0, f64::NAN, 1e9] {
        assert!(Taps::gaussian(wrong).is_err());
    }
}

#[test]
fn taps_of_an_independent_implementation() {
    for (name, theirs) in reference()["taps"].as_object().unwrap() {
        let number =
            |key: &str| name.split_whitespace().find_map(|p| p.strip_prefix(key)).unwrap().parse::<f64>().unwrap();
        let found = Taps::gaussian(number("s=") / number("pitch=")).unwrap();
        let theirs: Vec<f64> = theirs.as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect();
        let all = std::iter::once(found.centre()).chain(found.side().iter().copied()).chain(std::iter::repeat(0.0));
        // Theirs are least squares over samples of frequency, ours over all of them.
        for (found, theirs) in all.zip(&theirs[theirs.len() / 2..]) {
            assert!((found - theirs).abs() < 4e-4, "{name}: {found} for {theirs}");
        }
    }
}

#[test]
fn pixels_show_the_fitted_response_up_to_near_nyquist() {
    let mut largest = [0.0f64; 2];
    for id in ["kodak-5207", "kodak-5219"] {
        for fit in MtfFit::of_stock(&stock(id)).unwrap().to_array() {
            for width in [1024, 2048, 4096] {
                let pitch = FilmFormat::Super35.pitch(width, 1.0).unwrap().x_um();
                let [narrow, wide, beside] =
                    [fit.narrow_um, fit.wide_um, fit.adjacency_um].map(|um| Taps::gaussian(um / pitch).unwrap());
                let miss = |cycles: f64| {
                    let [n, w, b] = [&narrow, &wide, &beside].map(|taps| taps.response(cycles));
                    let scatter = fit.narrow_share * n + (1.0 - fit.narrow_share) * w;
                    let found = scatter * (1.0 + fit.adjacency * (1.0 - b));
                    (found - fit.response(1000.0 * cycles / pitch)).abs()
                };
                largest[0] = (0..=40).map(|i| miss(0.01 * f64::from(i))).fold(largest[0], f64::max);
                largest[1] = largest[1].max(miss(0.5));
            }
        }
    }
    assert!(largest[0] <= 0.037 && largest[1] <= 0.0925, "{largest:?}");
}

/// Modulation of a row about its mean at a frequency, in cycles per pixel.
fn modulation(row: &[f64], cycles: f64) -> f64 {
    let mean = row.iter().sum::<f64>() / row.len() as f64;
    let wave = |f: fn(f64) -> f64| {
        let phase = |i: usize| f(2.0 * std::f64::consts::PI * cycles * i as f64);
        2.0 * row.iter().enumerate().map(|(i, v)| v * phase(i)).sum::<f64>() / row.len() as f64
    };
    wave(f64::cos).hypot(wave(f64::sin)) / mean
}

#[test]
fn a_sine_wave_of_light_comes_back_as_the_sheet_says() {
    // Sheets are read with waves of about 35 % and back through the large-area curve. Pixels of 2.5 um, so that nothing else blurs.
    let pitch = Pitch::new(2.5, 2.5).unwrap();
    for id in ["kodak-5207", "kodak-5219"] {
        let film = Film::new(id);
        let sharpness = Sharpness::of_stock(&film.stock).unwrap();
        let frame = Frame::new([4000, 1], pitch).unwrap();
        let stage = SpatialStage::new(frame).with_sharpness(&sharpness);
        for stops in [-2.0f64, 0.0, 2.0, 4.0] {
            for period in [40usize, 20, 10] {
                let mut exposures = Planes::new(4000, 0..1).unwrap();
                for layer in exposures.row_mut(0) {
                    for (i, e) in layer.iter_mut().enumerate() {
                        let phase = 2.0 * std::f64::consts::PI * (i as f64 + 0.5) / period as f64;
                        *e = (stops.exp2() * (1.0 + 0.35 * phase.sin())) as f32;
                    }
                }
                let amounts = stage.amounts(&exposures, None, 0..1, &|e: [f32; 3]| film.develop(e)).unwrap();
                let layers = amounts.row(0).into_iter().zip(film.curves.as_ref().to_array());
                for ((amounts, curve), fit) in layers.zip(sharpness.layers().to_array()) {
                    // Whole periods, away from the ends.
                    let read = amounts[1000..3000].iter().map(|a| {
                        let h = curve.log_exposure(onelight_film::DyeAmount(f64::from(*a))).unwrap();
                        LogExposure(h.0 - film.mid_grey.0).exposure()
                    });
                    let found = modulation(&read.collect::<Vec<_>>(), 1.0 / period as f64) / 0.35;
                    let expected = fit.response(1000.0 / (period as f64 * 2.5));
                    assert!((found / expected - 1.0).abs() < 0.02, "{id} {stops} {period}: {found} for {expected}");
                }
            }
        }
    }
}

#[test]
fn a_picture_of_twice_the_size_shrunk_is_as_sharp() {
    // A scene that a lens has drawn: nothing finer than three pixels of the larger size.
    let film = Film::new("kodak-5219");
    let sharpness = Sharpness::of_stock(&film.stock).unwrap();
    let (width, height) = (240, 160);
    let scene = |x: f64, y: f64| {
        let edge = 1.0 / (1.0 + (-(x - 0.3 * y - 170.0) / 1.6).exp());
        let wave = (x / 5.0).sin() * (y / 9.0).cos() + ((x + 2.0 * y) / 40.0).sin();
        [1.0, 0.8, 0.6].map(|c| c * (0.1 + 3.0 * edge) * (0.6 * wave).exp2())
    };
    let develop = |e: [f32; 3]| film.develop(e);
    let light = |planes: &Planes, x: usize, y: usize| film.display_linear(planes.row(y).map(|l| f64::from(l[x])));
    let shown = |size: usize, with: bool| {
        let pixels = [width * size, height * size];
        let frame = Frame::new(pixels, FilmFormat::Super35.pitch(2048 * size, 1.0).unwrap()).unwrap();
        let mut exposures = Planes::new(pixels[0], 0..pixels[1]).unwrap();
        for y in 0..pixels[1] {
            for x in 0..pixels[0] {
                let points = (0..16 / (size * size)).map(|i| {
                    let n = 4 / size;
                    let at = |p: usize, i: usize| (p as f64 + (i as f64 + 0.5) / n as f64) * 2.0 / size as f64;
                    scene(at(x, i % n), at(y, i / n))
                });
                let sum = points.fold([0.0; 3], |s: [f64; 3], p| std::array::from_fn(|k| s[k] + p[k]));
                let row = exposures.row_mut(y);
                row.into_iter().zip(sum).for_each(|(row, s)| row[x] = (s * (size * size) as f64 / 16.0) as f32);
            }
        }
        let stage = SpatialStage::new(frame);
        let stage = if with { stage.with_sharpness(&sharpness) } else { stage };
        stage.amounts(&exposures, None, 0..pixels[1], &develop).unwrap()
    };
    let mean_difference = |with: bool| {
        let (small, large) = (shown(1, with), shown(2, with));
        // Away from the edges of the picture.
        let inside = (16..height - 16).flat_map(|y| (16..width - 16).map(move |x| (x, y)));
        let difference = |(x, y): (usize, usize)| {
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| light(&large, 2 * x + i, 2 * y + j));
            let shrunk = std::array::from_fn(|k| four.iter().map(|light| light[k]).sum::<f64>() / 4.0);
            film.difference(shrunk, light(&small, x, y))
        };
        let all: Vec<f64> = inside.map(difference).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    let (with, without) = (mean_difference(true), mean_difference(false));
    // Averaging light after the film is not averaging it before, with or without sharpness.
    assert!(with < 0.05 && with < without + 0.02, "{with}, without sharpness {without}");
}
