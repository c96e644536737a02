use std::f64::consts::LOG2_10;

use onelight::film::{AmountCurve, LogExposure, PerLayer};
use onelight::lut::{Develop, DirectForm, DirectParts, DirectPrint, Domain, Lut1d};
use onelight::{DirectSettings, Nodes};
use serde::Serialize;

use super::colours::{Colours, Miss};
use crate::error::Result;
use crate::report::measure::Prepared;

/// Curves as tables of so many points, read linearly.
#[derive(Debug, Clone, Serialize)]
pub(in crate::report) struct CurveRow {
    pub(in crate::report) points: usize,
    pub(in crate::report) miss: Miss,
}

const POINTS: [usize; 7] = [64, 128, 256, 512, 1024, 2048, 4096];

/// What tables in place of curves cost: all films of a process together, all else by 1 nm in `f32`.
pub(super) fn curves(prepared: &Prepared, colours: &Colours) -> Result<Vec<CurveRow>> {
    let film = &prepared.film;
    let fine = film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 1 } })?;
    let mut rows = Vec::new();
    for points in POINTS {
        let parts = fine.parts().clone();
        let print = match (parts.print, film.print_curves()) {
            (Some(print), Some(layers)) => Some(DirectPrint { curves: table(layers, points)?, ..print }),
            (print, _) => print,
        };
        let develop = Develop { curves: table(film.camera_curves(), points)?, ..parts.develop };
        let form = DirectForm::new(DirectParts { develop, print, ..parts })?;
        rows.push(CurveRow { points, miss: colours.miss_coded(|rgb| form.apply(rgb))? });
    }
    Ok(rows)
}

/// Dye over log2 exposure, each layer over its own range.
fn table(layers: PerLayer<&AmountCurve>, points: usize) -> Result<Lut1d> {
    let ranges = layers.map(|curve| (curve.range().start().0, curve.range().end().0)).to_array();
    let domain = Domain::new(ranges.map(|r| (r.0 * LOG2_10) as f32), ranges.map(|r| (r.1 * LOG2_10) as f32))?;
    let layers = layers.to_array();
    let entry = |i: usize| {
        let t = i as f64 / (points - 1) as f64;
        std::array::from_fn(|c| {
            let (from, to) = ranges[c];
            layers[c].amount(LogExposure(from + t * (to - from))).0 as f32
        })
    };
    Ok(Lut1d::new(domain, (0..points).map(entry).collect())?)
}
