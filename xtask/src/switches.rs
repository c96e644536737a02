//! The switches of the talk on the command line: the same words as in look.toml.

use std::str::FromStr;

use anyhow::{Result, bail};
use clap::Args;
use onelight::{
    Approach, Calibration, Filters, HeatGlass, Infrared, InterImageChoice, Matching, PrintCurves, PrinterLight,
    ProcessKeys, Projector, Reconstruction, Tail, White, WideGamut, Word, Wratten,
};

use crate::words::words;

/// What each step of the simulation can be changed to; docs/talk.md has the size of each.
#[derive(Debug, Args)]
#[command(next_help_heading = "Switches of the talk (docs/talk.md)")]
pub(crate) struct Switches {
    /// The simulation, the talk's first approach, or a tone mapping to compare with [default: second]
    #[arg(long, value_parser = words::<Approach>())]
    approach: Option<Approach>,
    /// Equivalent neutral density of a grey card in neutral aim, 0.05 to 3 [default: 0.7]
    #[arg(long, value_name = "D")]
    neutral_density: Option<f64>,
    /// Stops that the camera film is exposed over normal, the print corrected for it [default: 0]
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true)]
    overexposure: Option<f64>,
    /// A list of settings at once; options typed beside it win. talk: film by its sheet alone, as in 2010
    /// (--interimage none --white lamp --gamut clip)
    #[arg(long, value_enum)]
    preset: Option<Preset>,
    /// How strongly the camera film's layers inhibit each other: its own (film), none, negative, reversal, or log10 exposure for
    /// a unit of density between layers that touch and those that do not [default: film]
    #[arg(long = "interimage", value_name = "film|none|negative|reversal|NEAR,FAR", value_parser = inter_image)]
    inter_image: Option<InterImageChoice>,
    /// What light outside the sRGB primaries does [default: compress]
    #[arg(long, value_parser = words::<WideGamut>())]
    gamut: Option<WideGamut>,
    /// What the characteristic curves of the print film's sheet are [default: neutral]
    #[arg(long, value_parser = words::<PrintCurves>())]
    print_curves: Option<PrintCurves>,
    /// What a viewer takes for white: clear film, or the projector's bare lamp [default: film]
    #[arg(long, value_parser = words::<White>())]
    white: Option<White>,
    /// How exposures meet the characteristic curves [default: grey]
    #[arg(long, value_parser = words::<Matching>())]
    matching: Option<Matching>,
    /// How a spectrum is made for an RGB value [default: smooth]
    #[arg(long, value_parser = words::<Reconstruction>())]
    reconstruction: Option<Reconstruction>,
    /// The printer's light [default: separations]
    #[arg(long, value_parser = words::<PrinterLight>())]
    light: Option<PrinterLight>,
    /// Gelatin filters in the printer, comma-separated, or none [default: 70,99,98,2b]
    #[arg(long, value_name = "NUMBERS|none", value_parser = filters)]
    filters: Option<Filters>,
    /// Neutral density in the printer's red, green and blue beam [default: 0.5,0.55,0.9]
    #[arg(long, value_name = "R,G,B", value_parser = triple)]
    beam_density: Option<Triple>,
    /// How the printer's lights are found: exactly, or by so many of the talk's iterations [default: exact]
    #[arg(long, value_name = "exact|N", value_parser = calibration)]
    calibration: Option<Calibration>,
    /// Printer points on red, green and blue light: 0.025 log10 exposure each [default: 0,0,0]
    #[arg(long, value_name = "R,G,B", value_parser = triple, allow_hyphen_values = true)]
    points: Option<Triple>,
    /// Whether infrared takes part in printing [default: on]
    #[arg(long, value_parser = words::<Infrared>())]
    infrared: Option<Infrared>,
    /// The heat glass of the printer [default: no-2043]
    #[arg(long, value_parser = words::<HeatGlass>())]
    glass: Option<HeatGlass>,
    /// How the print's red layer goes on beyond its sheet [default: log-linear]
    #[arg(long, value_parser = words::<Tail>())]
    red_tail: Option<Tail>,
    /// The light that the film is seen by [default: display]
    #[arg(long, value_parser = words::<Projector>())]
    projector: Option<Projector>,
    /// First approach: steepness about mid grey [default: 1]
    #[arg(long, value_name = "X")]
    contrast: Option<f64>,
    /// First approach: added to the display-coded value [default: 0]
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    brightness: Option<f64>,
    /// First approach: colour of the light that white should look like, in K [default: 6500]
    #[arg(long, value_name = "KELVIN")]
    temperature: Option<f64>,
    /// First approach: distance from grey [default: 1]
    #[arg(long, value_name = "X")]
    saturation: Option<f64>,
    /// First approach: points the tone curve is bent through, stops about mid grey and display-coded value
    #[arg(long, value_name = "STOPS:VALUE,...", value_delimiter = ',', value_parser = point, allow_hyphen_values = true)]
    curve: Vec<Point>,
}

/// Settings that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Preset {
    /// Film by its sheet alone, as the talk has it.
    Talk,
}

/// Three numbers on the command line, for red, green and blue.
type Triple = [f64; 3];
/// A point of a tone curve: stops about mid grey, and the display-coded value.
type Point = [f64; 2];

