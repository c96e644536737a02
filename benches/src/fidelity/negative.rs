//! What a densitometer reads off a colour negative: chroma slopes, separation gammas.

use onelight::film::{AmountCurve, DyeDensitometer, LogExposure, PerLayer, Tail};
use onelight::spectra::{Kelvin, MID_GREY, SpectralShape, black_body, color_checker};
use onelight::{FilmProcess, InterImage, InterImageChoice, Reference, stock};

use crate::error::Result;

/// Sunlight in which the measured frames were taken.
const SUN_K: f64 = 5400.0;
/// A grey scale like that of the target of the measured frames: from density 2.5 under white to white, about a grey card, in log10.
const SCALE: (f64, f64) = (-1.8, 0.7);
const SCALE_STEP: f64 = 0.005;

/// A film, exposed in light of its balance, and the densitometer of its sheet.
pub(super) struct Negative {
    reference: Reference,
    reader: DyeDensitometer,
    /// Of the chart's patches, log10 over a grey card's, in [`SUN_K`] light.
    chart: Vec<PerLayer<f64>>,
}

/// Slopes of R - G and of B - G: 1 where each layer records alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChromaSlopes {
    pub(super) red_green: f64,
    pub(super) blue_green: f64,
}

impl Negative {
    pub(super) fn new(id: &str, inter_image: InterImageChoice) -> Result<Self> {
        let film = stock(id)?;
        let sun = black_body(Kelvin::new(SUN_K)?, SpectralShape::VISIBLE);
        let layers = film.sensitivity().try_map(|s, _| s.on(SpectralShape::VISIBLE, Tail::LogLinear))?;
        let grey = layers.as_ref().map(|layer| MID_GREY * sun.response(layer));
        let chart = color_checker().iter().map(|patch| {
            let light = sun.reflected_by(&patch.reflectance);
            layers.as_ref().zip_map(grey, |layer, grey| (light.response(layer) / grey).log10())
        });
        Ok(Self {
            chart: chart.collect(),
            reader: DyeDensitometer::new(&film.dyes_on(SpectralShape::VISIBLE)?, film.densitometry()),
            reference: FilmProcess { inter_image, ..FilmProcess::for_camera(id)? }.compile()?,
        })
    }

    /// Densities for log10 exposures over a grey card's.
    fn densities(&self, offsets: PerLayer<f64>) -> PerLayer<f64> {
        let h = self.reference.mid_grey().zip_map(offsets, |grey, offset| LogExposure(grey.0 + offset));
        let effective = self.reference.inter_image().effective(h);
        let amounts = self.reference.camera_curves().zip_map(effective, AmountCurve::amount);
        self.reader.density(amounts).map(|density| density.0)
    }

    /// Least-squares slopes through 0 of the differences between layers' equivalent neutral exposures over those of their
    /// exposures; of the patches within the grey scale in all layers.
    pub(super) fn chroma_slopes(&self, stops: f64) -> ChromaSlopes {
        let over = stops * std::f64::consts::LOG10_2;
        let steps = ((SCALE.1 - SCALE.0) / SCALE_STEP).round() as usize;
        let scale: Vec<(f64, [f64; 3])> = (0..=steps)
            .map(|i| SCALE.0 + i as f64 * SCALE_STEP + over)
            .map(|offset| (offset, self.densities(PerLayer::all(offset)).to_array()))
            .collect();
        let (mut products, mut squares) = ([0.0; 2], [0.0; 2]);
        for patch in &self.chart {
            let read = self.densities(patch.map(|h| h + over)).to_array();
            let [Some(red), Some(green), Some(blue)] =
                std::array::from_fn(|layer| read_back(&scale, layer, read[layer]))
            else {
                continue;
            };
            let pairs = [(red - green, patch.red - patch.green), (blue - green, patch.blue - patch.green)];
            for (i, (measured, exposed)) in pairs.into_iter().enumerate() {
                products[i] += measured * exposed;
                squares[i] += exposed * exposed;
            }
        }
        ChromaSlopes { red_green: products[0] / squares[0], blue_green: products[1] / squares[1] }
    }

    /// By which part of itself the slope of each layer's density at a grey card exceeds that of greys, where only that layer's
    /// exposure changes.
    pub(super) fn separation_over_neutral(&self) -> [f64; 3] {
        const STEP: f64 = 0.01;
        let slope = |of: [f64; 3], layer: usize| {
            let [up, down] = [1.0, -1.0].map(|sign| self.densities(PerLayer::from(of.map(|v| v * sign * STEP))));
            up.to_array()[layer] - down.to_array()[layer]
        };
        std::array::from_fn(|layer| {
            let mut alone = [0.0; 3];
            alone[layer] = 1.0;
            slope(alone, layer) / slope([1.0; 3], layer) - 1.0
        })
    }
}

/// The grey that has this density in a layer; `None` beyond the scale.
fn read_back(scale: &[(f64, [f64; 3])], layer: usize, density: f64) -> Option<f64> {
    scale.windows(2).find_map(|pair| {
        let [(from, a), (to, b)] = [pair[0], pair[1]];
        let (a, b) = (a[layer], b[layer]);
        (a <= density && density <= b && b > a).then(|| from + (to - from) * (density - a) / (b - a))
    })
}

/// A film whose layers develop each by itself.
pub(super) const ALONE: InterImageChoice = InterImageChoice::Fixed(InterImage::NONE);

#[cfg(test)]
mod tests {
    use super::*;

    /// Without an inter-image effect layers differ from 1 only by the overlap of dyes and filters: what is measured is that the
    /// greys themselves are read back as they are.
    #[test]
    fn greys_are_read_back_as_they_were_exposed() {
        let film = Negative::new("kodak-portra-400", InterImageChoice::Film).unwrap();
        let scale: Vec<_> = (-300..=100)
            .map(|i| f64::from(i) / 100.0)
            .map(|h| (h, film.densities(PerLayer::all(h)).to_array()))
            .collect();
        for h in [-1.234, 0.0, 0.555] {
            let read = film.densities(PerLayer::all(h)).to_array();
            for (layer, density) in read.into_iter().enumerate() {
                assert!((read_back(&scale, layer, density).unwrap() - h).abs() < 1e-3, "layer {layer} at {h}");
            }
        }
        assert_eq!(read_back(&scale, 0, 99.0), None);
    }

    /// The law that the measured figures follow: colours grow purer with exposure, and layers alone lie below 1.
    #[test]
    fn inter_image_effects_raise_separations_over_neutrals() {
        let with = Negative::new("kodak-5207", InterImageChoice::Film).unwrap().separation_over_neutral();
        let without = Negative::new("kodak-5207", ALONE).unwrap().separation_over_neutral();
        assert!(with.iter().all(|v| *v > 0.0) && without.iter().all(|v| *v < 0.0), "{with:?} {without:?}");
    }
}
