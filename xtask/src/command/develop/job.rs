//! One picture, from file to file.

use std::collections::VecDeque;
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use indicatif::ProgressBar;
use onelight::{
    Coverage, CoverageSeen, EffectsRun, FirstLook, LightSeen, PictureLight, Process, SceneStep, colour_tag,
};
use onelight_picture::{
    Band, BandSink, Channels, Description, JpegSettings, Limits, Metadata, PictureReader, PngSettings, TiffSettings,
    write_jpeg, write_png, write_tiff,
};
use rayon::prelude::*;

use super::bands::{Busy, look_through, pass};
use super::exposure::{self, Exposure};
use super::film::Film;
use super::input::InputSettings;
use super::light::{notes as notes_of_light, with_option};
use super::on_film::OnFilm;
use super::output::{KeptMetadata, Target};
use crate::atomic_file::write_atomically;
use crate::exposure::SceneExposure;
use crate::look::ChosenLook;
use crate::picture_file::{open_selected, text_of_complete_picture, write_exr_bands};

/// Everything that decides how a picture is developed; the same for all pictures of a run.
pub(super) struct Settings {
    pub(super) look: ChosenLook,
    pub(super) film: Film,
    pub(super) exposure: Exposure,
    /// What camera and frame buffer make of a picture's numbers.
    pub(super) scene: SceneExposure,
    /// Which picture comes in, and what its numbers mean.
    pub(super) input: InputSettings,
    /// Where the picture lies on the film.
    pub(super) on_film: OnFilm,
    pub(super) target: Target,
    /// Luminance of (1, 1, 1) in cd/m2, where an EXR of linear light is for a display of absolute light.
    pub(super) white_luminance: Option<f32>,
    pub(super) metadata: KeptMetadata,
    pub(super) limits: Limits,
}

/// What became of a picture.
#[derive(Debug)]
pub(super) struct Developed {
    /// Width and height of what was written.
    pub(super) size: [usize; 2],
    /// The exposure it was given, in stops.
    pub(super) ev: f64,
    /// What the user should know.
    pub(super) notes: Vec<String>,
    pub(super) busy: Busy,
}

/// One picture to develop, and where it goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Order<'a> {
    pub(super) input: &'a Path,
    pub(super) output: &'a Path,
    /// Its number in a sequence: each has grain of its own.
    pub(super) number: u32,
    /// Written into the output, to be known again by.
    pub(super) digest: Option<&'a str>,
}

/// Where the output holds the look.
const LOOK_KEY: &str = "onelight look";
/// Where the output holds [`Order::digest`].
pub(super) const DIGEST_KEY: &str = "onelight job";

