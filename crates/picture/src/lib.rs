//! OpenEXR, PNG, TIFF, JPEG and Radiance pictures in bands of rows: straight `f32` RGB with or without alpha in, all but
//! Radiance out.
//!
//! - [`open`] gives a [`PictureReader`]: its [`Description`], then one [`Band`] of about a million pixels after the other;
//! - [`write_exr`], [`write_png`], [`write_tiff`] and [`write_jpeg`] take a [`Description`] and the bands that were made of a picture's, and hand a
//!   [`BandSink`] to the function that writes them;
//! - [`Picture`] is a small picture held whole;
//! - [`Limits`] bound what a file may cost. Sizes in a header are claims, which are held against them and against the
//!   length of the file before memory is taken;
//! - [`text_of_complete_picture`] finds a text that was written into a file, if the file is complete.
//!
//! Readers are any `Read + Seek`, writers any `Write + Seek` (PNG: any `Write`): paths, and what is under them when writing
//! fails half way, are the caller's. All threads of the current rayon pool unpack, convert and pack.
//!
//! ```
//! use std::io::Cursor;
//!
//! use onelight_picture::{BandView, Channels, Description, Error, Limits, Source, open, write_exr};
//!
//! // A picture of 2000 x 1000 pixels, written to memory 100 rows at a time ...
//! let (width, height) = (2000, 1000);
//! let description = Description::new(width, height, Channels::Rgb, Source::Exr);
//! let mut file = Cursor::new(Vec::new());
//! write_exr(&mut file, &description, &[("Software", "a tour")], |sink| {
//!     for top in (0..height).step_by(100) {
//!         let rgb: Vec<[f32; 3]> = (0..100 * width).map(|i| [(top + i / width) as f32; 3]).collect();
//!         sink.write(BandView { top, width, rgb: &rgb, alpha: None })?;
//!     }
//!     Ok::<(), Error>(())
//! })?;
//!
//! // ... and read back in bands.
//! let mut picture = open(file, "tour.exr", Limits::default())?;
//! assert_eq!((picture.description().width, picture.description().height), (2000, 1000));
//! let mut bands = 0;
//! while let Some(band) = picture.next_band()? {
//!     assert_eq!(band.rgb()[0], [band.top() as f32; 3]);
//!     bands += 1;
//! }
//! assert_eq!(bands, 2);
//! # Ok::<(), Error>(())
//! ```
//!
//! # Colour
//! Values are those of the file: linear for OpenEXR and floating-point TIFF, 0 to 1 for integers, whose transfer curve the
//! caller undoes: [`Description::transfer`] is the one that the file names, [`Description::source`] hints at which is usual. NaN, infinities and negatives are kept. Colour that a file holds
//! premultiplied is divided by its coverage on the way in and multiplied on the way out, so that a caller sees the colour of
//! things and not of how much of a pixel they cover. Where coverage is 0, negative, not finite or subnormal, colour is left
//! as it is in both directions.
//!
//! # Damaged and hostile files
//! They give an [`Error`] of one sentence. A decoder's panic is caught and becomes one; whoever wants no message of it on
//! the standard error calls [`silence_panics_while_reading`] at the start of the program.
//!
//! # Features
//! `exr`, `hdr`, `jpeg`, `png` and `tiff`, all on by default: the formats that are built. `icc`, on too: ICC profiles are read.
//!
//! # Out of scope
//! Deep data, subsampled channels other than chroma, HTJ2K; CMYK, JPEG-compressed TIFF, camera raw; ICC profiles made of tables; gain maps; animation;
//! conversion between colour spaces; paths.
#![cfg_attr(
    not(all(feature = "exr", feature = "hdr", feature = "icc", feature = "jpeg", feature = "png", feature = "tiff")),
    allow(
        dead_code,
        unused_imports,
        unused_mut,
        unused_variables,
        reason = "what the formats share is all used where all are built"
    )
)]

mod alpha;
mod band;
mod band_sink;
mod colour_tag;
mod decoder_message;
mod description;
mod display;
mod display_rows;
mod dither;
#[cfg(feature = "exr")]
mod dwa;
mod error;
#[cfg(any(feature = "jpeg", feature = "png", feature = "tiff"))]
mod exif;
#[cfg(feature = "exr")]
mod exr_bands;
#[cfg(feature = "exr")]
mod exr_blocks;
#[cfg(feature = "exr")]
mod exr_boxes;
#[cfg(feature = "exr")]
mod exr_layout;
#[cfg(feature = "exr")]
mod exr_luminance_chroma;
#[cfg(feature = "exr")]
mod exr_read;
#[cfg(feature = "exr")]
mod exr_write;
mod file_colours;
#[cfg(feature = "hdr")]
mod hdr_read;
#[cfg(feature = "icc")]
mod icc;
#[cfg(any(feature = "jpeg", feature = "png", feature = "tiff"))]
mod icc_write;
mod input;
#[cfg(feature = "jpeg")]
mod jpeg_read;
#[cfg(feature = "jpeg")]
mod jpeg_write;
mod limits;
mod metadata;
mod metadata_text;
mod orientation;
mod panic_to_error;
#[cfg(feature = "png")]
mod png_read;
#[cfg(feature = "png")]
mod png_write;
mod reader;
mod selection;
mod tiff_directory;
#[cfg(feature = "tiff")]
mod tiff_header;
#[cfg(feature = "tiff")]
mod tiff_pages;
#[cfg(feature = "tiff")]
mod tiff_read;
#[cfg(feature = "tiff")]
mod tiff_unpack;
#[cfg(feature = "tiff")]
mod tiff_write;
mod transfer;
mod whole_picture;

pub use band::{Band, BandView, ReadingMemory, RowMut};
pub use band_sink::BandSink;
pub use colour_tag::{ColourTag, OutputTransfer};
pub use description::{Channels, Chromaticities, Description, Source, StoredAlpha, TiffSamples, Tristimulus, Windows};
pub use dither::Dither;
pub use error::Error;
#[cfg(feature = "exr")]
pub use exr_write::write_exr;
#[cfg(feature = "jpeg")]
pub use jpeg_write::{JpegSettings, write_jpeg};
pub use limits::Limits;
pub use metadata::Metadata;
pub use metadata_text::text_of_complete_picture;
pub use panic_to_error::silence_panics_while_reading;
#[cfg(feature = "png")]
pub use png_write::{PngBits, PngSettings, write_png};
pub use reader::{PictureReader, open, open_selected, readable_formats};
pub use selection::{PartChoice, Selection};
#[cfg(feature = "tiff")]
pub use tiff_write::{TiffBits, TiffSettings, write_tiff};
pub use transfer::{Curve, Transfer};
pub use whole_picture::Picture;

/// The README's example, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
