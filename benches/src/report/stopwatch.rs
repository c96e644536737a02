//! Times of many things, taken in rounds, so that what disturbs the machine meets all alike.

use std::time::{Duration, Instant};

use onelight::lut::{Channels, PixelsMut};
use serde::Serialize;

use super::frame::Frame;
use crate::error::{Error, Result};
use crate::form::Form;

/// Time that one pass of one thing should take; cheaper things do more rows.
const PASS: Duration = Duration::from_millis(14);

/// Nanoseconds for each pixel.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Timing {
    /// The fastest round: what the machine can do undisturbed.
    pub(super) ns: f64,
    /// The median round: what it did here.
    pub(super) median_ns: f64,
}

impl Timing {
    fn of(mut rounds: Vec<f64>) -> Self {
        rounds.sort_by(f64::total_cmp);
        let ns = rounds.first().copied().unwrap_or(f64::NAN);
        Self { ns, median_ns: rounds.get(rounds.len() / 2).copied().unwrap_or(ns) }
    }
}

/// Something that turns rows of the frame into a buffer; says how many pixels it did.
pub(super) type Pass<'a> = Box<dyn Fn(usize, usize, &mut [f32]) -> Result<usize> + Sync + 'a>;

/// A form over rows of the frame.
pub(super) fn mapping<'a>(form: &'a Form, frame: &'a Frame) -> Pass<'a> {
    Box::new(move |first, every, buffer| {
        let from = frame.rows(first, every)?;
        let size = from.size();
        form.map(&from, &mut PixelsMut::new(buffer, Channels::Rgb, size)?)?;
        Ok(size[0] * size[1])
    })
}

/// The same rows copied: what no form can be faster than.
pub(super) fn copying(frame: &Frame) -> Pass<'_> {
    Box::new(move |first, every, buffer| {
        let [width, height] = frame.size();
        let rows = (first % every..height).step_by(every);
        let count = rows.len();
        for (to, y) in buffer.chunks_exact_mut(width * 3).zip(rows) {
            to.copy_from_slice(frame.row(y));
        }
        Ok(count * width)
    })
}

/// Times of every pass on the threads of `pool`, in the order given; `after_round` is called after each round.
pub(super) fn interleaved(
    passes: &[Pass],
    frame: &Frame,
    threads: usize,
    rounds: usize,
    after_round: impl Fn() + Sync,
) -> Result<Vec<Timing>> {
    let pool = pool(threads)?;
    let [width, height] = frame.size();
    // Not zeros: those pages would come into being while they are timed.
    let mut buffer = vec![1.0; width * height * 3];
    let mut timed = |pass: &Pass, first: usize, every: usize| -> Result<(f64, Duration)> {
        let buffer = &mut buffer;
        pool.install(|| {
            let start = Instant::now();
            let pixels = pass(first, every, buffer)?;
            let taken = start.elapsed();
            Ok((1e9 * taken.as_secs_f64() / pixels.max(1) as f64, taken))
        })
    };
    let mut every = Vec::new();
    for pass in passes {
        every.push(rows_apart(height, |every| Ok(timed(pass, 0, every)?.1))?);
    }
    let mut taken = vec![Vec::new(); passes.len()];
    for round in 0..rounds {
        for ((pass, &every), taken) in passes.iter().zip(&every).zip(&mut taken) {
            taken.push(timed(pass, round, every)?.0);
        }
        after_round();
    }
    Ok(taken.into_iter().map(Timing::of).collect())
}

/// A pool of so many threads.
pub(super) fn pool(threads: usize) -> Result<rayon::ThreadPool> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| Error::of("threads to measure on cannot be started", error))
}

/// How far apart rows lie so that a pass takes about [`PASS`]; tried from few rows to many.
fn rows_apart(height: usize, time: impl FnMut(usize) -> Result<Duration>) -> Result<usize> {
    const TRIES: usize = 3;
    let mut time = time;
    let mut every = height;
    loop {
        // The least of a few, or one interruption would leave it at a row.
        let mut taken = time(every)?;
        for _ in 1..TRIES {
            taken = taken.min(time(every)?);
        }
        let room = PASS.as_secs_f64() / taken.as_secs_f64().max(1e-7);
        if every == 1 || room < 2.0 {
            return Ok(every);
        }
        // A short first pass says little; nearer by a factor of eight at most.
        every = ((every as f64 / room.min(8.0)) as usize).max(1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_fill_a_pass() {
        let cost =
            |per_row: f64| move |every: usize| Ok(Duration::from_secs_f64(per_row * (2160.0 / every as f64).ceil()));
        assert_eq!(rows_apart(2160, cost(1e-6)).unwrap(), 1, "cheap: the whole frame");
        assert_eq!(rows_apart(2160, cost(1.0)).unwrap(), 2160, "dear: one row");
        let every = rows_apart(2160, cost(1e-4)).unwrap();
        assert!((10..40).contains(&every), "{every}");
        let mut passes = 0;
        let interrupted = |every: usize| {
            passes += 1;
            Ok(if passes % 3 == 1 { Duration::from_secs(1) } else { cost(1e-6)(every)? })
        };
        assert_eq!(rows_apart(2160, interrupted).unwrap(), 1, "an interruption is not its cost");
    }

    #[test]
    fn the_fastest_and_the_middle() {
        let timing = Timing::of(vec![3.0, 1.0, 9.0]);
        assert_eq!((timing.ns, timing.median_ns), (1.0, 3.0));
    }
}
