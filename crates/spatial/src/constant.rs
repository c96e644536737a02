//! The numbers that no sheet of the film itself holds, each with its unit and origin.

use crate::error::Error;

/// Where a number comes from.
///
/// ```
/// use onelight_spatial::{CONSTANTS, ConstantOrigin};
/// let guesses = CONSTANTS.iter().filter(|constant| constant.origin == ConstantOrigin::Guess);
/// assert!(guesses.count() > 3, "halation and the size of dye clouds are on no sheet");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstantOrigin {
    /// Published by a maker.
    Sheet,
    /// Physics, or the definition of a measurement.
    Physics,
    /// Published by nobody: to be shown to whoever uses it.
    Guess,
}

/// A number of the model, its unit, between what it may lie, and who says so.
///
/// ```
/// use onelight_spatial::ANTIHALATION_DENSITY;
/// assert_eq!((ANTIHALATION_DENSITY.value, ANTIHALATION_DENSITY.low, ANTIHALATION_DENSITY.high), (0.8, 0.6, 1.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    /// What it is.
    pub name: &'static str,
    /// The number that is used unless another is given.
    pub value: f64,
    /// Its unit; empty for a bare number.
    pub unit: &'static str,
    /// Least plausible value.
    pub low: f64,
    /// Greatest plausible value.
    pub high: f64,
    /// Whether somebody publishes it.
    pub origin: ConstantOrigin,
    /// Who, or why this number.
    pub source: &'static str,
}

/// Thickness of a triacetate base.
pub const TRIACETATE_THICKNESS: Constant = Constant {
    name: "thickness of a triacetate base",
    value: 135.0,
    unit: "um",
    low: 125.0,
    high: 145.0,
    origin: ConstantOrigin::Guess,
    source: "usual for camera films; no sheet here states it",
};

/// Thickness of a polyester (ESTAR) base.
pub const POLYESTER_THICKNESS: Constant = Constant {
    name: "thickness of a polyester base",
    value: 120.0,
    unit: "um",
    low: 115.0,
    high: 125.0,
    origin: ConstantOrigin::Sheet,
    source: "sheets of Kodak 2383 and 2393",
};

/// Refractive index of triacetate.
pub const TRIACETATE_INDEX: Constant = Constant {
    name: "refractive index of triacetate",
    value: 1.48,
    unit: "",
    low: 1.47,
    high: 1.49,
    origin: ConstantOrigin::Physics,
    source: "handbooks of polymers",
};

/// Refractive index of polyester.
pub const POLYESTER_INDEX: Constant = Constant {
    name: "refractive index of polyester",
    value: 1.64,
    unit: "",
    low: 1.6,
    high: 1.67,
    origin: ConstantOrigin::Physics,
    source: "handbooks of polymers",
};

/// Density of the layer behind or in the base that swallows light (rem-jet, grey base, undercoat), for one passage.
pub const ANTIHALATION_DENSITY: Constant = Constant {
    name: "density of the antihalation layer",
    value: 0.8,
    unit: "",
    low: 0.6,
    high: 1.0,
    origin: ConstantOrigin::Guess,
    source: "on no sheet, and it decides everything about halation",
};

/// Share of the light returned by the base that exposes the red layer, which lies next to it.
pub const RETURNED_TO_RED: Constant = Constant {
    name: "share of returned light that exposes the red layer",
    value: 0.5,
    unit: "",
    low: 0.0,
    high: 1.0,
    origin: ConstantOrigin::Guess,
    source: "the order of the layers: red lies next to the base",
};

/// As [`RETURNED_TO_RED`] for the green layer, behind it.
pub const RETURNED_TO_GREEN: Constant = Constant {
    name: "share of returned light that exposes the green layer",
    value: 0.05,
    unit: "",
    low: 0.0,
    high: 0.15,
    origin: ConstantOrigin::Guess,
    source: "0.15 turns large halos yellow; photographs show red-orange",
};

/// As [`RETURNED_TO_RED`] for the blue layer, which lies behind the yellow filter.
pub const RETURNED_TO_BLUE: Constant = Constant {
    name: "share of returned light that exposes the blue layer",
    value: 0.0,
    unit: "",
    low: 0.0,
    high: 0.15,
    origin: ConstantOrigin::Guess,
    source: "the order of the layers: the yellow filter lies below blue",
};

/// Standard deviation of a dye cloud, taken for a Gaussian.
pub const CLOUD_RADIUS: Constant = Constant {
    name: "radius of a dye cloud",
    value: 1.5,
    unit: "um",
    low: 1.0,
    high: 2.0,
    origin: ConstantOrigin::Guess,
    source: "moves grain by 2 % at 12 um a pixel and by 5 % at 6 um, where a print blurs it",
};

/// Standard deviation of the blur of printer and print film, taken for a Gaussian: it acts on grain, not on the picture.
pub const PRINT_BLUR: Constant = Constant {
    name: "blur of grain by printer and print film",
    value: 2.5,
    unit: "um",
    low: 0.0,
    high: 5.0,
    origin: ConstantOrigin::Guess,
    source: "stands in until the modulation transfer of a print film is digitised; without it grain is 15 % stronger at 12 um a pixel",
};

/// All of them.
pub const CONSTANTS: [Constant; 10] = [
    TRIACETATE_THICKNESS,
    POLYESTER_THICKNESS,
    TRIACETATE_INDEX,
    POLYESTER_INDEX,
    ANTIHALATION_DENSITY,
    RETURNED_TO_RED,
    RETURNED_TO_GREEN,
    RETURNED_TO_BLUE,
    CLOUD_RADIUS,
    PRINT_BLUR,
];

/// `value`, if it lies within `allowed`.
pub(crate) fn checked(what: &'static str, value: f64, allowed: [f64; 2], unit: &'static str) -> Result<f64, Error> {
    if (allowed[0]..=allowed[1]).contains(&value) { Ok(value) } else { Err(Error::range(what, value, allowed, unit)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_has_every_number() {
        let document = include_str!("../../../docs/spatial.md");
        for c in CONSTANTS {
            assert!((c.low..=c.high).contains(&c.value), "{}", c.name);
            let origin = match c.origin {
                ConstantOrigin::Sheet => "sheet",
                ConstantOrigin::Physics => "physics",
                ConstantOrigin::Guess => "guess",
            };
            let value = format!("{} {}", c.value, c.unit);
            let row =
                format!("| {} | {} | {} | {} | {origin} | {} |", c.name, value.trim_end(), c.low, c.high, c.source);
            assert!(document.contains(&row), "docs/spatial.md lacks\n{row}");
        }
    }
}
