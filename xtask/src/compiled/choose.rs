//! The smallest table that keeps a promise.

use anyhow::{Context, Result, bail};
use onelight::lut::{Samples, Search, Storage};
use onelight::{Look, Process, TableCoding};

use super::{Compiled, Form, Recipe};
use crate::certificate::Measure;
use crate::progress::bar;

/// Sizes tried, smallest first.
const SIZES: [usize; 8] = [8, 12, 16, 20, 24, 32, 48, 64];
/// Codings tried for each size, each with the storage it suits, fewest bytes first.
const STORED: [(TableCoding, [Storage; 2]); 2] =
    [(TableCoding::Display, [Storage::Unorm8, Storage::Unorm10]), (TableCoding::Density, [Storage::F16, Storage::F32])];

/// The recipe with the fewest bytes whose certified maximum is at most `limit`.
///
/// The structured form is tried in all sizes and stores. A plain table of the same accuracy is always larger: it needs more
/// nodes, and its range ends.
pub(crate) fn smallest_under(film: &Look, process: &Process, limit: f64) -> Result<Recipe> {
    let measure = Measure::new(film, process)?;
    let samples: Samples = measure.samples(&onelight::lut::SamplingLaw::default(), onelight::WorkingSpace::Srgb)?;
    let progress = bar("choosing", SIZES.len() as u64);
    let mut best: Option<(usize, Recipe)> = None;
    let mut nearest = f64::INFINITY;
    for size in SIZES {
        for (coding, stored) in STORED {
            let too_large = |storage: Storage| best.is_some_and(|(least, _)| storage.bytes() * size.pow(3) >= least);
            let stored: Vec<Storage> = stored.into_iter().filter(|&storage| !too_large(storage)).collect();
            if stored.is_empty() {
                continue;
            }
            // Fitted once, then stored in each way.
            let recipe = Recipe { size, coding, ..Recipe::usual(Form::Structured) };
            let exact = Compiled::new(film, process, &recipe, None)?;
            let table = exact.table().context("a structured look has a table")?;
            for storage in stored {
                let compiled = exact.with_table(storage.stored(table)?);
                let quick = measure.certify(&samples, |rgb| compiled.apply(rgb), Search::SamplesOnly)?;
                nearest = nearest.min(quick.max_found);
                // An ascent only finds more.
                if quick.max_found > limit {
                    continue;
                }
                let found = measure.certify(&samples, |rgb| compiled.apply(rgb), Search::Ascent)?;
                let bytes = storage.bytes() * size.pow(3);
                if found.max_found <= limit && best.is_none_or(|(least, _)| bytes < least) {
                    best = Some((bytes, Recipe { storage, ..recipe }));
                }
            }
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    match best {
        Some((_, recipe)) => Ok(recipe),
        None => bail!(
            "--max-de {limit}: no table up to {0}^3 stays under it, the nearest has a maximum of {nearest:.3}",
            SIZES[SIZES.len() - 1]
        ),
    }
}
