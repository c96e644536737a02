use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};
use onelight_film::{AmountCurve, DyeAmount, LogExposure, PerLayer};
use onelight_lut::{Develop, Domain, Lut1d, Mix, SceneSampler};
use rayon::prelude::*;

use super::first_steps::CURVE_POINTS;
use crate::error::{Error, ErrorKind};
use crate::reference::Reference;

/// Colours that the affine map is fitted to, and their exposures in stops about mid grey.
const COLOURS: usize = 1 << 13;
const STOPS: (f64, f64) = (-10.0, 10.0);
const SEED: u64 = 0x666d_6178_6573_3031;

/// The axes of a process: from exposure to the coordinates of the table, and from coordinates back to dye in the camera film.
pub(super) struct Axes {
    /// From log2 exposure of each layer to the first coordinates.
    pub(super) develop: Develop,
    last: Last,
}

/// What the table's coordinates are.
enum Last {
    /// Dye in the camera film, 0 to 1 from the least to the most.
    Camera { amounts: PerLayer<(f64, f64)> },
    /// Dye in the print, 0 to 1, at the log exposure that an affine map of the camera film's dye gives.
    Print { matrix: Matrix3<f64>, offset: Vector3<f64>, inverse: Matrix3<f64>, axes: Box<PerLayer<PrintAxis>> },
}

/// One layer of the print over the range of log exposures it gets.
struct PrintAxis {
    curve: AmountCurve,
    from: f64,
    to: f64,
}

impl Axes {
    pub(super) fn new(film: &Reference) -> Result<Self, Error> {
        let camera = film.camera_curves();
        // No map to the three layers of a print or a scan can be found of one, nor is one needed.
        match film.axis_curves().filter(|_| !is_one_layer(film)) {
            None => {
                let amounts = camera.map(|curve| {
                    let (least, most) = curve.amount_range().into_inner();
                    (least.0, most.0)
                });
                let value = |layer: usize, h: f64| {
                    let (least, most) = amounts.to_array()[layer];
                    (camera.to_array()[layer].amount(LogExposure(h)).0 - least) / (most - least)
                };
                Ok(Self { develop: film.develop_form(value)?, last: Last::Camera { amounts } })
            }
            Some(print) => {
                let value = |layer: usize, h: f64| camera.to_array()[layer].amount(LogExposure(h)).0;
                Ok(Self { develop: film.develop_form(value)?, last: Last::print(film, print)? })
            }
        }
    }

    /// The second stage of the table's form.
    pub(super) fn mix(&self) -> Result<Option<Mix>, Error> {
        let Last::Print { matrix, offset, axes, .. } = &self.last else { return Ok(None) };
        let axes = axes.as_ref().as_ref().to_array();
        let ends = |pick: fn(&PrintAxis) -> f64| axes.map(|axis| pick(axis) as f32);
        let domain = Domain::new(ends(|axis| axis.from), ends(|axis| axis.to))?;
        let point = |i: usize| {
            let t = i as f64 / (CURVE_POINTS - 1) as f64;
            axes.map(|axis| axis.coordinate(axis.from + t * (axis.to - axis.from)) as f32)
        };
        let curves = Lut1d::new(domain, (0..CURVE_POINTS).map(point).collect())?;
        let matrix = std::array::from_fn(|i| std::array::from_fn(|k| matrix[(i, k)] as f32));
        Ok(Some(Mix { matrix, offset: std::array::from_fn(|i| offset[i] as f32), curves }))
    }

    /// What lies at a coordinate of each axis: dye in the camera film, or log exposure of the print.
    pub(super) fn positions(&self, coordinates: [f64; 3]) -> [f64; 3] {
        match &self.last {
            Last::Camera { amounts } => {
                amounts.zip_map(coordinates.into(), |(least, most), t| least + t * (most - least)).to_array()
            }
            Last::Print { axes, .. } => axes.as_ref().as_ref().zip_map(coordinates.into(), PrintAxis::at).to_array(),
        }
    }

