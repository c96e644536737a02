use std::error::Error;

use onelight::{DirectSettings, Nodes, Reference, StructuredSettings};
use onelight_benches::{PLAIN_SIZE, shaper};
use onelight_lut::{
    DirectForm, Interpolation, Lut3d, PixelMap, Pixels, PixelsMut, PlainLut, Sample, StructuredLut, bake,
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

    pub(crate) fn structured(film: &Reference) -> Result<Self, Box<dyn Error>> {
        Ok(Self::Structured(film.structured(&StructuredSettings::default())?))
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

/// The grid of wavelengths for baking: within 0.02 dE of the film.
const GRID_NM: usize = 5;

/// How the nodes of a plain table are computed.
#[derive(Clone, Copy)]
pub(crate) enum Way {
    Reference,
    /// Through a direct form whose making takes no time.
    Direct,
}

impl Way {
    pub(crate) fn parse(word: &str) -> Result<Self, Box<dyn Error>> {
        match word {
            "reference" => Ok(Self::Reference),
            "direct" => Ok(Self::Direct),
            _ => Err(format!("found {word}, expected reference or direct").into()),
        }
    }

    /// A plain table; making the direct form is part of what that way costs.
    pub(crate) fn bake(self, film: &Reference, size: usize) -> Result<Lut3d, Box<dyn Error>> {
        let shaper = shaper()?;
        Ok(match self {
            Self::Reference => bake(size, &shaper, |rgb| film.develop(rgb), |_| {}),
            Self::Direct => {
                let direct = film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: GRID_NM } })?;
                bake(size, &shaper, |rgb| direct.apply(rgb.map(|v| v as f32)).map(f64::from), |_| {})
            }
        }?)
    }
}
