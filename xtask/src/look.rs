//! The look on the command line: the same words everywhere.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use onelight::{Aim, DyeModel, Process, TransferCurve, WorkingSpace};

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
    /// Film in the camera, such as kodak-5207 (`cargo xtask stocks` lists all) [default: kodak-5207]
    #[arg(long, value_name = "ID")]
    camera: Option<String>,
    /// Film that a negative is printed on, or none [default: kodak-2383 for negatives]
    #[arg(long, value_name = "ID|none")]
    print: Option<String>,
    /// What an 18 % grey card becomes [default: neutral]
    #[arg(long, value_parser = words::<Aim>())]
    aim: Option<Aim>,
    /// How densities become amounts of dye [default: wedge]
    #[arg(long, value_parser = words::<DyeModel>())]
    dyes: Option<DyeModel>,
    /// Primaries of the scene-linear picture [default: what an EXR's chromaticities say, else the look's, else srgb]
    #[arg(long, value_parser = words::<WorkingSpace>())]
    input_space: Option<WorkingSpace>,
    /// Primaries of the display [default: srgb]
    #[arg(long, value_parser = words::<WorkingSpace>())]
    output_space: Option<WorkingSpace>,
    /// Transfer curve of the display [default: srgb]
    #[arg(long, value_parser = words::<TransferCurve>())]
    output_coding: Option<TransferCurve>,
    #[command(flatten)]
    switches: Switches,
}

impl LookArguments {
    /// The process that the arguments describe.
    pub(crate) fn process(&self) -> Result<Process> {
        let mut process = match (&self.look, &self.camera) {
            (Some(file), _) => read(file)?,
            (None, Some(camera)) => Process::for_camera(camera)?,
            (None, None) => Process::default(),
        };
        if let (Some(_), Some(camera)) = (&self.look, &self.camera) {
            let usual = Process::for_camera(camera)?.print;
            // The file's print film stays where the new camera film needs one.
            let print = usual.map(|usual| process.print.unwrap_or(usual));
            process = Process { camera: camera.clone(), print, ..process };
        }
        if let Some(print) = &self.print {
            process.print = Process::parse_print(print)?;
        }
        process.aim = self.aim.unwrap_or(process.aim);
        process.dyes = self.dyes.unwrap_or(process.dyes);
        process.input_space = self.input_space.unwrap_or(process.input_space);
        process.output_space = self.output_space.unwrap_or(process.output_space);
        process.output_coding = self.output_coding.unwrap_or(process.output_coding);
        self.switches.apply(&mut process);
        Ok(process)
    }

    /// Whether the command line says which films to use.
    pub(crate) fn names_film(&self) -> bool {
        self.look.is_some() || self.camera.is_some()
    }

    /// Whether the command line says what the input's primaries are: only that weighs more than the input's own word.
    pub(crate) fn names_input_space(&self) -> bool {
        self.input_space.is_some()
    }
}

fn read(path: &Path) -> Result<Process> {
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
    Ok(Process::from_toml(&name, &text)?)
}
