use onelight_film::{Image, Stock, StockKind};
use onelight_printing::ScanRule;

use crate::error::{Error, ErrorKind};
use crate::process::{FilmProcess, FirstProcess, Process, StockRef, usual_print};
use crate::stocks::stock;

/// The film in the camera and the one it is printed on, as [`Process::compile_with`] takes them: built in or read from sheets
/// of one's own.
///
/// ```
/// use onelight::{Films, Process, stock};
/// let films = Films { camera: stock("kodak-5219")?, print: Some(stock("kodak-2393")?) };
/// let film = Process::default().compile_with(&films)?;
/// assert_eq!(film.name(), "kodak-5219_kodak-2393");
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Films {
    /// A negative, a reversal or an instant film.
    pub camera: Stock,
    /// The print film or paper of a negative; `None` for reversal film that is shown itself, and for a negative that is scanned.
    pub print: Option<Stock>,
}

impl Films {
    /// The built-in films that a description names, checked as [`Films::check`] does.
    pub(crate) fn built_in(camera: &StockRef, print: Option<&StockRef>, scan: Option<ScanRule>) -> Result<Self, Error> {
        let films = Self { camera: built_in(camera)?, print: print.map(built_in).transpose()? };
        films.check(scan)?;
        Ok(films)
    }

    pub(crate) fn of_film(process: &FilmProcess) -> Result<Self, Error> {
        Self::built_in(&process.camera, process.print.as_ref().map(|print| &print.film), process.scan)
    }

    pub(crate) fn of_first(process: &FirstProcess) -> Result<Self, Error> {
        Self::built_in(&process.camera, process.print.as_ref(), None)
    }

    /// Whether the films fit together, where the one in the camera is scanned or not.
    pub(crate) fn check(&self, scan: Option<ScanRule>) -> Result<(), Error> {
        let (camera, kind, image) = (self.camera.id(), self.camera.kind(), self.camera.image());
        let usual = usual_print(image);
        if scan.is_some() && kind.is_camera_film() && kind != StockKind::Negative {
            let (article, kind) = if kind == StockKind::Instant { ("an", kind.name()) } else { ("a", kind.name()) };
            return refuse(format!(
                "{camera} is {article} {kind} and is shown as it is, expected print none instead of a scan, whose rule inverts negatives"
            ));
        }
        let Some(print) = &self.print else {
            return match kind {
                StockKind::Negative if scan.is_some() => Ok(()),
                StockKind::Negative => refuse(format!(
                    "{camera} is a negative, expected a print film to see it on, such as {usual}, or a scan"
                )),
                StockKind::Reversal | StockKind::Instant => Ok(()),
                kind => Err(Error::not_for_a_camera(camera, kind)),
            };
        };
        if !kind.is_camera_film() {
            return Err(Error::not_for_a_camera(camera, kind));
        }
        let (id, found) = (print.id(), print.kind());
        if kind.printed_on().contains(&found) {
            return if self.camera.is_printed_on(print) { Ok(()) } else { refuse(one_image(&self.camera, print)) };
        }
        match kind {
            StockKind::Negative if found.is_camera_film() => {
                refuse(format!("{id} is a camera film, expected a print film, such as {usual}"))
            }
            StockKind::Negative => refuse(format!(
                "{camera} is a negative, expected a print film, such as {usual}, instead of the {} {id}",
                found.name()
            )),
            StockKind::Reversal => refuse(format!(
                "{camera} is a reversal film and is shown as it is or printed on reversal paper, expected no print film instead of {id}"
            )),
            kind => refuse(format!(
                "{camera} is an {} and is shown as it is, expected no print film instead of {id}",
                kind.name()
            )),
        }
    }

    /// Whether a description prints where these films are printed.
    pub(crate) fn check_for(&self, printed: bool, scan: Option<ScanRule>) -> Result<(), Error> {
        self.check(scan)?;
        let camera = self.camera.id();
        match (&self.print, printed) {
            (Some(print), false) => refuse(format!(
                "{camera} is printed on {}, but the process has no printing, expected its print to be set",
                print.id()
            )),
            (None, true) => refuse(format!(
                "{camera} is a reversal film and is not printed, but the process has a printing, expected its print to be None"
            )),
            _ => Ok(()),
        }
    }

    /// The description with these films in it: built-in ones by name where it named others.
    pub(crate) fn named_in(&self, process: &Process) -> Process {
        let mut process = process.clone();
        let set = |place: &mut StockRef, stock: &Stock| {
            if place.id() != stock.id() {
                *place = stock.id().into();
            }
        };
        match &mut process {
            Process::Film(film) => {
                set(&mut film.camera, &self.camera);
                if let Some((place, stock)) = film.print.as_mut().zip(self.print.as_ref()) {
                    set(&mut place.film, stock);
                }
            }
            Process::First(first) => {
                set(&mut first.camera, &self.camera);
                if let Some((place, stock)) = first.print.as_mut().zip(self.print.as_ref()) {
                    set(place, stock);
                }
            }
            Process::Print(_) | Process::Tone(_) => {}
        }
        process
    }
}

/// The sentence for colour on black and white, or the other way round.
fn one_image(camera: &Stock, print: &Stock) -> String {
    let name = |stock: &Stock| match stock.image() {
        Image::Dye => "in colour",
        Image::Silver => "black and white",
    };
    let (camera, of_camera, print, of_print) = (camera.id(), name(camera), print.id(), name(print));
    format!("{camera} is {of_camera} and {print} {of_print}, expected both alike")
}

pub(crate) fn built_in(film: &StockRef) -> Result<Stock, Error> {
    match film {
        StockRef::BuiltIn(id) => stock(id),
        StockRef::Own(sheet) => refuse(format!(
            "{} is a data sheet of one's own ({}), expected its stock beside the process, as in compile_with",
            sheet.id, sheet.path
        )),
    }
}

fn refuse<T>(sentence: String) -> Result<T, Error> {
    Err(ErrorKind::Contradiction(sentence).into())
}
