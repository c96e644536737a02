//! What a report was made on and when: figures without that say little.

use std::time::{SystemTime, UNIX_EPOCH};
use std::{env, fs, thread};

use serde::Serialize;

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
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
        let arguments: Vec<String> = env::args().skip(1).collect();
        Self {
            processor: processor().unwrap_or_else(|| format!("unnamed ({})", env::consts::ARCH)),
            threads: threads(),
            vectors: vectors(),
            system: format!("{} {}", env::consts::OS, env::consts::ARCH),
            version: env!("CARGO_PKG_VERSION"),
            command: format!("cargo xtask {}", arguments.join(" ")),
            date: date(seconds),
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

/// `2026-02-03 14:05 UTC` of seconds since 1970: days to a date by counting from March, in years that repeat after 400.
fn date(seconds: u64) -> String {
    const DAYS_400: u64 = 146_097;
    // 0000-03-01 to 1970-01-01.
    let days = seconds / 86_400 + 719_468;
    let day_of_400 = days % DAYS_400;
    let year_of_400 = (day_of_400 - day_of_400 / 1460 + day_of_400 / 36_524 - day_of_400 / 146_096) / 365;
    let day_of_year = day_of_400 - (365 * year_of_400 + year_of_400 / 4 - year_of_400 / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = (month_from_march + 2) % 12 + 1;
    let year = days / DAYS_400 * 400 + year_of_400 + u64::from(month <= 2);
    let (hour, minute) = (seconds / 3600 % 24, seconds / 60 % 60);
    format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, expected) in [
            (0, "1970-01-01 00:00 UTC"),
            (951_782_399, "2000-02-28 23:59 UTC"),
            (951_782_400, "2000-02-29 00:00 UTC"),
            (951_868_800, "2000-03-01 00:00 UTC"),
            (1_735_689_599, "2024-12-31 23:59 UTC"),
            (4_107_542_400, "2100-03-01 00:00 UTC"),
        ] {
            assert_eq!(date(seconds), expected);
        }
    }
}
