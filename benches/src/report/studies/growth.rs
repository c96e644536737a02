//! How time grows with the picture, the table, the exponentials and the threads.

use std::time::Instant;

use onelight::Nodes;
use onelight::lut::{Channels, Interpolation, Lut3d, PixelsMut, Storage};
use serde::Serialize;

use super::effects::{EffectRow, effects};
use super::picture_effects::{PictureEffectRow, picture_effects};
use crate::error::{Error, Result};
use crate::progress::{OnProgress, Steps};
use crate::report::forms::{Kind, Made};
use crate::report::frame::Frame;
use crate::report::machine::threads;
use crate::report::measure::{Look, Prepared};
use crate::report::scope::Scope;
use crate::report::stopwatch::{Pass, interleaved, mapping, pool};

/// One quantity over another, for one form.
#[derive(Debug, Clone, Serialize)]
pub(in crate::report) struct Measured {
    pub(in crate::report) kind: Kind,
    pub(in crate::report) name: String,
    pub(in crate::report) points: Vec<(f64, f64)>,
}

/// How cost grows, of the first look.
#[derive(Debug, Serialize)]
pub(in crate::report) struct Growth {
    /// Megapixels, and milliseconds for all of them on one thread.
    pub(in crate::report) picture: Vec<Measured>,
    /// Bytes of the two buffers that strips of a picture go through.
    pub(in crate::report) buffers: usize,
    /// Nodes along a side of the table, and nanoseconds for each pixel.
    pub(in crate::report) table: Vec<Measured>,
    /// Exponentials for each pixel, and nanoseconds for each pixel.
    pub(in crate::report) nodes: Vec<Measured>,
    /// The usual forms with and without what films do beyond curves and dyes.
    pub(in crate::report) effects: Vec<EffectRow>,
    /// Sharpness, halation and grain.
    pub(in crate::report) picture_effects: Vec<PictureEffectRow>,
    /// Threads, and megapixels for each second.
    pub(in crate::report) threads: Vec<Measured>,
}

/// Seconds that one form may take for one size of picture, all its rounds together.
const LONGEST: f64 = 10.0;
/// Rows of the frame in a strip.
const STRIP_ROWS: usize = 64;

pub(in crate::report) fn growth(
    prepared: &Prepared,
    look: &Look,
    frame: &Frame,
    scope: Scope,
    progress: OnProgress<'_>,
) -> Result<Growth> {
    let forms = usual(&prepared.made);
    let progress = Steps::new("growth", 5, progress);
    let buffers = 2 * frame.strip(0, STRIP_ROWS)?.size().iter().product::<usize>() * 3 * size_of::<f32>();
    let picture = picture(&forms, frame, scope)?;
    progress.step();
    let table = table(&forms, frame, scope)?;
    progress.step();
    let effects = effects(prepared, frame, scope)?;
    progress.step();
    let picture_effects = picture_effects(frame, scope)?;
    progress.step();
    let threads = over_threads(&forms, frame, scope)?;
    progress.step();
    Ok(Growth { picture, buffers, table, nodes: over_nodes(look), effects, picture_effects, threads })
}

/// One form of each kind: of tables the largest of up to 33 nodes, of sums of exponentials the usual one.
fn usual(made: &[Made]) -> Vec<&Made> {
    let table = |kind| {
        let all = made.iter().filter(move |m| m.kind == kind && m.storage == Some(Storage::F32));
        all.filter(|m| m.size.is_some_and(|size| size <= 33)).max_by_key(|m| m.size)
    };
    let usual = match Nodes::USUAL_COUNTS {
        Nodes::Counts { projection, .. } => projection,
        _ => 0,
    };
    let direct = made.iter().find(|m| m.nodes.is_some_and(|[_, projection]| projection == usual));
    [table(Kind::Plain), table(Kind::Structured), direct].into_iter().flatten().collect()
}

fn named(made: &Made, points: Vec<(f64, f64)>) -> Measured {
    Measured { kind: made.kind, name: format!("{} {}", made.kind.name(), made.detail), points }
}

