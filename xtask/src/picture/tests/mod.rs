//! Laws of the whole module: what is written is read again, and what is broken is refused.

mod bands;
mod damage;
mod exr;
mod plain;
mod refusals;

use std::io::Cursor;

use super::{in_memory::read_from, *};

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
fn hand_over(picture: BandView<'_>, sink: &mut dyn BandSink) -> Result<()> {
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
        Description::plain(self.width, self.height, channels, Source::Exr)
    }
}

impl Picture {
    /// What a writer of display windows makes of bands of one row.
    fn into_display(self) -> Result<DisplayPicture> {
        let shown = display::Shown::new(&self.description());
        let [width, height] = self.windows.display_size;
        let mut rgb = vec![[0.0; 3]; width * height];
        let mut alpha = self.alpha.as_ref().map(|_| vec![0.0; width * height]);
        let mut next = 0;
        for top in 0..self.height {
            let pixels = top * self.width..(top + 1) * self.width;
            let own = self.alpha.as_ref().map(|alpha| &alpha[pixels.clone()]);
            let band = BandView { top, width: self.width, rgb: &self.rgb[pixels], alpha: own };
            for row in shown.rows_of(band) {
                assert!(row >= next && row < height, "row {row} after {next}");
                next = row + 1;
                let (columns, colours, coverage) = shown.row(row, band);
                let columns = row * width + columns.start..row * width + columns.end;
                rgb[columns.clone()].copy_from_slice(colours);
                if let (Some(alpha), Some(coverage)) = (&mut alpha, coverage) {
                    alpha[columns].copy_from_slice(coverage);
                }
            }
        }
        Ok(DisplayPicture { width, height, rgb, alpha })
    }
}

/// Writes a display-coded picture as PNG.
fn write_png_to(
    writer: impl std::io::Write + Send,
    picture: &DisplayPicture,
    bits: Bits,
    tag: Option<&ColourTag>,
    texts: &[(&str, &str)],
) -> Result<()> {
    let fill = |sink: &mut dyn BandSink| hand_over(picture.view(), sink);
    png_write::write_bands_to(writer, &picture.description(), bits, tag, texts, fill)
}

fn read_bytes(bytes: &[u8]) -> Result<Picture> {
    read_from(Cursor::new(bytes), bytes.len() as u64, &Limits::default())
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
