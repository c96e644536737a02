use onelight_film::PerLayer;

use super::{Decision, Effect};
use crate::chain::Finish;
use crate::frame::Frame;
use crate::grain::Grain;
use crate::grain::quadrature::normal_nodes;

/// Standard deviations below which grain is not seen: of L* and of b*.
const LEAST_LIGHTNESS: f64 = 0.3;
const LEAST_BLUE_YELLOW: f64 = 1.0;

/// Whether grain can be seen in greys of these amounts, such as those of -2 to +2 stops about mid grey. The picture is not looked at: grain is
/// where there is film.
///
/// It is left out where the standard deviation of a pixel's L* stays below 0.3 and that of its b* below 1 in all of them.
///
/// ```
/// # use onelight_film::{SheetText, Stock};
/// # use onelight_spatial::{AmountGranularity, FilmFormat, Frame, Grain, GrainSettings, Verdict, grain_decision};
/// # struct Screen;
/// # impl onelight_spatial::Finish for Screen {
/// #     fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3] { amounts.map(|a| 10f64.powf(-a)) }
/// #     fn lab(&self, [r, g, b]: [f64; 3]) -> [f64; 3] {
/// #         let [x, y, z] = [r, g, b].map(|v: f64| v.max(0.0).cbrt());
/// #         [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
/// #     }
/// #     fn difference(&self, _: [f64; 3], _: [f64; 3]) -> f64 { 0.0 }
/// # }
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
/// #     .with_figures(f.mtf_csv, f.granularity_csv)?;
/// let greys = [[0.2, 0.2, 0.25], [0.5, 0.6, 0.6], [0.8, 0.9, 0.95]];
/// let decide = |width| -> Result<_, onelight_spatial::Error> {
///     let frame = Frame::new([width, 100], FilmFormat::Still36.pitch(width, 1.0)?)?;
///     let grain = Grain::new(AmountGranularity::of_stock(&stock)?, frame.pitch(), GrainSettings::default())?;
///     Ok(grain_decision(&grain, &frame, &greys, &Screen).verdict())
/// };
/// assert_eq!(decide(4096)?, Verdict::Visible);
/// assert_eq!(decide(60)?, Verdict::NotVisible);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn grain_decision(grain: &Grain, frame: &Frame, greys: &[[f64; 3]], finish: &impl Finish) -> Decision {
    let (mut lightness, mut blue_yellow) = (0.0f64, 0.0f64);
    for grey in greys {
        let sigma = grain.sigma(PerLayer::from(*grey)).to_array();
        let (mut mean, mut square) = ([0.0; 3], [0.0; 3]);
        let amounts: Vec<[f64; 3]> =
            normal_nodes().map(|(z, _)| std::array::from_fn(|k| grey[k] + sigma[k] * z[k])).collect();
        for ((_, weight), light) in normal_nodes().zip(finish.display_linear_of(&amounts)) {
            let lab = finish.lab(light);
            for k in 0..3 {
                mean[k] += weight * lab[k];
                square[k] += weight * lab[k] * lab[k];
            }
        }
        let scatter = |k: usize| (square[k] - mean[k] * mean[k]).max(0.0).sqrt();
        lightness = lightness.max(scatter(0));
        blue_yellow = blue_yellow.max(scatter(2));
    }
    // Where no grey was given, nothing is known.
    let is_visible = greys.is_empty() || lightness >= LEAST_LIGHTNESS || blue_yellow >= LEAST_BLUE_YELLOW;
    Decision::new(Effect::Grain, is_visible, &format!("{lightness:.2} L*, {blue_yellow:.2} b*"), frame)
}
