//! The first approach and the tone mappings (M21).

use onelight::film::{CharacteristicCurve, Density, LogExposure, Tail};
use onelight::spectra::TransferCurve;
use onelight::{
    ColourSpaces, DisplayLinear, FirstControls, FirstProcess, Look, Process, ToneMapping, ToneProcess, WorkingSpace,
    stock,
};

use crate::films::talk::{film, process};
use crate::{FILMS, chart, differ, stated};

fn look(process: impl Into<Process>) -> Look {
    process.into().look().unwrap()
}

fn tone(mapping: ToneMapping) -> Look {
    look(ToneProcess { mapping, ..Default::default() })
}

fn first_of(camera: &str) -> FirstProcess {
    FirstProcess::for_camera(camera).unwrap()
}

/// The first approach as the talk writes it, without textures and matrices.
fn first(camera: &str) -> impl Fn([f64; 3]) -> DisplayLinear {
    let film = stock(camera).unwrap();
    let print = process(camera).print.map(|print| stock(print.film.id()).unwrap());
    let at = |curve: &CharacteristicCurve, d: f64| curve.log_exposure(Density(d)).unwrap().0;
    move |rgb| {
        DisplayLinear(std::array::from_fn(|i| {
            let sensitivity = film.sensitivity().to_array()[i];
            let weight = [612.0, 549.0, 464.0].map(|nm| 10f64.powf(sensitivity.log10_at(nm, Tail::LogLinear)));
            let light: f64 = (0..3).map(|k| weight[k] * rgb[k]).sum::<f64>() / weight.iter().sum::<f64>();
            let curve = film.characteristic().to_array()[i];
            let offset = (light / 0.18).max(1e-12).log10();
            let density = match &print {
                None => curve.density(LogExposure(at(curve, 0.7) + offset)).0,
                Some(print) => {
                    let (print, grey) = (print.characteristic().to_array()[i], film.mid_grey().unwrap().0);
                    let above = curve.density(LogExposure(grey + offset)).0 - curve.density(LogExposure(grey)).0;
                    print.density(LogExposure(at(print, 0.7) - above)).0
                }
            };
            10f64.powf(-density)
        }))
    }
}

#[test]
fn the_first_approach_is_the_talks_and_no_simulation() {
    let colours = chart(-2..=2);
    for camera in FILMS {
        let (plain, approach) = (first(camera), look(first_of(camera)));
        // The texture has 512 texels.
        let texture = differ(&colours, &plain, |rgb| approach.develop_linear(rgb));
        assert!(texture.1 < 0.02, "{camera}: {texture:?}");
        let film = film(camera);
        let (mean, max) = differ(&colours, plain, |rgb| film.develop_linear(rgb));
        stated(&format!("{camera}, mean"), mean, 4.9..=6.4);
        stated(&format!("{camera}, max"), max, 14.0..=22.0);
    }
}

#[test]
fn the_pre_colour_matrix_of_5207_is_the_published_one() {
    let Look::First(first) = look(FirstProcess::default()) else { panic!("first") };
    let published = [[0.990, 0.010, 0.000], [0.000, 0.986, 0.014], [0.0, 0.0, 1.0]];
    for (i, row) in published.iter().enumerate() {
        for (k, v) in row.iter().enumerate() {
            assert!((first.pre_colour()[(i, k)] - v).abs() < 6e-4, "{i} {k}: {}", first.pre_colour());
        }
    }
}

#[test]
fn a_first_approach_keeps_greys_grey_where_its_curves_agree() {
    // Orange is removed and grey pinned: 18 % grey is neutral on every film.
    for camera in FILMS {
        let approach = look(first_of(camera));
        for v in *approach.develop_linear([0.18; 3]) {
            assert!((v - 10f64.powf(-0.7)).abs() < 1e-3, "{camera}: {v}");
        }
        let darker = look(FirstProcess { neutral_density: 1.0, ..first_of(camera) });
        assert!((darker.develop_linear([0.18; 3])[1] - 0.1).abs() < 1e-3, "{camera}");
    }
}

