//! What a file says of its picture before the pixels.

use crate::{metadata::Metadata, transfer::Transfer};

/// What a file says of its picture before the pixels, and what a writer needs to know of it.
///
/// ```
/// use onelight_picture::{Channels, Description, Source, Windows};
///
/// let picture = Description::new(1920, 1080, Channels::Rgb, Source::Exr);
/// assert_eq!(picture.windows, Windows::of_size(1920, 1080));
/// assert_eq!(picture.pixels(), 1920 * 1080);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Width of the data window, in pixels.
    pub width: usize,
    /// Height of the data window, in pixels.
    pub height: usize,
    /// What a pixel holds: colour, or colour and coverage.
    pub channels: Channels,
    /// How the file keeps colours that alpha covers in part. Colours are given straight in any case.
    pub stored_alpha: StoredAlpha,
    /// Where the pixels lie and what part of the plane is shown.
    pub windows: Windows,
    /// What the three numbers of a colour are.
    pub tristimulus: Tristimulus,
    /// The colour space of the pixels where the file names it.
    pub primaries: Option<Chromaticities>,
    /// Luminance of (1, 1, 1) in cd/m2, where the file says it: OpenEXR's `whiteLuminance`. Other formats have no place for it.
    pub white_luminance: Option<f32>,
    /// How the values become light where the file says it. Values are given as they are. Writers do not look at it.
    pub transfer: Option<Transfer>,
    /// What in the file says so, as a noun for the user, such as "the ICC profile `Display P3`".
    pub colours_said_by: Option<String>,
    /// What kind of file it is.
    pub source: Source,
    /// How the picture was taken, as far as the file says it and it stays true.
    pub metadata: Metadata,
    /// What the reader chose among several layers or leaves out, a sentence each, for the user. Writers do not look at them.
    pub notes: Vec<String>,
}

impl Description {
    /// A picture of one window at the origin, of no named primaries.
    pub fn new(width: usize, height: usize, channels: Channels, source: Source) -> Self {
        let windows = Windows::of_size(width, height);
        Self {
            width,
            height,
            channels,
            stored_alpha: StoredAlpha::Straight,
            windows,
            tristimulus: Tristimulus::Rgb,
            primaries: None,
            white_luminance: None,
            transfer: None,
            colours_said_by: None,
            source,
            metadata: Metadata::default(),
            notes: Vec::new(),
        }
    }

    /// Pixels of the data window.
    pub fn pixels(&self) -> u64 {
        (self.width as u64).saturating_mul(self.height as u64)
    }
}

/// What a pixel holds: colour alone, or colour and coverage.
///
/// ```
/// use onelight_picture::Channels;
///
/// assert_eq!((Channels::Rgb.count(), Channels::Rgba.count()), (3, 4));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channels {
    /// Red, green and blue; the picture is opaque.
    Rgb,
    /// Red, green, blue, and coverage (alpha) from 0 to 1.
    Rgba,
}

impl Channels {
    /// Samples of a pixel: 3 or 4.
    pub fn count(self) -> usize {
        match self {
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }
}

/// What the three numbers of a colour are. Writers do not look at it.
///
/// ```
/// use onelight_picture::{Channels, Description, Source, Tristimulus};
///
/// let picture = Description::new(1, 1, Channels::Rgb, Source::Exr);
/// assert_eq!(picture.tristimulus, Tristimulus::Rgb);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tristimulus {
    /// Red, green and blue of a space, (1, 1, 1) being its white.
    Rgb,
    /// The CIE 1931 X, Y and Z of light.
    Xyz,
}

/// How a file keeps colours that alpha covers in part.
///
/// ```
/// use onelight_picture::StoredAlpha;
///
/// /// Whether colour under an alpha of 0 is light, such as glow, and not a leftover.
/// fn is_light_without_coverage(stored: StoredAlpha) -> bool {
///     stored == StoredAlpha::Premultiplied
/// }
/// # assert!(is_light_without_coverage(StoredAlpha::Premultiplied));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoredAlpha {
    /// Colours are those of what covers the pixel, however little.
    Straight,
    /// Colours are multiplied by alpha: the light that the pixel gives.
    Premultiplied,
}

