//! The look on the command line: the same words everywhere.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result, bail};
use clap::Args;
use onelight::spectra::SceneWhite;
use onelight::{
    Aim, Approach, DyeModel, FilmEffects, Films, FormatVersion, Look, Process, ProcessKeys, SheetKeys, Stock,
    StockKind, StockRef, TransferCurve, WorkingSpace, stock, stock_named,
};

use crate::effects::EffectSwitches;
use crate::own_stock::{self, OwnStock};
use crate::switches::Switches;
use crate::words::words;

/// Longest description that is read.
const MAX_LOOK_BYTES: u64 = 64 * 1024;

/// The look: a description file, and what the command line changes in it.
#[derive(Debug, Args)]
#[command(next_help_heading = "Look")]
pub(crate) struct LookArguments {
    /// Description of a look (look.toml) to begin with; the options below change it
    #[arg(long, value_name = "FILE")]
    look: Option<PathBuf>,
    /// Film in the camera, such as kodak-5207 or a part of a name that fits one film, such as velvia (`cargo xtask stocks` lists all), or a
    /// folder with a data sheet of your own in the form of stocks/kodak-5207, or none to print a scanned negative (--input-coding cineon)
    /// [default: kodak-5207]; bake --for ocio takes several between commas
    #[arg(long, value_name = "NAME|DIR|none")]
    camera: Option<String>,
    /// Film that a negative is printed on, or a folder with its data sheet; scan for a negative that is scanned and inverted, or none
    /// [default: kodak-2383 for negatives]
    #[arg(long, value_name = "NAME|DIR|scan|none")]
    print: Option<String>,
    /// What an 18 % grey card becomes [default: neutral]
    #[arg(long, value_parser = words::<Aim>())]
    aim: Option<Aim>,
    /// How densities become amounts of dye [default: wedge]
    #[arg(long, value_parser = words::<DyeModel>())]
    dyes: Option<DyeModel>,
    /// Light that becomes neutral before the film, in K with a tint (positive is greener than a black body), such as 3200 or 5600,10;
    /// none leaves white at 6500 K [default: none]
    #[arg(long, value_name = "KELVIN[,TINT]|none", value_parser = scene_white, allow_hyphen_values = true)]
    scene_white: Option<SceneLight>,
    /// Primaries of the scene-linear picture [default: what an EXR's chromaticities say, else the look's, else srgb]
    #[arg(long, value_parser = words::<WorkingSpace>())]
    input_space: Option<WorkingSpace>,
    /// Primaries of the display [default: srgb]
    #[arg(long, value_parser = words::<WorkingSpace>())]
    output_space: Option<WorkingSpace>,
    /// Transfer curve of the display [default: srgb]
    #[arg(long, value_parser = words::<TransferCurve>())]
    output_coding: Option<TransferCurve>,
    /// Luminance of the display's white in cd/m2, for pq and hlg [default: 203]
    #[arg(long, value_name = "CD_M2")]
    white_luminance: Option<f64>,
    #[command(flatten)]
    switches: Switches,
    #[command(flatten)]
    effects: EffectSwitches,
}

/// The light of a scene that is to look white; none leaves white where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SceneLight(Option<SceneWhite>);

fn scene_white(text: &str) -> Result<SceneLight, String> {
    ProcessKeys::parse_scene_white(text).map(SceneLight).map_err(|error| error.to_string())
}

/// A look that was chosen: its description, and the stocks where it names data sheets of one's own.
#[derive(Debug, Clone)]
pub(crate) struct ChosenLook {
    pub(crate) process: Process,
    films: Option<Arc<Films>>,
    /// The film that was named for the camera, which sets the exposure beside a tone mapping too.
    camera: String,
}

impl From<Process> for ChosenLook {
    /// A look of built-in stocks, without data sheets of one's own.
    fn from(process: Process) -> Self {
        let camera = process.camera().map_or(onelight::DEFAULT_CAMERA, StockRef::id).to_owned();
        Self { process, films: None, camera }
    }
}

impl ChosenLook {
    /// Compiles the look, with the data sheets of one's own that it uses.
    pub(crate) fn look(&self) -> Result<Look> {
        Ok(self.films.as_ref().map_or_else(|| self.process.look(), |films| self.process.look_with(films))?)
    }

