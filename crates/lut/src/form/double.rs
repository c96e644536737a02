//! The forms in float64: the same numbers, the same steps, no rounding worth a word. What float32 costs is the distance from these.

use super::direct::{DirectForm, DirectPrint, ExponentialSum};
use super::plain::PlainLut;
use super::structured::{Decode, INPUT_MAX, LOG_FLOOR, Mix, Rows, StructuredLut};
use crate::interpolate::Interpolation;
use crate::lut1d::Lut1d;
use crate::lut3d::Lut3d;

pub(crate) fn plain(form: &PlainLut, linear: [f64; 3]) -> [f64; 3] {
    table(form.table(), linear.map(|v| form.shaper().encode(v)), form.interpolation())
}

pub(crate) fn structured(form: &StructuredLut, linear: [f64; 3]) -> [f64; 3] {
    let parts = form.parts();
    let first = curves(&parts.curves, log2_exposure(&parts.input, &parts.exposure, linear));
    let coordinates = match &parts.mix {
        Some(Mix { matrix, offset, curves: second }) => {
            let mixed = times(matrix, first);
            curves(second, std::array::from_fn(|c| mixed[c] + f64::from(offset[c])))
        }
        None => first,
    };
    let entry = table(&parts.table, coordinates, parts.interpolation);
    match &parts.decode {
        Decode::Coded => entry,
        Decode::Density { matrix, coding } => times(matrix, entry.map(|d| 10_f64.powf(-d))).map(|v| coding.encode(v)),
    }
}

pub(crate) fn direct(form: &DirectForm, linear: [f64; 3]) -> [f64; 3] {
    let parts = form.parts();
    let first = curves(&parts.curves, log2_exposure(&parts.input, &parts.exposure, linear));
    let shown = match &parts.print {
        Some(DirectPrint { exposure, curves: second }) => curves(second, sum(exposure, first).map(floored_log2)),
        None => first,
    };
    sum(&parts.projection, shown).map(|v| parts.coding.encode(v))
}

fn log2_exposure(input: &Rows, exposure: &Rows, linear: [f64; 3]) -> [f64; 3] {
    let most = f64::from(INPUT_MAX);
    let finite = linear.map(|v| if v.is_nan() { 0.0 } else { v.clamp(-most, most) });
    let scene = times(input, finite).map(|v| v.clamp(0.0, most));
    times(exposure, scene).map(floored_log2)
}

fn floored_log2(v: f64) -> f64 {
    v.max(f64::from(LOG_FLOOR)).log2()
}

fn times(rows: &Rows, v: [f64; 3]) -> [f64; 3] {
    rows.map(|row| f64::from(row[0]) * v[0] + f64::from(row[1]) * v[1] + f64::from(row[2]) * v[2])
}

fn sum(sum: &ExponentialSum, x: [f64; 3]) -> [f64; 3] {
    let mut all = [0.0; 3];
    for term in sum.terms() {
        let [r, g, b] = term.rate.map(f64::from);
        let power = (-(r * x[0] + g * x[1] + b * x[2])).exp2();
        for (all, weight) in all.iter_mut().zip(term.weight) {
            *all += f64::from(weight) * power;
        }
    }
    all
}

fn curves(table: &Lut1d, x: [f64; 3]) -> [f64; 3] {
    let (min, max, entries) = (table.domain().min(), table.domain().max(), table.entries());
    std::array::from_fn(|c| {
        let (min, max) = (f64::from(min[c]), f64::from(max[c]));
        let (index, t) = cell((x[c] - min) / (max - min), entries.len());
        let ends = [entries[index][c], entries[index + 1][c]].map(f64::from);
        ends[0] * (1.0 - t) + ends[1] * t
    })
}

/// As the function of this name in `interpolate`.
fn cell(coordinate: f64, size: usize) -> (usize, f64) {
    let inside = if coordinate > 0.0 { coordinate.min(1.0) } else { 0.0 };
    let position = inside * (size - 1) as f64;
    let index = (position as usize).min(size - 2);
    (index, position - index as f64)
}

fn table(table: &Lut3d, coordinates: [f64; 3], how: Interpolation) -> [f64; 3] {
    let (size, entries) = (table.size(), table.entries());
    let cells = coordinates.map(|c| cell(c, size));
    let steps = [1, size, size * size];
    let start: usize = cells.iter().zip(steps).map(|(cell, step)| cell.0 * step).sum();
    let fraction = cells.map(|cell| cell.1);
    let mut out = [0.0; 3];
    let mut add = |entry: usize, weight: f64| {
        out.iter_mut().zip(entries[entry]).for_each(|(out, v)| *out += weight * f64::from(v));
    };
    match how {
        Interpolation::Tetrahedral => {
            let mut order = [0, 1, 2];
            order.sort_by(|&i, &k| fraction[k].total_cmp(&fraction[i]));
            let mut at = start;
            let mut before = 1.0;
            for axis in order {
                add(at, before - fraction[axis]);
                (at, before) = (at + steps[axis], fraction[axis]);
            }
            add(at, before);
        }
        Interpolation::Trilinear => {
            for corner in 0..8_usize {
                let far = |axis: usize| corner >> axis & 1 == 1;
                let entry = start + (0..3).filter(|&axis| far(axis)).map(|axis| steps[axis]).sum::<usize>();
                let weight = (0..3).map(|axis| if far(axis) { fraction[axis] } else { 1.0 - fraction[axis] }).product();
                add(entry, weight);
            }
        }
    }
    out
}
