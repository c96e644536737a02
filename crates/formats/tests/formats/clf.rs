//! Files against the LUTs they were made from, and files that must be refused.

use onelight_formats::{ClfProcess, Error};
use onelight_lut::{
    Decode, Develop, Domain, Expose, IDENTITY, Interpolation, Lut1d, Lut3d, Mix, PlainLut, PowerCoding, SceneSampler,
    Shaper, StructuredLut, StructuredParts, bake,
};

/// `f64` here against `f32` there: a few roundings of a logarithm near 40, over a domain of 25 stops, times the slopes below.
const ROUNDING: f32 = 2e-5;

fn curve(domain: Domain, size: usize, gains: [f32; 3]) -> Lut1d {
    let entry = |i: usize| gains.map(|gain| gain * (1.0 + (6.0 * i as f32 / (size - 1) as f32 - 3.0).tanh()));
    Lut1d::new(domain, (0..size).map(entry).collect()).unwrap()
}

/// Not separable, not symmetric, with negative entries.
fn table(size: usize) -> Lut3d {
    let identity = Lut3d::identity(size).unwrap();
    let bend = |[x, y, z]: [f32; 3]| [1.4 * x * x - 0.1 * y, 0.2 + y - 0.5 * z * x, (3.0 * z).sin() - 0.3 * x];
    Lut3d::new(size, identity.entries().map(bend).collect()).unwrap()
}

fn mixed() -> Option<Mix> {
    Some(Mix {
        matrix: [[0.9, 0.1, 0.0], [-0.2, 1.1, 0.1], [0.05, 0.0, 0.8]],
        offset: [0.1, -0.05, 0.0],
        curves: curve(Domain::new([0.0, -0.3, 0.1], [2.2, 2.0, 1.9]).unwrap(), 65, [0.5, 0.45, 0.5]),
    })
}

fn structured(input: [[f32; 3]; 3], mix: Option<Mix>, decode: Decode) -> StructuredLut {
    let domain = Domain::new([-12.5, -13.0, -12.0], [9.0, 10.5, 11.25]).unwrap();
    let gains = if mix.is_some() { [1.0, 0.9, 0.95] } else { [0.5, 0.45, 0.5] };
    StructuredLut::new(StructuredParts {
        expose: Expose { input, ..Expose::by([[4.1, 0.3, 0.0], [0.2, 3.9, 0.15], [0.0, 0.1, 5.2]]) },
        develop: Develop { coupling: None, curves: curve(domain, 257, gains) },
        mix,
        table: table(17),
        decode,
        interpolation: Interpolation::Tetrahedral,
    })
    .unwrap()
}

fn structured_kinds() -> Vec<StructuredLut> {
    let wide = [[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]];
    let matrix = [[1.1, -0.2, 0.05], [-0.1, 1.3, -0.2], [0.02, -0.15, 0.9]];
    let density = |coding| Decode::Density { matrix, coding };
    vec![
        structured(IDENTITY, None, Decode::Coded),
        structured(wide, mixed(), Decode::Coded),
        structured(wide, None, density(PowerCoding::new(2.4, 0.055).unwrap())),
        structured(IDENTITY, mixed(), density(PowerCoding::new(2.6, 0.0).unwrap())),
        structured(wide, mixed(), density(PowerCoding::LINEAR)),
    ]
}

fn colours() -> Vec<[f32; 3]> {
    let scene = SceneSampler::new(-12.0..=14.0).unwrap().take(4000).map(|rgb| rgb.map(|v| v as f32));
    let hard = [0.0, 1e-6, -1e-3, -5.0, 1e-3, 50.0, 1e4, 1e20, 1e30, f32::INFINITY];
    let mixed = hard.into_iter().flat_map(|a| [[a; 3], [a, 0.18, 0.0], [0.18, a, 1.0], [1e-3, 0.02, a]]);
    scene.chain(mixed).collect()
}

