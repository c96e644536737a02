//! What sharpness, halation and grain cost for each pixel, beside the colours alone and a copy.

use onelight::baked::{Baked, BakedForm, Form as BakedAs, Recipe};
use onelight::spatial::{Antihalation, FilmFormat, Frame as FilmFrame};
use onelight::{EffectChoice, Effects, FilmEffects, FilmProcess, FilmSteps, Look};
use serde::Serialize;

use crate::error::{Error, Result};
use crate::form::Form;
use crate::report::frame::Frame;
use crate::report::machine::threads;
use crate::report::scope::Scope;
use crate::report::stopwatch::{Pass, Timing, copying, interleaved, mapping};

/// The film whose effects are timed.
const CAMERA: &str = "kodak-5219";
const FORMAT: FilmFormat = FilmFormat::Super35;
/// Pixels that go in at once.
const BAND_PIXELS: usize = 1 << 20;

/// A picture's way from scene light to display-coded colours with some of the effects.
#[derive(Debug, Clone, Serialize)]
pub(in crate::report) struct PictureEffectRow {
    pub(in crate::report) what: &'static str,
    pub(in crate::report) one_thread: Timing,
    pub(in crate::report) all_threads: Timing,
}

impl PictureEffectRow {
    /// The row of the direct form by itself, which the others are more than.
    pub(in crate::report) const COLOUR_ALONE: &str = "colour alone";
}

/// A copy, the direct form alone, then the whole way of a picture with each effect and with all of them, on one thread and on all.
pub(super) fn picture_effects(frame: &Frame, scope: Scope) -> Result<Vec<PictureEffectRow>> {
    let look = Look::Film(FilmProcess::for_camera(CAMERA)?.compile()?);
    let baked = look.baked(&Recipe::of(BakedAs::Direct))?;
    let BakedForm::Direct(direct) = baked.form() else {
        return Err(Error::new("a look was baked to another form than the direct one, which was asked for"));
    };
    let colour = Form::Direct(direct.clone());
    let picture = OnFilm {
        frame: FilmFrame::new(frame.size(), FORMAT.pitch(frame.size()[0], 1.0)?)?,
        linear: (0..frame.size()[1]).flat_map(|y| frame.row(y).as_chunks().0).copied().collect(),
    };
    let (off, on) = (EffectChoice::Off, EffectChoice::On);
    let none = Effects { film_format: Some(FORMAT), grain: off, sharpness: off, ..Effects::default() };
    let cases = [
        ("in three steps, no effect", none),
        ("sharpness", Effects { sharpness: on, ..none }),
        ("grain", Effects { grain: on, ..none }),
        ("halation, a layer of density 0.8", Effects { halation: on, ..none }),
        ("halation, no layer", Effects { halation: on, antihalation: Antihalation::None, ..none }),
        ("all, a layer of density 0.8", Effects { sharpness: on, grain: on, halation: on, ..none }),
    ];
    let mut effects = Vec::new();
    for (_, effect) in cases {
        let process = FilmProcess { effects: effect, ..FilmProcess::for_camera(CAMERA)? };
        effects.extend(FilmEffects::new(&process)?);
    }
    let passes = effects.iter().map(|effects| picture.developing(effects, &look, &baked));
    let passes: Vec<Pass> = [copying(frame), mapping(&colour, frame)].into_iter().chain(passes).collect();
    let one = interleaved(&passes, frame, 1, scope.rounds(), || {})?;
    let all = interleaved(&passes, frame, threads(), scope.rounds(), || {})?;
    let names = ["copy", PictureEffectRow::COLOUR_ALONE].into_iter().chain(cases.map(|(what, _)| what));
    let rows = names.zip(one.into_iter().zip(all));
    Ok(rows.map(|(what, (one_thread, all_threads))| PictureEffectRow { what, one_thread, all_threads }).collect())
}

/// A picture that fills a frame of film.
struct OnFilm {
    frame: FilmFrame,
    linear: Vec<[f32; 3]>,
}

impl OnFilm {
    /// The whole picture, whichever rows are asked for: blurs need what is about them.
    fn developing<'a>(&'a self, effects: &'a FilmEffects, look: &'a Look, baked: &'a Baked) -> Pass<'a> {
        Box::new(move |_, _, buffer| {
            let width = self.frame.width();
            let band = width * (BAND_PIXELS / width).max(1);
            let mut first = effects.look_at(FilmSteps::of(look, Some(baked))?, self.frame)?;
            if first.needs_picture() {
                self.linear.chunks(band).try_for_each(|rows| first.add(rows))?;
            }
            let mut run = first.finish()?;
            let mut rest = buffer.as_chunks_mut().0;
            for rows in self.linear.chunks(band) {
                run.add(rows)?;
                let (ready, below) = rest.split_at_mut(width * run.ready());
                if !ready.is_empty() {
                    run.develop(ready)?;
                }
                rest = below;
            }
            Ok(self.linear.len())
        })
    }
}
