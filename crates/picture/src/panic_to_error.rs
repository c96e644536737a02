//! Catching the panics of decoders that were not written for damaged files.

use std::{
    cell::Cell,
    panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook},
    sync::Once,
};

use crate::error::{Error, Kind};

thread_local! {
    /// Whether a decoder is at work on this thread, whose panics are errors.
    static DECODING: Cell<bool> = const { Cell::new(false) };
}

/// Runs `decode`; a panic in it becomes an error.
pub(crate) fn panic_to_error<T>(decode: impl FnOnce() -> T) -> Result<T, Error> {
    let before = DECODING.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(decode));
    DECODING.set(before);
    outcome.map_err(|_| Kind::DecoderPanicked.into())
}

/// Keeps the standard error free of the panics of decoders, which this crate turns into an [`Error`] in any case.
///
/// Decoders may panic on damaged files, and the program's panic hook prints a message before the panic is caught. The
/// hook belongs to the whole program, so a library does not touch it by itself: a program calls this once, at its start,
/// if it does not want those messages. The hook that was there stays in force for all other panics. Only the thread on
/// which a decoder runs is silent, and only as long as it runs; calling this again changes nothing.
///
/// Without it, or where the program is built with `panic = "abort"`, which no library can catch, nothing else differs.
///
/// ```
/// onelight_picture::silence_panics_while_reading();
/// ```
pub fn silence_panics_while_reading() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let other = take_hook();
        set_hook(Box::new(move |info| {
            if !DECODING.get() {
                other(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_and_a_value_a_value() {
        assert!(panic_to_error(|| panic!("of a decoder, which the test expects")).unwrap_err().is_damaged());
        assert_eq!(panic_to_error(|| 3).unwrap(), 3);
        assert!(!DECODING.get());
    }

    #[test]
    fn a_decoder_within_a_decoder_leaves_the_outer_one_silent() {
        let inner = panic_to_error(|| {
            assert!(panic_to_error(|| panic!("of a decoder, which the test expects")).is_err());
            DECODING.get()
        });
        assert!(inner.unwrap());
    }
}
