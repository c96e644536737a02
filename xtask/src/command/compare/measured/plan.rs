//! What is put beside what: the comparisons of the talk, and each switch.

use onelight::spatial::{Antihalation, FilmFormat};
use onelight::{
    Aim, Approach, Calibration, DyeModel, EffectChoice, Effects, Error, FilmProcess, Filters, FirstControls, HeatGlass,
    Infrared, InterImageChoice, Matching, PrintCurves, PrinterLight, Process, ProcessKeys, Projector, Reconstruction,
    Tail, White, WideGamut, Word, Wratten,
};

/// One picture: a look at an exposure.
#[derive(Clone)]
pub(super) struct Shot {
    pub(super) caption: String,
    pub(super) keys: ProcessKeys,
    /// Stops that the scene is brighter.
    pub(super) ev: i32,
    /// The shot of the same sheet that it is compared with.
    pub(super) beside: Option<usize>,
}

/// Pictures of one comparison, side by side.
pub(super) struct Sheet {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// What the reader should look for.
    pub(super) text: &'static str,
    pub(super) columns: usize,
    pub(super) shots: Vec<Shot>,
}

impl Sheet {
    fn new(name: &'static str, title: &'static str, text: &'static str, columns: usize) -> Self {
        Self { name, title, text, columns, shots: Vec::new() }
    }

    /// Whether it shows what film does to a picture rather than to a colour: on parts of pictures, pixel by pixel.
    pub(super) fn is_on_film(&self) -> bool {
        self.shots.iter().all(|shot| shot.keys.film_format.is_some())
    }

    /// A shot at normal exposure with nothing to compare it with; its place on the sheet.
    fn plain(&mut self, caption: impl Into<String>, process: &ProcessKeys) -> usize {
        self.shots.push(Shot { caption: caption.into(), keys: process.clone(), ev: 0, beside: None });
        self.shots.len() - 1
    }

    /// The same process, changed, beside the plain one.
    fn turned(&mut self, caption: impl Into<String>, plain: usize, turn: impl FnOnce(&mut ProcessKeys)) {
        let Some(usual) = self.shots.get(plain) else { return };
        let mut shot = Shot { caption: caption.into(), beside: Some(plain), ..usual.clone() };
        turn(&mut shot.keys);
        self.shots.push(shot);
    }
}

/// The process of a camera film as the talk has it.
pub(super) fn usual(camera: &str) -> Result<ProcessKeys, Error> {
    let mut keys = ProcessKeys::from(&Process::for_camera(camera)?);
    keys.set_talk();
    Ok(keys)
}

/// The first approach with the same films: it has no layers, white or gamut of its own.
fn first_approach(of: &ProcessKeys) -> ProcessKeys {
    let ProcessKeys { inter_image, white, gamut, .. } = ProcessKeys::default();
    ProcessKeys { approach: Approach::First, inter_image, white, gamut, ..of.clone() }
}

/// A film with its name in the talk.
type Named = (String, ProcessKeys);

/// The five films of the talk, each in its usual process.
pub(super) fn films() -> Result<Vec<Named>, Error> {
    let films = [
        ("K-negative 5207 on 2383", "kodak-5207"),
        ("K-reversal Ektachrome 100", "kodak-ektachrome-100"),
        ("K-reversal Kodachrome 64", "kodak-kodachrome-64"),
        ("F-reversal Velvia 50", "fuji-velvia-50"),
        ("F-reversal 2 Provia 100F", "fuji-provia-100f"),
    ];
    films.into_iter().map(|(name, camera)| Ok((name.to_owned(), usual(camera)?))).collect()
}

/// Letters of a name that fit on a tile beside the rest of a caption.
const NAME_LETTERS: usize = 27;

