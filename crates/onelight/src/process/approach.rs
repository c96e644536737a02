use crate::word::words;

/// How scene light becomes a picture: the key `approach` of `look.toml`. Each has a description of its own in
/// [`crate::Process`].
///
/// ```
/// use onelight::{Approach, Process, Word};
/// assert_eq!(Process::default().approach(), Approach::Second);
/// assert_eq!(Approach::parse("reinhard")?, Approach::Reinhard);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Approach {
    /// The simulation: spectrum, exposure, dye, print, projection.
    #[default]
    Second,
    /// The first of \[Gotanda2010\]: sensitivities at three wavelengths, characteristic curves as tone curves, colour controls by
    /// hand. "Was NOT a simulation."
    First,
    /// x / (1 + x) for each channel (\[Reinhard2002\], equation 3): highlights lose their colour.
    Reinhard,
    /// The same of luminance: highlights keep their colour and clip.
    ReinhardLuminance,
    /// Nothing: what does not fit the display is cut off.
    Clip,
}

words! {
    Approach, "approach":
        Approach::Second = "second" "the simulation: spectrum, dye, print, projection",
        Approach::First = "first" "the talk's first: three wavelengths and tone curves",
        Approach::Reinhard = "reinhard" "no film: x / (1 + x) for each channel",
        Approach::ReinhardLuminance = "reinhard-luminance" "no film: the same of luminance",
        Approach::Clip = "clip" "no film: what does not fit is cut off";
}
