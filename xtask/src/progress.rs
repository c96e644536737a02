//! Progress bars and clocks.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `length` steps on the terminal; nothing where there is none.
pub(crate) fn bar(what: &'static str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:12} [{bar:40}] {percent:>3} %  {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style.progress_chars("=> ")).with_message(what)
}

/// A bar for each part of a measurement, one after the other.
#[cfg(feature = "measure")]
pub(crate) fn bars() -> impl Fn(onelight_benches::Progress) + Sync {
    use std::sync::{Mutex, PoisonError};

    use onelight_benches::Progress;

    let shown: Mutex<Option<ProgressBar>> = Mutex::new(None);
    move |Progress { part, done, steps }| {
        let mut shown = shown.lock().unwrap_or_else(PoisonError::into_inner);
        if done == steps {
            if let Some(bar) = shown.take() {
                bar.finish_and_clear();
            }
        } else {
            shown.get_or_insert_with(|| bar(part, steps)).set_position(done);
        }
    }
}

/// How long each part of a run took.
#[derive(Default)]
pub(crate) struct Clock {
    parts: Vec<(&'static str, Duration)>,
}

impl Clock {
    /// Runs and times a part; parts of one name add up.
    pub(crate) fn time<T>(&mut self, part: &'static str, run: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let value = run();
        self.add(part, start.elapsed());
        value
    }

    /// Adds time to a part.
    pub(crate) fn add(&mut self, part: &'static str, taken: Duration) {
        match self.parts.iter_mut().find(|(name, _)| *name == part) {
            Some((_, sum)) => *sum += taken,
            None => self.parts.push((part, taken)),
        }
    }

    /// `compile 0.03 s, bake 0.21 s, total 0.24 s`
    pub(crate) fn sentence(&self) -> String {
        let total: Duration = self.parts.iter().map(|(_, time)| *time).sum();
        let parts = self.parts.iter().copied().chain([("total", total)]);
        parts.map(|(part, time)| format!("{part} {:.2} s", time.as_secs_f64())).collect::<Vec<_>>().join(", ")
    }

    /// How long the parts of one name took.
    pub(crate) fn of(&self, part: &str) -> Duration {
        self.parts.iter().filter(|(name, _)| *name == part).map(|(_, time)| *time).sum()
    }

    /// The name of each part with the seconds that it took.
    pub(crate) fn json(&self) -> serde_json::Value {
        self.parts
            .iter()
            .map(|(part, time)| ((*part).to_owned(), serde_json::Value::from(time.as_secs_f64())))
            .collect()
    }
}