/// Every comparison of the talk, and each switch; a look of the user's joins the films.
pub(super) fn sheets(own: Option<&Process>) -> Result<Vec<Sheet>, Error> {
    let mut films = films()?;
    let talk = films.clone();
    films.extend(own.map(|own| (own.name().chars().take(NAME_LETTERS).collect(), ProcessKeys::from(own))));
    let negative = usual(onelight::DEFAULT_CAMERA)?;
    let (k_reversal, f_reversal) = (usual("kodak-ektachrome-100")?, usual("fuji-velvia-50")?);
    Ok(vec![
        exposures(&films),
        approaches(&films),
        by_hand(&films),
        aims(&films),
        iterations(&negative),
        infrared(&negative),
        matrices(&[("K-negative", &negative), ("F-reversal", &f_reversal)]),
        dyes(&[("K-negative", &negative), ("K-reversal", &k_reversal), ("F-reversal", &f_reversal)]),
        printer(&negative),
        projectors(&[("K-negative", &negative), ("K-reversal", &k_reversal)]),
        overexposure(&negative),
        as_it_is(&talk),
        matching(&[("Portra 160", &usual("kodak-portra-160")?), ("5219", &usual("kodak-5219")?)]),
        effects()?,
        formats()?,
        antihalation()?,
    ])
}

fn as_it_is(films: &[Named]) -> Sheet {
    let text = "What film does beyond its sheet, each by itself and all at once, beside the talk: layers that hold back each other's \
                development make colours stronger, clear film for white makes highlights neutral and brighter, light outside the sRGB \
                primaries fades smoothly. Last, the print's curves read as the density of each layer's dye alone.";
    let mut sheet = Sheet::new("film", "Film as it is", text, 5);
    for (name, process) in films {
        let talk = sheet.plain(format!("talk: {name}"), process);
        let layers = |p: &mut ProcessKeys| p.inter_image = InterImageChoice::default();
        let white = |p: &mut ProcessKeys| p.white = White::Film;
        let gamut = |p: &mut ProcessKeys| p.gamut = WideGamut::Compress;
        sheet.turned(format!("layers: {name}"), talk, layers);
        sheet.turned(format!("white: {name}"), talk, white);
        sheet.turned(format!("gamut: {name}"), talk, gamut);
        sheet.turned(format!("all: {name}"), talk, |p| [layers, white, gamut].iter().for_each(|turn| turn(p)));
    }
    sheet.turned("print curves: K-negative", 0, |p| p.print_curves = PrintCurves::Principal);
    sheet
}

fn exposures(films: &[Named]) -> Sheet {
    /// Exposures of a row of pictures, in stops about the normal one.
    const EXPOSURES: [i32; 5] = [-4, -2, 0, 2, 4];
    let text = "Tone mapping above, films below, two stops apart. Films are steeper in the middle, darker in the shadows, and let \
                bright colours fade to white where tone mapping keeps or clips them; greys are tinted. Each is compared with \
                Reinhard's curve at the same exposure.";
    let mut sheet = Sheet::new("films", "Films over exposures", text, EXPOSURES.len());
    let baseline = |approach| ProcessKeys { approach, ..ProcessKeys::default() };
    let rows = [
        ("Reinhard", Approach::Reinhard),
        ("Reinhard, luminance", Approach::ReinhardLuminance),
        ("clipped", Approach::Clip),
    ];
    let rows = rows.map(|(name, approach)| (name.to_owned(), baseline(approach)));
    for (row, (name, process)) in rows.iter().chain(films).enumerate() {
        for (column, ev) in EXPOSURES.into_iter().enumerate() {
            let beside = (row > 0).then_some(column);
            sheet.shots.push(Shot {
                caption: if ev == 0 { format!("{name} 0 EV") } else { format!("{name} {ev:+} EV") },
                keys: process.clone(),
                ev,
                beside,
            });
        }
    }
    sheet
}

fn approaches(films: &[Named]) -> Sheet {
    let text = "The talk's first approach on the left, the second on the right. The first has the film's contrast; colours stay \
                those of the scene, because dyes and the light between them are missing.";
    let mut sheet = Sheet::new("approaches", "First approach against second", text, 2);
    for (name, process) in films {
        let plain = sheet.plain(format!("first: {name}"), &first_approach(process));
        sheet.turned(format!("second: {name}"), plain, |p| p.clone_from(process));
    }
    sheet
}

