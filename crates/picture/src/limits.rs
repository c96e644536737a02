//! What a picture may cost, checked before memory is taken for it.

use crate::error::{Error, LimitProblem};

/// The largest picture that is read: what goes over a limit is refused before memory is taken for it.
///
/// ```
/// use onelight_picture::Limits;
///
/// // What a thumbnailer may want: no more than 4096 x 4096 pixels, and 64 MiB for a tile, a strip or an interlaced PNG.
/// let small = Limits { max_pixels: 1 << 24, max_bytes: 1 << 26, ..Limits::default() };
/// assert_eq!(small.max_side, 65_535);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Most pixels in one window: the data window, the display window.
    pub max_pixels: u64,
    /// Longest side of a window or a tile, in pixels.
    pub max_side: u64,
    /// Most bytes held at once for what a file keeps in one piece, while it is unpacked: a block or a row of large tiles of
    /// OpenEXR, a strip or a row of tiles of TIFF, an interlaced PNG. Beside them are bands of about a million pixels.
    pub max_bytes: u64,
}

impl Default for Limits {
    /// 268 million pixels (16384 x 16384), sides up to 65535, and 1 GiB.
    fn default() -> Self {
        Self { max_pixels: 1 << 28, max_side: 65_535, max_bytes: 1 << 30 }
    }
}

impl Limits {
    /// Refuses an empty window and one over the limits; `what` names it in the message.
    pub(crate) fn check_size(&self, what: &'static str, width: u64, height: u64) -> Result<(), Error> {
        let size = [width, height];
        if width == 0 || height == 0 {
            return Err(LimitProblem::Empty { what, size }.into());
        }
        if width > self.max_side || height > self.max_side {
            return Err(LimitProblem::Side { what, size, max: self.max_side }.into());
        }
        if width.saturating_mul(height) > self.max_pixels {
            return Err(LimitProblem::Pixels { what, size, max: self.max_pixels }.into());
        }
        Ok(())
    }

    /// Refuses what would take more than [`Limits::max_bytes`] at once; `what` names it in the message.
    pub(crate) fn check_bytes(&self, what: &'static str, size: [u64; 2], bytes: u64) -> Result<(), Error> {
        if bytes > self.max_bytes {
            return Err(LimitProblem::Bytes { what, size, bytes, max: self.max_bytes }.into());
        }
        Ok(())
    }
}

/// Most bytes that the PNG decoder may take beside the picture itself, for rows and the chunks beside the pixels. Tables kept
/// as PNG have a limit of their own, as their pictures have sizes that are known.
#[cfg(feature = "png")]
pub(crate) const PNG_WORKING_BYTES: usize = 1 << 26;

/// A display window may have this many pixels whatever the data window has (a PNG of some 100 KB), ...
#[cfg(feature = "exr")]
const SHOWN_FREELY: u64 = 1 << 24;
/// ... and beyond that this many times as many as the data window.
#[cfg(feature = "exr")]
const SHOWN_PER_PIXEL: u64 = 64;

/// Refuses a display window that is nearly all empty, so that a small file cannot ask for a large picture.
#[cfg(feature = "exr")]
pub(crate) fn check_shown(data: [u64; 2], display: [u64; 2]) -> Result<(), Error> {
    let (pixels, shown) = (data[0].saturating_mul(data[1]), display[0].saturating_mul(display[1]));
    if shown > SHOWN_FREELY && shown > pixels.saturating_mul(SHOWN_PER_PIXEL) {
        let (max_times, max_pixels) = (SHOWN_PER_PIXEL, SHOWN_FREELY);
        return Err(LimitProblem::Display { display, data, max_times, max_pixels }.into());
    }
    Ok(())
}

/// Refuses a header that claims more than the file can hold: so many bytes of `samples` from `length` bytes of file,
/// where one byte gives at most `expansion` bytes.
pub(crate) fn check_claim(size: [u64; 2], samples: u64, length: u64, expansion: u64) -> Result<(), Error> {
    if samples > length.saturating_mul(expansion) {
        return Err(LimitProblem::Claim { size, samples, length }.into());
    }
    Ok(())
}

/// `count` values, or a sentence where the memory is not there.
pub(crate) fn allocate<T: Clone>(count: usize, value: T) -> Result<Vec<T>, Error> {
    let mut values = Vec::new();
    grow(&mut values, count, value)?;
    Ok(values)
}

/// Makes `values` as many as `count`, new ones being `value`, or says that the memory is not there.
pub(crate) fn grow<T: Clone>(values: &mut Vec<T>, count: usize, value: T) -> Result<(), Error> {
    values
        .try_reserve_exact(count.saturating_sub(values.len()))
        .map_err(|_| LimitProblem::Memory { bytes: count.saturating_mul(size_of::<T>()) })?;
    values.resize(count, value);
    Ok(())
}
