//! Film simulation for HDR pictures: camera film, print film and projector from the manufacturers' data sheets.
//!
//! A [`Process`] describes a look in names and numbers. Compiled, it is a [`Reference`], exact in float64, or a [`Look`], which
//! takes the talk's first approach and plain tone mappings too.
//!
//! # A tour
//!
//! A scene-linear colour on Kodak 5207, printed on 2383 and shown on an sRGB display:
//!
//! ```
//! let film = onelight::Process::default().compile()?;
//! let display = film.develop([2.0, 0.5, 0.1]);
//! assert!(display[0] > display[1] && display[1] > display[2]);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! Where it comes from: exposure, dye, the print, the light from the screen.
//!
//! ```
//! let stages = onelight::Process::for_camera("kodak-5219")?.compile()?.stages([2.0, 0.5, 0.1]);
//! assert!(stages.amounts.red.0 > stages.amounts.blue.0);
//! assert_eq!(stages.spectrum.values().len(), 401);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! A look is changed by its fields; one struct for each kind of look holds those that mean something to it. As text it is a
//! `look.toml`.
//!
//! ```
//! use onelight::{Aim, FilmProcess, Printing, Process};
//! let print = Printing { points: [1.0, 0.0, -1.0], ..Printing::on("kodak-2393") };
//! let look = Process::from(FilmProcess { print: Some(print), aim: Aim::Sheet, ..FilmProcess::for_camera("kodak-5213")? });
//! assert_eq!(Process::from_toml("look.toml", &look.to_toml())?, look);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! A data sheet of one's own in the camera, read from four texts in the form of the built-in ones:
//!
//! ```
//! use onelight::{Films, Process, SheetText, Stock, stock};
//! # let sheet = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
//! # let mine = sheet.stock_toml.replace("id = \"kodak-5207\"", "id = \"mine\"");
//! # let (sensitivity, curves, dyes) = (sheet.sensitivity_csv, sheet.characteristic_csv, sheet.dye_density_csv);
//! let camera = Stock::parse(&SheetText {
//!     id: "mine",
//!     stock_toml: &mine,
//!     sensitivity_csv: sensitivity,
//!     characteristic_csv: curves,
//!     dye_density_csv: dyes,
//! })?;
//! let film = Process::default().compile_with(&Films { camera, print: Some(stock("kodak-2383")?) })?;
//! assert_eq!(film.name(), "mine_kodak-2383");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same, fast: a table with the film's own curves as its axes, or no table at all. Neither has an end of its range.
//!
//! ```
//! let film = onelight::Process::for_camera("fuji-velvia-50")?.compile()?;
//! let table = film.structured(&onelight::StructuredSettings { size: 12, ..Default::default() })?;
//! let direct = film.direct(&Default::default())?;
//! let (exact, rgb) = (film.develop([0.5, 0.2, 40.0]), [0.5, 0.2, 40.0]);
//! assert!((exact[0] - f64::from(table.apply(rgb)[0])).abs() < 0.01);
//! assert!((exact[0] - f64::from(direct.apply(rgb)[0])).abs() < 0.001);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! Baked by a recipe, and certified: how far it lies from the exact look, over twenty stops and all saturations. With the feature
//! `formats` it is written as a `.cube` and other files.
//!
//! ```
//! use onelight::baked::Recipe;
//! # use onelight::certify::CertifySettings;
//! # use onelight::lut::{SamplingLaw, Search};
//! let look = onelight::Process::default().look()?;
//! let baked = look.baked(&Recipe::cube(17))?;
//! # let settings = CertifySettings { law: SamplingLaw { count: 1 << 9, ..SamplingLaw::default() }, search: Search::SamplesOnly };
//! # /* The usual settings, by `&Default::default()`, take 30 seconds where nothing is optimised.
//! let report = look.certify(&baked, &Default::default())?;
//! # */ let report = look.certify(&baked, &settings)?;
//! println!("{report}");
//! assert!(report.srgb.overall.mean < 0.5);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! Whole pictures of f32, f16, u16 or u8, on all threads:
//!
//! ```
//! use onelight::{Channels, PixelMap, Pixels, PixelsMut};
//! let direct = onelight::Process::default().compile()?.direct(&Default::default())?;
//! let (hdr, mut display) = (vec![0.18_f32; 64 * 36 * 4], vec![0_u8; 64 * 36 * 4]);
//! let from = Pixels::new(&hdr, Channels::Rgba, [64, 36])?;
//! direct.map(&from, &mut PixelsMut::new(&mut display, Channels::Rgba, [64, 36])?)?;
//! assert_eq!(display[..3], [123, 123, 123]);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! Sharpness, halation and grain of the camera film depend on more than a pixel: [`FilmEffects`] has them, between the three steps of a
//! look ([`FilmSteps`]).
//!
//! # Out of scope
//! Files (text comes in as `&str`, files go out to writers). Keys in square brackets are resolved in
//! REFERENCES.md at the top of the repository.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod about;
mod bake;
pub mod baked;
pub mod certify;
mod cineon;
#[cfg(feature = "picture")]
mod code_light;
mod direct;
mod effects;
mod error;
mod films;
mod gamut_effect;
mod input_coding;
mod look;
mod message;
mod meter;
mod pairs;
#[cfg(feature = "picture")]
mod picture_colours;
#[cfg(feature = "picture")]
mod picture_coverage;
#[cfg(feature = "picture")]
mod picture_light;
#[cfg(feature = "picture")]
mod picture_notes;
mod positive;
mod process;
mod process_keys;
mod reference;
mod scene;
mod stocks;
mod structured;
mod uncertainty;
mod word;

