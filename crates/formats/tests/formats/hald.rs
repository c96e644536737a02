//! Hald CLUTs.

use onelight_formats::{PngDepth, hald};
use onelight_lut::Lut3d;

use crate::tables::{bent, damage, decoded, nearest_code};

#[test]
fn tables_come_back_to_half_a_code() {
    for depth in [PngDepth::Eight, PngDepth::Sixteen] {
        for size in [4, 9, 25] {
            let table = bent(size);
            let mut file = Vec::new();
            hald::write(&mut file, &table, depth, ["max dE 0.3", "\u{3b4}"]).unwrap();
            let back = hald::read(file.as_slice()).unwrap();
            assert_eq!(back.entries().collect::<Vec<_>>(), nearest_code(&table, depth));
            // Codes are fixed points.
            let mut again = Vec::new();
            hald::write(&mut again, &back, depth, ["max dE 0.3", "\u{3b4}"]).unwrap();
            assert_eq!(again, file);
        }
    }
}

#[test]
fn red_runs_along_the_first_row() {
    let mut file = Vec::new();
    hald::write(&mut file, &Lut3d::identity(4).unwrap(), PngDepth::Eight, [""; 0]).unwrap();
    let (size, pixels) = decoded(&file);
    assert_eq!(size, [8, 8]);
    let third = 85.0 / 255.0;
    assert_eq!(pixels[1], [third, 0.0, 0.0]);
    assert_eq!(pixels[4], [0.0, third, 0.0]);
    assert_eq!(pixels[2 * 8], [0.0, 0.0, third]);
}

/// A look in black and white, which programs write in one channel.
#[test]
fn grey_gives_equal_entries() {
    for (colour, channels) in [(png::ColorType::Grayscale, 1), (png::ColorType::GrayscaleAlpha, 2)] {
        let codes: Vec<u8> = (0..64 * channels).map(|i| (i / channels * 4) as u8).collect();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 8, 8);
        encoder.set_color(colour);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&codes).unwrap();
        writer.finish().unwrap();
        let entries: Vec<[f32; 3]> = hald::read(file.as_slice()).unwrap().entries().collect();
        assert_eq!(entries, (0..64).map(|i| [(4 * i) as f32 / 255.0; 3]).collect::<Vec<_>>());
    }
}

#[test]
fn other_sizes_and_damage_are_refused() {
    let found = hald::write(Vec::new(), &Lut3d::identity(33).unwrap(), PngDepth::Eight, [""; 0]).unwrap_err();
    assert!(found.to_string().contains("found 33, expected the square of a level"), "{found}");
    let mut file = Vec::new();
    hald::write(&mut file, &bent(4), PngDepth::Sixteen, [""; 0]).unwrap();
    damage(&file, |bytes| hald::read(bytes));
}
