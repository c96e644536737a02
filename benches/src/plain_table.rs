use onelight::baked::{BakedForm, Form, Recipe, ShaperChoice};
use onelight::lut::{PlainLut, Storage};
use onelight::{Entries, Look};

use crate::error::{Error, Result};

/// How a plain table is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlainTable {
    pub(crate) size: usize,
    pub(crate) shaper: PlainShaper,
    pub(crate) entries: Entries,
}

#[derive(Debug, Clone, Copy)]
pub(crate) enum PlainShaper {
    /// That of \[Gotanda2010\].
    Gotanda,
    /// Fitted to the look, to a range that ends there or is fitted too.
    Fitted { stops: Option<f64> },
}

impl PlainTable {
    /// The plain form of a look as `onelight::baked` makes it, tetrahedral, entries in 32-bit floats: the forms that are measured
    /// are those that are shipped.
    pub(crate) fn bake(&self, look: &Look) -> Result<PlainLut> {
        let (shaper, stops) = match self.shaper {
            PlainShaper::Gotanda => (ShaperChoice::Gotanda, None),
            PlainShaper::Fitted { stops } => (ShaperChoice::Log2, stops),
        };
        let recipe = Recipe {
            size: self.size,
            shaper,
            stops,
            entries: self.entries,
            storage: Storage::F32,
            ..Recipe::of(Form::Plain)
        };
        match look.baked(&recipe)?.form() {
            BakedForm::Plain(lut) => Ok(lut.clone()),
            _ => Err(Error::new("a plain table with a shaper was baked to another form")),
        }
    }
}
