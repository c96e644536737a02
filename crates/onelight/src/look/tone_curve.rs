use onelight_film::{CharacteristicCurve, Density, LogExposure, Stock};
use onelight_spectra::{Pchip, TransferCurve};

use crate::error::{Error, ErrorKind};

/// The tone-curve texture of the first approach: what one channel shows over its exposure, gamma-corrected (sRGB-coded).
///
/// A table over log10 exposure about that of mid grey, linear between its texels, held beyond its ends.
///
/// ```
/// use onelight::{ToneCurve, stock};
/// let film = stock("fuji-velvia-50")?;
/// let curve = ToneCurve::reversal(&film, "green", film.characteristic().green, 0.7)?;
/// assert!(curve.at(0.3) > curve.at(0.0) && curve.at(0.0) > curve.at(-0.3));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ToneCurve {
    first: f64,
    step: f64,
    texels: Vec<f64>,
}

/// The numbers of a [`ToneCurve`], as a texture takes them.
///
/// ```
/// use onelight::{Look, Process, FirstProcess};
/// let Look::First(first) = Process::from(FirstProcess::default()).look()? else { return Ok(()) };
/// let texels = first.tone_curves().green.texels();
/// assert!(texels.first < 0.0 && texels.last > 0.0 && texels.values.len() == 512);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texels<'a> {
    /// Display-coded values at equal steps of log10 exposure.
    pub values: &'a [f64],
    /// log10 exposure of the first value, about that of mid grey.
    pub first: f64,
    /// log10 exposure of the last value.
    pub last: f64,
}

/// Texels of a curve: its error is below 0.008 dE.
const TEXELS: usize = 512;
/// More points than an edit needs.
const MAX_POINTS: usize = 16;

impl ToneCurve {
    /// Of a reversal film's layer: its transmittance 10^-D, mid grey where the curve has `density`.
    ///
    /// # Errors
    /// If the curve does not reach the density.
    pub fn reversal(
        stock: &Stock,
        layer: &'static str,
        curve: &CharacteristicCurve,
        density: f64,
    ) -> Result<Self, Error> {
        let grey = reached(stock, layer, curve, density)?;
        Ok(Self::of(curve, grey, |h| curve.density(h).0))
    }

    /// Of a negative's layer and the print's: the print is exposed by log H = H(`density`) - (D - D at mid grey). Taking the
    /// density of mid grey off is what removes the orange of the negative.
    ///
    /// # Errors
    /// If the print does not reach the density.
    pub fn printed(
        negative: &Stock,
        curve: &CharacteristicCurve,
        print: &Stock,
        layer: &'static str,
        print_curve: &CharacteristicCurve,
        density: f64,
    ) -> Result<Self, Error> {
        let (grey, print_grey) = (negative.mid_grey()?, reached(print, layer, print_curve, density)?);
        let orange = curve.density(grey).0;
        let through = |h| print_curve.density(LogExposure(print_grey.0 - (curve.density(h).0 - orange))).0;
        Ok(Self::of(curve, grey, through))
    }

    fn of(curve: &CharacteristicCurve, grey: LogExposure, density: impl Fn(LogExposure) -> f64) -> Self {
        let (from, to) = curve.range().into_inner();
        let (first, step) = (from.0 - grey.0, (to.0 - from.0) / (TEXELS - 1) as f64);
        let texel = |i: usize| {
            let density = density(LogExposure(from.0 + step * i as f64));
            TransferCurve::Srgb.encode(10f64.powf(-density))
        };
        Self { first, step, texels: (0..TEXELS).map(texel).collect() }
    }

    /// The coded value for a log10 exposure about that of mid grey.
    #[must_use]
    pub fn at(&self, log_exposure: f64) -> f64 {
        let place = ((log_exposure - self.first) / self.step).clamp(0.0, (self.texels.len() - 1) as f64);
        let low = (place as usize).min(self.texels.len() - 2);
        let part = place - low as f64;
        self.texels[low] * (1.0 - part) + self.texels[low + 1] * part
    }

