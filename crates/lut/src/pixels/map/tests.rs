use super::*;
use crate::pixels::Channels;
use crate::{Interpolation, Lut3d, Shaper};
use half::f16;

fn lut() -> PlainLut {
    PlainLut::new(Shaper::log2(0.02, 4.0).unwrap(), Lut3d::identity(9).unwrap(), Interpolation::Tetrahedral)
}

#[test]
fn rows_may_lie_apart_and_alpha_goes_through() {
    let lut = lut();
    let from: Vec<f32> = (0..2 * 20).map(|i| i as f32 * 0.1).collect();
    let mut to = vec![7u8; 2 * 16];
    let pixels = Pixels::with_stride(&from, Channels::Rgba, [4, 2], 20).unwrap();
    lut.map(&pixels, &mut PixelsMut::with_stride(&mut to, Channels::Rgba, [4, 2], 16).unwrap()).unwrap();
    let second = lut.apply([2.4, 2.5, 2.6]).map(u8::from_f32);
    assert_eq!(to[20..23], second);
    assert_eq!(to[3], u8::from_f32(0.3));

    let mut wide = vec![7u16; 2 * 14];
    lut.map(&pixels, &mut PixelsMut::with_stride(&mut wide, Channels::Rgb, [4, 2], 14).unwrap()).unwrap();
    assert_eq!(wide[17..20], lut.apply([2.4, 2.5, 2.6]).map(u16::from_f32));
    assert_eq!(wide[12..14], [7, 7], "between the rows");
}

#[test]
fn in_place_is_the_same() {
    let lut = lut();
    let from: Vec<f16> = (0..300).map(|i| f16::from_f32(i as f32 * 0.02)).collect();
    let mut to = from.clone();
    lut.map_in_place(&mut PixelsMut::new(&mut to, Channels::Rgb, [10, 10]).unwrap());
    let mut other = vec![f16::ZERO; 300];
    let pixels = Pixels::new(&from, Channels::Rgb, [10, 10]).unwrap();
    lut.map(&pixels, &mut PixelsMut::new(&mut other, Channels::Rgb, [10, 10]).unwrap()).unwrap();
    assert_eq!(to, other);
}

#[test]
fn layouts_are_checked() {
    let samples = [0.0f32; 24];
    assert!(Pixels::new(&samples, Channels::Rgba, [3, 2]).is_ok());
    assert!(Pixels::new(&samples, Channels::Rgba, [0, 0]).is_ok());
    for (size, stride) in [([4, 2], 16), ([3, 2], 11), ([3, 3], 12), ([usize::MAX, 1], 12), ([1, usize::MAX], 4)] {
        assert!(Pixels::with_stride(&samples, Channels::Rgba, size, stride).is_err(), "{size:?} {stride}");
    }
    let mut to = [0u8; 24];
    let small = Pixels::new(&samples, Channels::Rgba, [2, 2]).unwrap();
    let error = lut().map(&small, &mut PixelsMut::new(&mut to, Channels::Rgba, [3, 2]).unwrap()).unwrap_err();
    assert_eq!(error.to_string(), "size of the picture to write: found 3x2, expected 2x2 as in the one to read");
}
