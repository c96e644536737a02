//! Laws of the whole module: what is written is read again, and what is broken is refused.

mod damage;
mod exr;
mod plain;
mod refusals;

use std::io::Cursor;

use super::*;

/// A picture that compresses, with a value in it that few things survive.
fn sample(width: usize, height: usize) -> Picture {
    let mut rgb: Vec<[f32; 3]> = (0..width * height)
        .map(|index| {
            let (x, y) = ((index % width) as f32, (index / width) as f32);
            [x / width as f32, (0.3 * x).sin() * 8.0 - 1.0, y * 0.125]
        })
        .collect();
    if let Some(colour) = rgb.get_mut(width + 1) {
        *colour = [f32::INFINITY, f32::NAN, -3.5];
    }
    Picture::opaque(width, height, rgb, Source::Exr)
}

fn read_bytes(bytes: &[u8]) -> Result<Picture> {
    read_from(Cursor::new(bytes), bytes.len() as u64, &Limits::default())
}

/// The sentence a file is refused with.
fn refusal(bytes: &[u8]) -> String {
    let sentence = read_bytes(bytes).expect_err("the file should be refused").to_string();
    assert!(!sentence.contains('\n') && !sentence.is_empty(), "{sentence:?}");
    sentence
}

/// Equal to the bit, NaN included.
fn assert_same(a: &[[f32; 3]], b: &[[f32; 3]]) {
    assert_eq!(a.len(), b.len());
    for (index, (a, b)) in a.iter().zip(b).enumerate() {
        assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits), "pixel {index}: {a:?} and {b:?}");
    }
}

/// A small generator with a fixed start, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }
}
