//! What a file says of how its picture was taken comes out again, and nothing that is no longer true.

use super::*;

/// Writes a picture of one pixel that has the metadata of another; what is read again, and the file.
fn through(picture: &Description, kind: &str) -> (Description, Vec<u8>) {
    let written =
        Description { metadata: picture.metadata.clone(), ..Description::new(1, 1, Channels::Rgb, Source::Exr) };
    let band = BandView { top: 0, width: 1, rgb: &[[0.5; 3]], alpha: None };
    let texts = [("Software", "a test"), ("onelight look", "day"), ("onelight job", "a1")];
    let fill = |sink: &mut dyn BandSink| sink.write(band);
    let mut file = Cursor::new(Vec::new());
    match kind {
        "exr" => write_exr(&mut file, &written, &texts, fill),
        "png" => write_png(&mut file, &written, PngSettings::default(), &texts, fill),
        "tif" => write_tiff(&mut file, &written, TiffSettings::default(), &texts, fill),
        _ => write_jpeg(&mut file, &written, JpegSettings::default(), &texts, fill),
    }
    .unwrap();
    let bytes = file.into_inner();
    let again = open(Cursor::new(&bytes), "", Limits::default()).unwrap().description().clone();
    assert_eq!(text_of_complete_picture(Cursor::new(&bytes), "onelight job").as_deref(), Some("a1"), "{kind}");
    (again, bytes)
}

fn corpus(name: &str) -> Description {
    let bytes = std::fs::read(format!("{}/../../fixtures/corpus/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    open(Cursor::new(bytes), name, Limits::default()).unwrap().description().clone()
}

fn has(bytes: &[u8], text: &str) -> bool {
    bytes.windows(text.len()).any(|window| window == text.as_bytes())
}

/// A phone's picture, as `fixtures/corpus/make_with_others.py` puts it together.
#[test]
fn exif_goes_from_each_format_to_each() {
    let phone = corpus("jpeg/phone.jpg");
    assert!(!phone.metadata.is_empty());
    for first in ["jpg", "png", "tif"] {
        for second in ["jpg", "png", "tif"] {
            let (once, _) = through(&phone, first);
            let (twice, bytes) = through(&once, second);
            assert_eq!(twice.metadata, phone.metadata, "{first}, {second}");
            for text in ["Maker", "2026:01:02 03:04:05", "a walk"] {
                assert!(has(&bytes, text), "{second}: {text}");
            }
            // The thumbnail, the maker's notes, and which way the picture was held.
            assert!(!has(&bytes, "THUMBNAIL") && !has(&bytes, "MAKERNOTE"), "{second}");
            assert!(!twice.notes.iter().any(|note| note.contains("upright")), "{second}: {:?}", twice.notes);
        }
    }
    assert_eq!(through(&phone, "exr").0.metadata, Description::new(1, 1, Channels::Rgb, Source::Exr).metadata);
}

#[test]
fn attributes_of_openexr_are_kept_in_one_order() {
    let render = corpus("exr/attributes.exr");
    let (again, bytes) = through(&render, "exr");
    assert_eq!(again.metadata, render.metadata);
    for name in ["capDate", "expTime", "owner", "worldToCamera", "Camera", "RenderTime", "isoSpeed"] {
        assert!(has(&bytes, name), "{name}");
    }
    for name in ["cryptomatte/", "whiteLuminance", "preview", "colorInteropID", "oiio:ColorSpace", "someoneElse"] {
        assert!(!has(&bytes, name), "{name}");
    }
    for _ in 0..5 {
        assert!(through(&render, "exr").1 == bytes);
    }
    assert!(again.primaries.is_none() && again.notes.is_empty());
    assert!(has(&through(&again, "exr").1, "RenderTime") && !has(&through(&again, "png").1, "RenderTime"));
}
