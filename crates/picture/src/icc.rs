//! What an ICC profile says of its colours: matrices and curves, not tables.

use std::sync::Arc;

use moxcms::{ColorProfile, DataColorSpace, Matrix3d, ParsingOptions, ProfileText, ToneReprCurve, Xyzd};

use crate::{
    decoder_message::one_line,
    description::Chromaticities,
    file_colours::{FileColours, of_code_points},
    panic_to_error::panic_to_error,
    transfer::{Curve, Transfer},
};

/// Most bytes of a profile that is read; those of cameras and phones have some hundred, printers' tables some million.
pub(crate) const MAX_BYTES: usize = 1 << 22;

/// Most entries of a curve.
const MAX_CURVE: usize = 1 << 16;

/// What `profile` says, or a note of why it is not used.
pub(crate) fn colours(profile: &[u8]) -> Result<FileColours, String> {
    if profile.len() > MAX_BYTES {
        return Err(format!(
            "left out the file's ICC profile, which has {} bytes, expected up to {MAX_BYTES}",
            profile.len()
        ));
    }
    let options = ParsingOptions {
        max_profile_size: MAX_BYTES + 1,
        max_allowed_clut_size: MAX_BYTES,
        max_allowed_trc_size: MAX_CURVE,
    };
    let parsed = panic_to_error(|| ColorProfile::new_from_slice_with_options(profile, options));
    let Ok(Ok(parsed)) = parsed else {
        return Err("left out the file's ICC profile, which is damaged".to_owned());
    };
    let name = parsed.description.as_ref().and_then(text).unwrap_or_else(|| "without a name".to_owned());
    let said_by = format!("the ICC profile `{}`", one_line(name.trim()));
    if let Some(points) = &parsed.cicp {
        let (primaries, transfer) = of_code_points(points.color_primaries as u8, points.transfer_characteristics as u8);
        if primaries.is_some() && transfer.is_some() {
            return Ok(FileColours { primaries, transfer, said_by });
        }
    }
    let unused = |why: &str| Err(format!("left out {said_by}, which {why}"));
    match parsed.color_space {
        DataColorSpace::Gray => match parsed.gray_trc.as_ref().and_then(curve) {
            Some(grey) => {
                let transfer = Some(simplest([grey.clone(), grey.clone(), grey]));
                Ok(FileColours { primaries: None, transfer, said_by })
            }
            None => unused("has no curve for grey"),
        },
        DataColorSpace::Rgb => {
            let curves = [&parsed.red_trc, &parsed.green_trc, &parsed.blue_trc];
            let curves = curves.map(|own| own.as_ref().and_then(curve));
            let [Some(red), Some(green), Some(blue)] = curves else {
                return unused("is made of tables (only a matrix with curves is read)");
            };
            match primaries(&parsed) {
                Some(primaries) => Ok(FileColours {
                    primaries: Some(primaries),
                    transfer: Some(simplest([red, green, blue])),
                    said_by,
                }),
                None => unused("has primaries that make no space"),
            }
        }
        _ => unused("is not of RGB or grey"),
    }
}

fn text(text: &ProfileText) -> Option<String> {
    match text {
        ProfileText::PlainString(text) => Some(text.clone()),
        ProfileText::Localizable(texts) => texts.first().map(|text| text.value.clone()),
        ProfileText::Description(text) => Some(text.ascii_string.clone()),
    }
}

fn curve(curve: &ToneReprCurve) -> Option<Curve> {
    let finite = |values: &[f32]| values.iter().all(|v| v.is_finite());
    match curve {
        ToneReprCurve::Lut(entries) => match entries[..] {
            [] => Some(power(1.0)),
            // One number is a power, in 256ths.
            [power_256] => Some(power(f32::from(power_256) / 256.0)),
            _ => Some(Curve::Table(entries.iter().map(|v| f32::from(*v) / 65_535.0).collect())),
        },
        // ICC.1:2022, table 68: each kind has more constants.
        ToneReprCurve::Parametric(p) if finite(p) => match p[..] {
            [g] => Some(power(g)),
            [g, a, b] if a != 0.0 => Some(Curve::Parametric([g, a, b, 0.0, -b / a, 0.0, 0.0])),
            [g, a, b, c] if a != 0.0 => Some(Curve::Parametric([g, a, b, 0.0, -b / a, c, c])),
            [g, a, b, c, d] => Some(Curve::Parametric([g, a, b, c, d, 0.0, 0.0])),
            [g, a, b, c, d, e, f] => Some(Curve::Parametric([g, a, b, c, d, e, f])),
            _ => None,
        },
        ToneReprCurve::Parametric(_) => None,
    }
}

