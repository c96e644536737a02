use std::f64::consts::PI;

use onelight_film::{ModulationTransfer, PerLayer, Stock};

use crate::error::{Error, ErrorKind};
use crate::least_squares::minimise;

/// Standard deviations of the two Gaussians of scatter, in um.
const S1_UM: [f64; 2] = [0.3, 12.0];
const S2_UM: [f64; 2] = [0.3, 40.0];
/// Standard deviation of the Gaussian of adjacency, in um.
const SC_UM: [f64; 2] = [8.0, 120.0];
/// Strength of adjacency.
const K: [f64; 2] = [0.0, 1.5];
/// Weight of the strength among the residuals: of two fits that are as good, the one with less adjacency.
const RIDGE: f64 = 0.02;
/// Lowest published frequency must respond about as large areas do, or the curve is not scaled to them.
const LOWEST_RESPONSE: [f64; 2] = [0.85, 1.15];
/// Largest response that is believed.
const MAX_RESPONSE: f64 = 3.0;
/// A point that lies further from the fit makes the curve unusable.
const WORST: f64 = 0.06;

/// Modulation transfer of a layer, split into what happens to light and what happens to dye.
///
/// Response at f cycles per mm: `[w g(s1) + (1 - w) g(s2)] [1 + k (1 - g(sc))]` with `g(s) = exp(-2 pi^2 s^2 f^2)`, s in mm. The first factor is
/// light that scatters in the emulsion, the second developer that is used up and inhibitor that spreads (adjacency). Both are 1 at
/// frequency 0: large areas stay as the characteristic curve has them. Beyond the last published point the Gaussians go on.
///
/// ```
/// use onelight_spatial::MtfFit;
/// let blurred: Vec<(f64, f64)> = [5.0, 10.0, 20.0, 40.0, 60.0, 80.0]
///     .map(|f: f64| (f, (-2.0 * std::f64::consts::PI.powi(2) * 0.004f64.powi(2) * f * f).exp()))
///     .to_vec();
/// let fit = MtfFit::of_points(&blurred)?;
/// assert!((fit.response(30.0) - 0.753).abs() < 0.005);
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MtfFit {
    /// Share of the narrow Gaussian, 0 to 1.
    pub narrow_share: f64,
    /// Standard deviation of the narrow Gaussian of scatter, in um.
    pub narrow_um: f64,
    /// Standard deviation of the wide Gaussian of scatter, in um.
    pub wide_um: f64,
    /// Strength of adjacency: by how much fine detail gains contrast over large areas.
    pub adjacency: f64,
    /// Standard deviation of the Gaussian of adjacency, in um.
    pub adjacency_um: f64,
    /// Root of the mean squared distance from the published points, in response.
    pub rms: f64,
    /// Largest distance from a published point, in response.
    pub worst: f64,
}

impl MtfFit {
    /// The fit of each layer of a stock.
    ///
    /// # Errors
    /// If the stock has no modulation transfer of its own, or a curve is refused as by [`MtfFit::of_points`].
    pub fn of_stock(stock: &Stock) -> Result<PerLayer<Self>, Error> {
        stock.modulation_transfer()?.try_map(|curve: &ModulationTransfer, layer| {
            Self::of_layer(&curve.points().collect::<Vec<_>>(), stock.id(), layer)
        })
    }

    /// The fit to points of frequency (cycles per mm, increasing) and response.
    ///
    /// # Errors
    /// If there are fewer than 2 points, they are not in order or not numbers, the response at the lowest frequency is not between 0.85 and 1.15, or a point lies more than 0.06 from
    /// the best fit.
    pub fn of_points(points: &[(f64, f64)]) -> Result<Self, Error> {
        Self::of_layer(points, "curve", "only")
    }

