//! From the numbers of a picture to the exposure of a film: steps 1 and 2 of the talk.

use std::str::FromStr;

use anyhow::{Result, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use onelight::film::{Camera, FrameBufferScale};
use onelight::spectra::{BufferFormat, white_lumens_per_watt};

use onelight::Stock;

use crate::look::ChosenLook;

/// How a picture's numbers become exposure, and the frame buffer between.
#[derive(Debug, Args)]
#[command(next_help_heading = "Exposure")]
pub(crate) struct ExposureArguments {
    /// What the picture's numbers are
    #[arg(long, default_value = "relative")]
    unit: Unit,
    /// Shutter time in s, such as 1/60: with --unit lux, w-per-m2 or stored
    #[arg(long, value_name = "S", value_parser = seconds)]
    shutter: Option<f64>,
    /// F-number of the lens
    #[arg(long, value_name = "N")]
    f_number: Option<f64>,
    /// Speed that the exposure is normal for [default: the camera film's]
    #[arg(long, value_name = "SPEED")]
    iso: Option<f64>,
    /// Low-precision frame buffer that the picture goes through before the film
    #[arg(long, value_parser = buffers())]
    buffer: Option<BufferFormat>,
    /// What the numbers are multiplied by in the buffer, or camera: the talk's 1000 t / (F ISO/100) [default: 1]
    #[arg(long, value_name = "X|camera", requires = "buffer")]
    buffer_scale: Option<BufferScale>,
}

/// What the numbers of a picture are. White is 6500 K.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Unit {
    /// 0.18 is a grey card, properly exposed
    Relative,
    /// Lux that a surface sends back: illuminance times reflectance
    Lux,
    /// The same in W/m^2 between 380 and 780 nm
    WPerM2,
    /// The talk's stored unit, mJ/m^2 per F per ISO 100, F being the square of the f-number
    Stored,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum BufferScale {
    Factor(f64),
    Camera,
}

impl FromStr for BufferScale {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse::<f64>() {
            _ if text == "camera" => Ok(Self::Camera),
            Ok(factor) if (1e-12..=1e12).contains(&factor) => Ok(Self::Factor(factor)),
            _ => Err("expected a factor from 1e-12 to 1e12, or camera".to_owned()),
        }
    }
}

/// A shutter time: a number, or a fraction as cameras show it.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let parse = |text: &str| text.parse::<f64>().ok();
    let seconds = match text.split_once('/') {
        Some((above, below)) => parse(above).zip(parse(below)).map(|(above, below)| above / below),
        None => parse(text),
    };
    seconds.filter(|s| s.is_finite() && *s > 0.0).ok_or_else(|| "expected seconds, such as 1/60 or 0.5".to_owned())
}

fn buffers() -> impl TypedValueParser<Value = BufferFormat> {
    let names = BufferFormat::ALL.map(|format| PossibleValue::new(format.name()));
    let find = |name: String| BufferFormat::ALL.into_iter().find(|format| format.name() == name);
    PossibleValuesParser::new(names).try_map(move |name| find(name).ok_or("expected a buffer"))
}

/// The arguments, resolved for a process.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SceneExposure {
    /// Scene value (0.18 is a grey card) of the number 1.
    factor: f64,
    metered: bool,
    /// Format, and stored value of the number 1.
    buffer: Option<(BufferFormat, f64)>,
    /// What was done, in words.
    pub(crate) notes: Vec<String>,
}

impl ExposureArguments {
    /// What to do with each pixel before the film.
    pub(crate) fn resolve(&self, look: &ChosenLook) -> Result<SceneExposure> {
        let mut notes = Vec::new();
        let settings = [
            ("--shutter", self.shutter.is_some()),
            ("--f-number", self.f_number.is_some()),
            ("--iso", self.iso.is_some()),
        ];
        let camera = if self.unit == Unit::Relative {
            if let Some((name, _)) = settings.iter().find(|(_, given)| *given) {
                bail!(
                    "--unit relative is exposed already: {name} changes nothing, expected --unit lux or w-per-m2 with it"
                );
            }
            None
        } else {
            let (Some(shutter), Some(f_number)) = (self.shutter, self.f_number) else {
                let [(shutter, _), (f_number, _), _] = settings;
                bail!("--unit {} needs a camera, expected {shutter} and {f_number} with it", self.unit.word());
            };
            let speed = match self.iso {
                Some(speed) => speed,
                None => look.of_camera(Stock::exposure_index)?.unwrap_or(100.0),
            };
            Some((shutter, f_number, speed))
        };
        let (mut factor, mut stored) = (1.0, None);
        if let Some((shutter, f_number, speed)) = camera {
            let camera = Camera::new(shutter, f_number)?;
            let scale = FrameBufferScale::new(shutter, f_number * f_number, speed)?.stored(1.0);
            let lux = match self.unit {
                Unit::Relative | Unit::Lux => 1.0,
                Unit::WPerM2 => white_lumens_per_watt(),
                Unit::Stored => white_lumens_per_watt() / scale,
            };
            factor = camera.scene_value(lux, speed)?;
            stored = Some(scale * lux / white_lumens_per_watt());
            let white = camera.scene_value(1000.0, speed)?;
            notes.push(format!(
                "{shutter:.4} s at f/{f_number}, ISO {speed}: white under 1000 lux lies {:+.1} stops from white",
                white.log2()
            ));
        }
        let buffer = match (self.buffer, self.buffer_scale, stored) {
            (None, _, _) => None,
            (Some(format), None, _) => Some((format, 1.0)),
            (Some(format), Some(BufferScale::Factor(scale)), _) => Some((format, scale)),
            (Some(format), Some(BufferScale::Camera), Some(stored)) => Some((format, stored)),
            (Some(_), Some(BufferScale::Camera), None) => {
                bail!(
                    "--buffer-scale camera needs a camera, expected --unit lux or w-per-m2 with --shutter and --f-number"
                )
            }
        };
        if let Some((format, scale)) = buffer {
            notes.push(format!("through a {} buffer that stores the numbers times {scale:.4}", format.name()));
        }
        Ok(SceneExposure { factor, metered: stored.is_some(), buffer, notes })
    }
}

