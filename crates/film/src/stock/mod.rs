//! A film as its data sheet describes it.

mod sheet;

use onelight_spectra::{NumberTable, SpectralShape};
use serde::Deserialize;

pub use sheet::{Normalisation, Uncertainty};

use crate::curve::{CharacteristicCurve, Density, Direction, LogExposure};
use crate::densitometry::Densitometry;
use crate::dye::{DyeDensity, Dyes};
use crate::error::Error;
use crate::layer::PerLayer;
use crate::sensitivity::SpectralSensitivity;

/// What a film is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StockKind {
    /// A camera film that is printed.
    Negative,
    /// A camera film that is projected itself.
    Reversal,
    /// A film that negatives are printed on.
    Print,
}

impl StockKind {
    /// Whether its densities rise or fall with exposure.
    #[must_use]
    pub fn direction(self) -> Direction {
        match self {
            Self::Negative | Self::Print => Direction::Rising,
            Self::Reversal => Direction::Falling,
        }
    }
}

/// What the numbers on a characteristic curve's exposure axis are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExposureAxis {
    /// log10 of lux s.
    LuxSeconds,
    /// Plotted as log10 of lux s; the scale could not be confirmed.
    LuxSecondsUnverified,
    /// Only differences mean something.
    Relative,
}

/// Where an 18 % grey card, properly exposed, lies on the exposure axis.
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Read off the sheet.
    Published,
    /// Computed: the stock's files say how.
    Derived,
}

/// The text of a stock's files.
#[derive(Debug, Clone, Copy)]
pub struct SheetText<'a> {
    /// Name of the folder, expected to be the `id` in `stock.toml`; messages begin with it.
    pub id: &'a str,
    /// `stock.toml`
    pub stock_toml: &'a str,
    /// `sensitivity.csv`
    pub sensitivity_csv: &'a str,
    /// `characteristic.csv`
    pub characteristic_csv: &'a str,
    /// `dye_density.csv`
    pub dye_density_csv: &'a str,
}

/// Exposure index times lux s of a properly exposed mid grey: the middle of what meters use.
const MID_GREY_LUX_S: f64 = 8.1;

/// A film: its facts and its three sets of curves.
///
/// ```
/// use onelight_film::{SheetText, Stock, StockKind};
/// let files = onelight_stocks::find("fuji-velvia-50").ok_or("no such stock")?;
/// let stock = Stock::parse(&SheetText {
///     id: files.id,
///     stock_toml: files.stock_toml,
///     sensitivity_csv: files.sensitivity_csv,
///     characteristic_csv: files.characteristic_csv,
///     dye_density_csv: files.dye_density_csv,
/// })?;
/// assert_eq!(stock.kind(), StockKind::Reversal);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Stock {
    sheet: sheet::Sheet,
    sensitivity: PerLayer<SpectralSensitivity>,
    characteristic: PerLayer<CharacteristicCurve>,
    dyes: PerLayer<DyeDensity>,
    d_min: Option<DyeDensity>,
    neutral: Option<DyeDensity>,
}

impl Stock {
    /// Reads a stock from the text of its files: `stock.toml` of at most 64 KiB, tables of at most 4 MiB.
    ///
    /// # Errors
    /// The first thing that is wrong, with file, line, what was found and what was expected.
    pub fn parse(text: &SheetText<'_>) -> Result<Self, Error> {
        let file = |name: &str| format!("{}/{name}", text.id);
        let sheet = sheet::parse(&file("stock.toml"), text.stock_toml)?;
        if sheet.id != text.id {
            return Err(Error::stock(
                text.id,
                format!(
                    "stock.toml has id {:?}, expected that of its folder",
                    sheet.id.chars().take(64).collect::<String>()
                ),
            ));
        }
        let sensitivity = NumberTable::parse(&file("sensitivity.csv"), text.sensitivity_csv)?;
        let characteristic = NumberTable::parse(&file("characteristic.csv"), text.characteristic_csv)?;
        let dye_density = NumberTable::parse(&file("dye_density.csv"), text.dye_density_csv)?;
        let direction = sheet.kind.direction();
        let layers = PerLayer::all(());
        let optional = |name: &str| -> Result<Option<DyeDensity>, Error> {
            let published = dye_density.column(name)?.iter().any(Option::is_some);
            if published { Ok(Some(DyeDensity::base(nodes(&dye_density, "wavelength_nm", name)?)?)) } else { Ok(None) }
        };
        let stock = Self {
            sensitivity: layers
                .try_map(|(), layer| SpectralSensitivity::new(nodes(&sensitivity, "wavelength_nm", layer)?))?,
            characteristic: layers.try_map(|(), layer| {
                let nodes = nodes(&characteristic, "log10_exposure", layer)?;
                CharacteristicCurve::new(nodes.x, &nodes.y, direction)
            })?,
            dyes: PerLayer { red: "cyan", green: "magenta", blue: "yellow" }.try_map(|dye, _| {
                DyeDensity::dye(nodes(&dye_density, "wavelength_nm", dye)?, sheet.dye_density.base)
            })?,
            d_min: optional("d_min")?,
            neutral: optional("neutral")?,
            sheet,
        };
        if stock.kind() == StockKind::Negative && stock.d_min.is_none() {
            return Err(dye_density
                .problem(1, "d_min is blank, expected values: a negative is printed through it".into())
                .into());
        }
        Ok(stock)
    }

