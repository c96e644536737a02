//! A film as its data sheet describes it.

mod facts;
mod figures;
mod layers;
mod reread;
mod sheet;

use onelight_spectra::SpectralShape;

pub use facts::{AimDensities, ExposureAxis, FilmSize, Image, MidGrey, Normalisation, Origin, StockKind, Uncertainty};
pub use reread::Figures;

use crate::curve::CharacteristicCurve;
use crate::densitometry::Densitometry;
use crate::dye::{DyeDensity, Dyes};
use crate::error::Error;
use crate::granularity::Granularity;
use crate::inter_image::{InterImage, InterImageOrigin};
use crate::layer::PerLayer;
use crate::metering::MID_GREY_LUX_S;
use crate::modulation_transfer::ModulationTransfer;
use crate::printable::printable;
use crate::quantity::{Density, LogExposure};
use crate::sensitivity::SpectralSensitivity;
use crate::table::NumberTable;
use layers::{ImageDensity, Layers};

/// Most characters of an id that a message repeats.
const ID_CHARACTERS: usize = 64;

/// The text of a film's four files, as they stand in a folder of `onelight-stocks`. A film of one's own needs nothing else; the
/// example at [`Stock`] has all of one.
///
/// ```
/// use onelight_film::{SheetText, Stock};
/// let error = Stock::parse(&SheetText {
///     id: "mine",
///     stock_toml: "version = 1\nname = 'My film'\nspeed = 100\n",
///     sensitivity_csv: "",
///     characteristic_csv: "",
///     dye_density_csv: "",
/// })
/// .unwrap_err();
/// assert!(error.to_string().starts_with("mine/stock.toml:3: unknown field `speed`"), "{error}");
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SheetText<'a> {
    /// Name of the folder, expected to be the `id` in `stock.toml`; messages begin with it. After an `@` may stand a variant of that
    /// file, as in `kodak-portra-800@push-1`.
    pub id: &'a str,
    /// `stock.toml`: what the film is, what its sheet states, and where each set of figures comes from.
    pub stock_toml: &'a str,
    /// `sensitivity.csv`: `wavelength_nm`, and log10 of the sensitivity in `red`, `green`, `blue`; in `silver` for black and white.
    pub sensitivity_csv: &'a str,
    /// `characteristic.csv`: `log10_exposure`, and the density in `red`, `green`, `blue`, or `silver`; a variant's after an `@`, as in
    /// `red@push-1`.
    pub characteristic_csv: &'a str,
    /// `dye_density.csv`: `wavelength_nm`, and the spectral density of `cyan`, `magenta`, `yellow`, `d_min` and `neutral`; the last
    /// two may be blank (a negative needs `d_min`). Empty for black and white.
    pub dye_density_csv: &'a str,
}

/// A film: its facts and its three sets of curves.
///
/// One of the built-in films, and a data sheet of one's own (shortened: a real sheet has fifty rows a table):
///
/// ```
/// use onelight_film::{LogExposure, SheetText, Stock, StockKind};
///
/// let files = onelight_stocks::find("fuji-velvia-50").ok_or("no such stock")?;
/// let velvia = Stock::parse(&SheetText {
///     id: files.id,
///     stock_toml: files.stock_toml,
///     sensitivity_csv: files.sensitivity_csv,
///     characteristic_csv: files.characteristic_csv,
///     dye_density_csv: files.dye_density_csv,
/// })?;
/// assert_eq!(velvia.kind(), StockKind::Reversal);
///
/// let mine = Stock::parse(&SheetText {
///     id: "mine",
///     stock_toml: r#"
///         version = 1
///         id = "mine"
///         name = "My slide film"
///         maker = "me"
///         kind = "reversal"
///         exposure_index = 100
///         balance = "daylight 5500 K"
///         process = "E-6"
///         year = 2024
///         sheet = "measured with a status A densitometer"
///
///         [sensitivity]
///         origin = "published"
///
///         [characteristic]
///         origin = "published"
///         densitometry = "status-a"
///         axis = "lux-seconds"
///         mid_grey = "speed"
///
///         [dye_density]
///         origin = "published"
///         normalisation = "peak"
///
///         [uncertainty]
///         origin = "two readings"
///         sensitivity = [0.02, 0.02, 0.02]
///         characteristic = [0.01, 0.01, 0.01]
///         dye_density = [0.01, 0.01, 0.01]
///     "#,
///     sensitivity_csv: "wavelength_nm,red,green,blue\n400,,-1,1\n450,-2,0,1.2\n550,0,1.5,-1\n650,1.4,-1,\n700,-1,,\n",
///     characteristic_csv: "log10_exposure,red,green,blue\n-3,3.2,3.3,3.4\n-1,0.9,1,1\n0.5,0.1,0.1,0.1\n",
///     dye_density_csv: "wavelength_nm,cyan,magenta,yellow,d_min,neutral\n\
///         400,0.2,0.1,0.8,,\n450,0.1,0.2,1,,\n550,0.2,1,0.1,,\n650,1,0.1,0,,\n700,0.8,0,0,,\n",
/// })?;
/// // 8.1 lux s / ISO 100.
/// assert_eq!(mine.mid_grey()?, LogExposure(0.081_f64.log10()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Stock {
    id: String,
    sheet: sheet::Sheet,
    sensitivity: PerLayer<SpectralSensitivity>,
    characteristic: PerLayer<CharacteristicCurve>,
    dyes: PerLayer<DyeDensity>,
    d_min: Option<DyeDensity>,
    neutral: Option<DyeDensity>,
    mtf: Option<PerLayer<ModulationTransfer>>,
    granularity: Option<PerLayer<Granularity>>,
}

