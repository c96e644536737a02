use onelight_film::{
    AmountCurve, Densitometry, Density, Direction, DyeAmount, Dyes, Image, PerLayer, Stock, StockKind,
};
use onelight_spectra::{DisplayLinear, SpectralDistribution, SpectralShape};

use crate::aim::EquivalentNeutralDensity;
use crate::error::{Error, ErrorKind, expect_kind};
use crate::spectral_row::SpectralRow;

/// The rule by which densities of a scanned negative become light.
///
/// ```
/// use onelight_printing::ScanRule;
/// assert_eq!(ScanRule::default(), ScanRule::Cineon);
/// assert!(ScanRule::Cineon.assumption().contains("gamma of 0.6"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ScanRule {
    /// That of the Cineon system (\[Kennel1995\]), as [`Scan`] has it.
    #[default]
    Cineon,
}

impl ScanRule {
    /// What the rule takes for granted, in a sentence without its end.
    #[must_use]
    pub fn assumption(self) -> &'static str {
        match self {
            Self::Cineon => {
                "densities above the film's base are taken for the logarithm of light by the Cineon system's gamma of 0.6, and grey is balanced; \
                 the curves that scanners and their programs add are not published"
            }
        }
    }
}

/// The highest density above a film's base that a scan tells from higher ones.
const DENSITY_MAX: f64 = 4.0;
/// Gamma that a scanner takes negatives to have: the Cineon system's, for all camera films and all three layers
/// (\[Kennel1995\]).
const SCAN_GAMMA: f64 = 0.6;

/// A scan of a negative turned into a picture: the third way beside print film and paper, without either's curves and dyes.
///
/// The rule is that of the Cineon system (\[Kennel1995\]): densities above the film's base are taken for the logarithm of light, by one
/// gamma of 0.6 for every film and layer, and the clear base for black,
/// `light = (10^((D - D_base) / 0.6) - 1) / (10^((D_grey - D_base) / 0.6) - 1) * grey`.
/// Densities are status M (\[ISO5-3\]), of black and white visual ones. Each channel is balanced so that a grey card is neutral at the
/// density asked for; where the Cineon system has its white does not matter then. Channels are taken for the display's own, by sRGB
/// primaries, as scanner programs do; light above 1 is kept, up to that of a density of 4 above the base.
///
/// ```
/// use onelight_film::{DyeModel, LogExposure, PerLayer, SheetText, Stock};
/// use onelight_printing::{EquivalentNeutralDensity, Scan};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let negative = read("kodak-portra-400")?;
/// let card = PerLayer::all(negative.mid_grey()?);
/// let curves = DyeModel::Wedge.amounts(&negative, card)?;
/// let exposed = |stops: f64| {
///     curves.as_ref().zip_map(card, |curve, h| curve.amount(LogExposure(h.0 + stops * std::f64::consts::LOG10_2)))
/// };
/// let scan = Scan::new(&negative, exposed(0.0), EquivalentNeutralDensity::default())?;
/// let [r, g, b] = *scan.positive(exposed(0.0));
/// assert!([r, g, b].iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-12), "a grey card is neutral");
/// assert!(scan.positive(exposed(1.0))[1] > g && scan.positive(exposed(-20.0))[1] < 0.001);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Scan {
    dyes: Dyes,
    densitometry: Densitometry,
    /// Densities of the film without any dye.
    base: PerLayer<f64>,
    /// What the rule's light of a grey card is multiplied by to be the grey asked for.
    gain: PerLayer<f64>,
}

impl Scan {
    /// A scanner set for `negative`, on which a grey card has made `grey`; it is shown at `density`.
    ///
    /// # Errors
    /// If the film is no negative, or the card has made no density above its base in some layer.
    pub fn new(negative: &Stock, grey: PerLayer<DyeAmount>, density: EquivalentNeutralDensity) -> Result<Self, Error> {
        expect_kind(negative, |kind| kind == StockKind::Negative, "negative")?;
        let densitometry = match negative.image() {
            Image::Dye => Densitometry::StatusM,
            Image::Silver => negative.densitometry(),
        };
        let dyes = negative.dyes_on(SpectralShape::VISIBLE)?;
        let unbalanced = Self { base: PerLayer::all(0.0), gain: PerLayer::all(1.0), dyes, densitometry };
        let base = unbalanced.densities(PerLayer::default()).map(|d| d.0);
        let unbalanced = Self { base, ..unbalanced };
        let shown = 10f64.powf(-density.value());
        let gain = PerLayer::from(*unbalanced.positive(grey)).try_map(|light, layer| {
            if light > 0.0 {
                return Ok::<f64, Error>(shown / light);
            }
            let found = "a grey card denser than the film's base".to_owned();
            let expected = "a card that was exposed".to_owned();
            Err(ErrorKind::Unreachable { stock: negative.id().to_owned(), layer, found, expected }.into())
        })?;
        Ok(Self { gain, ..unbalanced })
    }

    /// Densities of the negative as the scanner reads them, base included.
    #[must_use]
    pub fn densities(&self, amounts: PerLayer<DyeAmount>) -> PerLayer<Density> {
        self.densitometry.density(&self.dyes.density(amounts).transmittance())
    }

    /// The picture of a negative that holds these amounts of dye: display-linear RGB, 0 for the clear base.
    #[must_use]
    pub fn positive(&self, amounts: PerLayer<DyeAmount>) -> DisplayLinear {
        let above = self.densities(amounts).zip_map(self.base, |d, base| (d.0 - base).clamp(0.0, DENSITY_MAX));
        DisplayLinear(above.zip_map(self.gain, |d, gain| gain * (10f64.powf(d / SCAN_GAMMA) - 1.0)).to_array())
    }

