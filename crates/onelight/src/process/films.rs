//! The films of a process, once nothing in it contradicts anything else.

use onelight_film::{Stock, StockKind};
use onelight_printing::{Aim, EquivalentNeutralDensity, PrinterLight, Wratten};

use super::Process;
use crate::approach::Approach;
use crate::error::{Error, Kind};
use crate::stocks::stock;
use crate::word::Word;

/// Film in the camera, and the one it is printed on.
#[derive(Debug)]
pub(crate) struct Films {
    pub(crate) camera: Stock,
    pub(crate) print: Option<Stock>,
}

impl Films {
    /// The films of a process.
    ///
    /// # Errors
    /// If a stock is unknown, the films do not fit together, a number is out of its range, or a switch would change nothing.
    pub(crate) fn of(process: &Process) -> Result<Self, Error> {
        let camera = stock(&process.camera)?;
        let print = process.print.as_deref().map(stock).transpose()?;
        fit(&camera, print.as_ref())?;
        numbers(process)?;
        useful(process)?;
        Ok(Self { camera, print })
    }
}

/// Whether the films fit together.
fn fit(film: &Stock, print: Option<&Stock>) -> Result<(), Error> {
    let camera = film.id();
    let refuse = |sentence: String| Err(Kind::Contradiction(sentence).into());
    match (film.kind(), print.map(|p| (p.kind(), p.id()))) {
        (StockKind::Print, _) => Err(Error::print_film_in_camera(camera)),
        (StockKind::Negative, None) => {
            refuse(format!("{camera} is a negative, expected a print film to see it on, such as kodak-2383"))
        }
        (StockKind::Reversal, Some((_, print))) => refuse(format!(
            "{camera} is a reversal film and is shown as it is, expected no print film instead of {print}"
        )),
        (StockKind::Negative, Some((StockKind::Negative | StockKind::Reversal, print))) => {
            refuse(format!("{print} is a camera film, expected a print film, such as kodak-2383"))
        }
        _ => Ok(()),
    }
}

/// Whether the numbers are within their ranges.
fn numbers(process: &Process) -> Result<(), Error> {
    EquivalentNeutralDensity::new(process.neutral_density)?;
    let each = |what, values: [f64; 3], low, high| values.map(|found| (what, found, low, high));
    let all = [("overexposure", process.overexposure, -10.0, 10.0)]
        .into_iter()
        .chain(each("beam_density", process.beam_density, 0.0, 4.0))
        .chain(each("points", process.points, -50.0, 50.0));
    for (what, found, low, high) in all {
        if !(low..=high).contains(&found) {
            return Err(Error::setting(what, found, low, high));
        }
    }
    Ok(())
}

/// Whether every switch that was turned does something.
pub(crate) fn useful(process: &Process) -> Result<(), Error> {
    let usual = Process::default();
    let printer = [
        ("light", process.light != usual.light),
        ("filters", process.filters != usual.filters),
        ("beam_density", process.beam_density != usual.beam_density),
        ("calibration", process.calibration != usual.calibration),
        ("points", process.points != usual.points),
        ("infrared", process.infrared != usual.infrared),
        ("glass", process.glass != usual.glass),
        ("red_tail", process.red_tail != usual.red_tail),
    ];
    let film = [
        ("aim", process.aim != usual.aim),
        ("overexposure", process.overexposure != usual.overexposure),
        ("dyes", process.dyes != usual.dyes),
        ("matching", process.matching != usual.matching),
        ("reconstruction", process.reconstruction != usual.reconstruction),
        ("projector", process.projector != usual.projector),
    ];
    let density = ("neutral_density", process.neutral_density != usual.neutral_density);
    let first = ("first", process.first != usual.first);
    let (idle, why): (Vec<(&str, bool)>, String) = match process.approach {
        Approach::Second if process.print.is_none() => {
            let idle = printer.into_iter().chain([first]).collect();
            (idle, format!("{} is a reversal film and is not printed", process.camera))
        }
        Approach::Second => (vec![first], "approach second has no controls by hand".to_owned()),
        Approach::First => {
            (film.into_iter().chain(printer).collect(), "approach first knows no spectra, dyes or printer".to_owned())
        }
        baseline => {
            let idle = film.into_iter().chain(printer).chain([density, first]).collect();
            (idle, format!("approach {} knows no film", baseline.word()))
        }
    };
    let refuse = |sentence: String| Err(Kind::Contradiction(sentence).into());
    // The first approach's controls are named before the film's kind is blamed for them.
    if let Some((key, _)) = idle.iter().find(|(key, changed)| *changed && *key == "first") {
        return refuse(format!("{key} holds the controls of approach first, expected it left out or approach first"));
    }
    if let Some((key, _)) = idle.iter().find(|(_, changed)| *changed) {
        return refuse(format!("{why}: {key} changes nothing, expected it left out"));
    }
    if process.aim == Aim::Sheet && density.1 {
        return refuse(
            "aim sheet takes its density from the sheet: neutral_density changes nothing, expected aim neutral"
                .to_owned(),
        );
    }
    let separations = [Wratten::No70, Wratten::No99, Wratten::No98];
    if process.light == PrinterLight::White && !separations.iter().all(|filter| process.filters.contains(*filter)) {
        return refuse("light white has no separation filters: taking them out changes nothing, expected filters with 70, 99 and 98 or light separations".to_owned());
    }
    Ok(())
}