    /// Exposes the scene by so many stops, where the command line says how many, instead of by what the description says.
    pub(crate) fn expose(&mut self, ev: Option<f64>) {
        let spaces = self.process.spaces_mut();
        spaces.ev = ev.unwrap_or(spaces.ev);
    }

    /// As the measurements take it.
    #[cfg(feature = "measure")]
    pub(crate) fn described(&self) -> onelight_benches::DescribedLook {
        onelight_benches::DescribedLook { process: self.process.clone(), films: self.films.clone() }
    }

    /// The films, where a data sheet of one's own is among them.
    pub(crate) fn films(&self) -> Option<&Films> {
        self.films.as_deref()
    }

    /// What the camera film does to pictures, with the data sheets of one's own that it uses; `None` without a film format.
    pub(crate) fn effects(&self) -> Result<Option<FilmEffects>> {
        let Process::Film(process) = &self.process else { return Ok(None) };
        let found = match &self.films {
            Some(films) => FilmEffects::with(process, films),
            None => FilmEffects::new(process),
        };
        Ok(found?)
    }

    /// The same films by another process.
    pub(crate) fn with(&self, process: Process) -> Self {
        Self { process, films: self.films.clone(), camera: self.camera.clone() }
    }

    /// Asks the film in the camera; beside a tone mapping, the one that was named for it.
    pub(crate) fn of_camera<T>(&self, ask: impl Fn(&Stock) -> T) -> Result<T> {
        match &self.films {
            Some(films) => Ok(ask(&films.camera)),
            None => Ok(ask(&stock(&self.camera)?)),
        }
    }

    /// The description with data sheets of one's own by their digests alone: the same wherever they are.
    pub(crate) fn text_anywhere(&self) -> String {
        let mut keys = ProcessKeys::from(&self.process);
        (keys.camera_sheet, keys.print_sheet) = (None, None);
        keys.to_toml()
    }

    /// The description as `look.toml` in a folder: data sheets of one's own as seen from there.
    pub(crate) fn text_in(&self, folder: &Path) -> String {
        let mut keys = ProcessKeys::from(&self.process);
        for sheet in [&mut keys.camera_sheet, &mut keys.print_sheet].into_iter().flatten() {
            *sheet = own_stock::seen_from(folder, sheet);
        }
        keys.to_toml()
    }
}

/// The word of `--print` for a negative that is scanned.
const SCAN: &str = "scan";

/// A film that the command line or a description names.
enum Named {
    BuiltIn(String),
    Own(Box<OwnStock>),
}

impl Named {
    /// As an option has it; a part of a name goes to what `is_wanted` there.
    fn of_word(option: &str, word: &str, is_wanted: impl Fn(&Stock) -> bool) -> Result<Self> {
        if word != SCAN && own_stock::is_folder(word) {
            return own_stock::read(Path::new(word)).map(|own| Self::Own(Box::new(own)));
        }
        if word == "none" || word == SCAN {
            return Ok(Self::BuiltIn(word.to_owned()));
        }
        let found = stock_named(word, is_wanted).with_context(|| option.to_owned())?;
        if !word.eq_ignore_ascii_case(found.id()) {
            eprintln!("note: {option} {word}: taken for {}", found.id());
        }
        Ok(Self::BuiltIn(found.id().to_owned()))
    }

    /// Whether it stands for no film, but for a scan of the negative.
    fn is_scan(&self) -> bool {
        matches!(self, Self::BuiltIn(id) if id == SCAN)
    }

    /// As a description in `file` has it.
    fn of_keys(file: &Path, key: &str, id: &str, sheet: Option<SheetKeys<'_>>) -> Result<Self> {
        let Some(sheet) = sheet else { return Ok(Self::BuiltIn(id.to_owned())) };
        let variant = id.split_once('@').map_or_else(String::new, |(_, variant)| format!("@{variant}"));
        let folder = file.parent().unwrap_or(Path::new("")).join(format!("{}{variant}", sheet.path));
        let own = own_stock::read(&folder).with_context(|| format!("{}: {key}_sheet", file.display()))?;
        if own.sheet.sha256 != sheet.sha256 {
            bail!(
                "{}: the data sheet in {} has changed since: its SHA-256 is {}, expected {} (--{key} {1} takes it as it is now)",
                file.display(),
                folder.display(),
                own.sheet.sha256,
                sheet.sha256
            );
        }
        Ok(Self::Own(Box::new(own)))
    }

