//! Pictures larger than a band: the same pixels, and never many at once.

use ::exr::prelude::{Blocks, Compression, LineOrder, Vec2};

use super::{
    exr::{Stored, file, halves, layer},
    *,
};

/// Rows enough for several bands at this width.
const SIZE: [usize; 2] = [2100, 1210];

fn opened(bytes: &[u8]) -> PictureReader<'_> {
    open(Cursor::new(bytes), "", Limits::default()).unwrap()
}

/// Pixels of the largest band; the number of bands.
fn bands(bytes: &[u8]) -> (usize, usize) {
    let mut picture = opened(bytes);
    let memory = picture.memory();
    let (mut largest, mut count, mut rows, mut band) = (0, 0, 0, Band::default());
    loop {
        picture.next_into(&mut band).unwrap();
        if band.rows() == 0 {
            break;
        }
        assert_eq!(band.top(), rows);
        (largest, count, rows) = (largest.max(band.rgb().len()), count + 1, rows + band.rows());
    }
    assert_eq!(rows, picture.description().height);
    assert_eq!(memory.band_pixels, largest as u64);
    // The end stays the end.
    picture.next_into(&mut band).unwrap();
    assert_eq!(band.rows(), 0);
    assert!(picture.next_band().unwrap().is_none());
    (largest, count)
}

#[test]
fn a_band_is_a_million_pixels_or_one_row_of_blocks() {
    let [width, height] = SIZE;
    let mut picture = sample(width, height);
    picture.rgb[width + 1] = [1.0; 3];
    let channels = || {
        [("R", halves(&picture, 0)), ("G", halves(&picture, 1)), ("B", halves(&picture, 2)), ("A", halves(&picture, 0))]
    };
    let expected = picture.rgb.iter().map(|rgb| rgb.map(|v| half::f16::from_f32(v).to_f32()));
    let expected: Vec<[f32; 3]> = expected.collect();
    for (blocks, order, most) in [
        (Blocks::ScanLines, LineOrder::Increasing, 1 << 20),
        (Blocks::ScanLines, LineOrder::Decreasing, 1 << 20),
        (Blocks::Tiles(Vec2(64, 64)), LineOrder::Unspecified, 1 << 20),
        (Blocks::Tiles(Vec2(300, 600)), LineOrder::Increasing, 600 * width),
    ] {
        let stored = Stored { compression: Compression::ZIP16, blocks, order };
        let bytes = file(vec![layer(None, SIZE, stored, &channels()[..3])]);
        let (largest, count) = bands(&bytes);
        assert!(largest <= most && count >= 3, "{stored:?}: {count} bands up to {largest} pixels");
        assert_same(&read_bytes(&bytes).unwrap().rgb, &expected);
        let covered = read_bytes(&file(vec![layer(None, SIZE, stored, &channels())])).unwrap();
        assert_eq!(covered.alpha.unwrap()[5 * width + 7], expected[5 * width + 7][0]);
    }
}

#[test]
fn a_png_and_a_strip_of_tiff_come_in_bands() {
    let [width, height] = SIZE;
    let rgb = (0..width * height).map(|index| [(index % 256) as f32 / 255.0; 3]).collect();
    let picture = DisplayPicture { width, height, rgb, alpha: None };
    let mut png = Vec::new();
    write_png_to(&mut png, &picture, PngBits::Eight, None, &[]).unwrap();
    let (largest, count) = bands(&png);
    assert!(largest <= 1 << 20 && count == 3, "{count} bands up to {largest} pixels");
    assert_same(&read_bytes(&png).unwrap().rgb, &picture.rgb);

    let mut tiff = Cursor::new(Vec::new());
    let mut encoder = ::tiff::encoder::TiffEncoder::new(&mut tiff).unwrap();
    let mut image = encoder.new_image::<::tiff::encoder::colortype::RGB8>(width as u32, height as u32).unwrap();
    image.rows_per_strip(7).unwrap();
    let bytes: Vec<u8> = picture.rgb.iter().flatten().map(|value| (value * 255.0).round() as u8).collect();
    image.write_data(&bytes).unwrap();
    let (largest, count) = bands(tiff.get_ref());
    assert!(largest <= 1 << 20 && count == 3, "{count} bands up to {largest} pixels");
    assert_same(&read_bytes(tiff.get_ref()).unwrap().rgb, &picture.rgb);
}

