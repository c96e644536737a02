//! The curves of a stock, read from its tables.

use onelight_spectra::TablePoints;

use super::facts::{Image, StockKind};
use super::sheet::Sheet;
use crate::curve::CharacteristicCurve;
use crate::dye::DyeDensity;
use crate::error::Error;
use crate::layer::PerLayer;
use crate::sensitivity::SpectralSensitivity;
use crate::table::NumberTable;

/// The column of a stock whose picture is of silver.
const SILVER: &str = "silver";

/// What light does to the layers.
pub(super) struct Layers {
    pub(super) sensitivity: PerLayer<SpectralSensitivity>,
    pub(super) characteristic: PerLayer<CharacteristicCurve>,
}

impl Layers {
    /// Three layers in dye, or the one in silver three times.
    pub(super) fn read(
        sheet: &Sheet,
        variant: Option<&str>,
        sensitivity: &NumberTable,
        characteristic: &NumberTable,
    ) -> Result<Self, Error> {
        let direction = sheet.kind.direction();
        let sensitivity = |column: &str| SpectralSensitivity::new(sensitivity.points("wavelength_nm", column)?);
        let characteristic = |column: &str| {
            let column = variant.map_or_else(|| column.to_owned(), |variant| format!("{column}@{variant}"));
            let points = characteristic.points("log10_exposure", &column)?;
            CharacteristicCurve::new(points.x, &points.y, direction)
        };
        let layers = PerLayer::all(());
        Ok(match sheet.image {
            Image::Dye => Self {
                sensitivity: layers.try_map(|(), layer| sensitivity(layer))?,
                characteristic: layers.try_map(|(), layer| characteristic(layer))?,
            },
            Image::Silver => Self {
                sensitivity: PerLayer::all(sensitivity(SILVER)?),
                characteristic: PerLayer::all(characteristic(SILVER)?),
            },
        })
    }
}

/// What the developed layers hold back, wavelength by wavelength.
pub(super) struct ImageDensity {
    pub(super) image: PerLayer<DyeDensity>,
    pub(super) d_min: Option<DyeDensity>,
    pub(super) neutral: Option<DyeDensity>,
}

impl ImageDensity {
    /// Three dyes less the `base` that each curve contains.
    pub(super) fn of_dyes(table: &NumberTable, base: f64, kind: StockKind) -> Result<Self, Error> {
        let optional = |name: &str| -> Result<Option<DyeDensity>, Error> {
            let published = table.column(name)?.iter().any(Option::is_some);
            if published { Ok(Some(DyeDensity::base(table.points("wavelength_nm", name)?)?)) } else { Ok(None) }
        };
        let found = Self {
            image: PerLayer { red: "cyan", green: "magenta", blue: "yellow" }
                .try_map(|dye, _| DyeDensity::dye(table.points("wavelength_nm", dye)?, base))?,
            d_min: optional("d_min")?,
            neutral: optional("neutral")?,
        };
        if kind == StockKind::Negative && found.d_min.is_none() {
            return Err(table.problem(1, "d_min is blank, expected values: a negative is printed through it".into()));
        }
        Ok(found)
    }

