use std::sync::OnceLock;

use crate::built_in::BuiltInTable;
use crate::distribution::{SpectralDistribution, quantity::Reflectance};
use crate::error::Error;
use crate::shape::SpectralShape;
use crate::tabulated::Extrapolation;

/// A patch of the ColorChecker 24, from [`color_checker`].
///
/// ```
/// let chart = onelight_spectra::color_checker();
/// let grey = chart.iter().find(|patch| patch.name == "neutral 5").ok_or("no such patch")?;
/// assert!((grey.reflectance.at(550.0).ok_or("beyond the table")? - 0.19).abs() < 0.01);
/// # Ok::<(), &str>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// The name printed on the chart, in lower case: `dark skin`, `neutral 6.5`.
    pub name: String,
    /// Reflectance on 380..780 nm by 1 nm.
    pub reflectance: SpectralDistribution<Reflectance>,
}

/// The 24 patches in chart order, row by row from dark skin to black: the average of 30 charts (\[BabelColor\]); 10 nm
/// table, linear between its rows, end values held beyond 380..730 nm.
///
/// ```
/// let chart = onelight_spectra::color_checker();
/// assert_eq!((chart.len(), chart[14].name.as_str()), (24, "red"));
/// ```
#[must_use]
#[expect(clippy::expect_used, reason = "the table is compiled in and a test reads it")]
pub fn color_checker() -> &'static [Patch] {
    static CHART: OnceLock<Vec<Patch>> = OnceLock::new();
    CHART.get_or_init(|| read().expect("the built-in table is valid"))
}

fn read() -> Result<Vec<Patch>, Error> {
    let table = BuiltInTable::parse("colorchecker24.csv", include_str!("../data/colorchecker24.csv"))?;
    let patch = |column: &&str| {
        let reflectance = table.points(column)?.spectrum(SpectralShape::VISIBLE, Extrapolation::Held)?;
        Ok(Patch { name: name(column), reflectance })
    };
    table.value_names().iter().map(patch).collect()
}

/// `19_white_9p5_p05_D` is `white 9.5`: number in the chart, name, Munsell value, density.
fn name(column: &str) -> String {
    let name = column.trim_start_matches(|c: char| c.is_ascii_digit() || c == '_');
    let name = name.strip_suffix("_D").and_then(|name| name.rsplit_once('_')).map_or(name, |(name, _density)| name);
    name.split('_')
        .map(|word| word.replace("9p5", "9.5").replace("6p5", "6.5").replace("3p5", "3.5"))
        .collect::<Vec<_>>()
        .join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Illuminant, Observer, illuminant};
    use approx::assert_relative_eq;

    #[test]
    fn patches_have_plain_names() {
        let chart = read().unwrap();
        let names: Vec<&str> = chart.iter().map(|patch| patch.name.as_str()).collect();
        assert_eq!(names[..2], ["dark skin", "light skin"]);
        let greys = ["white 9.5", "neutral 8", "neutral 6.5", "neutral 5", "neutral 3.5", "black 2"];
        assert_eq!(names[18..], greys);
    }

    #[test]
    fn neutral_5_reflects_a_fifth() {
        let light = illuminant(Illuminant::D65, SpectralShape::VISIBLE);
        let grey = light.reflected_by(&read().unwrap()[21].reflectance);
        let eye = Observer::cie_1931();
        // Y 19.13 under D65, computed from the same chart average elsewhere.
        assert_relative_eq!(100.0 * eye.xyz(&grey).y / eye.xyz(&light).y, 19.13, epsilon = 0.01);
    }
}
