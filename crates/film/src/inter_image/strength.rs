use std::fmt;

use crate::error::{Error, ErrorKind};
use crate::printable::printable;
use crate::stock::StockKind;

/// Most characters of a word that a message repeats.
const MESSAGE_CHARACTERS: usize = 40;

/// How strongly the layers of a colour film inhibit each other's development, in log10 exposure for a unit of developed
/// density.
///
/// Couplers that release an inhibitor (DIR), and iodide, diffuse from a layer that develops into its neighbours. A data sheet
/// cannot tell: its curves are those of greys, where all layers develop alike. Two numbers are enough for measured negatives:
/// `near` between layers that touch (red and green, green and blue), `far` between red and blue.
///
/// ```
/// use onelight_film::InterImage;
/// let usual = InterImage::NEGATIVE;
/// assert_eq!((usual.near(), usual.far()), (0.60, 0.06));
/// assert_eq!(InterImage::parse("0.5,0.1")?.to_string(), "0.5,0.1");
/// assert_eq!(InterImage::parse("none")?, InterImage::NONE);
/// assert!(InterImage::new(-0.1, 0.0).is_err());
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterImage {
    near: f64,
    far: f64,
}

/// Where the strength of a stock's inter-image effect is from.
///
/// ```
/// use onelight_film::{InterImage, InterImageOrigin, StockKind};
/// let origin = |kind| InterImage::of_kind(kind).map(|(_, origin)| origin);
/// assert_eq!(origin(StockKind::Negative), Some(InterImageOrigin::Transferred));
/// assert_eq!(origin(StockKind::Reversal), Some(InterImageOrigin::Assumed));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum InterImageOrigin {
    /// Fitted to frames of this very film.
    Measured,
    /// That of other films of its kind, which were measured.
    Transferred,
    /// No measurement is known: a plausible value.
    Assumed,
}

impl InterImageOrigin {
    /// The word in stock files and lists.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Transferred => "transferred",
            Self::Assumed => "assumed",
        }
    }
}

impl InterImage {
    /// Layers that develop each by itself: what a film does that has only its sheet's curves.
    pub const NONE: Self = Self { near: 0.0, far: 0.0 };
    /// Colour negatives: fitted to about 3,500 patches on 15 frames of Portra 160, Portra 400 and Ektar 100; good to ±0.12 and
    /// 0 to 0.2.
    pub const NEGATIVE: Self = Self { near: 0.60, far: 0.06 };
    /// Reversal film: assumed, 0 to 0.3 is plausible; no measurement is known.
    pub const REVERSAL: Self = Self { near: 0.20, far: 0.02 };
    /// The strongest that is taken, in log10 exposure for a unit of density.
    pub const MAX: f64 = 3.0;

    /// An effect of this strength, each 0 to [`InterImage::MAX`].
    ///
    /// # Errors
    /// If a number is negative, too large or not a number.
    pub fn new(near: f64, far: f64) -> Result<Self, Error> {
        for (what, found) in [("near", near), ("far", far)] {
            if !(0.0..=Self::MAX).contains(&found) {
                return Err(ErrorKind::InterImage { what, found, max: Self::MAX }.into());
            }
        }
        Ok(Self { near, far })
    }

    /// The effect for a word: `none`, `negative`, `reversal`, or two numbers as `0.6,0.06`.
    ///
    /// # Errors
    /// If the word is none of these, or a number is out of range.
    pub fn parse(word: &str) -> Result<Self, Error> {
        match word {
            "none" => return Ok(Self::NONE),
            "negative" => return Ok(Self::NEGATIVE),
            "reversal" => return Ok(Self::REVERSAL),
            _ => {}
        }
        let numbers = word.split_once(',').and_then(|(near, far)| {
            let number = |text: &str| text.trim().parse::<f64>().ok();
            number(near).zip(number(far))
        });
        let (near, far) =
            numbers.ok_or_else(|| ErrorKind::InterImageWord { found: printable(word, MESSAGE_CHARACTERS) })?;
        Self::new(near, far)
    }

    /// The usual effect of a kind of film and where it is from; print films and papers have none, and of instant film none is known.
    #[must_use]
    pub fn of_kind(kind: StockKind) -> Option<(Self, InterImageOrigin)> {
        match kind {
            StockKind::Negative => Some((Self::NEGATIVE, InterImageOrigin::Transferred)),
            StockKind::Reversal => Some((Self::REVERSAL, InterImageOrigin::Assumed)),
            StockKind::Instant | StockKind::Print | StockKind::Paper | StockKind::ReversalPrint => None,
        }
    }

    /// Between layers that touch: log10 exposure for a unit of density.
    #[must_use]
    pub fn near(self) -> f64 {
        self.near
    }

    /// Between the red- and the blue-sensitive layer.
    #[must_use]
    pub fn far(self) -> f64 {
        self.far
    }

    /// Whether each layer develops by itself.
    #[must_use]
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// The matrix `M` of the law `h' = h + M q`, where `q` are the developed densities on the neutral wedge: what a layer's
    /// own density adds on the diagonal, what the others' take away beside it. Rows sum to 0, so that greys stay.
    #[must_use]
    pub fn matrix(self) -> [[f64; 3]; 3] {
        let Self { near, far } = self;
        [[near + far, -near, -far], [-near, near + near, -near], [-far, -near, far + near]]
    }
}

impl fmt::Display for InterImage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NONE => f.write_str("none"),
            Self::NEGATIVE => f.write_str("negative"),
            Self::REVERSAL => f.write_str("reversal"),
            Self { near, far } => write!(f, "{near},{far}"),
        }
    }
}
