//! Which channels of an OpenEXR file are taken for the picture.

use ::exr::prelude::{Compression, FlatSamples};

use super::{
    exr::{Stored, file, layer},
    *,
};

const SIZE: [usize; 2] = [3, 2];

/// A file of one part, each of whose channels holds one value.
fn of_channels(channels: &[(&str, f32)]) -> Vec<u8> {
    file(vec![part(None, channels)])
}

fn part(
    name: Option<&str>,
    channels: &[(&str, f32)],
) -> ::exr::prelude::Layer<::exr::prelude::AnyChannels<FlatSamples>> {
    let channels: Vec<(&str, FlatSamples)> =
        channels.iter().map(|(name, value)| (*name, FlatSamples::F32(vec![*value; SIZE[0] * SIZE[1]]))).collect();
    layer(name, SIZE, Stored::lines(Compression::ZIP16), &channels)
}

fn colour(bytes: &[u8]) -> [f32; 3] {
    read_bytes(bytes).unwrap_or_else(|error| panic!("{error}")).rgb[0]
}

fn selected(bytes: &[u8], layer: Option<&str>, part: Option<&str>) -> Result<[f32; 3], Error> {
    let selection = Selection { layer: layer.map(str::to_owned), part: part.map(PartChoice::from) };
    let mut picture = open_selected(Cursor::new(bytes), "", Limits::default(), &selection)?;
    Ok(picture.next_band()?.unwrap().rgb()[0])
}

