use onelight_film::{AmountCurve, LogExposure, PerLayer, PrintCurves, Stock, StockKind};
use onelight_printing::{
    EquivalentNeutralDensity, POINT_LOG_EXPOSURE, Projection, White, print_mid_grey, print_target,
};
use onelight_spectra::{DisplayLinear, SpectralShape, finite};

use crate::about::About;
use crate::cineon::{self, GREY_CODE, LAST_CODE};
use crate::error::{Error, ErrorKind};
use crate::films::built_in;
use crate::positive::viewed_by;
use crate::process::{PrintAlone, Process};

/// A print of Cineon codes at work: the exact one, in float64 at 1 nm.
///
/// ```
/// use onelight::{Look, PrintAlone, Process};
/// let Look::Print(print) = Process::from(PrintAlone::default()).look()? else { return Ok(()) };
/// // What is dense on the negative is bright on the print.
/// let [dark, bright] = [300.0, 600.0].map(|code| print.develop_codes([code / 1023.0; 3]));
/// assert!(dark[1] < 0.1 && bright[1] > 0.5);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct PrintedScan {
    curves: PerLayer<AmountCurve>,
    /// Exposure of each layer by a negative of density 0.
    unmasked: PerLayer<LogExposure>,
    projection: Projection,
    about: About,
}

impl PrintedScan {
    pub(crate) fn new(process: &PrintAlone) -> Result<Self, Error> {
        process.check()?;
        if process.film.own_sheet().is_some() {
            let sentence = format!(
                "{} is a data sheet of one's own, expected a built-in print film behind camera none",
                process.film.id()
            );
            return Err(ErrorKind::Contradiction(sentence).into());
        }
        let print = built_in(&process.film)?;
        check_kind(&print)?;
        let curves = match process.curves {
            PrintCurves::Neutral => process.dyes.amounts(&print, print_mid_grey(&print)?)?,
            PrintCurves::Principal => PrintCurves::principal_amounts(&print)?,
        };
        let output = process.spaces.output_space.space();
        let dyes = print.dyes_on(SpectralShape::VISIBLE)?;
        let projection = Projection::new(dyes, viewed_by(process.projector, &print)?, &output)?;
        let projection = match process.white {
            White::Lamp => projection,
            White::Film => projection.adapted_to(curves.as_ref().map(|curve| *curve.amount_range().start())),
        };
        let density = EquivalentNeutralDensity::new(process.neutral_density)?;
        let target = print_target(process.aim, density, &print, curves.as_ref(), &projection)?;
        let grey = cineon::density(GREY_CODE / LAST_CODE);
        let unmasked = target
            .zip_map(PerLayer::from(process.points), |h, points| LogExposure(h.0 + grey + POINT_LOG_EXPOSURE * points));
        Ok(Self { curves, unmasked, projection, about: About::new(&Process::Print(process.clone())) })
    }

    /// Cineon codes, 0 to 1 for 0 to 1023, to display-linear RGB, not clipped. NaN counts as 0, other codes are held to 0 to 1.
    #[must_use]
    pub fn develop_codes(&self, codes: [f64; 3]) -> DisplayLinear {
        let density = PerLayer::from(codes.map(|code| cineon::density(finite(code).clamp(0.0, 1.0))));
        let exposure = self.unmasked.zip_map(density, |h, density| LogExposure(h.0 - density));
        self.projection.rgb(self.curves.as_ref().zip_map(exposure, AmountCurve::amount))
    }

    /// The same of the light that codes stand for: 0.18 is code 445, ten times as much 300 codes more. What takes light, as
    /// [`crate::Look::develop`] does, takes this.
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> DisplayLinear {
        self.develop_codes(rgb.map(cineon::code))
    }

    pub(super) fn about(&self) -> &About {
        &self.about
    }
}

fn check_kind(print: &Stock) -> Result<(), Error> {
    if matches!(print.kind(), StockKind::Print | StockKind::Paper) {
        return Ok(());
    }
    let sentence = format!(
        "{} is a {}, expected a print film or paper for negatives, such as kodak-2383, behind codes of a negative",
        print.id(),
        print.kind().name()
    );
    Err(ErrorKind::Contradiction(sentence).into())
}
