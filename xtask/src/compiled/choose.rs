//! The smallest table that keeps a promise.

use anyhow::{Result, bail};
use onelight::lut::{Samples, Search, Storage};
use onelight::{Process, Reference, TableCoding};

use super::{Compiled, Form, Recipe};
use crate::certificate::Measure;
use crate::progress::bar;

/// Sizes tried, smallest first.
const SIZES: [usize; 8] = [8, 12, 16, 20, 24, 32, 48, 64];
/// Storage tried for each size, with the coding that suits it.
const STORED: [(Storage, TableCoding); 4] = [
    (Storage::Unorm8, TableCoding::Display),
    (Storage::Unorm10, TableCoding::Display),
    (Storage::F16, TableCoding::Density),
    (Storage::F32, TableCoding::Density),
];
/// What ascents find lies up to this much above the samples' largest: tables nearer to the limit are not followed up.
const ASCENT_MARGIN: f64 = 1.0;

/// The recipe with the fewest bytes whose certified maximum is at most `limit`.
///
/// The structured form is tried in all sizes and stores. A plain table of the same accuracy is always larger: it needs more
/// nodes, and its range ends.
pub(crate) fn smallest_under(film: &Reference, process: &Process, limit: f64) -> Result<Recipe> {
    let measure = Measure::new(film, process)?;
    let samples: Samples = measure.samples(&onelight::lut::Law::default(), onelight::WorkingSpace::Srgb)?;
    let progress = bar("choosing", SIZES.len() as u64);
    let mut best: Option<(usize, Recipe)> = None;
    let mut nearest = f64::INFINITY;
    for size in SIZES {
        let cheapest = STORED[0].0.bytes() * size.pow(3);
        if best.as_ref().is_some_and(|(bytes, _)| cheapest >= *bytes) {
            break;
        }
        for (storage, coding) in STORED {
            let bytes = storage.bytes() * size.pow(3);
            if best.as_ref().is_some_and(|(least, _)| bytes >= *least) {
                continue;
            }
            let recipe = Recipe { size, storage, coding, ..Recipe::usual(Form::Structured) };
            let compiled = Compiled::new(film, process, &recipe, None)?;
            let quick = measure.certify(&samples, |rgb| compiled.apply(rgb), Search::SamplesOnly)?;
            nearest = nearest.min(quick.max_found);
            if quick.max_found * ASCENT_MARGIN > limit {
                continue;
            }
            let found = measure.certify(&samples, |rgb| compiled.apply(rgb), Search::Ascent)?;
            if found.max_found <= limit {
                best = Some((bytes, recipe));
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
