use half::f16;
use onelight_lut::{Lut1d, Lut3d, Storage};

use crate::error::{Error, ErrorKind};
use crate::form::{Form, FormKind};
use crate::target::TargetCoding;
use crate::uniform;

/// The most points that a form's curves may have.
pub const MAX_POINTS: usize = 2048;

/// A look's numbers as the shader text of [`wgsl`](crate::wgsl) reads them, byte by byte: for an engine with another version of
/// wgpu, or none. [`BoundLook`](crate::BoundLook) uploads the same.
///
/// Words are in the byte order of this machine, which is that of its graphics cards.
///
/// ```
/// use onelight_gpu::{FormKind, LookBytes};
/// use onelight_lut::{Interpolation, Lut3d, PlainLut, Shaper, Storage};
///
/// let lut = PlainLut::new(Shaper::log2(0.02, 11.52)?, Lut3d::identity(17)?, Interpolation::Tetrahedral);
/// let look = LookBytes::new(&lut, Storage::F16)?;
/// assert_eq!(look.uniform.len(), FormKind::Plain.uniform_bytes());
/// // Four half floats a texel; a plain form has no curves.
/// assert_eq!(look.table.map(|table| table.bytes.len()), Some(17 * 17 * 17 * 8));
/// assert!(look.curves.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LookBytes {
    /// Which of the three forms the look has, and so which shader text reads it.
    pub kind: FormKind,
    /// The first binding, a uniform buffer of [`FormKind::uniform_bytes`]: the words of `onelight_look`.
    pub uniform: Vec<u8>,
    /// The second binding, a 3D texture; a direct form has none.
    pub table: Option<TableBytes>,
    /// The third binding, a 2D texture of `Rg32Float`, [`MAX_POINTS`] wide and [`CURVE_ROWS`] high: what is to be written into it.
    pub curves: Vec<CurveBytes>,
}

/// Rows of the texture of points: three for the first curves, three for the second, three for what couples layers.
pub const CURVE_ROWS: u32 = 9;

/// The texels of a 3D table, red fastest, four channels each.
///
/// ```
/// # use onelight_lut::{Interpolation, Lut3d, PlainLut, Shaper, Storage};
/// # let lut = PlainLut::new(Shaper::log2(0.02, 11.52)?, Lut3d::identity(17)?, Interpolation::Tetrahedral);
/// let table = onelight_gpu::LookBytes::new(&lut, Storage::F32)?.table.ok_or("a plain form has a table")?;
/// assert_eq!((table.size, table.storage), (17, Storage::F32));
/// assert_eq!(table.bytes.len(), 17 * 17 * 17 * 16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TableBytes {
    /// Nodes a side, 2 or more.
    pub size: usize,
    /// Half floats (`Rgba16Float`) or 32-bit floats (`Rgba32Float`).
    pub storage: Storage,
    /// `size`^3 texels of 8 or 16 bytes, without gaps.
    pub bytes: Vec<u8>,
}

/// Three rows of points, red, green, blue; a point is its value and the rise to the next, 32-bit floats.
///
/// ```
/// let form = onelight::Process::for_camera("fuji-velvia-50")?.compile()?.direct(&Default::default())?;
/// let look = onelight_gpu::LookBytes::new(&form, onelight_lut::Storage::F16)?;
/// // A reversal film is shown as it is; a negative has a print's curves after its own, from row 3 on. From row 6 on lies what
/// // its layers do to each other.
/// let rows: Vec<_> = look.curves.iter().map(|curves| curves.row).collect();
/// assert_eq!(rows, [0, 6]);
/// assert_eq!(look.curves[0].bytes.len(), 3 * 8 * look.curves[0].points);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CurveBytes {
    /// The row of the texture at which the red curve goes; green and blue follow.
    pub row: u32,
    /// Points of each curve, from 2 to [`MAX_POINTS`].
    pub points: usize,
    /// 8 bytes a point, row by row, without gaps.
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
        Self::for_target(form.into(), storage, TargetCoding::Stored)
    }

    /// [`LookBytes::new`] for a target that may encode what is stored in it.
    pub(crate) fn for_target(form: Form<'_>, storage: Storage, target: TargetCoding) -> Result<Self, Error> {
        let words = match form {
            Form::Plain(lut) => uniform::plain(lut, target),
            Form::Structured(lut) => uniform::structured(lut, target),
            Form::Direct(form) => uniform::direct(form, target),
        };
        let table = form.table().map(|table| TableBytes::new(table, storage)).transpose()?;
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
                Some(found) => return Err(ErrorKind::HalfFloat { found }.into()),
                None => texels.flat_map(|v| f16::from_f32(v).to_ne_bytes()).collect(),
            },
            found => return Err(ErrorKind::Storage { found }.into()),
        };
        Ok(Self { size: table.size(), storage, bytes })
    }
}

impl CurveBytes {
    fn new(row: u32, curves: &Lut1d) -> Result<Self, Error> {
        match curves.size() {
            found if found > MAX_POINTS => Err(ErrorKind::Points { found, max: MAX_POINTS }.into()),
            points => Ok(Self { row, points, bytes: uniform::points(curves)? }),
        }
    }
}

/// The curves of a form with the first of their rows.
fn curves(form: Form<'_>) -> [Option<(u32, &Lut1d)>; 3] {
    let (first, second) = match form {
        Form::Plain(_) => return [None; 3],
        Form::Structured(lut) => (&lut.parts().develop, lut.parts().mix.as_ref().map(|mix| &mix.curves)),
        Form::Direct(form) => (&form.parts().develop, form.parts().print.as_ref().map(|print| &print.curves)),
    };
    let coupling = first.coupling.as_ref().map(|coupling| (uniform::COUPLING_ROW, &coupling.curves));
    [Some((0, &first.curves)), second.map(|second| (uniform::SECOND_ROW, second)), coupling]
}
