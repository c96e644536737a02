//! The three steps of a form against the form.

use onelight_lut::{Decode, DirectForm, PixelMap, StagedMap};

use crate::pixels::{density, direct, mix, print, scene, structured};

/// An exposure's logarithm, to which the output's change by some 3 for a stop applies, is rounded thrice more: when it becomes an
/// exposure, which is rounded to 24 bits, and back.
const TWICE_ROUNDED: f32 = 1e-5;

fn colours(pixels: usize) -> Vec<[f32; 3]> {
    scene(pixels).chunks_exact(4).map(|rgba| [rgba[0], rgba[1], rgba[2]]).collect()
}

fn in_steps(form: &impl StagedMap, linear: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let mut layers: [Vec<f32>; 3] = std::array::from_fn(|_| vec![f32::NAN; linear.len()]);
    form.expose(linear, layers.each_mut().map(Vec::as_mut_slice));
    assert!(layers.iter().flatten().all(|e| (0.0..=1e31).contains(e)));
    form.develop(layers.each_mut().map(Vec::as_mut_slice));
    let mut shown = vec![[f32::NAN; 3]; linear.len()];
    form.finish(layers.each_ref().map(Vec::as_slice), &mut shown);
    shown
}

fn follows(form: &(impl StagedMap + PixelMap), pixels: usize) {
    let linear = colours(pixels);
    let mut whole = linear.clone();
    form.map_colours(&mut whole);
    for ((found, expected), rgb) in in_steps(form, &linear).iter().zip(&whole).zip(&linear) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= TWICE_ROUNDED, "{rgb:?}: {found} for {expected}");
        }
    }
}

#[test]
fn three_steps_are_the_form() {
    for pixels in [0, 1, 127, 128, 2000] {
        follows(&direct(None), pixels);
        follows(&direct(print()), pixels);
        follows(&structured(Decode::Coded, None), pixels);
        follows(&structured(density(), mix()), pixels);
    }
}

#[test]
fn hard_exposures_have_one_result() {
    let form = direct(print());
    let develop = |e: f32| {
        let [mut red, mut green, mut blue] = [[e]; 3];
        form.develop([&mut red, &mut green, &mut blue]);
        [red[0], green[0], blue[0]]
    };
    let dark = develop(0.0);
    assert_eq!([f32::NAN, -1.0, f32::NEG_INFINITY, -0.0, 1e-30].map(develop), [dark; 5]);
    assert_eq!(develop(f32::INFINITY), develop(1e31));
}

#[test]
fn what_is_longer_is_left_alone() {
    let form: DirectForm = direct(None);
    let [mut red, mut green, mut blue] = [vec![-7.0; 300], vec![-7.0; 200], vec![-7.0; 150]];
    form.expose(&[[0.18; 3]; 140], [&mut red, &mut green, &mut blue]);
    assert!([&red, &green, &blue].iter().all(|layer| layer[139] > 0.0 && layer[140..].iter().all(|e| *e == -7.0)));
    let mut shown = [[-7.0; 3]; 145];
    form.finish([&red[..140], &green, &blue], &mut shown);
    assert!(shown[139][0] > 0.0 && shown[140] == [-7.0; 3]);
}
