//! The smallest table that keeps a promise.

use onelight_lut::{SamplingLaw, Search, Storage};

use super::form::Baked;
#[cfg(feature = "formats")]
use super::form::BakedForm;
use super::recipe::{Form, Recipe};
use crate::certify::Certifier;
use crate::error::{Error, ErrorKind};
use crate::look::Look;
use crate::structured::TableCoding;
use crate::word::WorkingSpace;

/// Nodes along each side that are tried, fewest first.
const SIZES: [usize; 8] = [8, 12, 16, 20, 24, 32, 48, 64];
/// Codings tried for each size, each with the storage it suits, fewest bytes first.
const STORED: [(TableCoding, [Storage; 2]); 2] =
    [(TableCoding::Display, [Storage::Unorm8, Storage::Unorm10]), (TableCoding::Density, [Storage::F16, Storage::F32])];

/// The recipe with the fewest bytes whose certified largest difference from the look is at most `limit` (CIEDE2000).
///
/// The structured form is tried in all sizes and stores: half a minute. A plain table of the same accuracy is always larger:
/// it needs more nodes, and its range ends. `progress` is called with the sizes tried so far and their number.
///
/// ```no_run
/// let look = onelight::Process::default().look()?;
/// let recipe = onelight::baked::smallest_under(&look, 0.5, |done, all| println!("{done} of {all}"))?;
/// assert!(recipe.size < 32);
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// # Errors
/// If no table up to 64^3 keeps the limit, or the look has no film curves.
pub fn smallest_under(look: &Look, limit: f64, progress: impl Fn(usize, usize)) -> Result<Recipe, Error> {
    let certifier = Certifier::new(look)?;
    let samples = certifier.samples(&SamplingLaw::default(), WorkingSpace::Srgb)?;
    let mut best: Option<(usize, Recipe)> = None;
    let mut nearest = f64::INFINITY;
    for (tried, size) in SIZES.into_iter().enumerate() {
        for (coding, stored) in STORED {
            let too_large = |storage: Storage| best.is_some_and(|(least, _)| storage.bytes() * size.pow(3) >= least);
            let stored: Vec<Storage> = stored.into_iter().filter(|&storage| !too_large(storage)).collect();
            if stored.is_empty() {
                continue;
            }
            // Fitted once, then stored in each way.
            let recipe = Recipe { size, coding, ..Recipe::of(Form::Structured) };
            let exact = Baked::new(look, &recipe, None)?;
            for storage in stored {
                let baked = exact.stored(storage)?;
                let apply = as_written(&baked)?;
                let quick = certifier.certify(&samples, &apply, Search::SamplesOnly)?;
                nearest = nearest.min(quick.max_found);
                // An ascent only finds more.
                if quick.max_found > limit {
                    continue;
                }
                let found = certifier.certify(&samples, &apply, Search::Ascent)?;
                let bytes = storage.bytes() * size.pow(3);
                if found.max_found <= limit && best.is_none_or(|(least, _)| bytes < least) {
                    best = Some((bytes, Recipe { storage, ..recipe }));
                }
            }
        }
        progress(tried + 1, SIZES.len());
    }
    let expected = || {
        let largest = SIZES[SIZES.len() - 1];
        format!("a limit that a table of up to {largest}^3 keeps (the nearest had a maximum of {nearest:.3})")
    };
    best.map(|(_, recipe)| recipe).ok_or_else(|| {
        let what = "largest difference of a structured table".to_owned();
        ErrorKind::Setting { what, found: limit, expected: expected() }.into()
    })
}

/// From scene-linear to display-coded colours.
#[cfg(feature = "formats")]
type Map<'a> = Box<dyn Fn([f32; 3]) -> [f32; 3] + Sync + 'a>;

/// The table as the file has it that it is written to: a CLF holds coupled layers only nearly.
#[cfg(feature = "formats")]
fn as_written(baked: &Baked) -> Result<Map<'_>, Error> {
    match baked.form() {
        BakedForm::Structured(lut) if lut.parts().develop.coupling.is_some() => {
            let file = onelight_formats::ClfProcess::from_structured(lut)?;
            Ok(Box::new(move |rgb| file.apply(rgb)))
        }
        _ => Ok(Box::new(|rgb| baked.apply(rgb))),
    }
}

/// The table as it is: without files there is no other.
#[cfg(not(feature = "formats"))]
#[expect(clippy::unnecessary_wraps, reason = "the same call with and without files")]
fn as_written(baked: &Baked) -> Result<impl Fn([f32; 3]) -> [f32; 3] + Sync + '_, Error> {
    Ok(|rgb| baked.apply(rgb))
}
