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

/// Moves a picture through `develop` into `sink`; memory is that of three bands.
///
/// # Errors
/// What reading says, as [`NotOfThisFile`], and what writing says.
pub(super) fn pass(
    picture: &mut PictureReader<'_>,
    mut develop: impl FnMut(&mut Band) + Send,
    sink: &mut dyn BandSink,
) -> Result<Busy> {
    let mut busy = Busy::default();
    let [mut coming, mut here, mut going] = <[Band; 3]>::default();
    let mut read =
        |band: &mut Band| picture.next_into(band).map_err(|error| anyhow::Error::new(NotOfThisFile(error.into())));
    timed(&mut busy.reading, || read(&mut here))?;
    loop {
        let last = here.rows() == 0;
        let Busy { reading, developing, writing } = &mut busy;
        let ((was_read, ()), written) = rayon::join(
            || {
                rayon::join(
                    || if last { Ok(()) } else { timed(reading, || read(&mut coming)) },
                    || {
                        if !last {
                            timed(developing, || develop(&mut here));
                        }
                    },
                )
            },
            || if going.rows() == 0 { Ok(()) } else { timed(writing, || sink.write(going.view())) },
        );
        was_read?;
        written?;
        if last {
            return Ok(busy);
        }
        std::mem::swap(&mut going, &mut here);
        std::mem::swap(&mut here, &mut coming);
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
