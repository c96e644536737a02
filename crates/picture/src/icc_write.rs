//! The ICC profile of a space that a picture is written in: a matrix and a curve (\[ICC1\]).

use crate::{
    colour_tag::{ColourTag, OutputTransfer},
    description::Chromaticities,
};

/// The white of the profile connection space, D50 as ICC rounds it.
const D50: [f64; 3] = [0.9642, 1.0, 0.8249];
/// The Bradford cone responses of XYZ, as annex E gives them.
const BRADFORD: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

type Matrix = [[f64; 3]; 3];

/// The bytes of a profile of version 4.3, the same for the same space; `None` where the primaries make no space.
pub(crate) fn profile(tag: &ColourTag) -> Option<Vec<u8>> {
    let (colorants, adaptation) = colorants(&tag.primaries)?;
    let curve = match tag.transfer {
        OutputTransfer::Srgb => parametric(3, &[2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045]),
        OutputTransfer::Gamma24 => parametric(0, &[2.4]),
        OutputTransfer::Gamma26 => parametric(0, &[2.6]),
        // Of absolute light, which a matrix and curves do not hold.
        OutputTransfer::Pq | OutputTransfer::Hlg => return None,
        OutputTransfer::Linear => parametric(0, &[1.0]),
    };
    let column = |index: usize| xyz([colorants[0][index], colorants[1][index], colorants[2][index]]);
    let numbers: Vec<u8> = adaptation.as_flattened().iter().flat_map(|v| s15_fixed16(*v)).collect();
    let tags: [(&[u8; 4], Vec<u8>); 11] = [
        (b"desc", text(&name(tag))),
        (b"cprt", text("CC0")),
        (b"wtpt", xyz(D50)),
        (b"chad", [&b"sf32\0\0\0\0"[..], &numbers].concat()),
        (b"rXYZ", column(0)),
        (b"gXYZ", column(1)),
        (b"bXYZ", column(2)),
        (b"rTRC", curve.clone()),
        (b"gTRC", curve.clone()),
        (b"bTRC", curve.clone()),
        (b"lumi", xyz([0.0, 80.0, 0.0])),
    ];
    let (mut table, mut data) = (Vec::new(), Vec::new());
    let start = 128 + 4 + 12 * tags.len();
    for (signature, contents) in &tags {
        table.extend(*signature);
        table.extend(((start + data.len()) as u32).to_be_bytes());
        table.extend((contents.len() as u32).to_be_bytes());
        data.extend(contents);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    let mut bytes = Vec::with_capacity(start + data.len());
    bytes.extend(((start + data.len()) as u32).to_be_bytes());
    bytes.extend(*b"\0\0\0\0\x04\x30\0\0mntrRGB XYZ ");
    // A date that never changes, so that the same picture is always the same file.
    bytes.extend([2026, 1, 1, 0, 0, 0].map(u16::to_be_bytes).as_flattened());
    bytes.extend(*b"acsp");
    bytes.resize(68, 0);
    bytes.extend(D50.map(s15_fixed16).as_flattened());
    bytes.resize(128, 0);
    bytes.extend((tags.len() as u32).to_be_bytes());
    bytes.extend(table);
    bytes.extend(data);
    Some(bytes)
}

/// What viewers show as the profile's name.
fn name(tag: &ColourTag) -> String {
    let known = [
        (Chromaticities::BT709, "sRGB"),
        (Chromaticities::P3_D65, "Display P3"),
        (Chromaticities::BT2020, "Rec.2020"),
        (Chromaticities::ADOBE_RGB, "Adobe RGB"),
        (Chromaticities::AP1, "ACEScg"),
        (Chromaticities::AP0, "ACES2065-1"),
    ];
    let space = known.iter().find(|(known, _)| known.is_near(&tag.primaries)).map_or("RGB", |(_, name)| name);
    let curve = match tag.transfer {
        OutputTransfer::Srgb => "sRGB curve",
        OutputTransfer::Gamma24 => "gamma 2.4",
        OutputTransfer::Gamma26 => "gamma 2.6",
        OutputTransfer::Pq => "PQ",
        OutputTransfer::Hlg => "HLG",
        OutputTransfer::Linear => "linear",
    };
    format!("onelight {space}, {curve}")
}

/// Red, green and blue as seen beside D50, in columns, and the matrix that adapts to D50.
fn colorants(space: &Chromaticities) -> Option<(Matrix, Matrix)> {
    let point = |[x, y]: [f32; 2]| [f64::from(x), f64::from(y), 1.0 - f64::from(x) - f64::from(y)];
    let [red, green, blue, white] = [space.red, space.green, space.blue, space.white].map(point);
    let white = white.map(|v| v / white[1]);
    let primaries = transposed([red, green, blue]);
    let amounts = apply(&inverse(&primaries)?, white);
    let to_xyz = times(&primaries, &diagonal(amounts));
    let (from, to) = (apply(&BRADFORD, white), apply(&BRADFORD, D50));
    let scale = diagonal([to[0] / from[0], to[1] / from[1], to[2] / from[2]]);
    let adaptation = times(&inverse(&BRADFORD)?, &times(&scale, &BRADFORD));
    let colorants = times(&adaptation, &to_xyz);
    // What 16.16 bits can say.
    let fits = |matrix: &Matrix| matrix.as_flattened().iter().all(|v| v.abs() < 32_000.0);
    (fits(&colorants) && fits(&adaptation)).then_some((colorants, adaptation))
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(*b).map(|column| apply(a, column));
    transposed(columns)
}

fn apply(matrix: &Matrix, v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn diagonal([a, b, c]: [f64; 3]) -> Matrix {
    [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]
}

fn transposed([a, b, c]: Matrix) -> Matrix {
    [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]]
}

/// By cofactors; `None` where the matrix is singular.
fn inverse(m: &Matrix) -> Option<Matrix> {
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let [a, b, c] = *m;
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = a[0] * columns[0][0] + a[1] * columns[0][1] + a[2] * columns[0][2];
    (determinant.abs() > 1e-9).then(|| transposed(columns.map(|column| column.map(|v| v / determinant))))
}

fn s15_fixed16(value: f64) -> [u8; 4] {
    ((value * 65_536.0).round() as i32).to_be_bytes()
}

fn xyz(values: [f64; 3]) -> Vec<u8> {
    [&b"XYZ \0\0\0\0"[..], values.map(s15_fixed16).as_flattened()].concat()
}

fn parametric(kind: u16, constants: &[f64]) -> Vec<u8> {
    let constants: Vec<u8> = constants.iter().flat_map(|v| s15_fixed16(*v)).collect();
    [&b"para\0\0\0\0"[..], &kind.to_be_bytes(), &[0; 2], &constants].concat()
}

/// One text in English.
fn text(text: &str) -> Vec<u8> {
    let words: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let head = [1_u32, 12].map(u32::to_be_bytes);
    let place = [words.len() as u32, 28].map(u32::to_be_bytes);
    [&b"mluc\0\0\0\0"[..], head.as_flattened(), b"enUS", place.as_flattened(), &words].concat()
}
