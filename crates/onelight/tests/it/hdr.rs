//! PQ and HLG out: absolute light, in the forms that can hold it.

use onelight::baked::{Form, Recipe};
use onelight::{ColourSpaces, FilmProcess, Look, Process, TableCoding, TransferCurve, WorkingSpace};

fn look(
    output_coding: TransferCurve,
    output_space: WorkingSpace,
    white_luminance: f64,
) -> Result<Look, onelight::Error> {
    let spaces = ColourSpaces { output_coding, output_space, white_luminance, ..ColourSpaces::default() };
    Process::from(FilmProcess { spaces, ..FilmProcess::for_camera("kodak-ektachrome-100")? }).look()
}

/// [BT2408]: diffuse white is 58 % of PQ and 75 % of HLG. Clear film is white.
#[test]
fn clear_film_is_at_the_luminance_that_is_asked_for() {
    for (curve, white, code) in [
        (TransferCurve::Pq, 203.0, 0.580_689),
        (TransferCurve::Pq, 100.0, 0.508_078),
        (TransferCurve::Pq, 1000.0, 0.751_827),
        (TransferCurve::Hlg, 203.0, 0.749_877),
        (TransferCurve::Hlg, 1000.0, 1.0),
    ] {
        for space in [WorkingSpace::Rec2020, WorkingSpace::P3] {
            let found = look(curve, space, white).unwrap().develop([1e9; 3]);
            assert!(found.iter().all(|v| (v - code).abs() < 2e-4), "{curve:?} {white}: {found:?}");
        }
    }
}

#[test]
fn forms_code_as_the_film_does() {
    for curve in [TransferCurve::Pq, TransferCurve::Hlg] {
        let look = look(curve, WorkingSpace::Rec2020, 203.0).unwrap();
        let structured = Recipe { coding: TableCoding::Display, size: 24, ..Recipe::of(Form::Structured) };
        for recipe in [Recipe::of(Form::Direct), structured, Recipe::cube(33)] {
            let baked = look.baked(&recipe).unwrap();
            let mut mapped = vec![[0.18_f32, 0.1, 0.05], [0.05; 3], [0.5, 0.4, 0.1], [2.0, 1.0, 3.0]];
            let scene = mapped.clone();
            baked.map_in_place(&mut mapped);
            for (rgb, mapped) in scene.into_iter().zip(mapped) {
                let (one, exact) = (baked.apply(rgb), look.develop(rgb.map(f64::from)));
                for c in 0..3 {
                    let miss = (f64::from(one[c]) - exact[c]).abs();
                    assert!(miss < 0.01, "{curve:?} {}: {one:?} {exact:?}", baked.describe());
                    assert!((one[c] - mapped[c]).abs() < 1e-5, "{one:?} {mapped:?}");
                }
            }
        }
        let densities = look.baked(&Recipe::of(Form::Structured)).unwrap_err().to_string();
        assert!(densities.contains("is no power"), "{densities}");
        assert!(look.film().unwrap().direct(&Default::default()).is_err());
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |curve, space, white| look(curve, space, white).unwrap_err().to_string();
    let srgb = refused(TransferCurve::Pq, WorkingSpace::Srgb, 203.0);
    assert!(srgb.contains("expected output_space rec2020 or p3 instead of srgb"), "{srgb}");
    assert!(
        refused(TransferCurve::Hlg, WorkingSpace::P3, 2000.0)
            .contains("white_luminance: found 2000, expected 1 to 1000")
    );
    assert!(refused(TransferCurve::Pq, WorkingSpace::P3, f64::NAN).contains("white_luminance: found NaN"));
    assert!(refused(TransferCurve::Srgb, WorkingSpace::P3, 100.0).contains("white_luminance changes nothing"));
    // Digital cinema: a power of 2.6 in any primaries.
    let cinema = look(TransferCurve::Gamma26, WorkingSpace::DciP3, 203.0).unwrap();
    let (coded, linear) = (cinema.develop([0.18; 3]), cinema.develop_linear([0.18; 3]));
    assert!((coded[1].powf(2.6) - linear[1]).abs() < 1e-12);
}
