//! The fixture picture: a still life at dusk, rendered spectrally.
//!
//! A ColorChecker, an 18 % grey card, a step wedge of 14 stops lit from behind at 6500 K, and things that show what film
//! does to colour, under a tungsten key lamp, the evening sky, an opal bulb and a red neon ring. Radiance is carried at
//! the 41 nodes of [`Nodes`] through every reflection; sensors weigh it last. Every shadow is a closed form and nothing
//! is drawn by chance, so the picture has no noise and is the same on every run.
//!
//! Unit: luminance 1 is that of the 6500 K black body of 1 at 560 nm. The grey card sends back 0.18, and step 8 of the wedge
//! is exactly 0.18.

mod camera;
mod dusk;
mod light;
mod palette;
mod shadow;
mod shape;
mod spectrum;
mod still_life;
#[cfg(test)]
mod tests;
mod trace;

use glam::vec3;
use rayon::prelude::*;

use camera::Camera;
use light::{Cache, Path};
use spectrum::NODES;
pub(crate) use spectrum::{Nodes, sample, sensor};
use still_life::{COLOR_CHECKER, GREY_CARD, PATCH, STEP, Scene, TABLE, WEDGE};

/// Reflectances that come from measurement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inputs<'a> {
    /// ColorChecker patches in chart order, 0 to 1.
    pub(crate) color_checker: &'a [Nodes; 24],
}

/// Responses of the sensors: pixels row by row from the top, the sensors of a pixel side by side.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Image {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) responses: Vec<f32>,
}

/// Centres, in pixels (column, row), of the patches of known spectrum.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Patches {
    /// In chart order.
    pub(crate) color_checker: [(usize, usize); 24],
    pub(crate) grey_card: (usize, usize),
    /// From -7 to +7 stops about 0.18.
    pub(crate) wedge: [(usize, usize); 15],
}

/// Renders the picture, `size` being width and height; best at 16:9.
///
/// Each sensor is a row of weights over the nodes: its response is the sum of weight times radiance.
pub(crate) fn render(size: (usize, usize), inputs: &Inputs, sensors: &[Nodes]) -> Image {
    let (width, height) = size;
    let scene = Scene::new(inputs.color_checker);
    let camera = Camera::new(size);
    let see = |i: usize, offset: (f32, f32), cache: &mut Cache| {
        let (x, y) = ((i % width) as f32 + 0.5 + offset.0, (i / width) as f32 + 0.5 + offset.1);
        trace::radiance(&scene, camera.ray(x, y), TABLE, Path::Direct, cache)
    };
    let weigh = |light: &Nodes, pixel: &mut [f32]| {
        for (response, sensor) in pixel.iter_mut().zip(sensors) {
            *response = sensor.iter().zip(light).map(|(w, l)| w * l).sum();
        }
    };
    let mut responses = vec![0.0; width * height * sensors.len()];
    let count = sensors.len().max(1);
    let once: Vec<_> = responses
        .par_chunks_mut(count)
        .enumerate()
        .map(|(i, pixel)| {
            let (light, met) = see(i, (0.0, 0.0), &mut Vec::new());
            weigh(&light, pixel);
            (PROBES.map(|node| light[node]), met)
        })
        .collect();
    let rough = |i: usize| {
        let (x, y) = (i % width, i / width);
        let at = |x: usize, y: usize| &once[y.min(height - 1) * width + x.min(width - 1)];
        let beside = (at(x.saturating_sub(1), y), at(x + 1, y));
        let upright = (at(x, y.saturating_sub(1)), at(x, y + 1));
        let (light, met) = &once[i];
        [beside, upright].iter().any(|(a, b)| a.1 != *met || b.1 != *met || bent(&a.0, light, &b.0))
    };
    // A glint narrower than a sample's share of the pixel asks for a finer lattice.
    let [coarse, fine] = [(13, 5), (55, 34)].map(|(count, step)| camera::offsets(count, step));
    let average = |i: usize, offsets: &[(f32, f32)]| {
        let (mut mean, mut peak, mut cache) = ([0.0; NODES], 0.0_f32, Vec::new());
        for &offset in offsets {
            let light = see(i, offset, &mut cache).0;
            spectrum::add(&mut mean, &light, 1.0 / offsets.len() as f32);
            peak = peak.max(light[PROBES[1]]);
        }
        (mean, peak > 5.0 * mean[PROBES[1]])
    };
    responses.par_chunks_mut(count).enumerate().filter(|(i, _)| rough(*i)).for_each(|(i, pixel)| {
        let (mut light, glint) = average(i, &coarse);
        if glint {
            light = average(i, &fine).0;
        }
        weigh(&light, pixel);
    });
    Image { width, height, responses }
}

/// Where the known patches lie in a picture of a size.
pub(crate) fn patches(size: (usize, usize)) -> Patches {
    let scene = Scene::new(&[[0.0; NODES]; 24]);
    let camera = Camera::new(size);
    let pixel = |card: usize, x: f32, y: f32| {
        let body = &scene.bodies[card];
        camera.pixel(body.origin + body.axes * vec3(x, y, 0.0))
    };
    let patch = |i: usize| ((i % 6) as f32 - 2.5, 1.5 - (i / 6) as f32);
    Patches {
        color_checker: std::array::from_fn(|i| pixel(COLOR_CHECKER, patch(i).0 * PATCH.1, patch(i).1 * PATCH.1)),
        grey_card: pixel(GREY_CARD, 0.0, 0.0),
        wedge: std::array::from_fn(|i| pixel(WEDGE, (i as f32 - 7.0) * STEP.0, 0.0)),
    }
}

/// Nodes by which pixels are compared: 460 nm, 540 nm and 620 nm.
const PROBES: [usize; 3] = [8, 16, 24];

/// Whether light changes unevenly over three pixels.
fn bent(a: &[f32; 3], b: &[f32; 3], c: &[f32; 3]) -> bool {
    const EVEN: f32 = 0.06;
    const DARK: f32 = 2e-4;
    (0..3).any(|n| (a[n] - 2.0 * b[n] + c[n]).abs() > EVEN * a[n].max(b[n]).max(c[n]) + DARK)
}