impl Stock {
    /// Reads a stock from the text of its files: `stock.toml` of at most 64 KiB, tables of at most 4 MiB.
    ///
    /// # Errors
    /// The first thing that is wrong, with file, line, what was found and what was expected.
    pub fn parse(text: &SheetText<'_>) -> Result<Self, Error> {
        let (folder, asked) = text.id.split_once('@').map_or((text.id, None), |(folder, name)| (folder, Some(name)));
        let file = |name: &str| format!("{folder}/{name}");
        let mut sheet = sheet::parse(&file("stock.toml"), text.stock_toml)?;
        if sheet.id != folder {
            return Err(Error::stock(
                folder,
                format!("stock.toml has id {:?}, expected that of its folder", printable(&sheet.id, ID_CHARACTERS)),
            ));
        }
        let variant = sheet.choose(asked)?;
        let sensitivity = NumberTable::parse(&file("sensitivity.csv"), text.sensitivity_csv)?;
        let characteristic = NumberTable::parse(&file("characteristic.csv"), text.characteristic_csv)?;
        let layers = Layers::read(&sheet, variant.as_deref(), &sensitivity, &characteristic)?;
        let dyes = match &sheet.dye_density {
            Some(section) => {
                let table = NumberTable::parse(&file("dye_density.csv"), text.dye_density_csv)?;
                ImageDensity::of_dyes(&table, section.base, sheet.kind)?
            }
            None if text.dye_density_csv.is_empty() => ImageDensity::of_silver()?,
            None => {
                return Err(Error::stock(folder, "dye_density.csv is there, expected none for a picture in silver"));
            }
        };
        Ok(Self {
            id: variant.map_or_else(|| folder.to_owned(), |name| format!("{folder}@{name}")),
            sensitivity: layers.sensitivity,
            characteristic: layers.characteristic,
            dyes: dyes.image,
            d_min: dyes.d_min,
            neutral: dyes.neutral,
            mtf: None,
            granularity: None,
            sheet,
        })
    }

    /// Folder name, such as `kodak-5207`, and after an `@` the variant unless it is the usual one: `kodak-portra-800@push-1`.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The names of all variants, the usual one first where it has a name; empty if there are none.
    pub fn variants(&self) -> impl Iterator<Item = &str> {
        let others = self.sheet.variant.iter().map(|variant| variant.name.as_str());
        self.sheet.usual_variant.as_deref().into_iter().chain(others)
    }

