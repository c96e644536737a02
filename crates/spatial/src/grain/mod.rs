//! Grain: dye clouds that fall where chance will.

mod aperture;
mod correlation;
mod granularity;
mod mean;
pub(crate) mod noise;
mod numbers;
pub(crate) mod quadrature;
mod table;

use onelight_film::{Granularity, PerLayer};

pub use granularity::AmountGranularity;

use crate::chain::Finish;
use crate::constant::{CLOUD_RADIUS, PRINT_BLUR, checked};
use crate::error::Error;
use crate::format::Pitch;
use aperture::{disc_variance, pixel_covariance};
pub(crate) use correlation::Correlation;
use mean::mean_shifts;
pub(crate) use noise::NoiseKey;
use noise::field_sigma;
pub use numbers::GrainNumbers;
pub(crate) use table::StrengthTable;

/// Radii of dye clouds and of the print's blur that are worked with, in um.
const CLOUDS_UM: [f64; 2] = [0.5, 3.0];
const PRINT_BLURS_UM: [f64; 2] = [0.0, 5.0];

/// What grain depends on besides the film's sheet.
///
/// ```
/// use onelight_spatial::GrainSettings;
/// // A negative that is scanned, or film that is projected itself.
/// let scanned = GrainSettings { print_blur_um: 0.0, ..Default::default() };
/// assert_eq!(scanned.cloud_um, 1.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrainSettings {
    /// Standard deviation of a dye cloud, 0.5 to 3 um: [`CLOUD_RADIUS`] by default.
    pub cloud_um: f64,
    /// Standard deviation of the blur of grain by printer and print film, 0 to 5 um: [`PRINT_BLUR`] by default; 0 without a print.
    pub print_blur_um: f64,
    /// Another seed, another pattern.
    pub seed: u32,
}

impl Default for GrainSettings {
    fn default() -> Self {
        Self { cloud_um: CLOUD_RADIUS.value, print_blur_um: PRINT_BLUR.value, seed: 0 }
    }
}

/// Grain of a film at a size of pixels.
///
/// To each amount of dye comes `sigma z + m`: z a normal number of place and frame, correlated as clouds that neighbouring pixels share,
/// sigma the sheet's granularity brought from an aperture of 48 um to the pixel, m what keeps large areas as they are
/// ([`Grain::keeping_mean`]).
///
/// ```
/// use onelight_film::{PerLayer, SheetText, Stock};
/// use onelight_spatial::{AmountGranularity, FilmFormat, Grain, GrainSettings};
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
/// #     .with_figures(f.mtf_csv, f.granularity_csv)?;
/// let sheet = AmountGranularity::of_stock(&stock)?;
/// let grain = |width| Grain::new(sheet.clone(), FilmFormat::Super35.pitch(width, 1.0)?, GrainSettings::default());
/// assert!(grain(4096)?.factor() > 1.3 * grain(2048)?.factor(), "smaller pixels average fewer clouds");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Grain {
    granularity: AmountGranularity,
    settings: GrainSettings,
    pitch: Pitch,
    factor: f64,
    correlation: [Correlation; 2],
    /// For each layer, amounts in increasing order and the shift of the mean there.
    shifts: PerLayer<Vec<(f64, f64)>>,
    tables: [StrengthTable; 3],
}

impl Grain {
    /// For pixels of this size, without a shift of the mean.
    ///
    /// # Errors
    /// If a setting is out of range.
    pub fn new(granularity: AmountGranularity, pitch: Pitch, settings: GrainSettings) -> Result<Self, Error> {
        let cloud = checked("radius of a dye cloud", settings.cloud_um, CLOUDS_UM, " um")?;
        let print = checked("blur of grain by the print", settings.print_blur_um, PRINT_BLURS_UM, " um")?;
        let seen = cloud.hypot(print);
        let [x, y] = [pitch.x_um(), pitch.y_um()];
        let pixel = pixel_covariance(x, seen, 0) * pixel_covariance(y, seen, 0);
        let factor = (pixel / disc_variance(Granularity::APERTURE_UM, cloud)).sqrt();
        let correlation = [Correlation::new(x, seen), Correlation::new(y, seen)];
        let shifts = PerLayer::all(vec![(0.0, 0.0)]);
        let tables = tables(&granularity, factor, &shifts);
        Ok(Self { granularity, settings, pitch, factor, correlation, shifts, tables })
    }

    /// The same grain, with amounts shifted so that along the grey scale its mean in display-linear light, and so large areas, stay as they
    /// are without it: what follows the film is not linear in its dye. `greys` are the amounts of greys from black to white, 8 or more.
    ///
    /// Costs about 1400 evaluations of [`Finish::display_linear`] for each grey.
    #[must_use]
    pub fn keeping_mean(self, greys: &[[f64; 3]], finish: &impl Finish) -> Self {
        let shifts = mean_shifts(greys, |amounts| self.sigma(amounts), finish);
        let tables = tables(&self.granularity, self.factor, &shifts);
        Self { shifts, tables, ..self }
    }

    /// Standard deviation of a pixel over that of the sheet's aperture.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// Standard deviation of the amounts of a pixel.
    #[must_use]
    pub fn sigma(&self, amounts: PerLayer<f64>) -> PerLayer<f64> {
        self.granularity.sigma(amounts).map(|sigma| sigma * self.factor)
    }

    /// What is added to the amounts of a pixel to keep the mean.
    #[must_use]
    pub fn mean_shift(&self, amounts: PerLayer<f64>) -> PerLayer<f64> {
        self.shifts.as_ref().zip_map(amounts, |layer, amount| interpolated(layer, amount))
    }

    /// The size of the pixels that it was made for.
    #[must_use]
    pub fn pitch(&self) -> Pitch {
        self.pitch
    }

    /// What it was made with.
    #[must_use]
    pub fn settings(&self) -> GrainSettings {
        self.settings
    }

    pub(crate) fn numbers(&self) -> GrainNumbers {
        let [x, y] = &self.correlation;
        GrainNumbers {
            seed: self.settings.seed,
            taps: [x.taps().to_vec(), y.taps().to_vec()],
            scale: (1.0 / field_sigma(x, y)) as f32,
            axes: self.tables.each_ref().map(StrengthTable::axis),
            intervals: self.tables.each_ref().map(StrengthTable::intervals),
        }
    }

    pub(crate) fn correlation(&self) -> [&Correlation; 2] {
        self.correlation.each_ref()
    }

    pub(crate) fn tables(&self) -> &[StrengthTable; 3] {
        &self.tables
    }

    pub(crate) fn key(&self, frame: u32) -> NoiseKey {
        NoiseKey { frame, seed: self.settings.seed }
    }
}

fn tables(granularity: &AmountGranularity, factor: f64, shifts: &PerLayer<Vec<(f64, f64)>>) -> [StrengthTable; 3] {
    let sigma = |layer: usize, amount: f64| factor * granularity.sigma(PerLayer::all(amount)).to_array()[layer];
    let (range, shifts) = (granularity.range().to_array(), shifts.as_ref().to_array());
    std::array::from_fn(|layer| {
        StrengthTable::new(range[layer], |amount| [sigma(layer, amount), interpolated(shifts[layer], amount)])
    })
}

/// Linear between points of increasing first number, flat outside.
fn interpolated(points: &[(f64, f64)], x: f64) -> f64 {
    let above = points.partition_point(|(a, _)| *a <= x);
    let [(a, v), (b, w)] = [points[above.saturating_sub(1)], points[above.min(points.len() - 1)]];
    let t = if b > a { ((x - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
    v + t * (w - v)
}
