//! The darkroom: film simulation as a page in the browser, where nothing leaves the machine.
//!
//! - [`films`] and [`choices`] are what the page's controls offer, [`Keys`] what they have been turned to;
//! - [`FilmLook`] develops the page's pixels, and [`Way`] says where a colour comes from;
//! - [`film_shader`] and [`look_bytes`] are the same for graphics cards;
//! - [`OpenedPicture`] reads a file from bytes; [`develop_file`] and [`bake_for`] make the files that are taken away.
//!
//! All of it is plain Rust on any machine, and is tested there. In a browser (`wasm32`) `browser` hands it to JavaScript by
//! wasm-bindgen, as bytes and JSON; `crates/web/page` is the page itself. `cargo xtask darkroom` puts both into a folder.
//!
//! ```
//! use onelight_web::{FilmLook, Keys, Way};
//! let keys = Keys::from_json(r#"{ "camera": "kodak-5219", "points": [2, 0, 0] }"#)?.fitting()?;
//! let grey = Way::of(&FilmLook::new(&keys)?, [0.18; 3])?;
//! // Two points more of red light in the printer: less red.
//! assert!(grey.codes[0] < grey.codes[1]);
//! # Ok::<(), onelight_web::Error>(())
//! ```
//!
//! # Out of scope
//! Looks without film, and data sheets of one's own: the command line has them.

#[cfg(target_arch = "wasm32")]
mod browser;
mod error;
mod film_look;
mod films;
mod keys;
mod light;
mod opened;
mod shader;
mod shrink;
mod take_away;
mod way;

pub use error::Error;
pub use film_look::FilmLook;
pub use films::{Film, films};
pub use keys::{Keys, choices};
pub use opened::{Described, OpenedPicture, Seen};
pub use shader::{film_shader, look_bytes};
pub use take_away::{ForProgram, PictureKind, bake_for, develop_file};
pub use way::{Developed, Points, Spectrum, Way};
