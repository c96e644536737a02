//! Figures that stand in for what a sheet does not show are made again and compared with the stock files.

use onelight::film::{AimDensities, Densitometry, DyeDensity, Origin, PerLayer};
use onelight::printing::Projection;
use onelight::spectra::{RgbSpace, SpectralShape};
use onelight::{Projector, StockKind, stock, stock_ids};

/// Aims are written with three decimals.
const AIM_TOLERANCE: f64 = 5.1e-4;
/// Densities are written with four decimals; a product of two of them misses by less than this.
const DYE_TOLERANCE: f64 = 2e-4;

#[test]
fn derived_aims_are_the_visual_neutral_of_density_1() {
    let mut count = 0;
    for id in stock_ids() {
        let print = stock(id).unwrap();
        let Some(AimDensities { status_a: aim, origin: Origin::Derived }) = print.aim() else { continue };
        let dyes = print.dyes_on(SpectralShape::VISIBLE).unwrap();
        let projection = Projection::new(dyes.clone(), Projector::Display, &RgbSpace::SRGB).unwrap();
        let amounts = projection.neutral_amounts(1.0, id).unwrap();
        let made = Densitometry::StatusA.density(&dyes.density(amounts).transmittance());
        for (written, made) in aim.to_array().into_iter().zip(made.to_array()) {
            assert!((written.0 - made.0).abs() <= AIM_TOLERANCE, "{id}: aim {aim:?}, made again {made:?}");
        }
        count += 1;
    }
    assert_eq!(count, 2, "3513DI and 3523XD");
}

/// Cyan, magenta and yellow of kodak-5219 in the dyes of a stock without its own.
const STAND_INS: [(&str, [f64; 3]); 5] = [
    ("kodak-portra-160", [0.816, 0.644, 0.959]),
    ("kodak-portra-400", [0.900, 0.783, 1.062]),
    ("kodak-ektar-100", [0.916, 0.776, 1.214]),
    ("kodak-gold-200", [0.755, 0.683, 0.857]),
    ("fuji-eterna-500", [0.557, 0.596, 0.632]),
];

#[test]
fn derived_dyes_are_those_of_5219_fitted_to_the_neutral() {
    let model = stock("kodak-5219").unwrap();
    for id in stock_ids().filter(|id| stock(id).unwrap().derived().contains(&"dyes")) {
        let film = stock(id).unwrap();
        assert_eq!(film.kind(), StockKind::Negative);
        let (_, scale) = STAND_INS.into_iter().find(|(name, _)| *name == id).unwrap();
        let (neutral, d_min) = (film.neutral().unwrap(), film.d_min().unwrap());
        let in_range = |curve: &DyeDensity, nm: f64| curve.wavelengths_nm().contains(&nm);
        for &nm in model.dyes().red.wavelengths_nm() {
            let scaled = model.dyes().zip_map(PerLayer::from(scale), |dye, s| dye.at(nm) * s);
            let sum: f64 = scaled.to_array().iter().sum();
            let fitted = (400.0..=700.0).contains(&nm) && in_range(neutral, nm) && in_range(d_min, nm);
            // Eterna's D-min was lowered after the fit; the fit is to the published one.
            let lowered = if id == "fuji-eterna-500" { 0.10 / (1.0 + ((nm - 500.0) / 8.0).exp()) } else { 0.0 };
            let ratio = if fitted { (neutral.at(nm) - d_min.at(nm) - lowered) / sum } else { 1.0 };
            for (dye, expected) in film.dyes().to_array().into_iter().zip(scaled.to_array()) {
                let miss = (dye.at(nm) - expected * ratio).abs();
                assert!(miss <= DYE_TOLERANCE, "{id} at {nm} nm: {} against {}", dye.at(nm), expected * ratio);
            }
        }
    }
}
