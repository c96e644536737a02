use std::error::Error;

use onelight::film::InterImage;
use onelight::{DirectSettings, FilmProcess, InterImageChoice, Reference, StructuredSettings, TableCoding};
use onelight_benches::{Form, NEGATIVE, PLAIN_SIZE, shaper};
use onelight_lut::{DirectForm, Interpolation, Lut3d, PlainLut, bake, bake_form};

/// From the entries of a table that was baked before.
pub(crate) fn plain(entries: Vec<[f32; 3]>) -> Result<Form, Box<dyn Error>> {
    Ok(Form::Plain(PlainLut::new(shaper()?, Lut3d::new(PLAIN_SIZE, entries)?, Interpolation::Tetrahedral)))
}

/// The usual structured form, its entries in a coding.
pub(crate) fn structured(film: &Reference, coding: TableCoding) -> Result<Form, Box<dyn Error>> {
    let settings = StructuredSettings { coding, ..StructuredSettings::default() };
    Ok(Form::Structured(Box::new(film.structured(&settings)?)))
}

/// The usual direct form.
pub(crate) fn direct(film: &Reference) -> Result<Form, Box<dyn Error>> {
    Ok(Form::Direct(Box::new(film.direct(&DirectSettings::default())?)))
}

/// The film that all of this is made of, its layers acting each for itself.
pub(crate) fn uncoupled_film() -> Result<Reference, Box<dyn Error>> {
    let inter_image = InterImageChoice::Fixed(InterImage::NONE);
    Ok(FilmProcess { inter_image, ..FilmProcess::for_camera(NEGATIVE)? }.compile()?)
}

/// How the nodes of a plain table are computed.
pub(crate) enum BakeMethod {
    /// Each by the exact film.
    Reference,
    /// As `Reference::bake` does it, which makes a direct form first.
    Usual,
    /// Through that form, made before.
    Form(Box<DirectForm>),
}

impl BakeMethod {
    pub(crate) fn parse(word: &str, film: &Reference) -> Result<Self, Box<dyn Error>> {
        match word {
            "reference" => Ok(Self::Reference),
            "usual" => Ok(Self::Usual),
            "form" => Ok(Self::Form(Box::new(film.direct(&DirectSettings::BAKING)?))),
            _ => Err(format!("found {word}, expected reference, usual or form").into()),
        }
    }

    /// Bakes a plain table of `size` nodes a side.
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
