//! Data sheets of photographic films as text, one folder each, compiled into the program.
//!
//! This package holds no code that understands them: `onelight-film` reads them. Every folder has a `SOURCE.md` that says
//! which sheet the figures come from, who digitised them, and how far they can be trusted. The digitised points carry the
//! MIT licence in `LICENSE-DIGITISATION`.
//!
//! ```
//! let sheet = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
//! assert!(sheet.stock_toml.contains("5207"));
//! # Ok::<(), &str>(())
//! ```
//!
//! # Out of scope
//! Parsing, checking, and every number that is not in a sheet or marked as derived.

/// The text of the files of one stock. `onelight-film` reads those that hold figures: `Stock::parse` of a
/// `SheetText`, and `Stock::with_figures`.
///
/// ```
/// let sheet = onelight_stocks::find("fuji-velvia-50").ok_or("no such stock")?;
/// assert!(sheet.characteristic_csv.contains("log10_exposure,red,green,blue"));
/// # Ok::<(), &str>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DataSheet {
    /// Name of the folder, such as `kodak-5207`.
    pub id: &'static str,
    /// Facts: kind, speed, criteria, what is published and what derived.
    pub stock_toml: &'static str,
    /// Spectral sensitivity: nm; log10 of the three layers.
    pub sensitivity_csv: &'static str,
    /// Characteristic (H-D) curves: log10 exposure; density through the three filters.
    pub characteristic_csv: &'static str,
    /// Spectral density of the three dyes, of D-min and of the neutral, over nm.
    pub dye_density_csv: &'static str,
    /// Modulation transfer: cycles per mm; response of the three layers, or of all. `None` where none is digitised or it is not the
    /// film's own.
    pub mtf_csv: Option<&'static str>,
    /// Diffuse rms granularity: log10 exposure; density and granularity of the three layers. `None` as above.
    pub granularity_csv: Option<&'static str>,
    /// Where the figures come from, in words.
    pub source_md: &'static str,
}

macro_rules! figure {
    ($id:literal, $file:literal, $figure:ident) => {
        Some(include_str!(concat!("../", $id, "/", $file)))
    };
    ($id:literal, $file:literal) => {
        None
    };
}

macro_rules! sheets {
    ($($id:literal $($mtf:ident $($granularity:ident)?)?;)*) => {
        /// Every stock: negatives, reversal films, print films.
        pub static ALL: &[DataSheet] = &[$(DataSheet {
            id: $id,
            stock_toml: include_str!(concat!("../", $id, "/stock.toml")),
            sensitivity_csv: include_str!(concat!("../", $id, "/sensitivity.csv")),
            characteristic_csv: include_str!(concat!("../", $id, "/characteristic.csv")),
            dye_density_csv: include_str!(concat!("../", $id, "/dye_density.csv")),
            mtf_csv: figure!($id, "mtf.csv" $(, $mtf)?),
            granularity_csv: figure!($id, "granularity.csv" $($(, $granularity)?)?),
            source_md: include_str!(concat!("../", $id, "/SOURCE.md")),
        }),*];
    };
}

sheets! {
    "kodak-5203" mtf granularity;
    "kodak-5206" mtf;
    "kodak-5207" mtf granularity;
    "kodak-5213" mtf granularity;
    "kodak-5219" mtf granularity;
    "kodak-5277" mtf granularity;
    "kodak-5248" mtf granularity;
    "kodak-portra-160";
    "kodak-portra-400" mtf;
    "kodak-portra-800" mtf;
    "kodak-ektar-100" mtf;
    "kodak-gold-200";
    "kodak-ultramax-400";
    "kodak-vericolor-iii" mtf;
    "kodak-aerocolor" mtf;
    "fuji-eterna-500" mtf;
    "fuji-eterna-500-vivid" mtf;
    "fuji-pro-160c" mtf;
    "fuji-pro-160s" mtf;
    "fuji-pro-400h" mtf;
    "fuji-superia-reala" mtf;
    "fuji-superia-x-tra-400" mtf;
    "fuji-c200" mtf;
    "fuji-natura-1600" mtf;
    "agfa-vista-100" mtf;
    "kodak-ektachrome-100" mtf granularity;
    "kodak-kodachrome-64" mtf;
    "fuji-velvia-50";
    "fuji-provia-100f" mtf;
    "kodak-2383";
    "kodak-2393";
    "kodak-5384";
    "kodak-5386";
    "fuji-3513di";
    "fuji-3523xd";
}

/// The stock with this id, `None` if there is none.
///
/// ```
/// assert!(onelight_stocks::find("kodak-5207").is_some() && onelight_stocks::find("5207").is_none());
/// ```
#[must_use]
pub fn find(id: &str) -> Option<&'static DataSheet> {
    ALL.iter().find(|sheet| sheet.id == id)
}

/// The examples of README.md, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_folder_is_listed() {
        let here = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let folders = std::fs::read_dir(here).unwrap().map(|entry| entry.unwrap().path());
        let mut found: Vec<String> = folders
            .filter(|path| path.join("stock.toml").exists())
            .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
            .collect();
        let mut listed: Vec<String> = ALL.iter().map(|sheet| sheet.id.to_owned()).collect();
        found.sort();
        listed.sort();
        assert_eq!(found, listed);
    }

    #[test]
    fn every_source_names_sheet_and_licence() {
        for sheet in ALL {
            for word in ["Sheet:", "Digitisation:", "Jan Lohse", "MIT", "Resampling:", "## Oddities", "## Uncertainty"]
            {
                assert!(sheet.source_md.contains(word), "{}: {word}", sheet.id);
            }
        }
    }
}