    /// A third of density 1 at all wavelengths for each of three equal layers.
    pub(super) fn of_silver() -> Result<Self, Error> {
        let third = DyeDensity::base(TablePoints { x: vec![400.0, 700.0], y: vec![1.0 / 3.0; 2] })?;
        Ok(Self { image: PerLayer::all(third), d_min: None, neutral: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amounts::DyeModel;
    use crate::quantity::{Density, LogExposure};
    use crate::stock::{SheetText, Stock};
    use onelight_spectra::SpectralShape;

    fn read(id: &str) -> Result<Stock, Error> {
        let f = onelight_stocks::find(id.split('@').next().unwrap()).unwrap();
        Stock::parse(&SheetText {
            id,
            stock_toml: f.stock_toml,
            sensitivity_csv: f.sensitivity_csv,
            characteristic_csv: f.characteristic_csv,
            dye_density_csv: f.dye_density_csv,
        })
    }

    /// Steepest slope of the red layer, or of the silver.
    fn gamma(id: &str) -> f64 {
        let stock = read(id).unwrap();
        let curve = stock.characteristic().red.clone();
        curve.log_exposures().iter().map(|&h| curve.slope(LogExposure(h))).fold(0.0, f64::max)
    }

    #[test]
    fn longer_development_and_higher_grades_are_steeper() {
        let rising = |ids: &[&str]| {
            let gammas: Vec<f64> = ids.iter().map(|id| gamma(id)).collect();
            assert!(gammas.is_sorted_by(|a, b| a < b), "{ids:?}: {gammas:?}");
        };
        rising(&["kodak-5222@4-min", "kodak-5222@5-min", "kodak-5222", "kodak-5222@9-min", "kodak-5222@12-min"]);
        rising(&["kodak-tri-x-400", "kodak-tri-x-400@7-min", "kodak-tri-x-400@9-min", "kodak-tri-x-400@11-min"]);
        rising(&["kodak-2302@2-min", "kodak-2302@3-min", "kodak-2302", "kodak-2302@7-min", "kodak-2302@9-min"]);
        let grades = ["grade-minus-1", "grade-0", "grade-1", "grade-2", "grade-3", "grade-4", "grade-5"];
        rising(&grades.map(|grade| format!("kodak-polymax-fine-art@{grade}")).each_ref().map(String::as_str));
        rising(&["kodak-aerocolor@low-contrast", "kodak-aerocolor", "kodak-aerocolor@high-contrast"]);
    }

    #[test]
    fn silver_holds_back_what_its_curve_says_at_all_wavelengths() {
        for id in ["kodak-tri-x-400", "kodak-2302", "kodak-polymax-fine-art@grade-5"] {
            let stock = read(id).unwrap();
            let curves = DyeModel::Wedge.amounts(&stock, PerLayer::all(LogExposure(0.0))).unwrap();
            let dyes = stock.dyes_on(SpectralShape::VISIBLE).unwrap();
            for &h in stock.characteristic().red.log_exposures() {
                let h = LogExposure(h);
                let Density(sheet) = stock.characteristic().red.density(h);
                let film = dyes.density(curves.as_ref().map(|curve| curve.amount(h)));
                assert!(film.values().iter().all(|d| (d - sheet).abs() < 1e-12), "{id} at {h:?}");
                let read = stock.densitometry().density(&film.transmittance());
                assert!((read.red.0 - sheet).abs() < 1e-9 && read.red == read.blue, "{id} at {h:?}: {read:?}");
            }
        }
    }

    #[test]
    fn a_variant_has_its_own_speed_and_process() {
        let (box_speed, pushed) = (read("kodak-portra-800").unwrap(), read("kodak-portra-800@push-1").unwrap());
        assert_eq!((box_speed.id(), pushed.id()), ("kodak-portra-800", "kodak-portra-800@push-1"));
        assert_eq!((box_speed.exposure_index(), pushed.exposure_index()), (Some(800.0), Some(1600.0)));
        assert!(pushed.process().contains("one stop") && pushed.sensitivity() == box_speed.sensitivity());
        assert_eq!(box_speed.variants().collect::<Vec<_>>(), ["push-1", "push-2"]);
        // The usual one by its name.
        assert_eq!(read("kodak-5222@6-min").unwrap().id(), "kodak-5222");
        let message = read("kodak-5222@7-min").unwrap_err().to_string();
        assert_eq!(message, "kodak-5222: no variant is called \"7-min\", expected 6-min, 4-min, 5-min, 9-min, 12-min");
        assert!(read("kodak-5207@x").unwrap_err().to_string().ends_with("expected none"));
    }

    #[test]
    fn a_sheet_says_of_silver_what_silver_has() {
        let f = onelight_stocks::find("kodak-5222").unwrap();
        let message = |from: &str, to: &str, dyes: &str| {
            let text = f.stock_toml.replacen(from, to, 1);
            Stock::parse(&SheetText {
                id: f.id,
                stock_toml: &text,
                sensitivity_csv: f.sensitivity_csv,
                characteristic_csv: f.characteristic_csv,
                dye_density_csv: dyes,
            })
            .unwrap_err()
            .to_string()
        };
        assert!(message("visual", "status-m", "").contains("go together"));
        assert!(message("\"silver\"", "\"dye\"", "").contains("go together"));
        assert!(message("negative", "reversal", "").contains("negative, print or paper"));
        assert!(message("4-min", "four minutes", "").contains("found \"four minutes\""));
        assert!(message("4-min", "6-min", "").contains("found \"6-min\""));
        assert!(message("4-min", "3-min", "wavelength_nm,cyan\n").contains("expected none for a picture in silver"));
    }
}
