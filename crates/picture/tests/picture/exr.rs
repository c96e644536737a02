use ::exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, Levels,
    LineOrder, ReadChannels as _, ReadLayers as _, Text, Vec2, WritableImage, f16,
};

use super::*;

/// How a test file is stored.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stored {
    pub(super) compression: Compression,
    pub(super) blocks: Blocks,
    pub(super) order: LineOrder,
}

impl Stored {
    pub(super) fn lines(compression: Compression) -> Self {
        Self { compression, blocks: Blocks::ScanLines, order: LineOrder::Increasing }
    }

    pub(super) fn tiles(compression: Compression) -> Self {
        Self { compression, blocks: Blocks::Tiles(Vec2(16, 8)), order: LineOrder::Increasing }
    }
}

pub(super) const COMPRESSIONS: [Compression; 10] = [
    Compression::Uncompressed,
    Compression::RLE,
    Compression::ZIP1,
    Compression::ZIP16,
    Compression::PIZ,
    Compression::PXR24,
    Compression::B44,
    Compression::B44A,
    Compression::DWAA(None),
    Compression::DWAB(None),
];

pub(super) fn layer(
    name: Option<&str>,
    size: [usize; 2],
    stored: Stored,
    channels: &[(&str, FlatSamples)],
) -> Layer<AnyChannels<FlatSamples>> {
    let channels = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
    let encoding = Encoding { compression: stored.compression, blocks: stored.blocks, line_order: stored.order };
    let attributes = LayerAttributes { layer_name: name.map(Text::from), ..Default::default() };
    Layer::new((size[0], size[1]), attributes, encoding, AnyChannels::sort(channels))
}

