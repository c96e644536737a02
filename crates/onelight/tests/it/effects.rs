//! Sharpness, halation and grain of whole looks.

use onelight::baked::{Baked, Form, Recipe};
use onelight::spatial::{Antihalation, Development, FilmFormat, Frame, Pitch};
use onelight::{EffectChoice, Effects, FilmEffects, FilmProcess, FilmSteps, Look, Process};

use crate::chart;

const SIZE: [usize; 2] = [240, 150];

fn process(camera: &str, change: impl FnOnce(&mut Effects)) -> FilmProcess {
    let mut process = FilmProcess::for_camera(camera).unwrap();
    process.effects.film_format = Some(FilmFormat::Super35);
    change(&mut process.effects);
    process
}

fn frame(width: usize) -> Frame {
    Frame::new(SIZE, FilmFormat::Super35.pitch(width, 1.0).unwrap()).unwrap()
}

/// Edges, slopes and a light of 8 stops.
fn picture() -> Vec<[f32; 3]> {
    let pixel = |i: usize| {
        let (x, y) = (i % SIZE[0], i / SIZE[0]);
        let wave = 0.18 * (0.3 * x as f32).sin().exp2();
        let light = if x.abs_diff(120) < 6 && y.abs_diff(70) < 6 { 46.0 } else { 0.0 };
        let edge = if y > 100 { 0.02 } else { 1.0 };
        [wave * edge + light, 0.16 * edge + light, 0.1 * edge + light]
    };
    (0..SIZE[0] * SIZE[1]).map(pixel).collect()
}

/// Developed in bands of so many rows, and why.
fn developed(
    effects: &FilmEffects,
    look: &Look,
    baked: Option<&Baked>,
    frame: Frame,
    picture: &[[f32; 3]],
    band: usize,
) -> (Vec<[f32; 3]>, Vec<String>) {
    let mut first = effects.look_at(FilmSteps::of(look, baked).unwrap(), frame).unwrap();
    if first.needs_picture() {
        picture.chunks(band * frame.width()).for_each(|rows| first.add(rows).unwrap());
    }
    let mut run = first.finish().unwrap();
    let reasons = run.reasons().to_vec();
    let mut shown = Vec::new();
    for rows in picture.chunks(band * frame.width()) {
        run.add(rows).unwrap();
        let ready = run.ready();
        if ready > 0 {
            let mut some = vec![[f32::NAN; 3]; ready * frame.width()];
            run.develop(&mut some).unwrap();
            shown.extend(some);
        }
    }
    (shown, reasons)
}

/// One after the other the steps are the look: float32 between them costs 1e-5, as much as the loops themselves.
#[test]
fn three_steps_are_the_look() {
    let colours: Vec<[f32; 3]> = chart(-6..=6).iter().map(|rgb| rgb.map(|v| v as f32)).collect();
    for camera in ["kodak-5207", "fuji-velvia-50", "kodak-tri-x-400"] {
        let look = Process::for_camera(camera).unwrap().look().unwrap();
        let structured = Recipe { size: 9, ..Recipe::of(Form::Structured) };
        let forms = [None, Some(Recipe::of(Form::Direct)), Some(structured)];
        for baked in forms.map(|recipe| recipe.map(|recipe| look.baked(&recipe).unwrap())) {
            let steps = FilmSteps::of(&look, baked.as_ref()).unwrap();
            let mut layers: [Vec<f32>; 3] = std::array::from_fn(|_| vec![0.0; colours.len()]);
            steps.expose(&colours, layers.each_mut().map(Vec::as_mut_slice));
            steps.develop(layers.each_mut().map(Vec::as_mut_slice));
            let mut shown = vec![[0.0; 3]; colours.len()];
            steps.finish(layers.each_ref().map(Vec::as_slice), &mut shown);
            for (rgb, shown) in colours.iter().zip(&shown) {
                let whole = match &baked {
                    Some(baked) => baked.apply(*rgb),
                    None => look.develop(rgb.map(f64::from)).map(|v| v as f32),
                };
                let near = shown.iter().zip(whole).all(|(a, b)| (a - b).abs() < 2e-5);
                assert!(near, "{camera} {:?} {rgb:?}: {shown:?} for {whole:?}", baked.as_ref().map(Baked::describe));
            }
        }
    }
}

#[test]
fn bands_and_threads_give_the_same_bytes() {
    let process = process("kodak-5219", |effects| {
        (effects.halation, effects.antihalation) = (EffectChoice::On, Antihalation::None);
    });
    let look = Look::Film(process.compile().unwrap());
    let baked = look.baked(&Recipe::of(Form::Direct)).unwrap();
    let effects = FilmEffects::new(&process).unwrap().unwrap();
    let picture = picture();
    let run = |threads: usize, band| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| developed(&effects, &look, Some(&baked), frame(2048), &picture, band))
    };
    let (whole, reasons) = run(1, SIZE[1]);
    assert_eq!(whole.len(), picture.len());
    for (threads, band) in [(3, SIZE[1]), (1, 1), (2, 7), (4, 64)] {
        assert!(run(threads, band) == (whole.clone(), reasons.clone()), "{threads} threads, bands of {band}");
    }
    let steps = || FilmSteps::of(&look, Some(&baked)).unwrap();
    assert!(effects.develop(steps(), frame(2048), &picture).unwrap() == (whole, reasons), "as a whole");
    let message = effects.develop(steps(), frame(2048), &picture[1..]).unwrap_err().to_string();
    assert_eq!(message, "picture: found 35999 pixels, expected 240 x 150 as its frame has");
}

