use std::sync::atomic::{AtomicU64, Ordering};

/// How far a part of a measurement has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done: `timing`.
    pub part: &'static str,
    /// Steps done: 0 where the part begins, all of them where it ends.
    pub done: u64,
    /// All steps of the part.
    pub steps: u64,
}

/// Called at the beginning of a part, at every step, and at its end; from any thread.
pub type OnProgress<'a> = &'a (dyn Fn(Progress) + Sync);

/// The steps of one part; it ends with this.
pub(crate) struct Steps<'a> {
    part: &'static str,
    done: AtomicU64,
    steps: u64,
    tell: OnProgress<'a>,
}

impl<'a> Steps<'a> {
    pub(crate) fn new(part: &'static str, steps: u64, tell: OnProgress<'a>) -> Self {
        tell(Progress { part, done: 0, steps });
        Self { part, done: AtomicU64::new(0), steps, tell }
    }

    /// Counts one step; the last one is reported where the part ends.
    pub(crate) fn step(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if done < self.steps {
            (self.tell)(Progress { part: self.part, done, steps: self.steps });
        }
    }
}

impl Drop for Steps<'_> {
    fn drop(&mut self) {
        (self.tell)(Progress { part: self.part, done: self.steps, steps: self.steps });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn a_part_begins_steps_and_ends_once() {
        let seen = Mutex::new(Vec::new());
        let tell = |progress: Progress| seen.lock().unwrap().push(progress.done);
        let steps = Steps::new("a part", 3, &tell);
        (0..3).for_each(|_| steps.step());
        drop(steps);
        // Ended early: an error, say.
        drop(Steps::new("another", 2, &tell));
        assert_eq!(*seen.lock().unwrap(), [0, 1, 2, 3, 0, 2]);
    }
}
