use std::fmt;

use onelight_lut::{DirectForm, PlainLut, StructuredLut};

/// A compiled look in one of its forms.
#[derive(Clone, Copy, Debug)]
pub enum Form<'a> {
    /// A shaper and a table.
    Plain(&'a PlainLut),
    /// Matrices and curves before a table.
    Structured(&'a StructuredLut),
    /// No table: the whole film for each pixel.
    Direct(&'a DirectForm),
}

/// Which form it is: what decides over shaders and resources.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormKind {
    /// [`PlainLut`].
    Plain,
    /// [`StructuredLut`].
    Structured,
    /// [`DirectForm`].
    Direct,
}

impl FormKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Structured, Self::Direct];
}

impl Form<'_> {
    /// Which form it is.
    pub fn kind(&self) -> FormKind {
        match self {
            Self::Plain(_) => FormKind::Plain,
            Self::Structured(_) => FormKind::Structured,
            Self::Direct(_) => FormKind::Direct,
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
