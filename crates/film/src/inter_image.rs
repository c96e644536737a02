//! The inter-image effect: a developing layer holds back the development of its neighbours.

use std::fmt;

use crate::curve::CharacteristicCurve;
use crate::error::{Error, ErrorKind};
use crate::layer::PerLayer;
use crate::printable::printable;
use crate::quantity::LogExposure;
use crate::stock::{Stock, StockKind};

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

/// The inter-image effect of one film, exposed one way: log exposures to those at which the layers' own curves are read.
///
/// For the log10 exposures `h` of the three layers and those of a grey card `r`,
///
/// ```text
/// h'_i = h_i + sum over j of C_ij (q(h_i - r_i) - q(h_j - r_j)),    q(t) = mean over j of |D_j(r_j + t) - D_j(unexposed)|
/// ```
///
/// with the densities D of the sheet's characteristic curves. `q` never falls and is flat beyond the curves, so for any
/// strength: greys keep their place; a layer's `h'` rises with its own exposure at least as fast as without the effect, and
/// falls with its neighbours'; no two colours become one; and the shift is bounded.
///
/// ```
/// use onelight_film::{InterImage, InterImageEffect, LogExposure, PerLayer, SheetText, Stock};
/// # let files = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: files.id, stock_toml: files.stock_toml,
/// #     sensitivity_csv: files.sensitivity_csv, characteristic_csv: files.characteristic_csv,
/// #     dye_density_csv: files.dye_density_csv })?;
/// let grey = PerLayer::all(stock.mid_grey()?);
/// let effect = InterImageEffect::new(&stock, InterImage::NEGATIVE, grey);
/// assert_eq!(effect.effective(grey), grey);
/// // Red light: the green-sensitive layer below it is held back.
/// let red = PerLayer { red: LogExposure(0.3), green: LogExposure(-1.0), blue: LogExposure(-1.0) };
/// let shifted = effect.effective(red);
/// assert!(shifted.red.0 > red.red.0 && shifted.green.0 < red.green.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct InterImageEffect {
    strength: InterImage,
    curves: PerLayer<CharacteristicCurve>,
    /// Densities of unexposed film, which every colour is measured from.
    unexposed: PerLayer<f64>,
    grey: PerLayer<LogExposure>,
}

impl InterImageEffect {
    /// The effect of this strength in a film whose grey card lies at `grey`.
    #[must_use]
    pub fn new(stock: &Stock, strength: InterImage, grey: PerLayer<LogExposure>) -> Self {
        let curves = stock.characteristic().map(Clone::clone);
        let unexposed = curves.as_ref().map(|curve| curve.density(LogExposure(f64::NEG_INFINITY)).0);
        Self { strength, curves, unexposed, grey }
    }

    /// Its strength.
    #[must_use]
    pub fn strength(&self) -> InterImage {
        self.strength
    }

    /// Where a grey card lies.
    #[must_use]
    pub fn grey(&self) -> PerLayer<LogExposure> {
        self.grey
    }

    /// `q`: the density that grey light develops `offset` log10 above a grey card, above unexposed film; the mean of the
    /// layers. Never falls; flat beyond the curves; 0 for NaN.
    #[must_use]
    pub fn developed(&self, offset: f64) -> f64 {
        let offset = if offset.is_nan() { f64::NEG_INFINITY } else { offset };
        let at = self.curves.as_ref().zip_map(self.grey, |curve, grey| curve.density(LogExposure(grey.0 + offset)).0);
        let layers = at.zip_map(self.unexposed, |density, unexposed| (density - unexposed).abs());
        layers.to_array().iter().sum::<f64>() / 3.0
    }

    /// The largest value of [`InterImageEffect::developed`]; a layer moves by at most this times the sum of its row's
    /// couplings.
    #[must_use]
    pub fn most_developed(&self) -> f64 {
        self.developed(f64::INFINITY)
    }

    /// The log exposures at which the layers' own curves are to be read.
    #[must_use]
    pub fn effective(&self, h: PerLayer<LogExposure>) -> PerLayer<LogExposure> {
        if self.strength.is_none() {
            return h;
        }
        let q = h.zip_map(self.grey, |h, grey| self.developed(h.0 - grey.0)).to_array();
        let InterImage { near, far } = self.strength;
        // Differences of q, not a matrix of them: where all are equal nothing moves, to the last bit.
        let [red_green, green_blue, red_blue] = [q[0] - q[1], q[1] - q[2], q[0] - q[2]];
        let shift =
            [near * red_green + far * red_blue, near * (green_blue - red_green), -near * green_blue - far * red_blue];
        h.zip_map(PerLayer::from(shift), |h, shift| LogExposure(h.0 + shift))
    }
}
