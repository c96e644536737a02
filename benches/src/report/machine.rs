//! What a report was made on and when: figures without that say little.

use std::{env, fs, thread};

use serde::Serialize;

use crate::calendar::{date_and_time, now};

/// The machine, the program and the day.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Machine {
    /// The processor's own name.
    pub(super) processor: String,
    /// Threads that the system offers.
    pub(super) threads: usize,
    /// The widest vector unit that the processor has.
    pub(super) vectors: &'static str,
    pub(super) system: String,
    pub(super) version: &'static str,
    /// How the program was started.
    pub(super) command: String,
    /// Day and time, UTC.
    pub(super) date: String,
}

impl Machine {
    pub(super) fn here() -> Self {
        let arguments: Vec<String> = env::args().skip(1).collect();
        Self {
            processor: processor().unwrap_or_else(|| format!("unnamed ({})", env::consts::ARCH)),
            threads: threads(),
            vectors: vectors(),
            system: format!("{} {}", env::consts::OS, env::consts::ARCH),
            version: env!("CARGO_PKG_VERSION"),
            command: format!("cargo xtask {}", arguments.join(" ")),
            date: date_and_time(now()),
        }
    }
}

/// Threads that the system offers.
pub(super) fn threads() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

fn processor() -> Option<String> {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let named = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let name = named.map(|(_, name)| name.trim().to_owned());
    name.or_else(|| env::var("PROCESSOR_IDENTIFIER").ok()).filter(|name| !name.is_empty())
}

#[cfg(target_arch = "x86_64")]
fn vectors() -> &'static str {
    match (is_x86_feature_detected!("avx512f"), is_x86_feature_detected!("avx2")) {
        (true, _) => "AVX-512",
        (false, true) => "AVX2",
        (false, false) => "SSE2",
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn vectors() -> &'static str {
    if cfg!(target_arch = "aarch64") { "NEON" } else { "unknown" }
}
