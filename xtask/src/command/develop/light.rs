//! From the values of a file to the light that meets the film.

use anyhow::{Context, Result};
use onelight::spectra::Chromaticity;
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::{Process, TransferCurve, Word};
use onelight_picture::{Band, Description, RowMut, Source, TiffSamples};
use rayon::prelude::*;

use super::exposure::{Meter, RowLight};
use crate::exposure::SceneExposure;
use crate::scene_colours;

/// Whose word counts for the primaries of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum InputPrimaries {
    /// The file's, and the look's where it says nothing.
    OfFile,
    /// Those of the look, whatever the file says.
    OfLook,
}

/// How the values of a file become light.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Light {
    coding: TransferCurve,
    /// What camera and frame buffer make of the numbers.
    scene: SceneExposure,
    /// From the file's primaries to those of the process; `None` where they are the same.
    to_input: Option<Matrix3<f64>>,
    /// Luminance of the file's primaries.
    luminance: Vector3<f64>,
}

impl Light {
    /// For a picture; `notes` gets what the user should know of the choice.
    pub(super) fn new(
        picture: &Description,
        process: &Process,
        coding: Option<TransferCurve>,
        primaries: InputPrimaries,
        scene: &SceneExposure,
        notes: &mut Vec<String>,
    ) -> Result<Self> {
        let to_input = if picture.primaries.is_some() && primaries == InputPrimaries::OfLook {
            let space = process.spaces().input_space.word();
            notes.push(format!("the file's own chromaticities give way to --input-space {space}"));
            None
        } else {
            scene_colours::to_input_space(picture.primaries.as_ref(), process)?
        };
        let coding = coding_of(picture, coding, notes);
        let to_xyz = process.spaces().input_space.space().with_white(Chromaticity::black_body_6500_k()).to_xyz();
        let to_xyz = to_xyz.context("the input space")?;
        let luminance = (to_xyz * to_input.unwrap_or_else(Matrix3::identity)).row(1).transpose();
        notes.extend(scene.notes.iter().cloned());
        let scene = scene.clone();
        Ok(Self { coding, scene, to_input: to_input.filter(|matrix| *matrix != Matrix3::identity()), luminance })
    }

    /// Undoes the transfer curve, takes the numbers through camera and buffer, and shows the light to the meter.
    pub(super) fn measure(&self, band: &mut Band, meter: &mut Meter) {
        self.each_row(band, Some(meter), |_| {});
    }

    /// The same, then converts and exposes; shows the light before that to the meter, if there is one.
    pub(super) fn expose(&self, band: &mut Band, ev: f64, meter: Option<&mut Meter>) {
        let scale = ev.exp2();
        match self.to_input {
            // NaN and infinity stay in their channels: only the film says what they mean.
            None if scale == 1.0 => self.each_row(band, meter, |_| {}),
            None => self.each_row(band, meter, |rgb| *rgb = rgb.map(|v| (f64::from(v) * scale) as f32)),
            Some(matrix) => {
                let matrix = matrix * scale;
                let convert = |rgb: &mut [f32; 3]| {
                    *rgb = <[f64; 3]>::from(matrix * Vector3::from(finite(*rgb))).map(|v| v as f32);
                };
                self.each_row(band, meter, convert);
            }
        }
    }

    fn each_row(&self, band: &mut Band, meter: Option<&mut Meter>, change: impl Fn(&mut [f32; 3]) + Sync) {
        let rows = band.rows_mut().map(|row| {
            if self.coding != TransferCurve::Linear {
                let decode = |v: f32| self.coding.decode(f64::from(v)) as f32;
                row.rgb.iter_mut().for_each(|rgb| *rgb = rgb.map(decode));
            }
            if !self.scene.changes_nothing() {
                row.rgb.iter_mut().for_each(|rgb| *rgb = self.scene.apply(*rgb));
            }
            let seen = meter.is_some().then(|| self.look_at(&row));
            row.rgb.iter_mut().for_each(&change);
            seen
        });
        let rows: Vec<Option<RowLight>> = rows.collect();
        if let Some(meter) = meter {
            rows.iter().flatten().for_each(|row| meter.add(row));
        }
    }

    fn look_at(&self, row: &RowMut<'_>) -> RowLight {
        let mut seen = RowLight { hard: 0, logs: Vec::with_capacity(row.rgb.len()) };
        for (x, rgb) in row.rgb.iter().enumerate() {
            seen.hard += usize::from(rgb.iter().any(|v| !v.is_finite()));
            let luminance = self.luminance.dot(&Vector3::from(rgb.map(f64::from)));
            let covered = row.alpha.as_ref().is_none_or(|alpha| alpha[x] != 0.0);
            if covered && luminance > 0.0 && luminance.is_finite() {
                seen.logs.push(luminance.log2());
            }
        }
        seen
    }
}

/// The transfer curve to undo.
fn coding_of(picture: &Description, named: Option<TransferCurve>, notes: &mut Vec<String>) -> TransferCurve {
    match (named, picture.source) {
        (Some(_), Source::Exr) => {
            notes.push("an EXR holds linear light: --input-coding is not used".to_owned());
            TransferCurve::Linear
        }
        (Some(coding), _) => coding,
        (None, Source::Exr | Source::Tiff { samples: TiffSamples::Float, .. }) => TransferCurve::Linear,
        (None, Source::Png { .. } | Source::Tiff { samples: TiffSamples::Integer, .. }) => {
            notes.push("the picture's integers are taken for sRGB-coded (--input-coding says otherwise)".to_owned());
            TransferCurve::Srgb
        }
    }
}

/// What a channel counts as before it is mixed with others.
fn finite(rgb: [f32; 3]) -> [f64; 3] {
    rgb.map(|v| onelight::spectra::finite(f64::from(v)))
}