fn text(process: &ClfProcess) -> String {
    let mut bytes = Vec::new();
    process.write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn assert_close(found: [f32; 3], expected: [f32; 3], tolerance: f32, at: [f32; 3]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance, "{found} for {expected} at {at:?}");
    }
}

#[test]
fn a_structured_lut_is_in_the_file_whole() {
    for lut in structured_kinds() {
        let process = ClfProcess::from_structured(&lut).unwrap();
        let back = ClfProcess::parse(&text(&process)).unwrap();
        for rgb in colours() {
            assert_close(back.apply(rgb), lut.apply(rgb), ROUNDING, rgb);
        }
    }
    let lut = &structured_kinds()[0];
    let process = ClfProcess::from_structured(lut).unwrap();
    assert_eq!(process.apply([f32::NAN, 0.18, 0.18]), process.apply([0.0, 0.18, 0.18]));
}

#[test]
fn black_reads_the_floor_of_the_logarithm_within_wide_curves() {
    let curves = curve(Domain::common(-100.0, 10.0).unwrap(), 129, [0.5; 3]);
    let parts = structured(IDENTITY, None, Decode::Coded).parts().clone();
    let lut = StructuredLut::new(StructuredParts { develop: Develop { coupling: None, curves }, ..parts }).unwrap();
    let process = ClfProcess::from_structured(&lut).unwrap();
    assert_close(process.apply([0.0; 3]), lut.apply([0.0; 3]), ROUNDING, [0.0; 3]);
    assert_ne!(lut.apply([0.0; 3]), lut.decode(lut.parts().table.entry([0; 3]).unwrap()));
}

#[test]
fn a_plain_lut_is_in_the_file_whole() {
    let shaper = Shaper::log2(0.005, 16.0).unwrap();
    let baked = bake(17, &shaper, |[r, g, b]| [r / (r + 0.18), g / (1.0 + b), (b + r).sqrt()], |_| {}).unwrap();
    for how in [Interpolation::Trilinear, Interpolation::Tetrahedral] {
        let lut = PlainLut::new(shaper, baked.clone(), how);
        let back = ClfProcess::parse(&text(&ClfProcess::from_plain(&lut).unwrap())).unwrap();
        for rgb in colours() {
            assert_close(back.apply(rgb), lut.apply(rgb), ROUNDING, rgb);
        }
    }
}

#[test]
fn written_text_comes_back_equal() {
    let from_table = ClfProcess::from_table(&table(3), Interpolation::Trilinear);
    for process in structured_kinds().iter().map(|lut| ClfProcess::from_structured(lut).unwrap()).chain([from_table]) {
        let process = process
            .with_name("look <1> & \"two\"")
            .with_descriptions(["max dE < 0.1 & so on\nsecond line", "", "]]> \u{3b4}E"])
            .with_descriptors("scene-linear", "sRGB");
        let written = text(&process);
        let back = ClfProcess::parse(&written).unwrap();
        assert_eq!(back, process);
        assert_eq!(text(&back), written);
        assert_eq!(ClfProcess::read(written.as_bytes()).unwrap(), process);
        assert_eq!(ClfProcess::parse(&written.replace('\n', "\r\n")).unwrap(), process);
    }
}

#[test]
fn operations_are_those_of_the_table_in_the_documentation() {
    let names = |lut: &StructuredLut| ClfProcess::from_structured(lut).unwrap().operations().collect::<Vec<_>>();
    let kinds = structured_kinds();
    assert_eq!(names(&kinds[0]), ["Range", "Matrix", "Range", "Log", "LUT1D", "LUT3D"]);
    assert_eq!(
        names(&kinds[2]),
        ["Range", "Matrix", "Range", "Matrix", "Range", "Log", "LUT1D", "LUT3D", "Matrix", "Log", "Matrix", "Exponent"]
    );
    assert_eq!(names(&kinds[4]).len(), 13);
}

