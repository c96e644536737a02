//! What happens when a run is told to stop.

use std::{
    fs,
    io::{self, Write},
    sync::{Mutex, Once, PoisonError},
};

use super::temporary::unfinished;

/// Says what is to be said where the run is stopped: one sentence on the standard error.
///
/// `words` must not wait for a thread that writes a file.
pub(crate) fn last_words(words: impl Fn() -> String + Send + 'static) {
    *LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(words));
    watch();
}

type Words = Box<dyn Fn() -> String + Send>;

static LAST_WORDS: Mutex<Option<Words>> = Mutex::new(None);

/// Makes a signal to stop remove what is unfinished. Without it, files stay: nothing else is lost.
pub(super) fn watch() {
    static ONCE: Once = Once::new();
    ONCE.call_once(listen);
}

/// SIGHUP is left as it is, because `nohup` has it ignored.
#[cfg(unix)]
fn listen() {
    use signal_hook::{
        consts::{SIGINT, SIGTERM, SIGXFSZ},
        iterator::Signals,
    };
    // A limit on the size of files (`ulimit -f`) ends the program where its signal is not taken; a write then fails.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGXFSZ]) else { return };
    let wait = move || {
        if let Some(signal) = signals.forever().find(|signal| *signal != SIGXFSZ) {
            stop(SIGNALLED + signal);
        }
    };
    let _ = std::thread::Builder::new().name("signals".to_owned()).spawn(wait);
}

#[cfg(not(unix))]
fn listen() {
    // Ctrl-C, by the number it has elsewhere.
    let _ = ctrlc::set_handler(|| stop(SIGNALLED + 2));
}

/// What a shell adds to the number of the signal that ended a program.
const SIGNALLED: i32 = 128;

fn stop(status: i32) -> ! {
    // Kept locked, so that no file is made or named any more.
    let paths = unfinished();
    for path in paths.iter() {
        let _ = fs::remove_file(path);
    }
    if let Some(words) = LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner).as_ref() {
        let _ = writeln!(io::stderr(), "{}", words());
    }
    std::process::exit(status)
}