#[test]
fn an_interlaced_png_is_the_picture() {
    // Adam7 of 2 x 2 pixels: passes 1 (0, 0), 6 (1, 0), 7 (0, 1) and (1, 1).
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |name: &[u8; 4], data: &[u8]| {
        let body = [&name[..], data].concat();
        let crc = body.iter().fold(!0_u32, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
        });
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(body);
        bytes.extend((!crc).to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 1]);
    // A stored block of zlib: a filter byte before each row of a pass.
    let rows = [0, 51, 0, 102, 0, 153, 204];
    let (a, b) = rows.iter().fold((1_u32, 0_u32), |(a, b), byte| (a + byte, b + a + byte));
    let rows = rows.map(|byte| byte as u8);
    chunk(b"IDAT", &[&[0x78, 1, 1, 7, 0, !7, !0][..], &rows, &((b << 16) | a).to_be_bytes()].concat());
    chunk(b"IEND", &[]);
    let picture = read_bytes(&bytes).unwrap();
    assert_eq!(picture.rgb, [[0.2; 3], [0.4; 3], [0.6; 3], [0.8; 3]]);
}

#[test]
fn rows_out_of_order_or_missing_are_refused() {
    let picture = sample(5, 40);
    let band = |rows: std::ops::Range<usize>| BandView {
        top: rows.start,
        width: 5,
        rgb: &picture.rgb[rows.start * 5..rows.end * 5],
        alpha: None,
    };
    for rows in [vec![0..17, 18..40], vec![0..17, 17..39], vec![0..17, 14..40], vec![0..17, 17..40, 0..1], vec![]] {
        let fill = |sink: &mut dyn BandSink| rows.iter().try_for_each(|rows| sink.write(band(rows.clone())));
        let (exr, png) = (Cursor::new(Vec::new()), Vec::new());
        let exr = write_exr(exr, &picture.description(), &[], fill);
        let png = write_png(png, &picture.description(), PngSettings::default(), &[], fill);
        for error in [exr.unwrap_err(), png.unwrap_err()] {
            assert!(error.is_unwritable());
            assert!(error.to_string().contains("cannot be written"), "{rows:?}: {error}");
        }
    }
}

/// A disk that is full for one write, and takes all others.
struct FullOnce {
    writes: usize,
    full_at: usize,
}

impl std::io::Write for FullOnce {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.writes += 1;
        if self.writes == self.full_at { Err(ErrorKind::StorageFull.into()) } else { Ok(bytes.len()) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn no_failed_write_is_forgotten() {
    let picture = sample(300, 200);
    let picture = DisplayPicture { width: 300, height: 200, rgb: picture.rgb, alpha: None };
    let mut disk = FullOnce { writes: 0, full_at: usize::MAX };
    write_png_to(&mut disk, &picture, PngBits::Sixteen, None, &[]).unwrap();
    for full_at in 1..=disk.writes {
        let disk = FullOnce { writes: 0, full_at };
        let outcome = write_png_to(disk, &picture, PngBits::Sixteen, None, &[]);
        assert!(outcome.is_err_and(|error| error.is_io()), "the failure of write {full_at} is forgotten");
    }
}

#[test]
fn an_error_of_the_one_who_fills_comes_back_as_it_is() {
    #[derive(Debug)]
    enum Own {
        Mine(u8),
        Picture(Error),
    }
    impl From<Error> for Own {
        fn from(error: Error) -> Self {
            Self::Picture(error)
        }
    }
    let picture = sample(5, 40);
    let row = |sink: &mut dyn BandSink| sink.write(BandView { top: 0, width: 5, rgb: &picture.rgb[..5], alpha: None });
    let fill = |sink: &mut dyn BandSink| -> Result<(), Own> {
        row(sink)?;
        Err(Own::Mine(7))
    };
    let description = picture.description();
    let exr = write_exr(Cursor::new(Vec::new()), &description, &[], fill);
    let png = write_png(Vec::new(), &description, PngSettings::default(), &[], fill);
    assert!(matches!((exr, png), (Err(Own::Mine(7)), Err(Own::Mine(7)))));
    // Too few rows, of which the one who fills knows nothing.
    let fill = |sink: &mut dyn BandSink| Ok::<_, Own>(row(sink)?);
    let exr = write_exr(Cursor::new(Vec::new()), &description, &[], fill);
    let png = write_png(Vec::new(), &description, PngSettings::default(), &[], fill);
    for error in [exr, png] {
        assert!(matches!(error, Err(Own::Picture(error)) if error.is_unwritable()));
    }
}
