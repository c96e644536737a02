//! Pictures that are written from top to bottom.

use crate::{
    band::BandView,
    error::{Error, WriteProblem},
};

/// A picture that is written from top to bottom: what [`write_exr`](crate::write_exr) and [`write_png`](crate::write_png)
/// hand to the function that gives them the bands.
///
/// ```
/// use onelight_picture::{BandSink, BandView, Error};
///
/// /// Writes 16 rows at a time of one colour.
/// fn fill(sink: &mut dyn BandSink, width: usize, height: usize, colour: [f32; 3]) -> Result<(), Error> {
///     let rgb = vec![colour; 16 * width];
///     for top in (0..height).step_by(16) {
///         let rows = 16.min(height - top);
///         sink.write(BandView { top, width, rgb: &rgb[..rows * width], alpha: None })?;
///     }
///     Ok(())
/// }
/// # use onelight_picture::{Channels, Description, Source, write_exr};
/// # let picture = Description::new(5, 40, Channels::Rgb, Source::Exr);
/// # write_exr(std::io::Cursor::new(Vec::new()), &picture, &[], |sink| fill(sink, 5, 40, [0.18; 3]))?;
/// # Ok::<(), Error>(())
/// ```
pub trait BandSink: Send {
    /// Takes the next rows: the first of the picture, or those that follow what came before.
    ///
    /// # Errors
    /// If they are not the next ones, not as wide as the picture, or more than it has; if there is coverage for a picture
    /// without, or none for one with; or if writing fails.
    fn write(&mut self, band: BandView<'_>) -> Result<(), Error>;
}

/// Gives the bands of a picture to a sink; whether it gave them all.
pub(crate) type Fill<'a> = &'a mut dyn FnMut(&mut dyn BandSink) -> bool;

/// Runs `write` with a [`Fill`] that calls `fill` once: what `fill` returns, if the file is whole too. An error of `fill`
/// comes before what `write` makes of it.
pub(crate) fn filled_by<T, E: From<Error>>(
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T, E>,
    write: impl FnOnce(Fill<'_>) -> Result<(), Error>,
) -> Result<T, E> {
    let (mut fill, mut outcome) = (Some(fill), None);
    let written = write(&mut |sink| {
        outcome = fill.take().map(|fill| fill(sink));
        matches!(outcome, Some(Ok(_)))
    });
    match (outcome, written) {
        (Some(Err(error)), _) => Err(error),
        (_, Err(error)) => Err(error.into()),
        (Some(Ok(value)), Ok(())) => Ok(value),
        (None, Ok(())) => Err(Error::from(WriteProblem::NotFilled).into()),
    }
}
