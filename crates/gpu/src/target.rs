use wgpu::{Device, TextureFormat, TextureUsages};

use crate::error::{Error, Kind};

/// What is written to, by how it takes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// Integers for 0 to 1.
    Unorm(TextureFormat),
    /// The same behind a view that encodes by the sRGB curve.
    Srgb(TextureFormat),
    /// Half floats.
    Half,
    /// Floats.
    Single,
}

/// How a pass writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    Compute,
    Draw,
}

impl Target {
    pub(crate) fn new(format: TextureFormat) -> Result<Self, Error> {
        match format {
            TextureFormat::Rgba8Unorm | TextureFormat::Bgra8Unorm | TextureFormat::Rgb10a2Unorm => {
                Ok(Self::Unorm(format))
            }
            TextureFormat::Rgba8UnormSrgb | TextureFormat::Bgra8UnormSrgb => Ok(Self::Srgb(format)),
            TextureFormat::Rgba16Float => Ok(Self::Half),
            TextureFormat::Rgba32Float => Ok(Self::Single),
            found => Err(Kind::TargetFormat { found }.into()),
        }
    }

    pub(crate) fn format(self) -> TextureFormat {
        match self {
            Self::Unorm(format) | Self::Srgb(format) => format,
            Self::Half => TextureFormat::Rgba16Float,
            Self::Single => TextureFormat::Rgba32Float,
        }
    }

    /// By compute where WebGPU lets shaders write the format and the device computes at all.
    pub(crate) fn way(self, device: &Device) -> Way {
        let writable = matches!(self, Self::Unorm(TextureFormat::Rgba8Unorm) | Self::Half | Self::Single);
        if writable && device.limits().max_compute_invocations_per_workgroup >= 64 { Way::Compute } else { Way::Draw }
    }
}

impl Way {
    /// What a texture must allow to be written so.
    pub(crate) fn usage(self) -> TextureUsages {
        match self {
            Self::Compute => TextureUsages::STORAGE_BINDING,
            Self::Draw => TextureUsages::RENDER_ATTACHMENT,
        }
    }
}