pub(super) fn file(layers: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let size = layers[0].size;
    let image = Image::empty(::exr::prelude::ImageAttributes::with_size(size));
    let image =
        Image { attributes: image.attributes, layer_data: layers.into_iter().collect::<::exr::prelude::Layers<_>>() };
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

pub(super) fn floats(picture: &Picture, channel: usize) -> FlatSamples {
    FlatSamples::F32(picture.rgb.iter().map(|colour| colour[channel]).collect())
}

pub(super) fn halves(picture: &Picture, channel: usize) -> FlatSamples {
    FlatSamples::F16(picture.rgb.iter().map(|colour| f16::from_f32(colour[channel])).collect())
}

fn write(picture: &Picture, texts: &[(&str, &str)]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_exr(&mut bytes, texts).unwrap();
    bytes.into_inner()
}

#[test]
fn written_pictures_are_read_again_to_the_bit() {
    let mut picture = sample(37, 21);
    assert_same(&read_bytes(&write(&picture, &[])).unwrap().rgb, &picture.rgb);

    picture.primaries =
        Some(Chromaticities { red: [0.68, 0.32], green: [0.265, 0.69], blue: [0.15, 0.06], white: [0.3127, 0.329] });
    for windows in [
        Windows { data_origin: [-5, -9], display_origin: [0, 0], display_size: [20, 10], pixel_aspect: 2.0 },
        Windows { data_origin: [7, 3], display_origin: [-4, -4], display_size: [90, 80], pixel_aspect: 1.0 },
    ] {
        picture.windows = windows;
        let again = read_bytes(&write(&picture, &[("Software", "x"), ("onelight look", "day")])).unwrap();
        assert_same(&again.rgb, &picture.rgb);
        assert_eq!((again.windows, again.primaries), (windows, picture.primaries));
        assert_eq!((again.source, again.alpha), (Source::Exr, None));
    }
}

#[test]
fn windows_that_the_format_cannot_say_are_refused() {
    let huge = usize::MAX;
    for windows in [
        Windows { display_size: [0, 2], ..Windows::of_size(2, 2) },
        Windows::of_size(huge, 2),
        Windows { data_origin: [i32::MAX, 0], ..Windows::of_size(2, 2) },
        Windows { data_origin: [0, i32::MIN], ..Windows::of_size(2, 2) },
        Windows { display_origin: [i32::MAX, 0], ..Windows::of_size(2, 2) },
        Windows { pixel_aspect: f32::NAN, ..Windows::of_size(2, 2) },
    ] {
        let picture = Picture { windows, ..sample(2, 2) };
        let error = picture.write_exr(Cursor::new(Vec::new()), &[]).unwrap_err();
        assert!(error.is_unwritable() && !error.to_string().contains('\n'), "{windows:?}: {error}");
    }
    for [width, height] in [[huge, 1], [1, huge], [huge, huge], [0, 1]] {
        let description = Description::new(width, height, Channels::Rgba, Source::Exr);
        let fill = |sink: &mut dyn BandSink| {
            sink.write(BandView { top: 0, width, rgb: &[[0.5; 3]; 3], alpha: Some(&[1.0; 3]) })
        };
        assert!(write_exr(Cursor::new(Vec::new()), &description, &[], fill).unwrap_err().is_unwritable());
        assert!(write_png(Vec::new(), &description, PngSettings::default(), &[], fill).unwrap_err().is_unwritable());
        let one = Windows::of_size(1, 1);
        let shown = Description { windows: one, ..description };
        assert!(write_png(Vec::new(), &shown, PngSettings::default(), &[], fill).is_err());
    }
}

#[test]
fn an_impossible_pixel_aspect_is_one() {
    let mut bytes = write(&sample(2, 2), &[]);
    let head = b"pixelAspectRatio\0float\0\x04\0\0\0";
    let at = bytes.windows(head.len()).position(|window| window == head).unwrap() + head.len();
    for aspect in [f32::NAN, 0.0, -1.0, 1e30] {
        bytes[at..at + 4].copy_from_slice(&aspect.to_le_bytes());
        let picture = read_bytes(&bytes).unwrap();
        assert_eq!((picture.windows.pixel_aspect, picture.notes.len()), (1.0, 1));
    }
}

#[test]
fn texts_are_attributes() {
    let texts = [("Software", "onelight 1"), ("onelight look", "day"), ("onelight job", "a1")];
    let bytes = write(&sample(2, 2), &texts);
    // The same file each time.
    (0..16).for_each(|_| assert!(write(&sample(2, 2), &texts) == bytes));
    let third = sample(2, 2).write_exr(Cursor::new(Vec::new()), &[&texts[..], &[("z", "z")]].concat());
    assert!(third.unwrap_err().to_string().contains("two at most"));
    for attribute in [&b"software\0string\0\x0a\0\0\0onelight 1"[..], b"onelight look\0string\0\x03\0\0\0day"] {
        assert!(bytes.windows(attribute.len()).any(|window| window == attribute));
    }
    let error = sample(2, 2).write_exr(Cursor::new(Vec::new()), &[("k", "\u{4e00}")]).unwrap_err();
    assert!(error.to_string().contains("Latin-1"));
}

#[test]
fn colour_is_premultiplied_in_the_file_and_straight_in_memory() {
    let colour = [0.8, -2.0, 1000.0];
    // What no coverage can divide keeps its value both ways.
    let alphas = [1.0, 0.5, 0.1, 3.0, 0.0, -0.5, f32::NAN, f32::INFINITY, 1e-42];
    let mut picture = sample(alphas.len(), 1);
    picture.rgb = vec![colour; alphas.len()];
    picture.alpha = Some(alphas.to_vec());
    let bytes = write(&picture, &[]);

    let stored = ::exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    let stored = stored.first_valid_layer().all_attributes().from_buffered(Cursor::new(&bytes)).unwrap();
    let red = &stored.layer_data.channel_data.list[3];
    assert_eq!(red.name.to_string(), "R");
    let red: Vec<f32> = red.sample_data.values_as_f32().collect();
    assert_eq!(red[..6], [0.8, 0.8 * 0.5, 0.8 * 0.1, 0.8 * 3.0, 0.8, 0.8]);

    let again = read_bytes(&bytes).unwrap();
    for (index, found) in again.rgb.iter().enumerate() {
        for channel in 0..3 {
            let relative = (found[channel] / colour[channel] - 1.0).abs();
            // One rounding of the product and one of the quotient.
            assert!(relative <= 2.0 * f32::EPSILON, "alpha {}: {found:?}", alphas[index]);
        }
    }
    let bits = |alphas: &[f32]| alphas.iter().map(|alpha| alpha.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&again.alpha.unwrap()), bits(&alphas));
}

#[test]
fn every_compression_and_layout_gives_the_same_picture() {
    let mut picture = sample(37, 45);
    // B44A and DWA do not keep NaN, and blocks of both signs lose much; halves, so that the lossless ones are exact.
    picture.rgb[38] = [2.0, 0.5, 0.25];
    for value in picture.rgb.as_flattened_mut() {
        *value = f16::from_f32(value.abs() + 0.5).to_f32();
    }
    for compression in COMPRESSIONS {
        let orders = [LineOrder::Increasing, LineOrder::Decreasing];
        let lines = orders.map(|order| Stored { order, ..Stored::lines(compression) });
        let tiles =
            [LineOrder::Increasing, LineOrder::Unspecified].map(|order| Stored { order, ..Stored::tiles(compression) });
        for stored in lines.into_iter().chain(tiles) {
            for channel in [halves, floats] {
                let channels = [("R", channel(&picture, 0)), ("G", channel(&picture, 1)), ("B", channel(&picture, 2))];
                let bytes = file(vec![layer(None, [37, 45], stored, &channels)]);
                let again = read_bytes(&bytes).unwrap_or_else(|error| panic!("{stored:?}: {error}"));
                if compression.may_loose_data() {
                    let far = picture.rgb.as_flattened().iter().zip(again.rgb.as_flattened());
                    let far = far.map(|(a, b)| (a - b).abs() / (a.abs() + 0.5)).fold(0.0, f32::max);
                    assert!(far < 0.1, "{stored:?}: off by {far}");
                } else {
                    assert_same(&again.rgb, &picture.rgb);
                }
                assert!(again.notes.is_empty());
            }
        }
    }
}

