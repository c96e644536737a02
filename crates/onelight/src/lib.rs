//! Film simulation for HDR pictures.

mod about;
mod bake;
pub mod baked;
pub mod certify;
mod direct;
mod error;
mod films;
mod look;
mod message;
mod process;
mod process_keys;
mod reference;
mod scene;
mod stocks;
mod structured;
mod word;

pub use direct::{DirectSettings, Nodes};
pub use error::Error;
pub use films::Films;
pub use look::{FirstApproach, Look, PostColour, Texels, ToneCurve, ToneMapped};
pub use onelight_film as film;
pub use onelight_film::{DyeModel, Matching, SheetText, Stock, StockKind, Tail};
#[cfg(feature = "gpu")]
pub use onelight_gpu as gpu;
pub use onelight_lut as lut;
pub use onelight_printing as printing;
pub use onelight_printing::{Aim, Calibration, Filters, HeatGlass, Infrared, PrinterLight, Projector, Wratten};
pub use onelight_spectra as spectra;
pub use onelight_spectra::{Reconstruction, TransferCurve};
pub use process::{
    Approach, ColourSpaces, DEFAULT_CAMERA, DEFAULT_PRINT, FilmProcess, FirstControls, FirstProcess, OwnSheet,
    Printing, Process, StockRef, ToneMapping, ToneProcess,
};
pub use process_keys::{FormatVersion, ProcessKeys, SheetKeys};
pub use reference::{PrintStage, Reference, Stages};
pub use scene::SCENE_MAX;
pub use stocks::{stock, stock_ids};
pub use structured::{Entries, StructuredSettings, TableCoding};
pub use word::{Word, WorkingSpace};
