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
    /// Spectral density of the three dyes, of D-min and of the neutral, over nm; empty for black and white.
    pub dye_density_csv: &'static str,
    /// Modulation transfer: cycles per mm; response of the three layers, or of all. `None` where none is digitised or it is not the
    /// film's own.
    pub mtf_csv: Option<&'static str>,
    /// Diffuse rms granularity: log10 exposure; density and granularity of the three layers. `None` as above.
    pub granularity_csv: Option<&'static str>,
    /// Where the figures come from, in words.
    pub source_md: &'static str,
}

/// Black and white has no file of dyes.
macro_rules! dyes {
    ($id:literal silver) => {
        ""
    };
    ($id:literal dyes) => {
        include_str!(concat!("../", $id, "/dye_density.csv"))
    };
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
    ($($id:literal $image:ident $($mtf:ident $($granularity:ident)?)?;)*) => {
        /// Every stock: camera films, print films, papers; black and white last.
        pub static ALL: &[DataSheet] = &[$(DataSheet {
            id: $id,
            stock_toml: include_str!(concat!("../", $id, "/stock.toml")),
            sensitivity_csv: include_str!(concat!("../", $id, "/sensitivity.csv")),
            characteristic_csv: include_str!(concat!("../", $id, "/characteristic.csv")),
            dye_density_csv: dyes!($id $image),
            mtf_csv: figure!($id, "mtf.csv" $(, $mtf)?),
            granularity_csv: figure!($id, "granularity.csv" $($(, $granularity)?)?),
            source_md: include_str!(concat!("../", $id, "/SOURCE.md")),
        }),*];
    };
}

sheets! {
    "kodak-5203" dyes mtf granularity;
    "kodak-5206" dyes mtf;
    "kodak-5207" dyes mtf granularity;
    "kodak-5213" dyes mtf granularity;
    "kodak-5219" dyes mtf granularity;
    "kodak-5277" dyes mtf granularity;
    "kodak-5248" dyes mtf granularity;
    "kodak-portra-160" dyes;
    "kodak-portra-400" dyes mtf;
    "kodak-portra-800" dyes mtf;
    "kodak-ektar-100" dyes mtf;
    "kodak-gold-200" dyes;
    "kodak-ultramax-400" dyes;
    "kodak-vericolor-iii" dyes mtf;
    "kodak-aerocolor" dyes mtf;
    "fuji-eterna-500" dyes mtf;
    "fuji-eterna-500-vivid" dyes mtf;
    "fuji-pro-160c" dyes mtf;
    "fuji-pro-160s" dyes mtf;
    "fuji-pro-400h" dyes mtf;
    "fuji-superia-reala" dyes mtf;
    "fuji-superia-x-tra-400" dyes mtf;
    "fuji-c200" dyes mtf;
    "fuji-natura-1600" dyes mtf;
    "agfa-vista-100" dyes mtf;
    "kodak-ektachrome-100" dyes mtf granularity;
    "kodak-kodachrome-64" dyes mtf;
    "fuji-velvia-50" dyes;
    "fuji-provia-100f" dyes mtf;
    "kodak-2383" dyes;
    "kodak-2393" dyes;
    "kodak-5384" dyes;
    "kodak-5386" dyes;
    "fuji-3513di" dyes;
    "fuji-3523xd" dyes;
    "kodak-endura-premier" dyes;
    "kodak-portra-endura" dyes;
    "kodak-supra-endura" dyes;
    "fuji-crystal-archive-dpii" dyes;
    "fuji-crystal-archive-pdii" dyes;
    "fuji-crystal-archive-super-c" dyes;
    "fuji-fujiflex" dyes;
    "kodak-radiance-iii" dyes;
    "ilford-ilfochrome-micrographic" dyes;
    "fuji-fp-100c" dyes;
    "fuji-instax" dyes;
    "kodak-5222" silver mtf;
    "kodak-tri-x-400" silver mtf;
    "kodak-2302" silver;
    "kodak-polymax-fine-art" silver;
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