/// The windows of OpenEXR: pixels are given in the data window, the display window is what a viewer shows.
///
/// Columns count to the right and rows down, in one plane for both windows. Files of other formats have one window at the
/// origin.
///
/// ```
/// use onelight_picture::Windows;
///
/// // A render with 8 pixels more on each side than are shown.
/// let overscan = Windows { data_origin: [-8, -8], ..Windows::of_size(1920, 1080) };
/// assert_eq!((overscan.display_origin, overscan.display_size), ([0, 0], [1920, 1080]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Windows {
    /// Column and row of the first pixel.
    pub data_origin: [i32; 2],
    /// Column and row of the first pixel shown.
    pub display_origin: [i32; 2],
    /// Width and height of what is shown, in pixels.
    pub display_size: [usize; 2],
    /// Width of a pixel divided by its height, from 1e-6 to 1e6.
    pub pixel_aspect: f32,
}

impl Windows {
    /// Both windows the same, at the origin, of square pixels.
    pub fn of_size(width: usize, height: usize) -> Self {
        Self { data_origin: [0; 2], display_origin: [0; 2], display_size: [width, height], pixel_aspect: 1.0 }
    }

    /// Whether a viewer shows any pixel of a data window of `width` by `height` pixels.
    ///
    /// ```
    /// use onelight_picture::Windows;
    ///
    /// let aside = Windows { data_origin: [2000, 0], ..Windows::of_size(1920, 1080) };
    /// assert!(Windows::of_size(1920, 1080).show_pixels(1920, 1080) && !aside.show_pixels(1920, 1080));
    /// ```
    #[must_use]
    pub fn show_pixels(&self, width: usize, height: usize) -> bool {
        let overlap = |axis: usize, size: usize| {
            let (data, display) = (i64::from(self.data_origin[axis]), i64::from(self.display_origin[axis]));
            let end = |origin: i64, size: usize| origin.saturating_add(i64::try_from(size).unwrap_or(i64::MAX));
            data < end(display, self.display_size[axis]) && display < end(data, size)
        };
        overlap(0, width) && overlap(1, height)
    }
}

/// An RGB space by the CIE 1931 xy chromaticities of its primaries and its white point.
///
/// ```
/// use onelight_picture::Chromaticities;
///
/// let srgb = Chromaticities { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
/// # assert_eq!(srgb, srgb.clone());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chromaticities {
    /// x and y of the red primary.
    pub red: [f32; 2],
    /// x and y of the green primary.
    pub green: [f32; 2],
    /// x and y of the blue primary.
    pub blue: [f32; 2],
    /// x and y of the white point.
    pub white: [f32; 2],
}

/// The kind of file a picture came from, which hints at its transfer curve.
///
/// ```
/// use onelight_picture::{Source, TiffSamples};
///
/// /// Whether the numbers are linear light, where nobody says otherwise.
/// fn is_linear(source: Source) -> bool {
///     matches!(source, Source::Exr | Source::RadianceHdr | Source::Tiff { samples: TiffSamples::Float, .. })
/// }
/// assert!(is_linear(Source::Exr) && !is_linear(Source::Png { bits: 16 }));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// OpenEXR, whose values are linear light by convention.
    Exr,
    /// PNG: display-coded unless it says otherwise.
    Png {
        /// Bits of a sample: 8 or 16. Fewer are widened to 8.
        bits: u8,
    },
    /// JPEG of 8 bits: a finished picture, display-coded.
    Jpeg,
    /// Radiance: linear light.
    RadianceHdr,
    /// TIFF: integers are display-coded as a rule, floats linear.
    Tiff {
        /// Bits of a sample: 8, 16, 32 or 64.
        bits: u8,
        /// How the samples are stored.
        samples: TiffSamples,
    },
}

/// How a TIFF stores its samples.
///
/// ```
/// use onelight_picture::{Source, TiffSamples};
///
/// let scan = Source::Tiff { bits: 16, samples: TiffSamples::Integer };
/// # assert_ne!(scan, Source::Tiff { bits: 16, samples: TiffSamples::Float });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TiffSamples {
    /// Unsigned integers, given as 0 to 1.
    Integer,
    /// Floating point, given as they are.
    Float,
}
