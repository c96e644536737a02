use onelight::spectra::{Kelvin, Observer, SpectralShape, black_body};
use onelight::{FilmProcess, Projector, StructuredSettings, WideGamut};
use proptest::prelude::*;

use super::cases;
use super::settings::process;
use crate::{compiled, films};

/// Any double, and light as scenes have it.
fn channel() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => any::<u64>().prop_map(f64::from_bits),
        4 => (-20.0..20.0).prop_map(f64::exp2),
        1 => Just(0.0),
        1 => -1.0..0.0,
        1 => (-40.0..100.0).prop_map(f64::exp2),
    ]
}

fn scenes() -> impl Strategy<Value = Vec<[f64; 3]>> {
    prop::collection::vec(prop::array::uniform3(channel()), 24)
}

proptest! {
    #![proptest_config(cases(64))]

    /// Between nothing and what the film without any image lets through; finite from there on.
    #[test]
    fn light_lies_between_none_and_the_film_base(process in process(), scenes in scenes()) {
        let Ok(film) = process.compile() else { return Ok(()) };
        // Every layer is brighter with more light, and ends; on a negative, which a scan reads itself, brighter with less.
        let brightest = film.stages(if process.scan.is_some() { [0.0; 3] } else { [1e30; 3] });
        let base = brightest.spectrum.values();
        for scene in scenes {
            let stages = film.stages(scene);
            for (passed, base) in stages.spectrum.values().iter().zip(base) {
                // A sum of three dyes, rounded.
                prop_assert!((0.0..=base * (1.0 + 1e-12)).contains(passed), "{passed} of {base} at {scene:?} by {process:?}");
            }
            for (found, base) in stages.xyz.into_iter().zip(brightest.xyz) {
                prop_assert!((0.0..=base * (1.0 + 1e-12)).contains(&found), "{found} of {base} at {scene:?} by {process:?}");
            }
            let least = if process.gamut == WideGamut::Clip { 0.0 } else { -1e30 };
            prop_assert!(stages.scene.iter().all(|v| (least..=1e30).contains(v)));
            prop_assert!(stages.exposure.to_array().iter().all(|h| h.0.is_finite()));
            prop_assert!(stages.linear.iter().chain(&stages.coded).all(|v| v.is_finite()));
            prop_assert_eq!(film.develop(scene), stages.coded);
        }
    }
}

#[test]
fn the_film_base_passes_less_than_the_lamp_sends() {
    let lamp = black_body(Kelvin::WHITE, SpectralShape::VISIBLE);
    let scale = 1.0 / Observer::cie_1931().xyz(&lamp).y;
    for camera in ["kodak-5207", "kodak-portra-400", "fuji-velvia-50", "kodak-kodachrome-64"] {
        let process = FilmProcess { projector: Projector::Display, ..films::process(camera) };
        let base = compiled(&process).stages([1e30; 3]).spectrum;
        for (passed, sent) in base.values().iter().zip(lamp.values()) {
            assert!(*passed > 0.0 && *passed <= sent * scale, "{camera}: {passed} of {}", sent * scale);
        }
    }
}

#[test]
fn a_huge_channel_drowns_no_other() {
    // Found as dE 97: sRGB to sRGB was the identity but for 1e-17, which at 1e30 is more than all else.
    for camera in ["kodak-5207", "fuji-velvia-50"] {
        let process = films::talk::process(camera);
        let (film, direct) = (compiled(&process), films::direct(&process));
        let structured = film.structured(&StructuredSettings { size: 8, ..Default::default() }).unwrap();
        for (huge, plain) in [
            ([-1e30, -1e30, 0.18], [0.0, 0.0, 0.18]),
            ([0.18, f64::NEG_INFINITY, 0.0], [0.18, 0.0, 0.0]),
            ([f64::MIN, f64::NAN, 4.0], [0.0, 0.0, 4.0]),
        ] {
            assert_eq!(film.develop(huge), film.develop(plain), "{camera} {huge:?}");
            let single = [huge, plain].map(|rgb| rgb.map(|v| v as f32));
            assert_eq!(direct.apply(single[0]), direct.apply(single[1]), "{camera} {huge:?}");
            assert_eq!(structured.apply(single[0]), structured.apply(single[1]), "{camera} {huge:?}");
        }
    }
}
