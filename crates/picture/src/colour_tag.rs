//! What a written file says of its values.

use crate::description::Chromaticities;

/// The transfer curve that the values of a picture went through before they are written.
///
/// ```
/// # use onelight_picture::{Chromaticities, ColourTag, OutputTransfer};
/// # let primaries = Chromaticities { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
/// let tag = ColourTag { transfer: OutputTransfer::Gamma24, primaries };
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputTransfer {
    /// The piecewise curve of IEC 61966-2-1.
    Srgb,
    /// A power of 1 / 2.4.
    Gamma24,
    /// A power of 1 / 2.6.
    Gamma26,
    /// SMPTE ST 2084, which PNG says by code points alone.
    Pq,
    /// Hybrid Log-Gamma (ITU-R BT.2100), which PNG says by code points alone.
    Hlg,
    /// No curve: the values are linear light.
    Linear,
}

/// What a file says about its values. Values are written as they are; this changes none.
///
/// ```
/// use onelight_picture::{Chromaticities, ColourTag, OutputTransfer};
///
/// let display_p3 = ColourTag {
///     transfer: OutputTransfer::Srgb,
///     primaries: Chromaticities { red: [0.68, 0.32], green: [0.265, 0.69], blue: [0.15, 0.06], white: [0.3127, 0.329] },
/// };
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourTag {
    /// The transfer curve that the values went through.
    pub transfer: OutputTransfer,
    /// The primaries and the white point of the values.
    pub primaries: Chromaticities,
}
