use std::{error, fmt};

use onelight_lut::Storage;
use wgpu::{TextureDimension, TextureFormat, TextureUsages};

use crate::form::FormKind;

/// What went wrong in this crate: a form, a texture, a setting or a device that cannot be used.
///
/// The message is one sentence that says what, where, what was found and what was expected.
///
/// ```
/// use onelight_gpu::LookBytes;
/// use onelight_lut::{Interpolation, Lut3d, PlainLut, Shaper, Storage};
///
/// let lut = PlainLut::new(Shaper::log2(0.02, 11.52)?, Lut3d::identity(17)?, Interpolation::Tetrahedral);
/// let error = LookBytes::new(&lut, Storage::Unorm8).unwrap_err();
/// assert_eq!(error.to_string(), "storage of the table on the GPU: found Unorm8, expected F16 or F32");
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Debug)]
pub struct Error(Box<ErrorKind>);

impl Error {
    /// Whether the look has another form or size of table than the resources that it was to be uploaded into: it needs a new pass.
    pub fn is_other_shape(&self) -> bool {
        matches!(*self.0, ErrorKind::OtherForm { .. } | ErrorKind::TableSize { .. })
    }

    /// Whether a texture to read or write, or a view of one, cannot be used.
    pub fn is_texture(&self) -> bool {
        matches!(
            *self.0,
            ErrorKind::Side { .. }
                | ErrorKind::Sizes { .. }
                | ErrorKind::OtherTarget { .. }
                | ErrorKind::SourceFormat { .. }
                | ErrorKind::Usage { .. }
                | ErrorKind::Dimension { .. }
                | ErrorKind::SampleCount { .. }
                | ErrorKind::MipLevels { .. }
                | ErrorKind::SameTexture
                | ErrorKind::Refused { .. }
        )
    }

    /// Whether there is no graphics card or driver of the wanted name. A test may skip then.
    pub fn is_no_adapter(&self) -> bool {
        matches!(*self.0, ErrorKind::NoAdapter { .. })
    }
}

/// Which of a pass's two textures an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Source,
    Target,
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Source => "the texture to read",
            Self::Target => "the texture to write",
        })
    }
}

/// The reasons behind an [`Error`].
#[derive(Debug)]
#[cfg_attr(not(feature = "native"), expect(dead_code, reason = "some are about devices that this crate opens"))]
pub(crate) enum ErrorKind {
    TargetFormat {
        found: TextureFormat,
    },
    OtherTarget {
        found: TextureFormat,
        expected: TextureFormat,
    },
    SourceFormat {
        found: TextureFormat,
    },
    #[cfg(feature = "spatial")]
    SpatialTarget {
        found: TextureFormat,
    },
    #[cfg(feature = "spatial")]
    StageSize {
        found: [u32; 2],
        expected: [u32; 2],
    },
    Usage {
        role: Role,
        found: TextureUsages,
        expected: TextureUsages,
    },
    Dimension {
        role: Role,
        found: TextureDimension,
    },
    SampleCount {
        role: Role,
        found: u32,
    },
    MipLevels {
        found: u32,
    },
    SameTexture,
    Refused {
        what: Refused,
        found: String,
    },
    Storage {
        found: Storage,
    },
    NotFilterable,
    NoCompute,
    Shaper,
    OtherForm {
        found: FormKind,
        expected: FormKind,
    },
    TableSize {
        found: usize,
        expected: usize,
    },
    TableLimit {
        found: usize,
        max: u32,
    },
    Points {
        found: usize,
        max: usize,
    },
    Terms {
        found: usize,
        max: usize,
    },
    HalfFloat {
        found: f32,
    },
    NotFinite {
        what: &'static str,
        found: f32,
    },
    Binding {
        found: u32,
        max: u32,
    },
    Side {
        width: u32,
        height: u32,
        max: u32,
    },
    Sizes {
        from: [u32; 2],
        to: [u32; 2],
    },
    NoAdapter {
        found: Vec<String>,
        expected: String,
    },
    Device {
        found: String,
    },
    ByteCount {
        found: usize,
        expected: u64,
    },
    BufferLimit {
        found: u64,
        max: u64,
    },
}

/// What wgpu refused: a view tells nothing of itself, so that it cannot be checked beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(not(feature = "native"), expect(dead_code, reason = "some are about textures that this crate makes"))]
pub(crate) enum Refused {
    Source,
    SourceAndTarget,
    Target,
    Texture,
    ReadBack,
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(Box::new(kind))
    }
}

