use onelight_printing::Aim;
use onelight_spectra::{DisplayCoding, DisplayDifference, TransferCurve};

use crate::error::Error;
use crate::process::{ColourSpaces, Process};

/// What a compiled look still says of its process: its name, its aim, and the RGB at both ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct About {
    pub(crate) name: String,
    pub(crate) aim: Aim,
    pub(crate) spaces: ColourSpaces,
    coding: DisplayCoding,
}

impl About {
    pub(crate) fn new(process: &Process) -> Self {
        Self {
            name: process.name(),
            aim: process.aim(),
            spaces: *process.spaces(),
            coding: process.spaces().display_coding(),
        }
    }

    pub(crate) fn coding(&self) -> DisplayCoding {
        self.coding
    }

    /// The same look with linear light for its output.
    pub(crate) fn in_linear_light(&self) -> Self {
        let spaces = ColourSpaces {
            output_coding: TransferCurve::Linear,
            white_luminance: ColourSpaces::default().white_luminance,
            ..self.spaces
        };
        Self { spaces, coding: spaces.display_coding(), ..self.clone() }
    }

    pub(crate) fn difference(&self) -> Result<DisplayDifference, Error> {
        self.spaces.difference()
    }
}
