use onelight::spectra::MID_GREY;
use onelight::{DirectSettings, Error, Process, Reference, StructuredSettings};
use onelight_lut::{DirectForm, Interpolation, PlainLut, Shaper, StructuredLut, bake};

/// Camera film of the negative that is measured; it is printed on Kodak 2383.
pub const NEGATIVE: &str = "kodak-5207";
/// Camera film of the slide that is measured.
pub const REVERSAL: &str = "fuji-velvia-50";
/// Both, with what they are.
pub const PROCESSES: [(&str, &str); 2] = [("negative", NEGATIVE), ("reversal", REVERSAL)];

/// Nodes along each side of the plain table: the size most programs write.
pub const PLAIN_SIZE: usize = 33;

/// Where the plain table's shaper turns from linear to logarithmic, and where it ends: six stops over mid grey.
pub const SHAPER: [f64; 2] = [0.02, MID_GREY * 64.0];

/// The exact film of a camera film's usual process: negatives on Kodak 2383, reversal film as it is.
///
/// # Errors
/// If the camera film is unknown.
pub fn film(camera: &str) -> Result<Reference, Error> {
    Process::for_camera(camera)?.compile()
}

/// The shaper of the plain table, [`SHAPER`].
///
/// # Errors
/// None: its numbers are in range.
pub fn shaper() -> Result<Shaper, Error> {
    Ok(Shaper::log2(SHAPER[0], SHAPER[1])?)
}

/// The plain form, [`PLAIN_SIZE`] a side, each node by the exact film.
///
/// # Errors
/// If the film's result at a node is not finite; that of a built-in film is.
pub fn plain(film: &Reference) -> Result<PlainLut, Error> {
    let shaper = shaper()?;
    let table = bake(PLAIN_SIZE, &shaper, |rgb| film.develop(rgb), |_| {})?;
    Ok(PlainLut::new(shaper, table, Interpolation::Tetrahedral))
}

/// One look in its fast forms, each with its usual settings.
#[derive(Clone, Debug)]
pub struct Forms {
    /// A table of 33 nodes a side, tetrahedral, every node by the exact film.
    pub plain: PlainLut,
    /// A table of 32 nodes a side, entries fitted to the film.
    pub structured: StructuredLut,
    /// The usual exponentials, no table.
    pub direct: DirectForm,
}

impl Forms {
    /// The forms of a film.
    ///
    /// # Errors
    /// If a form's numbers are not finite; those of a built-in film are.
    pub fn new(film: &Reference) -> Result<Self, Error> {
        Ok(Self {
            plain: plain(film)?,
            structured: film.structured(&StructuredSettings::default())?,
            direct: film.direct(&DirectSettings::default())?,
        })
    }
}