impl error::Error for Error {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &*self.0 {
            ErrorKind::TargetFormat { found } => write!(
                f,
                "format of the target: found {found:?}, expected Rgba8Unorm or Bgra8Unorm, with or without Srgb, Rgb10a2Unorm, Rgba16Float or Rgba32Float"
            ),
            #[cfg(feature = "spatial")]
            ErrorKind::SpatialTarget { found } => write!(
                f,
                "target of sharpness, halation and grain: found {found:?}, expected Rgba8Unorm, Rgba16Float or Rgba32Float on a device that computes"
            ),
            #[cfg(feature = "spatial")]
            ErrorKind::StageSize { found: [w, h], expected: [width, height] } => {
                write!(f, "size of the textures: found {w} x {h}, expected {width} x {height} as the stage is for")
            }
            ErrorKind::OtherTarget { found, expected } => {
                write!(f, "format of the texture to write: found {found:?}, expected {expected:?} as the pass was made for")
            }
            ErrorKind::SourceFormat { found } => write!(
                f,
                "format of the texture to read: found {found:?}, expected a colour format that shaders read as floats, such as Rgba16Float"
            ),
            ErrorKind::Usage { role, found, expected } => {
                write!(f, "usage of {role}: found {}, expected {} among it", names(*found), names(*expected))
            }
            ErrorKind::Dimension { role, found } => write!(f, "dimension of {role}: found {found:?}, expected D2"),
            ErrorKind::SampleCount { role, found } => {
                write!(f, "samples of a pixel of {role}: found {found}, expected 1: resolve it before")
            }
            ErrorKind::MipLevels { found } => {
                write!(f, "mip levels of the texture to write: found {found}, expected 1")
            }
            ErrorKind::SameTexture => f.write_str("textures to read and to write: found the same, expected two"),
            ErrorKind::Refused { what, found } => write!(f, "{}: found that {found}, expected {}", what.name(), what.expected()),
            ErrorKind::Storage { found } => write!(f, "storage of the table on the GPU: found {found:?}, expected F16 or F32"),
            ErrorKind::NotFilterable => f.write_str(
                "table of 32-bit floats read through the filter: found a device without FLOAT32_FILTERABLE, expected one with it, or F16",
            ),
            ErrorKind::Shaper => f.write_str("shaper of a plain form: found a kind that has no shader, expected log2 with an offset"),
            ErrorKind::NoCompute => f.write_str("device for a bake: found no compute shaders, expected some"),
            ErrorKind::OtherForm { found, expected } => {
                write!(f, "form of the new look: found {found}, expected {expected} as in these resources")
            }
            ErrorKind::TableSize { found, expected } => write!(
                f,
                "table of the new look: found {found} nodes a side, expected {expected} as in these resources"
            ),
            ErrorKind::TableLimit { found, max } => {
                write!(f, "table on the GPU: found {found} nodes a side, expected at most {max}, as the device allows")
            }
            ErrorKind::Points { found, max } => write!(f, "points of the form's curves: found {found}, expected at most {max}"),
            ErrorKind::Terms { found, max } => {
                write!(f, "terms of a sum of the form: found {found}, expected at most {max}")
            }
            ErrorKind::HalfFloat { found } => {
                write!(f, "entry of a table kept in half floats: found {found}, expected a number within ±65504")
            }
            ErrorKind::NotFinite { what, found } => write!(f, "{what}: found {found} in 32-bit floats, expected finite numbers"),
            ErrorKind::Binding { found, max } => {
                write!(f, "first binding of a look: found {found}, expected at most {max}, as the device allows")
            }
            ErrorKind::Side { width, height, max } => {
                write!(f, "picture on the GPU: found {width}x{height} pixels, expected at most {max} a side")
            }
            ErrorKind::Sizes { from, to } => write!(
                f,
                "size of the texture to write: found {}x{}, expected {}x{} as in the one to read",
                to[0], to[1], from[0], from[1]
            ),
            ErrorKind::NoAdapter { found, expected } => {
                let found = if found.is_empty() { "none".to_owned() } else { found.join(", ") };
                let named = if expected.is_empty() { String::new() } else { format!(" with {expected:?} in its name") };
                write!(f, "graphics adapter: found {found}, expected one{named}: is its driver installed?")
            }
            ErrorKind::Device { found } => write!(f, "device of the adapter: found that {found}, expected one to work with"),
            ErrorKind::ByteCount { found, expected } => {
                write!(f, "bytes of a picture to upload: found {found}, expected {expected} for its size and format")
            }
            ErrorKind::BufferLimit { found, max } => {
                write!(f, "buffer to read a texture back: found {found} bytes, expected at most {max}, as the device allows")
            }
        }
    }
}

impl Refused {
    fn name(self) -> &'static str {
        match self {
            Self::Source => "view of the texture to read",
            Self::SourceAndTarget => "views of the textures to read and to write",
            Self::Target => "view of the texture to write",
            Self::Texture => "texture on the GPU",
            Self::ReadBack => "texture or buffer to read back",
        }
    }

    fn expected(self) -> &'static str {
        match self {
            Self::Source => "a two-dimensional view of one layer, of the same device as the pass",
            Self::SourceAndTarget => {
                "two-dimensional views of one layer, of the same device as the pass, the second in its format"
            }
            Self::Target => "a two-dimensional view of one layer in the pass's format, of the same device",
            Self::Texture => "a size, format and usage that the device has",
            Self::ReadBack => {
                "a texture of plain colour, one sample a pixel, with the usage COPY_SRC, or an unmapped buffer with MAP_READ"
            }
        }
    }
}

/// `COPY_SRC | RENDER_ATTACHMENT`, or `none`.
fn names(usages: TextureUsages) -> String {
    let names: Vec<_> = usages.iter_names().map(|(name, _)| name).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(" | ") }
}
