//! JPEG and Radiance pictures, and pictures that are stored turned.

use super::*;

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/../../fixtures/corpus/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn corpus(name: &str) -> Picture {
    read_bytes(&bytes(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Means and the codes at column 20 of row 12, as libjpeg-turbo (in Pillow 12) decodes them. Decoders may round and
/// interpolate by themselves: one or two codes.
#[test]
fn jpegs_are_what_others_see() {
    for (name, means, codes) in [
        ("baseline", [123.509, 122.275, 128.001], [160.0, 128.0, 129.0]),
        ("progressive", [123.546, 122.233, 128.052], [160.0, 129.0, 127.0]),
        ("subsampled", [123.841, 122.051, 128.122], [159.0, 129.0, 131.0]),
        ("grey", [123.285, 123.285, 123.285], [138.0, 138.0, 138.0]),
    ] {
        let picture = corpus(&format!("jpeg/{name}.jpg"));
        assert_eq!((picture.width, picture.height, picture.source), (32, 24, Source::Jpeg));
        for channel in 0..3 {
            let values = picture.rgb.iter().map(|rgb| f64::from(rgb[channel]) * 255.0);
            let mean = values.sum::<f64>() / picture.rgb.len() as f64;
            assert!((mean - means[channel]).abs() < 0.5, "{name}, channel {channel}: {mean}");
            let code = picture.rgb[12 * 32 + 20][channel] * 255.0;
            assert!((code - codes[channel]).abs() < 3.0, "{name}, channel {channel}: {code}");
        }
    }
}

#[test]
fn jpegs_that_are_not_read_are_named_and_cut_ones_refused() {
    assert!(refusal(&bytes("jpeg/refused-cmyk.jpg")).starts_with("the JPEG is of CMYK inks"));
    for name in ["baseline", "progressive"] {
        let whole = bytes(&format!("jpeg/{name}.jpg"));
        let frame = whole.windows(2).position(|pair| matches!(pair, [0xff, 0xc0 | 0xc2])).unwrap();
        for (marker, expected) in [(0xc9, "arithmetic-coded"), (0xc3, "lossless")] {
            let mut other = whole.clone();
            other[frame + 1] = marker;
            assert!(refusal(&other).contains(expected), "{}", refusal(&other));
        }
        for length in [3, 20, 200, whole.len() / 2, whole.len() - 40] {
            assert!(read_bytes(&whole[..length]).is_err(), "{name} of {length} bytes");
        }
    }
}

#[test]
fn pictures_come_upright() {
    // Ramps to the right in red and down in green; stored turned a quarter, the ramp in red goes up.
    for name in ["tiff/orientation-6.tif", "jpeg/orientation-6.jpg"] {
        let picture = corpus(name);
        assert_eq!((picture.width, picture.height), (24, 32), "{name}");
        let at = |x: usize, y: usize| picture.rgb[y * 24 + x];
        assert!(at(23, 0)[1] < 0.05 && at(0, 0)[1] > 0.9, "{name}: rows run from right to left");
        assert!(at(5, 31)[0] > 0.9 && at(5, 0)[0] < 0.05, "{name}: columns run down");
        assert_eq!(picture.notes, ["turned the picture upright, as the file says"]);
    }
    let png = corpus("png/exif-orientation-6.png");
    assert_eq!((png.width, png.height), (6, 5));
}

/// The eight ways to store one picture.
#[test]
fn every_orientation_is_undone() {
    let upright: Vec<u8> = (0..6).collect();
    // 2 columns, 3 rows: 0 1 / 2 3 / 4 5, as each case stores them.
    let cases: [(u16, [u16; 2], [u8; 6]); 8] = [
        (1, [2, 3], [0, 1, 2, 3, 4, 5]),
        (2, [2, 3], [1, 0, 3, 2, 5, 4]),
        (3, [2, 3], [5, 4, 3, 2, 1, 0]),
        (4, [2, 3], [4, 5, 2, 3, 0, 1]),
        (5, [3, 2], [0, 2, 4, 1, 3, 5]),
        (6, [3, 2], [1, 3, 5, 0, 2, 4]),
        (7, [3, 2], [5, 3, 1, 4, 2, 0]),
        (8, [3, 2], [4, 2, 0, 5, 3, 1]),
    ];
    for (number, [width, height], stored) in cases {
        let tags: [(u16, &[u16]); 5] = [(256, &[width]), (257, &[height]), (258, &[8]), (262, &[1]), (274, &[number])];
        let picture = read_bytes(&super::tiff::by_hand(&tags, &stored)).unwrap();
        let found: Vec<u8> = picture.rgb.iter().map(|rgb| (rgb[0] * 255.0) as u8).collect();
        assert_eq!((picture.width, picture.height, found), (2, 3, upright.clone()), "{number}");
    }
}

/// A picture of 12 x 5 pixels: a ramp of red, of green, and 1000 / (x + 1) in blue.
#[test]
fn radiance_pictures_are_read_to_the_precision_they_have() {
    let light = |x: usize, y: usize| [x as f32 * 0.25, y as f32 * 2.0, 1000.0 / (x + 1) as f32];
    let expected: Vec<[f32; 3]> = (0..60).map(|index| light(index % 12, index / 12)).collect();
    let near = |found: &[[f32; 3]], expected: &mut dyn Iterator<Item = [f32; 3]>| {
        for (found, expected) in found.iter().zip(expected) {
            // Eight bits of the largest, cut off.
            let step = expected.into_iter().fold(0.0, f32::max) / 128.0;
            assert!((0..3).all(|c| found[c] <= expected[c] && expected[c] - found[c] < step), "{found:?} {expected:?}");
        }
    };
    near(&corpus("hdr/runs.hdr").rgb, &mut expected.iter().copied());
    near(&corpus("hdr/flat.hdr").rgb, &mut expected.iter().copied());
    // Exposures multiply: 2 times 4.
    near(&corpus("hdr/exposed.hdr").rgb, &mut expected.iter().map(|rgb| rgb.map(|v| v / 8.0)));
    let turned = corpus("hdr/upside-down.hdr");
    near(&turned.rgb, &mut (0..60).map(|index| light(index % 12, 4 - index / 12)));
    assert_eq!(turned.source, Source::RadianceHdr);
}

#[test]
fn radiance_pictures_that_lie_are_refused() {
    let head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n";
    for (tail, expected) in [
        (&b"\x02\x02\x00\x08"[..], "runs that do not fit"),
        (b"\x02\x02\x00\x09\x8a\x07", "runs that do not fit"),
        (b"\x02\x02\x00\x09\x00", "runs that do not fit"),
        (b"\x01\x01\x01\x01", "runs that do not fit"),
        (b"\x02\x02\x00\x09\x89", "too early"),
    ] {
        let sentence = refusal(&[&head[..], tail].concat());
        assert!(sentence.contains(expected), "{tail:?}: {sentence}");
    }
    // Of the old form: a pixel, and eight more of it.
    let old = read_bytes(&[&head[..], &[128, 64, 0, 129, 1, 1, 1, 8]].concat()).unwrap();
    assert_eq!(old.rgb, [[1.0, 0.5, 0.0]; 9]);
    assert!(refusal(b"#?RADIANCE\nFORMAT=other\n\n-Y 1 +X 9\n").contains("format is `other`"));
    assert!(refusal(b"#?RADIANCE\n\n-Y 1 +Z 9\n").contains("size is `-Y 1 +Z 9`"));
    assert!(refusal(b"#?RADIANCE\n\n-Y 30000 +X 8000\n").contains("cannot hold"));
}