    /// The print film that goes with it in the camera; `known` stays where one is needed.
    fn usual_print(&self, known: Option<Named>) -> Result<Option<Named>> {
        let usual = match self {
            // A scan is printed on the usual film.
            Self::BuiltIn(id) if id == "none" => Some(onelight::DEFAULT_PRINT.to_owned()),
            Self::BuiltIn(id) => Process::for_camera(id)?.print().map(|print| print.id().to_owned()),
            Self::Own(own) => match own.stock.kind() {
                StockKind::Negative => Some(onelight::usual_print(own.stock.image()).to_owned()),
                // What is no film for a camera is refused with the rest.
                _ => None,
            },
        };
        Ok(usual.map(|usual| known.unwrap_or(Named::BuiltIn(usual))))
    }

    /// Writes it into the keys of a description: id, folder, digest.
    fn keys(&self) -> (String, Option<String>, Option<String>) {
        match self {
            Self::BuiltIn(id) => (id.clone(), None, None),
            Self::Own(own) => (own.sheet.id.clone(), Some(own.sheet.path.clone()), Some(own.sheet.sha256.clone())),
        }
    }

    fn stock(self) -> Result<Stock> {
        match self {
            Self::BuiltIn(id) => Ok(stock(&id)?),
            Self::Own(own) => Ok(own.stock),
        }
    }
}

impl LookArguments {
    /// The look that the arguments describe.
    pub(crate) fn chosen(&self) -> Result<ChosenLook> {
        self.chosen_with(self.camera.as_deref())
    }

    /// The looks that the arguments describe where `--camera` holds several films between commas.
    pub(crate) fn each(&self) -> Result<Vec<ChosenLook>> {
        match self.camera.as_deref().filter(|words| words.contains(',')) {
            Some(words) => words.split(',').map(|word| self.chosen_with(Some(word.trim()))).collect(),
            None => Ok(vec![self.chosen()?]),
        }
    }

    fn chosen_with(&self, camera: Option<&str>) -> Result<ChosenLook> {
        let mut keys = self.look.as_deref().map_or_else(|| Ok(ProcessKeys::default()), read)?;
        let (camera, print) = self.films(camera, &keys)?;
        (keys.camera, keys.camera_sheet, keys.camera_sha256) = camera.keys();
        (keys.print, keys.print_sheet, keys.print_sha256) = match print.as_ref().map(Named::keys) {
            Some((id, sheet, sha256)) => (Some(id), sheet, sha256),
            None => (None, None, None),
        };
        keys.aim = self.aim.unwrap_or(keys.aim);
        keys.dyes = self.dyes.unwrap_or(keys.dyes);
        keys.scene_white = self.scene_white.map_or(keys.scene_white, |light| light.0);
        keys.input_space = self.input_space.unwrap_or(keys.input_space);
        keys.output_space = self.output_space.unwrap_or(keys.output_space);
        keys.output_coding = self.output_coding.unwrap_or(keys.output_coding);
        keys.white_luminance = self.white_luminance.unwrap_or(keys.white_luminance);
        self.switches.apply(&mut keys);
        self.effects.apply(&mut keys);
        self.switches.refuse_idle(&keys)?;
        if keys.print.as_deref() == Some(SCAN) {
            eprintln!("note: print {SCAN}: {}", onelight::ScanRule::default().assumption());
        }
        if keys.camera_sheet.is_none() && keys.print_sheet.is_none() {
            return Ok(ChosenLook { process: keys.process()?, films: None, camera: keys.camera });
        }
        let print = print.filter(|print| !print.is_scan()).map(Named::stock).transpose()?;
        let films = Films { camera: camera.stock()?, print };
        Ok(ChosenLook { process: keys.process_with(&films)?, films: Some(Arc::new(films)), camera: keys.camera })
    }

