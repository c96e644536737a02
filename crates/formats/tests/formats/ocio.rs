//! OpenColorIO configurations; that OpenColorIO loads them is tried where the files of a bake are.

use onelight_formats::{OcioConfig, OcioSpace, OcioView};
use onelight_lut::{Interpolation, PlainLut, PowerCoding, Shaper};

use crate::tables::bent;

const REC709_TO_XYZ: [[f64; 3]; 3] = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];

fn text(config: &OcioConfig) -> String {
    let mut bytes = Vec::new();
    config.write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn config(coding: PowerCoding) -> OcioConfig {
    let scene = OcioSpace { name: "Linear Rec.709", to_xyz: REC709_TO_XYZ, coding: PowerCoding::LINEAR };
    OcioConfig::new(scene, OcioSpace { name: "display", coding, ..scene })
}

#[test]
fn a_table_without_a_shaper_gets_it() {
    let shaper = Shaper::log2(0.25, 15.75).unwrap();
    let lut = PlainLut::new(shaper, bent(2), Interpolation::Trilinear);
    let view = OcioView::of_table("x\\y", "a \"b\".spi3d", &lut).unwrap();
    let text = text(&config(PowerCoding::LINEAR).with_view(view).with_comments(["one\ntwo"]));
    for line in [
        "# one\n# two\n",
        "name: \"x\\\\y\"\n",
        "max_in_value: 15.75,",
        "{base: 2, log_side_slope: 0.16666666666666666, lin_side_slope: 4, lin_side_offset: 1}",
        "{src: \"a \\\"b\\\".spi3d\", interpolation: linear}",
    ] {
        assert!(text.contains(line), "{line} in {text}");
    }
}

#[test]
fn views_of_one_name_are_told_apart() {
    let names = ["film", "film", "display", "", " film\n"];
    let config = names
        .iter()
        .fold(config(PowerCoding::LINEAR), |config, name| config.with_view(OcioView::of_clf(name, "look.clf")));
    let text = text(&config);
    for name in ["film", "film 2", "display 2", "look", "film 3"] {
        assert_eq!(text.matches(&format!("<View> {{name: \"{name}\",")).count(), 1, "{name} in {text}");
    }
}

#[test]
fn the_display_is_coded_as_it_says() {
    for (coding, line) in [
        (
            PowerCoding::new(2.4, 0.055).unwrap(),
            "!<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}",
        ),
        (PowerCoding::new(2.4, 0.0).unwrap(), "!<ExponentTransform> {value: 2.4, style: mirror, direction: inverse}"),
    ] {
        assert!(text(&config(coding)).contains(line), "{line}");
    }
    assert!(!text(&config(PowerCoding::LINEAR)).contains("Exponent"));
}
