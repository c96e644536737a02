//! The bare numbers of a form as the shaders' uniform buffers hold them.
//!
//! Word by word as the structs `OnelightPlain`, `OnelightStructured` and `OnelightDirect` in the WGSL files: 32-bit floats and
//! integers, matrices as three columns of four words, the fourth unused.

use onelight_lut::{
    Decode, DirectForm, DirectPrint, ExponentialTerm, Interpolation, Lut1d, Mix, PlainLut, PowerCoding, Rows,
    ShaperKind, StructuredLut,
};

use crate::error::{Error, Kind};

/// The most terms that each sum of a direct form may have: enough for every 5 nm from 400 to 1000 nm.
pub const MAX_TERMS: usize = 128;

/// First row of the second curves in the texture of points.
pub(crate) const SECOND_ROW: u32 = 3;

/// The input matrix that a shader may skip.
const IDENTITY: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Adds nothing to a sum.
const NO_TERM: ExponentialTerm = ExponentialTerm { rate: [0.0; 3], weight: [0.0; 3] };

/// What the target does to values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    /// They are stored.
    Stored,
    /// They are encoded by the sRGB curve.
    Encoded,
}

/// Words of a uniform buffer.
#[derive(Debug, Default)]
pub(crate) struct Words(Vec<u32>);

impl Words {
    fn float(&mut self, v: f32) {
        self.0.push(v.to_bits());
    }

    fn int(&mut self, v: usize) {
        self.0.push(u32::try_from(v).unwrap_or(u32::MAX));
    }

    fn flag(&mut self, on: bool) {
        self.0.push(u32::from(on));
    }

    fn floats(&mut self, v: impl IntoIterator<Item = f32>) {
        self.0.extend(v.into_iter().map(f32::to_bits));
    }

    fn rows(&mut self, rows: &Rows) {
        let [a, b, c] = rows;
        for ((a, b), c) in a.iter().zip(b).zip(c) {
            self.floats([*a, *b, *c, 0.0]);
        }
    }

    fn curves(&mut self, curves: &Lut1d, row: u32) -> Result<(), Error> {
        let (min, max) = (curves.domain().min(), curves.domain().max());
        let last = curves.size() - 1;
        let scale: [f64; 3] = std::array::from_fn(|c| 1.0 / (f64::from(max[c]) - f64::from(min[c])));
        let offset: [f32; 3] = std::array::from_fn(|c| (-f64::from(min[c]) * scale[c]) as f32);
        let scale = scale.map(|v| v as f32);
        finite("scale along a curve", &scale)?;
        finite("where a curve begins, over its length", &offset)?;
        self.floats(scale);
        self.float(last as f32);
        self.floats(offset);
        self.0.push(row);
        Ok(())
    }

    fn coding(&mut self, coding: &PowerCoding) {
        // Linear light is a foot without end.
        let end = if coding.exponent() == 1.0 { f32::MAX } else { coding.end() as f32 };
        self.floats([(1.0 / coding.exponent()) as f32, coding.offset() as f32, coding.slope() as f32, end]);
    }

    /// A sum in groups of four terms, and weights of 0 after its last.
    fn terms(&mut self, terms: &[ExponentialTerm]) {
        for first in (0..MAX_TERMS).step_by(4) {
            let group: [ExponentialTerm; 4] = std::array::from_fn(|i| terms.get(first + i).copied().unwrap_or(NO_TERM));
            (0..3).for_each(|c| self.floats(group.map(|term| term.rate[c])));
            (0..3).for_each(|c| self.floats(group.map(|term| term.weight[c])));
        }
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.0.iter().flat_map(|word| word.to_ne_bytes()).collect()
    }
}

pub(crate) fn plain(lut: &PlainLut, after: After) -> Result<Words, Error> {
    let mut words = Words::default();
    let ShaperKind::Log2Offset { offset, max: brightest } = lut.shaper().kind() else {
        return Err(Kind::Shaper.into());
    };
    let per_stop = std::f64::consts::LN_2 / (brightest / offset).ln_1p();
    words.floats([brightest as f32, (1.0 / offset) as f32, per_stop as f32]);
    words.float((lut.table().size() - 1) as f32);
    words.flag(lut.interpolation() == Interpolation::Trilinear);
    words.flag(after == After::Encoded);
    words.floats([0.0; 2]);
    Ok(words)
}

