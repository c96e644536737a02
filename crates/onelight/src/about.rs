use onelight_printing::Aim;
use onelight_spectra::{DisplayDifference, TransferCurve};

use crate::error::Error;
use crate::process::{ColourSpaces, Process};

/// What a compiled look still says of its process: its name, its aim, and the RGB at both ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct About {
    pub(crate) name: String,
    pub(crate) aim: Aim,
    pub(crate) spaces: ColourSpaces,
}

impl About {
    pub(crate) fn new(process: &Process) -> Self {
        Self { name: process.name(), aim: process.aim(), spaces: *process.spaces() }
    }

    pub(crate) fn coding(&self) -> TransferCurve {
        self.spaces.output_coding
    }

    pub(crate) fn difference(&self) -> Result<DisplayDifference, Error> {
        self.spaces.difference()
    }
}
