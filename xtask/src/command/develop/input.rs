//! What the command line says of the picture that comes in.

use std::str::FromStr;

use anyhow::{Result, bail};
use clap::Args;
use onelight::{InputCoding, InputColours, InputPrimaries, InputWhite, Process, Word as _};
use onelight_picture::{Limits, PartChoice, Selection};

use crate::words::words;

/// The picture that comes in: which of a file, and what its numbers mean.
#[derive(Debug, Args)]
#[command(next_help_heading = "Picture that comes in")]
pub(crate) struct InputArguments {
    /// Layer of an EXR, by its name or the last word of it [default: the one that is called a finished picture]
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,
    /// Part of an EXR, by its number from 1 or its name
    #[arg(long, value_name = "N|NAME", value_parser = part)]
    part: Option<PartChoice>,
    /// How the picture's numbers are coded; a camera's log brings its primaries unless --input-space names others [default: what
    /// the file says, else srgb for integers, linear for floats]
    #[arg(long, value_parser = words::<InputCoding>())]
    input_coding: Option<InputCoding>,
    /// What the white of the picture's space is [default: relative; absolute for XYZ]
    #[arg(long, value_parser = words::<InputWhite>())]
    input_white: Option<InputWhite>,
    /// What lies behind a picture with alpha, scene-linear and before --ev; none keeps the alpha [default: none, and black
    /// where there is light without coverage]
    #[arg(long, value_name = "none|black|R,G,B")]
    background: Option<Background>,
    /// Most pixels of a picture that is read
    #[arg(long, default_value_t = Limits::default().max_pixels, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) max_pixels: u64,
}

/// The same, for every picture of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct InputSettings {
    pub(super) selection: Selection,
    /// What the numbers are, as far as it was named.
    pub(super) colours: InputColours,
    pub(super) background: Option<onelight::Background>,
}

/// [`onelight::Background`] as it is typed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Background(onelight::Background);

impl FromStr for Background {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected none, black, or red, green and blue such as 0.18,0.18,0.18".to_owned();
        match text {
            "none" => return Ok(Self(onelight::Background::None)),
            "black" => return Ok(Self(onelight::Background::Light([0.0; 3]))),
            _ => {}
        }
        let numbers: Option<Vec<f32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[r, g, b]) if [r, g, b].iter().all(|v: &f32| v.is_finite() && *v >= 0.0) => {
                Ok(Self(onelight::Background::Light([r, g, b])))
            }
            _ => Err(expected()),
        }
    }
}

fn part(text: &str) -> Result<PartChoice, String> {
    match PartChoice::from(text) {
        PartChoice::Number(0) => Err("expected a number from 1, or a name".to_owned()),
        choice => Ok(choice),
    }
}

impl InputArguments {
    /// For the pictures of a run; `names_space` where the command line has the picture's primaries too.
    pub(super) fn settings(&self, names_space: bool) -> InputSettings {
        let primaries = if names_space { InputPrimaries::OfLook } else { InputPrimaries::OfFile };
        InputSettings {
            selection: Selection { layer: self.layer.clone(), part: self.part.clone() },
            colours: InputColours { coding: self.input_coding, primaries, white: self.input_white },
            background: self.background.map(|Background(background)| background),
        }
    }
}

impl InputSettings {
    /// Codes of a scan for what prints them, and nothing else.
    pub(super) fn match_to(&mut self, process: &Process) -> Result<()> {
        match (process, self.colours.coding) {
            (Process::Print(_), None) => self.colours.coding = Some(InputCoding::Cineon),
            (Process::Print(_), Some(InputCoding::Cineon)) => {}
            (Process::Print(_), Some(coding)) => bail!(
                "--camera none prints codes of a scanned negative, expected --input-coding cineon instead of {}",
                coding.word()
            ),
            (_, Some(InputCoding::Cineon)) => bail!(
                "--input-coding cineon is of a scanned negative, which a camera film is not exposed by, expected --camera none with it"
            ),
            _ => {}
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backgrounds_are_words_or_three_numbers() {
        let parse = |text: &str| text.parse().map(|Background(background)| background);
        assert_eq!(parse("none"), Ok(onelight::Background::None));
        assert_eq!(parse("black"), Ok(onelight::Background::Light([0.0; 3])));
        assert_eq!(parse("0.5, 1,2"), Ok(onelight::Background::Light([0.5, 1.0, 2.0])));
        for text in ["", "white", "1", "1,2", "1,2,3,4", "-1,0,0", "nan,0,0", "1,2,inf"] {
            assert!(text.parse::<Background>().is_err(), "{text}");
        }
        assert!(part("0").is_err());
        assert_eq!(part("2"), Ok(PartChoice::Number(2)));
    }
}
