//! The film in the form that was asked for.

use anyhow::Result;
use clap::ValueEnum;
use indicatif::ProgressBar;
use onelight::Look;
use onelight::baked::{self, Baked, Recipe};
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

/// A film, ready for any number of pictures on any number of threads.
pub(crate) enum Film {
    /// The exact film in float64: the slowest, and what the others are measured against.
    Exact(Box<Look>),
    /// What was baked of it.
    Baked(Box<Baked>),
}

impl Film {
    pub(crate) fn new(look: &ChosenLook, form: Form) -> Result<Self> {
        let film = look.look()?;
        let form = match form {
            Form::Reference => return Ok(Self::Exact(Box::new(film))),
            Form::Plain => baked::Form::Plain,
            Form::Structured => baked::Form::Structured,
            Form::Direct => baked::Form::Direct,
        };
        Ok(Self::Baked(Box::new(film.baked(&Recipe::of(form))?)))
    }

    /// Its form, in words.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Exact(_) => "reference".to_owned(),
            Self::Baked(baked) => baked.describe(),
        }
    }

    /// Scene-linear to display-coded, in place; `progress` counts rows.
    pub(super) fn develop(&self, band: &mut Band, progress: &ProgressBar) {
        match self {
            Self::Exact(film) => band.rows_mut().for_each(|row| {
                for rgb in row.rgb {
                    *rgb = film.develop(rgb.map(f64::from)).map(|v| v as f32);
                }
                progress.inc(1);
            }),
            Self::Baked(baked) => {
                baked.map_in_place(band.rgb_mut());
                progress.inc(band.rows() as u64);
            }
        }
    }

    /// The brightest scene value that the form tells from brighter ones.
    pub(super) fn max(&self) -> Option<f64> {
        match self {
            Self::Exact(_) => None,
            Self::Baked(baked) => baked.max(),
        }
    }
}
