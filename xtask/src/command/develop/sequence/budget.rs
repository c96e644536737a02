//! Memory that frames beside each other share.

use std::str::FromStr;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use anyhow::Result;
use onelight_picture::{PictureReader, PngBits, TiffBits};

use super::super::job::Settings;
use super::super::output::Target;

/// How much memory frames may take together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Memory {
    bytes: u64,
}

impl Default for Memory {
    /// 1 GiB: a dozen 4K frames. A fixed figure, as what a machine has free is not what a farm's scheduler grants.
    fn default() -> Self {
        Self { bytes: 1 << 30 }
    }
}

impl Memory {
    pub(crate) fn bytes(self) -> u64 {
        self.bytes
    }
}

impl FromStr for Memory {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse::<f64>() {
            Ok(gib) if gib > 0.0 && gib <= 1_048_576.0 => Ok(Self { bytes: (gib * (1_u64 << 30) as f64) as u64 }),
            _ => Err("expected GiB above 0, such as 0.5 or 8".to_owned()),
        }
    }
}

/// What developing a picture takes, at most: three bands, if it has so many, and what reader, meter and writer hold
/// beside.
pub(super) fn needed(picture: &PictureReader<'_>, target: Target) -> u64 {
    let memory = picture.memory();
    let description = picture.description();
    let samples = description.channels.count() as u64;
    let bands = description.pixels().div_ceil(memory.band_pixels.max(1)).min(3);
    let written = match target {
        Target::Png(PngBits::Eight, _) | Target::Tiff(TiffBits::Eight, _) => samples,
        Target::Png(PngBits::Sixteen, _) | Target::Tiff(TiffBits::Sixteen, _) => 2 * samples,
        Target::Tiff(TiffBits::Float, _) => 4 * samples,
        // Held whole: see below.
        Target::Jpeg(..) => 0,
        // As rows, as blocks, and packed.
        Target::Exr => 3 * 4 * samples,
    };
    // The meter keeps a logarithm for each pixel.
    let for_each_pixel = bands * 4 * samples + 8 + written;
    let whole = if matches!(target, Target::Jpeg(..)) { 3 * description.pixels() } else { 0 };
    memory.band_pixels.saturating_mul(for_each_pixel).saturating_add(memory.bytes_beside).saturating_add(whole)
}

/// What sharpness, halation and grain take beside.
///
/// # Errors
/// If the picture cannot be that large or small on the film.
pub(super) fn needed_by_effects(picture: &PictureReader<'_>, settings: &Settings, number: u32) -> Result<u64> {
    let Some(effects) = settings.film.effects() else { return Ok(0) };
    let frame = settings.on_film.frame(effects, picture.description(), number)?;
    Ok(effects.bytes(&frame, picture.memory().band_pixels))
}

/// Lets frames begin as long as there is room, and a frame that is larger than all of it alone.
#[derive(Debug)]
pub(super) struct Budget {
    most: u64,
    taken: Mutex<Taken>,
    changed: Condvar,
    /// Held by who waits for room, so that a small frame does not go before a large one for ever.
    turn: Mutex<()>,
}

#[derive(Debug, Default)]
struct Taken {
    bytes: u64,
    frames: usize,
}

/// Room for one frame until it is dropped.
#[derive(Debug)]
pub(super) struct Room<'a> {
    budget: &'a Budget,
    bytes: u64,
}

impl Budget {
    pub(super) fn new(memory: Memory) -> Self {
        Self { most: memory.bytes, taken: Mutex::default(), changed: Condvar::new(), turn: Mutex::new(()) }
    }

    /// Waits until `bytes` fit beside what others have taken.
    pub(super) fn take(&self, bytes: u64) -> Room<'_> {
        let turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        let full = |taken: &mut Taken| taken.frames > 0 && taken.bytes.saturating_add(bytes) > self.most;
        let mut taken = self.changed.wait_while(self.taken(), full).unwrap_or_else(PoisonError::into_inner);
        taken.frames += 1;
        taken.bytes = taken.bytes.saturating_add(bytes);
        drop((taken, turn));
        Room { budget: self, bytes }
    }

    fn taken(&self) -> MutexGuard<'_, Taken> {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Room<'_> {
    fn drop(&mut self) {
        let mut taken = self.budget.taken();
        taken.frames -= 1;
        taken.bytes = if taken.frames == 0 { 0 } else { taken.bytes.saturating_sub(self.bytes) };
        drop(taken);
        self.budget.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;

    #[test]
    fn frames_beside_each_other_stay_within_the_budget() {
        let budget = Budget::new(Memory { bytes: 10 });
        let (held, running, most_held, most_running) =
            (AtomicU64::new(0), AtomicU64::new(0), AtomicU64::new(0), AtomicU64::new(0));
        let (small, large) = ([3, 4, 1, 0, 10, 5], [11, u64::MAX]);
        std::thread::scope(|scope| {
            for bytes in small.into_iter().chain(large).cycle().take(80) {
                let (budget, held, running) = (&budget, &held, &running);
                let (most_held, most_running) = (&most_held, &most_running);
                scope.spawn(move || {
                    let _room = budget.take(bytes);
                    let beside = running.fetch_add(1, Ordering::SeqCst);
                    if bytes > 10 {
                        assert_eq!(beside, 0, "a frame over the budget runs alone");
                    } else {
                        most_held.fetch_max(held.fetch_add(bytes, Ordering::SeqCst) + bytes, Ordering::SeqCst);
                    }
                    most_running.fetch_max(beside + 1, Ordering::SeqCst);
                    std::thread::sleep(std::time::Duration::from_millis(1));
                    if bytes <= 10 {
                        held.fetch_sub(bytes, Ordering::SeqCst);
                    }
                    running.fetch_sub(1, Ordering::SeqCst);
                });
            }
        });
        assert!(most_held.into_inner() <= 10);
        assert!(most_running.into_inner() > 1, "frames run beside each other");
        let left = budget.taken();
        assert_eq!((left.bytes, left.frames), (0, 0));
    }

    #[test]
    fn memory_is_given_in_gib() {
        assert_eq!("0.5".parse(), Ok(Memory { bytes: 1 << 29 }));
        for text in ["", "0", "-1", "NaN", "inf", "1e9", "1G"] {
            assert!(text.parse::<Memory>().unwrap_err().contains("GiB"), "{text}");
        }
    }
}
