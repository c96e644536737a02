//! What a data sheet says of its film in words.

use serde::Deserialize;

use crate::curve::Direction;
use crate::layer::PerLayer;
use crate::quantity::Density;

/// A size that a film is sold in: one of the `formats` of a data sheet.
///
/// ```
/// use onelight_film::FilmSize;
/// assert_eq!(FilmSize::Motion16.name(), "16 mm");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
pub enum FilmSize {
    /// Motion-picture film of 35 mm and wider.
    #[serde(rename = "35 mm")]
    Motion35,
    /// Motion-picture film of 16 mm.
    #[serde(rename = "16 mm")]
    Motion16,
    /// Cartridges of perforated film, for frames of 24 x 36 mm.
    #[serde(rename = "135")]
    Cartridge135,
    /// Rolls for frames 6 cm wide.
    #[serde(rename = "120")]
    Roll120,
    /// Sheets, of 4 x 5 inch and more.
    #[serde(rename = "sheet")]
    Sheet,
    /// Packs of instant film.
    #[serde(rename = "pack")]
    Pack,
}

impl FilmSize {
    /// The word of a data sheet for it, such as `16 mm`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Motion35 => "35 mm",
            Self::Motion16 => "16 mm",
            Self::Cartridge135 => "135",
            Self::Roll120 => "120",
            Self::Sheet => "sheet",
            Self::Pack => "pack",
        }
    }
}

/// What a film is for: the `kind` of a data sheet.
///
/// ```
/// use onelight_film::StockKind;
/// assert_eq!(StockKind::Reversal.name(), "reversal film");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StockKind {
    /// A camera film that is printed.
    Negative,
    /// A camera film that is projected itself, or printed on reversal paper.
    Reversal,
    /// A camera film that makes its own print, which is looked at in reflected light.
    Instant,
    /// A film that negatives are printed on, to be projected.
    Print,
    /// A paper that negatives are printed on, looked at in reflected light.
    Paper,
    /// A paper that reversal films are printed on, looked at in reflected light.
    ReversalPrint,
}

impl StockKind {
    /// All kinds, camera films first.
    pub const ALL: [Self; 6] =
        [Self::Negative, Self::Reversal, Self::Instant, Self::Print, Self::Paper, Self::ReversalPrint];

    /// What such a film is called in a sentence, such as `reversal film`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Negative => "negative",
            Self::Reversal => "reversal film",
            Self::Instant => "instant film",
            Self::Print => "print film",
            Self::Paper => "paper",
            Self::ReversalPrint => "reversal paper",
        }
    }

    /// The `kind` of a data sheet, such as `reversal-print`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Negative => "negative",
            Self::Reversal => "reversal",
            Self::Instant => "instant",
            Self::Print => "print",
            Self::Paper => "paper",
            Self::ReversalPrint => "reversal-print",
        }
    }

    /// Whether it goes into a camera; all others are printed on.
    #[must_use]
    pub fn is_camera_film(self) -> bool {
        matches!(self, Self::Negative | Self::Reversal | Self::Instant)
    }

    /// Whether it is looked at in reflected light: its densities are those of reflection.
    #[must_use]
    pub fn is_reflective(self) -> bool {
        matches!(self, Self::Instant | Self::Paper | Self::ReversalPrint)
    }

    /// The kinds that a camera film is printed on, the usual one first; none for what is not printed.
    #[must_use]
    pub fn printed_on(self) -> &'static [Self] {
        match self {
            Self::Negative => &[Self::Print, Self::Paper],
            Self::Reversal => &[Self::ReversalPrint],
            Self::Instant | Self::Print | Self::Paper | Self::ReversalPrint => &[],
        }
    }

    /// Whether its densities rise or fall with exposure.
    #[must_use]
    pub fn direction(self) -> Direction {
        match self {
            Self::Negative | Self::Print | Self::Paper => Direction::Rising,
            Self::Reversal | Self::Instant | Self::ReversalPrint => Direction::Falling,
        }
    }
}

