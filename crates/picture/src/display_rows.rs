//! The rows of a display window, packed as they come.

use std::ops::Range;

use rayon::prelude::*;

use crate::{
    band::BandView,
    band_sink::BandSink,
    description::{Channels, Description},
    display::Shown,
    dither::Dither,
    error::{Error, WriteProblem},
    limits::{allocate, grow},
};

/// How a sample is written, the highest byte first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Samples {
    /// Codes from 0 to 255.
    Eight(Dither),
    /// Codes from 0 to 65535.
    Sixteen,
    /// Numbers as they are.
    Float,
}

impl Samples {
    /// Bytes of a sample.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::Eight(_) => 1,
            Self::Sixteen => 2,
            Self::Float => 4,
        }
    }
}

/// Takes the bands of a picture, and hands on whole rows of its display window.
pub(crate) struct DisplayRows<W> {
    shown: Shown,
    /// Width and height of the data window.
    size: [usize; 2],
    channels: Channels,
    samples: Samples,
    row_bytes: usize,
    /// Rows of the display window.
    height: usize,
    /// The next row of the display window.
    next: usize,
    /// The next row of the data window.
    row: usize,
    bytes: Vec<u8>,
    write: W,
}

impl<W: FnMut(&[u8]) -> Result<(), Error>> DisplayRows<W> {
    /// From the first row on; `write` takes the bytes of one row or several.
    pub(crate) fn new(picture: &Description, samples: Samples, write: W) -> Self {
        let [width, height] = picture.windows.display_size;
        Self {
            shown: Shown::new(picture),
            size: [picture.width, picture.height],
            channels: picture.channels,
            samples,
            row_bytes: width * samples.bytes() * picture.channels.count(),
            height,
            next: 0,
            row: 0,
            bytes: Vec::new(),
            write,
        }
    }

    /// Writes empty rows up to `row` of the display window.
    fn blank_to(&mut self, row: usize) -> Result<(), Error> {
        if self.next < row {
            let blank = allocate(self.row_bytes, 0)?;
            for _ in self.next..row {
                (self.write)(&blank)?;
            }
            self.next = row;
        }
        Ok(())
    }

    /// Writes what is left below the data window.
    pub(crate) fn finish(&mut self) -> Result<(), Error> {
        let [width, height] = self.size;
        if self.row != height {
            return Err(WriteProblem::RowsMissing { size: [width, height], rows: self.row }.into());
        }
        self.blank_to(self.height)
    }
}

impl<W: FnMut(&[u8]) -> Result<(), Error> + Send> BandSink for DisplayRows<W> {
    fn write(&mut self, band: BandView<'_>) -> Result<(), Error> {
        self.row += band.checked_rows(self.row, self.size, self.channels)?;
        let rows = self.shown.rows_of(band);
        if rows.is_empty() {
            return Ok(());
        }
        self.blank_to(rows.start)?;
        grow(&mut self.bytes, rows.len() * self.row_bytes, 0)?;
        let (shown, samples, channels) = (&self.shown, self.samples, self.channels);
        self.bytes.par_chunks_exact_mut(self.row_bytes).zip(rows.clone()).for_each(|(bytes, row)| {
            let (columns, rgb, alpha) = shown.row(row, band);
            let eight = |value: f32| [nearest(clamped(value) * 255.0) as u8];
            match samples {
                Samples::Eight(Dither::None) => pack(bytes, channels, columns, rgb, alpha, |_, v| eight(v), eight),
                Samples::Eight(Dither::Pattern) => {
                    let code = |x: usize, value: f32| [(clamped(value) * 255.0 + Dither::threshold(x, row)) as u8];
                    pack(bytes, channels, columns, rgb, alpha, code, eight);
                }
                Samples::Sixteen => {
                    let code = |value: f32| (nearest(clamped(value) * 65_535.0) as u16).to_be_bytes();
                    pack(bytes, channels, columns, rgb, alpha, |_, v| code(v), code);
                }
                Samples::Float => {
                    pack(bytes, channels, columns, rgb, alpha, |_, v: f32| v.to_be_bytes(), f32::to_be_bytes);
                }
            }
        });
        (self.write)(&self.bytes)?;
        self.next = rows.end;
        Ok(())
    }
}

/// A value as integers have it. A cast of NaN gives 0, so clamping need not ask.
fn clamped(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}

/// Fills in a row of the display window; what lies outside of `columns` is empty. `code` knows the column.
fn pack<const N: usize>(
    bytes: &mut [u8],
    channels: Channels,
    columns: Range<usize>,
    rgb: &[[f32; 3]],
    alpha: Option<&[f32]>,
    code: impl Fn(usize, f32) -> [u8; N],
    code_alpha: impl Fn(f32) -> [u8; N],
) {
    let step = channels.count();
    let (samples, _) = bytes.as_chunks_mut::<N>();
    samples[..columns.start * step].fill([0; N]);
    samples[columns.end * step..].fill([0; N]);
    let pixels = columns.clone().zip(samples[columns.start * step..columns.end * step].chunks_exact_mut(step));
    match alpha {
        Some(alpha) => pixels.zip(rgb.iter().zip(alpha)).for_each(|((x, pixel), ([r, g, b], a))| {
            pixel.copy_from_slice(&[code(x, *r), code(x, *g), code(x, *b), code_alpha(*a)]);
        }),
        None => pixels.zip(rgb).for_each(|((x, pixel), rgb)| pixel.copy_from_slice(&rgb.map(|v| code(x, v)))),
    }
}

/// The nearest whole number, halves up, of what lies in 0..65535: as `round`, without the call that it is on most
/// processors.
fn nearest(value: f32) -> u32 {
    let whole = value as u32;
    // Exact, as both are of one size.
    whole + u32::from(value - whole as f32 >= 0.5)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_nearest_code_is_what_rounding_gives() {
        // Each code, half way to the next, and the values beside that.
        let halves = (0..65_535).map(|code| code as f32 + 0.5);
        let beside = halves.flat_map(|half| [half.next_down(), half, half.next_up(), half - 0.5]);
        for value in beside.chain([65_535.0, 0.5_f32.next_down(), f32::MIN_POSITIVE]) {
            assert_eq!(nearest(value), value.round() as u32, "{value}");
        }
        assert_eq!(nearest(f32::NAN), 0);
    }
}