impl Switches {
    /// Turns the switches that the command line names.
    pub(crate) fn apply(&self, keys: &mut ProcessKeys) {
        macro_rules! turn {
            ($($field:ident),+ of $target:expr) => {
                $(if let Some(value) = self.$field { $target.$field = value; })+
            };
        }
        match self.preset {
            Some(Preset::Talk) => keys.set_talk(),
            None => {}
        }
        turn!(inter_image, gamut, print_curves, white of keys);
        turn!(approach, neutral_density, overexposure, matching, reconstruction, light, filters, beam_density of keys);
        turn!(calibration, points, infrared, glass, red_tail, projector of keys);
        turn!(contrast, brightness, temperature, saturation of keys.first);
        if !self.curve.is_empty() {
            keys.first.curve.clone_from(&self.curve);
        }
    }
}

impl Switches {
    /// Refuses what the exact solution of the printer's lights undoes.
    pub(crate) fn refuse_idle(&self, keys: &ProcessKeys) -> Result<()> {
        if self.beam_density.is_some() && keys.calibration == Calibration::Exact {
            bail!(
                "--beam-density changes nothing where lights are found exactly, expected --calibration with a number of iterations"
            );
        }
        Ok(())
    }
}

fn filters(text: &str) -> Result<Filters, String> {
    if text == "none" {
        return Ok(Filters::of(&[]));
    }
    let filters: Result<Vec<Wratten>, _> = text.split(',').map(Wratten::parse).collect();
    filters.map(|filters| Filters::of(&filters)).map_err(|error| error.to_string())
}

fn inter_image(text: &str) -> Result<InterImageChoice, String> {
    ProcessKeys::parse_inter_image(text).map_err(|error| error.to_string())
}

fn calibration(text: &str) -> Result<Calibration, String> {
    ProcessKeys::parse_calibration(text).map_err(|error| error.to_string())
}

fn triple(text: &str) -> Result<Triple, String> {
    numbers(text, ',').ok_or_else(|| "expected three numbers, red, green, blue, such as 1,0,-1".to_owned())
}

fn point(text: &str) -> Result<Point, String> {
    numbers(text, ':').ok_or_else(|| "expected stops about mid grey and a value, such as -2:0.2".to_owned())
}

fn numbers<const N: usize>(text: &str, between: char) -> Option<[f64; N]> {
    let numbers: Result<Vec<f64>, _> = text.split(between).map(f64::from_str).collect();
    numbers.ok()?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        switches: Switches,
    }

    fn process(arguments: &[&str]) -> ProcessKeys {
        let mut keys = ProcessKeys::default();
        Line::parse_from([&["line"], arguments].concat()).switches.apply(&mut keys);
        keys
    }

    /// Every key of look.toml but the look's own options can be turned on the command line, with the same words.
    #[test]
    fn every_switch_of_a_look_is_on_the_command_line() {
        let arguments = [
            "--approach=first",
            "--neutral-density=1",
            "--overexposure=-1",
            "--matching=absolute",
            "--interimage=0.5,0.1",
            "--gamut=clip",
            "--print-curves=principal",
            "--white=lamp",
            "--reconstruction=boxes-raw",
            "--light=white",
            "--filters=70,99",
            "--beam-density=0,0.1,0",
            "--calibration=2",
            "--points=1,0,-1",
            "--infrared=off",
            "--glass=none",
            "--red-tail=held",
            "--projector=xenon",
            "--contrast=1.1",
            "--brightness=-0.1",
            "--temperature=5000",
            "--saturation=0.9",
            "--curve=-2:0.2,0:0.5",
        ];
        let (plain, turned) = (ProcessKeys::default(), process(&arguments));
        let keys = |keys: &ProcessKeys| keys.to_toml().parse::<toml::Table>().unwrap();
        let (before, after) = (keys(&plain), keys(&turned));
        let look = [
            "version",
            "camera",
            "print",
            "aim",
            "dyes",
            "ev",
            "scene_white",
            "input_space",
            "output_space",
            "output_coding",
            "white_luminance",
        ];
        let effects = ["film_format", "grain", "sharpness", "halation", "antihalation", "seed"];
        for (key, value) in &after {
            assert_eq!(before[key] == *value, [&look[..], &effects].concat().contains(&key.as_str()), "{key}");
        }
        for (key, value) in after["first"].as_table().unwrap() {
            assert!(before["first"].get(key) != Some(value), "first.{key}");
        }
        assert_eq!(turned.first.curve, [[-2.0, 0.2], [0.0, 0.5]]);
        assert_eq!(process(&["--filters=none"]).filters, Filters::of(&[]));
        assert_eq!(process(&[]), plain);
        let mut talk = plain.clone();
        talk.set_talk();
        assert_eq!(process(&["--preset=talk"]), talk);
        // What is typed beside a preset wins, before or after it.
        assert_eq!(process(&["--white=film", "--preset=talk"]).white, White::Film);
    }

    #[test]
    fn mistakes_are_named() {
        let message = |argument: &str| Line::try_parse_from(["line", argument]).map(|_| ()).unwrap_err().to_string();
        assert!(message("--points=1,2").contains("three numbers"));
        assert!(message("--curve=1").contains("-2:0.2"));
        assert!(message("--filters=71").contains("one of 70, 99, 98, 2b"));
        assert!(message("--calibration=99").contains("0 to 30"));
    }
}
