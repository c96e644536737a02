//! Laws of characteristic curves on random sheets.

use onelight_film::{AmountCurve, CharacteristicCurve, Density, Direction, DyeAmount, LogExposure};
use proptest::prelude::*;

use crate::cases;

/// Densities read off a sheet: mostly monotone, with noise, steps and flat parts.
fn sheet() -> impl Strategy<Value = (Vec<f64>, Vec<f64>, Direction)> {
    let point = (0.01..0.5, prop_oneof![1 => Just(0.0), 4 => -0.01..0.3, 1 => -1.0..1.0]);
    (-6.0..2.0, prop::collection::vec(point, 1..40), any::<bool>()).prop_map(|(start, points, rising)| {
        let (direction, sign) = if rising { (Direction::Rising, 1.0) } else { (Direction::Falling, -1.0) };
        let (mut h, mut density) = (vec![start], vec![1.5_f64]);
        for (step, rise) in points {
            h.push(h[h.len() - 1] + step);
            density.push(density[density.len() - 1] + sign * rise);
        }
        (h, density, direction)
    })
}

/// A few roundings of densities below 20.
const ROUNDING: f64 = 1e-14;

fn never_turns(values: &[f64], direction: Direction) -> bool {
    values.windows(2).all(|pair| match direction {
        Direction::Rising => pair[1] >= pair[0] - ROUNDING,
        Direction::Falling => pair[1] <= pair[0] + ROUNDING,
    })
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn a_curve_never_turns_whatever_the_sheet((h, density, direction) in sheet()) {
        let curve = CharacteristicCurve::new(h.clone(), &density, direction).unwrap();
        let dye = AmountCurve::new(h, &density, direction).unwrap();
        let (first, last) = curve.range().into_inner();
        let points = (-20..=420).map(|i| LogExposure(first.0 + f64::from(i) / 400.0 * (last.0 - first.0)));
        let read: Vec<f64> = points.clone().map(|h| curve.density(h).0).collect();
        prop_assert!(never_turns(&read, direction), "{read:?}");
        let sign = if direction == Direction::Rising { 1.0 } else { -1.0 };
        prop_assert!(points.clone().all(|h| sign * curve.slope(h) >= -1e-9));
        prop_assert!(read.iter().all(|d| (curve.d_min().0 - ROUNDING..=curve.d_max().0 + ROUNDING).contains(d)));
        // Dye is read as density is.
        prop_assert!(points.zip(read).all(|(h, d)| dye.amount(h).0 == d));
        // Flat beyond the sheet, to infinity.
        for (far, end) in [(f64::NEG_INFINITY, first), (f64::INFINITY, last), (-1e300, first), (1e300, last)] {
            prop_assert_eq!(curve.density(LogExposure(far)), curve.density(end));
        }
    }

    #[test]
    fn the_exposure_for_a_density_has_that_density((h, density, direction) in sheet(), t in 0.0..=1.0) {
        let curve = CharacteristicCurve::new(h.clone(), &density, direction).unwrap();
        let dye = AmountCurve::new(h, &density, direction).unwrap();
        let wanted = curve.d_min().0 * (1.0 - t) + curve.d_max().0 * t;
        let found = curve.log_exposure(Density(wanted));
        prop_assert_eq!(found, dye.log_exposure(DyeAmount(wanted)));
        if let Some(h) = found {
            // Log exposures below 30 are known to 4e-15, and curves rise by less than 200 for each unit.
            prop_assert!((curve.density(h).0 - wanted).abs() < 1e-12, "{:?} for {wanted}", curve.density(h));
            let (first, last) = curve.range().into_inner();
            prop_assert!(first <= h && h <= last);
        } else {
            // Only where the whole sheet is one density, or rounding left the range.
            let (low, high) = (curve.d_min().0, curve.d_max().0);
            prop_assert!(low == high || !(low..=high).contains(&wanted), "no exposure for {wanted} of {low}..{high}");
        }
        for beyond in [curve.d_min().0 - 1e-9, curve.d_max().0 + 1e-9, f64::NAN] {
            prop_assert_eq!(curve.log_exposure(Density(beyond)), None);
        }
    }

    #[test]
    fn the_nearest_monotone_sheet_keeps_what_is_monotone((h, density, direction) in sheet()) {
        let curve = CharacteristicCurve::new(h.clone(), &density, direction).unwrap();
        let once = curve.densities().to_vec();
        let again = CharacteristicCurve::new(h, &once, direction).unwrap();
        prop_assert!(once.iter().zip(again.densities()).all(|(a, b)| (a - b).abs() < ROUNDING));
        // Pooling keeps the sum.
        let sums = [density.iter().sum::<f64>(), once.iter().sum()];
        prop_assert!((sums[0] - sums[1]).abs() < 1e-11, "{sums:?}");
    }
}
