//! What the programs in `examples/` share: a device that may be missing, a picture that stands in for a renderer's, and a look that follows
//! keys.

use onelight_gpu::{Error, Headless, HeadlessSettings};

pub mod live_frame;
pub mod live_look;
pub mod scene;

/// Opens the fastest graphics card, or a software driver. `None`, and a printed sentence, if there is neither.
///
/// The environment variable `ONELIGHT_REQUIRE_GPU` makes that an error: it holds part of the adapter's name, or `1` for any.
///
/// ```
/// if let Some(gpu) = onelight_gpu_examples::open()? {
///     println!("{}", gpu.name());
/// }
/// # Ok::<(), onelight_gpu::Error>(())
/// ```
///
/// # Errors
/// If the adapter gives no device, or is missing though the variable asks for it.
pub fn open() -> Result<Option<Headless>, Error> {
    let required = std::env::var("ONELIGHT_REQUIRE_GPU").ok();
    let adapter = required.as_deref().filter(|word| *word != "1").unwrap_or_default();
    match Headless::open(&HeadlessSettings { adapter, ..Default::default() }) {
        Err(error) if error.is_no_adapter() && required.is_none() => {
            println!("skipped: {error}");
            Ok(None)
        }
        opened => opened.map(Some),
    }
}

// The Rust of the repository's pages, which the documentation tests compile and run: this package has all that they use.

#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../../../docs/using.md")]
struct Using;

#[cfg(doctest)]
#[doc = include_str!("../../../docs/gpu.md")]
struct Gpu;
