use std::ops::RangeInclusive;

use crate::error::{Error, ErrorKind};

/// Where the exponentials of a direct form come from.
///
/// ```
/// use onelight::{DirectSettings, Nodes, Process};
/// let film = Process::for_camera("fuji-velvia-50")?.compile()?;
/// let few = film.direct(&DirectSettings { nodes: Nodes::Counts { projection: 6, duplication: 0 } })?;
/// assert_eq!(few.parts().projection.terms().len(), 6);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Nodes {
    /// The wavelengths of an even grid, not fitted: ready at once. 1 nm is the film itself in float32; 5 nm costs 0.02 dE at
    /// most, 10 nm 0.2, 20 nm 1.3.
    Grid {
        /// Distance in nm: a whole number that divides the ranges of the film's grids, such as 1, 2, 5, 10 or 20.
        step_nm: usize,
    },
    /// The coarsest of the grids by 10, 5, 2 and 1 nm with which none of a few hundred colours differs from the film by more than
    /// this (CIEDE2000), or that by 1 nm: what tables are baked with.
    GridUnderMaxDe(f64),
    /// Ten exponentials from the dye on the screen to linear RGB and five from a negative to its print, fitted as those of [`Nodes::Counts`];
    /// where they would miss one of five thousand other colours by more than 0.1 (CIEDE2000), as steep papers show it, more of them, up to
    /// twelve and eight. For a scan ten to twelve from the negative and the four of its rule. Each takes its time for every pixel, on a processor and
    /// on a card: docs/speed.md and docs/gpu.md count it.
    Usual,
    /// So many exponentials, fitted to the film over all that light can reach: a tenth of a second. Rates and weights are free;
    /// they belong to no wavelength, and weights may be negative.
    Counts {
        /// Exponentials from the dye on the screen to linear RGB, 2 to [`Nodes::MAX_COUNT`].
        projection: usize,
        /// Exponentials from the dye of a negative to the exposure of its print; reversal film has none.
        duplication: usize,
    },
    /// The fewest fitted exponentials with which no colour differs from the film by more than this (CIEDE2000), from -10 to +10
    /// stops and after following the worst uphill: seconds.
    UnderMaxDe(f64),
}

impl Nodes {
    /// The most exponentials that are fitted in one stage.
    pub const MAX_COUNT: usize = 16;
    /// What [`Nodes::Usual`] begins with for film and paper, and ends with for most.
    pub const USUAL_COUNTS: Self = Self::Counts { projection: 10, duplication: 5 };
    /// Exponentials of each stage that [`Nodes::Usual`] begins and ends with.
    pub(super) const USUAL_PROJECTION: RangeInclusive<usize> = 10..=12;
    pub(super) const USUAL_DUPLICATION: RangeInclusive<usize> = 5..=8;
    /// Those from a negative to what a scan reads, which has no curve that forgives a miss: the rule needs but four behind them.
    pub(super) const USUAL_SCAN: RangeInclusive<usize> = 10..=12;
}

/// How [`Reference::direct`](crate::Reference::direct) makes its form.
///
/// ```
/// use onelight::{DirectSettings, Nodes};
/// let film = onelight::Process::for_camera("fuji-velvia-50")?.compile()?;
/// let grid = film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 20 } })?;
/// assert!(grid.parts().print.is_none());
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectSettings {
    /// Where the exponentials come from.
    pub nodes: Nodes,
}

impl Default for DirectSettings {
    /// What stays below 0.13 dE for the films of the README and light within the sRGB primaries (5207 on 2383: 6 + 3 stay below 0.6,
    /// 8 + 4 below 0.23; Velvia 50: 6 + 3 below 0.4, 8 + 4 below 0.05).
    fn default() -> Self {
        Self { nodes: Nodes::Usual }
    }
}

pub(super) fn check_count(stage: &str, found: usize) -> Result<(), Error> {
    let allowed = 2..=Nodes::MAX_COUNT;
    if allowed.contains(&found) {
        return Ok(());
    }
    let expected = format!("a number from {} to {}", allowed.start(), allowed.end());
    Err(ErrorKind::Setting { what: format!("exponentials of a direct form's {stage}"), found: found as f64, expected }
        .into())
}

pub(super) fn check_limit(found: f64) -> Result<(), Error> {
    if found > 0.0 {
        return Ok(());
    }
    let what = "largest difference of a direct form".to_owned();
    Err(ErrorKind::Setting { what, found, expected: "a number above 0".to_owned() }.into())
}
