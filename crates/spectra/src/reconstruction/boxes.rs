use super::sensors::round_trip;
use crate::error::{Error, ErrorKind};
use crate::shape::SpectralShape;

/// Where green begins and red begins, in nm.
const GREEN_FROM_NM: f64 = 490.0;
const RED_FROM_NM: f64 = 585.0;

pub(super) fn raw() -> [Vec<f64>; 3] {
    let within = |from: f64, to: f64| {
        SpectralShape::VISIBLE.wavelengths_nm().map(|nm| f64::from(u8::from((from..to).contains(&nm)))).collect()
    };
    [within(RED_FROM_NM, f64::INFINITY), within(GREEN_FROM_NM, RED_FROM_NM), within(0.0, GREEN_FROM_NM)]
}

/// The boxes mixed by the inverse of their round trip.
pub(super) fn balanced(sensors: &[Vec<f64>; 3]) -> Result<[Vec<f64>; 3], Error> {
    let raw = raw();
    let mix = round_trip(sensors, &raw).try_inverse();
    let mix = mix.ok_or_else(|| ErrorKind::Basis { problem: "the boxes are not independent".to_owned() })?;
    Ok(std::array::from_fn(|k| (0..raw[0].len()).map(|i| (0..3).map(|j| raw[j][i] * mix[(j, k)]).sum()).collect()))
}
