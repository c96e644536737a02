use std::error::Error;

use onelight::{DirectSettings, Reference, StructuredSettings, TableCoding};
use onelight_benches::{PLAIN_SIZE, shaper};
use onelight_lut::{
    DirectForm, Interpolation, Lut3d, PixelMap, Pixels, PixelsMut, PlainLut, Sample, StructuredLut, bake, bake_form,
};

/// One of the forms.
pub(crate) enum Form {
    Plain(PlainLut),
    Structured(StructuredLut),
    Direct(DirectForm),
}

impl Form {
    /// From the entries of a table that was baked before.
    pub(crate) fn plain(entries: Vec<[f32; 3]>) -> Result<Self, Box<dyn Error>> {
        Ok(Self::Plain(PlainLut::new(shaper()?, Lut3d::new(PLAIN_SIZE, entries)?, Interpolation::Tetrahedral)))
    }

    pub(crate) fn structured(film: &Reference, coding: TableCoding) -> Result<Self, Box<dyn Error>> {
        Ok(Self::Structured(film.structured(&StructuredSettings { coding, ..StructuredSettings::default() })?))
    }

    pub(crate) fn direct(film: &Reference) -> Result<Self, Box<dyn Error>> {
        Ok(Self::Direct(film.direct(&DirectSettings::default())?))
    }

    /// A whole picture.
    pub(crate) fn map<T: Sample>(
        &self,
        from: &Pixels<'_, f32>,
        to: &mut PixelsMut<'_, T>,
    ) -> Result<(), Box<dyn Error>> {
        Ok(match self {
            Self::Plain(form) => form.map(from, to),
            Self::Structured(form) => form.map(from, to),
            Self::Direct(form) => form.map(from, to),
        }?)
    }
}

/// How the nodes of a plain table are computed.
pub(crate) enum Way {
    /// Each by the exact film.
    Reference,
    /// As `Reference::bake` does it, which makes a direct form first.
    Usual,
    /// Through that form, made before.
    Form(Box<DirectForm>),
}

impl Way {
    pub(crate) fn parse(word: &str, film: &Reference) -> Result<Self, Box<dyn Error>> {
        match word {
            "reference" => Ok(Self::Reference),
            "usual" => Ok(Self::Usual),
            "form" => Ok(Self::Form(Box::new(film.direct(&DirectSettings::BAKING)?))),
            _ => Err(format!("found {word}, expected reference, usual or form").into()),
        }
    }

    /// A plain table.
    pub(crate) fn bake(&self, film: &Reference, size: usize) -> Result<Lut3d, Box<dyn Error>> {
        let shaper = shaper()?;
        let at = |coordinates: [f64; 3]| coordinates.map(|t| shaper.decode(t));
        Ok(match self {
            Self::Reference => bake(size, &shaper, |rgb| film.develop(rgb), |_| {})?,
            Self::Usual => film.bake(size, at)?,
            Self::Form(form) => bake_form(size, at, form.as_ref())?,
        })
    }
}