#[test]
fn tone_mappings_are_their_formulas_and_lie_far_from_film() {
    let reinhard = tone(ToneMapping::Reinhard);
    for rgb in [[0.0, 0.18, 1.0], [9.0, 1e6, 0.5]] {
        let out = reinhard.develop_linear(rgb);
        assert!((0..3).all(|i| (out[i] - rgb[i] / (1.0 + rgb[i])).abs() < 1e-9));
    }
    // Luminance tone mapping keeps ratios of channels.
    let out = tone(ToneMapping::ReinhardLuminance).develop_linear([4.0, 2.0, 1.0]);
    assert!((out[0] / out[2] - 4.0).abs() < 1e-12 && (out[1] / out[2] - 2.0).abs() < 1e-12);
    assert_eq!(tone(ToneMapping::Clip).develop_linear([0.25, 1.5, -3.0]).0, [0.25, 1.0, 0.0]);
    for camera in FILMS {
        let film = film(camera);
        // On four stops either side; on two the mean is 6.4 to 8.5.
        let (mean, max) = differ(&chart(-4..=4), |rgb| reinhard.develop_linear(rgb), |rgb| film.develop_linear(rgb));
        stated(&format!("{camera}, Reinhard, mean"), mean, 7.8..=9.6);
        stated(&format!("{camera}, Reinhard, max"), max, 19.0..=25.0);
    }
}

#[test]
fn any_input_gives_a_finite_result_in_every_approach() {
    let hard = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0, 1e-320, 0.18, 1e30, f64::MAX];
    let mappings = [ToneMapping::Reinhard, ToneMapping::ReinhardLuminance, ToneMapping::Clip];
    for mapping in [None].into_iter().chain(mappings.map(Some)) {
        for space in [WorkingSpace::Srgb, WorkingSpace::AcesCg] {
            let spaces = ColourSpaces { input_space: space, output_space: space, ..Default::default() };
            let look = match mapping {
                None => look(FirstProcess { spaces, ..Default::default() }),
                Some(mapping) => look(ToneProcess { mapping, spaces }),
            };
            for r in hard {
                for g in hard {
                    for b in hard {
                        let out = look.develop([r, g, b]);
                        assert!(out.iter().all(|v| v.is_finite() && v.abs() < 4.0), "{mapping:?} {r} {g} {b}: {out:?}");
                    }
                }
            }
            assert_eq!(look.develop([f64::NAN, -1.0, 0.5]), look.develop([0.0, -1.0, 0.5]));
        }
    }
}

#[test]
fn controls_by_hand_change_what_they_say() {
    let with = |controls: FirstControls| look(FirstProcess { controls, ..Default::default() });
    let plain = with(FirstControls::default());
    let colours = chart(-2..=2);
    let size = |controls: FirstControls| {
        let changed = with(controls);
        differ(&colours, |rgb| plain.develop_linear(rgb), |rgb| changed.develop_linear(rgb)).0
    };
    let usual = FirstControls::default;
    assert!((3.0..5.0).contains(&size(FirstControls { contrast: 1.2, ..usual() })));
    assert!((3.0..5.0).contains(&size(FirstControls { brightness: 0.05, ..usual() })));
    assert!((2.5..5.0).contains(&size(FirstControls { temperature: 5500.0, ..usual() })));
    assert!((1.0..3.0).contains(&size(FirstControls { saturation: 1.2, ..usual() })));
    let bent = with(FirstControls { curve: vec![[-2.0, 0.2], [0.0, 0.6]], ..usual() });
    let coded = |look: &Look, stops: f64| TransferCurve::Srgb.encode(look.develop_linear([0.18 * stops.exp2(); 3])[1]);
    assert!((coded(&bent, 0.0) - 0.6).abs() < 2e-3 && (coded(&bent, -2.0) - 0.2).abs() < 2e-3);
    assert!((coded(&bent, 12.0) - coded(&plain, 12.0)).abs() < 1e-9);
}
