//! What is refused, and in which words.

use ::exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, Vec2, WritableImage,
};

use super::{
    exr::{COMPRESSIONS, Stored, file, layer},
    *,
};

fn small_exr(compression: Compression) -> Vec<u8> {
    let value = || FlatSamples::F16(vec![Default::default(); 64]);
    file(vec![layer(None, [8, 8], Stored::lines(compression), &[("R", value()), ("G", value()), ("B", value())])])
}

/// The file with the four numbers of a window attribute replaced.
fn with_window(mut bytes: Vec<u8>, name: &str, corners: [i32; 4]) -> Vec<u8> {
    let head = [name.as_bytes(), b"\0box2i\0\x10\0\0\0"].concat();
    let at = bytes.windows(head.len()).position(|window| window == head).unwrap() + head.len();
    for (index, corner) in corners.iter().enumerate() {
        bytes[at + 4 * index..][..4].copy_from_slice(&corner.to_le_bytes());
    }
    bytes
}

#[test]
fn headers_that_lie_are_refused_before_memory_is_taken() {
    for compression in COMPRESSIONS {
        let good = small_exr(compression);
        for (corners, expected) in [
            ([0, 0, 99_999, 99_999], "expected sides up to 65535"),
            ([0, 0, 39_999, 39_999], "expected up to 268435456 pixels"),
            ([0, 0, 14_999, 14_999], "cannot hold"),
            ([0, 0, i32::MAX - 1, i32::MAX - 1], "data window"),
            ([i32::MIN, i32::MIN, i32::MAX, i32::MAX], "data window"),
            ([5, 5, 4, 9], "the data window is empty"),
            ([0, 7, 7, -9], "the data window is empty"),
        ] {
            let sentence = refusal(&with_window(good.clone(), "dataWindow", corners));
            assert!(sentence.contains(expected), "{corners:?}: {sentence}");
        }
        let sentence = refusal(&with_window(good.clone(), "displayWindow", [0, 0, 99_999, 9]));
        assert!(sentence.contains("the display window"), "{sentence}");
        assert!(refusal(&with_window(good, "displayWindow", [0, 0, -1, -1])).contains("the display window is empty"));
    }
}

#[test]
fn a_display_window_is_at_most_64_times_the_data_or_16_million_pixels() {
    let good = small_exr(Compression::ZIP1);
    let sentence = refusal(&with_window(good.clone(), "displayWindow", [0, 0, 16_383, 16_383]));
    assert_eq!(
        sentence,
        "the display window is 16384 x 16384 pixels for a data window of 8 x 8, expected at most 64 times as many, or \
         16777216 pixels"
    );
    assert!(refusal(&with_window(good.clone(), "displayWindow", [0, 0, 4096, 4095])).contains("the display window"));
    let largest = read_bytes(&with_window(good, "displayWindow", [0, 0, 4095, 4095])).unwrap();
    let mut png = Vec::new();
    let eight = PngSettings::default();
    write_png(&mut png, &largest.description(), eight, &[], |sink| sink.write(largest.view())).unwrap();
    assert_eq!(read_bytes(&png).unwrap().rgb.len(), 1 << 24);

    // Above 16 million pixels the data window decides.
    let square = |side: usize| {
        let value = || FlatSamples::F16(vec![Default::default(); side * side]);
        let channels = [("R", value()), ("G", value()), ("B", value())];
        file(vec![layer(None, [side, side], Stored::lines(Compression::ZIP16), &channels)])
    };
    assert!(read_bytes(&with_window(square(512), "displayWindow", [0, 0, 4096, 4095])).is_err());
    assert!(read_bytes(&with_window(square(513), "displayWindow", [0, 0, 4096, 4095])).is_ok());
}