pub use direct::{DirectSettings, LiveDirect, Nodes};
pub use effects::{EffectsRun, FilmEffects, FilmSteps, FirstLook};
pub use error::Error;
pub use films::Films;
pub use gamut_effect::GamutEffect;
pub use input_coding::InputCoding;
pub use look::{FirstApproach, Look, PostColour, PrintedScan, Texels, ToneCurve, ToneMapped};
pub use meter::Meter;
pub use onelight_film as film;
pub use onelight_film::{
    DyeModel, Image, InterImage, Matching, PrintCurves, SheetText, Stock, StockKind, Tail, WideGamut,
};
#[cfg(feature = "formats")]
pub use onelight_formats as formats;
#[cfg(feature = "gpu")]
pub use onelight_gpu as gpu;
pub use onelight_lut as lut;
pub use onelight_lut::{Channels, PixelMap, Pixels, PixelsMut};
#[cfg(feature = "picture")]
pub use onelight_picture as picture;
pub use onelight_printing as printing;
pub use onelight_printing::{
    Aim, Calibration, Filters, HeatGlass, Infrared, PrinterLight, Projector, ScanRule, White, Wratten,
};
pub use onelight_spatial as spatial;
pub use onelight_spectra as spectra;
pub use onelight_spectra::{DisplayLinear, Reconstruction, TransferCurve};
pub use pairs::{looks_with, pairs, seen_on};
#[cfg(feature = "picture")]
pub use picture_colours::{colour_tag, space_of};
#[cfg(feature = "picture")]
pub use picture_coverage::{Background, Coverage, CoverageSeen};
#[cfg(feature = "picture")]
pub use picture_light::{InputColours, InputPrimaries, InputWhite, LightSeen, PictureLight, SceneStep};
#[cfg(feature = "picture")]
pub use picture_notes::{LightNote, LightSetting};
pub use process::{
    Approach, ColourSpaces, DEFAULT_CAMERA, DEFAULT_PRINT, DEFAULT_SILVER_PRINT, EffectChoice, Effects, FilmProcess,
    FirstControls, FirstProcess, InterImageChoice, OwnSheet, PrintAlone, Printing, Process, StockRef, ToneMapping,
    ToneProcess, usual_print,
};
pub use process_keys::{FormatVersion, ProcessKeys, SheetKeys};
pub use reference::{PrintStage, Reference, Stages};
pub use scene::SCENE_MAX;
pub use stocks::{stock, stock_ids, stock_named};
pub use structured::{Entries, StructuredSettings, TableCoding};
pub use uncertainty::Uncertainty;
pub use word::{Word, WorkingSpace};

/// The README's examples run with the documentation's.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
