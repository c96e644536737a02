//! White noise that is a function of place, frame and seed: integers, the same on every machine and in every order.

use super::correlation::Correlation;
use crate::blur::LANES;

/// Standard deviation of [`white`]: the root of 2048^2 * 8 + 4 (1024^2 - 1) / 12.
pub(crate) const WHITE_SIGMA: f64 = 5_822.710_451_327_629;
/// Bits that are dropped between the taps of the two axes, so that no sum leaves 32 bits: at worst 33791 times the taps' magnitudes
/// squared, 1346^2, over 64.
pub(crate) const DROPPED_BITS: u32 = 6;

/// Where and when noise is looked up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NoiseKey {
    pub(crate) frame: u32,
    pub(crate) seed: u32,
}

/// Four numbers hashed together: pcg4d of \[Jarzynski2020\], and one more fold, without which lines show in the picture.
#[inline(always)]
pub(crate) fn hash(v: [u32; 4]) -> [u32; 4] {
    let [mut x, mut y, mut z, mut w] = v.map(|v| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w] = [x ^ (x >> 16), y ^ (y >> 16), z ^ (z >> 16), w ^ (w >> 16)];
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x ^ (x >> 16), y ^ (y >> 16), z ^ (z >> 16), w ^ (w >> 16)]
}

/// A number for each layer, of mean 0 and nearly normal: bits of one word counted, filled up by ten bits of another.
#[inline(always)]
pub(crate) fn white(x: u32, y: u32, key: NoiseKey) -> [i32; 3] {
    let [a, b, c, fine] = hash([x, y, key.frame, key.seed]);
    let number = |bits: u32, fine: u32| 2048 * (bits.count_ones() as i32 - 16) + 2 * (fine & 1023) as i32 - 1023;
    [number(a, fine), number(b, fine >> 10), number(c, fine >> 20)]
}

/// [`white`] of the pixels from `x` on, in whole groups of [`LANES`].
#[inline(always)]
pub(crate) fn white_row(x: u32, y: u32, key: NoiseKey, [red, green, blue]: [&mut [i32]; 3]) {
    let (red, green, blue) =
        (red.as_chunks_mut::<LANES>().0, green.as_chunks_mut::<LANES>().0, blue.as_chunks_mut::<LANES>().0);
    for (block, ((red, green), blue)) in red.iter_mut().zip(green).zip(blue).enumerate() {
        let start = x.wrapping_add((block * LANES) as u32);
        for (i, ((r, g), b)) in red.iter_mut().zip(green).zip(blue).enumerate() {
            [*r, *g, *b] = white(start.wrapping_add(i as u32), y, key);
        }
    }
}

/// One row of white noise, correlated along it: `noise` begins `radius` pixels before `out`, which is whole groups of [`LANES`], and ends as
/// many after it.
#[inline(always)]
pub(crate) fn correlate_row(taps: &[i32], noise: &[i32], out: &mut [i32]) {
    let radius = taps.len() - 1;
    for (block, out) in out.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let start = block * LANES + radius;
        let mut sum = [1 << (DROPPED_BITS - 1); LANES];
        add_lanes(&mut sum, taps[0], noise, start);
        for (i, &tap) in taps[1..].iter().enumerate() {
            add_lanes(&mut sum, tap, noise, start - i - 1);
            add_lanes(&mut sum, tap, noise, start + i + 1);
        }
        for (out, sum) in out.iter_mut().zip(sum) {
            *out = sum >> DROPPED_BITS;
        }
    }
}

/// The group at `start` of row `y` of such rows, correlated across them.
#[inline(always)]
pub(crate) fn correlate_rows(taps: &[i32], rows: &[i32], stride: usize, y: usize, start: usize) -> [i32; LANES] {
    let at = y * stride + start;
    let mut sum = [0; LANES];
    add_lanes(&mut sum, taps[0], rows, at);
    for (i, &tap) in taps[1..].iter().enumerate() {
        add_lanes(&mut sum, tap, rows, at - (i + 1) * stride);
        add_lanes(&mut sum, tap, rows, at + (i + 1) * stride);
    }
    sum
}

#[inline(always)]
fn add_lanes(sum: &mut [i32; LANES], tap: i32, numbers: &[i32], start: usize) {
    const NONE: [i32; LANES] = [0; LANES];
    let numbers = numbers.get(start..).and_then(|from| from.first_chunk()).unwrap_or(&NONE);
    for i in 0..LANES {
        sum[i] = sum[i].wrapping_add(tap.wrapping_mul(numbers[i]));
    }
}