    /// Wavelength by wavelength, by 1 nm: the sums are the light that the densitometer's channels read of the film, 1 without a film.
    #[must_use]
    pub fn rows(&self) -> Vec<SpectralRow> {
        let [red, green, blue] = self.densitometry.responses().as_ref().map(SpectralDistribution::values).to_array();
        let [c, m, y] = self.dyes.dyes().map(SpectralDistribution::values).to_array();
        let row = |i: usize| SpectralRow {
            dyes: [c[i], m[i], y[i]],
            base: self.dyes.d_min().map_or(0.0, |d| d.values()[i]),
            weights: [red[i], green[i], blue[i]],
        };
        (0..red.len()).map(row).collect()
    }

    /// Over log10 of that light, the density above the base divided by gamma: log10 of scene light, as far as the rule goes. Straight
    /// lines, as the curves of a print would be that had no toe and no shoulder.
    ///
    /// # Errors
    /// None for densities that are finite.
    pub fn curves(&self) -> Result<PerLayer<AmountCurve>, Error> {
        self.base.try_map(|base, _| {
            let (from, to) = (-(base + DENSITY_MAX), -base);
            Ok(AmountCurve::new(vec![from, to], &[DENSITY_MAX / SCAN_GAMMA, 0.0], Direction::Falling)?)
        })
    }

    /// What light of 10^`curves` is multiplied by once 1 is taken off, so that a grey card is the grey asked for.
    #[must_use]
    pub fn gain(&self) -> PerLayer<f64> {
        self.gain
    }
}

#[cfg(test)]
mod tests {
    use onelight_film::{DyeModel, LogExposure, SheetText};

    use super::*;

    fn read(id: &str) -> Stock {
        let f = onelight_stocks::find(id).unwrap();
        Stock::parse(&SheetText {
            id: f.id,
            stock_toml: f.stock_toml,
            sensitivity_csv: f.sensitivity_csv,
            characteristic_csv: f.characteristic_csv,
            dye_density_csv: f.dye_density_csv,
        })
        .unwrap()
    }

    /// Amounts that greys make, stops over a grey card, on the film's own grey scale.
    fn greys(stock: &Stock) -> impl Fn(f64) -> PerLayer<DyeAmount> {
        let card = PerLayer::all(stock.mid_grey().unwrap());
        let curves = DyeModel::Wedge.amounts(stock, card).unwrap();
        move |stops| {
            curves.as_ref().zip_map(card, |curve, h| curve.amount(LogExposure(h.0 + stops * std::f64::consts::LOG10_2)))
        }
    }

    /// On every negative, in colour and in silver: the card is neutral at what is asked for, the clear base black, and more light
    /// never darker.
    #[test]
    fn a_scan_is_neutral_at_the_card_black_at_the_base_and_rises() {
        for id in onelight_stocks::ALL.iter().map(|sheet| sheet.id) {
            let stock = read(id);
            let density = EquivalentNeutralDensity::new(0.9).unwrap();
            if stock.kind() != StockKind::Negative {
                let error = Scan::new(&stock, PerLayer::default(), density).unwrap_err();
                assert!(error.is_wrong_kind() && error.to_string().contains("expected a negative"), "{error}");
                continue;
            }
            let grey = greys(&stock);
            let scan = Scan::new(&stock, grey(0.0), density).unwrap();
            assert!(scan.positive(grey(0.0)).iter().all(|v| (v - 10f64.powf(-0.9)).abs() < 1e-12), "{id}");
            assert_eq!(scan.positive(PerLayer::default()), DisplayLinear([0.0; 3]), "{id}");
            let scale: Vec<DisplayLinear> = (-60..=60).map(|i| scan.positive(grey(f64::from(i) / 10.0))).collect();
            // A densitometer's channels overlap, and reading noise of a sheet's curves is levelled layer by layer.
            let falls = |pair: &[DisplayLinear]| (0..3).any(|i| pair[1][i] < pair[0][i] - 1e-9);
            assert!(!scale.windows(2).any(falls), "{id}");
        }
    }

    /// \[Kennel1995\]: code values of 0.002 density from the base's 95, white at 685, light 10^((code - 685) 0.002 / 0.6) less that
    /// of the base, is what the rule gives but for the factor that balances grey.
    #[test]
    fn the_rule_is_the_cineon_systems() {
        let stock = read("kodak-5207");
        let grey = greys(&stock);
        let scan = Scan::new(&stock, grey(0.0), EquivalentNeutralDensity::default()).unwrap();
        let base = scan.densities(PerLayer::default());
        let linear = |stops: f64| {
            scan.densities(grey(stops)).zip_map(base, |d, base| {
                let code = 95.0 + (d.0 - base.0) / 0.002;
                let light = |code: f64| 10f64.powf((code - 685.0) * 0.002 / 0.6);
                (light(code) - light(95.0)) / (1.0 - light(95.0))
            })
        };
        let card = linear(0.0);
        for stops in [-4.0, -1.0, 2.0, 5.0] {
            let expected = linear(stops).zip_map(card, |light, card| light / card * 10f64.powf(-0.7)).to_array();
            let found = scan.positive(grey(stops));
            assert!(
                found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9 * b),
                "{stops}: {found:?} {expected:?}"
            );
        }
    }

    #[test]
    fn a_card_that_left_no_trace_is_refused() {
        let error =
            Scan::new(&read("kodak-5207"), PerLayer::default(), EquivalentNeutralDensity::default()).unwrap_err();
        let expected = "kodak-5207: the aim needs a grey card denser than the film's base in the red layer, expected a card that was \
                        exposed";
        assert_eq!(error.to_string(), expected);
        assert!(error.is_unreachable_aim());
    }
}