/// What a developed picture is made of: the `image` of a data sheet.
///
/// ```
/// use onelight_film::Image;
/// assert_eq!(Image::default(), Image::Dye);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Image {
    /// Three layers, each with its dye.
    #[default]
    Dye,
    /// One layer of silver: black and white. Silver is taken to hold back all wavelengths alike.
    Silver,
}

/// What the numbers on a characteristic curve's exposure axis are: the `axis` of a data sheet.
///
/// ```
/// use onelight_film::{ExposureAxis, SheetText, Stock};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// assert_eq!(read("kodak-5207")?.axis(), ExposureAxis::Relative);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExposureAxis {
    /// log10 of lux s, by the sheet and by what its speed says.
    LuxSeconds,
    /// Plotted as log10 of lux s; the scale could not be confirmed.
    LuxSecondsUnverified,
    /// log10 of an exposure in a unit that the sheet does not give: only differences mean something.
    Relative,
}

/// Where an 18 % grey card, properly exposed, lies on the exposure axis: the `mid_grey` of a camera film's data sheet.
/// [`Stock::mid_grey`](crate::Stock::mid_grey) has the number.
///
/// ```
/// use onelight_film::{LogExposure, SheetText, Stock};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// // A sheet that says `mid_grey = "axis-zero"`.
/// assert_eq!(read("fuji-eterna-500")?.mid_grey()?, LogExposure(0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MidGrey {
    /// At the middle of the published range: sheets that plot camera stops about the normal exposure.
    Centre,
    /// At 8.1 lux s divided by the exposure index.
    Speed,
    /// At 0 of a relative axis.
    AxisZero,
}

/// Whether figures were read off the maker's sheet or stand in for what it does not show.
///
/// ```
/// use onelight_film::{Origin, SheetText, Stock};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let aim = read("kodak-2383")?.aim().ok_or("a print film has one")?;
/// assert_eq!(aim.origin, Origin::Published);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Read off the maker's sheet.
    Published,
    /// Computed: the stock's files say how.
    Derived,
}

/// What one unit of a dye is, and so the unit of [`DyeAmount`](crate::DyeAmount).
///
/// ```
/// use onelight_film::{Normalisation, SheetText, Stock};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// assert_eq!(read("kodak-5207")?.normalisation(), Normalisation::Peak);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Normalisation {
    /// The amount whose highest spectral density is 1.
    Peak,
    /// The amount that, with the two others, makes the sheet's neutral.
    Neutral,
}

/// How far the figures of a stock can be trusted: rms per layer or dye.
///
/// ```
/// use onelight_film::{SheetText, Stock};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let stock = read("kodak-5207")?;
/// // Two people who read the same sheet differ by 0.01 to 0.03 in log10 sensitivity.
/// assert!(stock.uncertainty().sensitivity.iter().all(|rms| (0.01..0.04).contains(rms)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Uncertainty {
    /// How the figures were found, in words.
    pub origin: String,
    /// log10 of sensitivity: red, green, blue.
    pub sensitivity: [f64; 3],
    /// Density of the characteristic curves: red, green, blue.
    pub characteristic: [f64; 3],
    /// Density of cyan, magenta, yellow; `None` where the dyes are derived.
    pub dye_density: Option<[f64; 3]>,
}

/// What a properly printed grey card should measure on a print film or paper: its laboratory aim densities.
///
/// ```
/// use onelight_film::{Density, SheetText, Stock};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let aim = read("kodak-2383")?.aim().ok_or("a print film has one")?;
/// assert_eq!(aim.status_a.red, Density(1.09));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AimDensities {
    /// Status A density through the red, green and blue filter; three times the visual density on black and white.
    pub status_a: PerLayer<Density>,
    /// Whether the sheet states them.
    pub origin: Origin,
}
