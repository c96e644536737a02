//! How far a job is: on a terminal as a bar, elsewhere as a line now and then.

use std::fmt;
use std::io::{self, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::outcome::Outcome;

/// How many frames have been developed, were there already, and have failed.
#[derive(Debug)]
pub(super) struct JobProgress {
    total: usize,
    pub(super) developed: AtomicUsize,
    pub(super) already_done: AtomicUsize,
    pub(super) failed: AtomicUsize,
    start: Instant,
}

impl JobProgress {
    pub(super) fn new(total: usize) -> Self {
        let [developed, already_done, failed] = Default::default();
        Self { total, developed, already_done, failed, start: Instant::now() }
    }

    pub(super) fn add(&self, outcome: &Outcome) {
        let counter = match outcome {
            Outcome::Developed(_) => &self.developed,
            Outcome::AlreadyDone => &self.already_done,
            Outcome::Failed(_) => &self.failed,
        };
        counter.fetch_add(1, Ordering::Relaxed);
    }

    fn done(&self) -> usize {
        [&self.developed, &self.already_done, &self.failed].map(|counter| counter.load(Ordering::Relaxed)).iter().sum()
    }

    /// What is said where the job is stopped.
    pub(super) fn when_stopped(&self) -> String {
        format!("stopped: {self}; the same command goes on from here")
    }
}

/// `37 of 100 frames, 4.1 frames/s, 16 s left, 1 failed`
impl fmt::Display for JobProgress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (done, developed) = (self.done(), self.developed.load(Ordering::Relaxed));
        write!(f, "{done} of {} frames", self.total)?;
        if developed > 0 {
            let each = self.start.elapsed() / u32::try_from(developed).unwrap_or(u32::MAX);
            write!(f, ", {}", rate(each))?;
            let left = u32::try_from(self.total - done).unwrap_or(u32::MAX);
            if left > 0 {
                write!(f, ", {} left", duration(each.saturating_mul(left)))?;
            }
        }
        match self.failed.load(Ordering::Relaxed) {
            0 => Ok(()),
            failed => write!(f, ", {failed} failed"),
        }
    }
}

/// `4.1 frames/s`, or `12.5 s/frame` where that is slow.
pub(super) fn rate(each: Duration) -> String {
    let seconds = each.as_secs_f64().max(1e-9);
    if seconds < 1.0 { format!("{:.1} frames/s", seconds.recip()) } else { format!("{seconds:.1} s/frame") }
}

/// `16 s`, `3 min 20 s`, `2 h 05 min`.
fn duration(time: Duration) -> String {
    let seconds = time.as_secs_f64().round() as u64;
    match seconds {
        0..60 => format!("{seconds} s"),
        60..3600 => format!("{} min {:02} s", seconds / 60, seconds % 60),
        _ => format!("{} h {:02} min", seconds / 3600, seconds / 60 % 60),
    }
}

/// How often a line is written where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Shows a [`JobProgress`] on the standard error.
pub(super) struct Display {
    pub(super) bar: ProgressBar,
    last_line: Instant,
}

impl Display {
    pub(super) fn new(total: usize) -> Self {
        let style = ProgressStyle::with_template("developing   [{bar:40}] {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::new(total as u64).with_style(style.progress_chars("=> "));
        Self { bar, last_line: Instant::now() }
    }

    /// Shows the job after a frame has come to its end.
    pub(super) fn show(&mut self, progress: &JobProgress, outcome: &Outcome) {
        if let Outcome::Failed(why) = outcome {
            self.line(&format!("failed: {why}"));
        }
        self.bar.set_message(progress.to_string());
        self.bar.set_position(progress.done() as u64);
        if self.bar.is_hidden() && self.last_line.elapsed() >= LINE_EVERY {
            self.line(&progress.to_string());
            self.last_line = Instant::now();
        }
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn line(&self, text: &str) {
        // Where this cannot be written, the frames are developed all the same.
        self.bar.suspend(|| {
            let _ = writeln!(io::stderr(), "{text}");
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_times_are_shown_in_units_of_their_size() {
        for (seconds, expected) in
            [(0.2, "0 s"), (59.4, "59 s"), (59.6, "1 min 00 s"), (200.0, "3 min 20 s"), (7530.0, "2 h 05 min")]
        {
            assert_eq!(duration(Duration::from_secs_f64(seconds)), expected);
        }
        assert_eq!(rate(Duration::from_millis(250)), "4.0 frames/s");
        assert_eq!(rate(Duration::from_millis(12_500)), "12.5 s/frame");
        assert!(rate(Duration::ZERO).ends_with("frames/s"));
    }

    /// Frames that were there already say nothing of how long the others take.
    #[test]
    fn what_is_left_is_reckoned_from_developed_frames() {
        let progress = JobProgress { start: Instant::now() - Duration::from_secs(10), ..JobProgress::new(100) };
        progress.already_done.store(50, Ordering::Relaxed);
        assert_eq!(progress.to_string(), "50 of 100 frames");
        progress.developed.store(5, Ordering::Relaxed);
        progress.failed.store(1, Ordering::Relaxed);
        assert_eq!(progress.to_string(), "56 of 100 frames, 2.0 s/frame, 1 min 28 s left, 1 failed");
        progress.developed.store(49, Ordering::Relaxed);
        assert!(!progress.to_string().contains("left"), "{progress}");
    }
}
