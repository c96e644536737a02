//! What files say of their colours.

use super::*;

fn corpus(name: &str) -> Picture {
    let bytes = std::fs::read(format!("{}/../../fixtures/corpus/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    read_bytes(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn profiles_chunks_and_tags_are_understood() {
    let adobe_power = Transfer::Power(563.0 / 256.0);
    for (name, primaries, transfer) in [
        ("jpeg/display-p3.jpg", Some(Chromaticities::P3_D65), Some(Transfer::Srgb)),
        ("jpeg/baseline.jpg", None, None),
        ("tiff/linear-rec2020.tif", Some(Chromaticities::BT2020), Some(Transfer::Linear)),
        ("tiff/rawtherapee-without-profile.tif", Some(Chromaticities::BT709), Some(Transfer::Srgb)),
        ("tiff/exif-srgb.tif", Some(Chromaticities::BT709), Some(Transfer::Srgb)),
        ("tiff/exif-adobe-rgb.tif", Some(Chromaticities::ADOBE_RGB), Some(adobe_power.clone())),
        ("tiff/exif-beside-floats.tif", None, None),
        ("tiff/adobe-rgb.tif", Some(Chromaticities::ADOBE_RGB), Some(adobe_power.clone())),
        ("png/icc-srgb.png", Some(Chromaticities::BT709), Some(Transfer::Srgb)),
        ("png/icc-grey.png", None, Some(adobe_power)),
        ("png/cicp-pq-16.png", Some(Chromaticities::BT2020), Some(Transfer::Pq)),
        ("png/gama-linear-16.png", None, Some(Transfer::Linear)),
        ("png/gama-chrm.png", Some(Chromaticities::BT2020), Some(Transfer::Power(1.8))),
        ("hdr/runs.hdr", None, Some(Transfer::Linear)),
        ("hdr/exposed.hdr", Some(Chromaticities::BT2020), Some(Transfer::Linear)),
        ("hdr/xyz.hdr", Some(Chromaticities::XYZ), Some(Transfer::Linear)),
    ] {
        let picture = corpus(name);
        assert_eq!(picture.primaries, primaries, "{name}");
        assert_eq!(picture.transfer, transfer, "{name}");
    }
}

/// `ROMM` RGB (ISO 22028-2), whose white D50 needs no adaptation in a profile.
#[test]
fn a_space_without_a_name_here_keeps_its_primaries() {
    let found = corpus("png/icc-prophoto.png").primaries.unwrap();
    let expected = Chromaticities {
        red: [0.7347, 0.2653],
        green: [0.1596, 0.8404],
        blue: [0.0366, 0.0001],
        white: [0.3457, 0.3585],
    };
    assert!(found.is_near(&expected), "{found:?}");
}

#[test]
fn a_profile_that_is_not_used_is_named() {
    for (name, expected) in [
        ("png/icc-damaged.png", "left out the file's ICC profile, which is damaged"),
        ("png/icc-lab-table.png", "left out the ICC profile `XYZ identity built-in`, which is not of RGB or grey"),
    ] {
        let picture = corpus(name);
        assert_eq!((picture.primaries, picture.transfer, &picture.notes[..]), (None, None, &[expected.to_owned()][..]));
    }
}

/// What is written comes back as what it was.
#[test]
fn our_own_tags_are_read_again() {
    let (p3, odd) = (Chromaticities::P3_D65, Chromaticities { red: [0.7, 0.3], ..Chromaticities::BT709 });
    for primaries in [Chromaticities::BT709, Chromaticities::BT2020, p3, odd, Chromaticities::AP0] {
        for (written, read) in [
            (OutputTransfer::Srgb, Transfer::Srgb),
            (OutputTransfer::Gamma24, Transfer::Power(2.4)),
            (OutputTransfer::Linear, Transfer::Linear),
        ] {
            let picture = DisplayPicture { width: 1, height: 1, rgb: vec![[0.5; 3]], alpha: None };
            let mut bytes = Vec::new();
            let tag = Some(ColourTag { transfer: written, primaries });
            write_png_to(&mut bytes, &picture, PngBits::Sixteen, tag, &[]).unwrap();
            let again = read_bytes(&bytes).unwrap();
            assert_eq!(again.transfer, Some(read), "{primaries:?}");
            assert!(again.primaries.unwrap().is_near(&primaries), "{primaries:?}");
        }
    }
}
