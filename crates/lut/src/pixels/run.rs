use rayon::prelude::*;

use super::sample::Sample;
use super::transfer::{read, write};
use super::view::{Channels, Layout};
use crate::kernel::{BLOCK, Block, BlockMap, Level};

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

    /// The pixels of a piece: the last may be shorter.
    fn pixels<S>(self, piece: &[S]) -> &[S] {
        &piece[..self.samples.min(piece.len())]
    }

    fn pixels_mut<S>(self, piece: &mut [S]) -> &mut [S] {
        let len = self.samples.min(piece.len());
        &mut piece[..len]
    }

    /// Pieces for a task.
    fn together(self) -> usize {
        (TASK * self.channels.count()).div_ceil(self.samples.max(1))
    }
}

/// One picture to another of the same size.
pub(super) fn map<S: Sample, T: Sample>(
    form: &dyn BlockMap,
    level: Level,
    (from, here): (&[S], Layout),
    (to, there): (&mut [T], Layout),
) {
    let joined = here.is_dense() && there.is_dense();
    let (from, to) = (&from[..here.samples()], &mut to[..there.samples()]);
    let (here, there) = (Cut::new(here, joined), Cut::new(there, joined));
    let each = |block: &mut Block, (to, from): (&mut [T], &[S])| {
        let [from_step, to_step] = [here.channels, there.channels].map(|channels| BLOCK * channels.count());
        let blocks = there.pixels_mut(to).chunks_mut(to_step).zip(here.pixels(from).chunks(from_step));
        for (to, from) in blocks {
            read(level, from, here.channels, block);
            finish(form, level, block, to, there.channels);
        }
    };
    if here.pieces <= here.together() {
        let block = &mut Block::new();
        let pieces = to.chunks_mut(there.stride).zip(from.chunks(here.stride)).take(here.pieces);
        return pieces.for_each(|piece| each(block, piece));
    }
    let pieces = to.par_chunks_mut(there.stride).zip(from.par_chunks(here.stride)).take(here.pieces);
    pieces.with_min_len(here.together()).for_each_init(Block::new, each);
}

/// A picture in place.
pub(super) fn map_in_place<S: Sample>(form: &dyn BlockMap, level: Level, samples: &mut [S], layout: Layout) {
    let cut = Cut::new(layout, layout.is_dense());
    let samples = &mut samples[..layout.samples()];
    let each = |block: &mut Block, piece: &mut [S]| {
        for pixels in cut.pixels_mut(piece).chunks_mut(BLOCK * cut.channels.count()) {
            read(level, pixels, cut.channels, block);
            finish(form, level, block, pixels, cut.channels);
        }
    };
    if cut.pieces <= cut.together() {
        let block = &mut Block::new();
        return samples.chunks_mut(cut.stride).take(cut.pieces).for_each(|piece| each(block, piece));
    }
    let pieces = samples.par_chunks_mut(cut.stride).take(cut.pieces);
    pieces.with_min_len(cut.together()).for_each_init(Block::new, each);
}

/// Colours in place.
pub(crate) fn map_colours(form: &dyn BlockMap, pixels: &mut [[f32; 3]]) {
    let (width, samples) = (pixels.len(), pixels.as_flattened_mut());
    let layout = Layout { channels: Channels::Rgb, width, height: 1, stride: samples.len() };
    map_in_place(form, Level::new(), samples, layout);
}

/// What a form makes of the block, to its place.
fn finish<T: Sample>(form: &dyn BlockMap, level: Level, block: &mut Block, to: &mut [T], channels: Channels) {
    let count = to.len() / channels.count();
    match channels {
        Channels::Rgba => match T::as_pixels(to) {
            Some(pixels) => form.map_block_to(level, block, pixels),
            None => {
                form.map_block(level, block, count);
                write(level, block, to, channels);
            }
        },
        Channels::Rgb => {
            form.map_block(level, block, count);
            write(level, block, to, channels);
        }
    }
}

#[cfg(test)]
mod tests;
