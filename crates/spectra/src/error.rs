use std::fmt;

/// What went wrong in this crate: one sentence that says what, where, what was found and what was expected.
#[derive(Debug, Clone, PartialEq)]
pub struct Error(Kind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    Shape { first_nm: u16, last_nm: u16, step_nm: u16 },
    Length { quantity: &'static str, found: usize, expected: usize },
    Value { quantity: &'static str, nm: f64, found: f64, expected: &'static str },
    Nodes { problem: String },
    Table { source: String, line: u64, problem: String },
    Chromaticity { what: &'static str, x: f64, y: f64 },
    Temperature { found: f64 },
    Basis { problem: String },
}

impl Error {
    /// Whether the error lies in a text table, at a line the message names.
    #[must_use]
    pub fn is_table(&self) -> bool {
        matches!(self.0, Kind::Table { .. })
    }

    /// Whether a value lay outside what its quantity allows.
    #[must_use]
    pub fn is_value(&self) -> bool {
        matches!(self.0, Kind::Value { .. } | Kind::Chromaticity { .. } | Kind::Temperature { .. })
    }
}

impl From<Kind> for Error {
    fn from(kind: Kind) -> Self {
        Self(kind)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Shape { first_nm, last_nm, step_nm } => write!(
                f,
                "spectral shape {first_nm}..{last_nm} nm by {step_nm}: expected first < last and a step that divides the range"
            ),
            Kind::Length { quantity, found, expected } => {
                write!(f, "{quantity}: {found} values, expected one per wavelength: {expected}")
            }
            Kind::Value { quantity, nm, found, expected } => {
                write!(f, "{quantity} at {nm} nm: found {found}, expected {expected}")
            }
            Kind::Nodes { problem } => write!(f, "interpolation nodes: {problem}"),
            Kind::Table { source, line, problem } => write!(f, "{source}:{line}: {problem}"),
            Kind::Chromaticity { what, x, y } => {
                write!(
                    f,
                    "{what}: found xy ({x}, {y}), expected finite values with y > 0 and three primaries that span a triangle"
                )
            }
            Kind::Temperature { found } => {
                write!(f, "colour temperature: found {found} K, expected 500 K to 100000 K")
            }
            Kind::Basis { problem } => write!(f, "reconstruction basis: {problem}"),
        }
    }
}

impl std::error::Error for Error {}
