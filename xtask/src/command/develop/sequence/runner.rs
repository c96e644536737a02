//! Many frames beside each other: one bad one does not keep the others.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
    mpsc,
};
use std::thread;

use anyhow::Result;
use indicatif::ProgressBar;

use super::super::job::{Order, Settings, develop_picture, open_input};
use super::super::paths::same_file;
use super::budget::{Budget, needed, needed_by_effects};
use super::digest::{Recipe, is_done};
use super::outcome::Outcome;
use super::plan::Frame;
use super::progress::JobProgress;

/// Develops `frames`, as many at once as `budget` and `at_once` allow; what became of each, in their order. `done` hears
/// of each as soon as it is known.
pub(super) fn develop_frames(
    settings: &Settings,
    recipe: &Recipe,
    frames: &[Frame],
    budget: &Budget,
    at_once: usize,
    progress: &Arc<JobProgress>,
    mut done: impl FnMut(&Outcome),
) -> Vec<Outcome> {
    let next = AtomicUsize::new(0);
    let mut outcomes: Vec<Option<Outcome>> = frames.iter().map(|_| None).collect();
    let (results, received) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..at_once {
            // Threads of their own, as those of the pool would take up whole frames while they wait for parts of one.
            let (results, next) = (results.clone(), &next);
            scope.spawn(move || {
                while let Some((index, frame)) = take(next, frames) {
                    let outcome = develop_frame(settings, recipe, frame, budget);
                    progress.add(&outcome);
                    let _ = results.send((index, outcome));
                }
            });
        }
        drop(results);
        for (index, outcome) in received {
            done(&outcome);
            if let Some(place) = outcomes.get_mut(index) {
                *place = Some(outcome);
            }
        }
    });
    outcomes.into_iter().flatten().collect()
}

fn take<'a>(next: &AtomicUsize, frames: &'a [Frame]) -> Option<(usize, &'a Frame)> {
    let index = next.fetch_add(1, Ordering::Relaxed);
    frames.get(index).map(|frame| (index, frame))
}

fn develop_frame(settings: &Settings, recipe: &Recipe, frame: &Frame, budget: &Budget) -> Outcome {
    let attempt = || -> Result<Outcome> {
        // Before the file is read: if it changes meanwhile, the next run sees it.
        let digest = recipe.digest(frame);
        if digest.as_ref().is_ok_and(|digest| is_done(&frame.output, digest)) {
            return Ok(Outcome::AlreadyDone);
        }
        let picture = open_input(settings, &frame.input)?;
        let bytes =
            needed(&picture, settings.target).saturating_add(needed_by_effects(&picture, settings, frame.number)?);
        let digest = digest.map_err(|error| anyhow::anyhow!("{}: cannot be read: {error}", frame.input.display()))?;
        if same_file(&frame.input, &frame.output) {
            anyhow::bail!("{}: the output would replace the picture it is made from", frame.output.display());
        }
        let _room = budget.take(bytes);
        let order = Order { input: &frame.input, output: &frame.output, number: frame.number, digest: Some(&digest) };
        develop_picture(settings, &order, &ProgressBar::hidden(), |_, _| {}).map(Outcome::Developed)
    };
    match catch_unwind(AssertUnwindSafe(attempt)) {
        Ok(Ok(outcome)) => outcome,
        Ok(Err(error)) => Outcome::Failed(format!("{error:#}")),
        Err(_) => Outcome::Failed(format!(
            "{}: the program gave up on this frame, which is its own mistake",
            frame.input.display()
        )),
    }
}