#[test]
fn png_and_tiff_headers_that_lie_are_refused() {
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    png.extend([0, 0, 0x3f, 0, 0, 0, 0x3f, 0, 16, 6, 0, 0, 0]);
    let mut crc = !0_u32; // CRC-32 of the chunk
    for byte in &png[12..] {
        crc = (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()));
    }
    png.extend((!crc).to_be_bytes());
    assert!(refusal(&png).contains("cannot hold"), "{}", refusal(&png));

    let mut tiff = b"II\x2a\0\x08\0\0\0".to_vec();
    let entries = [
        (256, 16_000),
        (257, 16_000),
        (258, 16),
        (259, 1),
        (262, 1),
        (273, 8),
        (277, 1),
        (278, 16_000),
        (279, 512_000_000_u32),
    ];
    tiff.extend((entries.len() as u16).to_le_bytes());
    for (tag, value) in entries {
        tiff.extend(
            [&(tag as u16).to_le_bytes()[..], &4_u16.to_le_bytes(), &1_u32.to_le_bytes(), &value.to_le_bytes()]
                .concat(),
        );
    }
    tiff.extend([0; 4]);
    assert!(refusal(&tiff).contains("cannot hold"), "{}", refusal(&tiff));
}

#[test]
fn channels_that_make_no_picture_are_listed() {
    let value = || FlatSamples::F32(vec![0.0; 4]);
    let stored = Stored::lines(Compression::ZIP16);
    let refused = |channels: &[(&str, FlatSamples)]| refusal(&file(vec![layer(None, [2, 2], stored, channels)]));
    assert_eq!(
        refused(&[("R", value()), ("B", value()), ("Z", value())]),
        "found the channels B, R, Z, expected R, G and B, or X, Y and Z, or Y, RY and BY, or Y, or a single one"
    );
    assert!(refused(&[("a.R", value()), ("b.G", value()), ("c.B", value())]).contains("a.R, b.G, c.B"));
    assert!(refused(&[("BY", value()), ("RY", value())]).starts_with("found the channels BY, RY, expected"));
    let many: Vec<String> = (0..60).map(|index| format!("c{index:02}")).collect();
    let many: Vec<(&str, FlatSamples)> = many.iter().map(|name| (name.as_str(), value())).collect();
    assert!(refused(&many).contains("c23 and 36 more"));
    // Names of 255 bytes, of which 160 are repeated.
    let long: Vec<String> = (0..24).map(|index| format!("{index:0255}")).collect();
    let long: Vec<(&str, FlatSamples)> = long.iter().map(|name| (name.as_str(), value())).collect();
    let sentence = refused(&long);
    assert!(sentence.contains("... and 21 more, expected R, G and B") && sentence.len() < 1000, "{sentence}");
}

#[test]
fn subsampled_channels_are_refused() {
    let channel = |name: &str, side: usize| {
        let mut channel = AnyChannel::new(name, FlatSamples::F32(vec![0.0; (4 / side) * (4 / side)]));
        channel.sampling = Vec2(side, side);
        channel
    };
    let channels =
        AnyChannels::sort([channel("R", 1), channel("G", 1), channel("B", 1), channel("U", 1)].into_iter().collect());
    let image = Image::from_layer(Layer::new((4, 4), LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels));
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    // The crate cannot write subsampled channels, so the sampling of U is set by hand.
    let mut bytes = bytes.into_inner();
    let head = b"U\0\x02\0\0\0";
    let at = bytes.windows(head.len()).position(|window| window == head).unwrap() + head.len() + 4;
    bytes[at..at + 8].copy_from_slice(&[2, 0, 0, 0, 2, 0, 0, 0]);
    assert!(refusal(&bytes).contains("`U` is subsampled 2 x 2"), "{}", refusal(&bytes));
}

#[test]
fn deep_data_are_refused() {
    let mut bytes = small_exr(Compression::ZIP1);
    let kind = b"type\0string\0\x0d\0\0\0scanlineimage";
    let at = bytes.windows(kind.len()).position(|window| window == kind).unwrap();
    bytes.splice(at..at + kind.len(), *b"type\0string\0\x0c\0\0\0deepscanline");
    assert!(refusal(&bytes).contains("deep data"), "{}", refusal(&bytes));
}

