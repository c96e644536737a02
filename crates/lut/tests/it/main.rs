//! Tests of what users call, in one program: the pixel loops are compiled for the library once.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod pixels;
mod properties;
mod staged;
