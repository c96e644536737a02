//! Strips.

use onelight_formats::{PngDepth, StripGreen, hald, strip};
use onelight_lut::Lut3d;

use crate::tables::{bent, damage, decoded, nearest_code};

const BOTH: [StripGreen; 2] = [StripGreen::Down, StripGreen::Up];

#[test]
fn tables_come_back_to_half_a_code() {
    for depth in [PngDepth::Eight, PngDepth::Sixteen] {
        for (size, green) in [2, 16, 32].into_iter().flat_map(|size| BOTH.map(|green| (size, green))) {
            let table = bent(size);
            let mut file = Vec::new();
            strip::write(&mut file, &table, depth, green, ["a comment"]).unwrap();
            let back = strip::read(file.as_slice(), green).unwrap();
            assert_eq!(back.entries().collect::<Vec<_>>(), nearest_code(&table, depth));
        }
    }
}

#[test]
fn tiles_lie_as_the_engines_want_them() {
    for (green, black, lime) in [(StripGreen::Down, 0, 15), (StripGreen::Up, 15, 0)] {
        let mut file = Vec::new();
        strip::write(&mut file, &Lut3d::identity(16).unwrap(), PngDepth::Eight, green, [""; 0]).unwrap();
        let (size, pixels) = decoded(&file);
        assert_eq!(size, [256, 16]);
        let at = |x: usize, y: usize| pixels[x + 256 * y];
        assert_eq!(at(0, black), [0.0; 3]);
        assert_eq!(at(15, black), [1.0, 0.0, 0.0]);
        assert_eq!(at(0, lime), [0.0, 1.0, 0.0]);
        assert_eq!(at(240, black), [0.0, 0.0, 1.0]);
    }
}

#[test]
fn other_sizes_and_damage_are_refused() {
    let mut file = Vec::new();
    strip::write(&mut file, &bent(4), PngDepth::Sixteen, StripGreen::Down, [""; 0]).unwrap();
    damage(&file, |bytes| strip::read(bytes, StripGreen::Down));
    let mut hald = Vec::new();
    hald::write(&mut hald, &bent(4), PngDepth::Eight, [""; 0]).unwrap();
    let error = strip::read(hald.as_slice(), StripGreen::Up).unwrap_err();
    assert!(error.to_string().starts_with("size of a LUT strip: found 8 x 8 pixels"), "{error}");
}