fn by_hand(films: &[Named]) -> Sheet {
    let text = "What a hand can change in the first approach: one matrix after the tone curve, and the curve itself.";
    let mut sheet = Sheet::new("controls", "Controls of the first approach", text, 3);
    let Some((_, process)) = films.first() else { return sheet };
    let plain = sheet.plain("first approach, K-negative", &first_approach(process));
    let mut control = |name: &str, first: FirstControls| sheet.turned(name, plain, |p| p.first = first);
    let usual = FirstControls::default;
    control("contrast 1.2", FirstControls { contrast: 1.2, ..usual() });
    control("brightness +0.05", FirstControls { brightness: 0.05, ..usual() });
    control("temperature 5000 K", FirstControls { temperature: 5000.0, ..usual() });
    control("saturation 1.3", FirstControls { saturation: 1.3, ..usual() });
    control("curve -3:0.25, 0:0.5", FirstControls { curve: vec![[-3.0, 0.25], [0.0, 0.5]], ..usual() });
    sheet
}

fn aims(films: &[Named]) -> Sheet {
    let text = "Two modes of calibration: a grey card exactly neutral at density 0.7, and the densities of the sheet (reversal film: \
                its own exposure). The sheet's print is about a stop darker, made for a dark room.";
    let mut sheet = Sheet::new("calibration", "Neutral aim against the sheet's", text, 2);
    for (name, process) in films {
        let plain = sheet.plain(format!("neutral: {name}"), process);
        sheet.turned(format!("sheet: {name}"), plain, |p| p.aim = Aim::Sheet);
    }
    sheet
}

fn iterations(negative: &ProcessKeys) -> Sheet {
    let text = "The talk finds the printer's lights by iteration from equal ones: one is practically enough. Exact is a linear solve.";
    let mut sheet = Sheet::new("iterations", "Calibration by iteration", text, 3);
    let exact = sheet.plain("exact", negative);
    for count in 0..=3 {
        let s = if count == 1 { "" } else { "s" };
        sheet.turned(format!("{count} iteration{s}"), exact, |p| p.calibration = Calibration::Iterations(count));
    }
    sheet.turned("1, no density in beams", exact, |p| {
        (p.calibration, p.beam_density) = (Calibration::Iterations(1), [0.0; 3]);
    });
    sheet
}

fn infrared(negative: &ProcessKeys) -> Sheet {
    let text = "With sensitivities that fall beyond their sheet, infrared and glass do next to nothing. Held flat to 1000 nm, as the \
                talk's figures imply, the print's red layer sees the infrared that gelatin filters let pass: without heat glass the \
                printer cannot be calibrated at all; cut at 780 nm it can.";
    let mut sheet = Sheet::new("infrared", "Infrared in the printer", text, 3);
    let usual = sheet.plain("as built", negative);
    sheet.turned("infrared off", usual, |p| p.infrared = Infrared::Off);
    sheet.turned("no heat glass", usual, |p| p.glass = HeatGlass::None);
    sheet.turned("held tail, glass", usual, |p| p.red_tail = Tail::Held);
    sheet.turned("held tail, no glass, cut", usual, |p| {
        (p.red_tail, p.glass, p.infrared) = (Tail::Held, HeatGlass::None, Infrared::Off);
    });
    sheet.turned("held tail, no glass", usual, |p| (p.red_tail, p.glass) = (Tail::Held, HeatGlass::None));
    sheet
}

fn matrices(films: &[(&str, &ProcessKeys)]) -> Sheet {
    let text = "Four methods that make a spectrum of RGB. Three raw boxes are the talk's \"color balance not adjusted properly\": saturated colours \
                move most, greys not at all.";
    let mut sheet = Sheet::new("matrices", "Spectra for RGB", text, 4);
    for (name, process) in films {
        let usual = sheet.plain(format!("smooth: {name}"), process);
        for (value, word, _) in <Reconstruction as Word>::ALL.iter().copied().skip(1) {
            sheet.turned(format!("{word}: {name}"), usual, |p| p.reconstruction = value);
        }
    }
    sheet
}

fn dyes(films: &[(&str, &ProcessKeys)]) -> Sheet {
    let text = "From densities to dye. The wedge gives the sheet's densities together; read literally, each density is its own dye's \
                amount and the densities of the others come on top. Last, the talk's formula with a matching constant for each dye of the \
                negative, which nearly is the wedge.";
    let mut sheet = Sheet::new("dyes", "Densities to dyes", text, 4);
    for (name, process) in films {
        for aim in [Aim::Neutral, Aim::Sheet] {
            let word = aim.word();
            let usual = sheet.plain(format!("{word}, wedge: {name}"), &ProcessKeys { aim, ..(*process).clone() });
            sheet.turned(format!("{word}, literal: {name}"), usual, |p| p.dyes = DyeModel::Literal);
        }
    }
    sheet.turned("neutral, constants: K-negative", 0, |p| p.dyes = DyeModel::Constants);
    sheet
}

