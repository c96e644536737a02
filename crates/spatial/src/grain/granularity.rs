use nalgebra::{Matrix3, Vector3};
use onelight_film::{Density, DyeAmount, DyeDensitometer, Granularity, PerLayer, Stock, StockKind};
use onelight_spectra::SpectralShape;

use crate::error::{Error, ErrorKind};

/// Steps along the grey scale of the figure.
const STEPS: usize = 400;
/// Amounts nearer than this count as one.
const SAME_AMOUNT: f64 = 1e-4;

/// How far the amount of dye in each layer scatters over an aperture of 48 um, by amount: the sheet's granularity with the crosstalk of the
/// densitometer taken out.
///
/// Along the figure's grey scale the three densities give three amounts; the layers scatter independently, so that the variances of
/// densities are those of the amounts times the squares of the densitometer's slopes.
///
/// ```
/// use onelight_film::{PerLayer, SheetText, Stock};
/// use onelight_spatial::AmountGranularity;
/// # let f = onelight_stocks::find("kodak-5219").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
/// #     .with_figures(f.mtf_csv, f.granularity_csv)?;
/// let grain = AmountGranularity::of_stock(&stock)?;
/// let sigma = grain.sigma(PerLayer::all(0.2));
/// assert!(sigma.blue > 2.0 * sigma.green, "the blue layer is the coarsest: {sigma:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AmountGranularity {
    /// Amounts, increasing, and their variance over the aperture.
    layers: PerLayer<Vec<(f64, f64)>>,
}

impl AmountGranularity {
    /// From the granularity, dyes and densitometer of a stock.
    ///
    /// # Errors
    /// If the stock has no granularity of its own, no amounts of its dyes make the densities of the figure, or no scatter of its layers that of
    /// the figure.
    pub fn of_stock(stock: &Stock) -> Result<Self, Error> {
        let figure = stock.granularity()?;
        let reader = DyeDensitometer::new(&stock.dyes_on(SpectralShape::VISIBLE)?, stock.densitometry());
        let base = match stock.kind() {
            StockKind::Negative => reader.density(PerLayer::all(DyeAmount(0.0))).map(|d| d.0),
            _ => stock.characteristic().map(|curve| curve.d_min().0),
        };
        let refuse = |problem: String| ErrorKind::Granularity { stock: stock.id().to_owned(), problem };
        let ends = figure.map(Granularity::range).to_array();
        let from = ends.iter().map(|[first, _]| *first).fold(f64::NEG_INFINITY, f64::max);
        let to = ends.iter().map(|[_, last]| *last).fold(f64::INFINITY, f64::min);
        let mut found: [Vec<(f64, f64)>; 3] = Default::default();
        let mut amounts = PerLayer::all(DyeAmount(0.5));
        for step in 0..=STEPS {
            let h = from + (to - from) * step as f64 / STEPS as f64;
            let read = figure.map(|layer| layer.at(h));
            let target = read.zip_map(base, |(density, _), base| Density(density + base));
            amounts = reader.unmix(target, amounts).ok_or_else(|| {
                refuse(format!("no dye amounts give the densities at log exposure {h:.2} of its figure"))
            })?;
            let slope = Matrix3::from(reader.density_and_slope(amounts).1).transpose();
            let measured = Vector3::from(read.map(|(_, sigma)| sigma * sigma).to_array());
            let variance = slope.component_mul(&slope).lu().solve(&measured).filter(|v| v.iter().all(|v| *v >= 0.0));
            let variance = variance.ok_or_else(|| {
                refuse(format!("no scatter of its three layers gives that of its figure at log exposure {h:.2}"))
            })?;
            for ((layer, amount), variance) in found.iter_mut().zip(amounts.to_array()).zip(variance.iter()) {
                layer.push((amount.0, *variance));
            }
        }
        Ok(Self { layers: PerLayer::from(found).map(by_amount) })
    }

    /// Standard deviation of the amount in each layer over 48 um at these amounts: linear in variance between the figure's points, flat outside.
    #[must_use]
    pub fn sigma(&self, amounts: PerLayer<f64>) -> PerLayer<f64> {
        self.layers.as_ref().zip_map(amounts, |layer, amount| {
            let above = layer.partition_point(|(a, _)| *a <= amount);
            let [(a, v), (b, w)] = [layer[above.saturating_sub(1)], layer[above.min(layer.len() - 1)]];
            let t = if b > a { ((amount - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
            (v + t * (w - v)).sqrt()
        })
    }

    /// The amounts between which the figure says something, for each layer.
    #[must_use]
    pub fn range(&self) -> PerLayer<[f64; 2]> {
        self.layers.as_ref().map(|layer| [layer[0].0, layer[layer.len() - 1].0])
    }
}

/// In the order of amounts, with one variance, their mean, for amounts that are the same.
fn by_amount(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut merged: Vec<(f64, f64, f64)> = Vec::with_capacity(points.len());
    for (amount, variance) in points {
        match merged.last_mut() {
            Some((a, v, count)) if amount - *a / *count < SAME_AMOUNT => {
                (*a, *v, *count) = (*a + amount, *v + variance, *count + 1.0);
            }
            _ => merged.push((amount, variance, 1.0)),
        }
    }
    merged.into_iter().map(|(a, v, count)| (a / count, v / count)).collect()
}
