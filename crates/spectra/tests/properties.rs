//! Laws of curves and spaces on random input. What was found by them is kept below as a test with a name.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

use onelight_spectra::{
    BufferFormat, Chromaticity, DisplayDifference, DisplayLinear, Pchip, RgbSpace, SceneCurve, TransferCurve,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The same inputs in every run; PROPTEST_CASES digs deeper, with new inputs each time.
fn cases(count: u32) -> ProptestConfig {
    let mut config = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        (config.cases, config.rng_seed) = (count, RngSeed::Fixed(0x6f6e_656c_6967_6874));
    }
    config
}

/// Abscissae that increase, by steps of very different size, and ordinates that never fall.
fn rising_nodes() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    let step = prop_oneof![3 => 0.01..1.0, 1 => 1e-9..1e-6, 1 => 1.0..1e3_f64];
    let rise = prop_oneof![2 => Just(0.0), 3 => 0.0..1.0, 1 => 1e-12..1e-9, 1 => 1.0..1e3_f64];
    (-100.0..100.0, -10.0..10.0, prop::collection::vec((step, rise), 1..12)).prop_map(|(x, y, steps)| {
        let (mut xs, mut ys) = (vec![x], vec![y]);
        for (step, rise) in steps {
            xs.push(xs[xs.len() - 1] + step);
            ys.push(ys[ys.len() - 1] + rise);
        }
        (xs, ys)
    })
}

/// A few roundings of the largest ordinate: a cubic is four products and sums.
fn rounding(y: &[f64]) -> f64 {
    8.0 * f64::EPSILON * y.iter().fold(0.0_f64, |most, v| most.max(v.abs()))
}

/// Light from nothing to the brightest, of either sign.
fn light() -> impl Strategy<Value = f64> {
    let magnitude = (-120.0..100.0).prop_map(f64::exp2);
    prop_oneof![1 => Just(0.0), 4 => magnitude.clone(), 2 => magnitude.prop_map(|v| -v), 2 => -0.1..0.1, 2 => 0.0..2.0]
}