    fn of_layer(points: &[(f64, f64)], stock: &str, layer: &'static str) -> Result<Self, Error> {
        let refuse = |problem: String| ErrorKind::ModulationTransfer { stock: stock.to_owned(), layer, problem };
        let [(lowest_f, lowest), _, ..] = points else {
            return Err(refuse(format!("found {} points, expected at least 2", points.len())).into());
        };
        let increase = points.windows(2).all(|pair| pair[0].0 < pair[1].0) && *lowest_f > 0.0;
        if !increase || !points.iter().all(|(f, r)| f.is_finite() && (0.0..=MAX_RESPONSE).contains(r)) {
            let expected =
                format!("expected frequencies that increase from above 0 and responses of 0 to {MAX_RESPONSE}");
            return Err(refuse(format!("found other numbers among its points, {expected}")).into());
        }
        let [low, high] = LOWEST_RESPONSE;
        if !(low..=high).contains(lowest) {
            let found = format!("found {lowest} at its lowest frequency, {lowest_f} cycles per mm");
            return Err(refuse(format!("{found}, expected {low} to {high}: 1 must stand for large areas")).into());
        }
        let fit = Self::best(points);
        if fit.worst > WORST {
            let found = format!("a point lies {:.3} from the best fit", fit.worst);
            return Err(
                refuse(format!("{found}, expected at most {WORST}: scatter and adjacency cannot make it")).into()
            );
        }
        Ok(fit)
    }

    fn best(points: &[(f64, f64)]) -> Self {
        let residuals = |p: &[f64]| {
            let fit = Self::of_parameters(p);
            let misses = points.iter().map(|(f, r)| fit.response(*f) - r);
            misses.chain([RIDGE * fit.adjacency]).collect::<Vec<f64>>()
        };
        let log = |[low, high]: [f64; 2]| [low.ln(), high.ln()];
        let bounds = [[0.0, 1.0], log(S1_UM), log(S2_UM), K, log(SC_UM)];
        let mut best = (f64::INFINITY, Vec::new());
        for narrow in [0.25f64, 0.6] {
            for [s1, s2] in [[1.5f64, 6.0f64], [3.0, 10.0], [4.0, 25.0]] {
                for sc in [10.0f64, 20.0, 45.0, 100.0] {
                    let (p, cost) = minimise(residuals, &[narrow, s1.ln(), s2.ln(), 0.15, sc.ln()], &bounds);
                    if cost < best.0 {
                        best = (cost, p);
                    }
                }
            }
        }
        let fit = Self::of_parameters(&best.1);
        let misses = || points.iter().map(|(f, r)| (fit.response(*f) - r).abs());
        let rms = (misses().map(|m| m * m).sum::<f64>() / points.len() as f64).sqrt();
        Self { rms, worst: misses().fold(0.0, f64::max), ..fit }
    }

    fn of_parameters(p: &[f64]) -> Self {
        let [w, s1, s2, k, sc] = [p[0], p[1].exp(), p[2].exp(), p[3], p[4].exp()];
        let (narrow_share, narrow_um, wide_um) = if s1 <= s2 { (w, s1, s2) } else { (1.0 - w, s2, s1) };
        Self { narrow_share, narrow_um, wide_um, adjacency: k, adjacency_um: sc, rms: 0.0, worst: 0.0 }
    }

    /// Response to a sine wave of so many cycles per mm on the film, 1 for large areas.
    #[must_use]
    pub fn response(&self, cycles_per_mm: f64) -> f64 {
        let g = |um: f64| gaussian_response(um / 1000.0 * cycles_per_mm);
        let scatter = self.narrow_share * g(self.narrow_um) + (1.0 - self.narrow_share) * g(self.wide_um);
        scatter * (1.0 + self.adjacency * (1.0 - g(self.adjacency_um)))
    }
}

/// Response of a Gaussian at so many cycles per standard deviation.
pub(crate) fn gaussian_response(cycles: f64) -> f64 {
    (-2.0 * (PI * cycles).powi(2)).exp()
}
