//! The bare numbers of a form as the shaders' uniform buffers hold them.
//!
//! Member by member as the structs `OnelightPlain`, `OnelightStructured` and `OnelightDirect` in the WGSL files: 32-bit floats
//! and integers, matrices as three columns of four words, the fourth unused. `layout.rs` compares names, offsets and sizes with
//! those that naga finds in the WGSL.

use onelight_lut::{
    CodingStandard, Decode, Develop, DirectForm, DirectPrint, ExponentialTerm, Expose, IDENTITY, Interpolation, Lut1d,
    Mix, NegativeLight, PlainLut, PowerCoding, Rows, ShaperKind, StructuredLut,
};

use crate::error::{Error, ErrorKind};
use crate::target::TargetCoding;

/// The most terms that each sum of a direct form may have: enough for every 5 nm from 400 to 1000 nm.
pub const MAX_TERMS: usize = 128;

/// First row of the second curves in the texture of points.
pub(crate) const SECOND_ROW: u32 = 3;
/// First row of the curves by which layers act on each other.
pub(crate) const COUPLING_ROW: u32 = 6;

/// A term that adds nothing to a sum.
const NO_TERM: ExponentialTerm = ExponentialTerm { rate: [0.0; 3], weight: [0.0; 3] };

/// The words of a uniform buffer, written in the order of a WGSL struct's members.
#[derive(Debug, Default)]
pub(crate) struct UniformWords {
    words: Vec<u32>,
    /// Name and byte offset of each member, those of structs within it after their own.
    #[cfg(test)]
    members: Vec<(&'static str, usize)>,
}

impl UniformWords {
    /// Begins the member of that name in the WGSL struct.
    #[cfg(test)]
    fn member(&mut self, name: &'static str) -> &mut Self {
        self.members.push((name, 4 * self.words.len()));
        self
    }

    /// Begins the member of that name in the WGSL struct.
    #[cfg(not(test))]
    fn member(&mut self, _: &'static str) -> &mut Self {
        self
    }

    fn float(&mut self, v: f32) {
        self.words.push(v.to_bits());
    }

    fn int(&mut self, v: usize) {
        self.words.push(u32::try_from(v).unwrap_or(u32::MAX));
    }

    fn flag(&mut self, on: bool) {
        self.words.push(u32::from(on));
    }

    fn floats(&mut self, v: impl IntoIterator<Item = f32>) {
        self.words.extend(v.into_iter().map(f32::to_bits));
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
        self.member("scale").floats(scale);
        self.member("last").float(last as f32);
        self.member("offset").floats(offset);
        self.member("row").row(row);
        Ok(())
    }

    fn expose(&mut self, expose: &Expose, develop: &Develop) {
        self.member("input").rows(&expose.input);
        self.member("exposure").rows(&expose.matrix);
        let coupling = develop.coupling.as_ref();
        self.member("coupling_matrix").rows(coupling.map_or(&[[0.0; 3]; 3], |coupling| &coupling.matrix));
    }

    fn develop(&mut self, develop: &Develop) -> Result<(), Error> {
        // A look without coupled layers holds the curves' own numbers here, which nobody reads.
        let coupling = develop.coupling.as_ref().map_or(&develop.curves, |coupling| &coupling.curves);
        self.member("coupling").curves(coupling, COUPLING_ROW)?;
        self.member("curves").curves(&develop.curves, 0)
    }

    fn flags(&mut self, expose: &Expose, develop: &Develop) {
        self.member("converts").flag(expose.input != IDENTITY);
        self.member("compresses").flag(expose.negative == NegativeLight::Compress);
        self.member("couples").flag(develop.coupling.is_some());
    }

    fn row(&mut self, row: u32) {
        self.words.push(row);
    }

    fn coding(&mut self, coding: &PowerCoding) {
        // Linear light is a foot without end.
        let linear = coding.standard() == CodingStandard::Linear;
        self.member("inverse_exponent").float((1.0 / coding.exponent()) as f32);
        self.member("offset").float(coding.offset() as f32);
        self.member("slope").float(coding.slope() as f32);
        self.member("end").float(if linear { f32::MAX } else { coding.end() as f32 });
    }

    /// A sum in groups of four terms, and weights of 0 after its last.
    fn terms(&mut self, terms: &[ExponentialTerm]) {
        const RATES: [&str; 3] = ["rate_red", "rate_green", "rate_blue"];
        const WEIGHTS: [&str; 3] = ["weight_red", "weight_green", "weight_blue"];
        for first in (0..MAX_TERMS).step_by(4) {
            let group: [ExponentialTerm; 4] = std::array::from_fn(|i| terms.get(first + i).copied().unwrap_or(NO_TERM));
            (0..3).for_each(|c| self.member(RATES[c]).floats(group.map(|term| term.rate[c])));
            (0..3).for_each(|c| self.member(WEIGHTS[c]).floats(group.map(|term| term.weight[c])));
        }
    }