fn corpus(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/../../fixtures/corpus/exr/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The names that Blender, Arnold and others give, in files of many layers.
#[test]
fn the_finished_picture_is_read_and_not_a_part_of_its_light() {
    let layered = |layers: &[&str]| {
        let names: Vec<String> =
            layers.iter().flat_map(|layer| ["B", "G", "R"].map(|channel| format!("{layer}.{channel}"))).collect();
        let values = (1..=layers.len()).flat_map(|number| [number as f32; 3]);
        let channels: Vec<(&str, f32)> = names.iter().map(String::as_str).zip(values).collect();
        of_channels(&channels)
    };
    for (layers, expected) in [
        (&["ViewLayer.AO", "ViewLayer.Combined", "ViewLayer.DiffCol"][..], 2.0),
        (&["albedo", "color"], 2.0),
        (&["beauty", "rgba"], 1.0),
        (&["C", "diffuse", "specular"], 1.0),
        (&["CryptoObject00", "left", "right"], 2.0),
        (&["Normal", "RGBA"], 2.0),
        (&["View Layer.Shadow", "View Layer.Combined"], 2.0),
    ] {
        let bytes = layered(layers);
        assert_eq!(colour(&bytes), [expected; 3], "{layers:?}");
        let note = &read_bytes(&bytes).unwrap().notes[0];
        assert!(layers.iter().all(|layer| note.contains(&format!("`{layer}`"))), "{note}");
        // Any of them can be asked for, by the whole name or its last word.
        for (number, layer) in (1..).zip(layers) {
            for name in [layer, layer.rsplit('.').next().unwrap(), &layer.to_lowercase()] {
                assert_eq!(selected(&bytes, Some(name), None).unwrap(), [number as f32; 3], "{name}");
            }
        }
    }
    let sentence = refusal(&layered(&["ViewLayer.AO", "ViewLayer.Normal"]));
    assert!(
        sentence.contains("`ViewLayer.AO`, `ViewLayer.Normal`") && sentence.contains("layer to be chosen"),
        "{sentence}"
    );
}

#[test]
fn a_part_is_chosen_by_its_number_or_name() {
    let rgb = |value| [("R", value), ("G", value), ("B", value)];
    let bytes =
        file(vec![part(Some("albedo"), &rgb(1.0)), part(Some("beauty"), &rgb(2.0)), part(Some("glow"), &rgb(3.0))]);
    assert_eq!(colour(&bytes), [2.0; 3]);
    for (choice, expected) in [("1", 1.0), ("albedo", 1.0), ("3", 3.0), ("Glow", 3.0)] {
        assert_eq!(selected(&bytes, None, Some(choice)).unwrap(), [expected; 3], "{choice}");
    }
    assert_eq!(selected(&bytes, Some("glow"), None).unwrap(), [3.0; 3]);
    for choice in ["0", "4", "shine"] {
        let sentence = selected(&bytes, None, Some(choice)).unwrap_err().to_string();
        assert_eq!(
            sentence,
            format!("there is no part {choice}, found the parts 1 (`albedo`), 2 (`beauty`), 3 (`glow`)")
        );
    }
    let sentence = selected(&bytes, Some("shine"), None).unwrap_err().to_string();
    assert_eq!(sentence, "there is no layer `shine` that makes a picture, found `albedo`, `beauty`, `glow`");
}

#[test]
fn words_and_small_letters_are_channels_too() {
    for name in ["small-letters.exr", "words.exr"] {
        let picture = read_bytes(&corpus(name)).unwrap();
        let expected = |x: usize, y: usize| [x as f32 / 32.0, y as f32 / 24.0, (x + y) as f32 / 56.0];
        let expected: Vec<[f32; 3]> = (0..32 * 24).map(|index| expected(index % 32, index / 32)).collect();
        assert_same(&picture.rgb, &expected);
    }
}

#[test]
fn a_lone_channel_is_grey() {
    let picture = read_bytes(&corpus("lone-channel.exr")).unwrap();
    assert!(picture.rgb.iter().all(|[r, g, b]| r == g && g == b) && picture.rgb.iter().any(|rgb| rgb[0] > 0.0));
    assert_eq!(picture.notes, ["read the only channel, `V`, as grey"]);
    assert_eq!(picture.primaries, Some(Chromaticities::BT709)); // by its colorInteropID
    let with_alpha = read_bytes(&of_channels(&[("I", 0.25), ("A", 0.5)])).unwrap();
    assert_eq!((with_alpha.rgb[0], with_alpha.alpha.unwrap()[0]), ([0.5; 3], 0.5));
    assert!(refusal(&of_channels(&[("R", 1.0), ("G", 1.0)])).contains("found the channels G, R"));
}

#[test]
fn xyz_is_light_without_a_layer_and_a_direction_with_one() {
    let picture = read_bytes(&of_channels(&[("X", 1.0), ("Y", 2.0), ("Z", 3.0)])).unwrap();
    assert_eq!((picture.rgb[0], picture.primaries), ([1.0, 2.0, 3.0], Some(Chromaticities::XYZ)));
    assert!(refusal(&corpus("refused-normal.exr")).contains("N.X, N.Y, N.Z, Z"));
    // Beside colours they are left alone.
    let both = of_channels(&[("R", 1.0), ("G", 2.0), ("B", 3.0), ("X", 9.0), ("Y", 9.0), ("Z", 9.0)]);
    assert_eq!(colour(&both), [1.0, 2.0, 3.0]);
}

/// Pixels as `RgbaInputFile` of OpenEXR 3.1.5 gives them, which rounds to half floats in between: an eleven-bit significand.
#[test]
fn luminance_and_chroma_make_colours() {
    for name in ["chroma-no.exr", "chroma-piz.exr", "chroma-rle.exr", "chroma-zips.exr", "chroma-dwaa.exr"] {
        let picture = read_bytes(&corpus(name)).unwrap();
        assert_eq!((picture.width, picture.height), (20, 34));
        for (y, x, expected) in [
            (5, 7, [0.478_271_5, 0.159_912_1, 0.497_070_3]),
            (3, 12, [0.697_265_6, 0.122_619_6, 0.492_187_5]),
            (25, 13, [0.255_371_1, 0.249_267_6, 0.241_455_1]),
            (33, 19, [1.043_945_3, 0.828_613_3, 0.405_761_7]),
            (15, 6, [0.933_593_8, 0.090_332, 0.089_599_6]),
        ] {
            let found = picture.rgb[y * 20 + x];
            let near = |channel: usize| (found[channel] - expected[channel]).abs() < 1e-3;
            assert!((0..3).all(near), "{name}, row {y}, column {x}: {found:?}");
        }
        assert_eq!(picture.notes, ["made red, green and blue of luminance and chroma (Y, RY and BY)"]);
    }
    let sentence = refusal(&corpus("refused-chroma-b44.exr"));
    assert!(sentence.starts_with("found B44 with subsampled chroma as compression, expected none"), "{sentence}");
}

#[test]
fn what_is_packed_in_a_later_way_is_named() {
    let expected = "found Zstandard compression, expected none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA or DWAB";
    assert_eq!(refusal(&corpus("refused-zstd.exr")), expected);
}
