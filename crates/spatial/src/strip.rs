//! One tile of a strip of rows through the effects on exposure, and one through those on amounts.

use fearless_simd::{Level, dispatch};

use crate::blur::{LANES, across_rows, along_row, copy_padded, lanes};
use crate::cells::{CellRows, Expansion};
use crate::grain::noise::{correlate_row, correlate_rows, field_sigma, white_row};
use crate::grain::{Grain, NoiseKey};
use crate::halation::HaloField;
use crate::planes::{Planes, believed};
use crate::sharpness::{Adjacency, AdjacencyBlur, Scatter};

/// Columns of a tile: rows of a strip and what is worked out for them stay in the second cache.
pub(crate) const TILE: usize = 512;

/// Columns of the picture and rows of it that are worked on together.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tile {
    pub(crate) x: usize,
    pub(crate) width: usize,
    pub(crate) y: usize,
    pub(crate) rows: usize,
    /// Rows of the whole picture.
    pub(crate) height: usize,
}

impl Tile {
    /// The rows from `margin` before the tile to `margin` after it, edge rows repeated.
    fn rows_with(&self, margin: usize) -> impl Iterator<Item = usize> + '_ {
        let of = move |i: usize| (self.y + i).saturating_sub(margin).min(self.height - 1);
        (0..self.rows + 2 * margin).map(of)
    }
}

/// Room for the rows of a tile, kept between tiles.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    padded: Vec<f32>,
    narrow: Vec<f32>,
    wide: Vec<f32>,
    halo: [Vec<f32>; 2],
    white: [Vec<i32>; 3],
    field: [Vec<i32>; 3],
    noise: Vec<i32>,
}

/// Room for so many numbers; what is in it does not matter.
fn room<T: Clone + Default>(vec: &mut Vec<T>, len: usize) -> &mut [T] {
    if vec.len() < len {
        vec.resize(len, T::default());
    }
    &mut vec[..len]
}

/// The exposure of a layer after scatter and halation; `out` is the tile's part of each row of the strip.
pub(crate) fn expose_layer(
    level: Level,
    (exposures, layer): (&Planes, usize),
    tile: Tile,
    scatter: Option<&Scatter>,
    halo: Option<&HaloField>,
    scratch: &mut Scratch,
    out: &mut [&mut [f32]],
) {
    match scatter {
        Some(scatter) => dispatch!(level, _simd => scatter_tile((exposures, layer), tile, scatter, scratch, out)),
        None => {
            for (y, out) in tile.rows_with(0).zip(out.iter_mut()) {
                copy_clean(exposures.layer_row(layer, y), tile.x as isize, out);
            }
        }
    }
    let Some((halo, pull)) = halo.and_then(|halo| Some((halo, halo.pull(layer)?))) else { return };
    let [field, lower] = &mut scratch.halo;
    let (field, lower) = (room(field, tile.width), room(lower, tile.width));
    for (y, out) in tile.rows_with(0).zip(out) {
        halo.row(layer, y, tile.x, field, lower);
        for (e, field) in out.iter_mut().zip(field.iter()) {
            *e += pull * (field - *e);
        }
    }
}

#[inline(always)]
fn copy_clean(row: &[f32], start: isize, out: &mut [f32]) {
    copy_padded(row, start, out);
    for e in out {
        *e = believed(*e);
    }
}

#[inline(always)]
fn scatter_tile(
    (exposures, layer): (&Planes, usize),
    tile: Tile,
    scatter: &Scatter,
    scratch: &mut Scratch,
    out: &mut [&mut [f32]],
) {
    let ([narrow_x, narrow_y], [wide_x, wide_y]) = (&scatter.narrow, &scatter.wide);
    let (margin, width) = (scatter.rows(), tile.width);
    let radius = narrow_x.len().max(wide_x.len());
    let padded = room(&mut scratch.padded, width + 2 * radius);
    let narrow = room(&mut scratch.narrow, width * (tile.rows + 2 * margin));
    let wide = room(&mut scratch.wide, width * (tile.rows + 2 * margin));
    let rows = narrow.chunks_exact_mut(width).zip(wide.chunks_exact_mut(width));
    for (y, (narrow, wide)) in tile.rows_with(margin).zip(rows) {
        copy_clean(exposures.layer_row(layer, y), tile.x as isize - radius as isize, padded);
        along_row(narrow_x, &padded[radius - narrow_x.len()..], narrow);
        along_row(wide_x, &padded[radius - wide_x.len()..], wide);
    }
    let share = scatter.narrow_share;
    for (y, out) in out.iter_mut().enumerate() {
        let row = |plane, distance: isize| row_of(plane, width, (y + margin) as isize + distance);
        let (narrow, wide) = (|d| row(&*narrow, d), |d| row(&*wide, d));
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let (start, len) = (block * LANES, out.len());
            let narrow_sum = across_rows(narrow_y, narrow, start, len);
            let wide_sum = across_rows(wide_y, wide, start, len);
            let (narrow, wide) = (lanes(&narrow(0)[start..], len), lanes(&wide(0)[start..], len));
            for i in 0..len {
                let (narrow, wide) = (narrow[i] + narrow_sum[i], wide[i] + wide_sum[i]);
                out[i] = wide + share * (narrow - wide);
            }
        }
    }
}

#[inline(always)]
fn row_of<T>(plane: &[T], width: usize, y: isize) -> &[T] {
    &plane[y as usize * width..][..width]
}

