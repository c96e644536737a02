use crate::constant::checked;
use crate::error::Error;
use crate::format::Pitch;

/// Most pixels of a side.
const MAX_SIDE: f64 = 1_048_576.0;

/// The picture, and where it lies in its frame and its sequence.
///
/// Everything that has a place, cells of halation as well as grain, is counted from the frame's origin: a crop that knows its offset has
/// the grain that the whole picture has there.
///
/// ```
/// use onelight_spatial::{FilmFormat, Frame};
/// // The right half of a 2048 pixels wide frame, 24th frame of a shot.
/// let crop = Frame::new([1024, 1152], FilmFormat::Super35.pitch(2048, 1.0)?)?.at([1024, 0]).numbered(23);
/// assert_eq!(crop.offset(), [1024, 0]);
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    size: [usize; 2],
    pitch: Pitch,
    offset: [i32; 2],
    number: u32,
}

impl Frame {
    /// A picture of `[width, height]` pixels at the frame's origin, frame 0.
    ///
    /// # Errors
    /// If a side is not 1 to 1048576 pixels.
    pub fn new(size: [usize; 2], pitch: Pitch) -> Result<Self, Error> {
        for side in size {
            checked("side of a picture", side as f64, [1.0, MAX_SIDE], " pixels")?;
        }
        Ok(Self { size, pitch, offset: [0, 0], number: 0 })
    }

    /// The picture's first pixel, counted from the frame's origin: right and down.
    #[must_use]
    pub fn at(self, offset: [i32; 2]) -> Self {
        Self { offset, ..self }
    }

    /// The picture's number in its sequence: each has grain of its own.
    #[must_use]
    pub fn numbered(self, number: u32) -> Self {
        Self { number, ..self }
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.size[0]
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.size[1]
    }

    /// Size of a pixel on the film.
    #[must_use]
    pub fn pitch(&self) -> Pitch {
        self.pitch
    }

    /// As [`Frame::at`].
    #[must_use]
    pub fn offset(&self) -> [i32; 2] {
        self.offset
    }

    /// As [`Frame::numbered`].
    #[must_use]
    pub fn number(&self) -> u32 {
        self.number
    }
}