#[test]
fn integers_and_grey_are_read() {
    let count = |scale: u32| FlatSamples::U32((0..6).map(|value| value * scale).collect());
    let stored = Stored::lines(Compression::ZIP16);
    let picture =
        read_bytes(&file(vec![layer(None, [3, 2], stored, &[("R", count(1)), ("G", count(10)), ("B", count(100))])]));
    assert_eq!(picture.unwrap().rgb[5], [5.0, 50.0, 500.0]);

    let grey = read_bytes(&file(vec![layer(None, [3, 2], stored, &[("Y", count(7)), ("Z", count(1))])])).unwrap();
    assert_eq!(grey.rgb[2], [14.0; 3]);
    assert_eq!(grey.notes, ["read the luminance channel Y as grey"]);
}

#[test]
fn the_layer_without_a_name_comes_first_and_else_the_first_whole_one() {
    let value = |value: f32| FlatSamples::F32(vec![value; 4]);
    let stored = Stored::lines(Compression::PIZ);
    let named: Vec<(&str, FlatSamples)> = vec![
        ("a.R", value(1.0)),
        ("b.x.B", value(4.0)),
        ("b.x.G", value(3.0)),
        ("b.x.R", value(2.0)),
        ("c.B", value(9.0)),
        ("c.G", value(9.0)),
        ("c.R", value(9.0)),
        ("A", value(0.5)), // not of the layer
    ];
    let picture = read_bytes(&file(vec![layer(None, [2, 2], stored, &named)])).unwrap();
    assert_eq!((picture.rgb[3], picture.alpha), ([2.0, 3.0, 4.0], None));
    assert!(picture.notes[0].contains("`b.x`"), "{:?}", picture.notes);

    let mut all = named;
    all.extend([("R", value(5.0)), ("G", value(6.0)), ("B", value(7.0))]);
    let picture = read_bytes(&file(vec![layer(None, [2, 2], stored, &all)])).unwrap();
    assert_eq!((picture.rgb[0], picture.alpha.map(|alpha| alpha[0])), ([10.0, 12.0, 14.0], Some(0.5)));
    assert_eq!(picture.notes, ["read the channels without a layer name; there are also `b.x`, `c`"]);
}

#[test]
fn the_first_part_with_colour_is_read() {
    let value = |value: f32, count: usize| FlatSamples::F32(vec![value; count]);
    let rgb = |value_: f32| [("R", value(value_, 600)), ("G", value(value_, 600)), ("B", value(value_, 600))];
    let parts = vec![
        layer(
            Some("depth"),
            [30, 20],
            Stored::lines(Compression::ZIP1),
            &[("Z", value(9.0, 600)), ("Y", value(8.0, 600))],
        ),
        layer(Some("beauty"), [30, 20], Stored::tiles(Compression::ZIP1), &rgb(1.0)),
        layer(Some("glow"), [30, 20], Stored::lines(Compression::ZIP1), &rgb(2.0)),
    ];
    let picture = read_bytes(&file(parts)).unwrap();
    assert!(picture.rgb.iter().all(|colour| *colour == [1.0; 3]));
    assert_eq!(picture.notes, ["read part 2 (`beauty`) of 3 parts; there are also `depth`, `glow`"]);
}

#[test]
fn of_several_resolutions_the_full_one_is_read() {
    let picture = sample(40, 24);
    let levels = |channel: usize| Levels::Mip {
        rounding_mode: ::exr::math::RoundingMode::Down,
        level_data: [(40, 24), (20, 12), (10, 6), (5, 3), (2, 1), (1, 1)]
            .iter()
            .map(|(width, height)| match (width, floats(&picture, channel)) {
                (40, full) => full,
                _ => FlatSamples::F32(vec![-1.0; width * height]),
            })
            .collect(),
    };
    let channels = ["R", "G", "B"].iter().enumerate().map(|(index, name)| AnyChannel::new(*name, levels(index)));
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::Tiles(Vec2(16, 16)),
        line_order: LineOrder::Unspecified,
    };
    let channels = AnyChannels::sort(channels.collect());
    let image = Image::from_layer(Layer::new((40, 24), LayerAttributes::default(), encoding, channels));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    assert_same(&read_bytes(bytes.get_ref()).unwrap().rgb, &picture.rgb);
}