/// The amounts of a layer after adjacency; `cells` are its blurred means, where it is blurred in cells.
pub(crate) fn adjacency_layer(
    level: Level,
    (amounts, layer): (&Planes, usize),
    tile: Tile,
    adjacency: Option<&Adjacency>,
    cells: Option<&(CellRows, Expansion)>,
    scratch: &mut Scratch,
    out: &mut [&mut [f32]],
) {
    match (adjacency, cells) {
        (Some(Adjacency { strength, blur: AdjacencyBlur::Pixels(taps) }), _) => {
            dispatch!(level, _simd => adjacency_tile((amounts, layer), tile, *strength, taps, scratch, out));
        }
        (Some(Adjacency { strength, blur: AdjacencyBlur::Cells(axes, _) }), Some((cells, expansion))) => {
            let [upper, lower] = &mut scratch.halo;
            let (upper, lower) = (room(upper, tile.width), room(lower, tile.width));
            let mut held = None;
            for (y, out) in tile.rows_with(0).zip(out) {
                let (above, below, t) = axes[1].between(y);
                if held != Some((above, below)) {
                    expansion.expand(cells.row(above as isize), tile.x, upper);
                    expansion.expand(cells.row(below as isize), tile.x, lower);
                    held = Some((above, below));
                }
                let own = &amounts.layer_row(layer, y)[tile.x..];
                for (((out, own), upper), lower) in out.iter_mut().zip(own).zip(upper.iter()).zip(lower.iter()) {
                    let blurred = upper + t * (lower - upper);
                    *out = (own + strength * (own - blurred)).max(0.0);
                }
            }
        }
        _ => {
            for (y, out) in tile.rows_with(0).zip(out) {
                out.copy_from_slice(&amounts.layer_row(layer, y)[tile.x..][..tile.width]);
            }
        }
    }
}

#[inline(always)]
fn adjacency_tile(
    (amounts, layer): (&Planes, usize),
    tile: Tile,
    strength: f32,
    [x, y]: &[Vec<f32>; 2],
    scratch: &mut Scratch,
    out: &mut [&mut [f32]],
) {
    let (margin, width) = (y.len(), tile.width);
    let padded = room(&mut scratch.padded, width + 2 * x.len());
    let blurred = room(&mut scratch.narrow, width * (tile.rows + 2 * margin));
    for (row, blurred) in tile.rows_with(margin).zip(blurred.chunks_exact_mut(width)) {
        copy_padded(amounts.layer_row(layer, row), tile.x as isize - x.len() as isize, padded);
        along_row(x, padded, blurred);
    }
    for (i, out) in out.iter_mut().enumerate() {
        let own = &amounts.layer_row(layer, tile.y + i)[tile.x..];
        let row = |distance: isize| row_of(&*blurred, width, (i + margin) as isize + distance);
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let (start, len) = (block * LANES, out.len());
            let sum = across_rows(y, row, start, len);
            let (own, middle) = (lanes(&own[start..], len), lanes(&row(0)[start..], len));
            for i in 0..len {
                out[i] = (own[i] + strength * (own[i] - (middle[i] + sum[i]))).max(0.0);
            }
        }
    }
}

/// Adds grain to the tile's part of each row of the three layers.
pub(crate) fn add_grain(
    level: Level,
    grain: &Grain,
    frame: u32,
    tile: Tile,
    offset: [i32; 2],
    scratch: &mut Scratch,
    out: &mut [[&mut [f32]; 3]],
) {
    let [x, y] = grain.correlation();
    let (margin, width) = (y.radius(), tile.width);
    let wide = width + 2 * x.radius();
    let key = grain.key(frame);
    let start = [
        (tile.x as i64 + i64::from(offset[0]) - x.radius() as i64) as u32,
        (tile.y as i64 + i64::from(offset[1]) - margin as i64) as u32,
    ];
    for layer in 0..3 {
        room(&mut scratch.white[layer], wide);
        room(&mut scratch.field[layer], width * (tile.rows + 2 * margin));
    }
    let (white, field) = (&mut scratch.white, &mut scratch.field);
    dispatch!(level, _simd => fill_field(start, key, x.taps(), wide, width, tile.rows + 2 * margin, white, field));
    let noise = room(&mut scratch.noise, width);
    let scale = (1.0 / field_sigma(x, y)) as f32;
    for (i, rows) in out.iter_mut().enumerate() {
        for (layer, out) in rows.iter_mut().enumerate() {
            let field = &scratch.field[layer];
            dispatch!(level, _simd => across(y.taps(), field, width, i + margin, noise));
            let table = &grain.tables()[layer];
            for (a, noise) in out.iter_mut().zip(noise.iter()) {
                let [sigma, shift] = table.at(*a);
                *a += sigma * (*noise as f32 * scale) + shift;
            }
        }
    }
}

#[inline(always)]
fn across(taps: &[i32], field: &[i32], width: usize, y: usize, out: &mut [i32]) {
    correlate_rows(taps, |distance| row_of(field, width, y as isize + distance), out);
}

#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "one loop, compiled for each level of vector instructions")]
fn fill_field(
    [x, y]: [u32; 2],
    key: NoiseKey,
    taps: &[i32],
    wide: usize,
    width: usize,
    rows: usize,
    white: &mut [Vec<i32>; 3],
    field: &mut [Vec<i32>; 3],
) {
    for row in 0..rows {
        let [red, green, blue] = white;
        let numbers = [&mut red[..wide], &mut green[..wide], &mut blue[..wide]];
        white_row(x, y.wrapping_add(row as u32), key, numbers);
        for (white, field) in white.iter().zip(field.iter_mut()) {
            correlate_row(taps, &white[..wide], &mut field[row * width..][..width]);
        }
    }
}