    /// The film in the camera and the print film: the command line's, else those of the description.
    fn films(&self, camera: Option<&str>, keys: &ProcessKeys) -> Result<(Named, Option<Named>)> {
        let file = self.look.as_deref().unwrap_or(Path::new(""));
        let print = match (&self.print, &keys.print) {
            (Some(word), _) => {
                let is_wanted = |stock: &Stock| !stock.kind().is_camera_film();
                let word = ProcessKeys::parse_print(word)?;
                word.map(|word| Named::of_word("--print", &word, is_wanted)).transpose()?
            }
            (None, Some(id)) => Some(Named::of_keys(file, "print", id, keys.print_sheet())?),
            (None, None) => None,
        };
        let Some(word) = camera else {
            return Ok((Named::of_keys(file, "camera", &keys.camera, keys.camera_sheet())?, print));
        };
        let camera = Named::of_word("--camera", word, |stock| stock.kind().is_camera_film())?;
        if self.print.is_some() {
            return Ok((camera, print));
        }
        // The file's print film stays where the new camera film needs one.
        let print = camera.usual_print(self.look.is_some().then_some(print).flatten())?;
        Ok((camera, print))
    }

    /// Whether the command line says which films to use.
    #[cfg(feature = "measure")]
    pub(crate) fn names_film(&self) -> bool {
        self.look.is_some() || self.camera.is_some() || self.print.is_some()
    }

    /// Whether the command line or a description says how the display codes.
    pub(crate) fn names_output_coding(&self) -> bool {
        self.look.is_some() || self.output_coding.is_some()
    }

    /// Whether the command line itself says how the display codes.
    pub(crate) fn types_output_coding(&self) -> bool {
        self.output_coding.is_some()
    }

    /// Whether the command line says what the input's primaries are: only that weighs more than the input's own word.
    pub(crate) fn names_input_space(&self) -> bool {
        self.input_space.is_some()
    }
}

fn read(path: &Path) -> Result<ProcessKeys> {
    let name = path.display().to_string();
    if path.is_dir() {
        bail!("{name}: is a folder, expected a look.toml");
    }
    let file = File::open(path).with_context(|| format!("{name}: the look cannot be read"))?;
    let mut text = String::new();
    // One byte more than allowed shows that there is more.
    file.take(MAX_LOOK_BYTES + 1).read_to_string(&mut text).with_context(|| format!("{name}: the look is no text"))?;
    if text.len() as u64 > MAX_LOOK_BYTES {
        bail!("{name}: more than {MAX_LOOK_BYTES} bytes, expected a look.toml");
    }
    let keys = ProcessKeys::from_toml(&name, &text)?;
    if keys.version == FormatVersion::One && keys.approach == Approach::Second {
        eprintln!("note: {name}: version 1 has no interimage, white or gamut: read as none, lamp and clip");
    }
    Ok(keys)
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory as _, Parser};
    use toml::Value;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        look: LookArguments,
    }

    /// As it is typed: lists with commas.
    fn typed(value: &Value) -> String {
        match value {
            Value::String(word) => word.clone(),
            Value::Array(values) => values.iter().map(typed).collect::<Vec<_>>().join(","),
            other => other.to_string().trim_end_matches(".0").to_owned(),
        }
    }

    #[test]
    fn nothing_typed_is_the_default_of_the_library() {
        assert_eq!(Line::parse_from(["line"]).look.chosen().unwrap().process, Process::default());
    }

    /// Every key of look.toml, with what the help says that it is when left out.
    #[test]
    fn help_names_the_defaults_of_the_library() {
        let mut keys: toml::Table = ProcessKeys::default().to_toml().parse().unwrap();
        let Some(Value::Table(first)) = keys.remove("first") else { panic!("no controls of the first approach") };
        keys.remove("version");
        // Each command has an --ev of its own: that of develop may be auto.
        keys.remove("ev");
        keys.extend(first.into_iter().filter(|(key, _)| key != "curve"));
        let command = Line::command();
        for (key, value) in &keys {
            let option = key.replace('_', "-");
            let argument = command.get_arguments().find(|a| a.get_long() == Some(&option));
            let help = argument.and_then(|a| a.get_help()).unwrap_or_else(|| panic!("no --{option}")).to_string();
            let said = help.split("[default: ").nth(1).and_then(|rest| rest.split(']').next());
            let said = said.unwrap_or_else(|| panic!("--{option} says no default: {help}"));
            // What depends on the picture or the camera film ends or begins with the look's own.
            let same =
                [said.strip_suffix(" for negatives"), said.rsplit_once("else ").map(|(_, last)| last), Some(said)];
            assert!(same.contains(&Some(typed(value).as_str())), "--{option} says {said:?}, it is {value}");
        }
    }
}
