use std::fmt;

/// Why a picture cannot be drawn, as one sentence.
///
/// ```
/// # use onelight_charts::{Tile, contact_sheet};
/// // Sheets that no PNG holds are refused and not drawn in part.
/// let huge = Tile { captions: Default::default(), width: 1, height: u32::MAX / 2, picture: Ok(Vec::new()) };
/// assert!(contact_sheet("huge", 1, &[huge]).unwrap_err().to_string().starts_with("a sheet of "));
/// ```
#[derive(Debug)]
pub struct Error(pub(crate) String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}