/// A pure power as a curve.
fn power(power: f32) -> Curve {
    Curve::Parametric([power, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// Curves that a standard has a name for are called by it: numbers of a profile are rounded.
fn simplest(curves: [Curve; 3]) -> Transfer {
    let [red, green, blue] = &curves;
    if red == green && green == blue {
        if let Curve::Parametric([g, a, b, _, _, e, f]) = *red
            && (a, b, e, f) == (1.0, 0.0, 0.0, 0.0)
        {
            // A power of one decimal is rounded to 1/65536.
            let round = (g * 10.0).round() / 10.0;
            let g = if (g - round).abs() < 2e-5 { round } else { g };
            return if g == 1.0 { Transfer::Linear } else { Transfer::Power(g) };
        }
        // Four decimals, or the table of 1024 steps that the first profiles of sRGB have.
        let near = |at: f32| (red.value(at) - Transfer::Srgb.light([at; 3])[0]).abs() < 2e-4;
        if (0..=64_u8).all(|step| near(f32::from(step) / 64.0)) {
            return Transfer::Srgb;
        }
        let straight = |at: f32| (red.value(at) - at).abs() < 1e-5;
        if (0..=64_u8).all(|step| straight(f32::from(step) / 64.0)) {
            return Transfer::Linear;
        }
    }
    Transfer::Curves(Arc::new(curves))
}

/// The Bradford cone responses of XYZ (\[ICC1\], annex E).
const BRADFORD: Matrix3d =
    Matrix3d { v: [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]] };

/// The primaries as they were before the profile adapted them to D50.
fn primaries(profile: &ColorProfile) -> Option<Chromaticities> {
    let colorants = [profile.red_colorant, profile.green_colorant, profile.blue_colorant];
    let to_own = match (profile.chromatic_adaptation, profile.media_white_point) {
        (Some(adaptation), _) => adaptation.inverse(),
        // Profiles of version 2 say it by the white of the medium.
        (None, Some(white)) => bradford(white),
        (None, None) => Matrix3d::IDENTITY,
    };
    let own = colorants.map(|colorant| times(&to_own, colorant));
    let sum =
        Xyzd { x: own.iter().map(|c| c.x).sum(), y: own.iter().map(|c| c.y).sum(), z: own.iter().map(|c| c.z).sum() };
    let xy = |c: Xyzd| {
        let sum = c.x + c.y + c.z;
        let xy = [(c.x / sum) as f32, (c.y / sum) as f32];
        (xy.iter().all(|v| v.is_finite()) && sum > 0.0).then_some(xy)
    };
    let found = Chromaticities { red: xy(own[0])?, green: xy(own[1])?, blue: xy(own[2])?, white: xy(sum)? };
    let named = [
        Chromaticities::BT709,
        Chromaticities::P3_D65,
        Chromaticities::BT2020,
        Chromaticities::ADOBE_RGB,
        Chromaticities::AP1,
        Chromaticities::AP0,
        Chromaticities::P3_DCI,
        Chromaticities::XYZ,
    ];
    // Profiles are rounded to 1/65536 and adapted by matrices of four decimals.
    let near = |named: &Chromaticities| {
        let pairs =
            [(named.red, found.red), (named.green, found.green), (named.blue, found.blue), (named.white, found.white)];
        pairs.iter().all(|(a, b)| (a[0] - b[0]).abs() < 2e-3 && (a[1] - b[1]).abs() < 2e-3)
    };
    Some(named.into_iter().find(near).unwrap_or(found))
}

/// From D50 to a white.
fn bradford(white: Xyzd) -> Matrix3d {
    const D50: Xyzd = Xyzd { x: 0.9642, y: 1.0, z: 0.8249 };
    let (from, to) = (times(&BRADFORD, D50), times(&BRADFORD, white));
    let scale = Matrix3d { v: [[to.x / from.x, 0.0, 0.0], [0.0, to.y / from.y, 0.0], [0.0, 0.0, to.z / from.z]] };
    BRADFORD.inverse().mat_mul_const(scale).mat_mul_const(BRADFORD)
}

fn times(matrix: &Matrix3d, c: Xyzd) -> Xyzd {
    let row = |row: [f64; 3]| row[0] * c.x + row[1] * c.y + row[2] * c.z;
    Xyzd { x: row(matrix.v[0]), y: row(matrix.v[1]), z: row(matrix.v[2]) }
}