/// Where no effect is run the steps are those of the form, and every reason is told.
#[test]
fn what_cannot_be_seen_is_left_out_and_told() {
    let process = process("kodak-5207", |effects| effects.halation = EffectChoice::Auto);
    let look = Look::Film(process.compile().unwrap());
    let effects = FilmEffects::new(&process).unwrap().unwrap();
    let grey = vec![[0.18; 3]; SIZE[0] * SIZE[1]];
    let coarse = Frame::new(SIZE, Pitch::new(200.0, 200.0).unwrap()).unwrap();
    let mut first = effects.look_at(FilmSteps::of(&look, None).unwrap(), coarse).unwrap();
    first.add(&grey).unwrap();
    let run = first.finish().unwrap();
    assert!(!run.runs_any());
    let [assumed, grain, sharpness, halation] = run.reasons() else { panic!("{:?}", run.reasons()) };
    assert!(assumed.contains("density 0.8 is assumed for kodak-5207, as no sheet states it"), "{assumed}");
    for (reason, effect) in [(grain, "grain"), (sharpness, "sharpness"), (halation, "halation")] {
        assert!(reason.starts_with(effect) && reason.ends_with("px of 48.0 mm: not visible, skipped"), "{reason}");
    }
    let (shown, _) = developed(&effects, &look, None, coarse, &grey, 50);
    let whole = look.develop([0.18f32; 3].map(f64::from)).map(|v| v as f32);
    assert!(shown.iter().all(|rgb| rgb.iter().zip(whole).all(|(a, b)| (a - b).abs() < 1e-6)));
}

/// What grain is for: grey is grainy, and as bright as it was. The mean of 36,000 pixels scatters by 1/190 of a pixel's own.
#[test]
fn grain_keeps_large_areas() {
    for (camera, stops) in [("kodak-5219", [-2.0f32, 0.0, 2.0]), ("kodak-ektachrome-100", [-1.0, 0.0, 1.0])] {
        let process = process(camera, |effects| {
            (effects.grain, effects.sharpness, effects.seed) = (EffectChoice::On, EffectChoice::Off, 5);
        });
        let look = Look::Film(process.compile().unwrap());
        let baked = look.baked(&Recipe::of(Form::Direct)).unwrap();
        let effects = FilmEffects::new(&process).unwrap().unwrap();
        for level in stops.map(|stops| 0.18 * stops.exp2()) {
            let grey = vec![[level; 3]; SIZE[0] * SIZE[1]];
            let (shown, _) = developed(&effects, &look, Some(&baked), frame(2048), &grey, SIZE[1]);
            let plain = baked.apply([level; 3]);
            for layer in 0..3 {
                let linear = |v: f32| look.coding().curve.decode(f64::from(v));
                let count = shown.len() as f64;
                let mean = shown.iter().map(|rgb| linear(rgb[layer])).sum::<f64>() / count;
                let scatter = shown.iter().map(|rgb| (linear(rgb[layer]) - mean).powi(2)).sum::<f64>() / count;
                let scatter = scatter.sqrt();
                let off = (mean - linear(plain[layer])).abs();
                assert!(off < 0.03 * scatter, "{camera} {level} {layer}: {mean} for {}", linear(plain[layer]));
                assert!(scatter > 0.01 * mean, "{camera} {level} {layer}: {scatter} of {mean}");
            }
        }
    }
}

