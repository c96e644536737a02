//! Times of passes over pictures that take turns.

use onelight_gpu::{Fetch, FilmPass, Form, LookSettings, wgpu};
use wgpu::TextureFormat;

use super::card::Card;
use super::copy::Copy;
use super::pictures::{Sources, Targets};
use crate::error::Result;

/// How long a timed run of passes lasts, ms, and how many runs each pass gets, in turns with the others.
const RUN_MS: f64 = 40.0;
const RUNS: usize = 7;
/// Passes in a run: whole turns over the pairs of pictures.
const TURN: usize = 6;
const MOST: usize = 1200;

/// A form and how its table is read.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    pub(super) form: Form<'a>,
    pub(super) settings: LookSettings,
}

/// The time of a pass; the first of a group is the copy.
pub(super) struct Timed {
    /// Number of the subject, or None for the copy.
    pub(super) subject: Option<usize>,
    pub(super) ms: f64,
}

impl Subject<'_> {
    /// `structured, tetrahedral`
    pub(super) fn name(&self) -> String {
        match (self.form, self.settings.fetch) {
            (Form::Direct(_), _) => "direct".to_owned(),
            (form, Fetch::Filtered) => format!("{}, filtered", form.kind()),
            (form, Fetch::Texels) => format!("{}, tetrahedral", form.kind()),
        }
    }
}

impl Subject<'_> {
    /// Nodes a side of its table.
    pub(super) fn table_size(&self) -> Option<usize> {
        match self.form {
            Form::Plain(lut) => Some(lut.table().size()),
            Form::Structured(lut) => Some(lut.parts().table.size()),
            Form::Direct(_) => None,
        }
    }
}

enum Pass {
    Copy(Copy),
    Film(Box<FilmPass>),
}

/// Median times of the copy and of every subject from `sources` to a format, all in turns.
pub(super) fn times(
    card: &Card,
    sources: &Sources,
    target: TextureFormat,
    subjects: &[Subject<'_>],
) -> Result<Vec<Timed>> {
    let mut passes = vec![(None, Pass::Copy(Copy::new(card, target)))];
    for (i, Subject { form, settings }) in subjects.iter().enumerate() {
        let film = FilmPass::with_settings(&card.gpu.device, &card.gpu.queue, *form, target, settings)?;
        passes.push((Some(i), Pass::Film(Box::new(film))));
    }
    let usage = passes.iter().find_map(|(_, pass)| match pass {
        Pass::Film(film) => Some(film.target_usage()),
        Pass::Copy(_) => None,
    });
    let targets = Targets::new(card, target, sources.size, usage.unwrap_or(wgpu::TextureUsages::RENDER_ATTACHMENT));
    let run = |pass: &Pass, count: usize| -> Result<f64> {
        let ms = card.time(|encoder| {
            for _ in 0..count {
                let (from, to) = targets.next(sources);
                match pass {
                    Pass::Copy(copy) => copy.encode(card, encoder, from, to),
                    Pass::Film(film) => film.encode(encoder, from, to)?,
                }
            }
            Ok(())
        })?;
        Ok(ms / count as f64)
    };
    // The first run of each warms it up and says how many make a run of the wanted length.
    let mut counts = Vec::new();
    for (_, pass) in &passes {
        let ms = run(pass, TURN)?.max(1e-6);
        let count = if card.is_software { 1 } else { (RUN_MS / ms / TURN as f64).ceil() as usize };
        counts.push((count * TURN).clamp(TURN, MOST));
    }
    let mut runs = vec![Vec::new(); passes.len()];
    for _ in 0..if card.is_software { 1 } else { RUNS } {
        for ((runs, (_, pass)), &count) in runs.iter_mut().zip(&passes).zip(&counts) {
            runs.push(run(pass, count)?);
        }
    }
    Ok(passes.iter().zip(runs).map(|((subject, _), runs)| Timed { subject: *subject, ms: median(runs) }).collect())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