#[test]
fn files_that_are_no_pictures_are_named_in_one_sentence() {
    for (name, contents, expected) in [
        ("empty.exr", &b""[..], "is empty"),
        ("a.jxl", b"\xff\x0a and so on", "a JPEG XL picture"),
        ("a.raf", b"FUJIFILMCCD-RAW 0201", "(RAF) by its first bytes, expected what a raw converter makes of it"),
        ("a.dpx", b"SDPX", "a DPX picture by its first bytes, expected its codes as a TIFF or PNG of 16 bits"),
        ("a.cr3", b"\0\0\0\x18ftypcrx \0", "a Canon camera raw file (CR3)"),
        ("a.dds", b"DDS |", "a DDS texture"),
        ("a.hdr", b"#?RADIANCE\n", "no end"),
        ("a.png", b"hello", "an unknown format"),
        ("b.exr", b"\x76\x2f\x31\x01", "too early"),
        ("b.png", b"\x89PNG\r\n\x1a\n", "too early"),
        ("b.tif", b"II\x2a\0", "too early"),
    ] {
        let sentence = open(Cursor::new(contents), name, Limits::default()).unwrap_err().to_string();
        assert!(sentence.starts_with(&format!("{name}: ")), "{sentence}");
        assert!(sentence.contains(expected) && !sentence.contains('\n'), "{sentence}");
    }
}

#[test]
fn the_format_is_told_by_the_bytes_and_not_by_the_name() {
    let mut file = Cursor::new(Vec::new());
    sample(5, 4).write_exr(&mut file, &[]).unwrap();
    assert_eq!(open(file, "really.png", Limits::default()).unwrap().description().source, Source::Exr);
}

#[test]
fn errors_tell_their_kind() {
    let mut file = Cursor::new(Vec::new());
    sample(5, 4).write_exr(&mut file, &[]).unwrap();
    let small = Limits { max_pixels: 19, ..Limits::default() };
    let error = open(&mut file, "a.exr", small).unwrap_err();
    assert_eq!(error.to_string(), "a.exr: the data window is 5 x 4 pixels, expected up to 19 pixels");
    assert!(error.is_limit() && !error.is_damaged() && !error.is_unsupported());
    let short = &file.get_ref()[..file.get_ref().len() - 1];
    let mut picture = open(Cursor::new(short), "b.exr", Limits::default()).unwrap();
    let error = picture.next_band().unwrap_err();
    assert!(error.is_damaged() && error.to_string().starts_with("b.exr: "), "{error}");
}

/// A connection that breaks off.
struct Broken(Cursor<Vec<u8>>);

impl std::io::Read for Broken {
    fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
        Err(ErrorKind::ConnectionReset.into())
    }
}

impl std::io::Seek for Broken {
    fn seek(&mut self, to: std::io::SeekFrom) -> std::io::Result<u64> {
        self.0.seek(to)
    }
}

#[test]
fn a_reader_that_fails_is_no_damage() {
    let error = open(Broken(Cursor::new(vec![0; 9])), "far.exr", Limits::default()).unwrap_err();
    assert!(error.is_io() && error.to_string().starts_with("far.exr: cannot be read: "), "{error}");
    assert_eq!(text_of_complete_picture(Broken(Cursor::new(vec![0; 9])), "job"), None);
}

#[test]
fn a_picture_that_contradicts_itself_is_not_written() {
    let write_png = |picture: &DisplayPicture, texts: &[(&str, &str)]| {
        write_png_to(Vec::new(), picture, PngBits::Eight, None, texts)
    };
    let wrong = DisplayPicture { width: 3, height: 2, rgb: vec![[0.0; 3]; 5], alpha: None };
    assert!(write_png(&wrong, &[]).unwrap_err().is_unwritable());
    let right = DisplayPicture { rgb: vec![[0.0; 3]; 6], ..wrong };
    assert!(write_png(&right, &[("", "empty key")]).unwrap_err().is_unwritable());
    let short = Picture { alpha: Some(vec![1.0; 3]), ..sample(2, 2) };
    assert!(short.write_exr(Cursor::new(Vec::new()), &[]).unwrap_err().is_unwritable());
    write_png(&right, &[]).unwrap();
}
