//! JPEG pictures.
#![no_main]

libfuzzer_sys::fuzz_target!(init: onelight_fuzz::on_one_thread(), |bytes: &[u8]| {
    onelight_fuzz::picture::check(bytes);
});
