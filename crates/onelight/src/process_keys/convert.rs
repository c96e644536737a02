//! From keys to one kind of process, and back.

use onelight_printing::ScanRule;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::keys::ProcessKeys;
use crate::error::{Error, ErrorKind};
use crate::films::{Films, built_in};
use crate::process::{
    Approach, ColourSpaces, DEFAULT_PRINT, Effects, FilmProcess, FirstControls, FirstProcess, NO_CAMERA, OwnSheet,
    PrintAlone, Printing, Process, SCAN, StockRef, ToneMapping, ToneProcess, check_exposure, check_lights,
};
use crate::word::Word as _;

impl ProcessKeys {
    /// The process that the keys describe.
    ///
    /// # Errors
    /// If a stock is unknown or a sheet of one's own, the films do not fit together, a number is out of its range, or a key
    /// changes nothing.
    pub fn process(&self) -> Result<Process, Error> {
        let process = self.unchecked()?;
        match &process {
            Process::Film(_) | Process::First(_) => {
                let (camera, print) = self.stocks()?;
                Films::built_in(&camera, print.as_ref(), self.scan())?;
            }
            Process::Print(print) => {
                built_in(&print.film)?;
            }
            Process::Tone(_) => {}
        }
        self.check()?;
        Ok(process)
    }

    /// The process that the keys describe, with these stocks where they name sheets of one's own.
    ///
    /// # Errors
    /// As [`ProcessKeys::process`], but for sheets of one's own; a tone mapping takes no films.
    pub fn process_with(&self, films: &Films) -> Result<Process, Error> {
        let process = self.unchecked()?;
        match &process {
            Process::Tone(tone) => return Err(no_films(tone.mapping.approach())),
            Process::Print(_) => {
                let sentence =
                    "camera is none: data sheets of one's own are not taken behind it, expected a built-in print film";
                return Err(ErrorKind::Contradiction(sentence.to_owned()).into());
            }
            Process::Film(_) | Process::First(_) => {}
        }
        films.check(self.scan())?;
        self.check()?;
        Ok(films.named_in(&process))
    }

    fn unchecked(&self) -> Result<Process, Error> {
        let spaces = ColourSpaces {
            ev: self.ev,
            scene_white: self.scene_white,
            input_space: self.input_space,
            output_space: self.output_space,
            output_coding: self.output_coding,
            white_luminance: self.white_luminance,
        };
        let mapping = match self.approach {
            Approach::Second if self.camera == NO_CAMERA => return self.print_alone(spaces).map(Process::Print),
            Approach::Second => return self.film(spaces).map(Process::Film),
            Approach::First => {
                let (camera, print) = self.stocks()?;
                let (neutral_density, controls) = (self.neutral_density, self.first.clone());
                return Ok(Process::First(FirstProcess { camera, print, neutral_density, controls, spaces }));
            }
            Approach::Reinhard => ToneMapping::Reinhard,
            Approach::ReinhardLuminance => ToneMapping::ReinhardLuminance,
            Approach::Clip => ToneMapping::Clip,
        };
        Ok(Process::Tone(ToneProcess { mapping, spaces }))
    }

    fn film(&self, spaces: ColourSpaces) -> Result<FilmProcess, Error> {
        let (camera, print) = self.stocks()?;
        let print = print.map(|film| Printing {
            film,
            curves: self.print_curves,
            light: self.light,
            filters: self.filters,
            beam_density: self.beam_density,
            calibration: self.calibration,
            points: self.points,
            infrared: self.infrared,
            glass: self.glass,
            red_tail: self.red_tail,
        });
        Ok(FilmProcess {
            camera,
            print,
            scan: self.scan(),
            aim: self.aim,
            neutral_density: self.neutral_density,
            overexposure: self.overexposure,
            dyes: self.dyes,
            matching: self.matching,
            inter_image: self.inter_image,
            reconstruction: self.reconstruction,
            gamut: self.gamut,
            projector: self.projector,
            white: self.white,
            effects: self.effects(),
            spaces,
        })
    }

