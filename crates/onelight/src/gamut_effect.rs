//! What the handling of light outside the sRGB primaries changes in a picture.

use std::fmt;

use onelight_film::WideGamut;
use rayon::iter::{IntoParallelRefIterator as _, ParallelIterator as _};
use serde::Serialize;

use crate::certify::MeanAndMax;
use crate::error::Error;
use crate::reference::Reference;
use crate::word::Word as _;

/// How many of some colours have light outside the sRGB primaries, and how far the other [`WideGamut`] would move those. As text it
/// is one sentence.
///
/// ```
/// let film = onelight::Process::default().compile()?;
/// let effect = film.gamut_effect(&[[0.2, 0.3, 0.3], [-0.05, 0.3, 0.3]])?;
/// assert_eq!((effect.outside, effect.colours), (1, 2));
/// assert!(effect.share() == 0.5 && effect.moved.max > 0.1);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct GamutEffect {
    /// The look's own setting.
    #[serde(with = "crate::word::text")]
    pub gamut: WideGamut,
    /// The setting that it is compared with.
    #[serde(with = "crate::word::text")]
    pub other: WideGamut,
    /// Colours that were looked at.
    pub colours: usize,
    /// Those of them that have light outside the sRGB primaries; the setting changes no other.
    pub outside: usize,
    /// CIEDE2000 between the two settings on those outside; 0 where there are none.
    pub moved: MeanAndMax,
}

impl GamutEffect {
    /// The part of the colours that lies outside, 0 to 1.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.outside as f64 / self.colours.max(1) as f64
    }
}

impl fmt::Display for GamutEffect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { gamut, other, outside, moved, .. } = self;
        write!(
            f,
            "{:.2} % of the pixels hold light outside the sRGB primaries (--gamut {})",
            100.0 * self.share(),
            gamut.word()
        )?;
        if *outside > 0 {
            write!(f, ": {moved} from --gamut {}", other.word())?;
        }
        Ok(())
    }
}

impl Reference {
    /// What this look's handling of light outside the sRGB primaries changes in scene-linear colours of its input space, by the
    /// exact film. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn gamut_effect(&self, colours: &[[f64; 3]]) -> Result<GamutEffect, Error> {
        let gamut = self.exposure_matrix().gamut();
        let other = match gamut {
            WideGamut::Compress => WideGamut::Clip,
            WideGamut::Clip => WideGamut::Compress,
        };
        // Nothing before or after the exposures differs.
        let exposure = self.exposure_matrix().clone().with_gamut(other);
        let difference = self.difference()?;
        let moved = |rgb: &[f64; 3]| {
            let other = self.develop_exposure(exposure.expose(self.light(*rgb)));
            difference.between(self.develop_linear(*rgb), other)
        };
        let outside: Vec<[f64; 3]> = colours.iter().copied().filter(|rgb| self.is_outside_srgb(*rgb)).collect();
        let moved: Vec<f64> = outside.par_iter().map(moved).collect();
        Ok(GamutEffect { gamut, other, colours: colours.len(), outside: outside.len(), moved: MeanAndMax::of(&moved) })
    }
}

#[cfg(test)]
mod tests {
    use crate::{FilmProcess, WideGamut};

    /// A cyan and a green outside of sRGB, and three colours inside.
    const COLOURS: [[f64; 3]; 5] =
        [[-0.05, 0.3, 0.3], [0.18, 0.18, 0.18], [0.0, 0.2, 0.1], [-0.1, 0.4, -0.05], [0.9, 0.1, 0.0]];

    #[test]
    fn either_setting_is_as_far_from_the_other() {
        let effect = |gamut| FilmProcess { gamut, ..FilmProcess::default() }.compile().unwrap().gamut_effect(&COLOURS);
        let (compress, clip) = (effect(WideGamut::Compress).unwrap(), effect(WideGamut::Clip).unwrap());
        assert_eq!((compress.outside, compress.colours), (2, 5));
        assert_eq!((compress.gamut, compress.other), (clip.other, clip.gamut));
        assert!((compress.moved.max - clip.moved.max).abs() < 1e-9 && compress.moved.max > 0.5, "{compress:?}");
        assert!(compress.moved.mean < compress.moved.max);
        assert!(compress.to_string().starts_with("40.00 % of the pixels hold light outside"), "{compress}");
    }

    #[test]
    fn colours_within_srgb_are_never_changed() {
        let film = FilmProcess::default().compile().unwrap();
        let effect = film.gamut_effect(&COLOURS[1..3]).unwrap();
        assert_eq!((effect.outside, effect.moved.max, effect.share()), (0, 0.0, 0.0));
        assert_eq!(film.gamut_effect(&[]).unwrap().share(), 0.0);
    }
}
