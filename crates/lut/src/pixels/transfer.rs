//! Samples to planes and back.

use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::raw::Raw;
use super::sample::LaneSample;
use super::samples::{Samples, SamplesMut};
use super::view::Channels;
use crate::kernel::block::{BLOCK, Block, Plane};
use crate::kernel::dispatch::dispatch;

/// The most lanes that a level has.
const LANES: usize = 16;

/// Reads up to [`BLOCK`] pixels; where there is no alpha it is 1.
pub(super) fn read(level: Level, from: Samples<'_>, channels: Channels, block: &mut Block) {
    match from {
        Samples::F32(from) => read_from(level, from, channels, block),
        Samples::F16(from) => read_from(level, from, channels, block),
        Samples::U16(from) => read_from(level, from, channels, block),
        Samples::U8(from) => read_from(level, from, channels, block),
    }
}

/// Writes up to [`BLOCK`] pixels.
pub(super) fn write(level: Level, block: &Block, to: SamplesMut<'_>, channels: Channels) {
    match to {
        SamplesMut::F32(to) => write_to(level, block, to, channels),
        SamplesMut::F16(to) => write_to(level, block, to, channels),
        SamplesMut::U16(to) => write_to(level, block, to, channels),
        SamplesMut::U8(to) => write_to(level, block, to, channels),
    }
}

fn read_from<S: LaneSample>(level: Level, from: &[S], channels: Channels, block: &mut Block) {
    let from = S::as_raw(from);
    dispatch!(level, simd => match channels {
        Channels::Rgb => read_rgb::<_, S>(simd, from.as_chunks().0, block),
        Channels::Rgba => read_rgba::<_, S>(simd, from.as_chunks().0, block),
    });
}

fn write_to<T: LaneSample>(level: Level, block: &Block, to: &mut [T], channels: Channels) {
    let to = T::as_raw_mut(to);
    dispatch!(level, simd => match channels {
        Channels::Rgb => write_rgb::<_, T>(simd, block, to.as_chunks_mut().0),
        Channels::Rgba => write_rgba::<_, T>(simd, block, to.as_chunks_mut().0),
    });
}

#[inline(always)]
fn read_rgba<L: Simd, S: LaneSample>(simd: L, from: &[[S::Raw; 4]], block: &mut Block) {
    let len = L::u32s::LEN;
    let mut groups = from.chunks_exact(len);
    let mut i = 0;
    for group in &mut groups {
        read_group::<L, S>(simd, group, block, i);
        i += len;
    }
    let rest = groups.remainder();
    if !rest.is_empty() {
        let mut padded = [[S::Raw::default(); 4]; LANES];
        padded[..rest.len()].copy_from_slice(rest);
        read_group::<L, S>(simd, &padded[..len], block, i);
    }
}

#[inline(always)]
fn read_group<L: Simd, S: LaneSample>(simd: L, group: &[[S::Raw; 4]], block: &mut Block, i: usize) {
    let (Block { rgb: [red, green, blue], alpha, .. }, end) = (block, i + L::u32s::LEN);
    let [r, g, b, a] = S::Raw::deinterleave(simd, group);
    S::values(simd, r).store_slice(&mut red[i..end]);
    S::values(simd, g).store_slice(&mut green[i..end]);
    S::values(simd, b).store_slice(&mut blue[i..end]);
    S::values(simd, a).store_slice(&mut alpha[i..end]);
}

#[inline(always)]
fn write_rgba<L: Simd, T: LaneSample>(simd: L, block: &Block, to: &mut [[T::Raw; 4]]) {
    let len = L::u32s::LEN;
    let mut groups = to.chunks_exact_mut(len);
    let mut i = 0;
    for group in &mut groups {
        write_group::<L, T>(simd, block, i, group);
        i += len;
    }
    let rest = groups.into_remainder();
    if !rest.is_empty() {
        let mut padded = [[T::Raw::default(); 4]; LANES];
        write_group::<L, T>(simd, block, i, &mut padded[..len]);
        rest.copy_from_slice(&padded[..rest.len()]);
    }
}

#[inline(always)]
fn write_group<L: Simd, T: LaneSample>(simd: L, block: &Block, i: usize, group: &mut [[T::Raw; 4]]) {
    let (Block { rgb: [red, green, blue], alpha, .. }, end) = (block, i + L::u32s::LEN);
    let red = T::codes(simd, L::f32s::from_slice(simd, &red[i..end]));
    let green = T::codes(simd, L::f32s::from_slice(simd, &green[i..end]));
    let blue = T::codes(simd, L::f32s::from_slice(simd, &blue[i..end]));
    let alpha = T::alphas(simd, L::f32s::from_slice(simd, &alpha[i..end]));
    T::Raw::interleave::<L>([red, green, blue, alpha], group);
}

/// Three to a pixel is nothing for vectors: samples one by one, the rest together.
#[inline(always)]
fn read_rgb<L: Simd, S: LaneSample>(simd: L, from: &[[S::Raw; 3]], block: &mut Block) {
    let mut bits = [[0; BLOCK]; 3];
    match from.first_chunk::<BLOCK>() {
        // A whole block has its length known to the compiler.
        Some(from) => deinterleave_rgb(from, &mut bits),
        None => deinterleave_rgb(from, &mut bits),
    }
    for (plane, bits) in block.rgb.iter_mut().zip(&bits) {
        for i in (0..from.len()).step_by(L::u32s::LEN) {
            let end = i + L::u32s::LEN;
            S::values(simd, L::u32s::from_slice(simd, &bits[i..end])).store_slice(&mut plane[i..end]);
        }
    }
    block.alpha = [1.0; BLOCK];
}

#[inline(always)]
fn deinterleave_rgb<R: Raw>(from: &[[R; 3]], [red, green, blue]: &mut [Plane<u32>; 3]) {
    for (pixel, ((red, green), blue)) in from.iter().zip(red.iter_mut().zip(green).zip(blue)) {
        *red = pixel[0].to_bits();
        *green = pixel[1].to_bits();
        *blue = pixel[2].to_bits();
    }
}

#[inline(always)]
fn write_rgb<L: Simd, T: LaneSample>(simd: L, block: &Block, to: &mut [[T::Raw; 3]]) {
    let mut bits = [[0; BLOCK]; 3];
    for (plane, bits) in block.rgb.iter().zip(&mut bits) {
        for i in (0..to.len()).step_by(L::u32s::LEN) {
            let end = i + L::u32s::LEN;
            T::codes(simd, L::f32s::from_slice(simd, &plane[i..end])).store_slice(&mut bits[i..end]);
        }
    }
    match to.first_chunk_mut::<BLOCK>() {
        Some(to) => interleave_rgb(&bits, to),
        None => interleave_rgb(&bits, to),
    }
}

#[inline(always)]
fn interleave_rgb<R: Raw>([red, green, blue]: &[Plane<u32>; 3], to: &mut [[R; 3]]) {
    for (pixel, ((red, green), blue)) in to.iter_mut().zip(red.iter().zip(green).zip(blue)) {
        *pixel = [R::from_bits(*red), R::from_bits(*green), R::from_bits(*blue)];
    }
}
