use std::sync::atomic::{AtomicUsize, Ordering};

use super::scene_coordinates::SceneCoordinates;
use super::*;
use crate::SceneSampler;

/// A toy film: layers that see each other's light, each with an S-shaped curve from black to white.
fn film(rgb: [f64; 3]) -> [f64; 3] {
    [[0.8, 0.15, 0.05], [0.1, 0.8, 0.1], [0.02, 0.13, 0.85]].map(|row| {
        let exposure: f64 = row.iter().zip(rgb).map(|(k, u)| k * u.max(0.0)).sum();
        0.002 + 0.99 * (exposure / (exposure + 0.3)).powf(1.4)
    })
}

/// The Euclidean distance of two colours, in percent of white.
fn difference(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    100.0 * a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn luminance(v: &[f64; 3]) -> f64 {
    0.2 * v[0] + 0.7 * v[1] + 0.1 * v[2]
}

fn law() -> SamplingLaw {
    SamplingLaw { count: 1 << 12, fold_places: 256, ..SamplingLaw::default() }
}

fn chart() -> ColourSet {
    ColourSet::new("chart", [("skin", [0.5, 0.35, 0.3]), ("sky", [0.15, 0.25, 0.5]), ("leaf", [0.1, 0.2, 0.05])])
        .unwrap()
}

fn certificate_of(law: &SamplingLaw, search: Search, candidate: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Certificate {
    let samples = Samples::new(law, &[chart()], film, |_| {}).unwrap();
    certify(&samples, &Maps { reference: film, candidate, difference, luminance }, search, |_| {}).unwrap()
}

fn certificate(candidate: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Certificate {
    certificate_of(&law(), Search::Ascent, candidate)
}

/// The film, and in all channels a hill of the given height around one colour, half a stop, 0.06 of saturation and
/// 0.25 of hue wide.
fn bumped(peak: SceneCoordinates, height: f64) -> impl Fn([f64; 3]) -> [f64; 3] + Sync {
    move |rgb| {
        let at = SceneCoordinates::of(rgb);
        let away = ((at.stops - peak.stops) / 0.5).powi(2)
            + ((at.saturation - peak.saturation) / 0.06).powi(2)
            + ((at.hue - peak.hue) / 0.25).powi(2);
        film(rgb).map(|v| v + height * (-0.5 * away).exp())
    }
}

#[test]
fn identical_maps_give_zeros_and_pass() {
    let found = certificate(film);
    assert_eq!((found.headline_mean, found.max_found, found.overall.max), (0.0, 0.0, 0.0));
    assert_eq!(found.neutral_axis.max, 0.0);
    assert_eq!(found.neutral_axis.fall, Fall::default());
    assert_eq!((found.folds.folds, found.folds.first), (0, None));
    assert_eq!(found.colour_sets[0].max, 0.0);
    for circle in &found.hue_steps {
        assert_eq!((circle.ratio, circle.excess, circle.max), (Some(1.0), 0.0, 0.0));
    }
    assert!(found.passed(0.0), "{:?}", found.failures(0.0));
}

#[test]
fn ascents_find_the_peak_that_samples_miss() {
    let mut missed = 0;
    for (index, colour) in SceneSampler::with_seed(-9.0..=9.0, 5).unwrap().take(12).enumerate() {
        let peak = SceneCoordinates::of(colour);
        let height = 0.05;
        let expected = difference(&[0.0; 3], &[height; 3]);
        let found = certificate(bumped(peak, height));
        assert!(found.max_found > 0.99 * expected && found.max_found <= expected * (1.0 + 1e-9), "{index} {peak:?}");
        let at = SceneCoordinates::of(found.max_found_at);
        assert!(
            (at.stops - peak.stops).abs() < 0.1 && (at.saturation - peak.saturation).abs() < 0.02,
            "{at:?} {peak:?}"
        );
        missed += usize::from(found.overall.max < 0.99 * expected);
        let plain = certificate_of(&law(), Search::SamplesOnly, bumped(peak, height));
        assert_eq!((plain.max_found, plain.max_found_at), (plain.overall.max, plain.overall.worst));
        assert_eq!(plain.overall, found.overall);
    }
    assert!(missed >= 10, "{missed} of 12");
}

#[test]
fn the_highest_of_several_hills_wins() {
    // Twenty broad hills of 0.04 hold the worst samples; a narrow one of 0.05 must still be climbed.
    let sharp = SceneCoordinates { stops: 1.3, saturation: 0.33, hue: 2.6 };
    let map = |rgb| {
        let at = SceneCoordinates::of(rgb);
        let broad = 0.04 * (at.stops * std::f64::consts::PI / 2.0).sin().powi(2) * (1.0 - at.saturation);
        bumped(sharp, 0.05)(rgb).map(|v| v + broad)
    };
    let expected = 0.05 + 0.04 * (1.3 * std::f64::consts::PI / 2.0).sin().powi(2) * 0.67;
    let found = certificate(map);
    assert!(found.max_found > 0.99 * difference(&[0.0; 3], &[expected; 3]), "{}", found.max_found);
}

#[test]
fn bands_add_up_and_show_where_the_error_is() {
    // Half a percent off, above +2 stops only.
    let map = |rgb: [f64; 3]| {
        let bright = rgb.iter().copied().fold(0.0, f64::max) >= 0.72;
        film(rgb).map(|v| if bright { v + 0.005 } else { v })
    };
    let found = certificate_of(&law(), Search::SamplesOnly, map);
    let ends: Vec<_> = found.bands.iter().map(|band| band.stops).collect();
    assert_eq!(ends, [[-10.0, -6.0], [-6.0, -2.0], [-2.0, 2.0], [2.0, 6.0], [6.0, 10.0]]);
    let counts: Vec<_> = found.bands.iter().map(|band| band.deviation.count).collect();
    assert_eq!(counts.iter().sum::<usize>(), found.overall.count);
    // Five standard deviations of a binomial count: 5 sqrt(4096 / 5 * 4 / 5).
    assert!(counts.iter().all(|&count| count.abs_diff(4096 / 5) < 130), "{counts:?}");
    let sum: f64 = found.bands.iter().map(|band| band.deviation.mean * band.deviation.count as f64).sum();
    assert!((sum / 4096.0 - found.overall.mean).abs() < 1e-12);
    let step = difference(&[0.0; 3], &[0.005; 3]);
    for (index, band) in found.bands.iter().enumerate() {
        let want = if index >= 3 { step } else { 0.0 };
        assert!((band.deviation.mean - want).abs() < 1e-9 && (band.deviation.max - want).abs() < 1e-9);
        let stops = SceneCoordinates::of(band.deviation.worst).stops;
        assert!(stops >= band.stops[0] - 1e-9 && stops <= band.stops[1] + 1e-9);
    }
    assert!((found.headline_mean - step).abs() < 1e-9);
}

#[test]
fn a_fold_is_caught_where_it_is() {
    // Between 0 and 2 stops of exposure red and green change places: every colour stays within the range of its
    // neighbours, and greys change little.
    let map = |[r, g, b]: [f64; 3]| {
        let inside = (0.18..0.72).contains(&r) && (0.18..0.72).contains(&g);
        if inside { film([g, r, b]) } else { film([r, g, b]) }
    };
    let found = certificate(map);
    assert!(found.folds.folds > 10, "{:?}", found.folds);
    let first = found.folds.first.unwrap();
    // The first is a grey, whose stencil just lies inside; greys come before drawn colours.
    assert!((0.17..0.76).contains(&first[0]) && (first[0] - first[1]).abs() < 1e-12, "{first:?}");
    assert!(found.failures(f64::INFINITY).iter().any(|f| f.starts_with("folds: found at")));
}

#[test]
fn a_fold_off_the_axis_is_caught() {
    // Blue runs backwards in deep reds.
    let map = |[r, g, b]: [f64; 3]| film([r, g, if r > 2.0 * g.max(b) { 0.25 * r * r / b.max(0.02 * r) } else { b }]);
    let found = certificate(map);
    let [r, g, b] = found.folds.first.unwrap();
    assert!(r > 1.9 * g.max(b));
}

#[test]
fn clipped_and_flat_places_are_no_folds() {
    // A display that clips half of the reference's range, and a candidate that clips as it should.
    let bright = |rgb| film(rgb).map(|v| 2.0 * v - 0.1);
    let samples = Samples::new(&law(), &[], bright, |_| {}).unwrap();
    let clipped = |rgb| bright(rgb).map(|v| v.clamp(0.0, 1.0));
    let maps = Maps { reference: bright, candidate: clipped, difference, luminance };
    let found = certify(&samples, &maps, Search::SamplesOnly, |_| {}).unwrap().folds;
    assert_eq!((found.folds, found.places), (0, 161 + 256));
    assert!(found.clipped > 100 && found.clipped + found.flat < found.places, "{found:?}");

    // Ripples of 3e-5 turn the sign of the flat ends over and over, and of nothing else.
    let rippled = |rgb: [f64; 3]| film(rgb.map(|u| u * (1.0 + 1e-3 * (40.0 * u.max(1e-9).log2()).sin())));
    let found = certificate(rippled).folds;
    assert_eq!(found.folds, 0, "{found:?}");
    assert!(found.flat > 0 && found.places - found.flat - found.clipped > 150, "{found:?}");
}

#[test]
fn a_neutral_axis_that_falls_is_caught() {
    // A dent a third of a stop wide at +3.
    let map = |rgb: [f64; 3]| {
        let stops = SceneCoordinates::of(rgb).stops - 3.0;
        film(rgb).map(|v| v - 0.05 * (-0.5 * (stops / 0.15).powi(2)).exp())
    };
    let found = certificate(map);
    let fall = found.neutral_axis.fall;
    assert!(fall.luminance > 1e-3 && (2.6..=3.0).contains(&fall.stops.unwrap()), "{fall:?}");
    assert_eq!(found.neutral_axis.reference_fall, Fall::default());
    assert_eq!(found.neutral_axis.worst_stops, 3.0);
    assert_eq!(found.neutral_axis.count, 161);
    assert!(found.failures(f64::INFINITY)[0].starts_with("neutral axis: luminance falls by"));

    // A reference that falls by itself excuses a candidate that falls alike.
    let samples = Samples::new(&law(), &[], map, |_| {}).unwrap();
    let maps = Maps { reference: map, candidate: map, difference, luminance };
    let same = certify(&samples, &maps, Search::SamplesOnly, |_| {}).unwrap();
    assert_eq!(same.neutral_axis.fall, fall);
    assert!(same.passed(0.0));
}

#[test]
fn a_hue_kink_is_caught() {
    // From 200 to 260 degrees, saturated colours are 1.5 % of white off.
    let map = |rgb| {
        let at = SceneCoordinates::of(rgb);
        let off = at.saturation > 0.99 && (200.1..260.1).contains(&(60.0 * at.hue));
        film(rgb).map(|v| if off { v + 0.015 } else { v })
    };
    let found = certificate(map);
    // Without the kink nothing would be above; with it, one of its two edges is, less the reference's own step.
    let edge = difference(&[0.0; 3], &[0.015; 3]);
    for circle in &found.hue_steps {
        assert!([200.0, 260.0].contains(&circle.excess_hue), "{circle:?}");
        assert!(circle.excess > 0.5 * edge && circle.excess <= edge, "{circle:?}");
        assert!((circle.max - edge).abs() < 1e-9 && (200.5..=260.0).contains(&circle.max_hue), "{circle:?}");
    }
    // In the dark the kink is the largest step of all, too.
    assert!([200.0, 260.0].contains(&found.hue_steps[0].candidate_hue));
    assert!(found.hue_steps[0].ratio.unwrap() > 5.0);
    let hue_failures = |limit| {
        let failures = found.failures(limit);
        let [largest, local] = ["hue steps at +0 stops: ", "hue step at +6 stops, "]
            .map(|start| failures.iter().any(|failure| failure.starts_with(start)));
        (largest, local)
    };
    assert_eq!(
        (hue_failures(0.5 * edge), hue_failures(edge), hue_failures(100.0)),
        ((true, true), (true, false), (false, false))
    );
}

#[test]
fn named_colours_are_named() {
    // Wrong around one patch at +2 stops.
    let target = [0.6, 1.0, 2.0];
    let map = |rgb: [f64; 3]| {
        let near = rgb.iter().zip(target).all(|(u, t)| (u / t - 1.0).abs() < 0.1);
        film(rgb).map(|v| if near { v + 0.01 } else { v })
    };
    let found = &certificate(map).colour_sets[0];
    assert_eq!((found.name.as_str(), found.worst_name.as_str(), found.worst_stops), ("chart", "sky", 2.0));
    assert_eq!((found.count, found.worst), (27, target));
    let step = difference(&[0.0; 3], &[0.01; 3]);
    assert!((found.max - step).abs() < 1e-9 && (found.mean - step / 27.0).abs() < 1e-9);
}

#[test]
fn threads_do_not_matter() {
    let measure_on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| certificate(|rgb| film(rgb).map(|v| (v * 255.0).round() / 255.0)))
    };
    assert_eq!(measure_on(1), measure_on(5));
}

#[test]
fn samples_serve_many_candidates() {
    let calls = AtomicUsize::new(0);
    let counted = |rgb| {
        calls.fetch_add(1, Ordering::Relaxed);
        film(rgb)
    };
    let reported = AtomicUsize::new(0);
    let samples = Samples::new(&law(), &[chart()], counted, |done| {
        reported.fetch_max(done, Ordering::Relaxed);
    })
    .unwrap();
    let made = calls.load(Ordering::Relaxed);
    assert_eq!((made, reported.load(Ordering::Relaxed)), (samples.evaluations(Search::SamplesOnly), made));

    for levels in [31.0, 255.0] {
        let candidate = |rgb| film(rgb).map(|v| (v * levels).round() / levels);
        let maps = Maps { reference: counted, candidate, difference, luminance };
        let found = certify(&samples, &maps, Search::SamplesOnly, |_| {}).unwrap();
        assert_eq!(found.overall, samples.deviation(candidate, difference).unwrap());
    }
    assert_eq!(calls.load(Ordering::Relaxed), made);

    let candidate = |rgb| film(rgb).map(|v| v + 0.001 * (9.0 * v).sin());
    let maps = Maps { reference: counted, candidate, difference, luminance };
    reported.store(0, Ordering::Relaxed);
    certify(&samples, &maps, Search::Ascent, |done| {
        reported.fetch_max(done, Ordering::Relaxed);
    })
    .unwrap();
    let climbed = calls.load(Ordering::Relaxed) - made;
    assert!(climbed > 1000 && climbed <= 4000, "{climbed}");
    assert_eq!(reported.load(Ordering::Relaxed), made + climbed);
    assert!(reported.load(Ordering::Relaxed) <= samples.evaluations(Search::Ascent));
}

#[test]
fn seeds_draw_other_colours() {
    let of = |seed| {
        certificate_of(&SamplingLaw { seed, ..law() }, Search::SamplesOnly, |rgb| film(rgb).map(f64::sqrt)).overall
    };
    assert_ne!(of(1), of(2));
    assert_eq!(of(2), of(2));
    assert_ne!(SamplingLaw::SEED, 0);
}

#[test]
fn what_cannot_be_measured_is_an_error() {
    let samples = Samples::new(&law(), &[], film, |_| {}).unwrap();
    let bad_above = |limit: f64, value: f64| {
        let candidate = move |rgb: [f64; 3]| if rgb[0] > limit { [value; 3] } else { film(rgb) };
        let maps = Maps { reference: film, candidate, difference, luminance };
        certify(&samples, &maps, Search::Ascent, |_| {}).map(|_| ()).unwrap_err().to_string()
    };
    for value in [f64::NAN, f64::INFINITY] {
        assert!(bad_above(5.0, value).starts_with("difference at sample "), "{}", bad_above(5.0, value));
    }
    // A difference that hides infinities does not hide them from luminance.
    let candidate = |_| [f64::INFINITY; 3];
    let maps = Maps { reference: film, candidate, difference: |_: &[f64; 3], _: &[f64; 3]| 0.0, luminance };
    let error = certify(&samples, &maps, Search::Ascent, |_| {}).unwrap_err().to_string();
    assert_eq!(error, "luminance of the candidate on the neutral axis: found inf, expected a finite number");

    let bad = [
        SamplingLaw { count: 0, ..law() },
        SamplingLaw { count: usize::MAX, ..law() },
        SamplingLaw { stops: [2.0, 1.0], ..law() },
        SamplingLaw { stops: [f64::NAN, 1.0], ..law() },
        SamplingLaw { band_width: 0.0, ..law() },
        SamplingLaw { neutral_step: f64::NAN, ..law() },
        SamplingLaw { fold_places: usize::MAX, ..law() },
        SamplingLaw { ascents: usize::MAX, ..law() },
        SamplingLaw { ascent_steps: usize::MAX, ..law() },
    ];
    for law in bad {
        assert!(Samples::new(&law, &[], film, |_| {}).is_err(), "{law:?}");
    }
}

#[test]
fn small_laws_work() {
    let law = SamplingLaw {
        count: 1,
        ascents: 0,
        ascent_steps: 0,
        fold_places: 0,
        stops: [1.0, 1.0],
        ..SamplingLaw::default()
    };
    let found = certificate_of(&law, Search::Ascent, |rgb| film(rgb).map(|v| 0.9 * v));
    assert_eq!((found.bands.len(), found.neutral_axis.count, found.folds.places), (1, 1, 1));
    assert_eq!(found.max_found, found.overall.max);
}

#[cfg(feature = "serde")]
#[test]
fn the_serialised_form_keeps_its_names() {
    let json = serde_json::to_value(certificate(|rgb| film(rgb).map(|v| 0.99 * v))).unwrap();
    let keys = |value: &serde_json::Value| {
        let mut keys: Vec<_> = value.as_object().unwrap().keys().cloned().collect();
        keys.sort_unstable();
        keys.join(" ")
    };
    assert_eq!(
        keys(&json),
        "bands colour_sets folds headline_mean hue_steps law max_found max_found_at neutral_axis overall search"
    );
    assert_eq!(json["search"], "ascent");
    assert_eq!(keys(&json["law"]), "ascent_steps ascents band_width count fold_places neutral_step seed stops");
    assert_eq!(keys(&json["bands"][0]), "count max mean p95 p99 stops worst");
    assert_eq!(keys(&json["neutral_axis"]), "count fall max mean reference_fall step worst_stops");
    assert_eq!(keys(&json["colour_sets"][0]), "count max mean name worst worst_name worst_stops");
    assert_eq!(keys(&json["folds"]), "clipped first flat folds places");
    assert_eq!(
        keys(&json["hue_steps"][0]),
        "candidate candidate_hue excess excess_hue max max_hue ratio reference reference_hue stops"
    );
}

#[test]
fn sentences_name_what_is_above_the_limit() {
    let found = certificate(|rgb| film(rgb).map(|v| 0.99 * v));
    let failures = found.failures(0.1);
    for start in [
        "largest difference: found ",
        "neutral axis: found ",
        "colours of chart: found ",
        "saturated hues at +0 stops: found ",
    ] {
        assert!(failures.iter().any(|f| f.starts_with(start) && f.ends_with("expected at most 0.1")), "{failures:?}");
    }
    assert!(found.failures(1.8).is_empty(), "{failures:?}");
}