impl Unit {
    fn word(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

impl SceneExposure {
    /// Whether pixels stay as they are.
    pub(crate) fn changes_nothing(&self) -> bool {
        self.factor == 1.0 && self.buffer.is_none()
    }

    /// Whether a camera decides how bright the picture is.
    pub(crate) fn is_metered(&self) -> bool {
        self.metered
    }

    /// All that [`apply`](Self::apply) depends on, in one line.
    pub(crate) fn in_numbers(&self) -> String {
        let buffer =
            self.buffer.map_or("no buffer".to_owned(), |(format, scale)| format!("{} of {scale:?}", format.name()));
        format!("times {:?}, {buffer}", self.factor)
    }

    /// A pixel as the film gets it. NaN and infinities stay what they are unless a buffer takes them.
    pub(crate) fn apply(&self, rgb: [f32; 3]) -> [f32; 3] {
        let stored = match self.buffer {
            Some((format, scale)) => format.quantise(rgb.map(|v| f64::from(v) * scale)).map(|v| v / scale),
            None => rgb.map(f64::from),
        };
        stored.map(|v| (v * self.factor) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        exposure: ExposureArguments,
    }

    fn resolve(arguments: &str) -> Result<SceneExposure> {
        let line = Line::try_parse_from(["line"].into_iter().chain(arguments.split_whitespace()))?;
        line.exposure.resolve(&onelight::Process::default().into())
    }

    fn grey(arguments: &str, value: f32) -> f32 {
        resolve(arguments).unwrap().apply([value; 3])[1]
    }

    #[test]
    fn a_metered_grey_card_is_mid_grey_in_every_unit() {
        // L = 12.5 N^2 / (t S), and the card sends back pi L lux.
        let lux = (std::f64::consts::PI * 12.5 * 2.8 * 2.8 * 60.0 / 400.0) as f32;
        let camera = "--shutter 1/60 --f-number 2.8 --iso 400";
        let watts = lux / white_lumens_per_watt() as f32;
        let stored = watts * (1000.0 / 60.0 / (2.8 * 2.8 * 4.0)) as f32;
        for (unit, value) in [("lux", lux), ("w-per-m2", watts), ("stored", stored)] {
            let scene = grey(&format!("--unit {unit} {camera}"), value);
            assert!((scene / 0.18 - 1.0).abs() < 0.005, "{unit}: {scene}");
        }
        // The film's own speed where none is named: 5207 is 250.
        let slower = grey("--unit lux --shutter 1/60 --f-number 2.8", lux);
        assert!((slower / 0.18 - 250.0 / 400.0).abs() < 0.005, "{slower}");
        assert_eq!(grey("", 0.3), 0.3);
    }

    #[test]
    fn buffers_keep_what_their_scale_brings_into_their_range() {
        assert_eq!(grey("--buffer unorm8", 4.0), 1.0);
        assert!((grey("--buffer unorm8 --buffer-scale 0.25", 3.9) - 3.9).abs() < 0.01);
        assert_eq!(grey("--buffer float7e3", 0.18), 0.1796875);
        // A street lamp's 20 lux is next to nothing in W/m^2, and not where the talk's factor is.
        let lamp = |scale: &str| {
            let line = format!("--unit w-per-m2 --shutter 1/24 --f-number 1.4 --buffer unorm8 --buffer-scale {scale}");
            let watts = (20.0 / white_lumens_per_watt()) as f32;
            let exact = grey("--unit w-per-m2 --shutter 1/24 --f-number 1.4", watts);
            (grey(&line, watts) / exact - 1.0).abs()
        };
        assert!(lamp("camera") < 0.2 * lamp("0.1"), "{} {}", lamp("camera"), lamp("0.1"));
    }

    #[test]
    fn contradictions_are_named() {
        let message = |arguments: &str| resolve(arguments).unwrap_err().to_string();
        assert!(message("--shutter 1/60").contains("--shutter changes nothing"));
        assert!(message("--unit lux --shutter 1/60").contains("--f-number"));
        assert!(message("--buffer half --buffer-scale camera").contains("needs a camera"));
        assert!(message("--unit lux --shutter 0 --f-number 2").contains("1/60"));
        assert!(message("--unit lux --shutter 1/60 --f-number 0").contains("f-number: found 0"));
        assert!(message("--unit lux --shutter 1/60 --f-number 2 --iso 0").contains("exposure index: found 0"));
        assert!(message("--buffer-scale 2").contains("--buffer"));
    }
}