/// Any double at all.
fn hard() -> impl Strategy<Value = f64> {
    prop_oneof![any::<u64>().prop_map(f64::from_bits), -2.0..2.0]
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn monotone_nodes_make_a_monotone_curve_within_them((x, y) in rising_nodes(), points in prop::collection::vec(0.0..1.0, 64)) {
        let curve = Pchip::new(x, y).unwrap();
        let (first, last) = curve.range().into_inner();
        let (low, high, slack) = (curve.y()[0], curve.y()[curve.y().len() - 1], rounding(curve.y()));
        let mut points: Vec<f64> = points.into_iter().map(|t| first - 1.0 + t * (last - first + 2.0)).collect();
        points.extend(curve.x().iter().flat_map(|x| [x.next_down(), *x, x.next_up()]));
        points.sort_by(f64::total_cmp);
        let values: Vec<f64> = points.iter().map(|x| curve.at(*x)).collect();
        for (pair, x) in values.windows(2).zip(&points) {
            prop_assert!(pair[1] >= pair[0] - slack, "{pair:?} at {x}");
        }
        prop_assert!(values.iter().all(|v| (low - slack..=high + slack).contains(v)));
        let steepest = curve.x().windows(2).zip(curve.y().windows(2)).map(|(x, y)| (y[1] - y[0]) / (x[1] - x[0]));
        let steepest = steepest.fold(0.0, f64::max);
        prop_assert!(points.iter().all(|x| curve.slope_at(*x) >= -1e-14 * steepest));
    }

    #[test]
    fn solving_undoes_reading((x, y) in rising_nodes(), t in 0.0..=1.0, turn in any::<bool>()) {
        let y: Vec<f64> = if turn { y.iter().map(|v| -v).collect() } else { y };
        let slack = rounding(&y);
        let curve = Pchip::new(x, y).unwrap();
        let (first, last) = (curve.y()[0], curve.y()[curve.y().len() - 1]);
        let wanted = first * (1.0 - t) + last * t;
        match curve.solve(wanted) {
            Some(x) => {
                // As near as a neighbouring abscissa comes.
                let step = (x.abs() * f64::EPSILON).max(f64::MIN_POSITIVE) * (curve.slope_at(x).abs() + 1.0);
                let steep = (curve.at(x.next_up()) - curve.at(x.next_down())).abs();
                prop_assert!((curve.at(x) - wanted).abs() <= slack + step + steep, "{} for {wanted} at {x}", curve.at(x));
            }
            None => prop_assert!(first == last || !(first.min(last)..=first.max(last)).contains(&wanted)),
        }
    }

    #[test]
    fn nodes_are_refused_or_make_finite_curves(nodes in prop::collection::vec((hard(), hard()), 0..6), x in hard()) {
        let (mut xs, ys): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
        xs.sort_by(f64::total_cmp);
        if let Ok(curve) = Pchip::new(xs, ys) {
            let (first, last) = curve.range().into_inner();
            let all = [x, first, last, 0.5 * first + 0.5 * last];
            for x in all {
                prop_assert!(curve.at(x).is_finite() && curve.slope_at(x).is_finite(), "{curve:?} at {x}");
            }
        }
    }

    #[test]
    fn display_curves_go_there_and_back(v in light()) {
        for curve in [TransferCurve::Linear, TransferCurve::Srgb, TransferCurve::Gamma24] {
            // sRGB's pieces miss each other by 3e-8, as the standard rounds them.
            let slack = if curve == TransferCurve::Srgb { 1e-8 } else { 1e-13 * v.abs() };
            prop_assert!((curve.decode(curve.encode(v)) - v).abs() <= slack.max(1e-13 * v.abs()), "{curve:?}");
            prop_assert!((curve.encode(curve.decode(v)) - v).abs() <= (slack * 13.0).max(1e-13 * v.abs()), "{curve:?}");
        }
    }

    #[test]
    fn scene_curves_go_there_and_back_and_rise(v in light(), by in 1e-12..1.0) {
        for curve in SceneCurve::ALL {
            let (coded, brighter) = (curve.encode(v), curve.encode(v + by * v.abs()));
            // sRGB falls by 3e-8 where its pieces meet.
            let joint = if curve == SceneCurve::Srgb { 4e-8 } else { 0.0 };
            prop_assert!(brighter >= coded - joint - 4.0 * f64::EPSILON * coded.abs(), "{curve:?}: {coded} {brighter}");
            let shown = match curve {
                SceneCurve::Pq => v.clamp(0.0, 10_000.0 / 203.0),
                SceneCurve::AppleLog => v.max(curve.decode(0.0)),
                _ => v,
            };
            // Light beside 1 (sRGB: its joint; PQ: a code of 1e-16 more is light of 1e-8 near 0, by its power of 78).
            let slack = match curve {
                SceneCurve::Srgb => 1e-8,
                SceneCurve::Pq => 1e-12,
                _ => 1e-15,
            };
            let back = curve.decode(coded);
            prop_assert!((back - shown).abs() <= slack + 1e-9 * shown.abs(), "{curve:?}: {back} for {v}");
        }
    }

    #[test]
    fn camera_codes_go_there_and_back(coded in -2.0..4.0) {
        for curve in SceneCurve::ALL {
            let Some(log) = curve.camera_log() else { continue };
            prop_assert!((log.encode(log.decode(coded)) - coded).abs() < 1e-12, "{curve:?}");
        }
    }

    #[test]
    fn a_buffer_keeps_what_it_holds_and_its_order(a in hard(), b in hard()) {
        for format in BufferFormat::ALL {
            let [low, high] = [a.min(b), a.max(b)].map(|v| format.quantise([v; 3]));
            for c in 0..3 {
                prop_assert!(low[c] <= high[c] || a.is_nan() || b.is_nan(), "{format:?} {a} {b}");
                prop_assert!(low[c].is_finite() && high[c].abs() <= format.max()[c], "{format:?}");
            }
            // sRGB's joint is no code of 8 bits.
            let again = format.quantise(high);
            prop_assert!((0..3).all(|c| (again[c] - high[c]).abs() <= 1e-15), "{format:?} {again:?} {high:?}");
        }
    }

    #[test]
    fn spaces_go_there_and_back(rgb in prop::array::uniform3(-10.0..10.0), i in 0..SceneCurve::ALL.len(), k in 0..SceneCurve::ALL.len()) {
        let [a, b] = [i, k].map(|i| SceneCurve::ALL[i].space());
        let white = Chromaticity::black_body_6500_k();
        let v = onelight_spectra::nalgebra::Vector3::from(rgb);
        let back = b.to_about(&a, white).unwrap() * (a.to_about(&b, white).unwrap() * v);
        prop_assert!((back - v).amax() < 1e-11, "{back:?}");
    }

    #[test]
    fn differences_are_distances(a in prop::array::uniform3(hard()), b in prop::array::uniform3(hard())) {
        let difference = DisplayDifference::new(&RgbSpace::SRGB).unwrap();
        let (a, b) = (DisplayLinear(a), DisplayLinear(b));
        let found = difference.between(a, b);
        prop_assert!(found.is_finite() && found >= 0.0, "{found}");
        prop_assert!((found - difference.between(b, a)).abs() < 1e-9 && difference.between(a, a) == 0.0);
    }
}

#[test]
fn nodes_too_steep_for_float64_are_refused() {
    // Found as nodes that are finite with a slope that is not.
    for (x, y) in [
        ([-5e-324, 0.0], [2.6458208237649843e110, 0.0]),
        ([0.0, 1.0], [-1e308, 1e308]),
        ([-1e308, 1e308], [0.0, 1.0]),
        ([0.0, 1e-300], [0.0, 1e10]),
    ] {
        let error = Pchip::new(x.to_vec(), y.to_vec()).unwrap_err().to_string();
        assert!(error.contains("expected a slope that float64 holds") && error.len() < 200, "{error}");
    }
    assert!(Pchip::new(vec![-1e300, 1e300], vec![-1e300, 1e300]).is_ok());
}