/// Develops the picture in one file into another. May run beside others: it holds three bands of each picture (see
/// [`pass`]), with sharpness those about them too, and the threads are shared. `progress` counts rows, those of a first look for
/// [`Exposure::Auto`] or for effects too; `watch` sees each band of scene light before the film gets it.
///
/// # Errors
/// One sentence that starts with the path it is about; then `output` is as it was before.
pub(super) fn develop_picture(
    settings: &Settings,
    order: &Order<'_>,
    progress: &ProgressBar,
    mut watch: impl FnMut(&Description, &Band) + Send,
) -> Result<Developed> {
    let input = order.input;
    let Settings { look, film, exposure, target, .. } = settings;
    let open = || open_input(settings, input);
    let mut picture = open()?;
    let description = picture.description().clone();
    let mut notes = description.notes.clone();
    notes.iter_mut().filter(|note| note.contains("; there are also ")).for_each(|note| {
        note.push_str(" (--layer or --part chooses another)");
    });
    if matches!(look.process, Process::Film(_)) && text_of_complete_picture(input, LOOK_KEY).is_some() {
        notes.push("the picture was developed already: this is film on film".to_owned());
    }
    let light = PictureLight::new(&description, look.process.spaces(), &settings.input.colours);
    let way_out = "the file's colours cannot be used, expected --input-space with the space that is meant";
    let mut light = light.context(way_out).with_context(|| input.display().to_string())?;
    notes.extend(notes_of_light(&description, &look.process, &settings.input));
    notes.extend(settings.scene.notes.iter().cloned());
    let scene = |rgb| settings.scene.apply(rgb);
    let scene = (!settings.scene.changes_nothing()).then_some(&scene as SceneStep<'_>);
    let reopened = || {
        let again = open()?;
        if *again.description() != description {
            bail!("{}: the file changed while it was read", input.display());
        }
        Ok(again)
    };
    let mut is_covered = true;
    if description.channels == Channels::Rgba {
        let mut seen = CoverageSeen::default();
        look_through(&mut picture, |band| seen.add(band))?;
        let (coverage, more) = seen.decide(&description, settings.input.background);
        light.coverage = coverage;
        notes.extend(more.iter().map(with_option));
        if matches!(target, Target::Jpeg(..)) && light.coverage == Coverage::Kept {
            notes.push("a JPEG has no alpha: developed over black (--background chooses another)".to_owned());
            light.coverage = Coverage::Over([0.0; 3]);
        }
        is_covered = light.coverage != Coverage::Kept || seen.covers_all();
        picture = reopened()?;
    }
    let height = description.height as u64;
    let look_at = |effects| {
        let frame = settings.on_film.frame(effects, &description, order.number)?;
        anyhow::Ok(effects.look_at(film.steps()?, frame)?)
    };
    let first_look = film.effects().map(look_at).transpose().with_context(|| input.display().to_string())?;
    let looks =
        u64::from(*exposure == Exposure::Auto) + u64::from(first_look.as_ref().is_some_and(FirstLook::needs_picture));
    progress.set_length((1 + looks) * height);

    let mut seen_light = LightSeen::default();
    let ev = match *exposure {
        Exposure::Stops(stops) => stops,
        Exposure::Auto => {
            look_through(&mut picture, |band| {
                light.measure(band, scene, &mut seen_light);
                progress.inc(band.rows() as u64);
            })?;
            picture = reopened()?;
            seen_light.meter.exposure()
        }
    };
    let mut effects = None;
    if let Some(mut first_look) = first_look {
        if first_look.needs_picture() {
            let mut seen = Ok(());
            look_through(&mut picture, |band| {
                light.expose(band, ev, scene, None);
                if seen.is_ok() {
                    seen = first_look.add(band.rgb());
                }
                progress.inc(band.rows() as u64);
            })?;
            seen?;
            picture = reopened()?;
        }
        let run = first_look.finish()?;
        notes.extend(run.reasons().iter().cloned());
        if run.runs_any() {
            if !is_covered {
                notes.push(
                    "the picture keeps its alpha: where it covers nothing, the light that is stored there, mostly black, meets the film \
                     (--background lays it over what is behind it)"
                        .to_owned(),
                );
            }
            effects = Some(BandsOnFilm { run, waiting: VecDeque::new() });
        }
    }
    let mut beyond = 0;
    let develop = |mut band: Band, done: &mut Vec<Band>| {
        light.expose(&mut band, ev, scene, (*exposure != Exposure::Auto).then_some(&mut seen_light));
        beyond += film.max().map_or(0, |max| brighter(&band, max));
        watch(&description, &band);
        match &mut effects {
            Some(effects) => effects.develop(band, done, progress),
            None => {
                film.develop(&mut band, progress);
                done.push(band);
                Ok(())
            }
        }
    };
    let mut developed = Description {
        channels: light.coverage.channels(&description),
        white_luminance: settings.white_luminance,
        ..description.clone()
    };
    if settings.metadata == KeptMetadata::None {
        developed.metadata = Metadata::default();
    }
    let busy = write(order, *target, look, &developed, |sink| pass(&mut picture, develop, sink))?;

    notes.extend(exposure::notes(&seen_light, *exposure, ev));
    if target.is_shown() && !description.windows.show_pixels(description.width, description.height) {
        notes.push("the picture is empty, as its data window lies outside of its display window".to_owned());
    }
    if beyond > 0 {
        let max = film.max().unwrap_or_default();
        notes.push(format!(
            "{beyond} pixels are brighter than {max:.1}, where the plain table ends (--form structured has no end)"
        ));
    }
    let size =
        if target.is_shown() { description.windows.display_size } else { [description.width, description.height] };
    Ok(Developed { size, ev, notes, busy })
}

/// Opens the picture that comes in.
///
/// # Errors
/// As [`open_selected`], with the option that allows more where a limit refuses it.
pub(super) fn open_input(settings: &Settings, input: &Path) -> Result<PictureReader<'static>> {
    open_selected(input, &settings.limits, &settings.input.selection).map_err(|error| {
        let limit = error.downcast_ref::<onelight_picture::Error>().and_then(onelight_picture::Error::limit_field);
        match limit {
            Some("max_pixels") => anyhow!("{error} (--max-pixels allows more)"),
            Some("max_bytes") => anyhow!("{error} (--memory allows more)"),
            _ => error,
        }
    })
}

/// The bands of a picture whose film does more than change colours: each waits for those below it.
struct BandsOnFilm<'a> {
    run: EffectsRun<'a>,
    waiting: VecDeque<Band>,
}

impl BandsOnFilm<'_> {
    /// Takes a band of scene light, and adds those that can be developed now to `done`.
    fn develop(&mut self, band: Band, done: &mut Vec<Band>, progress: &ProgressBar) -> Result<()> {
        self.run.add(band.rgb())?;
        self.waiting.push_back(band);
        let mut ready = self.run.ready();
        while let Some(mut band) = self.waiting.pop_front_if(|band| band.rows() <= ready) {
            self.run.develop(band.rgb_mut())?;
            ready -= band.rows();
            progress.inc(band.rows() as u64);
            done.push(band);
        }
        Ok(())
    }
}

/// Pixels with a channel over `max`.
fn brighter(band: &Band, max: f64) -> usize {
    let rows = band.rgb().par_chunks(band.width().max(1));
    rows.map(|row| row.iter().filter(|rgb| rgb.iter().any(|v| f64::from(*v) > max)).count()).sum()
}

/// Writes what `fill` hands over as the process's display sees it.
fn write<T>(
    order: &Order<'_>,
    target: Target,
    look: &ChosenLook,
    scene: &Description,
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T>,
) -> Result<T> {
    let tag = colour_tag(look.process.spaces());
    let look = look.text_in(order.output.parent().unwrap_or(Path::new("")));
    let software = format!("onelight {}", env!("CARGO_PKG_VERSION"));
    let mut texts = vec![("Software", software.as_str()), (LOOK_KEY, look.as_str())];
    texts.extend(order.digest.map(|digest| (DIGEST_KEY, digest)));
    let path = order.output;
    let picture = Description { primaries: Some(tag.primaries), ..scene.clone() };
    let tag = Some(tag);
    match target {
        Target::Exr => write_exr_bands(path, &picture, &texts, fill),
        Target::Png(bits, dither) => {
            write_atomically(path, |file| write_png(file, &picture, PngSettings { bits, tag, dither }, &texts, fill))
        }
        Target::Tiff(bits, dither) => {
            write_atomically(path, |file| write_tiff(file, &picture, TiffSettings { bits, tag, dither }, &texts, fill))
        }
        Target::Jpeg(quality, dither) => {
            let settings = JpegSettings { quality, tag, dither };
            write_atomically(path, |file| write_jpeg(file, &picture, settings, &texts, fill))
        }
    }
}
