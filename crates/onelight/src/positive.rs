//! How the film in the camera becomes a picture: shown itself, printed, or scanned.

use nalgebra::{Matrix3, Vector3};
use onelight_film::{AmountCurve, Direction, DyeAmount, Image, LogExposure, PerLayer, Stock, Tail};
use onelight_printing::{
    Duplication, EquivalentNeutralDensity, LitDuplication, PrinterLights, Projector, Scan, SpectralRow,
};
use onelight_spectra::{Chromaticity, DisplayLinear, RgbSpace, TransferCurve};

use crate::error::{Error, ErrorKind};
use crate::process::Printing;
use crate::word::Word as _;

/// What comes behind the film in the camera.
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "there is one of a film")]
pub(crate) enum Positive {
    /// Nothing: reversal and instant film is shown as it is.
    Itself,
    /// A print film or paper.
    Print(PrintStep),
    /// A scanner, and the rule by which it inverts densities.
    Scan(ScanStep),
}

/// What printing adds to the camera film.
#[derive(Debug, Clone)]
pub(crate) struct PrintStep {
    pub(crate) duplication: LitDuplication,
    pub(crate) lights: PrinterLights,
    pub(crate) target: PerLayer<LogExposure>,
    pub(crate) curves: PerLayer<AmountCurve>,
}

/// What scanning adds to a negative. Its channels are computed as the layers of a print are, the light that each reads being the exposure
/// and density above the base the dye: so that all forms have a scan by the steps that they have for prints.
#[derive(Debug, Clone)]
pub(crate) struct ScanStep {
    pub(crate) scan: Scan,
    pub(crate) rows: Vec<SpectralRow>,
    pub(crate) curves: PerLayer<AmountCurve>,
    /// Over the same, what a table's nodes are even in: the display's code up to its white, and little for all that is brighter.
    pub(crate) codes: PerLayer<AmountCurve>,
    /// From the scan's channels, which are sRGB's, to those of the output.
    pub(crate) to_output: Matrix3<f64>,
}

impl PrintStep {
    /// The printer set so that dye `grey` of the negative gives the print the exposure `target`.
    pub(crate) fn new(
        printing: &Printing,
        negative: &Stock,
        print: &Stock,
        grey: PerLayer<DyeAmount>,
        target: PerLayer<LogExposure>,
        curves: PerLayer<AmountCurve>,
    ) -> Result<Self, Error> {
        check_one_layer(printing, print)?;
        let duplication = Duplication::new(negative, print, printing.printer())?;
        let lights = duplication.calibrate_by(printing.calibration, grey, target)?;
        let lights = lights.offset(PerLayer::from(printing.points));
        Ok(Self { duplication: duplication.lit(lights), lights, target, curves })
    }

    pub(crate) fn amounts(&self, exposure: PerLayer<LogExposure>) -> PerLayer<DyeAmount> {
        self.curves.as_ref().zip_map(exposure, AmountCurve::amount)
    }
}

impl ScanStep {
    /// The scanner set so that dye `grey` of the negative is shown neutral at `density`.
    pub(crate) fn new(
        negative: &Stock,
        grey: PerLayer<DyeAmount>,
        density: EquivalentNeutralDensity,
        output: &RgbSpace,
    ) -> Result<Self, Error> {
        let scan = Scan::new(negative, grey, density)?;
        let to_output = RgbSpace::SRGB.to_about(output, Chromaticity::black_body_6500_k())?;
        let curves = scan.curves()?;
        let codes = codes(&curves, scan.gain())?;
        Ok(Self { rows: scan.rows(), curves, codes, to_output, scan })
    }

    pub(crate) fn rgb(&self, amounts: PerLayer<DyeAmount>) -> DisplayLinear {
        DisplayLinear((self.to_output * Vector3::from(*self.scan.positive(amounts))).into())
    }

    /// log10 of the light that each channel reads.
    pub(crate) fn light(&self, amounts: PerLayer<DyeAmount>) -> PerLayer<LogExposure> {
        self.scan.densities(amounts).map(|density| LogExposure(-density.0))
    }
}

/// Light up to which nodes are even in the display's code: half as much again as its white, as the axis of a channel knows its light nearly
/// and not to the last.
const EVEN: f64 = 1.5;
/// Nodes of a table on each decade of light that is brighter, as a part of those up to white.
const BRIGHTER: f64 = 0.1;
/// Points of each curve of codes.
const CODES: usize = 1025;

fn codes(curves: &PerLayer<AmountCurve>, gain: PerLayer<f64>) -> Result<PerLayer<AmountCurve>, Error> {
    curves.as_ref().zip_map(gain, |curve, gain| (curve, gain)).try_map(|(curve, gain), _| {
        let (from, to) = (curve.range().start().0, curve.range().end().0);
        let at = |i: usize| from + i as f64 / (CODES - 1) as f64 * (to - from);
        let code = |h: f64| {
            let light = gain * (10f64.powf(curve.amount(LogExposure(h)).0) - 1.0);
            TransferCurve::Srgb.encode(light.min(EVEN)) + BRIGHTER * (light / EVEN).max(1.0).log10()
        };
        let places: Vec<f64> = (0..CODES).map(at).collect();
        let codes: Vec<f64> = places.iter().map(|h| code(*h)).collect();
        Ok(AmountCurve::new(places, &codes, Direction::Falling)?)
    })
}

/// The light that a look's picture is seen by: paper is looked at in a viewing booth, and nothing projects it.
pub(crate) fn viewed_by(projector: Projector, shown: &Stock) -> Result<Projector, Error> {
    match projector {
        Projector::Display if shown.kind().is_reflective() => Ok(Projector::ViewingBooth),
        Projector::Theatre | Projector::TheatreUnadapted | Projector::Xenon if shown.kind().is_reflective() => {
            let (id, kind, found) = (shown.id(), shown.kind().name(), projector.word());
            let sentence = format!(
                "{id} is a {kind} and is not projected, expected projector display or booth instead of {found}"
            );
            Err(ErrorKind::Contradiction(sentence).into())
        }
        Projector::Display
        | Projector::Theatre
        | Projector::TheatreUnadapted
        | Projector::Xenon
        | Projector::ViewingBooth => Ok(projector),
    }
}

/// One layer cannot be filtered: what moves one of three layers means nothing to black and white.
fn check_one_layer(printing: &Printing, print: &Stock) -> Result<(), Error> {
    let [red, green, blue] = printing.points;
    let expected = match printing.red_tail {
        _ if print.image() == Image::Dye => return Ok(()),
        _ if red != green || green != blue => format!("three equal points instead of {red}, {green}, {blue}"),
        Tail::Held => "red_tail log-linear".to_owned(),
        Tail::LogLinear => return Ok(()),
    };
    Err(ErrorKind::Contradiction(format!("{} is black and white and has one layer, expected {expected}", print.id()))
        .into())
}