fn printer(negative: &ProcessKeys) -> Sheet {
    let without = |gone: Wratten| {
        let rest: Vec<Wratten> = Wratten::ALL.into_iter().filter(|filter| *filter != gone).collect();
        Filters::of(&rest)
    };
    let text = "White light instead of three beams costs chroma. Without the red or the green separation no lights balance the print. \
                More of a light makes its complement: +4 points of red print cyan.";
    let mut sheet = Sheet::new("printer", "Lights and filters of the printer", text, 5);
    let usual = sheet.plain("separations, all filters", negative);
    sheet.turned("one white lamp", usual, |p| p.light = PrinterLight::White);
    for filter in Wratten::ALL {
        sheet.turned(format!("without Wratten {}", filter.word()), usual, |p| p.filters = without(filter));
    }
    sheet.turned("+1 point of all", usual, |p| p.points = [1.0; 3]);
    for (name, points) in
        [("+4 points red", [4.0, 0.0, 0.0]), ("+4 points green", [0.0, 4.0, 0.0]), ("+4 points blue", [0.0, 0.0, 4.0])]
    {
        sheet.turned(name, usual, |p| p.points = points);
    }
    sheet
}

fn projectors(films: &[(&str, &ProcessKeys)]) -> Sheet {
    let text = "An eye adapted to the lamp sees nearly the same film by any of them; beside a 6500 K display a theatre's light is warm.";
    let mut sheet = Sheet::new("projectors", "The projector's lamp", text, 4);
    for (name, process) in films {
        let usual = sheet.plain(format!("6500 K: {name}"), process);
        for (word, projector) in [
            ("5500 K, adapted", Projector::Theatre),
            ("5500 K, not adapted", Projector::TheatreUnadapted),
            ("xenon, adapted", Projector::Xenon),
        ] {
            sheet.turned(format!("{word}: {name}"), usual, |p| p.projector = projector);
        }
    }
    sheet
}

fn overexposure(negative: &ProcessKeys) -> Sheet {
    let text = "The negative exposed over or under normal, the print corrected for it: grey stays. Underexposed, shadows fall on the \
                toe and lose contrast; overexposed, little changes but highlights.";
    let mut sheet = Sheet::new("overexposure", "Exposure of the negative, print corrected", text, 3);
    let usual = sheet.plain("normal", negative);
    for stops in [-3.0, -1.0, 1.0, 3.0] {
        sheet.turned(format!("{stops:+} stops"), usual, |p| p.overexposure = stops);
    }
    sheet
}

fn matching(films: &[(&str, &ProcessKeys)]) -> Sheet {
    let text = "Balanced on a grey card, or by the sheet's own units, under which light of another colour than the film is made for keeps its \
                colour: 5219 is a tungsten film and shows daylight blue. What sensitivities and curves of a sheet disagree on adds to it.";
    let mut sheet = Sheet::new("matching", "Matching of exposure and curves", text, 2);
    for (name, process) in films {
        let usual = sheet.plain(format!("grey: {name}"), process);
        sheet.turned(format!("absolute: {name}"), usual, |p| p.matching = Matching::Absolute);
    }
    sheet
}

/// A film on Super 16 without any effect.
fn on_film(camera: &str) -> Result<ProcessKeys, Error> {
    let (off, film_format) = (EffectChoice::Off, Some(FilmFormat::Super16));
    let effects = Effects { film_format, grain: off, sharpness: off, ..Effects::default() };
    Ok(ProcessKeys::from(&Process::from(FilmProcess { effects, ..FilmProcess::for_camera(camera)? })))
}

fn sharp(keys: &mut ProcessKeys) {
    keys.sharpness = EffectChoice::On;
}

fn grainy(keys: &mut ProcessKeys) {
    keys.grain = EffectChoice::On;
}