/// Pictures of all sizes, in strips through one pair of buffers.
fn picture(forms: &[&Made], frame: &Frame, scope: Scope) -> Result<Vec<Measured>> {
    let megapixels: &[f64] = match scope {
        Scope::Full => &[0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0],
        Scope::Quick => &[0.1, 0.3],
    };
    let pool = pool(1)?;
    let [width, height] = frame.size();
    let rows_of_strip = STRIP_ROWS.min(height);
    let mut buffer = vec![1.0; width * rows_of_strip * 3];
    let mut measured: Vec<Vec<(f64, f64)>> = vec![Vec::new(); forms.len()];
    for &megapixels in megapixels {
        let rows = ((1e6 * megapixels) as usize).div_ceil(width);
        for (form, points) in forms.iter().zip(&mut measured) {
            let pixels = rows as f64 * width as f64;
            let foreseen = points.last().map_or(0.0, |(before, ms)| pixels / 1e6 / before * ms / 1e3);
            if foreseen > LONGEST {
                continue;
            }
            let (begun, mut best) = (Instant::now(), f64::INFINITY);
            for _ in 0..scope.rounds() {
                if begun.elapsed().as_secs_f64() + foreseen > LONGEST {
                    break;
                }
                let start = Instant::now();
                pool.install(|| -> Result<()> {
                    for first in (0..rows).step_by(rows_of_strip) {
                        let strip = frame.strip(first, rows_of_strip.min(rows - first))?;
                        form.form.map(&strip, &mut PixelsMut::new(&mut buffer, Channels::Rgb, strip.size())?)?;
                    }
                    Ok(())
                })?;
                best = best.min(start.elapsed().as_secs_f64());
            }
            points.push((pixels / 1e6, 1e3 * best));
        }
    }
    Ok(forms.iter().zip(measured).map(|(form, points)| named(form, points)).collect())
}

/// Tables of all sizes: the same look, resampled, as only its time counts.
fn table(forms: &[&Made], frame: &Frame, scope: Scope) -> Result<Vec<Measured>> {
    let sizes: &[usize] = match scope {
        Scope::Full => &[9, 17, 33, 65, 129],
        Scope::Quick => &[9, 17],
    };
    let mut tables = Vec::new();
    for made in forms {
        let Some(baked) = made.form.table() else { continue };
        for &size in sizes {
            tables.push((*made, size, made.form.with_table(resampled(baked, size)?)));
        }
    }
    let passes: Vec<Pass> = tables.iter().map(|(_, _, form)| mapping(form, frame)).collect();
    let times = interleaved(&passes, frame, 1, scope.rounds(), || {})?;
    let mut measured: Vec<Measured> = Vec::new();
    for ((made, size, _), time) in tables.iter().zip(times) {
        let point = (*size as f64, time.ns);
        match measured.last_mut().filter(|last| last.kind == made.kind) {
            Some(last) => last.points.push(point),
            None => measured.push(Measured {
                kind: made.kind,
                name: format!("{} f32", made.kind.name()),
                points: vec![point],
            }),
        }
    }
    Ok(measured)
}

fn resampled(table: &Lut3d, size: usize) -> Result<Lut3d> {
    let places = Lut3d::identity(size)?;
    let entries = places.entries().map(|place| table.apply(place, Interpolation::Trilinear)).collect();
    Ok(Lut3d::new(size, entries)?)
}

/// The direct forms of the table, by the exponentials that a pixel takes.
fn over_nodes(look: &Look) -> Vec<Measured> {
    let direct = look.rows.iter().filter(|row| row.kind == Kind::Direct);
    let mut points: Vec<(f64, f64)> =
        direct.filter_map(|row| Some((row.nodes?.iter().sum::<usize>() as f64, row.time.ns))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    vec![Measured { kind: Kind::Direct, name: Kind::Direct.name().to_owned(), points }]
}

fn over_threads(forms: &[&Made], frame: &Frame, scope: Scope) -> Result<Vec<Measured>> {
    let passes: Vec<Pass> = forms.iter().map(|made| mapping(&made.form, frame)).collect();
    let mut measured: Vec<Measured> = forms.iter().map(|made| named(made, Vec::new())).collect();
    let all = threads();
    // Every count on a small machine, doubling ones on a large one.
    let counts = (1..=all).filter(|n| all <= 8 || n.is_power_of_two() || *n == all);
    for count in counts {
        let times = interleaved(&passes, frame, count, scope.rounds(), || {})
            .map_err(|error| Error::of(&format!("timing on {count} threads"), error))?;
        for (measured, time) in measured.iter_mut().zip(times) {
            measured.points.push((count as f64, 1e3 / time.ns));
        }
    }
    Ok(measured)
}