#[test]
fn blue_is_fastest_in_the_file() {
    let written = text(&ClfProcess::from_table(&Lut3d::identity(2).unwrap(), Interpolation::Tetrahedral));
    let entries: Vec<_> = written.lines().skip_while(|line| !line.contains("<Array")).skip(1).take(3).collect();
    assert_eq!(entries, ["0 0 0", "0 0 1", "0 1 0"]);
}

/// One operation around a piece of CLF, and what it makes of a grey.
fn grey(operation: &str, value: f32) -> f32 {
    let operation = operation.replace(" style", r#" inBitDepth="32f" outBitDepth="16f" style"#);
    let file = format!(r#"<ProcessList compCLFversion="3.0" id="a"><!-- one -->{operation}</ProcessList>"#);
    let out = ClfProcess::parse(&file).unwrap().apply([value; 3]);
    assert_eq!(out, [out[0]; 3]);
    out[0]
}

#[test]
fn styles_follow_their_formulas() {
    let close = |found: f32, expected: f64| assert!((f64::from(found) - expected).abs() < 1e-6, "{found} {expected}");
    close(grey(r#"<Log style="log10"/>"#, 100.0), 2.0);
    close(grey(r#"<Log style="log2"></Log>"#, 0.0), -126.0);
    close(grey(r#"<Log style="antiLog2"/>"#, -3.0), 0.125);
    close(grey(r#"<Log style="antiLog10"/>"#, -1.0), 0.1);
    let acescct = |style: &str, v| {
        let text = format!(
            r#"<Log style="{style}"><LogParams base="2" logSideSlope="0.05707762557" logSideOffset="0.5547945205" linSideBreak="0.0078125"/></Log>"#
        );
        grey(&text, v)
    };
    // Values of S-2016-001: 0.18 codes to 0.4135884, and 0 to 0.0729055 on the straight foot.
    close(acescct("cameraLinToLog", 0.18), 0.413_588_4);
    assert!((acescct("cameraLinToLog", 0.0) - 0.072_905_5).abs() < 2e-5);
    for v in [-0.01, 0.0, 0.005, 0.18, 20.0] {
        assert!((acescct("cameraLogToLin", acescct("cameraLinToLog", v)) - v).abs() < 1e-5);
    }
    let params = r#"<ExponentParams exponent="2.4" offset="0.055"/>"#;
    let power = |style: &str, v| grey(&format!(r#"<Exponent style="{style}">{params}</Exponent>"#), v);
    close(power("monCurveRev", 0.18), 0.461_356_13);
    close(power("monCurveFwd", 0.5), 0.214_041_14);
    close(power("monCurveMirrorRev", -0.18), -0.461_356_13);
    assert!((power("monCurveRev", -0.01) + 0.1292).abs() < 1e-3);
    assert!((power("monCurveFwd", -0.1292) + 0.01).abs() < 1e-4);
    let basic =
        |style: &str, v| grey(&format!(r#"<Exponent style="{style}"><ExponentParams exponent="2"/></Exponent>"#), v);
    close(basic("basicFwd", 3.0), 9.0);
    close(basic("basicRev", -4.0), 0.0);
    close(basic("basicMirrorRev", -4.0), -2.0);
    close(basic("basicPassThruRev", -4.0), -4.0);
    let range = |style: &str, v| {
        let ends = "<minInValue>0</minInValue><maxInValue>2</maxInValue><minOutValue>1</minOutValue><maxOutValue>2</maxOutValue>";
        grey(&format!(r#"<Range style="{style}">{ends}</Range>"#), v)
    };
    close(range("Clamp", 1.0), 1.5);
    close(range("Clamp", 5.0), 2.0);
    close(range("noClamp", 4.0), 3.0);
}

/// What OpenColorIO 2.6.0 gives for the same file, not optimised, to seven decimals.
#[test]
fn colour_decision_lists_are_those_of_opencolorio() {
    for (style, expected) in [
        ("Fwd", [[0.298_421_4, 0.282_810_4, 1.0], [0.0, 0.049_64, 1.0], [0.0, 0.880_076_2, 0.618_334_9]]),
        (
            "Rev",
            [
                [0.138_229_7, 0.696_229_5, 0.629_753_5],
                [0.008_853_7, 0.383_11, 0.630_814_9],
                [0.105_092_2, 1.0, 0.456_006_3],
            ],
        ),
        (
            "FwdNoClamp",
            [
                [0.295_549_8, 0.279_938_8, 1.393_738],
                [-0.201_426_9, 0.037_258_9, 2.351_011_8],
                [-0.192_068, 0.880_076_2, 0.618_334_9],
            ],
        ),
        (
            "RevNoClamp",
            [
                [0.138_229_7, 0.696_229_5, 0.629_753_5],
                [-0.023_128_6, 0.385_791_1, 0.870_656_3],
                [0.105_092_2, 1.105_421_1, 0.456_006_3],
            ],
        ),
    ] {
        let file = format!(
            r#"<ProcessList compCLFversion="3" id="a"><ASC_CDL inBitDepth="32f" outBitDepth="32f" style="{style}"><SOPNode>
            <Slope>1.2 0.9 1.1</Slope><Offset>0.02 -0.05 0.1</Offset><Power>0.8 1.3 1.1</Power></SOPNode>
            <SatNode><Saturation>1.4</Saturation></SatNode></ASC_CDL></ProcessList>"#
        );
        let process = ClfProcess::parse(&file).unwrap();
        assert_eq!(process.operations().collect::<Vec<_>>(), ["ASC_CDL"]);
        for (rgb, expected) in [[0.18, 0.5, 0.9], [-0.1, 0.2, 1.4], [0.0, 1.0, 0.5]].into_iter().zip(expected) {
            assert_close(process.apply(rgb), expected, 1e-6, rgb);
        }
        assert_eq!(ClfProcess::parse(&text(&process)).unwrap(), process);
    }
    // Without nodes it clamps.
    let bare = r#"<ProcessList compCLFversion="3" id="a"><ASC_CDL inBitDepth="32f" outBitDepth="32f"/></ProcessList>"#;
    assert_eq!(ClfProcess::parse(bare).unwrap().apply([-1.0, 0.5, 2.0]), [0.0, 0.5, 1.0]);
}

fn refusal(text: &str) -> Error {
    let error = ClfProcess::parse(text).unwrap_err();
    assert!(error.is_text() && error.line().is_some(), "{error}");
    error
}

#[test]
fn bad_operations_are_refused_with_their_line() {
    const DEPTHS: &str = r#"inBitDepth="32f" outBitDepth="32f""#;
    let params = |style: &str, params: &str| format!("<Log {DEPTHS} style=\"{style}\">\n{params}\n</Log>");
    let array = |element: &str, dim: &str, numbers: &str| {
        format!("<{element} {DEPTHS}>\n<Array dim=\"{dim}\">\n{numbers}\n</Array>\n</{element}>")
    };
    let cdl = |style: &str, nodes: &str| format!("<ASC_CDL {DEPTHS} style=\"{style}\">\n{nodes}\n</ASC_CDL>");
    let range = |values: &str| format!("<Range {DEPTHS}>\n{values}\n</Range>");
    let cases = [
        (array("Matrix", "3 3", "1 0 0\n0 1 0\n0 0"), 4, "numbers in an element: found 8, expected 9"),
        (array("Matrix", "3 3", "1 0 0\n0 1 0\n0 0 1\n5"), 8, "numbers: found more than 9, expected at most 9"),
        (array("Matrix", "3 3", "1 0 0\n0 nan 0\n0 0 1"), 6, "number: found \"nan\", expected a number finite"),
        (array("Matrix", "3 3", "1 0 0\n0 x 0\n0 0 1"), 6, "number: found \"x\", expected a number"),
        (array("LUT1D", "2 3", "0 0 0\n1 1e39 1"), 6, "number: found \"1e39\", expected a number finite"),
        (array("LUT1D", "1 3", "0 0 0"), 4, "dim: found \"1 3\", expected 2 to 1048576 entries"),
        (array("LUT1D", "99999999999 1", "0"), 4, "dim: found \"99999999999 1\""),
        (
            array("LUT3D", "100000 100000 100000 3", "0"),
            4,
            "dim: found \"100000 100000 100000 3\", expected three times",
        ),
        (array("LUT3D", "2 3 2 3", "0"), 4, "dim: found"),
        (array("LUT3D", "256 256 256 3", "0 0 0"), 4, "numbers in an element: found 3, expected 50331648"),
        (array("LUT3D", "-2 -2 -2 3", "0"), 4, "dim: found -2 -2 -2 3"),
        (array("LUT3D", "2 2 2 3", "<Deep/>"), 5, "content of an element: found <Deep>, expected text only"),
        (array("LUT3D", "2 2 2 3", "&bomb;"), 5, "reference: found &bomb;"),
        (format!("<Matrix {DEPTHS}/>"), 3, "arrays of an operation: found 0, expected one"),
        (format!("<Sharpen {DEPTHS}/>"), 3, "operation: found <Sharpen>, expected Matrix"),
        (cdl("Sideways", ""), 3, "style: found \"Sideways\", expected Fwd"),
        (cdl("Fwd", "<SOPNode><Slope>1 1</Slope></SOPNode>"), 4, "numbers in an element: found 2, expected 3"),
        (cdl("Fwd", "<SOPNode><Slope>1 -1 1</Slope></SOPNode>"), 3, "expected numbers that are not below 0"),
        (cdl("Rev", "<SOPNode><Slope>1 0 1</Slope></SOPNode>"), 3, "expected numbers above 0"),
        (cdl("Fwd", "<SOPNode><Power>0 1 1</Power></SOPNode>"), 3, "values of ASC_CDL: found Power [0.0, 1.0, 1.0]"),
        (cdl("Rev", "<SatNode><Saturation>0</Saturation></SatNode>"), 3, "expected numbers above 0"),
        (cdl("Fwd", "<SatNode><Slope>1 1 1</Slope></SatNode>"), 4, "found <Slope> in <SatNode>"),
        (cdl("Fwd", "<SatNode><Saturation>1</Saturation><Saturation>1</Saturation></SatNode>"), 3, "Saturation again"),
        ("<Matrix inBitDepth=\"9i\" outBitDepth=\"32f\"/>".to_owned(), 3, "inBitDepth: found \"9i\", expected 32f"),
        ("<Matrix outBitDepth=\"32f\"/>".to_owned(), 3, "inBitDepth: found no such attribute of <Matrix>"),
        (format!("<LUT1D {DEPTHS} halfDomain=\"true\"/>"), 3, "halfDomain: found \"true\", expected false"),
        (format!("<Matrix {DEPTHS} id=\"a\" id=\"b\"/>"), 3, "attribute: found"),
        (range(""), 3, "values of a Range: found none"),
        (range("<minInValue>0</minInValue>"), 3, "values of a Range: found one of In and Out alone"),
        (range("<minInValue>0 1</minInValue>"), 4, "numbers: found more than 1"),
        (range("<minInValue>0</minInValue><minInValue>0</minInValue>"), 3, "values of a Range: found minInValue again"),
        (range("<Array/>"), 4, "content of an operation: found <Array> in <Range>"),
        (params("log3", ""), 3, "style: found \"log3\""),
        (params("linToLog", ""), 3, "LogParams: found a channel without"),
        (params("log2", "<LogParams/>"), 3, "LogParams: found one more"),
        (params("linToLog", "<LogParams base=\"1\"/>"), 3, "base: found \"1\""),
        (params("linToLog", "<LogParams base=\"inf\"/>"), 3, "base: found \"inf\", expected a number finite"),
        (params("linToLog", "<LogParams linSideSlope=\"0\"/>"), 3, "linSideSlope: found \"0\""),
        (params("linToLog", "<LogParams/><LogParams/>"), 3, "LogParams: found one more"),
        (params("linToLog", "<LogParams channel=\"A\"/>"), 3, "channel: found \"A\""),
        (params("cameraLinToLog", "<LogParams linSideBreak=\"-1\"/>"), 3, "linSideBreak: found \"-1\""),
        (
            format!(
                "<Exponent {DEPTHS} style=\"monCurveRev\"><ExponentParams exponent=\"1\" offset=\"0.1\"/></Exponent>"
            ),
            3,
            "offset: found \"0.1\"",
        ),
        (
            format!("<Exponent {DEPTHS} style=\"basicRev\"><ExponentParams exponent=\"0\"/></Exponent>"),
            3,
            "exponent: found \"0\"",
        ),
    ];
    for (operation, line, says) in cases {
        let error = refusal(&format!("<ProcessList compCLFversion=\"3\"\n id=\"a\">\n{operation}\n</ProcessList>\n"));
        assert_eq!(error.line(), Some(line), "{operation}: {error}");
        assert!(error.to_string().contains(says), "{operation}: {error}");
    }
}

#[test]
fn codes_of_integers_are_parts_of_the_largest() {
    let file = |operations: &str| {
        let text = format!(r#"<ProcessList xmlns="{NAMESPACE}"><Id>urn:uuid:0</Id>{operations}</ProcessList>"#);
        ClfProcess::parse(&text).unwrap().apply([0.5, 0.25, 1.0])
    };
    let close = |found: [f32; 3], expected: [f32; 3]| assert_close(found, expected, 1e-6, expected);
    // Code 1023 becomes 4 * 1023 of 4095, and an offset of 409.5 is a tenth.
    let matrix =
        r#"<Matrix inBitDepth="10i" outBitDepth="12i"><Array dim="3 4">4 0 0 409.5 0 4 0 0 0 0 4 0</Array></Matrix>"#;
    close(file(matrix), [0.5 * 4092.0 / 4095.0 + 0.1, 0.25 * 4092.0 / 4095.0, 4092.0 / 4095.0]);
    let lut = r#"<LUT1D inBitDepth="16i" outBitDepth="8i"><Array dim="2 1">0 127.5</Array></LUT1D>"#;
    close(file(lut), [0.25, 0.125, 0.5]);
    let range = r#"<Range inBitDepth="10i" outBitDepth="32f"><minInValue>0</minInValue><maxInValue>1023</maxInValue><minOutValue>0</minOutValue><maxOutValue>2</maxOutValue></Range>"#;
    close(file(range), [1.0, 0.5, 2.0]);
}

const NAMESPACE: &str = "http://www.smpte-ra.org/ns/2136-1/2024";

/// Elements and attributes that our files hold, in the order of \[ST2136-1\]: those of the ProcessList, then those of its nodes.
#[test]
fn files_are_as_st_2136_1_orders_them() {
    const LIST: [&str; 3] = ["Description", "InputDescriptor", "OutputDescriptor"];
    const NODES: [(&str, &[&str], &[&str]); 6] = [
        ("Matrix", &[], &["Array"]),
        ("Range", &["style"], &["minInValue", "maxInValue", "minOutValue", "maxOutValue"]),
        ("Log", &["style"], &["LogParams"]),
        ("Exponent", &["style"], &["ExponentParams"]),
        ("LUT1D", &["interpolation"], &["Array"]),
        ("LUT3D", &["interpolation"], &["Array"]),
    ];
    for lut in structured_kinds() {
        let process = ClfProcess::from_structured(&lut).unwrap().with_name("a look").with_descriptions(["one", "two"]);
        let written = text(&process.with_descriptors("in", "out"));
        assert!(
            written.contains(&format!(
                r#"<ProcessList compCLFversion="3" xmlns="{NAMESPACE}" id="a-look" name="a look">"#
            ))
        );
        let starts = written.lines().filter_map(|line| Some((line, line.trim_start().strip_prefix('<')?)));
        let names = starts.map(|(line, start)| {
            let name = start.split([' ', '>', '/']).next().unwrap();
            (line.len() - line.trim_start().len(), name, line)
        });
        let (mut list, mut children, mut node) = (0, 0, None);
        for (depth, name, line) in names.filter(|(_, name, _)| !name.is_empty()) {
            match depth {
                2 if node.is_none() && LIST.contains(&name) => {
                    let place = LIST.iter().position(|listed| *listed == name).unwrap();
                    assert!(place >= list, "{line}");
                    list = place;
                }
                2 => {
                    let found = NODES.iter().find(|(element, ..)| *element == name).unwrap_or_else(|| panic!("{line}"));
                    for attribute in line.split(' ').filter_map(|word| word.split_once('=').map(|(name, _)| name)) {
                        let common = ["inBitDepth", "outBitDepth"].contains(&attribute);
                        assert!(common || found.1.contains(&attribute), "{line}");
                    }
                    (node, children) = (Some(found), 0);
                }
                4 => {
                    let place = node.unwrap().2.iter().position(|listed| *listed == name);
                    assert!(place.unwrap_or_else(|| panic!("{line}")) >= children, "{line}");
                    children = place.unwrap();
                }
                _ => {}
            }
        }
        assert!(node.is_some());
    }
}

#[test]
fn bad_files_are_refused() {
    for text in [
        "",
        "no XML",
        "<ProcessList",
        "<Other/>",
        "<ProcessList/>",
        "<ProcessList compCLFversion=\"2\" id=\"a\"/>",
        "<ProcessList compCLFversion=\"3\" id=\"a\"/>",
        "<ProcessList xmlns=\"http://www.smpte-ra.org/ns/2136-1/1999\" id=\"a\"><Log inBitDepth=\"32f\" outBitDepth=\"32f\" style=\"log2\"/></ProcessList>",
        "<ProcessList compCLFversion=\"3\" id=\"a\">",
        "<ProcessList compCLFversion=\"3\" id=\"a\"></Other>",
        "<ProcessList compCLFversion=\"3\" id=\"a\"/>more",
        "<ProcessList compCLFversion=\"3\" id=\"a\"/><ProcessList compCLFversion=\"3\" id=\"a\"/>",
        "<!DOCTYPE a [<!ENTITY b \"c\">]><ProcessList compCLFversion=\"3\" id=\"a\"/>",
        "<ProcessList compCLFversion=\"3\" id=\"a\"><Info>",
        "<ProcessList compCLFversion=\"3\" id=\"a\">words</ProcessList>",
    ] {
        refusal(text);
    }
    let many = "<Log inBitDepth=\"32f\" outBitDepth=\"32f\" style=\"log2\"/>".repeat(65);
    let error = refusal(&format!("<ProcessList compCLFversion=\"3\" id=\"a\">{many}</ProcessList>"));
    assert_eq!(error.to_string(), "line 1: operations: found more than 64, expected at most 64");
    let many = "<Description/>".repeat(ClfProcess::MAX_DESCRIPTION_BYTES + 1);
    refusal(&format!("<ProcessList compCLFversion=\"3\" id=\"a\">{many}</ProcessList>"));
}

#[test]
fn no_cut_or_change_of_a_byte_panics() {
    let whole = text(&ClfProcess::from_structured(&structured(IDENTITY, None, Decode::Coded)).unwrap());
    let short = whole.len().min(3000);
    for end in (0..short).filter(|&end| whole.is_char_boundary(end)) {
        assert!(ClfProcess::parse(&whole[..end]).is_err());
    }
    let file = text(&ClfProcess::from_structured(&structured_kinds()[2].with_table(table(2))).unwrap());
    let mut bytes = file.into_bytes();
    for at in (0..bytes.len()).step_by(7) {
        let kept = bytes[at];
        for change in [b'<', b'0', 0xff, b'"'] {
            bytes[at] = change;
            let _ = ClfProcess::read(bytes.as_slice());
        }
        bytes[at] = kept;
    }
}
