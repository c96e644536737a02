use super::spectrum::{self, NODES, bell, rise};
use super::*;

const SIZE: (usize, usize) = (320, 180);

/// Sensors: luminosity, then blue, green and red light.
fn sensors() -> [Nodes; 4] {
    let luminosity = std::array::from_fn(|node| {
        let mut one = [0.0; NODES];
        one[node] = 1.0;
        spectrum::luminance(&one)
    });
    let band = |centre_nm: f32| spectrum::sample(|nm| bell(nm, centre_nm, 25.0) / 6.3);
    [luminosity, band(450.0), band(540.0), band(610.0)]
}

/// A chart of the like of the ColorChecker: 18 colours, then six greys from white to black.
fn chart() -> [Nodes; 24] {
    std::array::from_fn(|i| match i {
        0..6 => spectrum::sample(|nm| 0.05 + 0.6 * rise(nm, 480.0 + 25.0 * i as f32, 12.0)),
        6..12 => spectrum::sample(|nm| 0.05 + 0.5 * rise(-nm, -660.0 + 25.0 * (i - 6) as f32, 12.0)),
        12..18 => spectrum::sample(|nm| 0.05 + 0.5 * bell(nm, 440.0 + 35.0 * (i - 12) as f32, 20.0)),
        _ => [[0.9, 0.59, 0.36, 0.19, 0.09, 0.03][i - 18]; NODES],
    })
}

fn picture(size: (usize, usize)) -> Image {
    render(size, &Inputs { color_checker: &chart() }, &sensors())
}

fn at(image: &Image, (x, y): (usize, usize)) -> &[f32] {
    &image.responses[4 * (y * image.width + x)..][..4]
}

#[test]
fn grey_card_is_exposed_at_18_percent() {
    let size = (640, 360);
    let grey = at(&picture(size), patches(size).grey_card)[0];
    // Exact at the card's centre; the patch is a pixel's width from there.
    assert!((grey - 0.18).abs() < 0.002, "{grey}");
}

#[test]
fn wedge_climbs_one_stop_a_step_from_minus_seven() {
    for size in [SIZE, (640, 360)] {
        let image = picture(size);
        for (step, centre) in patches(size).wedge.into_iter().enumerate() {
            let stops = (at(&image, centre)[0] / 0.18).log2();
            assert!((stops - (step as f32 - 7.0)).abs() < 1e-4, "step {step} at {size:?}: {stops}");
        }
    }
}

#[test]
fn wedge_is_white_at_6500_kelvin() {
    let image = picture(SIZE);
    let white = spectrum::black_body(6500.0);
    let expected = sensors().map(|s| s.iter().zip(&white).map(|(w, l)| w * l).sum::<f32>() * 0.18);
    for (found, expected) in at(&image, patches(SIZE).wedge[7]).iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
    }
}

#[test]
fn chart_patches_are_large_and_stand_in_chart_order() {
    let image = picture((640, 360));
    let places = patches((640, 360)).color_checker;
    let seen = places.map(|p| at(&image, p).to_vec());
    for (i, a) in seen.iter().enumerate() {
        for b in &seen[..i] {
            let apart = a.iter().zip(b).map(|(a, b)| (a / b).log2().abs()).fold(0.0, f32::max);
            assert!(apart > 0.05, "patch {i}: {apart}");
        }
        // A square of 14 pixels about the centre shows the patch and nothing else.
        for (dx, dy) in [(0, 7), (14, 7), (7, 0), (7, 14), (0, 0), (14, 14)] {
            let (x, y) = (places[i].0 + dx - 7, places[i].1 + dy - 7);
            let there = at(&image, (x, y));
            let near = there.iter().zip(a).all(|(t, a)| (t / a - 1.0).abs() < 0.1);
            assert!(near, "patch {i} at {dx}, {dy}: {there:?} {a:?}");
        }
    }
    assert!(seen[18..].windows(2).all(|pair| pair[0][0] > 1.2 * pair[1][0]));
}

#[test]
fn chart_answers_its_light_by_its_reflectance() {
    // Neighbours in the neutral row stand in nearly the same light.
    let image = picture(SIZE);
    let places = patches(SIZE).color_checker;
    for sensor in 0..4 {
        let ratio = at(&image, places[19])[sensor] / at(&image, places[18])[sensor];
        assert!((ratio / (0.59 / 0.9) - 1.0).abs() < 0.05, "sensor {sensor}: {ratio}");
    }
}

#[test]
fn picture_is_the_same_on_every_run_and_any_number_of_threads() {
    let several = picture(SIZE);
    assert_eq!(several, picture(SIZE));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(several, one.install(|| picture(SIZE)));
}

#[test]
fn light_is_finite_and_spans_fourteen_stops() {
    let image = picture(SIZE);
    assert_eq!(image.responses.len(), 4 * SIZE.0 * SIZE.1);
    assert!(image.responses.iter().all(|r| r.is_finite() && *r >= 0.0));
    let luminance = || image.responses.iter().step_by(4).copied().filter(|l| *l > 0.0);
    let stops = (luminance().fold(0.0, f32::max) / luminance().fold(f32::MAX, f32::min)).log2();
    assert!(stops > 14.0, "{stops}");
}

#[test]
fn picture_has_no_speckles() {
    // Noise leaves pixels that stand out from all eight neighbours. Highlights and thin stems do so too, but are few.
    let image = picture((640, 360));
    let log = |x: usize, y: usize| (at(&image, (x, y))[0] + 1e-3).log2();
    let lonely = |x: usize, y: usize| {
        let ring = (0..9).filter(|i| *i != 4).map(|i| log(x, y) - log(x + i % 3 - 1, y + i / 3 - 1));
        ring.clone().all(|d| d > 0.3) || ring.clone().all(|d| d < -0.3)
    };
    let count = (1..359).flat_map(|y| (1..639).map(move |x| (x, y))).filter(|&(x, y)| lonely(x, y)).count();
    assert!(count < 640 * 360 / 1000, "{count}");
}

#[test]
fn reflectances_stay_between_black_and_white() {
    let pairs = [palette::walnut(), palette::leaf(), palette::orange(), palette::pear(), palette::plum()];
    let singles = [palette::brass(), palette::bark(), palette::cobalt_glass(), palette::skin(1.0), palette::skin(0.3)];
    for spectrum in pairs.iter().flatten().chain(&singles) {
        assert!(spectrum.iter().all(|r| (0.0..=1.0).contains(r)), "{spectrum:?}");
    }
}

#[test]
fn picture_without_pixels_is_empty() {
    assert!(picture((0, 0)).responses.is_empty());
    assert!(picture((0, 9)).responses.is_empty());
}
