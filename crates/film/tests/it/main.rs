//! Laws of the emulsion on random sheets and exposures, and an independent computation.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod inter_image;
mod properties;

use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;

/// The same inputs in every run; PROPTEST_CASES digs deeper, in new places each time.
pub(crate) fn cases(count: u32) -> ProptestConfig {
    let mut config = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        (config.cases, config.rng_seed) = (count, RngSeed::Fixed(0x6f6e_656c_6967_6874));
    }
    config
}
