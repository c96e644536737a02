//! Three bands on their way at once: one is read, one developed, one written.

use std::time::{Duration, Instant};

use anyhow::Result;
use onelight_picture::{Band, BandSink, PictureReader};

use crate::atomic_file::NotOfThisFile;

/// How long each step was at work. Steps run beside each other, so that their sum is more than what passed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Busy {
    pub(crate) reading: Duration,
    pub(crate) developing: Duration,
    pub(crate) writing: Duration,
}

/// Moves a picture through `develop` into `sink`. `develop` is given bands from top to bottom and adds those that it is done with to the
/// ones that are to be written, in the same order, all of them once it has the last. Memory is that of three bands and those that
/// `develop` keeps.
///
/// # Errors
/// What reading says, as [`NotOfThisFile`], what `develop` says, and what writing says.
pub(super) fn pass(
    picture: &mut PictureReader<'_>,
    mut develop: impl FnMut(Band, &mut Vec<Band>) -> Result<()> + Send,
    sink: &mut dyn BandSink,
) -> Result<Busy> {
    let mut busy = Busy::default();
    let (mut going, mut spare): (Vec<Band>, Vec<Band>) = (Vec::new(), Vec::new());
    let mut read =
        |band: &mut Band| picture.next_into(band).map_err(|error| anyhow::Error::new(NotOfThisFile(error.into())));
    let mut here = Band::default();
    timed(&mut busy.reading, || read(&mut here))?;
    loop {
        let last = here.rows() == 0;
        let Busy { reading, developing, writing } = &mut busy;
        let (mut coming, mut done) = (spare.pop().unwrap_or_default(), Vec::new());
        let ((was_read, developed), written) = rayon::join(
            || {
                rayon::join(
                    || if last { Ok(()) } else { timed(reading, || read(&mut coming)) },
                    || if last { Ok(()) } else { timed(developing, || develop(here, &mut done)) },
                )
            },
            || timed(writing, || going.iter().try_for_each(|band| sink.write(band.view()))),
        );
        was_read?;
        developed?;
        written?;
        if last {
            return Ok(busy);
        }
        spare.append(&mut going);
        (going, here) = (done, coming);
    }
}

/// Shows every band of a picture to `look`, while the next one is read.
///
/// # Errors
/// What reading a band reports, in one sentence.
pub(super) fn look_through(picture: &mut PictureReader<'_>, mut look: impl FnMut(&mut Band) + Send) -> Result<()> {
    let [mut coming, mut here] = <[Band; 2]>::default();
    picture.next_into(&mut here)?;
    while here.rows() > 0 {
        let (was_read, ()) = rayon::join(|| picture.next_into(&mut coming), || look(&mut here));
        was_read?;
        std::mem::swap(&mut here, &mut coming);
    }
    Ok(())
}

fn timed<T>(sum: &mut Duration, run: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let value = run();
    *sum += start.elapsed();
    value
}
