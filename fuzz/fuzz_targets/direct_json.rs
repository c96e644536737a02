//! `look.direct.json` files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    onelight_fuzz::lut::direct_form(bytes);
});
