//! From the values of a file to the light that meets the film.

use anyhow::{Context, Result};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Chromaticity, RgbSpace};
use onelight::{InputCoding, Process, TransferCurve, Word};
use onelight_picture::{Band, Chromaticities, Description, RowMut, Source, TiffSamples, Transfer, Tristimulus};
use rayon::prelude::*;

use super::coverage::Coverage;
use super::exposure::{Meter, RowLight};
use super::input::{InputPrimaries, InputSettings, InputWhite};
use crate::exposure::SceneExposure;
use crate::scene_colours;

/// How the values of a file become light.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Light {
    coding: Coding,
    /// What becomes of alpha.
    pub(super) coverage: Coverage,
    /// What camera and frame buffer make of the numbers.
    scene: SceneExposure,
    /// From the file's primaries to those of the process; `None` where they are the same.
    to_input: Option<Matrix3<f64>>,
    /// Luminance of the file's primaries.
    luminance: Vector3<f64>,
}

/// How values are coded.
#[derive(Debug, Clone, PartialEq)]
enum Coding {
    Named(InputCoding),
    OfFile(Transfer),
}

impl Light {
    /// For a picture; `notes` gets what the user should know of the choice.
    pub(super) fn new(
        picture: &Description,
        process: &Process,
        input: &InputSettings,
        scene: &SceneExposure,
        notes: &mut Vec<String>,
    ) -> Result<Self> {
        let to_input = to_input_space(picture, process, input, notes)?;
        let coding = coding_of(picture, input.coding, notes);
        notes.extend(said_by_file(picture, input));
        notes.extend(unsaid(picture, process, input));
        let to_xyz = process.spaces().input_space.space().with_white(Chromaticity::black_body_6500_k()).to_xyz();
        let to_xyz = to_xyz.context("the input space")?;
        let luminance = (to_xyz * to_input.unwrap_or_else(Matrix3::identity)).row(1).transpose();
        notes.extend(scene.notes.iter().cloned());
        let scene = scene.clone();
        let to_input = to_input.filter(|matrix| *matrix != Matrix3::identity());
        Ok(Self { coding, coverage: Coverage::Kept, scene, to_input, luminance })
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
            let mut row = row;
            if !self.coding.is_linear() {
                row.rgb.iter_mut().for_each(|rgb| *rgb = self.coding.light(*rgb));
            }
            self.coverage.apply(&mut row);
            if !self.scene.changes_nothing() {
                row.rgb.iter_mut().for_each(|rgb| *rgb = self.scene.apply(*rgb));
            }
            let seen = meter.is_some().then(|| self.look_at(&row));
            row.rgb.iter_mut().for_each(&change);
            seen
        });
        let rows: Vec<Option<RowLight>> = rows.collect();
        if self.coverage != Coverage::Kept {
            band.leave_out_alpha();
        }
        if let Some(meter) = meter {
            rows.iter().flatten().for_each(|row| meter.add(row));
        }
    }

    fn look_at(&self, row: &RowMut<'_>) -> RowLight {
        let mut seen = RowLight { hard: 0, logs: Vec::with_capacity(row.rgb.len()) };
        let kept = self.coverage == Coverage::Kept;
        for (x, rgb) in row.rgb.iter().enumerate() {
            seen.hard += usize::from(rgb.iter().any(|v| !v.is_finite()));
            let luminance = self.luminance.dot(&Vector3::from(rgb.map(f64::from)));
            let covered = !kept || row.alpha.as_ref().is_none_or(|alpha| alpha[x] != 0.0);
            if covered && luminance > 0.0 && luminance.is_finite() {
                seen.logs.push(luminance.log2());
            }
        }
        seen
    }
}

impl Coding {
    fn is_linear(&self) -> bool {
        matches!(self, Self::Named(InputCoding::Display(TransferCurve::Linear)) | Self::OfFile(Transfer::Linear))
    }

    fn light(&self, rgb: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Named(curve) => rgb.map(|v| curve.decode(f64::from(v)) as f32),
            Self::OfFile(transfer) => transfer.light(rgb),
        }
    }
}

/// From a picture's primaries to those of the process; `None` where they are the same.
fn to_input_space(
    picture: &Description,
    process: &Process,
    input: &InputSettings,
    notes: &mut Vec<String>,
) -> Result<Option<Matrix3<f64>>> {
    let look = process.spaces().input_space;
    let named = input.coding.filter(|coding| coding.space().is_some() && input.primaries == InputPrimaries::OfFile);
    let coded = named.or(input.coding.filter(|coding| *coding == InputCoding::Cineon));
    let of_file = picture.primaries.filter(|_| input.primaries == InputPrimaries::OfFile && coded.is_none());
    if picture.primaries.is_some() && of_file.is_none() {
        let by = match coded {
            Some(coding) => format!("--input-coding {}", coding.word()),
            None => format!("--input-space {}", look.word()),
        };
        notes.push(format!("the file's own chromaticities give way to {by}"));
    }
    let own = named.and_then(InputCoding::space).or_else(|| of_file.as_ref().map(onelight::space_of));
    let is_xyz = of_file.is_some() && picture.tristimulus == Tristimulus::Xyz;
    let usual = if is_xyz { InputWhite::Absolute } else { InputWhite::Relative };
    match input.white.unwrap_or(usual) {
        InputWhite::Relative => {
            let way_out = "the file's colours cannot be used, expected --input-space with the space that is meant";
            scene_colours::to_input_space(own.as_ref(), process).context(way_out)
        }
        InputWhite::Absolute => {
            let own = own.unwrap_or(look.space());
            let to_srgb = RgbSpace::SRGB.from_xyz()? * own.to_xyz().context("its chromaticities")?;
            let matrix = RgbSpace::SRGB.to_about(&look.space(), Chromaticity::black_body_6500_k())? * to_srgb;
            Ok(Some(matrix))
        }
    }
}