    /// Folder name, such as `kodak-5207`.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.sheet.id
    }

    /// The maker's name for it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.sheet.name
    }

    /// Who made it.
    #[must_use]
    pub fn maker(&self) -> &str {
        &self.sheet.maker
    }

    /// What it is for.
    #[must_use]
    pub fn kind(&self) -> StockKind {
        self.sheet.kind
    }

    /// Speed (ISO, ASA, EI); `None` for print films.
    #[must_use]
    pub fn exposure_index(&self) -> Option<f64> {
        self.sheet.exposure_index
    }

    /// The light it is made for, in words.
    #[must_use]
    pub fn balance(&self) -> &str {
        &self.sheet.balance
    }

    /// How it is developed, such as ECN-2.
    #[must_use]
    pub fn process(&self) -> &str {
        &self.sheet.process
    }

    /// Year of the sheet or of the film's introduction.
    #[must_use]
    pub fn year(&self) -> u16 {
        self.sheet.year
    }

    /// The document the figures were read off.
    #[must_use]
    pub fn sheet(&self) -> &str {
        &self.sheet.sheet
    }

    /// Density above D-min that the sensitivity is stated at; `None` where the sheet does not say.
    #[must_use]
    pub fn criterion(&self) -> Option<Density> {
        self.sheet.sensitivity.criterion.map(Density)
    }

    /// What the exposure axis of the characteristic curves is.
    #[must_use]
    pub fn axis(&self) -> ExposureAxis {
        self.sheet.characteristic.axis
    }

    /// The densitometer of the characteristic curves.
    #[must_use]
    pub fn densitometry(&self) -> Densitometry {
        self.sheet.characteristic.densitometry
    }

    /// What one unit of a dye is.
    #[must_use]
    pub fn normalisation(&self) -> Normalisation {
        self.sheet.dye_density.normalisation
    }

    /// Aim densities of a print's neutral (status A), and whether the sheet states them; `None` for camera films.
    #[must_use]
    pub fn aim(&self) -> Option<(PerLayer<Density>, Origin)> {
        self.sheet.aim.as_ref().map(|section| (sheet::aim(section).map(Density), section.origin))
    }

    /// How far the figures can be trusted.
    #[must_use]
    pub fn uncertainty(&self) -> &Uncertainty {
        &self.sheet.uncertainty
    }

    /// What stands in for figures that the sheet does not show, in a few words each; empty if nothing does.
    #[must_use]
    pub fn derived(&self) -> Vec<&'static str> {
        let parts = [
            (Some(self.sheet.sensitivity.origin), "sensitivities"),
            (Some(self.sheet.characteristic.origin), "characteristic curves"),
            (Some(self.sheet.dye_density.origin), "dyes"),
            (self.sheet.dye_density.d_min, "D-min"),
            (self.sheet.aim.as_ref().map(|aim| aim.origin), "aim"),
        ];
        parts.into_iter().filter(|(origin, _)| *origin == Some(Origin::Derived)).map(|(_, what)| what).collect()
    }

    /// Spectral sensitivity of each layer.
    #[must_use]
    pub fn sensitivity(&self) -> PerLayer<&SpectralSensitivity> {
        self.sensitivity.as_ref()
    }

    /// Characteristic curve of each layer.
    #[must_use]
    pub fn characteristic(&self) -> PerLayer<&CharacteristicCurve> {
        self.characteristic.as_ref()
    }

    /// Dye of each layer: cyan, magenta, yellow.
    #[must_use]
    pub fn dyes(&self) -> PerLayer<&DyeDensity> {
        self.dyes.as_ref()
    }

    /// Density of the film without image, as published.
    #[must_use]
    pub fn d_min(&self) -> Option<&DyeDensity> {
        self.d_min.as_ref()
    }

    /// The published neutral, D-min included.
    #[must_use]
    pub fn neutral(&self) -> Option<&DyeDensity> {
        self.neutral.as_ref()
    }

    /// Dyes, and for a negative D-min, on a grid. Prints and reversal films have none: their curves are total densities.
    ///
    /// # Errors
    /// If a density of the sheet lies beyond what a density may be.
    pub fn dyes_on(&self, shape: SpectralShape) -> Result<Dyes, Error> {
        let d_min = match self.kind() {
            StockKind::Negative => self.d_min.as_ref().map(|d| d.on(shape)).transpose()?,
            StockKind::Reversal | StockKind::Print => None,
        };
        Dyes::new(self.dyes.as_ref().try_map(|dye, _| dye.on(shape))?, d_min)
    }

    /// Where an 18 % grey card lies on the exposure axis, the same for all layers.
    ///
    /// # Errors
    /// For print films.
    pub fn mid_grey(&self) -> Result<LogExposure, Error> {
        match (self.sheet.characteristic.mid_grey, self.sheet.exposure_index) {
            (Some(MidGrey::Centre), _) => {
                let middle = self.characteristic.as_ref().map(|curve| {
                    let (first, last) = curve.range();
                    0.5 * (first.0 + last.0)
                });
                Ok(LogExposure(middle.to_array().iter().sum::<f64>() / 3.0))
            }
            (Some(MidGrey::Speed), Some(speed)) => Ok(LogExposure((MID_GREY_LUX_S / speed).log10())),
            (Some(MidGrey::AxisZero), _) => Ok(LogExposure(0.0)),
            _ => Err(Error::stock(self.id(), "a print film has no mid grey of its own, expected a camera film")),
        }
    }
}

fn nodes(table: &NumberTable, x: &str, y: &str) -> Result<onelight_spectra::Nodes, Error> {
    Ok(table.nodes(x, y)?)
}
