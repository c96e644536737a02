//! What TIFF files are found to hold, by what is known of how they were made.

use super::*;

/// A file of the corpus.
fn corpus(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/../../fixtures/corpus/tiff/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn read(name: &str) -> Picture {
    read_bytes(&corpus(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The picture of 32 x 24 pixels that the files of `tifffile` were made from.
fn ramps(most: f32) -> Vec<[f32; 3]> {
    let code = |value: f32| if most > 0.0 { (value * most + 0.5).floor() / most } else { value };
    let pixel = |x: usize, y: usize| [x as f32 / 32.0, y as f32 / 24.0, ((x / 4 + y / 4) % 2) as f32 * 0.8];
    (0..32 * 24).map(|index| pixel(index % 32, index / 32).map(code)).collect()
}

/// A little-endian TIFF by hand: one strip of `data`, and tags of words.
pub(super) fn by_hand(tags: &[(u16, &[u16])], data: &[u8]) -> Vec<u8> {
    let mut tags: Vec<(u16, Vec<u16>)> = tags.iter().map(|(tag, words)| (*tag, words.to_vec())).collect();
    let given = |tag| tags.iter().any(|(given, _)| *given == tag);
    let default = [(259, 1), (273, 8), (277, 1), (279, data.len() as u16)];
    let default: Vec<(u16, Vec<u16>)> =
        default.into_iter().filter(|(tag, _)| !given(*tag)).map(|(tag, word)| (tag, vec![word])).collect();
    tags.extend(default);
    tags.sort();
    let mut file = b"II\x2a\0".to_vec();
    file.extend((8 + data.len() as u32).to_le_bytes());
    file.extend(data);
    file.extend((tags.len() as u16).to_le_bytes());
    let mut beyond = file.len() + 12 * tags.len() + 4;
    let mut values = Vec::new();
    for (tag, words) in tags {
        file.extend([tag.to_le_bytes(), 3_u16.to_le_bytes()].concat());
        file.extend((words.len() as u32).to_le_bytes());
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        if bytes.len() > 4 {
            file.extend((beyond as u32).to_le_bytes());
            beyond += bytes.len();
            values.extend(bytes);
        } else {
            file.extend((0..4).map(|at| bytes.get(at).copied().unwrap_or(0)));
        }
    }
    file.extend([0; 4]);
    file.extend(values);
    file
}

#[test]
fn surplus_channels_leave_the_colours_as_they_are() {
    for (name, most, alpha) in [
        ("surplus-8-lzw.tif", 255.0, false),
        ("surplus-float-lzw.tif", 0.0, false),
        ("alpha-and-spot.tif", 255.0, true),
    ] {
        let picture = read(name);
        assert_same(&picture.rgb, &ramps(most));
        assert_eq!(picture.alpha.is_some(), alpha, "{name}");
        assert!(picture.notes.iter().any(|note| note.contains("left out an extra channel")), "{:?}", picture.notes);
    }
}

/// Each file, the means of its channels, and the colour in column 33 of row 20.
const OTHERS: [(&str, [f64; 3], [f32; 3]); 3] = [
    ("surplus-16-deflate-of-four.tif", [0.680_302_8, 0.648_010_3, 0.692_377_3], [0.773_434, 0.624_994_3, 0.709_819_2]),
    ("surplus-16-deflate-of-five.tif", [0.680_302_8, 0.648_010_3, 0.692_377_3], [0.773_434, 0.624_994_3, 0.709_819_2]),
    ("zstd-float.tif", [0.857_427, 0.726_135_3, 0.727_219_4], [0.773_437_5, 0.625, 0.709_821_46]),
];

/// Means and one pixel as tifffile 2026.3.3 gives them.
#[test]
fn files_of_openimageio_are_read_as_others_read_them() {
    let mean = |picture: &Picture, channel: usize| {
        picture.rgb.iter().map(|rgb| f64::from(rgb[channel])).sum::<f64>() / picture.rgb.len() as f64
    };
    for (name, means, pixel) in OTHERS {
        let picture = read(name);
        assert_eq!((picture.width, picture.height), (64, 48));
        for channel in 0..3 {
            let found = mean(&picture, channel);
            assert!((found - means[channel]).abs() < 1e-6, "{name}, channel {channel}: {found}");
            assert!((picture.rgb[20 * 64 + 33][channel] - pixel[channel]).abs() < 1e-6, "{name}");
        }
    }
}

#[test]
fn the_full_picture_is_read_and_not_the_thumbnail() {
    let picture = read("thumbnail-first.tif");
    assert_same(&picture.rgb, &ramps(65_535.0));
    assert_eq!(picture.notes, ["read page 2 of 2 of the TIFF (those before it are smaller copies or masks)"]);
}

#[test]
fn camera_raw_is_refused_with_the_way_out() {
    let sentence = refusal(&corpus("refused-dng.tif"));
    assert!(sentence.starts_with("found a DNG") && sentence.contains("darktable or RawTherapee"), "{sentence}");
    let sensor = by_hand(&[(256, &[2]), (257, &[2]), (258, &[8]), (262, &[32_803])], &[0; 4]);
    assert!(refusal(&sensor).contains("found a camera raw file"), "{}", refusal(&sensor));
}

#[test]
fn tiles_in_planes_are_whole_tiles() {
    let [planes, tiles] = ["planes.tif", "tiles.tif"].map(read);
    let both = read("tiled-planes.tif");
    assert_eq!((both.width, both.height), (tiles.width, tiles.height));
    // The samples of each file are a ramp over its bytes, i / 7 % 56; a plane of two by two tiles has 1024.
    let sample = |plane: usize, x: usize, y: usize| {
        let at = plane * 1024 + (y / 16 * 2 + x / 16) * 256 + y % 16 * 16 + x % 16;
        (at / 7 % 56) as f32 / 255.0
    };
    for (index, rgb) in both.rgb.iter().enumerate() {
        assert_eq!(*rgb, [0, 1, 2].map(|plane| sample(plane, index % 18, index / 18)), "pixel {index}");
    }
    assert_ne!(planes.rgb, both.rgb);
}

#[test]
fn low_bits_first_are_turned() {
    let tags: [(u16, &[u16]); 5] = [(256, &[3]), (257, &[1]), (258, &[8]), (262, &[1]), (266, &[2])];
    let picture = read_bytes(&by_hand(&tags, &[0b1000_0000, 0b1111_1111, 0b0101_0000])).unwrap();
    assert_eq!(picture.rgb, [[1.0 / 255.0; 3], [1.0; 3], [10.0 / 255.0; 3]]);
}

#[test]
fn palettes_and_few_bits_are_widened() {
    let map: Vec<u16> = (0..48).map(|entry| entry * 1365).collect();
    let palette: [(u16, &[u16]); 5] = [(256, &[3]), (257, &[1]), (258, &[4]), (262, &[3]), (320, &map)];
    let picture = read_bytes(&by_hand(&palette, &[0x0f, 0x70])).unwrap();
    let colour = |index: u16| [index, 16 + index, 32 + index].map(|entry| f32::from(entry * 1365) / 65_535.0);
    assert_eq!(picture.rgb, [0, 15, 7].map(colour));

    let bits: [(u16, &[u16]); 4] = [(256, &[3]), (257, &[2]), (258, &[1]), (262, &[0])];
    let picture = read_bytes(&by_hand(&bits, &[0b0100_0000, 0b1110_0000])).unwrap();
    assert_eq!(picture.rgb.iter().map(|rgb| rgb[0]).collect::<Vec<_>>(), [1.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn what_is_not_read_is_named() {
    let tags = |photometric: u16, compression: u16| {
        by_hand(&[(256, &[1]), (257, &[1]), (258, &[8]), (259, &[compression]), (262, &[photometric])], &[0, 1, 2])
    };
    for (photometric, compression, expected) in [
        (5, 1, "the TIFF's pixels are CMYK or other inks, expected grey, palette or RGB, with or without alpha"),
        (32_845, 1, "SGI LogLuv"),
        (9, 1, "CIE L*a*b*"),
        (1, 7, "the TIFF's compression is JPEG, expected none, LZW, Deflate, PackBits or Zstandard"),
        (6, 7, "the TIFF's compression is JPEG"),
        (1, 4, "fax"),
        (77, 1, "the unknown photometric interpretation 77"),
        (1, 999, "the unknown number 999"),
    ] {
        let sentence = refusal(&tags(photometric, compression));
        assert!(sentence.contains(expected), "{sentence}");
    }
    // LZW of low bits first begins with a byte of 0 and an odd one.
    let old = by_hand(&[(256, &[1]), (257, &[1]), (258, &[8]), (259, &[5]), (262, &[1])], &[0, 1, 2]);
    assert!(refusal(&old).contains("LZW of before 1990"), "{}", refusal(&old));
}

#[test]
fn directories_that_lie_are_refused() {
    assert!(refusal(b"II\x2a\0\xff\xff\0\0").contains("beyond the end of a file of 8 bytes"));
    let short = by_hand(&[(256, &[4]), (257, &[4]), (258, &[8]), (262, &[1])], &[0; 15]);
    assert!(refusal(&short).contains("15 bytes, expected 16"), "{}", refusal(&short));
    let missing = by_hand(&[(256, &[4]), (258, &[8]), (262, &[1])], &[0; 16]);
    assert!(refusal(&missing).contains("tag 257 is missing"), "{}", refusal(&missing));
    // Directories that name each other end.
    let mut ring = by_hand(&[(254, &[1]), (256, &[1]), (257, &[1]), (258, &[8]), (262, &[1])], &[7]);
    let end = ring.len() - 4;
    ring[end..].copy_from_slice(&9_u32.to_le_bytes());
    assert_eq!(read_bytes(&ring).unwrap().rgb, [[7.0 / 255.0; 3]]);
}
