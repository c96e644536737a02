//! One tile of a strip of rows through the effects on exposure, and one through those on amounts.

use fearless_simd::{Level, dispatch};

use crate::blur::{LANES, across_rows, along_row, copy_padded, lanes, whole_lanes};
use crate::cells::{CellRows, ExpandedRows, Expansion};
use crate::grain::noise::{correlate_row, correlate_rows, field_sigma, white_row};
use crate::grain::{Grain, NoiseKey, StrengthTable};
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

    /// Numbers in a row of scratch.
    fn stride(&self) -> usize {
        whole_lanes(self.width)
    }
}

/// Room for the rows of a tile, kept between tiles.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    padded: Vec<f32>,
    narrow: Vec<f32>,
    wide: Vec<f32>,
    cells: ExpandedRows,
    white: [Vec<i32>; 3],
    field: [Vec<i32>; 3],
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
                copy_believed(exposures.layer_row(layer, y), tile.x as isize, out);
            }
        }
    }
    let Some((halo, pull)) = halo.and_then(|halo| Some((halo, halo.pull(layer)?))) else { return };
    scratch.cells.clear();
    for (y, out) in tile.rows_with(0).zip(out) {
        let Some(rows) = halo.rows(layer, y, tile.x, tile.width, &mut scratch.cells) else { return };
        dispatch!(level, _simd => pull_row(pull, rows, out));
    }
}

#[inline(always)]
fn copy_believed(row: &[f32], start: isize, out: &mut [f32]) {
    copy_padded(row, start, out);
    for e in out {
        *e = believed(*e);
    }
}

/// Exposures go towards a field, given at the rows above and below.
#[inline(always)]
fn pull_row(pull: f32, (upper, lower, t): (&[f32], &[f32], f32), out: &mut [f32]) {
    for ((e, upper), lower) in out.iter_mut().zip(upper).zip(lower) {
        let field = upper + t * (lower - upper);
        *e += pull * (field - *e);
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
    let (margin, stride) = (scatter.reach(1), tile.stride());
    let radius = narrow_x.len().max(wide_x.len());
    let padded = room(&mut scratch.padded, stride + 2 * radius);
    let narrow = room(&mut scratch.narrow, stride * (tile.rows + 2 * margin));
    let wide = room(&mut scratch.wide, stride * (tile.rows + 2 * margin));
    let rows = narrow.chunks_exact_mut(stride).zip(wide.chunks_exact_mut(stride));
    for (y, (narrow, wide)) in tile.rows_with(margin).zip(rows) {
        copy_believed(exposures.layer_row(layer, y), tile.x as isize - radius as isize, padded);
        along_row(narrow_x, &padded[radius - narrow_x.len()..], narrow);
        along_row(wide_x, &padded[radius - wide_x.len()..], wide);
    }
    let share = scatter.narrow_share;
    for (y, out) in out.iter_mut().enumerate() {
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let narrow = across_rows(narrow_y, narrow, stride, y + margin, block * LANES);
            let mut mixed = across_rows(wide_y, wide, stride, y + margin, block * LANES);
            for (wide, narrow) in mixed.iter_mut().zip(narrow) {
                *wide += share * (narrow - *wide);
            }
            store(out, &mixed);
        }
    }
}

/// A group, or as much of it as is in the picture.
#[inline(always)]
fn load(from: &[f32]) -> [f32; LANES] {
    if let Some(group) = from.first_chunk() {
        return *group;
    }
    let mut group = [0.0; LANES];
    group[..from.len()].copy_from_slice(from);
    group
}

/// Writes a group, or as much of it as is in the picture.
#[inline(always)]
fn store(out: &mut [f32], group: &[f32; LANES]) {
    if let Some(out) = out.first_chunk_mut() {
        *out = *group;
    } else {
        out.copy_from_slice(&group[..out.len()]);
    }
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
        (Some(Adjacency { strength, blur: AdjacencyBlur::Cells([_, axis], _) }), Some((cells, expansion))) => {
            scratch.cells.clear();
            for (y, out) in tile.rows_with(0).zip(out) {
                let rows = scratch.cells.at(cells, axis, expansion, y, tile.x, tile.width);
                let own = &amounts.layer_row(layer, y)[tile.x..][..tile.width];
                dispatch!(level, _simd => push_row(*strength, own, rows, out));
            }
        }
        _ => {
            for (y, out) in tile.rows_with(0).zip(out) {
                out.copy_from_slice(&amounts.layer_row(layer, y)[tile.x..][..tile.width]);
            }
        }
    }
}

