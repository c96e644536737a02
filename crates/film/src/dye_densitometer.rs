use std::f64::consts::LN_10;

use nalgebra::{Matrix3, Vector3};
use onelight_spectra::SpectralDistribution;

use crate::densitometry::Densitometry;
use crate::dye::Dyes;
use crate::layer::PerLayer;
use crate::quantity::{Density, DyeAmount};

/// Newton's method ends when the densities are met this closely.
const DENSITY_TOLERANCE: f64 = 1e-11;
const MAX_ITERATIONS: usize = 60;

/// A densitometer that reads a film of three dyes: amounts of dye to densities, their slopes, and back.
///
/// ```
/// use onelight_film::{Density, DyeAmount, DyeDensitometer, PerLayer, SheetText, Stock};
/// use onelight_spectra::SpectralShape;
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?;
/// let reader = DyeDensitometer::new(&stock.dyes_on(SpectralShape::VISIBLE)?, stock.densitometry());
/// let amounts = PerLayer { red: 0.5, green: 0.4, blue: 0.6 }.map(DyeAmount);
/// let read = reader.density(amounts);
/// let found = reader.unmix(read, PerLayer::all(DyeAmount(0.0))).ok_or("no amounts")?;
/// assert!((found.green.0 - 0.4).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct DyeDensitometer {
    /// Per wavelength: the three unit densities, the base, the three responses.
    rows: Vec<([f64; 3], f64, [f64; 3])>,
}

impl DyeDensitometer {
    /// For these dyes, with their base where they have one, on their own wavelengths.
    #[must_use]
    pub fn new(dyes: &Dyes, densitometry: Densitometry) -> Self {
        let [c, m, y] = dyes.dyes().map(SpectralDistribution::values).to_array();
        let [r, g, b] = densitometry.responses().as_ref().map(SpectralDistribution::values).to_array();
        let base = |i: usize| dyes.d_min().map_or(0.0, |d| d.values()[i]);
        let rows = (0..c.len()).map(|i| ([c[i], m[i], y[i]], base(i), [r[i], g[i], b[i]]));
        Self { rows: rows.filter(|(_, _, response)| response.iter().any(|&v| v > 0.0)).collect() }
    }

    /// What it reads off a film that holds these amounts.
    #[must_use]
    pub fn density(&self, amounts: PerLayer<DyeAmount>) -> PerLayer<Density> {
        self.density_and_slope(amounts).0
    }

    /// The densities, and how each of them (row) grows with the amount of each dye (column: cyan, magenta, yellow).
    #[must_use]
    pub fn density_and_slope(&self, amounts: PerLayer<DyeAmount>) -> (PerLayer<Density>, [[f64; 3]; 3]) {
        let (density, slope) = self.read(Vector3::from(amounts.map(|a| a.0).to_array()));
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| slope[(i, j)]));
        (PerLayer::from(<[f64; 3]>::from(density)).map(Density), rows)
    }

    /// The amounts that give these densities, looked for from `start`; `None` if none are found.
    #[must_use]
    pub fn unmix(&self, target: PerLayer<Density>, start: PerLayer<DyeAmount>) -> Option<PerLayer<DyeAmount>> {
        let target = Vector3::from(target.map(|d| d.0).to_array());
        let mut amount = Vector3::from(start.map(|a| a.0).to_array());
        for _ in 0..MAX_ITERATIONS {
            let (density, slope) = self.read(amount);
            let miss = density - target;
            if miss.amax() < DENSITY_TOLERANCE {
                return Some(PerLayer::from(<[f64; 3]>::from(amount)).map(DyeAmount));
            }
            // Far steps overshoot where one dye hides another.
            let step = slope.lu().solve(&miss)?;
            amount -= step * (1.0 / step.amax()).min(1.0);
            if !amount.iter().all(|a| a.is_finite()) {
                return None;
            }
        }
        None
    }

    fn read(&self, amount: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let (mut passed, mut weighted) = (Vector3::zeros(), Matrix3::zeros());
        for (dye, base, response) in &self.rows {
            let dye = Vector3::from(*dye);
            let light = Vector3::from(*response) * (-LN_10 * (base + dye.dot(&amount))).exp();
            passed += light;
            weighted += light * dye.transpose();
        }
        let slope = Matrix3::from_fn(|i, j| weighted[(i, j)] / passed[i]);
        (passed.map(|p: f64| -p.log10()), slope)
    }
}
