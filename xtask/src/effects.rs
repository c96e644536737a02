//! Sharpness, halation and grain on the command line: the same words as in look.toml.

use clap::Args;
use onelight::spatial::{Antihalation, FilmFormat};
use onelight::{EffectChoice, ProcessKeys};

use crate::words::words;

/// What film does to a picture, not to a colour; docs/spatial.md has pictures of each.
#[derive(Debug, Args)]
#[command(next_help_heading = "Sharpness, halation and grain (docs/spatial.md), which tables cannot have")]
pub(crate) struct EffectSwitches {
    /// How large the picture is on the film, without which all three are left out [default: none]
    #[arg(long, value_name = "super35|academy|super16|super8|still36|65mm|WIDTHmm|none", value_parser = film_format)]
    film_format: Option<FormatChoice>,
    /// Grain of the camera film; without a film format there is none [default: auto]
    #[arg(long, value_parser = words::<EffectChoice>())]
    grain: Option<EffectChoice>,
    /// Scatter of light in the camera film, and adjacency of its development; without a film format there is none [default: auto]
    #[arg(long, value_parser = words::<EffectChoice>())]
    sharpness: Option<EffectChoice>,
    /// Light that returns from the back of the camera film; the density that decides it is on no sheet [default: off]
    #[arg(long, value_parser = words::<EffectChoice>())]
    halation: Option<EffectChoice>,
    /// Density of the layer that keeps light from returning, 0 to 3, or none; usual ones are assumed [default: 0.8]
    #[arg(long, value_name = "D|none", value_parser = antihalation)]
    antihalation: Option<Antihalation>,
    /// Another number, another pattern of grain [default: 0]
    #[arg(long, value_name = "N")]
    seed: Option<u32>,
}

/// A format of film, or none of them.
#[derive(Debug, Clone, Copy)]
struct FormatChoice(Option<FilmFormat>);

impl EffectSwitches {
    /// Turns the switches that the command line names.
    pub(crate) fn apply(&self, keys: &mut ProcessKeys) {
        if let Some(FormatChoice(format)) = self.film_format {
            keys.film_format = format;
        }
        keys.grain = self.grain.unwrap_or(keys.grain);
        keys.sharpness = self.sharpness.unwrap_or(keys.sharpness);
        keys.halation = self.halation.unwrap_or(keys.halation);
        keys.antihalation = self.antihalation.unwrap_or(keys.antihalation);
        keys.seed = self.seed.unwrap_or(keys.seed);
    }
}

fn film_format(text: &str) -> Result<FormatChoice, String> {
    ProcessKeys::parse_film_format(text).map(FormatChoice).map_err(|error| error.to_string())
}

fn antihalation(text: &str) -> Result<Antihalation, String> {
    ProcessKeys::parse_antihalation(text).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        switches: EffectSwitches,
    }

    #[test]
    fn words_are_those_of_the_description() {
        let line = |arguments: &[&str]| {
            let mut keys = ProcessKeys::default();
            Line::try_parse_from([&["line"], arguments].concat()).map(|line| line.switches.apply(&mut keys))?;
            Ok::<_, clap::Error>(keys)
        };
        let keys = line(&[
            "--film-format=12.5mm",
            "--grain=off",
            "--sharpness=on",
            "--halation=auto",
            "--antihalation=none",
            "--seed=7",
        ])
        .unwrap();
        let expected = "film_format = \"12.5mm\"\ngrain = \"off\"\nsharpness = \"on\"\nhalation = \"auto\"\nantihalation = \"none\"\nseed = 7\n";
        assert!(keys.to_toml().contains(expected), "{}", keys.to_toml());
        assert_eq!(line(&[]).unwrap(), ProcessKeys::default());
        let message = |argument| line(&[argument]).unwrap_err().to_string();
        assert!(message("--film-format=super9").contains("expected super35, academy"));
        assert!(message("--antihalation=thick").contains("a density from 0 to 3, or none"));
        assert!(message("--grain=yes").contains("off, on, auto"));
    }
}
