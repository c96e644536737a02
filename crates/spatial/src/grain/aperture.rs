//! How much of the scatter of dye clouds is left when density is averaged over an aperture.

use std::f64::consts::PI;

/// Gaussians are followed for this many standard deviations.
const REACH: f64 = 9.0;
/// Intervals of Simpson's rule.
const INTERVALS: usize = 512;

/// Variance over a disc of diameter `d_um` of white noise blurred by a Gaussian of `cloud_um`, in 1/um^2: the share that two points of the
/// disc have in common, by their distance.
pub(crate) fn disc_variance(d_um: f64, cloud_um: f64) -> f64 {
    let area = PI * d_um * d_um / 4.0;
    let lens =
        |r: f64| d_um * d_um / 2.0 * (r / d_um).min(1.0).acos() - r / 2.0 * (d_um * d_um - r * r).max(0.0).sqrt();
    // The clouds' autocorrelation is a Gaussian of twice the variance, in two dimensions.
    let variance = 2.0 * cloud_um * cloud_um;
    let shared = |r: f64| (-r * r / (2.0 * variance)).exp() / (2.0 * PI * variance);
    let end = d_um.min(REACH * variance.sqrt());
    simpson(0.0, end, |r| 2.0 * PI * r * lens(r) / (area * area) * shared(r))
}

/// Covariance along one axis of two pixels, `distance` pixels apart, of white noise blurred by a Gaussian of `cloud_um` and averaged over
/// pixels of `pitch_um`, in 1/um. At distance 0: the variance.
pub(crate) fn pixel_covariance(pitch_um: f64, cloud_um: f64, distance: usize) -> f64 {
    let sigma = std::f64::consts::SQRT_2 * cloud_um;
    let centre = pitch_um * distance as f64;
    let density = |x: f64| (-0.5 * (x / sigma).powi(2)).exp() / (sigma * (2.0 * PI).sqrt());
    let both = |x: f64| (1.0 - (x - centre).abs() / pitch_um) / pitch_um * density(x);
    let reach = REACH * sigma;
    let side = |from: f64, to: f64| {
        let (from, to) = (from.clamp(-reach, reach), to.clamp(-reach, reach));
        if to > from { simpson(from, to, both) } else { 0.0 }
    };
    side(centre - pitch_um, centre) + side(centre, centre + pitch_um)
}

fn simpson(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let step = (to - from) / INTERVALS as f64;
    let inner: f64 = (1..INTERVALS).map(|i| (if i % 2 == 1 { 4.0 } else { 2.0 }) * f(from + i as f64 * step)).sum();
    step / 3.0 * (f(from) + inner + f(to))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clouds_much_smaller_than_the_aperture_average_by_its_area() {
        assert!((disc_variance(48.0, 0.01) * PI * 24.0 * 24.0 - 1.0).abs() < 1e-3);
        assert!((pixel_covariance(30.0, 0.01, 0) * 30.0 - 1.0).abs() < 1e-3);
        assert!(pixel_covariance(30.0, 0.01, 1) * 30.0 < 1e-3);
    }

    #[test]
    fn pixels_together_hold_all_of_a_cloud() {
        for pitch in [0.75, 3.0, 12.0] {
            let all =
                pixel_covariance(pitch, 1.5, 0) + (1..40).map(|j| 2.0 * pixel_covariance(pitch, 1.5, j)).sum::<f64>();
            assert!((all * pitch - 1.0).abs() < 1e-8, "{pitch}: {all}");
        }
    }
}
