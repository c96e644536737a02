//! Catching the panics of decoders that were not written for damaged files.

use std::{
    cell::Cell,
    panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook},
    sync::Once,
};

use anyhow::{Result, anyhow};

thread_local! {
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Runs `decode`; a panic in it becomes an error and prints nothing.
pub(super) fn guarded<T>(decode: impl FnOnce() -> T) -> Result<T> {
    static HOOK: Once = Once::new();
    // The hook belongs to the whole program, so it is wrapped once and asks the thread.
    HOOK.call_once(|| {
        let loud = take_hook();
        set_hook(Box::new(move |info| {
            if !QUIET.get() {
                loud(info);
            }
        }));
    });
    let before = QUIET.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(decode));
    QUIET.set(before);
    outcome.map_err(|_| anyhow!("the data are damaged, or of a kind that the decoder cannot take (it gave up)"))
}

/// Most characters that are repeated of a decoder's message, which may list what a damaged file has thousands of.
const MESSAGE_CHARACTERS: usize = 160;

/// A decoder's message as part of a sentence: on one line, and not long.
pub(super) fn told(message: &str) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    match message.char_indices().nth(MESSAGE_CHARACTERS) {
        Some((end, _)) => message[..end].chars().map(plain).chain("...".chars()).collect(),
        None => message.chars().map(plain).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_and_a_value_a_value() {
        assert!(guarded(|| panic!("not to be seen in the test's output")).is_err());
        assert_eq!(guarded(|| 3).unwrap(), 3);
        assert!(!QUIET.get());
    }

    #[test]
    fn a_message_is_one_short_line() {
        assert_eq!(told("a\nb\u{7}"), "a b ");
        assert_eq!(told(&"\u{e4}".repeat(161)), format!("{}...", "\u{e4}".repeat(160)));
        assert_eq!(told(&"x".repeat(160)), "x".repeat(160));
    }
}
