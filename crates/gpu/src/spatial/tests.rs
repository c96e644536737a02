//! Noise on a card.

use onelight::spatial::{AmountGranularity, FilmFormat, Frame, Grain, GrainSettings};

use super::*;
use crate::headless::{Headless, HeadlessSettings};

/// Rows of noise as the card makes them, correlated along y as the last step does, against the field of the CPU.
#[test]
fn noise_is_that_of_the_processor_to_the_bit() {
    let wanted = std::env::var("ONELIGHT_REQUIRE_GPU").ok().filter(|name| !name.is_empty() && name != "1");
    let settings = HeadlessSettings { adapter: wanted.as_deref().unwrap_or_default(), ..HeadlessSettings::default() };
    let Ok(gpu) = Headless::open(&settings) else {
        assert!(std::env::var("ONELIGHT_REQUIRE_GPU").is_err(), "no adapter");
        return;
    };
    let film = onelight::stock("kodak-5219").unwrap();
    let pitch = FilmFormat::Super35.pitch(6000, 1.0).unwrap();
    let grain = Grain::new(
        AmountGranularity::of_stock(&film).unwrap(),
        pitch,
        GrainSettings { seed: 9, ..GrainSettings::default() },
    );
    let frame = Frame::new([70, 33], pitch).unwrap().at([-5, 4_000]).numbered(7);
    let numbers = SpatialStage::new(frame).with_grain(grain.unwrap()).unwrap().numbers();
    let (device, queue) = (&gpu.device, &gpu.queue);
    let mut steps = Vec::new();
    let (_, _, rows, ..) = Maker { device, queue, size: [70, 33] }.grain(&numbers, &mut steps);
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    steps.iter().for_each(|step| step.run(&mut pass));
    drop(pass);
    queue.submit([encoder.finish()]);
    let bytes = gpu.read_back(rows.texture()).unwrap();
    let words: Vec<i32> = bytes.as_chunks().0.iter().map(|word| i32::from_ne_bytes(*word)).collect();
    let grain = numbers.grain.unwrap();
    let taps = &grain.taps[1];
    let field = grain.field([-5, 4_000], [70, 33], 7);
    for (i, expected) in field.iter().enumerate() {
        let (x, y) = (i % 70, i / 70 + taps.len() - 1);
        let at = |y: usize, layer: usize| words[4 * (y * 70 + x) + layer];
        let found: [i32; 3] = std::array::from_fn(|layer| {
            let beside = (1..).zip(&taps[1..]).map(|(d, tap)| tap * (at(y - d, layer) + at(y + d, layer)));
            taps[0] * at(y, layer) + beside.sum::<i32>()
        });
        assert_eq!(found, *expected, "pixel {i}");
    }
}
