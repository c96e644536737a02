use super::sample::Sample;
use crate::error::{Error, ErrorKind};

/// The channels of a pixel, in memory order.
///
/// ```
/// use onelight_lut::{Channels, Pixels};
/// let rgba = [0.18_f32, 0.18, 0.18, 1.0];
/// assert!(Pixels::new(&rgba, Channels::Rgba, [1, 1]).is_ok());
/// assert!(Pixels::new(&rgba, Channels::Rgba, [2, 1]).is_err(), "two pixels need eight samples");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channels {
    /// Red, green, blue, without alpha.
    Rgb,
    /// Red, green, blue, alpha. Alpha is carried along; RGB is not multiplied or divided by it.
    Rgba,
}

impl Channels {
    /// The number of samples of a pixel.
    pub fn count(self) -> usize {
        match self {
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }
}

/// A picture to read: rows of interleaved samples.
///
/// ```
/// use onelight_lut::{Channels, Pixels};
/// let samples = vec![0.0_f32; 4 * 640 * 480];
/// assert_eq!(Pixels::new(&samples, Channels::Rgba, [640, 480])?.size(), [640, 480]);
/// assert!(Pixels::new(&samples, Channels::Rgba, [640, 481]).is_err());
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pixels<'a, S> {
    pub(super) samples: &'a [S],
    pub(super) layout: Layout,
}

/// A picture to write, or to change in place.
///
/// ```
/// use onelight_lut::{Channels, PixelsMut};
/// // The left half of a picture whose rows are 1280 pixels long.
/// let mut samples = vec![0_u8; 3 * 1280 * 720];
/// let left = PixelsMut::with_stride(&mut samples, Channels::Rgb, [640, 720], 3 * 1280)?;
/// assert_eq!(left.size(), [640, 720]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Debug)]
pub struct PixelsMut<'a, S> {
    pub(super) samples: &'a mut [S],
    pub(super) layout: Layout,
}

/// Where the pixels of a picture lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) channels: Channels,
    pub(super) width: usize,
    pub(super) height: usize,
    /// Samples from the start of a row to the start of the next.
    pub(super) stride: usize,
}

impl Layout {
    /// The samples that a picture takes, if the numbers fit together.
    fn new(len: usize, channels: Channels, width: usize, height: usize, stride: usize) -> Result<Self, Error> {
        let layout = Self { channels, width, height, stride };
        let row = width.checked_mul(channels.count());
        let needed = row.and_then(|row| match height {
            0 => Some(0),
            _ if row > stride => None,
            _ => stride.checked_mul(height - 1)?.checked_add(row),
        });
        match needed {
            Some(needed) if needed <= len => Ok(layout),
            _ => Err(ErrorKind::PixelLayout { width, height, channels: channels.count(), stride, len }.into()),
        }
    }

    pub(super) fn row_samples(self) -> usize {
        self.width * self.channels.count()
    }

    /// From the first sample to the last.
    pub(super) fn samples(self) -> usize {
        match self.height {
            0 => 0,
            height => self.stride * (height - 1) + self.row_samples(),
        }
    }

    /// Whether rows follow each other without a gap.
    pub(super) fn is_dense(self) -> bool {
        self.stride == self.row_samples()
    }
}

impl<'a, S: Sample> Pixels<'a, S> {
    /// A picture whose rows follow each other.
    ///
    /// # Errors
    /// If there are fewer samples than the picture takes.
    pub fn new(samples: &'a [S], channels: Channels, [width, height]: [usize; 2]) -> Result<Self, Error> {
        Self::with_stride(samples, channels, [width, height], width.saturating_mul(channels.count()))
    }

    /// A picture whose rows begin `stride` samples apart.
    ///
    /// # Errors
    /// If a row is longer than `stride`, or there are fewer samples than the picture takes.
    pub fn with_stride(
        samples: &'a [S],
        channels: Channels,
        [width, height]: [usize; 2],
        stride: usize,
    ) -> Result<Self, Error> {
        Ok(Self { layout: Layout::new(samples.len(), channels, width, height, stride)?, samples })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.layout.width, self.layout.height]
    }
}

impl<'a, S: Sample> PixelsMut<'a, S> {
    /// A picture whose rows follow each other.
    ///
    /// # Errors
    /// If there are fewer samples than the picture takes.
    pub fn new(samples: &'a mut [S], channels: Channels, [width, height]: [usize; 2]) -> Result<Self, Error> {
        Self::with_stride(samples, channels, [width, height], width.saturating_mul(channels.count()))
    }

    /// A picture whose rows begin `stride` samples apart; what lies between rows is left alone.
    ///
    /// # Errors
    /// If a row is longer than `stride`, or there are fewer samples than the picture takes.
    pub fn with_stride(
        samples: &'a mut [S],
        channels: Channels,
        [width, height]: [usize; 2],
        stride: usize,
    ) -> Result<Self, Error> {
        Ok(Self { layout: Layout::new(samples.len(), channels, width, height, stride)?, samples })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.layout.width, self.layout.height]
    }
}