/// What the integer field is divided by to have standard deviation 1.
pub(crate) fn field_sigma(x: &Correlation, y: &Correlation) -> f64 {
    WHITE_SIGMA * x.gain() * y.gain() / f64::from(1 << DROPPED_BITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_an_independent_implementation() {
        assert_eq!(hash([1, 2, 3, 4]), [908_262_196, 4_044_652_748, 3_775_953_455, 45_698_710]);
        let first = NoiseKey { frame: 0, seed: 0 };
        let expected = [[927, 3789, -411], [6983, -3403, 14407], [-5079, 7459, -2793], [-3791, 7797, 3783]];
        for (x, expected) in (0..).zip(expected) {
            assert_eq!(white(x, 0, first), expected);
        }
        assert_eq!(white(5, 9, NoiseKey { frame: 3, seed: 1 }), [6241, 1297, -1575]);
        assert_eq!(white(4095, 2159, NoiseKey { frame: 1000, seed: 7 }), [-1197, -6137, 1291]);
    }

    #[test]
    fn no_sum_leaves_32_bits() {
        let largest = 2048 * 16 + 1023;
        for pitch in [0.75, 1.0, 2.0, 6.0, 12.0, 24.0] {
            for cloud in [0.5, 1.5, 2.9, 5.84] {
                let gain = Correlation::new(pitch, cloud).largest_gain();
                let after_x = (largest * gain + 32) >> DROPPED_BITS;
                assert!(largest * gain < i64::from(i32::MAX), "{pitch} {cloud}: {gain}");
                assert!(after_x * gain < i64::from(i32::MAX), "{pitch} {cloud}: {gain}");
            }
        }
    }

    #[test]
    fn white_noise_is_white() {
        // Mean 0, the variance, no correlation between layers, neighbours, frames and seeds: within 4 standard errors of 2^18 numbers.
        let side = 512;
        let plane = |key: NoiseKey| -> Vec<[f64; 3]> {
            (0..side * side).map(|i| white(i % side, i / side, key).map(|v| f64::from(v) / WHITE_SIGMA)).collect()
        };
        let here = plane(NoiseKey { frame: 5, seed: 3 });
        let count = here.len() as f64;
        let limit = 4.0 / count.sqrt();
        let mean = |pairs: &mut dyn Iterator<Item = f64>| pairs.sum::<f64>() / count;
        for k in 0..3 {
            assert!(mean(&mut here.iter().map(|z| z[k])).abs() < limit);
            assert!((mean(&mut here.iter().map(|z| z[k] * z[k])) - 1.0).abs() < 1.5 * limit);
            let kurtosis = mean(&mut here.iter().map(|z| z[k].powi(4))) - 3.0;
            assert!((kurtosis + 0.06).abs() < 0.05, "{kurtosis}");
            assert!(mean(&mut here.iter().map(|z| z[k] * z[(k + 1) % 3])).abs() < limit);
            for lag in [1, 2, 511, 512, 513] {
                assert!(mean(&mut here.iter().zip(&here[lag..]).map(|(a, b)| a[k] * b[k])).abs() < limit, "lag {lag}");
            }
        }
        for other in [NoiseKey { frame: 6, seed: 3 }, NoiseKey { frame: 5, seed: 4 }, NoiseKey { frame: 3, seed: 5 }] {
            let there = plane(other);
            assert!(mean(&mut here.iter().zip(&there).map(|(a, b)| a[1] * b[1])).abs() < limit, "{other:?}");
        }
    }

    #[test]
    fn no_frequency_stands_out() {
        // Power along rows and along columns, the mean of 512 of them: of 128 frequencies the strongest, were they white, 1.2 times the mean.
        let length = 256;
        for along_x in [true, false] {
            let mut power = vec![0.0; length / 2];
            for line in 0..512 {
                let at = |i: u32| if along_x { (i, line) } else { (line, i) };
                let number =
                    |i: u32| f64::from(white(at(i).0, at(i).1, NoiseKey { frame: 2, seed: 9 })[0]) / WHITE_SIGMA;
                let numbers: Vec<f64> = (0..length as u32).map(number).collect();
                for (f, power) in (1..).zip(power.iter_mut()) {
                    let wave =
                        |i: usize| (2.0 * std::f64::consts::PI * ((f * i) % length) as f64 / length as f64).sin_cos();
                    let (mut s, mut c) = (0.0, 0.0);
                    for (i, z) in numbers.iter().enumerate() {
                        let (sine, cosine) = wave(i);
                        (s, c) = (s + z * sine, c + z * cosine);
                    }
                    *power += (s * s + c * c) / 512.0;
                }
            }
            let mean = power.iter().sum::<f64>() / power.len() as f64;
            let strongest = power.iter().copied().fold(0.0, f64::max) / mean;
            assert!(strongest < 1.24 && (mean / length as f64 - 1.0).abs() < 0.02, "{strongest} {mean}");
        }
    }
}
