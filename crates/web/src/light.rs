//! From the values of a file to scene-linear light, as `cargo xtask develop` does it without options.

use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Chromaticity, RgbSpace, finite};
use onelight::{Meter, WorkingSpace, space_of};
use onelight_picture::{Band, Description, Source, TiffSamples, Transfer, Tristimulus};

use crate::error::Error;

/// How the values of a file become light in the look's input space.
#[derive(Debug, Clone)]
pub(crate) struct Light {
    transfer: Transfer,
    /// From the file's primaries to those of the look; `None` where they are the same.
    to_input: Option<Matrix3<f64>>,
    /// Luminance of the file's primaries.
    luminance: Vector3<f64>,
}

impl Light {
    /// For a picture; `notes` gets what the user should know of the choice.
    pub(crate) fn new(picture: &Description, input: WorkingSpace, notes: &mut Vec<String>) -> Result<Self, Error> {
        let floats = matches!(
            picture.source,
            Source::Exr | Source::RadianceHdr | Source::Tiff { samples: TiffSamples::Float, .. }
        );
        let transfer = match &picture.transfer {
            Some(transfer) => transfer.clone(),
            None if floats => Transfer::Linear,
            None => {
                notes.push("The file does not say how its values are coded: they are taken for sRGB.".to_owned());
                Transfer::Srgb
            }
        };
        if let Some(by) = &picture.colours_said_by {
            notes.push(format!("Its colours are read by {by}."));
        }
        let white = Chromaticity::black_body_6500_k();
        let to_input = match picture.primaries.as_ref().map(space_of) {
            None => None,
            Some(own) if picture.tristimulus == Tristimulus::Xyz => {
                let to_srgb = RgbSpace::SRGB.from_xyz()? * own.to_xyz()?;
                Some(RgbSpace::SRGB.to_about(&input.space(), white)? * to_srgb)
            }
            Some(own) => Some(own.to_about(&input.space(), white)?),
        };
        let to_xyz = input.space().with_white(white).to_xyz()?;
        let luminance = (to_xyz * to_input.unwrap_or_else(Matrix3::identity)).row(1).transpose();
        let to_input = to_input.filter(|matrix| *matrix != Matrix3::identity());
        Ok(Self { transfer, to_input, luminance })
    }

    /// Makes light of a band's values, and shows it to the meter if there is one.
    pub(crate) fn of(&self, band: &mut Band, ev: f64, mut meter: Option<&mut Meter>) {
        let scale = ev.exp2();
        let is_linear = matches!(self.transfer, Transfer::Linear);
        for rgb in band.rgb_mut() {
            if !is_linear {
                *rgb = self.transfer.light(*rgb);
            }
            if let Some(meter) = &mut meter {
                meter.add(self.luminance.dot(&Vector3::from(rgb.map(f64::from))));
            }
            match self.to_input {
                None if scale == 1.0 => {}
                // NaN and infinity stay in their channels: only the film says what they mean.
                None => *rgb = rgb.map(|v| (f64::from(v) * scale) as f32),
                Some(matrix) => {
                    let own = Vector3::from(rgb.map(|v| finite(f64::from(v))));
                    *rgb = <[f64; 3]>::from(matrix * scale * own).map(|v| v as f32);
                }
            }
        }
    }
}
