use std::fmt;

/// What went wrong in this crate: one sentence that says what, where, what was found and what was expected.
///
/// ```
/// use onelight_spectra::Kelvin;
/// let error = Kelvin::new(0.0).unwrap_err();
/// assert_eq!(error.to_string(), "colour temperature: found 0 K, expected 500 K to 100000 K");
/// assert!(error.is_value());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Error(ErrorKind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ErrorKind {
    Shape { first_nm: u16, last_nm: u16, step_nm: u16 },
    Length { quantity: &'static str, found: usize, expected: usize },
    Value { quantity: &'static str, nm: f64, found: f64, expected: &'static str },
    Nodes { problem: String },
    Table { source: &'static str, line: usize, problem: String },
    Chromaticity { what: &'static str, x: f64, y: f64 },
    Temperature { found: f64 },
    SceneWhite { kelvin: f64, tint: f64 },
    Basis { problem: String },
}

impl Error {
    /// Whether a number lay outside what its quantity allows: a negative power, a temperature of 0 K, a white with y = 0.
    #[must_use]
    pub fn is_value(&self) -> bool {
        matches!(
            self.0,
            ErrorKind::Value { .. }
                | ErrorKind::Chromaticity { .. }
                | ErrorKind::Temperature { .. }
                | ErrorKind::SceneWhite { .. }
        )
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(kind)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            ErrorKind::Shape { first_nm, last_nm, step_nm } => write!(
                f,
                "spectral shape {first_nm}..{last_nm} nm by {step_nm}: expected first < last and a step that divides the range"
            ),
            ErrorKind::Length { quantity, found, expected } => {
                write!(f, "{quantity}: {found} values, expected one per wavelength: {expected}")
            }
            ErrorKind::Value { quantity, nm, found, expected } => {
                write!(f, "{quantity} at {nm} nm: found {found}, expected {expected}")
            }
            ErrorKind::Nodes { problem } => write!(f, "interpolation nodes: {problem}"),
            ErrorKind::Table { source, line, problem } => write!(f, "{source}:{line}: {problem}"),
            ErrorKind::Chromaticity { what, x, y } => {
                write!(
                    f,
                    "{what}: found xy ({x}, {y}), expected a white with y > 0 and three primaries that span a triangle, all finite"
                )
            }
            ErrorKind::Temperature { found } => {
                write!(f, "colour temperature: found {found} K, expected 500 K to 100000 K")
            }
            ErrorKind::SceneWhite { kelvin, tint } => write!(
                f,
                "scene white: found {kelvin} K with a tint of {tint}, expected 1667 to 25000 K and a tint from -100 to 100, less for low temperatures"
            ),
            ErrorKind::Basis { problem } => write!(f, "reconstruction basis: {problem}"),
        }
    }
}

impl std::error::Error for Error {}