    fn print_alone(&self, spaces: ColourSpaces) -> Result<PrintAlone, Error> {
        let refuse = |sentence: &str| Err(ErrorKind::Contradiction(sentence.to_owned()).into());
        if self.camera_sheet.is_some() || self.camera_sha256.is_some() {
            return refuse("camera is none: camera_sheet and camera_sha256 change nothing, expected them left out");
        }
        if self.scan().is_some() {
            return refuse(
                "print is scan and camera none: codes of a scan are printed, expected a print film, such as kodak-2383",
            );
        }
        let Some(print) = &self.print else {
            return refuse(
                "camera and print are none, expected a print film, such as kodak-2383, behind codes of a scan",
            );
        };
        Ok(PrintAlone {
            film: stock_ref("print", print, self.print_sheet.as_deref(), self.print_sha256.as_deref())?,
            curves: self.print_curves,
            dyes: self.dyes,
            aim: self.aim,
            neutral_density: self.neutral_density,
            points: self.points,
            projector: self.projector,
            white: self.white,
            spaces,
        })
    }

    /// The rule of a scan, where the key `print` asks for one.
    fn scan(&self) -> Option<ScanRule> {
        self.print.as_deref().filter(|print| *print == SCAN).map(|_| ScanRule::default())
    }

    fn effects(&self) -> Effects {
        Effects {
            film_format: self.film_format,
            grain: self.grain,
            sharpness: self.sharpness,
            halation: self.halation,
            antihalation: self.antihalation,
            seed: self.seed,
        }
    }

    fn stocks(&self) -> Result<(StockRef, Option<StockRef>), Error> {
        if self.camera == NO_CAMERA {
            let sentence = format!(
                "camera none prints a scan, which approach {} does not, expected approach second",
                self.approach.word()
            );
            return Err(ErrorKind::Contradiction(sentence).into());
        }
        let camera = stock_ref("camera", &self.camera, self.camera_sheet.as_deref(), self.camera_sha256.as_deref())?;
        let (path, sha256) = (self.print_sheet.as_deref(), self.print_sha256.as_deref());
        let refuse = |sentence: String| Err(ErrorKind::Contradiction(sentence).into());
        match self.print.as_deref().filter(|_| self.scan().is_none()) {
            Some(print) => Ok((camera, Some(stock_ref("print", print, path, sha256)?))),
            None if path.or(sha256).is_some() => {
                let print = self.print.as_deref().unwrap_or("none");
                refuse(format!("print is {print}: print_sheet and print_sha256 change nothing, expected them left out"))
            }
            None if self.scan().is_some() && self.approach == Approach::First => refuse(format!(
                "print is scan, which approach first does not have, expected a print film, such as {DEFAULT_PRINT}, or approach second"
            )),
            None => Ok((camera, None)),
        }
    }

    /// Whether the numbers of a film are within their ranges, and every key that was changed changes something.
    fn check(&self) -> Result<(), Error> {
        if matches!(self.approach, Approach::Second | Approach::First) {
            check_exposure(self.neutral_density, self.overexposure)?;
            check_lights(&self.beam_density, &self.points)?;
        }
        self.unchecked()?.spaces().check()?;
        let refuse = |sentence: String| Err(ErrorKind::Contradiction(sentence).into());
        let (idle, why) = self.idle_keys();
        // The first approach's controls are named before the film's kind is blamed for them.
        if idle.contains(&"first") {
            let (own, usual) = (&self.first, FirstControls::default());
            let changed = [
                ("contrast", own.contrast != usual.contrast),
                ("brightness", own.brightness != usual.brightness),
                ("temperature", own.temperature != usual.temperature),
                ("saturation", own.saturation != usual.saturation),
                ("curve", own.curve != usual.curve),
            ];
            let changed: Vec<&str> = changed.into_iter().filter(|(_, changed)| *changed).map(|(key, _)| key).collect();
            return refuse(format!(
                "{}: a control of approach first, which changes nothing in another, expected it left out or approach first",
                changed.join(", ")
            ));
        }
        if let Some(key) = idle.first() {
            return refuse(format!("{why}: {key} changes nothing, expected it left out"));
        }
        match self.unchecked()? {
            Process::Film(film) => film.check(),
            Process::Print(print) => print.check(),
            Process::First(first) => first.check(),
            Process::Tone(_) => Ok(()),
        }
    }

