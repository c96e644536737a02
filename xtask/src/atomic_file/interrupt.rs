//! What happens when a signal stops a run.

use std::{
    fs,
    io::{self, Write},
    sync::{Mutex, Once, PoisonError},
};

use super::unfinished::unfinished;

/// Writes `message` to the standard error, one sentence, where the run is stopped by a signal.
///
/// `message` must not wait for a thread that writes a file.
pub(crate) fn say_when_stopped(message: impl Fn() -> String + Send + 'static) {
    *MESSAGE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(message));
    watch();
}

type Message = Box<dyn Fn() -> String + Send>;

static MESSAGE: Mutex<Option<Message>> = Mutex::new(None);

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
    if let Some(message) = MESSAGE.lock().unwrap_or_else(PoisonError::into_inner).as_ref() {
        let _ = writeln!(io::stderr(), "{}", message());
    }
    std::process::exit(status)
}
