//! Laws of whole looks on random films, settings and light. What was found by them is kept as a test with a name.

mod calibration;
mod description;
mod light;
mod settings;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The same inputs in every run; PROPTEST_CASES digs deeper, with new inputs each time.
fn cases(count: u32) -> ProptestConfig {
    let mut config = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_none() {
        (config.cases, config.rng_seed) = (count, RngSeed::Fixed(0x6f6e_656c_6967_6874));
    }
    config
}