    /// The curve's numbers and where they stand.
    #[must_use]
    pub fn texels(&self) -> Texels<'_> {
        let last = self.first + self.step * (self.texels.len() - 1) as f64;
        Texels { values: &self.texels, first: self.first, last }
    }

    /// The curve bent through points (stops about mid grey, coded value): values between two points move smoothly with them,
    /// the darkest and the brightest stay.
    ///
    /// # Errors
    /// If the points are too many, out of order, where the curve is flat, or not between its darkest and brightest value.
    pub fn edited(&self, points: &[[f64; 2]]) -> Result<Self, Error> {
        if points.is_empty() {
            return Ok(self.clone());
        }
        let refuse =
            |found: String, expected: String| Error::from(ErrorKind::Word { what: "first.curve", found, expected });
        if points.len() > MAX_POINTS {
            return Err(refuse(format!("{} points", points.len()), format!("at most {MAX_POINTS}")));
        }
        let (darkest, brightest) = (self.texels[0], self.texels[self.texels.len() - 1]);
        // From the film's own value to the one wanted.
        let mut nodes = vec![(darkest, darkest)];
        for [stops, value] in points.iter().copied() {
            let shown = format!("{stops} stops, {value}");
            let (own, (last_own, last)) = (self.at(stops * std::f64::consts::LOG10_2), nodes[nodes.len() - 1]);
            if !(own > last_own && own < brightest) {
                return Err(refuse(shown, "stops that increase, where the film's curve rises".to_owned()));
            }
            if !(value >= last && value <= brightest) {
                return Err(refuse(shown, format!("values that rise from {darkest:.3} to {brightest:.3}")));
            }
            nodes.push((own, value));
        }
        nodes.push((brightest, brightest));
        let (x, y) = nodes.into_iter().unzip();
        let bend = Pchip::new(x, y)?;
        Ok(Self { texels: self.texels.iter().map(|v| bend.at(*v)).collect(), ..*self })
    }
}

fn reached(
    stock: &Stock,
    layer: &'static str,
    curve: &CharacteristicCurve,
    density: f64,
) -> Result<LogExposure, Error> {
    curve.log_exposure(Density(density)).ok_or_else(|| {
        let kind = if stock.kind().is_camera_film() { "film" } else { "print" };
        let sentence = format!(
            "{}: grey of density {density} is beyond the {layer} layer of this {kind}, expected {:.3} to {:.3}",
            stock.id(),
            curve.d_min().0,
            curve.d_max().0
        );
        ErrorKind::Unreachable(sentence).into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stocks::stock;

    fn velvia() -> ToneCurve {
        let film = stock("fuji-velvia-50").unwrap();
        ToneCurve::reversal(&film, "green", film.characteristic().green, 0.7).unwrap()
    }

    #[test]
    fn a_texture_is_its_curve() {
        let film = stock("fuji-velvia-50").unwrap();
        let curve = film.characteristic().green;
        let grey = curve.log_exposure(Density(0.7)).unwrap();
        for i in -60..=60 {
            let offset = f64::from(i) / 20.0;
            let exact = TransferCurve::Srgb.encode(10f64.powf(-curve.density(LogExposure(grey.0 + offset)).0));
            assert!((velvia().at(offset) - exact).abs() < 3e-4, "{offset}");
        }
        assert!((velvia().at(-99.0) - TransferCurve::Srgb.encode(10f64.powf(-curve.d_max().0))).abs() < 1e-9);
    }

    #[test]
    fn an_edit_goes_through_its_points_and_leaves_the_ends() {
        let plain = velvia();
        let points = [[-2.0, 0.2], [0.0, 0.55], [1.0, 0.8]];
        let bent = plain.edited(&points).unwrap();
        for [stops, value] in points {
            assert!((bent.at(stops * 2f64.log10()) - value).abs() < 2e-3, "{stops}");
        }
        assert_eq!((bent.at(-99.0), bent.at(99.0)), (plain.at(-99.0), plain.at(99.0)));
        assert_eq!(plain.edited(&[]).unwrap(), plain);
    }

    #[test]
    fn edits_that_make_no_curve_are_named() {
        let message = |points: &[[f64; 2]]| velvia().edited(points).unwrap_err().to_string();
        assert!(message(&[[0.0, 0.7], [1.0, 0.2]]).contains("values that rise"));
        assert!(message(&[[1.0, 0.5], [0.0, 0.6]]).contains("stops that increase"));
        assert!(message(&[[0.0, 1.5]]).contains("values that rise"));
        assert!(message(&[[99.0, 0.5]]).contains("curve rises"));
        assert!(
            message(&[[f64::NAN, 0.5]]).contains("stops that") && message(&[[0.0, f64::NAN]]).contains("values that")
        );
        assert!(message(&[[0.0, 0.5]; 17]).contains("at most 16"));
    }

    #[test]
    fn an_edited_curve_never_falls() {
        for points in [&[[0.0, 0.8]][..], &[[-3.0, 0.1], [-1.0, 0.1], [2.0, 0.84]], &[[1.0, 0.06]]] {
            let bent = velvia().edited(points).unwrap();
            assert!(bent.texels().values.windows(2).all(|pair| pair[1] >= pair[0]), "{points:?}");
        }
    }
}
