use wgpu::{Device, TextureFormat, TextureUsages};

use crate::error::{Error, ErrorKind};

/// A format that can be written, by how it takes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// Integers that stand for 0 to 1.
    Unorm(TextureFormat),
    /// The same behind a view that encodes by the sRGB curve.
    Srgb(TextureFormat),
    /// Half floats in four channels: `Rgba16Float`.
    Half,
    /// 32-bit floats in four channels: `Rgba32Float`.
    Single,
}

/// Which kind of shader writes the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WriteMethod {
    Compute,
    Draw,
}

/// What the target does to the values that a shader gives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TargetCoding {
    /// It stores them as they are.
    Stored,
    /// It encodes them by the sRGB curve.
    Srgb,
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
            found => Err(ErrorKind::TargetFormat { found }.into()),
        }
    }

    pub(crate) fn format(self) -> TextureFormat {
        match self {
            Self::Unorm(format) | Self::Srgb(format) => format,
            Self::Half => TextureFormat::Rgba16Float,
            Self::Single => TextureFormat::Rgba32Float,
        }
    }

    pub(crate) fn coding(self) -> TargetCoding {
        if matches!(self, Self::Srgb(_)) { TargetCoding::Srgb } else { TargetCoding::Stored }
    }

    /// By compute where WebGPU lets shaders write the format and the device computes at all.
    pub(crate) fn write_method(self, device: &Device) -> WriteMethod {
        let writable = matches!(self, Self::Unorm(TextureFormat::Rgba8Unorm) | Self::Half | Self::Single);
        let computes = device.limits().max_compute_invocations_per_workgroup >= 64;
        if writable && computes { WriteMethod::Compute } else { WriteMethod::Draw }
    }
}

impl WriteMethod {
    /// The usage that a texture needs to be written so.
    pub(crate) fn usage(self) -> TextureUsages {
        match self {
            Self::Compute => TextureUsages::STORAGE_BINDING,
            Self::Draw => TextureUsages::RENDER_ATTACHMENT,
        }
    }
}