    /// The keys that were changed and change nothing, and why they do not.
    fn idle_keys(&self) -> (Vec<&'static str>, String) {
        let usual = Self::default();
        let printer = [
            ("print_curves", self.print_curves != usual.print_curves),
            ("light", self.light != usual.light),
            ("filters", self.filters != usual.filters),
            ("beam_density", self.beam_density != usual.beam_density),
            ("calibration", self.calibration != usual.calibration),
            ("points", self.points != usual.points),
            ("infrared", self.infrared != usual.infrared),
            ("glass", self.glass != usual.glass),
            ("red_tail", self.red_tail != usual.red_tail),
        ];
        let film = [
            ("aim", self.aim != usual.aim),
            ("overexposure", self.overexposure != usual.overexposure),
            ("dyes", self.dyes != usual.dyes),
            ("matching", self.matching != usual.matching),
            ("interimage", self.inter_image != usual.inter_image),
            ("reconstruction", self.reconstruction != usual.reconstruction),
            ("gamut", self.gamut != usual.gamut),
            ("projector", self.projector != usual.projector),
            ("white", self.white != usual.white),
            ("film_format", self.film_format != usual.film_format),
            ("grain", self.grain != usual.grain),
            ("sharpness", self.sharpness != usual.sharpness),
            ("halation", self.halation != usual.halation),
            ("antihalation", self.antihalation != usual.antihalation),
            ("seed", self.seed != usual.seed),
        ];
        let density = [("neutral_density", self.neutral_density != usual.neutral_density)];
        let first = [("first", self.first != usual.first)];
        let (idle, why): (Vec<(&'static str, bool)>, String) = match self.approach {
            Approach::Second if self.camera == NO_CAMERA => {
                let of_print = ["print_curves", "points", "aim", "dyes", "projector", "white"];
                let idle =
                    film.into_iter().chain(printer).filter(|(key, _)| !of_print.contains(key)).chain(first).collect();
                (idle, "camera is none and the negative is a scan".to_owned())
            }
            Approach::Second if self.scan().is_some() => {
                let of_light = ["projector", "white"];
                let idle =
                    film.into_iter().filter(|(key, _)| of_light.contains(key)).chain(printer).chain(first).collect();
                (idle, "print is scan and nothing is printed or projected".to_owned())
            }
            Approach::Second if self.print.is_none() => {
                let idle = printer.into_iter().chain(first).collect();
                (idle, format!("{} is a reversal film and is not printed", self.camera))
            }
            Approach::Second => (first.to_vec(), "approach second has no controls by hand".to_owned()),
            Approach::First => {
                let idle = film.into_iter().chain(printer).collect();
                (idle, "approach first knows no spectra, dyes or printer".to_owned())
            }
            tone => {
                let idle = film.into_iter().chain(printer).chain(density).chain(first).collect();
                (idle, format!("approach {} knows no film", tone.word()))
            }
        };
        (idle.into_iter().filter(|(_, changed)| *changed).map(|(key, _)| key).collect(), why)
    }
}

/// The sentence for films beside a process that has none.
pub(crate) fn no_films(approach: Approach) -> Error {
    let sentence = format!("approach {} knows no film: films beside it change nothing, expected none", approach.word());
    ErrorKind::Contradiction(sentence).into()
}

fn stock_ref(key: &str, id: &str, path: Option<&str>, sha256: Option<&str>) -> Result<StockRef, Error> {
    let (path, sha256) = match (path, sha256) {
        (None, None) => return Ok(id.into()),
        (Some(path), Some(sha256)) => (path.to_owned(), sha256.to_owned()),
        (Some(_), None) => {
            return Err(ErrorKind::Contradiction(format!(
                "{key}_sheet names a data sheet without its digest, expected {key}_sha256 beside it"
            ))
            .into());
        }
        (None, Some(_)) => {
            return Err(ErrorKind::Contradiction(format!(
                "{key}_sha256 is the digest of no data sheet, expected {key}_sheet beside it"
            ))
            .into());
        }
    };
    Ok(StockRef::Own(OwnSheet { id: id.to_owned(), path, sha256 }))
}

impl From<&Process> for ProcessKeys {
    fn from(process: &Process) -> Self {
        let spaces = process.spaces();
        let mut keys = Self {
            approach: process.approach(),
            ev: spaces.ev,
            scene_white: spaces.scene_white,
            input_space: spaces.input_space,
            output_space: spaces.output_space,
            output_coding: spaces.output_coding,
            white_luminance: spaces.white_luminance,
            ..Self::default()
        };
        if let Some(camera) = process.camera() {
            camera.id().clone_into(&mut keys.camera);
            (keys.camera_sheet, keys.camera_sha256) = sheet_of(camera);
            keys.print = match process.print() {
                None if process.is_scanned() => Some(SCAN.to_owned()),
                print => print.map(|print| print.id().to_owned()),
            };
            (keys.print_sheet, keys.print_sha256) = process.print().map_or((None, None), sheet_of);
        }
        match process {
            Process::Film(film) => keys.take_film(film),
            Process::Print(print) => keys.take_print_alone(print),
            Process::First(first) => {
                (keys.neutral_density, keys.first) = (first.neutral_density, first.controls.clone());
            }
            Process::Tone(_) => {}
        }
        keys
    }
}

impl ProcessKeys {
    fn take_print_alone(&mut self, print: &PrintAlone) {
        NO_CAMERA.clone_into(&mut self.camera);
        self.print = Some(print.film.id().to_owned());
        (self.print_sheet, self.print_sha256) = sheet_of(&print.film);
        (self.aim, self.neutral_density, self.dyes) = (print.aim, print.neutral_density, print.dyes);
        (self.print_curves, self.points) = (print.curves, print.points);
        (self.projector, self.white) = (print.projector, print.white);
    }

