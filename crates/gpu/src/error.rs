use std::{error, fmt};

use onelight_lut::Storage;
use wgpu::TextureFormat;

use crate::MAX_SIDE;
use crate::form::FormKind;

/// What went wrong in this crate: a form, a texture or a setting that cannot be used.
///
/// The message is one sentence that says what, where, what was found and what was expected.
#[derive(Debug)]
pub struct Error(Box<Kind>);

impl Error {
    /// Whether the form does not fit the resources that it was to be uploaded into: a new pass is needed.
    pub fn is_other_shape(&self) -> bool {
        matches!(*self.0, Kind::OtherForm { .. } | Kind::TableSize { .. })
    }

    /// Whether a texture to read or write is at fault.
    pub fn is_texture(&self) -> bool {
        matches!(*self.0, Kind::Side { .. } | Kind::Sizes { .. } | Kind::OtherTarget { .. })
    }
}

/// The reasons behind an [`Error`].
#[derive(Debug)]
pub(crate) enum Kind {
    TargetFormat { found: TextureFormat },
    OtherTarget { found: TextureFormat, expected: TextureFormat },
    Storage { found: Storage },
    NotFilterable,
    NoCompute,
    Shaper,
    OtherForm { found: FormKind, expected: FormKind },
    TableSize { found: usize, expected: usize },
    Points { found: usize, max: usize },
    Terms { found: usize, max: usize },
    Half { found: f32 },
    NotFinite { what: &'static str, found: f32 },
    Side { width: u32, height: u32 },
    Sizes { from: [u32; 2], to: [u32; 2] },
}

impl From<Kind> for Error {
    fn from(kind: Kind) -> Self {
        Self(Box::new(kind))
    }
}

impl error::Error for Error {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self.0 {
            Kind::TargetFormat { found } => write!(
                f,
                "format of the target: found {found:?}, expected Rgba8Unorm or Bgra8Unorm, with or without Srgb, Rgb10a2Unorm, Rgba16Float or Rgba32Float"
            ),
            Kind::OtherTarget { found, expected } => {
                write!(f, "format of the texture to write: found {found:?}, expected {expected:?} as the pass was made for")
            }
            Kind::Storage { found } => write!(f, "storage of the table on the GPU: found {found:?}, expected F16 or F32"),
            Kind::NotFilterable => f.write_str(
                "table of 32-bit floats read through the filter: found a device without FLOAT32_FILTERABLE, expected one with it, or F16",
            ),
            Kind::Shaper => f.write_str("shaper of a plain form: found a kind that has no shader, expected log2 with an offset"),
            Kind::NoCompute => f.write_str("device for a bake: found no compute shaders, expected some"),
            Kind::OtherForm { found, expected } => {
                write!(f, "form of the new look: found {found}, expected {expected} as in these resources")
            }
            Kind::TableSize { found, expected } => write!(
                f,
                "table of the new look: found {found} nodes a side, expected {expected} as in these resources"
            ),
            Kind::Points { found, max } => write!(f, "points of the form's curves: found {found}, expected at most {max}"),
            Kind::Terms { found, max } => {
                write!(f, "terms of a sum of the form: found {found}, expected at most {max}")
            }
            Kind::Half { found } => {
                write!(f, "entry of a table kept in half floats: found {found}, expected a number within ±65504")
            }
            Kind::NotFinite { what, found } => write!(f, "{what}: found {found} in 32-bit floats, expected finite numbers"),
            Kind::Side { width, height } => {
                write!(f, "picture on the GPU: found {width}x{height} pixels, expected at most {MAX_SIDE} a side")
            }
            Kind::Sizes { from, to } => write!(
                f,
                "size of the texture to write: found {}x{}, expected {}x{} as in the one to read",
                to[0], to[1], from[0], from[1]
            ),
        }
    }
}