/// A structured table ends where light can lead, and grain leads beyond: there it is held at the end. The direct form goes on, so it is what
/// the table is held against. On negatives printed little is lost; on clear reversal film half of the grain is, which docs/spatial.md states.
#[test]
fn grain_beyond_the_ends_of_a_table_is_held_there() {
    for camera in ["kodak-5219", "kodak-5207", "kodak-ektachrome-100"] {
        let process = process(camera, |effects| {
            (effects.grain, effects.sharpness) = (EffectChoice::On, EffectChoice::Off);
        });
        let look = Look::Film(process.compile().unwrap());
        let [direct, structured] = [Form::Direct, Form::Structured].map(|form| look.baked(&Recipe::of(form)).unwrap());
        let effects = FilmEffects::new(&process).unwrap().unwrap();
        let difference = look.difference().unwrap();
        for level in [0.0, 0.18 / 64.0, 0.18, 0.18 * 16.0, 0.18 * 1024.0] {
            let between = |a: [f32; 3], b: [f32; 3]| {
                let [a, b] = [a, b].map(|rgb| look.coding().decode_rgb(rgb.map(f64::from)));
                difference.between(a, b)
            };
            let grey = vec![[level; 3]; SIZE[0] * SIZE[1]];
            let [with_direct, with_table] = [&direct, &structured]
                .map(|baked| developed(&effects, &look, Some(baked), frame(2048), &grey, SIZE[1]).0);
            let mut all: Vec<f64> = with_direct.iter().zip(&with_table).map(|(a, b)| between(*a, *b)).collect();
            all.sort_by(f64::total_cmp);
            let at = |part: f64| all[((all.len() - 1) as f64 * part) as usize];
            let is_clear = camera == "kodak-ektachrome-100" && level > 1.0;
            let allowed = if is_clear { [0.6, 2.1] } else { [0.2, 0.5] };
            let found = [at(0.5), at(0.99)];
            assert!(found[0] < allowed[0] && found[1] < allowed[1], "{camera} {level}: {found:?}");
            assert!(!is_clear || found[1] > 1.0, "docs/spatial.md says otherwise: {found:?}");
        }
    }
}

/// Light returns where the lamp is dark, to the red layer first.
#[test]
fn halos_are_red() {
    let process = process("kodak-5207", |effects| {
        effects.halation = EffectChoice::On;
        effects.antihalation = Antihalation::Density(0.3);
        (effects.grain, effects.sharpness) = (EffectChoice::Off, EffectChoice::Off);
    });
    let look = Look::Film(process.compile().unwrap());
    let baked = look.baked(&Recipe::of(Form::Direct)).unwrap();
    let effects = FilmEffects::new(&process).unwrap().unwrap();
    let mut picture = vec![[0.01; 3]; SIZE[0] * SIZE[1]];
    for y in 60..75 {
        picture[y * SIZE[0] + 110..][..15].fill([180.0; 3]);
    }
    let (shown, _) = developed(&effects, &look, Some(&baked), frame(2048), &picture, 40);
    let dark = baked.apply([0.01; 3]);
    // 22 pixels of 12.16 um from the lamp's middle: on the ring.
    let halo = shown[67 * SIZE[0] + 117 + 22];
    assert!(halo[0] > 5.0 * halo[1] && halo[1] > 2.0 * dark[1] && halo[2] < dark[2], "{halo:?} {dark:?}");
    assert_eq!(shown[0].map(|v| (v * 100.0).round()), dark.map(|v| (v * 100.0).round()), "far away");
}

#[test]
fn films_without_figures_are_told_or_refused() {
    let velvia = |choice| process("fuji-velvia-50", |effects| effects.grain = choice);
    let error = FilmEffects::new(&velvia(EffectChoice::On)).unwrap_err();
    assert!(error.is_not_published() && error.to_string().contains("repeats the points of Kodak Ektachrome 100"));
    let effects = FilmEffects::new(&velvia(EffectChoice::Auto)).unwrap().unwrap();
    let look = Look::Film(velvia(EffectChoice::Auto).compile().unwrap());
    let first = effects.look_at(FilmSteps::of(&look, None).unwrap(), frame(2048)).unwrap();
    assert!(!first.needs_picture());
    let run = first.finish().unwrap();
    assert!(
        run.reasons().iter().all(|reason| reason.contains(": skipped, as fuji-velvia-50: ")),
        "{:?}",
        run.reasons()
    );
    assert!(FilmEffects::new(&FilmProcess::default()).unwrap().is_none());
}

#[test]
fn what_knows_no_dye_is_refused() {
    let look = Process::default().look().unwrap();
    let plain = look.baked(&Recipe::cube(9)).unwrap();
    let message = FilmSteps::of(&look, Some(&plain)).unwrap_err().to_string();
    assert!(message.contains("a plain table knows no dye") && message.contains("form direct, structured or reference"));
    let tone = Process::from(onelight::ToneProcess::default()).look().unwrap();
    assert!(FilmSteps::of(&tone, None).unwrap_err().is_contradiction());
    let toml = "version = 2\napproach = \"reinhard\"\nfilm_format = \"super35\"\n";
    let message = Process::from_toml("look.toml", toml).unwrap_err().to_string();
    assert!(message.contains("film_format changes nothing"), "{message}");
}

#[test]
fn rows_are_whole() {
    let process = process("kodak-5207", |_| {});
    let look = Look::Film(process.compile().unwrap());
    let effects = FilmEffects::new(&process).unwrap().unwrap();
    let mut first = effects.look_at(FilmSteps::of(&look, None).unwrap(), frame(2048)).unwrap();
    let message = first.add(&[[0.0; 3]; 250]).unwrap_err().to_string();
    assert_eq!(message, "rows of the picture: found 250 pixels, expected a multiple of its width, 240");
    assert!(first.finish().is_err(), "it was not shown the picture");
}
