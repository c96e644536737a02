//! The darkroom: film simulation as a page in the browser, where nothing leaves the machine.
//!
//! - [`films`] and [`choices`] are what the page's controls offer, [`Keys`] what they have been turned to;
//! - [`FilmLook`] develops the page's pixels, [`MovingLook`] follows its controls, and [`Way`] says where a colour comes from;
//! - [`develop_on_film`] adds sharpness, halation and grain;
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
mod moving;
mod on_film;
mod opened;
mod packed;
mod read;
mod shader;
mod shrink;
mod take_away;
mod way;

pub use error::Error;
pub use film_look::{FilmLook, develop_codes};
pub use films::{Film, films};
pub use keys::{Keys, choices, look_name};
pub use moving::{MovingLook, quick_form};
pub use on_film::{FramePart, OnFilm, develop_on_film};
pub use opened::{Described, OpenedPicture, Seen};
pub use packed::{PackedLooks, pack, pack_one, unpack_one};
pub use shader::{film_shader, look_bytes};
pub use take_away::{DevelopedFile, FileOrder, ForProgram, PictureKind, bake_for, develop_file};
pub use way::{Developed, Points, Spectrum, Way};
