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
//! All sheets are half a megabyte of text. A program that needs one names it, and the linker leaves out the others:
//!
//! ```
//! use onelight_stocks::{FUJI_VELVIA_50, find};
//! assert_eq!(find("fuji-velvia-50"), Some(&FUJI_VELVIA_50));
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
    ($($name:ident $id:literal $image:ident $($mtf:ident $($granularity:ident)?)?;)*) => {
        $(
            #[doc = concat!("The sheet of `", $id, "`: a program that names it and neither [`ALL`] nor [`find`] holds no other.")]
            pub const $name: DataSheet = DataSheet {
                id: $id,
                stock_toml: include_str!(concat!("../", $id, "/stock.toml")),
                sensitivity_csv: include_str!(concat!("../", $id, "/sensitivity.csv")),
                characteristic_csv: include_str!(concat!("../", $id, "/characteristic.csv")),
                dye_density_csv: dyes!($id $image),
                mtf_csv: figure!($id, "mtf.csv" $(, $mtf)?),
                granularity_csv: figure!($id, "granularity.csv" $($(, $granularity)?)?),
                source_md: include_str!(concat!("../", $id, "/SOURCE.md")),
            };
        )*

        /// Every stock: camera films, print films, papers; black and white last.
        pub static ALL: &[DataSheet] = &[$($name),*];
    };
}

sheets! {
    KODAK_5203 "kodak-5203" dyes mtf granularity;
    KODAK_5206 "kodak-5206" dyes mtf;
    KODAK_5207 "kodak-5207" dyes mtf granularity;
    KODAK_5213 "kodak-5213" dyes mtf granularity;
    KODAK_5219 "kodak-5219" dyes mtf granularity;
    KODAK_5277 "kodak-5277" dyes mtf granularity;
    KODAK_5248 "kodak-5248" dyes mtf granularity;
    KODAK_PORTRA_160 "kodak-portra-160" dyes;
    KODAK_PORTRA_400 "kodak-portra-400" dyes mtf;
    KODAK_PORTRA_800 "kodak-portra-800" dyes mtf;
    KODAK_EKTAR_100 "kodak-ektar-100" dyes mtf;
    KODAK_GOLD_200 "kodak-gold-200" dyes;
    KODAK_ULTRAMAX_400 "kodak-ultramax-400" dyes;
    KODAK_VERICOLOR_III "kodak-vericolor-iii" dyes mtf;
    KODAK_AEROCOLOR "kodak-aerocolor" dyes mtf;
    FUJI_ETERNA_500 "fuji-eterna-500" dyes mtf;
    FUJI_ETERNA_500_VIVID "fuji-eterna-500-vivid" dyes mtf;
    FUJI_PRO_160C "fuji-pro-160c" dyes mtf;
    FUJI_PRO_160S "fuji-pro-160s" dyes mtf;
    FUJI_PRO_400H "fuji-pro-400h" dyes mtf;
    FUJI_SUPERIA_REALA "fuji-superia-reala" dyes mtf;
    FUJI_SUPERIA_X_TRA_400 "fuji-superia-x-tra-400" dyes mtf;
    FUJI_C200 "fuji-c200" dyes mtf;
    FUJI_NATURA_1600 "fuji-natura-1600" dyes mtf;
    AGFA_VISTA_100 "agfa-vista-100" dyes mtf;
    KODAK_EKTACHROME_100 "kodak-ektachrome-100" dyes mtf granularity;
    KODAK_KODACHROME_64 "kodak-kodachrome-64" dyes mtf;
    FUJI_VELVIA_50 "fuji-velvia-50" dyes;
    FUJI_PROVIA_100F "fuji-provia-100f" dyes mtf;
    KODAK_2383 "kodak-2383" dyes;
    KODAK_2393 "kodak-2393" dyes;
    KODAK_5384 "kodak-5384" dyes;
    KODAK_5386 "kodak-5386" dyes;
    FUJI_3513DI "fuji-3513di" dyes;
    FUJI_3523XD "fuji-3523xd" dyes;
    KODAK_ENDURA_PREMIER "kodak-endura-premier" dyes;
    KODAK_PORTRA_ENDURA "kodak-portra-endura" dyes;
    KODAK_SUPRA_ENDURA "kodak-supra-endura" dyes;
    FUJI_CRYSTAL_ARCHIVE_DPII "fuji-crystal-archive-dpii" dyes;
    FUJI_CRYSTAL_ARCHIVE_PDII "fuji-crystal-archive-pdii" dyes;
    FUJI_CRYSTAL_ARCHIVE_SUPER_C "fuji-crystal-archive-super-c" dyes;
    FUJI_FUJIFLEX "fuji-fujiflex" dyes;
    KODAK_RADIANCE_III "kodak-radiance-iii" dyes;
    ILFORD_ILFOCHROME_MICROGRAPHIC "ilford-ilfochrome-micrographic" dyes;
    FUJI_FP_100C "fuji-fp-100c" dyes;
    FUJI_INSTAX "fuji-instax" dyes;
    KODAK_5222 "kodak-5222" silver mtf;
    KODAK_TRI_X_400 "kodak-tri-x-400" silver mtf;
    KODAK_2302 "kodak-2302" silver;
    KODAK_POLYMAX_FINE_ART "kodak-polymax-fine-art" silver;
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
            assert_eq!(find(sheet.id), Some(sheet));
            for word in ["Sheet:", "Digitisation:", "Jan Lohse", "MIT", "Resampling:", "## Oddities", "## Uncertainty"]
            {
                assert!(sheet.source_md.contains(word), "{}: {word}", sheet.id);
            }
        }
    }
}
