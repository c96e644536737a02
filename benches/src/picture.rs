use onelight_lut::{Sample, SplitMix64};
use rayon::prelude::*;

/// Mid grey, scene-linear.
const MID_GREY: f32 = onelight::spectra::MID_GREY as f32;

/// Width and height in pixels.
pub type Size = [usize; 2];

/// Full HD, 1920 x 1080 pixels.
pub const FULL_HD: Size = [1920, 1080];
/// Ultra HD, 3840 x 2160 pixels: 4K.
pub const ULTRA_HD: Size = [3840, 2160];

/// A picture such as a camera or a renderer gives: scene-linear RGBA, row after row, alpha 1. The same at every call.
///
/// Not white noise: neighbouring pixels of a photograph are alike, so they read the same few cells of a table, which stay in
/// the nearest cache, and branches go as they went before. Noise would time the caches instead of the arithmetic, and a flat
/// ramp would flatter both. So:
///
/// - exposure is about log-normal: a stop under mid grey in the mean, a deviation of about one and a half stops;
/// - objects with edges, each with its own lightness and colour, most of them muted;
/// - light that changes slowly in strength and from warm to cool over the picture;
/// - texture down to the scale of pixels, and the grain of a sensor;
/// - a few small highlights, up to eight stops over mid grey: beyond the end of many tables.
///
/// Sizes of the same shape show the same scene.
pub fn natural(size: Size) -> Vec<f32> {
    let [width, height] = size;
    let mut samples = vec![0.0; width * height * 4];
    samples.par_chunks_mut((width * 4).max(1)).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
            let at = [x, y].map(|v| (v as f32 + 0.5) / height as f32);
            let [red, green, blue] = colour(at, 0.015 * (hash([x as i32, y as i32], 0) - 0.5));
            pixel.copy_from_slice(&[red, green, blue, 1.0]);
        }
    });
    samples
}

/// The picture in another type of sample; integers clip at 1.
pub fn coded<S: Sample>(picture: &[f32]) -> Vec<S> {
    picture.iter().map(|&v| S::from_f32(v)).collect()
}

/// Scene-linear RGB at a place, in heights of the picture; `grain` in stops.
fn colour(at: [f32; 2], grain: f32) -> [f32; 3] {
    let [lightness, warmth, green, roughness] = object(at);
    let light = 11.0 * octaves(at, 1, 1.2, 4, 0.45);
    let texture = (0.1 + roughness) * octaves(at, 2, 40.0, 4, 0.6);
    let stops = -1.0 + light + 4.0 * lightness + texture + grain;
    let warmth = 1.2 * warmth + 0.8 * octaves(at, 3, 1.0, 1, 1.0);
    let shine = MID_GREY * highlight(at);
    [warmth, 0.6 * green, -warmth].map(|tint| MID_GREY * (stops + tint).exp2() + shine)
}

/// The nearest of points strewn over the picture owns this place: its lightness, warmth, greenness (-0.5 to 0.5, near 0 most of
/// the time) and roughness (0 to 1).
fn object(at: [f32; 2]) -> [f32; 4] {
    const ACROSS: f32 = 7.0;
    let place = at.map(|v| v * ACROSS);
    let [i, k] = place.map(|v| v.floor() as i32);
    let mut nearest = (f32::INFINITY, [i, k]);
    for cell in (-1..=1).flat_map(|di| (-1..=1).map(move |dk| [i + di, k + dk])) {
        let dx = cell[0] as f32 + hash(cell, 11) - place[0];
        let dy = cell[1] as f32 + hash(cell, 12) - place[1];
        let distance = dx * dx + dy * dy;
        if distance < nearest.0 {
            nearest = (distance, cell);
        }
    }
    let middling = |seed| (hash(nearest.1, seed) + hash(nearest.1, seed + 1) + hash(nearest.1, seed + 2)) / 3.0 - 0.5;
    [2.0 * middling(13), 2.0 * middling(16), 2.0 * middling(19), hash(nearest.1, 22)]
}

