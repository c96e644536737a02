//! Laws of the whole crate: what is written is read again, and what is broken is refused.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod bands;
mod colours;
mod damage;
mod exr;
mod jpeg_and_radiance;
mod layers;
mod metadata;
mod others;
mod plain;
mod refusals;
mod tiff;
mod written;

use std::io::{Cursor, ErrorKind};

use onelight_picture::{
    Band, BandSink, BandView, Channels, Chromaticities, ColourTag, Description, Dither, Error, JpegSettings, Limits,
    OutputTransfer, PartChoice, Picture, PictureReader, PngBits, PngSettings, Selection, Source, TiffBits, TiffSamples,
    TiffSettings, Transfer, Windows, open, open_selected, text_of_complete_picture, write_exr, write_jpeg, write_png,
    write_tiff,
};

/// A picture that compresses, with a value in it that few things survive.
fn sample(width: usize, height: usize) -> Picture {
    let mut rgb: Vec<[f32; 3]> = (0..width * height)
        .map(|index| {
            let (x, y) = ((index % width) as f32, (index / width) as f32);
            [x / width as f32, (0.3 * x).sin() * 8.0 - 1.0, y * 0.125]
        })
        .collect();
    if let Some(colour) = rgb.get_mut(width + 1) {
        *colour = [f32::INFINITY, f32::NAN, -3.5];
    }
    Picture::opaque(width, height, rgb, Source::Exr)
}

/// Hands a picture over in bands of a few rows.
fn hand_over(picture: BandView<'_>, sink: &mut dyn BandSink) -> Result<(), Error> {
    // What is left over when rows are counted comes with the last.
    let rows = (picture.rgb.len() / picture.width).max(1);
    for top in (0..rows).step_by(3) {
        let pixels = top * picture.width..if top + 3 < rows { (top + 3) * picture.width } else { picture.rgb.len() };
        let alpha = picture.alpha.map(|alpha| &alpha[pixels.start.min(alpha.len())..pixels.end.min(alpha.len())]);
        sink.write(BandView { top, width: picture.width, rgb: &picture.rgb[pixels], alpha })?;
    }
    Ok(())
}

/// A display-coded picture.
#[derive(Debug, Clone, PartialEq)]
struct DisplayPicture {
    width: usize,
    height: usize,
    rgb: Vec<[f32; 3]>,
    alpha: Option<Vec<f32>>,
}

impl DisplayPicture {
    fn view(&self) -> BandView<'_> {
        BandView { top: 0, width: self.width, rgb: &self.rgb, alpha: self.alpha.as_deref() }
    }

    fn description(&self) -> Description {
        let channels = if self.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        Description::new(self.width, self.height, channels, Source::Exr)
    }
}

/// Writes a display-coded picture as PNG.
fn write_png_to(
    writer: impl std::io::Write + Send,
    picture: &DisplayPicture,
    bits: PngBits,
    tag: Option<ColourTag>,
    texts: &[(&str, &str)],
) -> Result<(), Error> {
    let fill = |sink: &mut dyn BandSink| hand_over(picture.view(), sink);
    write_png(writer, &picture.description(), PngSettings { bits, tag, ..PngSettings::default() }, texts, fill)
}

fn read_bytes(bytes: &[u8]) -> Result<Picture, Error> {
    Picture::read(Cursor::new(bytes), "", Limits::default())
}

/// The sentence a file is refused with.
fn refusal(bytes: &[u8]) -> String {
    let sentence = read_bytes(bytes).expect_err("the file should be refused").to_string();
    assert!(!sentence.contains('\n') && !sentence.is_empty(), "{sentence:?}");
    sentence
}

/// Equal to the bit, NaN included.
fn assert_same(a: &[[f32; 3]], b: &[[f32; 3]]) {
    assert_eq!(a.len(), b.len());
    for (index, (a, b)) in a.iter().zip(b).enumerate() {
        assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits), "pixel {index}: {a:?} and {b:?}");
    }
}

/// A small generator with a fixed start, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }
}
