//! Laws of tables, shapers and forms on random input. What was found by them is kept below as a test with a name.

use onelight_lut::{
    Channels, Coupling, Decode, Develop, DirectForm, DirectParts, DirectPrint, Domain, ExponentialSum, ExponentialTerm,
    Expose, Interpolation, Lut1d, Lut3d, Mix, NegativeLight, PixelMap, Pixels, PixelsMut, PlainLut, PowerCoding, Rows,
    Shaper, SimdLevel, StructuredLut, StructuredParts, bake, bake_coordinates,
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

const BOTH: [Interpolation; 2] = [Interpolation::Trilinear, Interpolation::Tetrahedral];

/// Any float at all, and some near 0 and 1.
fn hard() -> impl Strategy<Value = f32> {
    prop_oneof![2 => any::<u32>().prop_map(f32::from_bits), 2 => 0.0..1.0_f32, 1 => -2.0..20.0_f32]
}

fn finite() -> impl Strategy<Value = f32> {
    hard().prop_filter("finite", |v| v.is_finite())
}

/// What tables take.
fn entry() -> impl Strategy<Value = [f32; 3]> {
    let large = finite().prop_map(|v| v.clamp(-1e38, 1e38));
    prop::array::uniform3(prop_oneof![4 => -1.0..2.0_f32, 1 => large, 1 => Just(1e38), 1 => Just(-1e38)])
}

fn table() -> impl Strategy<Value = Lut3d> {
    (2_usize..5).prop_flat_map(|size| {
        prop::collection::vec(entry(), size.pow(3)).prop_map(move |entries| Lut3d::new(size, entries).unwrap())
    })
}

fn shaper() -> impl Strategy<Value = Shaper> {
    (-8.0..3.0, 1.0..12.0).prop_map(|(offset, ratio): (f64, f64)| {
        let offset = 10_f64.powf(offset);
        Shaper::log2(offset, offset * 10_f64.powf(ratio)).unwrap()
    })
}

/// Every way to map one colour.
fn implementations(form: &impl PixelMap, rgb: [f32; 3]) -> Vec<[f32; 3]> {
    let mut all = vec![form.apply(rgb)];
    for level in SimdLevel::available() {
        // In the middle of other pixels, and where vectors end.
        let mut out = [[7.0_f32; 3]; 9];
        let from = [rgb; 9];
        let pixels = Pixels::new(from.as_flattened(), Channels::Rgb, [9, 1]).unwrap();
        let mut to = PixelsMut::new(out.as_flattened_mut(), Channels::Rgb, [9, 1]).unwrap();
        form.map_on(level, &pixels, &mut to).unwrap();
        all.extend([out[0], out[4], out[8]]);
    }
    all
}

/// The corners of the cell that coordinates lie in: least and most of each channel. On the border of cells, those of both.
fn corners(table: &Lut3d, at: [f32; 3]) -> [(f32, f32); 3] {
    let size = table.size();
    let span = at.map(|c| {
        let place = if c > 0.0 { c.min(1.0) } else { 0.0 } * (size - 1) as f32;
        // Rounding may lead to the neighbouring cell.
        let slack = 1e-5;
        ((place - slack).max(0.0).floor() as usize, ((place + slack).ceil() as usize).min(size - 1))
    });
    let mut found = [(f32::INFINITY, f32::NEG_INFINITY); 3];
    for r in span[0].0..=span[0].1 {
        for g in span[1].0..=span[1].1 {
            for b in span[2].0..=span[2].1 {
                let entry = table.entry([r, g, b]).unwrap();
                for (found, v) in found.iter_mut().zip(entry) {
                    *found = (found.0.min(v), found.1.max(v));
                }
            }
        }
    }
    found
}

/// Within the corners: weights come to 1 within a few roundings, and each product is rounded.
fn is_between(out: [f32; 3], corners: [(f32, f32); 3]) -> bool {
    out.iter().zip(corners).all(|(v, (low, high))| {
        let slack = 8.0 * f32::EPSILON * low.abs().max(high.abs()).min(f32::MAX / 2.0) + f32::MIN_POSITIVE;
        v.is_finite()
            && f64::from(*v) >= f64::from(low) - f64::from(slack)
            && f64::from(*v) <= f64::from(high) + f64::from(slack)
    })
}

fn rows(least: f32, most: f32) -> impl Strategy<Value = Rows> {
    prop::array::uniform3(prop::array::uniform3(least..most))
}

/// Curves that rise or fall over 20 to 50 stops.
fn curves(top: f32) -> impl Strategy<Value = Lut1d> {
    let entries = prop::collection::vec(prop::array::uniform3(0.0..top), 2..40);
    (-30.0..-10.0_f32, 10.0..20.0_f32, entries, any::<bool>()).prop_map(|(from, to, mut entries, falls)| {
        for c in 0..3 {
            let mut channel: Vec<f32> = entries.iter().map(|entry| entry[c]).collect();
            channel.sort_by(f32::total_cmp);
            if falls {
                channel.reverse();
            }
            entries.iter_mut().zip(channel).for_each(|(entry, v)| entry[c] = v);
        }
        Lut1d::new(Domain::common(from, to).unwrap(), entries).unwrap()
    })
}

fn coding() -> impl Strategy<Value = PowerCoding> {
    prop_oneof![
        Just(PowerCoding::LINEAR),
        (1.01..10.0, 1e-3..0.9).prop_map(|(exponent, offset)| PowerCoding::new(exponent, offset).unwrap()),
    ]
}

fn sum() -> impl Strategy<Value = ExponentialSum> {
    let term = (prop::array::uniform3(0.0..5.0_f32), prop::array::uniform3(-2.0..4.0_f32))
        .prop_map(|(rate, weight)| ExponentialTerm { rate, weight });
    prop::collection::vec(term, 1..12).prop_map(|terms| ExponentialSum::new(terms).unwrap())
}

fn expose() -> impl Strategy<Value = Expose> {
    let negative = prop_oneof![Just(NegativeLight::Clip), Just(NegativeLight::Compress)];
    (rows(-0.5, 1.5), rows(-0.1, 2.0), negative).prop_map(|(input, matrix, negative)| Expose {
        input,
        matrix,
        negative,
    })
}

fn develop(top: f32) -> impl Strategy<Value = Develop> {
    let coupling = (curves(2.0), rows(-1.0, 1.0)).prop_map(|(curves, matrix)| Coupling { curves, matrix });
    (prop::option::of(coupling), curves(top)).prop_map(|(coupling, curves)| Develop { coupling, curves })
}

fn direct() -> impl Strategy<Value = DirectForm> {
    let print = prop::option::of((sum(), curves(4.0)).prop_map(|(exposure, curves)| DirectPrint { exposure, curves }));
    (expose(), develop(4.0), print, sum(), coding()).prop_map(|(expose, develop, print, projection, coding)| {
        DirectForm::new(DirectParts { expose, develop, print, projection, coding }).unwrap()
    })
}

fn structured() -> impl Strategy<Value = StructuredLut> {
    let mix = (rows(-1.0, 1.0), prop::array::uniform3(-5.0..5.0_f32), curves(1.0))
        .prop_map(|(matrix, offset, curves)| Mix { matrix, offset, curves });
    let decode = prop_oneof![
        Just(Decode::Coded),
        (rows(-1.0, 2.0), coding()).prop_map(|(matrix, coding)| Decode::Density { matrix, coding }),
    ];
    let table = prop::collection::vec(prop::array::uniform3(-1.0..6.0_f32), 27)
        .prop_map(|entries| Lut3d::new(3, entries).unwrap());
    let how = prop_oneof![Just(BOTH[0]), Just(BOTH[1])];
    (expose(), develop(1.0), prop::option::of(mix), table, decode, how).prop_map(
        |(expose, develop, mix, table, decode, interpolation)| {
            StructuredLut::new(StructuredParts { expose, develop, mix, table, decode, interpolation }).unwrap()
        },
    )
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn interpolation_stays_between_the_corners(table in table(), at in prop::array::uniform3(hard())) {
        for how in BOTH {
            let out = table.apply(at, how);
            prop_assert!(is_between(out, corners(&table, at)), "{how:?} {at:?}: {out:?} in {:?}", corners(&table, at));
        }
    }

    #[test]
    fn pixels_stay_between_the_corners(table in table(), shaper in shaper(), rgb in prop::array::uniform3(hard())) {
        let at = rgb.map(|v| shaper.encode_f32(v));
        for how in BOTH {
            let form = PlainLut::new(shaper, table.clone(), how);
            for out in implementations(&form, rgb) {
                prop_assert!(is_between(out, corners(&table, at)), "{how:?} {rgb:?}: {out:?} in {:?}", corners(&table, at));
            }
        }
    }

    #[test]
    fn curves_stay_between_their_entries(entries in prop::collection::vec(entry(), 2..20), x in prop::array::uniform3(hard())) {
        let table = Lut1d::new(Domain::common(-1.0, 3.0).unwrap(), entries).unwrap();
        let out = table.apply(x);
        for c in 0..3 {
            let place = if x[c] > -1.0 { (x[c].min(3.0) + 1.0) / 4.0 } else { 0.0 } * (table.size() - 1) as f32;
            let near = ((place - 1e-5).max(0.0).floor() as usize)..=((place + 1e-5).ceil() as usize).min(table.size() - 1);
            let (low, high) = table.entries()[near].iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), entry| {
                (low.min(entry[c]), high.max(entry[c]))
            });
            prop_assert!(is_between([out[c]; 3], [(low, high); 3]), "{x:?}: {out:?}");
        }
    }

    #[test]
    fn nodes_are_read_exactly(size in 2_usize..=40, node in prop::array::uniform3(any::<prop::sample::Index>()), seed in any::<u32>()) {
        // No two nodes alike.
        let look = |rgb: [f64; 3]| rgb.map(|v| (f64::from(seed) + 7.7 * v + rgb[0] - rgb[1]).sin());
        let table = bake_coordinates(size, look, |_| {}).unwrap();
        let node = node.map(|i| i.index(size));
        let coordinates = node.map(|i| i as f64 / (size - 1) as f64);
        let entry = table.entry(node).unwrap();
        prop_assert_eq!(entry, look(coordinates).map(|v| v as f32));
        for how in BOTH {
            let out = table.apply(coordinates.map(|v| v as f32), how);
            // A coordinate is a float32: its node is missed by a rounding of the place, below 3e-6 of a cell.
            let exact = (size - 1).is_power_of_two();
            for (out, entry) in out.into_iter().zip(entry) {
                prop_assert!(if exact { out == entry } else { (out - entry).abs() <= 6e-6 }, "{how:?}: {out} for {entry}");
            }
        }
    }

    #[test]
    fn baked_scene_light_is_read_at_its_nodes(shaper in shaper(), i in 0_usize..=16, k in 0_usize..=16) {
        let look = |rgb: [f64; 3]| rgb.map(|v| v / (v + shaper.max() / 16.0));
        let table = bake(17, &shaper, look, |_| {}).unwrap();
        let light = [i, k, 16].map(|i| shaper.decode(i as f64 / 16.0));
        let form = PlainLut::new(shaper, table, Interpolation::Tetrahedral);
        let exact = look(light);
        let near = |out: f64, exact: f64, slack: f64| (out - exact).abs() <= slack;
        // Float64 to its rounding, and that of the entries; float32 to that of coordinates, 3e-7, on a table whose steepest cell
        // rises by 1.
        let found = form.apply_f64(light);
        prop_assert!((0..3).all(|c| near(found[c], exact[c], 1e-7)), "{found:?} for {exact:?}");
        let found = form.apply(light.map(|v| v as f32));
        prop_assert!((0..3).all(|c| near(f64::from(found[c]), exact[c], 1e-5)), "{found:?} for {exact:?}");
    }

    #[test]
    fn shapers_go_there_and_back_and_rise(shaper in shaper(), t in 0.0..=1.0, by in 0.0..0.1, v in hard()) {
        let linear = shaper.decode(t);
        prop_assert!((shaper.encode(linear) - t).abs() < 1e-13, "{} for {t}", shaper.encode(linear));
        prop_assert!(shaper.decode(t + by) >= linear && shaper.encode(linear + by * linear) >= shaper.encode(linear));
        let back = shaper.decode(shaper.encode(linear));
        prop_assert!((back - linear).abs() <= 1e-12 * linear, "{back} for {linear}");
        let coordinate = shaper.encode_f32(v);
        prop_assert!((0.0..=1.0).contains(&coordinate), "{coordinate} for {v}");
        prop_assert!((f64::from(coordinate) - shaper.encode(f64::from(v))).abs() < 1e-6, "{coordinate} for {v}");
    }

    #[test]
    fn codings_go_there_and_back(coding in coding(), v in -1e4..1e4) {
        prop_assert!((coding.decode(coding.encode(v)) - v).abs() <= 1e-11 * v.abs(), "{v}");
        prop_assert!((coding.encode(coding.decode(v)) - v).abs() <= 1e-11 * v.abs(), "{v}");
        prop_assert!(coding.encode(v.abs() * 1.001) >= coding.encode(v.abs()));
    }

    #[test]
    fn direct_forms_agree_on_any_light(form in direct(), rgb in prop::array::uniform3(hard())) {
        // Terms come to 48 at most, each wrong by what 3e-5 stops in a curve's place and a rate of 5 make of it.
        agrees(&form, rgb, 0.05)?;
    }

    #[test]
    fn structured_forms_agree_on_any_light(form in structured(), rgb in prop::array::uniform3(hard())) {
        agrees(&form, rgb, 0.05)?;
    }
}

