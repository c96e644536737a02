//! Tables written as KTX2.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    onelight_fuzz::lut::ktx2(bytes);
});
