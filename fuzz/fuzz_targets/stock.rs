//! Data sheets of films.
#![no_main]

libfuzzer_sys::fuzz_target!(init: onelight_fuzz::on_one_thread(), |bytes: &[u8]| {
    onelight_fuzz::stock::check(bytes, onelight_fuzz::OneIn(16));
});