fn with_halation(keys: &mut ProcessKeys) {
    keys.halation = EffectChoice::On;
}

fn effects() -> Result<Sheet, Error> {
    let text = "Part of a picture that fills a frame of Super 16, pixel by pixel, about its brightest place. Sharpness is the sheet's: light \
                scatters, development sharpens edges. Grain is the sheet's: coarser in fast films. Halation rests on a density that no \
                sheet states, 0.8.";
    let mut sheet = Sheet::new("effects", "Sharpness, grain, halation", text, 5);
    for (name, camera) in [("5219", "kodak-5219"), ("5207", "kodak-5207"), ("Ektachrome 100", "kodak-ektachrome-100")] {
        let plain = sheet.plain(format!("colour alone: {name}"), &on_film(camera)?);
        sheet.turned(format!("sharpness: {name}"), plain, sharp);
        sheet.turned(format!("grain: {name}"), plain, grainy);
        sheet.turned(format!("halation: {name}"), plain, with_halation);
        sheet.turned(format!("all: {name}"), plain, |p| [sharp, grainy, with_halation].iter().for_each(|turn| turn(p)));
    }
    Ok(sheet)
}

fn formats() -> Result<Sheet, Error> {
    let text = "The same pixels on films of other widths, with sharpness and grain: the smaller the frame, the coarser its grain, the \
                softer its edges.";
    let mut sheet = Sheet::new("formats", "Film formats", text, 5);
    for (name, camera) in [("5219", "kodak-5219"), ("5203", "kodak-5203")] {
        let plain = sheet.plain(format!("colour alone: {name}"), &on_film(camera)?);
        for format in [FilmFormat::Super8, FilmFormat::Super16, FilmFormat::Super35, FilmFormat::Film65] {
            sheet.turned(format!("{format}: {name}"), plain, |p| {
                p.film_format = Some(format);
                [sharp, grainy].iter().for_each(|turn| turn(p));
            });
        }
    }
    Ok(sheet)
}

fn antihalation() -> Result<Sheet, Error> {
    let text = "The layer that keeps light from returning decides everything about halation, and its density is on no sheet: usual ones \
                are taken to be 0.6 to 1. Without it, as where remjet was stripped for another developer, lamps have red-orange rings.";
    let mut sheet = Sheet::new("antihalation", "Halation by antihalation layer", text, 5);
    let plain = sheet.plain("no halation: 5219", &on_film("kodak-5219")?);
    for density in [1.0, 0.8, 0.6] {
        sheet.turned(format!("density {density:.1}: 5219"), plain, |p| {
            with_halation(p);
            p.antihalation = Antihalation::Density(density);
        });
    }
    sheet.turned("no layer: 5219", plain, |p| {
        with_halation(p);
        p.antihalation = Antihalation::None;
    });
    Ok(sheet)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_shot_has_a_caption_of_its_own_and_something_to_compare_with() {
        let sheets = sheets(None).unwrap();
        let names: HashSet<&str> = sheets.iter().map(|sheet| sheet.name).collect();
        assert_eq!(names.len(), sheets.len());
        for sheet in &sheets {
            let captions: HashSet<&str> = sheet.shots.iter().map(|shot| shot.caption.as_str()).collect();
            assert_eq!(captions.len(), sheet.shots.len(), "{}", sheet.name);
            for shot in &sheet.shots {
                // Letters of 8 pixels on a tile of 288.
                assert!(shot.caption.len() <= 36, "{}", shot.caption);
                assert!(shot.beside.is_none_or(|i| sheet.shots[i].ev == shot.ev), "{}", shot.caption);
            }
        }
    }

    /// The two impossible printers are shown as such; everything else works.
    #[test]
    fn only_what_physics_forbids_does_not_compile() {
        let refused: Vec<String> = sheets(None)
            .unwrap()
            .iter()
            .flat_map(|sheet| &sheet.shots)
            .filter_map(|shot| {
                shot.keys.process().and_then(|process| process.look()).err().map(|error| (shot.caption.clone(), error))
            })
            .map(|(caption, error)| {
                assert!(error.is_unreachable_aim(), "{caption}: {error}");
                caption
            })
            .collect();
        assert_eq!(refused, ["held tail, no glass", "without Wratten 70", "without Wratten 99"]);
    }
}