/// Small lights over mid grey: one in one of sixteen tiles of a grid, wholly inside it.
fn highlight(at: [f32; 2]) -> f32 {
    const ACROSS: f32 = 24.0;
    let place = at.map(|v| v * ACROSS);
    let tile = place.map(|v| v.floor() as i32);
    if hash(tile, 31) > 1.0 / 16.0 {
        return 0.0;
    }
    let centre = [32, 33].map(|seed| 0.4 + 0.2 * hash(tile, seed));
    let [dx, dy] = [place[0] - tile[0] as f32 - centre[0], place[1] - tile[1] as f32 - centre[1]];
    let radius = 0.04 + 0.08 * hash(tile, 34);
    let peak = (5.0 + 3.0 * hash(tile, 35)).exp2();
    peak * (-(dx * dx + dy * dy) / (radius * radius)).exp()
}

/// Noise of several octaves, each `persistence` times as strong as the one before; about -0.5 to 0.5.
fn octaves(at: [f32; 2], seed: u64, frequency: f32, count: u64, persistence: f32) -> f32 {
    let (mut sum, mut all, mut strength, mut frequency) = (0.0, 0.0, 1.0, frequency);
    for octave in 0..count {
        sum += strength * smooth(at.map(|v| v * frequency), 100 * seed + octave);
        all += strength;
        strength *= persistence;
        frequency *= 2.0;
    }
    sum / all
}

/// Random numbers at whole coordinates, smoothly between; -0.5 to 0.5.
fn smooth(at: [f32; 2], seed: u64) -> f32 {
    let [i, k] = at.map(|v| v.floor() as i32);
    let [x, y] = at.map(|v| v - v.floor()).map(|t| t * t * (3.0 - 2.0 * t));
    let row = |k: i32| hash([i, k], seed) * (1.0 - x) + hash([i + 1, k], seed) * x;
    row(k) * (1.0 - y) + row(k + 1) * y - 0.5
}

/// A number in [0, 1) for a place: the mixer of SplitMix64 \[Steele2014\].
fn hash([i, k]: [i32; 2], seed: u64) -> f32 {
    let place = i as u32 as u64 | (k as u32 as u64) << 32;
    let mixed = SplitMix64::mix(place.wrapping_add(seed.wrapping_mul(SplitMix64::STEP)));
    (mixed >> 40) as f32 / (1_u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = [960, 540];

    /// Stops about mid grey of the green channel.
    fn stops() -> Vec<f32> {
        natural(SIZE).chunks_exact(4).map(|p| (p[1] / MID_GREY).log2()).collect()
    }

    fn mean(values: impl ExactSizeIterator<Item = f32>) -> f32 {
        let count = values.len() as f32;
        values.sum::<f32>() / count
    }

    #[test]
    fn light_is_positive_and_bounded() {
        for pixel in natural(SIZE).chunks_exact(4) {
            assert!(pixel[..3].iter().all(|&v| v > 0.0 && v < MID_GREY * 1024.0), "{pixel:?}");
            assert_eq!(pixel[3], 1.0);
        }
    }

    #[test]
    fn exposure_is_about_log_normal() {
        let mut stops = stops();
        let centre = mean(stops.iter().copied());
        let variance = mean(stops.iter().map(|v| (v - centre).powi(2)));
        assert!((-2.0..0.0).contains(&centre), "{centre}");
        assert!((1.0..2.5).contains(&variance.sqrt()), "{variance}");
        // 68 % of a normal law lie within one deviation.
        stops.retain(|v| (v - centre).abs() < variance.sqrt());
        let share = stops.len() as f32 / (SIZE[0] * SIZE[1]) as f32;
        assert!((0.6..0.76).contains(&share), "{share}");
    }

    #[test]
    fn neighbours_are_alike() {
        let stops = stops();
        let steps = stops.chunks_exact(SIZE[0]).flat_map(|row| row.windows(2)).map(|w| (w[1] - w[0]).abs());
        let steps: Vec<f32> = steps.collect();
        let step = mean(steps.iter().copied());
        assert!((0.01..0.1).contains(&step), "texture, but little: {step}");
        let edges = steps.iter().filter(|&&v| v > 0.5).count() as f32 / steps.len() as f32;
        assert!((0.001..0.03).contains(&edges), "{edges}");
    }

    #[test]
    fn some_highlights_are_beyond_six_stops() {
        let stops = stops();
        let share = stops.iter().filter(|&&v| v > 6.0).count() as f32 / stops.len() as f32;
        assert!((1e-5..1e-2).contains(&share), "{share}");
    }

    #[test]
    fn every_call_gives_the_same() {
        assert_eq!(natural([64, 36]), natural([64, 36]));
        assert!(natural([0, 0]).is_empty());
    }
}
