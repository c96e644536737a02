//! A negative printed on 2383: what comes before and after the effects.

use onelight_film::{AmountCurve, DyeAmount, DyeModel, LogExposure, PerLayer, SheetText, Stock};
use onelight_printing::{
    Aim, Duplication, EquivalentNeutralDensity, LitDuplication, Printer, Projection, Projector, print_mid_grey,
    print_target,
};
use onelight_spatial::Finish;
use onelight_spectra::{DisplayDifference, DisplayLinear, RgbSpace, SpectralShape};

pub(crate) fn stock(id: &str) -> Stock {
    let f = onelight_stocks::find(id).unwrap();
    let text = SheetText {
        id: f.id,
        stock_toml: f.stock_toml,
        sensitivity_csv: f.sensitivity_csv,
        characteristic_csv: f.characteristic_csv,
        dye_density_csv: f.dye_density_csv,
    };
    Stock::parse(&text).unwrap().with_figures(f.mtf_csv, f.granularity_csv).unwrap()
}

pub(crate) fn reference() -> serde_json::Value {
    serde_json::from_str(include_str!("../reference.json")).unwrap()
}

pub(crate) struct Film {
    pub(crate) stock: Stock,
    pub(crate) curves: PerLayer<AmountCurve>,
    pub(crate) mid_grey: LogExposure,
    printer: LitDuplication,
    print: PerLayer<AmountCurve>,
    projection: Projection,
    difference: DisplayDifference,
}

impl Film {
    pub(crate) fn new(id: &str) -> Self {
        let (negative, print) = (stock(id), stock("kodak-2383"));
        let mid_grey = negative.mid_grey().unwrap();
        let curves = DyeModel::Wedge.amounts(&negative, PerLayer::all(mid_grey)).unwrap();
        let print_curves = DyeModel::Wedge.amounts(&print, print_mid_grey(&print).unwrap()).unwrap();
        let dyes = print.dyes_on(SpectralShape::VISIBLE).unwrap();
        let projection = Projection::new(dyes, Projector::Display, &RgbSpace::SRGB).unwrap();
        let grey = curves.as_ref().map(|curve| curve.amount(mid_grey));
        let density = EquivalentNeutralDensity::default();
        let target = print_target(Aim::Neutral, density, &print, print_curves.as_ref(), &projection).unwrap();
        let printer = Duplication::new(&negative, &print, Printer::default()).unwrap();
        let printer = printer.lit(printer.calibrate(grey, target).unwrap());
        let difference = DisplayDifference::new(&RgbSpace::SRGB).unwrap();
        Self { stock: negative, curves, mid_grey, printer, print: print_curves, projection, difference }
    }

    /// The amounts of a grey so many stops above mid grey.
    pub(crate) fn grey(&self, stops: f64) -> [f64; 3] {
        let h = LogExposure(self.mid_grey.0 + stops * std::f64::consts::LOG10_2);
        self.curves.as_ref().map(|curve| curve.amount(h).0).to_array()
    }

    pub(crate) fn greys(&self) -> Vec<[f64; 3]> {
        (-28..=36).map(|i| self.grey(f64::from(i) * 0.25)).collect()
    }

    /// A pixel's amounts by its exposure, 1 at mid grey.
    pub(crate) fn develop(&self, exposure: [f32; 3]) -> [f32; 3] {
        let h = PerLayer::from(exposure).map(|e| LogExposure(LogExposure::of(f64::from(e)).0 + self.mid_grey.0));
        self.curves.as_ref().zip_map(h, |curve, h| curve.amount(h).0 as f32).to_array()
    }
}

impl Finish for Film {
    fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3] {
        let exposure = self.printer.expose(PerLayer::from(amounts).map(DyeAmount));
        *self.projection.rgb(self.print.as_ref().zip_map(exposure, AmountCurve::amount))
    }

    fn lab(&self, display_linear: [f64; 3]) -> [f64; 3] {
        self.difference.lab(DisplayLinear(display_linear))
    }

    fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        self.difference.between(DisplayLinear(a), DisplayLinear(b))
    }
}
