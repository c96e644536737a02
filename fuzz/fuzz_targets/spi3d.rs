//! `.spi3d` files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    onelight_fuzz::lut::spi3d(bytes);
});
