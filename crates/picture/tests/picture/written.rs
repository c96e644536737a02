//! TIFF and JPEG that are written, and how values are rounded to 8 bits.

use super::*;

const SIZE: [usize; 2] = [70, 50];

/// Values in slow ramps, some beyond 0 to 1.
fn ramps() -> DisplayPicture {
    let [width, height] = SIZE;
    let value = |x: usize, y: usize| [x as f32 / 60.0, y as f32 / 49.0, (x + y) as f32 / 118.0 - 0.05];
    let rgb = (0..width * height).map(|index| value(index % width, index / width)).collect();
    DisplayPicture { width, height, rgb, alpha: None }
}

fn tiff(picture: &DisplayPicture, settings: TiffSettings, texts: &[(&str, &str)]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    write_tiff(&mut bytes, &picture.description(), settings, texts, |sink| hand_over(picture.view(), sink)).unwrap();
    bytes.into_inner()
}

fn jpeg(picture: &DisplayPicture, settings: JpegSettings, texts: &[(&str, &str)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_jpeg(&mut bytes, &picture.description(), settings, texts, |sink| hand_over(picture.view(), sink)).unwrap();
    bytes
}

fn clamped(rgb: [f32; 3], most: f32) -> [f32; 3] {
    rgb.map(|v| (v.clamp(0.0, 1.0) * most + 0.5).floor() / most)
}

#[test]
fn tiffs_come_back_and_others_read_them() {
    let alpha = DisplayPicture { alpha: Some(vec![0.25; SIZE[0] * SIZE[1]]), ..ramps() };
    for picture in [ramps(), alpha] {
        for (bits, most) in [(TiffBits::Eight, 255.0), (TiffBits::Sixteen, 65_535.0), (TiffBits::Float, 0.0)] {
            let bytes = tiff(&picture, TiffSettings { bits, ..TiffSettings::default() }, &[]);
            let again = read_bytes(&bytes).unwrap();
            assert_eq!((again.width, again.height, again.notes.len()), (SIZE[0], SIZE[1], 0));
            let expected: Vec<[f32; 3]> =
                picture.rgb.iter().map(|rgb| if most > 0.0 { clamped(*rgb, most) } else { *rgb }).collect();
            assert_same(&again.rgb, &expected);
            assert_eq!(again.alpha.is_some(), picture.alpha.is_some());
            // The tiff crate, which writes for the other tests, reads here.
            let mut other = ::tiff::decoder::Decoder::new(Cursor::new(&bytes)).unwrap();
            assert_eq!(other.dimensions().unwrap(), (SIZE[0] as u32, SIZE[1] as u32));
            let step = if picture.alpha.is_some() { 4 } else { 3 };
            let green = match other.read_image().unwrap() {
                ::tiff::decoder::DecodingResult::U8(codes) => f32::from(codes[33 * SIZE[0] * step + 1]) / 255.0,
                ::tiff::decoder::DecodingResult::U16(codes) => f32::from(codes[33 * SIZE[0] * step + 1]) / 65_535.0,
                ::tiff::decoder::DecodingResult::F32(values) => values[33 * SIZE[0] * step + 1],
                other => panic!("{other:?}"),
            };
            assert_eq!(green, expected[33 * SIZE[0]][1]);
        }
    }
}

#[test]
fn tiffs_and_jpegs_say_what_their_values_are() {
    let texts = [("Software", "onelight"), ("job", "a\\1\nand more")];
    for primaries in [Chromaticities::BT709, Chromaticities::P3_D65, Chromaticities::BT2020, Chromaticities::AP1] {
        for (written, read) in [
            (OutputTransfer::Srgb, Transfer::Srgb),
            (OutputTransfer::Gamma24, Transfer::Power(2.4)),
            (OutputTransfer::Linear, Transfer::Linear),
        ] {
            let tag = Some(ColourTag { transfer: written, primaries });
            let files = [
                tiff(&ramps(), TiffSettings { tag, ..TiffSettings::default() }, &texts),
                jpeg(&ramps(), JpegSettings { tag, ..JpegSettings::default() }, &texts),
            ];
            for bytes in files {
                let again = read_bytes(&bytes).unwrap();
                assert_eq!(again.primaries, Some(primaries), "{written:?}");
                let (found, expected) = (again.transfer.unwrap().light([0.3; 3])[0], read.light([0.3; 3])[0]);
                assert!((found - expected).abs() < 1e-5, "{written:?}: {found} {expected}");
                let text = |key: &str, end: usize| text_of_complete_picture(Cursor::new(&bytes[..end]), key);
                assert_eq!(text("job", bytes.len()).as_deref(), Some("a\\1\nand more"));
                assert_eq!(text("Software", bytes.len()).as_deref(), Some("onelight"));
                assert_eq!(text("jo", bytes.len()), None);
                assert_eq!(text("job", bytes.len() / 2), None);
            }
        }
    }
}

#[test]
fn a_jpeg_is_near_what_was_written() {
    let bytes = jpeg(&ramps(), JpegSettings::default(), &[]);
    let again = read_bytes(&bytes).unwrap();
    let far = |a: &[f32; 3], b: &[f32; 3]| (0..3).map(|c| (a[c] - b[c].clamp(0.0, 1.0)).abs()).fold(0.0, f32::max);
    let largest = again.rgb.iter().zip(&ramps().rgb).map(|(a, b)| far(a, b)).fold(0.0, f32::max);
    // Quality 95, whose steps are a few codes; kinks where values are clamped.
    assert!(largest < 8.0 / 255.0, "{largest}");
    let alpha = DisplayPicture { alpha: Some(vec![1.0; SIZE[0] * SIZE[1]]), ..ramps() };
    let refused = write_jpeg(Vec::new(), &alpha.description(), JpegSettings::default(), &[], |sink| {
        hand_over(alpha.view(), sink)
    });
    assert_eq!(refused.unwrap_err().to_string(), "a picture with alpha cannot be written as JPEG");
    let empty = DisplayPicture { width: 0, height: 0, rgb: Vec::new(), alpha: None };
    assert!(
        write_jpeg(Vec::new(), &empty.description(), JpegSettings::default(), &[], |_| Ok::<(), Error>(())).is_err()
    );
}

#[test]
fn a_file_that_was_broken_off_is_none() {
    let picture = ramps();
    let mut bytes = Cursor::new(Vec::new());
    let fault = write_tiff(&mut bytes, &picture.description(), TiffSettings::default(), &[], |sink| {
        sink.write(BandView { top: 0, width: SIZE[0], rgb: &picture.rgb[..10 * SIZE[0]], alpha: None })
    });
    assert!(fault.unwrap_err().to_string().contains("with 10 rows cannot be written"));
    assert!(read_bytes(bytes.get_ref()).is_err());
}

/// A ramp of 4096 pixels over a tenth of the scale, as a clear sky has it.
#[test]
fn dither_keeps_means_and_hides_steps() {
    let (width, height) = (4096, 32);
    let value = |x: usize| 0.5 + 0.1 * x as f32 / width as f32;
    let rgb = (0..width * height).map(|index| [value(index % width); 3]).collect();
    let picture = DisplayPicture { width, height, rgb, alpha: None };
    let codes = |dither: Dither| {
        let mut bytes = Vec::new();
        let settings = PngSettings { dither, ..PngSettings::default() };
        write_png(&mut bytes, &picture.description(), settings, &[], |sink| hand_over(picture.view(), sink)).unwrap();
        let rgb = read_bytes(&bytes).unwrap().rgb;
        assert!(rgb.iter().all(|[r, g, b]| r == g && g == b), "grey stays grey");
        rgb.iter().map(|rgb| f64::from(rgb[0]) * 255.0).collect::<Vec<f64>>()
    };
    let exact: Vec<f64> = picture.rgb.iter().map(|rgb| f64::from(rgb[0]) * 255.0).collect();
    let mean = |codes: &[f64], left: usize| {
        let pixels = (0..256).map(|place| codes[(place / 16) * width + left + place % 16]);
        pixels.sum::<f64>() / 256.0
    };
    let (plain, dithered) = (codes(Dither::None), codes(Dither::Pattern));
    let (mut furthest, mut step, mut plain_step) = (0.0_f64, 0.0_f64, 0.0_f64);
    for left in (0..width).step_by(16) {
        furthest = furthest.max((mean(&dithered, left) - mean(&exact, left)).abs());
        if left > 0 {
            step = step.max((mean(&dithered, left) - mean(&dithered, left - 16)).abs());
            plain_step = plain_step.max((mean(&plain, left) - mean(&plain, left - 16)).abs());
        }
    }
    let noise = exact.iter().zip(&dithered).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / exact.len() as f64;
    assert!(furthest < 0.05, "means are {furthest} codes off");
    assert!(step < 0.25 && plain_step > 0.5, "{step} {plain_step}");
    assert!(noise.sqrt() < 0.75, "{}", noise.sqrt());
}

#[test]
fn codes_stay_what_they_are_under_dither() {
    let rgb: Vec<[f32; 3]> = (0..256).map(|code| [f32::from(code as u8) / 255.0; 3]).collect();
    let picture = DisplayPicture { width: 16, height: 16, rgb, alpha: Some(vec![0.3; 256]) };
    let mut bytes = Vec::new();
    let settings = PngSettings { dither: Dither::Pattern, ..PngSettings::default() };
    write_png(&mut bytes, &picture.description(), settings, &[], |sink| hand_over(picture.view(), sink)).unwrap();
    let again = read_bytes(&bytes).unwrap();
    assert_same(&again.rgb, &picture.rgb);
    assert!(again.alpha.unwrap().iter().all(|alpha| *alpha == 77.0 / 255.0));
}