    /// The maker's name for it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.sheet.name
    }

    /// The company that made it.
    #[must_use]
    pub fn maker(&self) -> &str {
        &self.sheet.maker
    }

    /// What it is for: a camera, a printer, and which way its densities go.
    #[must_use]
    pub fn kind(&self) -> StockKind {
        self.sheet.kind
    }

    /// Whether its picture is of three dyes or of silver.
    #[must_use]
    pub fn image(&self) -> Image {
        self.sheet.image
    }

    /// Whether `print` is something that this film is usually printed on: a kind that goes with its own, and like it in colour or in
    /// black and white.
    #[must_use]
    pub fn is_printed_on(&self, print: &Self) -> bool {
        self.kind().printed_on().contains(&print.kind()) && self.image() == print.image()
    }

    /// Speed (ISO, ASA, EI); `None` for what is printed on.
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

    /// The sizes that it is sold in, as its sheet or its numbers name them; empty where neither is known to.
    ///
    /// ```
    /// use onelight_film::{FilmSize, SheetText, Stock};
    /// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
    /// # let vision = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
    /// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?;
    /// assert_eq!(vision.formats(), [FilmSize::Motion35, FilmSize::Motion16]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn formats(&self) -> &[FilmSize] {
        &self.sheet.formats
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

    /// The densitometer that the characteristic curves were read with.
    #[must_use]
    pub fn densitometry(&self) -> Densitometry {
        self.sheet.characteristic.densitometry
    }

    /// What one unit of a dye is: how the sheet's dye curves are scaled. A third of a picture in silver is one where it has density 1.
    #[must_use]
    pub fn normalisation(&self) -> Normalisation {
        self.sheet.dye_density.as_ref().map_or(Normalisation::Peak, |dyes| dyes.normalisation)
    }

    /// What a printed grey card should measure; `None` for camera films.
    #[must_use]
    pub fn aim(&self) -> Option<AimDensities> {
        let section = self.sheet.aim.as_ref()?;
        Some(AimDensities { status_a: PerLayer::from(section.densities()).map(Density), origin: section.origin })
    }

    /// How strongly its layers inhibit each other's development, and where that is from: its own where the sheet has one, else
    /// that of its kind ([`InterImage::of_kind`]); `None` for print films and for a picture in silver, which has one layer.
    ///
    /// ```
    /// use onelight_film::{InterImage, InterImageOrigin, SheetText, Stock};
    /// # let f = onelight_stocks::find("kodak-portra-400").ok_or("no such stock")?;
    /// # let portra = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
    /// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?;
    /// assert_eq!(portra.inter_image(), Some((InterImage::NEGATIVE, InterImageOrigin::Measured)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn inter_image(&self) -> Option<(InterImage, InterImageOrigin)> {
        if self.image() == Image::Silver {
            return None;
        }
        let own = self.sheet.inter_image.as_ref();
        // The reader has checked the numbers.
        let own = own.and_then(|pair| Some((InterImage::new(pair.near, pair.far).ok()?, pair.origin)));
        own.or_else(|| InterImage::of_kind(self.kind()))
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
            (self.sheet.dye_density.as_ref().map(|dyes| dyes.origin), "dyes"),
            (self.sheet.dye_density.as_ref().and_then(|dyes| dyes.d_min), "D-min"),
            (self.sheet.aim.as_ref().map(|aim| aim.origin), "aim"),
            (self.sheet.mtf.as_ref().and_then(|mtf| mtf.origin), "modulation transfer"),
            (self.sheet.granularity.as_ref().and_then(|granularity| granularity.origin), "granularity"),
        ];
        parts.into_iter().filter(|(origin, _)| *origin == Some(Origin::Derived)).map(|(_, what)| what).collect()
    }

    /// Spectral sensitivity of each layer, as published; black and white has one layer, three times.
    #[must_use]
    pub fn sensitivity(&self) -> PerLayer<&SpectralSensitivity> {
        self.sensitivity.as_ref()
    }

    /// Characteristic curve of each layer, as read by [`Stock::densitometry`].
    #[must_use]
    pub fn characteristic(&self) -> PerLayer<&CharacteristicCurve> {
        self.characteristic.as_ref()
    }

    /// Dye of each layer: cyan, magenta, yellow. For a picture in silver three times the third of one of density 1, so that the three
    /// together are the silver.
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

    /// Dyes, and for a negative in dye D-min, on a grid. All others have none: their curves are total densities.
    ///
    /// # Errors
    /// If a density of the sheet lies beyond what a density may be.
    pub fn dyes_on(&self, shape: SpectralShape) -> Result<Dyes, Error> {
        let base = self.d_min.as_ref().filter(|_| self.kind() == StockKind::Negative);
        let d_min = base.map(|d| d.on(shape)).transpose()?;
        Dyes::new(self.dyes.as_ref().try_map(|dye, _| dye.on(shape))?, d_min)
    }

    /// Where an 18 % grey card lies on the exposure axis, the same for all layers.
    ///
    /// # Errors
    /// If it is printed on: where its grey lies is an aim of the printer.
    pub fn mid_grey(&self) -> Result<LogExposure, Error> {
        match (self.sheet.characteristic.mid_grey, self.sheet.exposure_index) {
            (Some(MidGrey::Centre), _) => {
                let middle = self.characteristic.as_ref().map(|curve| {
                    let (first, last) = curve.range().into_inner();
                    0.5 * (first.0 + last.0)
                });
                Ok(LogExposure(middle.to_array().iter().sum::<f64>() / 3.0))
            }
            (Some(MidGrey::Speed), Some(speed)) => Ok(LogExposure((MID_GREY_LUX_S / speed).log10())),
            (Some(MidGrey::AxisZero), _) => Ok(LogExposure(0.0)),
            _ => {
                let found = format!("a {} has no mid grey of its own, expected a camera film", self.kind().name());
                Err(Error::stock(self.id(), found))
            }
        }
    }
}
