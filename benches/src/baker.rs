use onelight::lut::{Interpolation, Law, Lut3d, PlainLut, Shaper};
use onelight::{Entries, Look, Process};
use serde::Serialize;

use crate::error::Result;
use crate::form::Form;

/// What the program that bakes looks lends to those who measure it: its fit of the plain form, and its certificates.
///
/// So the forms that are measured are those that are shipped.
pub trait Baker: Sync {
    /// The shaper that the plain form of a look gets; `stops` says where its range ends, in stops about mid grey, `None` fits that
    /// too.
    ///
    /// # Errors
    /// As [`Look::bake`].
    fn shaper(&self, look: &Look, stops: Option<f64>) -> Result<Shaper>;

    /// A plain table moved towards the look between its nodes.
    ///
    /// # Errors
    /// As [`Look::develop`]'s forms: if a result is not finite.
    fn fit(&self, look: &Look, shaper: &Shaper, table: &Lut3d) -> Result<Lut3d>;

    /// How far each form lies from the look of a process over the colours that `law` draws; `step` is called after the colours are
    /// developed and after each form.
    ///
    /// # Errors
    /// If the law or the look's spaces are impossible.
    fn certify(
        &self,
        process: &Process,
        look: &Look,
        law: &Law,
        forms: &[&Form],
        step: &dyn Fn(),
    ) -> Result<Vec<Difference>>;
}

/// CIEDE2000 of a form from its look.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Difference {
    /// Mean over all colours drawn.
    pub mean: f64,
    /// The mean of the worst of five bands of four stops.
    pub worst_band: f64,
    /// Exceeded by one colour in a hundred.
    pub p99: f64,
    /// The largest found, followed uphill.
    pub max: f64,
    /// The mean over the bands up to +6 stops.
    pub mean_to_six: f64,
    /// The largest of those bands, not followed uphill.
    pub max_to_six: f64,
}

/// How a plain table is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlainTable {
    pub(crate) size: usize,
    pub(crate) shaper: PlainShaper,
    pub(crate) entries: Entries,
}

#[derive(Debug, Clone, Copy)]
pub(crate) enum PlainShaper {
    /// log2(u + 0.191406), 0 to 4, as \[Gotanda2010\] has it.
    Gotanda,
    /// Fitted to the look, to a range that ends there or is fitted too.
    Fitted { stops: Option<f64> },
}

impl PlainTable {
    /// The plain form of a look, tetrahedral, entries in 32-bit floats.
    pub(crate) fn bake(&self, look: &Look, baker: &dyn Baker) -> Result<PlainLut> {
        let shaper = match self.shaper {
            PlainShaper::Gotanda => Shaper::gotanda(),
            PlainShaper::Fitted { stops } => baker.shaper(look, stops)?,
        };
        let table = look.bake(self.size, |t| t.map(|t| shaper.decode(t)))?;
        let table = match self.entries {
            Entries::Sampled => table,
            Entries::Fitted => baker.fit(look, &shaper, &table)?,
        };
        Ok(PlainLut::new(shaper, table, Interpolation::Tetrahedral))
    }
}
