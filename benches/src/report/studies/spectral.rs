use onelight::film::{PerLayer, Tail};
use onelight::lut::{DirectForm, DirectParts, DirectPrint};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Basis, SpectralShape};
use onelight::{DirectSettings, Nodes};
use serde::Serialize;

use super::colours::{Colours, Miss};
use crate::error::Result;
use crate::form::Form;
use crate::report::forms::Kind;
use crate::report::measure::{Look, Prepared};

/// A set of wavelengths, or of exponentials that stand for them.
#[derive(Debug, Clone, Serialize)]
pub(in crate::report) struct GridRow {
    pub(in crate::report) name: String,
    /// Exponentials of printing (0 for reversal film) and of projection.
    pub(in crate::report) nodes: [usize; 2],
    /// Projection by these, all else by 1 nm.
    pub(in crate::report) projection: Miss,
    /// Printing by these, all else by 1 nm.
    pub(in crate::report) printing: Option<Miss>,
    /// Both by these: what the direct form is certified with.
    pub(in crate::report) both: Miss,
    pub(in crate::report) ns: f64,
}

/// Every direct form of a look, taken apart.
pub(super) fn grids(prepared: &Prepared, look: &Look, colours: &Colours) -> Result<Vec<GridRow>> {
    let fine = prepared.film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 1 } })?;
    let mut rows = Vec::new();
    let direct = look.rows.iter().filter(|row| row.kind == Kind::Direct);
    let forms = prepared.made.iter().filter_map(|made| match &made.form {
        Form::Direct(form) => Some((made, form)),
        _ => None,
    });
    for ((made, form), row) in forms.zip(direct) {
        let parts = form.parts();
        let projected = with(&fine, |all| DirectParts { projection: parts.projection.clone(), ..all })?;
        let printed = match (&parts.print, &fine.parts().print) {
            (Some(coarse), Some(fine_print)) => {
                let print = DirectPrint { exposure: coarse.exposure.clone(), curves: fine_print.curves.clone() };
                Some(with(&fine, |all| DirectParts { print: Some(print), ..all })?)
            }
            _ => None,
        };
        rows.push(GridRow {
            name: made.detail.clone(),
            nodes: made.nodes.unwrap_or_default(),
            projection: colours.miss_coded(|rgb| projected.apply(rgb))?,
            printing: printed.map(|form| colours.miss_coded(|rgb| form.apply(rgb))).transpose()?,
            both: Miss { mean: row.error.mean, max: row.error.max },
            ns: row.time.ns,
        });
    }
    Ok(rows)
}

fn with(fine: &DirectForm, change: impl FnOnce(DirectParts) -> DirectParts) -> Result<DirectForm> {
    Ok(DirectForm::new(change(fine.parts().clone()))?)
}

/// The exposure matrix integrated on a coarse grid.
#[derive(Debug, Clone, Serialize)]
pub(in crate::report) struct ExposureRow {
    pub(in crate::report) step_nm: u16,
    /// With the matching vector of the fine grid.
    pub(in crate::report) unmatched: Miss,
    /// With a matching vector made on the coarse grid too: a grey card stays where it was.
    pub(in crate::report) matched: Miss,
}

/// Steps of the grids that the exposure matrix is tried on.
const STEPS_NM: [u16; 4] = [2, 5, 10, 20];

/// What integrating spectra and sensitivities by more than 1 nm costs, all else exact.
pub(super) fn exposure(prepared: &Prepared, colours: &Colours) -> Result<Vec<ExposureRow>> {
    let film = &prepared.film;
    let exact = film.exposure_matrix();
    let grey = exact.expose([1.0; 3]).to_array();
    let mut rows = Vec::new();
    for step_nm in STEPS_NM {
        let sensors = sensors(prepared, step_nm)?;
        let response = sensors * Vector3::repeat(1.0);
        let miss = |matching: Vector3<f64>| {
            let matrix = Matrix3::from_diagonal(&matching) * sensors;
            let coarse = |rgb: [f64; 3]| PerLayer::from(<[f64; 3]>::from(matrix * Vector3::from(rgb)));
            colours
                .miss_between(|rgb| film.develop_exposure(exact.expose(rgb)), |rgb| film.develop_exposure(coarse(rgb)))
        };
        rows.push(ExposureRow {
            step_nm,
            unmatched: miss(Vector3::from(exact.matching_vector().to_array()))?,
            matched: miss(Vector3::from_fn(|i, _| grey[i] / response[i]))?,
        });
    }
    Ok(rows)
}

/// Response of each layer to each primary of the process's basis, by the trapezoid rule on every `step_nm`-th wavelength.
fn sensors(prepared: &Prepared, step_nm: u16) -> Result<Matrix3<f64>> {
    let basis = Basis::new(prepared.process.film()?.reconstruction)?;
    let visible = SpectralShape::VISIBLE;
    let shape = SpectralShape::new(visible.first_nm() as u16, visible.last_nm() as u16, step_nm)?;
    let weights: Vec<f64> = shape.trapezoid_weights_nm().collect();
    let mut sensors = Matrix3::zeros();
    for (i, layer) in prepared.films.camera.sensitivity().to_array().into_iter().enumerate() {
        let sensitivity = layer.on(visible, Tail::LogLinear)?;
        for k in 0..3 {
            let light = basis.reflectance(k).iter().zip(basis.white().values());
            let response = light.zip(sensitivity.values()).step_by(usize::from(step_nm)).zip(&weights);
            sensors[(i, k)] = response.map(|(((rho, white), s), weight)| rho * white * s * weight).sum();
        }
    }
    Ok(sensors)
}