    /// Fills up 16 bytes: what arrays begin on, and what uniform buffers come in.
    fn pad(&mut self) {
        self.words.resize(self.words.len().next_multiple_of(4), 0);
    }

    /// The names and byte offsets of what was written.
    #[cfg(test)]
    pub(crate) fn members(&self) -> &[(&'static str, usize)] {
        &self.members
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.words.iter().flat_map(|word| word.to_ne_bytes()).collect()
    }
}

pub(crate) fn plain(lut: &PlainLut, target: TargetCoding) -> Result<UniformWords, Error> {
    let mut words = UniformWords::default();
    let ShaperKind::Log2Offset { offset, max: brightest } = lut.shaper().kind() else {
        return Err(ErrorKind::Shaper.into());
    };
    let per_stop = std::f64::consts::LN_2 / (brightest / offset).ln_1p();
    words.member("brightest").float(brightest as f32);
    words.member("per_offset").float((1.0 / offset) as f32);
    words.member("per_stop").float(per_stop as f32);
    words.member("last").float((lut.table().size() - 1) as f32);
    words.member("trilinear").flag(lut.interpolation() == Interpolation::Trilinear);
    words.member("coded").flag(target == TargetCoding::Srgb);
    words.pad();
    Ok(words)
}

pub(crate) fn structured(lut: &StructuredLut, target: TargetCoding) -> Result<UniformWords, Error> {
    let parts = lut.parts();
    let mut words = UniformWords::default();
    words.expose(&parts.expose, &parts.develop);
    words.member("mix_matrix").rows(parts.mix.as_ref().map_or(&[[0.0; 3]; 3], |mix| &mix.matrix));
    let (decode, coding, coded) = match &parts.decode {
        Decode::Coded => (&[[0.0; 3]; 3], PowerCoding::LINEAR, target == TargetCoding::Srgb),
        Decode::Density { matrix, coding } => {
            let (coding, coded) = coding_in_shader(coding, target);
            (matrix, coding, coded)
        }
    };
    words.member("decode").rows(decode);
    words.member("mix_offset").floats(parts.mix.as_ref().map_or([0.0; 3], |mix| mix.offset));
    words.member("last").float((parts.table.size() - 1) as f32);
    words.develop(&parts.develop)?;
    let mix_curves = parts.mix.as_ref().map_or(&parts.develop.curves, |Mix { curves, .. }| curves);
    words.member("mix_curves").curves(mix_curves, SECOND_ROW)?;
    words.member("coding").coding(&coding);
    words.member("mixes").flag(parts.mix.is_some());
    words.member("densities").flag(matches!(parts.decode, Decode::Density { .. }));
    words.member("trilinear").flag(parts.interpolation == Interpolation::Trilinear);
    words.member("coded").flag(coded);
    words.flags(&parts.expose, &parts.develop);
    words.pad();
    Ok(words)
}

pub(crate) fn direct(form: &DirectForm, target: TargetCoding) -> Result<UniformWords, Error> {
    let parts = form.parts();
    let print = parts.print.as_ref().map_or(&[][..], |print| print.exposure.terms());
    let projection = parts.projection.terms();
    let found = print.len().max(projection.len());
    if found > MAX_TERMS {
        return Err(ErrorKind::Terms { found, max: MAX_TERMS }.into());
    }
    let (coding, coded) = coding_in_shader(&parts.coding, target);
    let mut words = UniformWords::default();
    words.expose(&parts.expose, &parts.develop);
    words.develop(&parts.develop)?;
    let print_curves = parts.print.as_ref().map_or(&parts.develop.curves, |DirectPrint { curves, .. }| curves);
    words.member("print_curves").curves(print_curves, SECOND_ROW)?;
    words.member("coding").coding(&coding);
    words.member("print_count").int(print.len());
    words.member("projection_count").int(projection.len());
    words.member("coded").flag(coded);
    words.flags(&parts.expose, &parts.develop);
    words.pad();
    words.member("print").terms(print);
    words.member("projection").terms(projection);
    Ok(words)
}

/// The coding that a shader does, and whether what it yields is still to be decoded: a target that encodes wants linear light.
fn coding_in_shader(coding: &PowerCoding, target: TargetCoding) -> (PowerCoding, bool) {
    match (target, coding.standard()) {
        (TargetCoding::Stored, _) => (*coding, false),
        (TargetCoding::Srgb, CodingStandard::Linear | CodingStandard::Srgb) => (PowerCoding::LINEAR, false),
        (TargetCoding::Srgb, CodingStandard::Other) => (*coding, true),
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
        Some(&found) => Err(ErrorKind::NotFinite { what, found }.into()),
        None => Ok(()),
    }
}
