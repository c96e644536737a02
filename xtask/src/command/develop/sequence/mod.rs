//! Many pictures in one run: a job that can be stopped, killed, shared out, and run again.

mod budget;
mod digest;
mod numbers;
mod outcome;
mod pattern;
mod plan;
mod progress;
mod runner;
mod summary;

use std::sync::Arc;

use anyhow::{Result, bail};

pub(crate) use self::budget::Memory;
pub(super) use self::numbers::{FrameNumbers, Shard};
pub(super) use self::plan::{Plan, plan};
pub(super) use self::summary::Summary;
use self::{
    budget::Budget,
    digest::Recipe,
    outcome::Outcome,
    progress::{Display, JobProgress},
    runner::develop_frames,
};
use super::exposure::Exposure;
use super::job::Settings;
use crate::progress::Clock;
use crate::{Report, atomic_file};

/// Refuses to expose each frame of a shot by itself.
///
/// # Errors
/// One sentence that names `--ev` and the way out, if the frames of a numbered shot would each get an exposure of their own.
pub(super) fn check_exposure(plan: &Plan, exposure: Exposure) -> Result<()> {
    match plan.frames.first() {
        Some(frame) if plan.numbered && exposure == Exposure::Auto => bail!(
            "--ev auto would expose each frame by itself, so that the shot flickers, expected stops for all of them (for \
             {} alone --ev auto shows its own)",
            frame.input.display()
        ),
        _ => Ok(()),
    }
}

/// Develops the pictures of a plan. Where some fail, the rest go on, and the report is printed before the error.
///
/// # Errors
/// A look that cannot be compiled; how many frames failed.
pub(super) fn run(
    settings: &Settings,
    plan: Plan,
    memory: Memory,
    mut clock: Clock,
    mut summary: Summary,
) -> Result<Report> {
    let Plan { frames, notes, .. } = plan;
    summary.notes.extend(notes);
    let recipe = clock.time("compile", || Recipe::new(settings))?;
    atomic_file::remove_leftovers(frames.iter().map(|frame| frame.output.as_path()));
    let at_once = rayon::current_num_threads().min(frames.len());
    let progress = Arc::new(JobProgress::new(frames.len()));
    let mut display = Display::new(frames.len());
    atomic_file::say_when_stopped({
        let (progress, bar) = (Arc::clone(&progress), display.bar.clone());
        move || {
            bar.finish_and_clear();
            progress.when_stopped()
        }
    });
    let outcomes = clock.time("develop", || {
        let budget = Budget::new(memory);
        develop_frames(settings, &recipe, &frames, &budget, at_once, &progress, |outcome| {
            display.show(&progress, outcome);
        })
    });
    display.finish();
    let failed = outcomes.iter().filter(|outcome| matches!(outcome, Outcome::Failed(_))).count();
    let report = summary.report(&settings.look.process, &frames, &outcomes, &clock);
    if failed > 0 {
        crate::finish::print(&report)?;
        bail!("{failed} of {} frames were not developed", frames.len());
    }
    Ok(report)
}
