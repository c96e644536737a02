use onelight::Look;
use onelight::baked::{BakedForm, Recipe};
use onelight_lut::{DirectForm, Lut3d, PixelMap, Pixels, PixelsMut, PlainLut, Sample, SimdLevel, StructuredLut};

use crate::error::{Error, Result};

/// One look in one of the forms that take scene-linear light.
#[derive(Clone, Debug)]
pub enum Form {
    /// A shaper and one table.
    Plain(PlainLut),
    /// The film's own curves as axes of a table.
    Structured(Box<StructuredLut>),
    /// The film's curves and a few exponentials, no table.
    Direct(Box<DirectForm>),
}

impl Form {
    /// The form of a look that `bake` writes for a recipe.
    pub(crate) fn baked(look: &Look, recipe: &Recipe) -> Result<Self> {
        match look.baked(recipe)?.form() {
            BakedForm::Plain(lut) => Ok(Self::Plain(lut.clone())),
            BakedForm::Structured(lut) => Ok(Self::Structured(lut.clone())),
            BakedForm::Direct(form) => Ok(Self::Direct(form.clone())),
            BakedForm::Coded { .. } => {
                Err(Error::new("a table that takes coded light is not among the forms measured"))
            }
        }
    }

    /// Scene-linear RGB of the look's input space to display-coded RGB.
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Plain(lut) => lut.apply(linear),
            Self::Structured(lut) => lut.apply(linear),
            Self::Direct(form) => form.apply(linear),
        }
    }

    /// A picture of the same size in both, on the threads of the current pool.
    ///
    /// # Errors
    /// If the sizes differ.
    pub fn map<T: Sample>(
        &self,
        from: &Pixels<'_, f32>,
        to: &mut PixelsMut<'_, T>,
    ) -> std::result::Result<(), onelight_lut::Error> {
        self.map_on(SimdLevel::best(), from, to)
    }

    /// The same as [`Form::map`], by the instructions of one level.
    ///
    /// # Errors
    /// If the sizes differ.
    pub fn map_on<T: Sample>(
        &self,
        level: SimdLevel,
        from: &Pixels<'_, f32>,
        to: &mut PixelsMut<'_, T>,
    ) -> std::result::Result<(), onelight_lut::Error> {
        match self {
            Self::Plain(lut) => lut.map_on(level, from, to),
            Self::Structured(lut) => lut.map_on(level, from, to),
            Self::Direct(form) => form.map_on(level, from, to),
        }
    }

    /// Its table; the direct form has none.
    pub fn table(&self) -> Option<&Lut3d> {
        match self {
            Self::Plain(lut) => Some(lut.table()),
            Self::Structured(lut) => Some(&lut.parts().table),
            Self::Direct(_) => None,
        }
    }

    /// The same form with another table; the direct form as it is.
    pub(crate) fn with_table(&self, table: Lut3d) -> Self {
        match self {
            Self::Plain(lut) => Self::Plain(PlainLut::new(*lut.shaper(), table, lut.interpolation())),
            Self::Structured(lut) => Self::Structured(Box::new(lut.with_table(table))),
            Self::Direct(form) => Self::Direct(form.clone()),
        }
    }

    /// The brightest scene value that the form tells from brighter ones; `None` where there is no end.
    pub(crate) fn end(&self) -> Option<f64> {
        match self {
            Self::Plain(lut) => Some(lut.shaper().max()),
            Self::Structured(_) | Self::Direct(_) => None,
        }
    }

    /// `plain`, `structured` or `direct`
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::Plain(_) => "plain",
            Self::Structured(_) => "structured",
            Self::Direct(_) => "direct",
        }
    }
}
