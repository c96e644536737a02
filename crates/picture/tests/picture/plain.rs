//! PNG and TIFF.

use ::tiff::{
    encoder::{Compression, TiffEncoder, colortype},
    tags::Tag,
};

use super::*;

const SIZE: [usize; 2] = [23, 19];
const BT709: Chromaticities =
    Chromaticities { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
const P3: Chromaticities =
    Chromaticities { red: [0.68, 0.32], green: [0.265, 0.69], blue: [0.15, 0.06], white: [0.3127, 0.329] };

/// All codes of `0..=most` that fit, spread over the range.
fn coded(most: u32) -> DisplayPicture {
    let [width, height] = SIZE;
    let count = width * height;
    let value = |index: usize| (index as u32 * 7919 % (most + 1)) as f32 / most as f32;
    DisplayPicture {
        width,
        height,
        rgb: (0..count).map(|index| [value(3 * index), value(3 * index + 1), value(3 * index + 2)]).collect(),
        alpha: Some((0..count).map(|index| value(index + 5)).collect()),
    }
}

fn png(picture: &DisplayPicture, bits: PngBits, tag: Option<ColourTag>, texts: &[(&str, &str)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_png_to(&mut bytes, picture, bits, tag, texts).unwrap();
    bytes
}

fn raw_png(colour: ::png::ColorType, depth: ::png::BitDepth, size: [u32; 2], palette: &[u8], data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if !palette.is_empty() {
        encoder.set_palette(palette.to_vec());
        encoder.set_trns(vec![255, 51]);
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

pub(super) fn png_files() -> Vec<(String, Vec<u8>)> {
    let eight = coded(255);
    let opaque = DisplayPicture { alpha: None, ..coded(65_535) };
    vec![
        ("PNG 8".to_owned(), png(&eight, PngBits::Eight, None, &[("Software", "x")])),
        ("PNG 16".to_owned(), png(&opaque, PngBits::Sixteen, None, &[])),
    ]
}

#[test]
fn png_codes_are_read_again_exactly() {
    for (bits, most, source) in [(PngBits::Eight, 255, 8), (PngBits::Sixteen, 65_535, 16)] {
        let picture = coded(most);
        let again = read_bytes(&png(&picture, bits, None, &[])).unwrap();
        assert_eq!((again.width, again.height, again.source), (SIZE[0], SIZE[1], Source::Png { bits: source }));
        assert_same(&again.rgb, &picture.rgb);
        assert_eq!(again.alpha, picture.alpha);
        let opaque = DisplayPicture { alpha: None, ..picture };
        assert_same(&read_bytes(&png(&opaque, bits, None, &[])).unwrap().rgb, &opaque.rgb);
    }
}

#[test]
fn png_values_are_clamped_and_rounded_to_the_nearest_code() {
    let rgb = vec![
        [-1.0, f32::NAN, f32::NEG_INFINITY],
        [1.5, f32::INFINITY, 1.0],
        [0.501 / 255.0, 0.499 / 255.0, 254.501 / 255.0],
    ];
    let picture = DisplayPicture { width: 3, height: 1, rgb, alpha: None };
    let again = read_bytes(&png(&picture, PngBits::Eight, None, &[])).unwrap();
    assert_eq!(again.rgb, [[0.0; 3], [1.0; 3], [1.0 / 255.0, 0.0, 1.0]]);
}

#[test]
fn the_other_kinds_of_png_are_read() {
    use ::png::{BitDepth, ColorType};
    let grey = read_bytes(&raw_png(ColorType::Grayscale, BitDepth::Sixteen, [2, 1], &[], &[0, 1, 0xff, 0xff])).unwrap();
    assert_eq!(grey.rgb, [[1.0 / 65_535.0; 3], [1.0; 3]]);
    let one_bit = read_bytes(&raw_png(ColorType::Grayscale, BitDepth::One, [2, 1], &[], &[0b0100_0000])).unwrap();
    assert_eq!((one_bit.rgb, one_bit.source), (vec![[0.0; 3], [1.0; 3]], Source::Png { bits: 8 }));
    let grey_alpha = read_bytes(&raw_png(ColorType::GrayscaleAlpha, BitDepth::Eight, [1, 1], &[], &[51, 102])).unwrap();
    assert_eq!((grey_alpha.rgb, grey_alpha.alpha), (vec![[0.2; 3]], Some(vec![0.4])));
    let palette = [255, 0, 0, 0, 51, 255];
    let indexed = read_bytes(&raw_png(ColorType::Indexed, BitDepth::Eight, [2, 1], &palette, &[1, 0])).unwrap();
    assert_eq!((indexed.rgb, indexed.alpha), (vec![[0.0, 0.2, 1.0], [1.0, 0.0, 0.0]], Some(vec![0.2, 1.0])));
}

#[test]
fn png_says_what_its_values_are() {
    let chunks = |transfer, primaries| {
        let tag = ColourTag { transfer, primaries };
        let bytes = png(&coded(255), PngBits::Eight, Some(tag), &[("Software", "onelight"), ("Title", "\u{4e00}")]);
        let mut decoder = ::png::Decoder::new(Cursor::new(&bytes));
        let info = decoder.read_header_info().unwrap();
        assert_eq!(info.width, SIZE[0] as u32);
        let reader = ::png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
        let info = reader.info().clone();
        assert_eq!(info.uncompressed_latin1_text[0].text, "onelight");
        assert_eq!(info.utf8_text[0].get_text().unwrap(), "\u{4e00}");
        let points =
            info.coding_independent_code_points.map(|points| (points.color_primaries, points.transfer_function));
        (info.srgb.is_some(), info.gama_chunk.map(::png::ScaledFloat::into_scaled), points, info.chrm_chunk)
    };
    let (srgb, _, points, _) = chunks(OutputTransfer::Srgb, BT709);
    assert_eq!((srgb, points), (true, Some((1, 13))));
    let (srgb, gamma, points, chromaticities) = chunks(OutputTransfer::Srgb, P3);
    assert_eq!((srgb, gamma, points), (false, Some(45_454), Some((12, 13))));
    assert_eq!(chromaticities.unwrap().red.0.into_scaled(), 68_000);
    let (srgb, gamma, points, _) = chunks(OutputTransfer::Gamma24, BT709);
    assert_eq!((srgb, gamma, points), (false, Some(41_666), None));
    let odd = Chromaticities { red: [0.7, 0.3], ..BT709 };
    let (_, gamma, points, _) = chunks(OutputTransfer::Linear, odd);
    assert_eq!((gamma, points), (Some(100_000), None));
}

/// A TIFF of the encoder's colour type, with the tag of its extra samples.
fn tiff<C>(size: [u32; 2], data: &[C::Inner], extra: Option<u16>, compression: Compression) -> Vec<u8>
where
    C: colortype::ColorType,
    [C::Inner]: ::tiff::encoder::TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap().with_compression(compression);
    let mut image = encoder.new_image::<C>(size[0], size[1]).unwrap();
    if let Some(extra) = extra {
        image.encoder().write_tag(Tag::ExtraSamples, &[extra][..]).unwrap();
    }
    image.write_data(data).unwrap();
    bytes.into_inner()
}

pub(super) fn tiff_files() -> Vec<(String, Vec<u8>)> {
    let size = SIZE.map(|side| side as u32);
    let words: Vec<u16> = (0..SIZE[0] * SIZE[1] * 4).map(|index| (index * 97 % 65_536) as u16).collect();
    let floats: Vec<f32> = words.iter().take(SIZE[0] * SIZE[1] * 3).map(|word| f32::from(*word) / 9.0 - 5.0).collect();
    let deflate = Compression::Deflate(Default::default());
    vec![
        ("TIFF 16 none".to_owned(), tiff::<colortype::RGBA16>(size, &words, Some(2), Compression::Uncompressed)),
        ("TIFF 16 LZW".to_owned(), tiff::<colortype::RGBA16>(size, &words, Some(1), Compression::Lzw)),
        ("TIFF float Deflate".to_owned(), tiff::<colortype::RGB32Float>(size, &floats, None, deflate)),
    ]
}

#[test]
fn tiff_integers_are_0_to_1_and_floats_as_they_are() {
    let float = [f32::NAN, -1.5, 1e9, 0.18, 0.0, 2.0];
    let picture = read_bytes(&tiff::<colortype::RGB32Float>([2, 1], &float, None, Compression::Lzw)).unwrap();
    assert_same(&picture.rgb, &[[f32::NAN, -1.5, 1e9], [0.18, 0.0, 2.0]]);
    assert_eq!(picture.source, Source::Tiff { bits: 32, samples: TiffSamples::Float });

    for compression in [Compression::Uncompressed, Compression::Packbits, Compression::Deflate(Default::default())] {
        let picture = read_bytes(&tiff::<colortype::Gray16>([2, 1], &[13_107, 65_535], None, compression)).unwrap();
        assert_eq!((picture.rgb, picture.alpha), (vec![[0.2; 3], [1.0; 3]], None));
        assert_eq!(picture.source, Source::Tiff { bits: 16, samples: TiffSamples::Integer });
    }
    let byte = read_bytes(&tiff::<colortype::RGB8>([1, 1], &[0, 51, 255], None, Compression::Lzw)).unwrap();
    assert_eq!(byte.rgb, [[0.0, 0.2, 1.0]]);
}

#[test]
fn tiff_alpha_is_straight_or_divided_out() {
    let data = [13_107, 26_214, 0, 32_768];
    let alpha = 32_768.0 / 65_535.0;
    for (extra, expected, notes) in
        [(Some(2), [0.2, 0.4, 0.0], 0), (Some(1), [0.2 / alpha, 0.4 / alpha, 0.0], 0), (None, [0.2, 0.4, 0.0], 1)]
    {
        let picture = read_bytes(&tiff::<colortype::RGBA16>([1, 1], &data, extra, Compression::Lzw)).unwrap();
        assert_eq!((&picture.rgb[..], picture.alpha), (&[expected][..], Some(vec![alpha])), "{extra:?}");
        assert_eq!(picture.notes.len(), notes, "{:?}", picture.notes);
    }
}