    fn take_film(&mut self, film: &FilmProcess) {
        (self.aim, self.neutral_density, self.overexposure) = (film.aim, film.neutral_density, film.overexposure);
        (self.dyes, self.matching) = (film.dyes, film.matching);
        (self.inter_image, self.gamut, self.white) = (film.inter_image, film.gamut, film.white);
        (self.reconstruction, self.projector) = (film.reconstruction, film.projector);
        let Effects { film_format, grain, sharpness, halation, antihalation, seed } = film.effects;
        (self.film_format, self.grain, self.sharpness) = (film_format, grain, sharpness);
        (self.halation, self.antihalation, self.seed) = (halation, antihalation, seed);
        if let Some(print) = &film.print {
            self.print_curves = print.curves;
            (self.light, self.filters, self.beam_density) = (print.light, print.filters, print.beam_density);
            (self.calibration, self.points) = (print.calibration, print.points);
            (self.infrared, self.glass, self.red_tail) = (print.infrared, print.glass, print.red_tail);
        }
    }
}

fn sheet_of(film: &StockRef) -> (Option<String>, Option<String>) {
    film.own_sheet().map_or((None, None), |sheet| (Some(sheet.path.clone()), Some(sheet.sha256.clone())))
}

/// As the keys of `look.toml`.
impl Serialize for Process {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        ProcessKeys::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Process {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        ProcessKeys::deserialize(deserializer)?.process().map_err(de::Error::custom)
    }
}
