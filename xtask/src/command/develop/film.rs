//! The film in the form that was asked for.

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use indicatif::ProgressBar;
use onelight::baked::{self, Baked, Recipe, ShaperChoice};
use onelight::{FilmEffects, FilmSteps, Look, Process, Reference, TableCoding, Uncertainty, WideGamut};
use onelight_picture::Band;
use rayon::prelude::*;

use crate::look::ChosenLook;

/// How the film is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Form {
    /// Exact: every pixel through the spectra, in float64
    Reference,
    /// A 33^3 table with a log2 shaper, as `bake` writes it
    Plain,
    /// A 32^3 table whose axes are the film's curves, as `bake --form structured` writes it
    Structured,
    /// No table: curves and a few exponentials, as `bake --form direct` writes them
    Direct,
}

impl Form {
    /// The usual form of a look: the direct form of a film, which is several hundred times faster than the film itself and cannot be
    /// told from it; other looks as they are.
    fn usual(look: &ChosenLook) -> Self {
        match look.process {
            Process::Film(_) => Self::Direct,
            Process::Print(_) | Process::First(_) | Process::Tone(_) => Self::Reference,
        }
    }
}

/// A film, ready for any number of pictures on any number of threads.
pub(crate) struct Film {
    /// The exact film in float64: the slowest, and what the others are measured against.
    exact: Look,
    /// What was baked of it, and maps pictures in its place.
    baked: Option<Baked>,
    /// What takes the picture's place, where a map of it is asked for.
    uncertainty: Option<Uncertainty>,
    /// What the camera film does to pictures, where the look has a film format.
    effects: Option<FilmEffects>,
    form: Form,
}

impl Film {
    /// The look in this form, the usual one unless it is named.
    pub(crate) fn new(look: &ChosenLook, form: Option<Form>) -> Result<Self> {
        let exact = look.look()?;
        let form = form.unwrap_or(Form::usual(look));
        let baked = match form {
            Form::Reference => None,
            Form::Plain => Some(baked::Form::Plain),
            Form::Structured => Some(baked::Form::Structured),
            Form::Direct => Some(baked::Form::Direct),
        };
        let recipe = |form| match exact {
            Look::Print(_) if form == baked::Form::Plain => Recipe::taking(ShaperChoice::Cineon),
            // Densities are decoded by a power, PQ and HLG are none.
            _ if exact.coding().curve.is_hdr() => Recipe { coding: TableCoding::Display, ..Recipe::of(form) },
            _ => Recipe::of(form),
        };
        let baked = baked.map(|form| exact.baked(&recipe(form))).transpose()?;
        let film = Self { exact, baked, uncertainty: None, effects: look.effects()?, form };
        if film.effects.is_some() {
            film.steps().context("--film-format")?;
        }
        Ok(film)
    }

    /// The film in three steps, for what happens to a picture between them.
    pub(super) fn steps(&self) -> Result<FilmSteps<'_>> {
        Ok(FilmSteps::of(&self.exact, self.baked.as_ref())?)
    }

    /// What the camera film does to pictures, where the look has a film format.
    pub(super) fn effects(&self) -> Option<&FilmEffects> {
        self.effects.as_ref()
    }

    /// A map of what the look is uncertain by, in place of its picture: red the whole CIEDE2000, green what of it the sheets make,
    /// blue the inter-image effect.
    pub(super) fn uncertainty(look: &ChosenLook) -> Result<Self> {
        let Process::Film(process) = &look.process else {
            bail!("--uncertainty: approaches without film have no data sheets, expected approach second");
        };
        let found = match look.films() {
            Some(films) => Uncertainty::with(process, films)?,
            None => Uncertainty::new(process)?,
        };
        Ok(Self { exact: look.look()?, baked: None, uncertainty: Some(found), effects: None, form: Form::Reference })
    }

    /// The exact look.
    pub(super) fn exact(&self) -> &Look {
        &self.exact
    }

    /// What maps pictures in its place, if anything does.
    pub(super) fn baked(&self) -> Option<&Baked> {
        self.baked.as_ref()
    }

    /// The film, if it compresses light outside the sRGB primaries.
    pub(super) fn compressing(&self) -> Option<&Reference> {
        match &self.exact {
            Look::Film(film) if film.exposure_matrix().gamut() == WideGamut::Compress => Some(film),
            _ => None,
        }
    }

    /// The word of its form on the command line.
    pub(super) fn form_word(&self) -> String {
        self.form.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// Its form, in words.
    pub(super) fn describe(&self) -> String {
        self.baked.as_ref().map_or_else(|| "reference".to_owned(), Baked::describe)
    }

    /// Scene-linear to display-coded, in place; `progress` counts rows.
    pub(super) fn develop(&self, band: &mut Band, progress: &ProgressBar) {
        if let Some(uncertainty) = &self.uncertainty {
            band.rows_mut().for_each(|row| {
                for rgb in row.rgb {
                    let [sheets, inter_image] = uncertainty.parts(rgb.map(f64::from));
                    *rgb = [sheets.hypot(inter_image), sheets, inter_image].map(|v| v as f32);
                }
                progress.inc(1);
            });
            return;
        }
        match &self.baked {
            None => band.rows_mut().for_each(|row| {
                for rgb in row.rgb {
                    *rgb = self.exact.develop(rgb.map(f64::from)).map(|v| v as f32);
                }
                progress.inc(1);
            }),
            Some(baked) => {
                baked.map_in_place(band.rgb_mut());
                progress.inc(band.rows() as u64);
            }
        }
    }

    /// The brightest scene value that the form tells from brighter ones.
    pub(super) fn max(&self) -> Option<f64> {
        self.baked.as_ref().and_then(Baked::max)
    }
}