pub(crate) fn structured(lut: &StructuredLut, after: After) -> Result<Words, Error> {
    let parts = lut.parts();
    let mut words = Words::default();
    words.rows(&parts.input);
    words.rows(&parts.exposure);
    words.rows(parts.mix.as_ref().map_or(&[[0.0; 3]; 3], |mix| &mix.matrix));
    let (decode, coding, coded) = match &parts.decode {
        Decode::Coded => (&[[0.0; 3]; 3], PowerCoding::LINEAR, after == After::Encoded),
        Decode::Density { matrix, coding } => {
            let (coding, coded) = coding_before(coding, after);
            (matrix, coding, coded)
        }
    };
    words.rows(decode);
    words.floats(parts.mix.as_ref().map_or([0.0; 3], |mix| mix.offset));
    words.float((parts.table.size() - 1) as f32);
    words.curves(&parts.curves, 0)?;
    words.curves(parts.mix.as_ref().map_or(&parts.curves, |Mix { curves, .. }| curves), SECOND_ROW)?;
    words.coding(&coding);
    words.flag(parts.mix.is_some());
    words.flag(matches!(parts.decode, Decode::Density { .. }));
    words.flag(parts.interpolation == Interpolation::Trilinear);
    words.flag(coded);
    words.flag(parts.input != IDENTITY);
    words.floats([0.0; 3]);
    Ok(words)
}

pub(crate) fn direct(form: &DirectForm, after: After) -> Result<Words, Error> {
    let parts = form.parts();
    let print = parts.print.as_ref().map_or(&[][..], |print| print.exposure.terms());
    let projection = parts.projection.terms();
    let found = print.len().max(projection.len());
    if found > MAX_TERMS {
        return Err(Kind::Terms { found, max: MAX_TERMS }.into());
    }
    let (coding, coded) = coding_before(&parts.coding, after);
    let mut words = Words::default();
    words.rows(&parts.input);
    words.rows(&parts.exposure);
    words.curves(&parts.curves, 0)?;
    words.curves(parts.print.as_ref().map_or(&parts.curves, |DirectPrint { curves, .. }| curves), SECOND_ROW)?;
    words.coding(&coding);
    words.int(print.len().div_ceil(4));
    words.int(projection.len().div_ceil(4));
    words.flag(coded);
    words.flag(parts.input != IDENTITY);
    words.terms(print);
    words.terms(projection);
    Ok(words)
}

/// The coding that a shader does, and whether what it yields is still to be decoded: a target that encodes wants linear light.
fn coding_before(coding: &PowerCoding, after: After) -> (PowerCoding, bool) {
    let linear = coding.exponent() == 1.0;
    let srgb = coding.exponent() == 2.4 && coding.offset() == 0.055;
    match after {
        After::Stored => (*coding, false),
        After::Encoded if linear || srgb => (PowerCoding::LINEAR, false),
        After::Encoded => (*coding, true),
    }
}

/// Three curves as texels for each row: value, rise to the next point.
pub(crate) fn points(curves: &Lut1d) -> Result<Vec<u8>, Error> {
    let entries = curves.entries();
    let mut bytes = Vec::with_capacity(entries.len() * 24);
    for c in 0..3 {
        for (i, entry) in entries.iter().enumerate() {
            let rise = entries.get(i + 1).map_or(0.0, |next| next[c] - entry[c]);
            finite("rise of a curve from point to point", &[rise])?;
            bytes.extend(entry[c].to_ne_bytes());
            bytes.extend(rise.to_ne_bytes());
        }
    }
    Ok(bytes)
}

fn finite(what: &'static str, values: &[f32]) -> Result<(), Error> {
    match values.iter().find(|v| !v.is_finite()) {
        Some(&found) => Err(Kind::NotFinite { what, found }.into()),
        None => Ok(()),
    }
}
