use crate::error::Error;
use crate::layer::PerLayer;
use crate::table::NumberTable;

/// Largest published granularity that is believed, in thousandths of density.
const MAX_SIGMA_X1000: f64 = 500.0;

/// Diffuse rms granularity of one layer, as published: how far densities, read over a circular aperture of 48 um, scatter about
/// their mean, along the grey scale of the figure it was read from.
///
/// ```
/// use onelight_film::{Granularity, NumberTable, PerLayer};
/// let text = "log10_exposure,red_density,red_sigma_x1000,green_density,green_sigma_x1000,blue_density,blue_sigma_x1000\n\
///             0,0.2,5,0.6,6,0.9,9\n1,0.7,9,1.2,10,1.5,20\n";
/// let table = NumberTable::parse("mine/granularity.csv", text)?;
/// let red = Granularity::read(&table, PerLayer { red: 0.2, green: 0.6, blue: 0.9 })?.red;
/// let (density_above_d_min, sigma) = red.at(0.5);
/// assert!((density_above_d_min - 0.25).abs() < 1e-12 && (sigma - 0.007).abs() < 1e-12);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Granularity {
    log_exposure: Vec<f64>,
    density_above_d_min: Vec<f64>,
    sigma: Vec<f64>,
}

impl Granularity {
    /// Diameter of the aperture over which the scatter of densities is published, in um.
    pub const APERTURE_UM: f64 = 48.0;

    /// Reads `granularity.csv`: `log10_exposure` on the figure's own axis, and for each layer `red_density` (base included, of the curve
    /// in the same figure) and `red_sigma_x1000`. `d_min` is the lowest density of each curve in that figure, which is another plot than
    /// the characteristic curves.
    ///
    /// # Errors
    /// If a column is missing, exposures do not increase, a layer has fewer than two points or a density without its granularity, or a
    /// number is out of range.
    pub fn read(table: &NumberTable, d_min: PerLayer<f64>) -> Result<PerLayer<Self>, Error> {
        d_min.try_map(|d_min, layer| {
            let density = table.points("log10_exposure", &format!("{layer}_density"))?;
            let name = format!("{layer}_sigma_x1000");
            let sigma = table.points("log10_exposure", &name)?;
            if density.x != sigma.x {
                let problem =
                    format!("{name} and {layer}_density are not given in the same rows, expected both or neither");
                return Err(table.problem(1, problem));
            }
            if let Some(found) = sigma.y.iter().find(|s| !(0.0..=MAX_SIGMA_X1000).contains(*s)) {
                return Err(table.problem(1, format!("{name}: found {found}, expected 0 to {MAX_SIGMA_X1000}")));
            }
            Ok(Self {
                log_exposure: density.x,
                density_above_d_min: density.y.iter().map(|d| d - d_min).collect(),
                sigma: sigma.y.iter().map(|s| s / 1000.0).collect(),
            })
        })
    }

    /// From the first published log exposure to the last, on the figure's own axis.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.log_exposure[0], self.log_exposure[self.log_exposure.len() - 1]]
    }

    /// Density above the figure's D-min, and the standard deviation of density over [`Granularity::APERTURE_UM`], at a log exposure of
    /// the figure's axis: linear between the points, flat outside.
    #[must_use]
    pub fn at(&self, log_exposure: f64) -> (f64, f64) {
        let x = &self.log_exposure;
        let above = x.partition_point(|&h| h <= log_exposure);
        let (i, j) = (above.saturating_sub(1), above.min(x.len() - 1));
        let t = if j > i { ((log_exposure - x[i]) / (x[j] - x[i])).clamp(0.0, 1.0) } else { 0.0 };
        let between = |y: &[f64]| y[i] + t * (y[j] - y[i]);
        (between(&self.density_above_d_min), between(&self.sigma))
    }
}