/// Amounts go away from their blurred mean, given at the rows above and below.
#[inline(always)]
fn push_row(strength: f32, own: &[f32], (upper, lower, t): (&[f32], &[f32], f32), out: &mut [f32]) {
    for (((out, own), upper), lower) in out.iter_mut().zip(own).zip(upper).zip(lower) {
        let blurred = upper + t * (lower - upper);
        *out = (own + strength * (own - blurred)).max(0.0);
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
    let (margin, stride, radius) = (y.len(), tile.stride(), x.len());
    let padded = room(&mut scratch.padded, stride + 2 * radius);
    let blurred = room(&mut scratch.narrow, stride * (tile.rows + 2 * margin));
    let own = room(&mut scratch.wide, stride * tile.rows);
    for ((i, row), blurred) in tile.rows_with(margin).enumerate().zip(blurred.chunks_exact_mut(stride)) {
        copy_padded(amounts.layer_row(layer, row), tile.x as isize - radius as isize, padded);
        along_row(x, padded, blurred);
        if let Some(own) = i.checked_sub(margin).and_then(|i| own.get_mut(i * stride..(i + 1) * stride)) {
            own.copy_from_slice(&padded[radius..][..stride]);
        }
    }
    for (i, out) in out.iter_mut().enumerate() {
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let mut blurred = across_rows(y, blurred, stride, i + margin, block * LANES);
            for (blurred, own) in blurred.iter_mut().zip(lanes(own, i * stride + block * LANES)) {
                *blurred = (own + strength * (own - *blurred)).max(0.0);
            }
            store(out, &blurred);
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
    let (margin, stride) = (y.radius(), tile.stride());
    let start = [
        (tile.x as i64 + i64::from(offset[0]) - x.radius() as i64) as u32,
        (tile.y as i64 + i64::from(offset[1]) - margin as i64) as u32,
    ];
    let wide = whole_lanes(stride + 2 * x.radius());
    let white = scratch.white.each_mut().map(|white| room(white, wide));
    let mut field = scratch.field.each_mut().map(|field| room(field, stride * (tile.rows + 2 * margin)));
    dispatch!(level, _simd => fill_field(start, grain.key(frame), x.taps(), stride, white, &mut field));
    let scale = (1.0 / field_sigma(x, y)) as f32;
    for (i, rows) in out.iter_mut().enumerate() {
        for ((out, field), table) in rows.iter_mut().zip(&field).zip(grain.tables()) {
            dispatch!(level, _simd => grain_row(table, (y.taps(), field, stride), i + margin, scale, out));
        }
    }
}

/// Rows of noise, correlated along themselves.
#[inline(always)]
fn fill_field(
    [x, y]: [u32; 2],
    key: NoiseKey,
    taps: &[i32],
    stride: usize,
    [red, green, blue]: [&mut [i32]; 3],
    field: &mut [&mut [i32]; 3],
) {
    for row in 0..field[0].len() / stride {
        white_row(x, y.wrapping_add(row as u32), key, [red, green, blue]);
        for (white, field) in [&*red, &*green, &*blue].into_iter().zip(field.iter_mut()) {
            correlate_row(taps, white, &mut field[row * stride..][..stride]);
        }
    }
}

#[inline(always)]
fn grain_row(
    table: &StrengthTable,
    (taps, field, stride): (&[i32], &[i32], usize),
    y: usize,
    scale: f32,
    out: &mut [f32],
) {
    for (block, out) in out.chunks_mut(LANES).enumerate() {
        let field = correlate_rows(taps, field, stride, y, block * LANES);
        let mut noise = [0.0; LANES];
        for (noise, field) in noise.iter_mut().zip(field) {
            *noise = field as f32 * scale;
        }
        let mut amounts = load(out);
        table.add_grain(&noise, &mut amounts);
        store(out, &amounts);
    }
}
