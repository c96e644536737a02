use super::approach::Approach;
use super::spaces::ColourSpaces;

/// A tone mapping without film, to compare looks with: the description of it.
///
/// ```
/// use onelight::{Process, ToneMapping, ToneProcess};
/// let clipped = Process::from(ToneProcess { mapping: ToneMapping::Clip, ..Default::default() });
/// assert_eq!(clipped.look()?.develop_linear([0.25, 1.5, -3.0]).0, [0.25, 1.0, 0.0]);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToneProcess {
    /// What becomes of light that is brighter than the display.
    pub mapping: ToneMapping,
    /// The RGB that comes in and goes out.
    pub spaces: ColourSpaces,
}

/// Tone mappings that know no film.
///
/// ```
/// use onelight::{Process, ToneMapping, ToneProcess};
/// let clip = Process::from(ToneProcess { mapping: ToneMapping::Clip, ..ToneProcess::default() }).look()?;
/// assert_eq!(clip.develop_linear([0.25, 0.5, 9.0]).0, [0.25, 0.5, 1.0]);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ToneMapping {
    /// x / (1 + x) for each channel (\[Reinhard2002\], equation 3): highlights lose their colour.
    #[default]
    Reinhard,
    /// The same of luminance: highlights keep their colour and clip.
    ReinhardLuminance,
    /// Nothing: what does not fit the display is cut off.
    Clip,
}

impl ToneMapping {
    /// The word of the key `approach` for it.
    #[must_use]
    pub fn approach(self) -> Approach {
        match self {
            Self::Reinhard => Approach::Reinhard,
            Self::ReinhardLuminance => Approach::ReinhardLuminance,
            Self::Clip => Approach::Clip,
        }
    }
}
