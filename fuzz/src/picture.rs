use std::io::Cursor;

use onelight_picture::{
    BandSink, BandView, Channels, Description, JpegSettings, Limits, Metadata, Picture, PngSettings, Source,
    TiffSettings, open, silence_panics_while_reading, write_exr, write_jpeg, write_png, write_tiff,
};

use super::{Met, lut, refused};

/// Small, so that a hostile claim shows against libFuzzer's limits of memory.
pub const LIMITS: Limits = Limits { max_pixels: 1 << 18, max_side: 1 << 13, max_bytes: 1 << 26 };

/// A picture is refused, or has as many pixels as it says, and is the same when written as OpenEXR and read again.
pub fn check(bytes: &[u8]) -> Met {
    // A decoder's panic is caught and becomes an error: libFuzzer, which ends at any panic, does not hear of it.
    silence_panics_while_reading();
    let picture = match Picture::read(Cursor::new(bytes), "", LIMITS) {
        Ok(picture) => picture,
        Err(error) => return refused(&error),
    };
    let Picture { width, height, rgb, alpha, .. } = &picture;
    assert!((*width as u64) * (*height as u64) <= LIMITS.max_pixels);
    assert_eq!(rgb.len(), width * height);
    assert!(alpha.as_ref().is_none_or(|alpha| alpha.len() == rgb.len()));

    let mut written = Cursor::new(Vec::new());
    picture.write_exr(&mut written, &[]).unwrap_or_else(|error| panic!("cannot be written: {error}"));
    let again = Picture::read(written, "", LIMITS).unwrap_or_else(|error| panic!("our own file is refused: {error}"));
    assert_eq!((again.width, again.height), (*width, *height));
    match (alpha, &again.alpha) {
        // Colours went through a multiplication and a division.
        (Some(alpha), Some(again)) => assert!(same(alpha, again), "coverage changed"),
        (None, None) => assert!(same(rgb.as_flattened(), again.rgb.as_flattened()), "colours changed"),
        _ => panic!("coverage came or went"),
    }
    check_metadata(bytes);
    Met::Read
}

/// What is said of how a picture was taken is written in every format and read again; a second time nothing is lost.
fn check_metadata(bytes: &[u8]) {
    let read = |bytes: &[u8]| {
        let picture =
            open(Cursor::new(bytes), "", LIMITS).unwrap_or_else(|error| panic!("our own file is refused: {error}"));
        picture.description().metadata.clone()
    };
    let kinds = [
        |file: &mut Cursor<Vec<u8>>, picture: &Description| write_exr(file, picture, &[], pixel),
        |file: &mut Cursor<Vec<u8>>, picture: &Description| {
            write_png(file, picture, PngSettings::default(), &[], pixel)
        },
        |file: &mut Cursor<Vec<u8>>, picture: &Description| {
            write_tiff(file, picture, TiffSettings::default(), &[], pixel)
        },
        |file: &mut Cursor<Vec<u8>>, picture: &Description| {
            write_jpeg(file, picture, JpegSettings::default(), &[], pixel)
        },
    ];
    let through = |kind: usize, metadata: &Metadata| {
        let picture = Description { metadata: metadata.clone(), ..Description::new(1, 1, Channels::Rgb, Source::Exr) };
        let mut file = Cursor::new(Vec::new());
        kinds[kind](&mut file, &picture).unwrap_or_else(|error| panic!("cannot be written: {error}"));
        read(file.get_ref())
    };
    let own = read(bytes);
    if own.is_empty() {
        return;
    }
    for kind in 0..kinds.len() {
        let once = through(kind, &own);
        assert_eq!(through(kind, &once), once, "a second time something is lost");
    }
}

fn pixel(sink: &mut dyn BandSink) -> Result<(), onelight_picture::Error> {
    sink.write(BandView { top: 0, width: 1, rgb: &[[0.5; 3]], alpha: None })
}

/// The same for a PNG, which may also hold a table.
pub fn check_png(bytes: &[u8]) -> Met {
    lut::png(bytes);
    check(bytes)
}

fn same(a: &[f32], b: &[f32]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