/// All implementations give the result of float64 to `slack` of 1 or of itself.
fn agrees(form: &impl PixelMap, rgb: [f32; 3], slack: f64) -> Result<(), TestCaseError> {
    let exact = form.apply_f64(rgb.map(f64::from));
    prop_assert!(exact.iter().all(|v| v.is_finite()), "{rgb:?}: {exact:?}");
    for out in implementations(form, rgb) {
        for (out, exact) in out.into_iter().zip(exact) {
            prop_assert!((f64::from(out) - exact).abs() <= slack * exact.abs().max(1.0), "{rgb:?}: {out} for {exact}");
        }
    }
    Ok(())
}

#[test]
fn entries_whose_mean_might_overflow_are_refused() {
    // Found as a mean of -3.4e38 and its like that was -infinity.
    let entries = |v| vec![[0.0, v, 0.0]; 8];
    for large in [f32::MIN, f32::MAX, 1.1e38, f32::INFINITY, f32::NAN] {
        let error = Lut3d::new(2, entries(large)).unwrap_err().to_string();
        assert!(error.ends_with("expected numbers within ±1e38"), "{error}");
        assert!(Lut1d::new(Domain::UNIT, entries(large)).is_err());
    }
    for at in (0..1000).map(|i| [i as f32 / 999.0, (i * 7 % 1000) as f32 / 999.0, (i * 13 % 1000) as f32 / 999.0]) {
        let table = Lut3d::new(2, entries(-1e38)).unwrap();
        assert!(BOTH.iter().all(|how| (table.apply(at, *how)[1] / -1e38 - 1.0).abs() < 1e-6), "{at:?}");
    }
}
