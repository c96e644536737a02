use fearless_simd::Level;

use super::sample::Sample;
use super::samples::{Samples, SamplesMut};
use super::transfer::{read, write};
use super::view::{Channels, Layout};
use crate::kernel::block::{BLOCK, Block, BlockMap};

/// Pixels per task: long enough to hide the cost of handing one out, short enough to share among threads.
const TASK: usize = 64 * BLOCK;

/// A picture cut into pieces that tasks take: rows, or parts of them.
#[derive(Clone, Copy)]
struct Cut {
    channels: Channels,
    /// Samples from one piece to the next, and those of them that are pixels.
    stride: usize,
    samples: usize,
    pieces: usize,
}

impl Cut {
    /// Where rows of both pictures follow each other they count as one, cut anew.
    fn new(layout: Layout, joined: bool) -> Self {
        let Layout { channels, width, height, stride } = layout;
        let samples = TASK * channels.count();
        if joined {
            return Self { channels, stride: samples, samples, pieces: (width * height).div_ceil(TASK) };
        }
        Self { channels, stride: stride.max(1), samples: layout.row_samples(), pieces: height }
    }

    /// Pieces that come to a task's worth of pixels.
    fn pieces_per_task(self) -> usize {
        (TASK * self.channels.count()).div_ceil(self.samples.max(1))
    }

    /// Samples of a whole block.
    fn block(self) -> usize {
        BLOCK * self.channels.count()
    }
}

/// One picture to another of the same size.
pub(super) fn map<S: Sample, T: Sample>(
    form: &dyn BlockMap,
    level: Level,
    (from, here): (&[S], Layout),
    (to, there): (&mut [T], Layout),
) {
    map_samples(form, level, (S::samples(from), here), (T::samples_mut(to), there));
}

/// A picture in place: each block is read before it is written.
pub(super) fn map_in_place<S: Sample>(form: &dyn BlockMap, level: Level, samples: &mut [S], layout: Layout) {
    map_samples_in_place(form, level, S::samples_mut(samples), layout);
}

fn map_samples(
    form: &dyn BlockMap,
    level: Level,
    (from, here): (Samples<'_>, Layout),
    (to, there): (SamplesMut<'_>, Layout),
) {
    let joined = here.is_dense() && there.is_dense();
    let run = Run { form, level, from: Some(Cut::new(here, joined)), to: Cut::new(there, joined) };
    let (from, to) = (from.split_at(here.samples()).0, to.split_at(there.samples()).0);
    run.map_pieces(Some(from), to, run.to.pieces);
}

fn map_samples_in_place(form: &dyn BlockMap, level: Level, samples: SamplesMut<'_>, layout: Layout) {
    let run = Run { form, level, from: None, to: Cut::new(layout, layout.is_dense()) };
    run.map_pieces(None, samples.split_at(layout.samples()).0, run.to.pieces);
}

/// A form on its way through a picture.
struct Run<'a> {
    form: &'a dyn BlockMap,
    level: Level,
    /// How the picture to read is cut; none where pixels are mapped in place.
    from: Option<Cut>,
    to: Cut,
}

impl Run<'_> {
    /// So many pieces, half by half on the threads of the current pool.
    fn map_pieces(&self, from: Option<Samples<'_>>, to: SamplesMut<'_>, pieces: usize) {
        let per_task = self.from.unwrap_or(self.to).pieces_per_task();
        let half = pieces / 2;
        if half >= per_task {
            let (to_near, to_far) = to.split_at(half * self.to.stride);
            let (from_near, from_far) = self.split_from(from, |cut| half * cut.stride);
            rayon::join(
                || self.map_pieces(from_near, to_near, half),
                || self.map_pieces(from_far, to_far, pieces - half),
            );
            return;
        }
        let block = &mut Block::new();
        let (mut from, mut to) = (from, to);
        for _ in 0..pieces {
            let (piece, rest) = to.split_at(self.to.stride);
            let (from_piece, from_rest) = self.split_from(from, |cut| cut.stride);
            self.map_piece(block, from_piece, piece);
            (from, to) = (from_rest, rest);
        }
    }

    /// The pixels of one piece: the last may be shorter.
    fn map_piece(&self, block: &mut Block, from: Option<Samples<'_>>, to: SamplesMut<'_>) {
        let mut from = self.split_from(from, |cut| cut.samples).0;
        let mut to = to.split_at(self.to.samples).0;
        while to.len() > 0 {
            let (pixels, rest) = to.split_at(self.to.block());
            let (from_pixels, from_rest) = self.split_from(from, Cut::block);
            match (from_pixels, self.from) {
                (Some(pixels), Some(cut)) => read(self.level, pixels, cut.channels, block),
                _ => read(self.level, pixels.as_samples(), self.to.channels, block),
            }
            self.finish(block, pixels);
            (from, to) = (from_rest, rest);
        }
    }

    fn split_from<'s>(
        &self,
        from: Option<Samples<'s>>,
        count: impl Fn(Cut) -> usize,
    ) -> (Option<Samples<'s>>, Option<Samples<'s>>) {
        from.zip(self.from).map(|(from, cut)| from.split_at(count(cut))).unzip()
    }

    /// What the form makes of the block, to its place.
    fn finish(&self, block: &mut Block, to: SamplesMut<'_>) {
        let Self { form, level, to: Cut { channels, .. }, .. } = *self;
        match (to, channels) {
            (SamplesMut::F32(to), Channels::Rgba) => form.map_block_to(level, block, to.as_chunks_mut().0),
            (to, _) => {
                form.map_block(level, block, to.len() / channels.count());
                write(level, block, to, channels);
            }
        }
    }
}