/// The transfer curve to undo: the command line's, else the file's, else what is usual.
fn coding_of(picture: &Description, named: Option<InputCoding>, notes: &mut Vec<String>) -> Coding {
    let floats =
        matches!(picture.source, Source::Exr | Source::RadianceHdr | Source::Tiff { samples: TiffSamples::Float, .. });
    match (named, &picture.transfer) {
        (Some(coding), None) if picture.source == Source::Exr && matches!(coding, InputCoding::Display(_)) => {
            notes.push("an EXR holds linear light: --input-coding is not used".to_owned());
            Coding::Named(InputCoding::Display(TransferCurve::Linear))
        }
        (Some(coding), said) => {
            if said.is_some() && picture.source != Source::RadianceHdr {
                notes.push(format!("the file's own coding gives way to --input-coding {}", coding.word()));
            }
            if !matches!(coding, InputCoding::Display(_)) {
                notes.push(format!("read as {}, full range", coding.name()));
            }
            Coding::Named(coding)
        }
        (None, Some(transfer)) => Coding::OfFile(transfer.clone()),
        (None, None) if floats => {
            if matches!(picture.source, Source::Tiff { .. }) {
                notes.push(
                    "the file does not say what its floats are: taken for linear light (--input-coding says otherwise)"
                        .to_owned(),
                );
            }
            Coding::Named(InputCoding::Display(TransferCurve::Linear))
        }
        (None, None) => {
            notes.push(
                "the file does not say how its integers are coded: taken for sRGB (--input-coding says otherwise)"
                    .to_owned(),
            );
            Coding::Named(InputCoding::Display(TransferCurve::Srgb))
        }
    }
}

/// What is taken for granted of a picture, for the user to know.
fn unsaid(picture: &Description, process: &Process, input: &InputSettings) -> Option<String> {
    let is_named =
        input.primaries == InputPrimaries::OfLook || input.coding.is_some_and(|coding| coding.space().is_some());
    let linear = matches!(picture.source, Source::Exr | Source::Tiff { samples: TiffSamples::Float, .. });
    match picture.source {
        Source::Jpeg => Some(
            "a JPEG is a finished picture: its coding is undone, what the camera made of the scene is not".to_owned(),
        ),
        _ if linear && picture.primaries.is_none() && !is_named => Some(format!(
            "the file names no primaries: taken for those of {} (--input-space says otherwise)",
            process.spaces().input_space.word()
        )),
        _ => None,
    }
}

/// What a file says of its colours and is believed.
fn said_by_file(picture: &Description, input: &InputSettings) -> Option<String> {
    let said_by = picture.colours_said_by.as_ref()?;
    let transfer = picture.transfer.as_ref().filter(|_| input.coding.is_none()).map(|transfer| match transfer {
        Transfer::Linear => "linear".to_owned(),
        Transfer::Srgb => "sRGB-coded".to_owned(),
        Transfer::Power(power) => format!("coded by a power of 1/{power:.4}"),
        Transfer::Bt709 => "coded by BT.709's camera curve".to_owned(),
        Transfer::Pq => "PQ-coded, white at 203 cd/m2".to_owned(),
        Transfer::Hlg => "HLG-coded, white at 75 %".to_owned(),
        Transfer::Curves(_) => "coded by curves of its own".to_owned(),
    });
    let of_file = input.primaries == InputPrimaries::OfFile
        && input.coding.is_none_or(|coding| matches!(coding, InputCoding::Display(_)));
    let primaries = picture.primaries.filter(|_| of_file).map(|own| {
        let named = [
            (Chromaticities::BT709, "sRGB primaries"),
            (Chromaticities::P3_D65, "Display P3 primaries"),
            (Chromaticities::P3_DCI, "DCI-P3 primaries"),
            (Chromaticities::BT2020, "BT.2020 primaries"),
            (Chromaticities::ADOBE_RGB, "Adobe RGB primaries"),
            (Chromaticities::AP1, "ACEScg primaries"),
            (Chromaticities::AP0, "ACES2065-1 primaries"),
            (Chromaticities::XYZ, "CIE XYZ"),
        ];
        named.iter().find(|(named, _)| named.is_near(&own)).map_or("primaries of its own", |(_, name)| name)
    });
    let said: Vec<&str> = primaries.into_iter().chain(transfer.as_deref()).collect();
    (!said.is_empty()).then(|| format!("read as {}, by {said_by}", said.join(", ")))
}

/// What a channel counts as before it is mixed with others.
fn finite(rgb: [f32; 3]) -> [f64; 3] {
    rgb.map(|v| onelight::spectra::finite(f64::from(v)))
}
