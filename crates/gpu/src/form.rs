use std::fmt;

use onelight_lut::{DirectForm, Lut3d, PlainLut, StructuredLut};

/// A compiled look in one of its forms, borrowed to be uploaded.
///
/// ```
/// use onelight_gpu::{Form, FormKind};
/// use onelight_lut::{Interpolation, Lut3d, PlainLut, Shaper};
///
/// let lut = PlainLut::new(Shaper::log2(0.02, 11.52)?, Lut3d::identity(17)?, Interpolation::Tetrahedral);
/// assert_eq!(Form::from(&lut).kind(), FormKind::Plain);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Form<'a> {
    /// A shaper before a 3D table.
    Plain(&'a PlainLut),
    /// Matrices and curves before a 3D table.
    Structured(&'a StructuredLut),
    /// No table: curves and sums of exponentials for each pixel.
    Direct(&'a DirectForm),
}

/// Which of the three forms a look has. Shaders and resources depend on it, so a look can be uploaded only over one of the same
/// form.
///
/// ```
/// use onelight_gpu::FormKind;
///
/// assert_eq!(FormKind::Structured.to_string(), "structured");
/// assert_eq!(FormKind::ALL.map(FormKind::uniform_bytes), [32, 400, 6432]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormKind {
    /// The form of a [`PlainLut`].
    Plain,
    /// The form of a [`StructuredLut`].
    Structured,
    /// The form of a [`DirectForm`].
    Direct,
}

impl FormKind {
    /// Every form, the cheapest to evaluate first.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Structured, Self::Direct];

    /// Bytes of the form's uniform buffer: the WGSL struct's size, rounded up to 16.
    pub const fn uniform_bytes(self) -> usize {
        match self {
            Self::Plain => 32,
            Self::Structured => 400,
            Self::Direct => 6432,
        }
    }
}

impl<'a> Form<'a> {
    /// Which of the three forms it is.
    pub fn kind(&self) -> FormKind {
        match self {
            Self::Plain(_) => FormKind::Plain,
            Self::Structured(_) => FormKind::Structured,
            Self::Direct(_) => FormKind::Direct,
        }
    }

    /// Its 3D table, which a direct form has not.
    pub(crate) fn table(self) -> Option<&'a Lut3d> {
        match self {
            Self::Plain(lut) => Some(lut.table()),
            Self::Structured(lut) => Some(&lut.parts().table),
            Self::Direct(_) => None,
        }
    }
}

impl<'a> From<&'a PlainLut> for Form<'a> {
    fn from(lut: &'a PlainLut) -> Self {
        Self::Plain(lut)
    }
}

impl<'a> From<&'a StructuredLut> for Form<'a> {
    fn from(lut: &'a StructuredLut) -> Self {
        Self::Structured(lut)
    }
}

impl<'a> From<&'a DirectForm> for Form<'a> {
    fn from(form: &'a DirectForm) -> Self {
        Self::Direct(form)
    }
}

impl fmt::Display for FormKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Plain => "plain",
            Self::Structured => "structured",
            Self::Direct => "direct",
        })
    }
}
