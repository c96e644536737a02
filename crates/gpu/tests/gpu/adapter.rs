//! The device that the tests share.

use std::io::{self, Write as _};
use std::sync::OnceLock;

use onelight_gpu::{Headless, HeadlessSettings};

/// The device, or None where there is none and none is demanded.
pub(crate) fn gpu() -> Option<&'static Headless> {
    static GPU: OnceLock<Option<Headless>> = OnceLock::new();
    let open_and_tell = || {
        let gpu = open();
        let found = gpu.as_ref().map_or("tests on a GPU were skipped: found no adapter".to_owned(), Headless::name);
        // Not by a macro, whose output a test that passes keeps to itself.
        let mut stderr = io::stderr();
        writeln!(stderr, "{found}").unwrap();
        gpu
    };
    GPU.get_or_init(open_and_tell).as_ref()
}

fn open() -> Option<Headless> {
    let demanded = std::env::var("ONELIGHT_REQUIRE_GPU").ok();
    let adapter = demanded.as_deref().filter(|word| *word != "1").unwrap_or_default();
    match Headless::open(&HeadlessSettings { adapter, ..Default::default() }) {
        Ok(gpu) => Some(gpu),
        Err(error) if error.is_no_adapter() && demanded.is_none() => None,
        Err(error) => panic!("{error}"),
    }
}

/// Another device on the same adapter, whose counters no other test moves.
pub(crate) fn another() -> Option<Headless> {
    gpu().and_then(|_| open())
}
