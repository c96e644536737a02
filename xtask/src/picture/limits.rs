//! What a picture may cost, checked before memory is taken for it.

use anyhow::{Result, anyhow, bail};

/// The largest picture that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Most pixels in one window.
    pub max_pixels: u64,
    /// Longest side of a window, in pixels.
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
    pub(super) fn check_size(&self, what: &str, width: u64, height: u64) -> Result<()> {
        if width == 0 || height == 0 {
            bail!("{what} is {width} x {height} pixels, expected at least 1 x 1");
        }
        if width > self.max_side || height > self.max_side {
            bail!("{what} is {width} x {height} pixels, expected sides up to {}", self.max_side);
        }
        if width * height > self.max_pixels {
            bail!("{what} is {width} x {height} pixels, expected up to {} pixels", self.max_pixels);
        }
        Ok(())
    }

    /// Refuses what would take more than [`Limits::max_bytes`] at once; `what` names it in the message.
    pub(super) fn check_bytes(&self, what: &str, [width, height]: [u64; 2], bytes: u64) -> Result<()> {
        if bytes > self.max_bytes {
            bail!(
                "{what} of {width} x {height} pixels takes {} MiB of memory at once, expected up to {} MiB",
                bytes.div_ceil(1 << 20),
                self.max_bytes >> 20
            );
        }
        Ok(())
    }
}

/// A display window may have this many pixels whatever the data window has (a PNG of some 100 KB), ...
const SHOWN_FREELY: u64 = 1 << 24;
/// ... and beyond that this many times as many as the data window.
const SHOWN_PER_PIXEL: u64 = 64;

/// Refuses a display window that is nearly all empty, so that a small file cannot ask for a large picture.
pub(super) fn check_shown(data: (u64, u64), display: (u64, u64)) -> Result<()> {
    let (pixels, shown) = (data.0.saturating_mul(data.1), display.0.saturating_mul(display.1));
    if shown > SHOWN_FREELY && shown > pixels.saturating_mul(SHOWN_PER_PIXEL) {
        bail!(
            "the display window is {} x {} pixels for a data window of {} x {}, expected at most {SHOWN_PER_PIXEL} times \
             as many, or {SHOWN_FREELY} pixels",
            display.0,
            display.1,
            data.0,
            data.1
        );
    }
    Ok(())
}

/// Refuses a header that claims more than the file can hold: `claimed` bytes of samples from `length` bytes of file,
/// where one byte gives at most `expansion` bytes.
pub(super) fn check_claim(width: u64, height: u64, claimed: u64, length: u64, expansion: u64) -> Result<()> {
    if claimed > length.saturating_mul(expansion) {
        bail!(
            "the header claims {width} x {height} pixels ({claimed} bytes of samples), which a file of {length} bytes \
             cannot hold (is it truncated?)"
        );
    }
    Ok(())
}

/// `count` values, or a sentence where the memory is not there.
pub(super) fn allocate<T: Clone>(count: usize, value: T) -> Result<Vec<T>> {
    let mut values = Vec::new();
    grow(&mut values, count, value)?;
    Ok(values)
}

/// Makes `values` as many as `count`, new ones being `value`, or says that the memory is not there.
pub(super) fn grow<T: Clone>(values: &mut Vec<T>, count: usize, value: T) -> Result<()> {
    values
        .try_reserve_exact(count.saturating_sub(values.len()))
        .map_err(|_| anyhow!("there is no memory for {} MiB of pixels", (count * size_of::<T>()) >> 20))?;
    values.resize(count, value);
    Ok(())
}
