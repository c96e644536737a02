use half::f16;
use onelight_lut::{Lut1d, Lut3d, Storage};

use crate::error::{Error, Kind};
use crate::form::{Form, FormKind};
use crate::uniform::{self, After};

/// The most points that a form's curves may have.
pub const MAX_POINTS: usize = 2048;

/// A look's numbers as the shader text of [`wgsl`](crate::wgsl) reads them, byte by byte: for an engine with another version of
/// wgpu, or none. [`BoundLook`](crate::BoundLook) uploads the same.
///
/// Words are in the byte order of this machine, which is that of its graphics cards.
#[derive(Clone, Debug, PartialEq)]
pub struct LookBytes {
    /// Which form it is.
    pub kind: FormKind,
    /// Binding 0, a uniform buffer: the words of `onelight_look`.
    pub uniform: Vec<u8>,
    /// Binding 1, a 3D texture.
    pub table: Option<TableBytes>,
    /// Binding 2, a 2D texture of `Rg32Float`, [`MAX_POINTS`] wide and [`CURVE_ROWS`] high: what is to be written into it.
    pub curves: Vec<CurveBytes>,
}

/// Rows of the texture of points: three for the first curves, three for the second.
pub const CURVE_ROWS: u32 = 6;

/// Texels of a table, red fastest, four channels each.
#[derive(Clone, Debug, PartialEq)]
pub struct TableBytes {
    /// Nodes a side.
    pub size: usize,
    /// Half floats (`Rgba16Float`) or 32-bit floats (`Rgba32Float`).
    pub storage: Storage,
    /// `size`^3 texels.
    pub bytes: Vec<u8>,
}

/// Three rows of points, red, green, blue; a point is its value and the rise to the next, 32-bit floats.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveBytes {
    /// The first of the rows.
    pub row: u32,
    /// Points of a row.
    pub points: usize,
    /// Row by row.
    pub bytes: Vec<u8>,
}

impl LookBytes {
    /// The numbers of a form, its table in half floats or 32-bit floats.
    ///
    /// # Errors
    /// If the storage of a table is neither [`Storage::F16`] nor [`Storage::F32`] or an entry does not fit it; if a curve has more
    /// than [`MAX_POINTS`] points, a sum more than [`MAX_TERMS`](crate::MAX_TERMS) terms, or steps of a curve leave the range
    /// of 32-bit floats.
    pub fn new<'a>(form: impl Into<Form<'a>>, storage: Storage) -> Result<Self, Error> {
        Self::before(form.into(), storage, After::Stored)
    }

    /// The same for a target that may encode.
    pub(crate) fn before(form: Form<'_>, storage: Storage, after: After) -> Result<Self, Error> {
        let words = match form {
            Form::Plain(lut) => uniform::plain(lut, after),
            Form::Structured(lut) => uniform::structured(lut, after),
            Form::Direct(form) => uniform::direct(form, after),
        };
        let table = table(form).map(|table| TableBytes::new(table, storage)).transpose()?;
        let curves = curves(form).into_iter().flatten().map(|(row, curves)| CurveBytes::new(row, curves));
        Ok(Self { kind: form.kind(), uniform: words?.bytes(), table, curves: curves.collect::<Result<_, _>>()? })
    }
}

impl TableBytes {
    fn new(table: &Lut3d, storage: Storage) -> Result<Self, Error> {
        let texels = table.entries().flat_map(|[r, g, b]| [r, g, b, 1.0]);
        let bytes = match storage {
            Storage::F32 => texels.flat_map(f32::to_ne_bytes).collect(),
            Storage::F16 => match table.entries().flatten().find(|v| f16::from_f32(*v).is_infinite()) {
                Some(found) => return Err(Kind::Half { found }.into()),
                None => texels.flat_map(|v| f16::from_f32(v).to_ne_bytes()).collect(),
            },
            found => return Err(Kind::Storage { found }.into()),
        };
        Ok(Self { size: table.size(), storage, bytes })
    }
}

impl CurveBytes {
    fn new(row: u32, curves: &Lut1d) -> Result<Self, Error> {
        match curves.size() {
            found if found > MAX_POINTS => Err(Kind::Points { found, max: MAX_POINTS }.into()),
            points => Ok(Self { row, points, bytes: uniform::points(curves)? }),
        }
    }
}

fn table(form: Form<'_>) -> Option<&Lut3d> {
    match form {
        Form::Plain(lut) => Some(lut.table()),
        Form::Structured(lut) => Some(&lut.parts().table),
        Form::Direct(_) => None,
    }
}

/// The curves of a form with the first of their rows.
fn curves(form: Form<'_>) -> [Option<(u32, &Lut1d)>; 2] {
    let (first, second) = match form {
        Form::Plain(_) => return [None; 2],
        Form::Structured(lut) => (&lut.parts().curves, lut.parts().mix.as_ref().map(|mix| &mix.curves)),
        Form::Direct(form) => (&form.parts().curves, form.parts().print.as_ref().map(|print| &print.curves)),
    };
    [Some((0, first)), second.map(|second| (uniform::SECOND_ROW, second))]
}