    /// Dye in the camera film at a node, given by its positions. Nodes that no light reaches may hold less than no dye.
    pub(super) fn amounts(&self, positions: [f64; 3]) -> PerLayer<DyeAmount> {
        let amounts = match &self.last {
            Last::Camera { .. } => positions,
            Last::Print { offset, inverse, .. } => (inverse * (Vector3::from(positions) - offset)).into(),
        };
        PerLayer::from(amounts).map(DyeAmount)
    }
}

impl Last {
    fn print(film: &Reference, print: PerLayer<&AmountCurve>) -> Result<Self, Error> {
        let colours: Vec<[f64; 3]> = SceneSampler::with_seed(STOPS.0..=STOPS.1, SEED)?.take(COLOURS).collect();
        let pairs: Vec<(Vector3<f64>, Vector3<f64>)> = colours
            .par_iter()
            .filter_map(|&rgb| {
                let amounts = film.camera_amounts(film.exposure_matrix().expose(rgb).map(LogExposure::of));
                let exposure = film.exposure_behind(amounts)?;
                Some((Vector3::from(amounts.map(|a| a.0).to_array()), Vector3::from(exposure.map(|h| h.0).to_array())))
            })
            .collect();
        let (matrix, offset) = affine(&pairs)?;
        let inverse = matrix.try_inverse().ok_or_else(flat)?;
        let (mut from, mut to) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        for (amounts, _) in &pairs {
            let h = matrix * amounts + offset;
            (from, to) = (from.inf(&h), to.sup(&h));
        }
        let axis = |layer: usize, curve: &AmountCurve| {
            let axis = PrintAxis { curve: curve.clone(), from: from[layer], to: to[layer] };
            // Reversal paper holds less dye the more light it gets.
            if axis.end(axis.from) == axis.end(axis.to) { Err(flat()) } else { Ok(axis) }
        };
        let axes = PerLayer { red: axis(0, print.red)?, green: axis(1, print.green)?, blue: axis(2, print.blue)? };
        Ok(Self::Print { matrix, offset, inverse, axes: Box::new(axes) })
    }
}

impl PrintAxis {
    fn end(&self, h: f64) -> f64 {
        self.curve.amount(LogExposure(h)).0
    }

    fn coordinate(&self, h: f64) -> f64 {
        let (least, most) = (self.end(self.from), self.end(self.to));
        (self.end(h) - least) / (most - least)
    }

    /// The log exposure at a coordinate.
    fn at(&self, coordinate: f64) -> f64 {
        let (least, most) = (self.end(self.from), self.end(self.to));
        let found = self.curve.log_exposure(DyeAmount(least + coordinate * (most - least)));
        // Rounding may lead a hair beyond the ends.
        found.map_or(if coordinate < 0.5 { self.from } else { self.to }, |h| h.0.clamp(self.from, self.to))
    }
}

/// Whether the camera film is black and white: one layer three times.
pub(super) fn is_one_layer(film: &Reference) -> bool {
    let camera = film.camera_curves();
    camera.red == camera.green && camera.green == camera.blue
}

/// The affine map nearest to pairs of points, in least squares.
fn affine(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Result<(Matrix3<f64>, Vector3<f64>), Error> {
    let mut square = Matrix4::<f64>::zeros();
    let mut products = [Vector4::<f64>::zeros(); 3];
    for (from, to) in pairs {
        let point = from.push(1.0);
        square += point * point.transpose();
        for (product, value) in products.iter_mut().zip(to.iter()) {
            *product += point * *value;
        }
    }
    let lu = square.lu();
    let mut solved = [Vector4::zeros(); 3];
    for (solved, product) in solved.iter_mut().zip(&products) {
        *solved = lu.solve(product).ok_or_else(flat)?;
    }
    Ok((Matrix3::from_fn(|i, k| solved[i][k]), Vector3::from_fn(|i, _| solved[i][3])))
}

fn flat() -> Error {
    ErrorKind::Contradiction("the print does not respond to the negative, expected three layers that do".to_owned())
        .into()
}
