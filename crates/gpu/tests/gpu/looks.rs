//! Real looks in all forms: a negative with its print, and a reversal film.

use std::sync::OnceLock;

use onelight::{Entries, Process, Reference, StructuredSettings};
use onelight_gpu::Form;
use onelight_lut::{
    Decode, DirectForm, Interpolation, Lut3d, PlainLut, SceneSampler, Shaper, Storage, StructuredLut, StructuredParts,
    bake,
};

pub(crate) struct LookForms {
    pub(crate) name: &'static str,
    pub(crate) plain: PlainLut,
    pub(crate) structured: StructuredLut,
    pub(crate) direct: DirectForm,
}

/// Nodes a side: few, so that the steps between them are large.
pub(crate) const SIZE: usize = 17;

pub(crate) fn looks() -> &'static [LookForms; 2] {
    static LOOKS: OnceLock<[LookForms; 2]> = OnceLock::new();
    LOOKS.get_or_init(|| {
        [look("kodak-5207", Interpolation::Tetrahedral), look("fuji-velvia-50", Interpolation::Trilinear)]
    })
}

fn look(name: &'static str, interpolation: Interpolation) -> LookForms {
    let film: Reference = Process::for_camera(name).unwrap().compile().unwrap();
    let shaper = Shaper::log2(0.02, 11.52).unwrap();
    let table = bake(SIZE, &shaper, |rgb| film.develop(rgb), |_| {}).unwrap();
    let settings = StructuredSettings { size: SIZE, entries: Entries::Sampled, interpolation, ..Default::default() };
    LookForms {
        name,
        plain: PlainLut::new(shaper, table, interpolation),
        structured: film.structured(&settings).unwrap(),
        direct: film.direct(&Default::default()).unwrap(),
    }
}

impl LookForms {
    pub(crate) fn forms(&self) -> [Form<'_>; 3] {
        [(&self.plain).into(), (&self.structured).into(), (&self.direct).into()]
    }

    /// The look as its table reads in a texture of that storage.
    pub(crate) fn stored(&self, storage: Storage) -> Self {
        let stored = |table: &Lut3d| storage.stored(table).unwrap();
        Self {
            name: self.name,
            plain: PlainLut::new(*self.plain.shaper(), stored(self.plain.table()), self.plain.interpolation()),
            structured: self.structured.with_table(stored(&self.structured.parts().table)),
            direct: self.direct.clone(),
        }
    }
}

/// The structured look with display-coded entries.
pub(crate) fn coded(look: &LookForms) -> StructuredLut {
    let lut = &look.structured;
    let entries = lut.parts().table.entries().map(|entry| lut.decode(entry)).collect();
    let table = Lut3d::new(SIZE, entries).unwrap();
    StructuredLut::new(StructuredParts { table, decode: Decode::Coded, ..lut.parts().clone() }).unwrap()
}

pub(crate) fn apply(form: Form<'_>, linear: [f32; 3]) -> [f32; 3] {
    match form {
        Form::Plain(lut) => lut.apply(linear),
        Form::Structured(lut) => lut.apply(linear),
        Form::Direct(form) => form.apply(linear),
    }
}

/// Ten stops up and down, any saturation, alpha from 0 to 1.
pub(crate) fn colours(count: usize) -> Vec<[f32; 4]> {
    let sampler = SceneSampler::new(-10.0..=10.0).unwrap().take(count).enumerate();
    sampler.map(|(i, [r, g, b])| [r as f32, g as f32, b as f32, (i % 11) as f32 / 10.0]).collect()
}
