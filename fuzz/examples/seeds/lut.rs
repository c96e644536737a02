//! Files of tables: every keyword of `.cube`, every operation and style of CLF, `.spi3d`, and entries for KTX2.

use onelight::StructuredSettings;
use onelight::lut::{Domain, Interpolation, Lut1d, Lut3d, PlainLut, Shaper};
use onelight_formats::{ClfProcess, CubeFile, direct_json, spi3d};

use super::{Fault, Seed};

pub(super) fn cube() -> Result<Vec<Seed>, Fault> {
    let curve = || Lut1d::sample(4, [0.0, 2.0], |v| v * v);
    let table = || Lut3d::identity(2);
    let files = [
        ("curve", CubeFile::from_1d(curve()?).with_title("a curve").with_comments(["one", "", "two"])),
        ("table", CubeFile::from_3d(Domain::new([-1.0; 3], [0.5, 1.0, 2.0])?, table()?)),
        ("both", CubeFile::from_both(curve()?, Domain::UNIT, table()?)?.with_title("both")),
    ];
    let mut seeds = Vec::new();
    for (name, file) in files {
        let mut bytes = Vec::new();
        file.write(&mut bytes)?;
        seeds.push((format!("{name}.cube"), bytes));
    }
    let texts = [
        ("1d-range", "lut_1d_size 2\r\nLUT_1D_INPUT_RANGE -1 2\r\n0 0\t0\r\n\r\n1e0 +1 .5\r\n"),
        (
            "3d-range",
            "TITLE no quotes\nLUT_3D_SIZE 2\nLUT_3D_INPUT_RANGE 0 4\n# before the data\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n# within\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n",
        ),
        ("refused-size", "LUT_3D_SIZE 4096\n0 0 0\n"),
        ("refused-nan", "LUT_1D_SIZE 2\nnan 0 0\n1 1 1\n"),
    ];
    seeds.extend(texts.map(|(name, text)| (format!("{name}.cube"), text.as_bytes().to_vec())));
    Ok(seeds)
}

pub(super) fn clf() -> Result<Vec<Seed>, Fault> {
    let plain = PlainLut::new(Shaper::log2(0.02, 4.0)?, Lut3d::identity(2)?, Interpolation::Tetrahedral);
    let mut written = Vec::new();
    ClfProcess::from_plain(&plain)?
        .with_name("look <1> & \"two\"")
        .with_descriptions(["a < b & c\nsecond line"])
        .with_descriptors("scene", "display")
        .write(&mut written)?;
    let mut seeds = vec![("plain.clf".to_owned(), written)];
    let operations = [
        ("matrix", r#"<Matrix D><Array dim="3 4">1 0 0 .5 0 2 0 0 0 0 1 -1</Array></Matrix>"#.to_owned()),
        ("matrix-old", r#"<Matrix D><Array dim="3 3 3">1 0 0 0 2 0 0 0 1</Array></Matrix>"#.to_owned()),
        ("range-clamp", range("Clamp")),
        ("range-continue", range("noClamp")),
        ("range-one-end", "<Range D><minInValue>0</minInValue><minOutValue>0</minOutValue></Range>".to_owned()),
        ("log-bare", ["log2", "log10", "antiLog2", "antiLog10"].map(|s| format!(r#"<Log D style="{s}"/>"#)).concat()),
        ("log-curves", ["linToLog", "logToLin"].map(|s| format!(
            r#"<Log D style="{s}"><LogParams base="10" logSideSlope=".3" logSideOffset=".4" linSideSlope="5" linSideOffset=".01"/></Log>"#
        )).concat()),
        ("log-camera", ["cameraLinToLog", "cameraLogToLin"].map(|s| format!(
            r#"<Log D style="{s}"><LogParams channel="R" linSideBreak=".01"/><LogParams channel="G" linSideBreak=".1" linearSlope="2"/><LogParams channel="B" linSideBreak=".2"/></Log>"#
        )).concat()),
        ("exponent-basic", exponents(&["basicFwd", "basicRev", "basicMirrorFwd", "basicMirrorRev", "basicPassThruFwd", "basicPassThruRev"], "exponent=\"2.4\"")),
        ("exponent-curve", exponents(&["monCurveFwd", "monCurveRev", "monCurveMirrorFwd", "monCurveMirrorRev"], "exponent=\"2.4\" offset=\".055\"")),
        ("lut1d", r#"<LUT1D D interpolation="linear"><Array dim="3 1">0 .1 1</Array></LUT1D><LUT1D D><Array dim="2 3">0 0 0 1 .5 2</Array></LUT1D>"#.to_owned()),
        ("lut3d", r#"<LUT3D D interpolation="trilinear"><Array dim="2 2 2 3">0 0 0 0 0 1 0 1 0 0 1 1 1 0 0 1 0 1 1 1 0 1 1 1</Array></LUT3D>"#.to_owned()),
        ("text", "<Info><Deep/></Info><Description><![CDATA[a < b]]> &amp; &#233;</Description><!-- a comment --><Log D style=\"log2\"><Description>within</Description></Log>".to_owned()),
        ("cdl", ["Fwd", "Rev", "FwdNoClamp", "RevNoClamp"].map(|s| format!(
            r#"<ASC_CDL D style="{s}"><SOPNode><Slope>1.2 .9 1.1</Slope><Offset>.02 -.05 .1</Offset><Power>.8 1.3 1</Power></SOPNode><SatNode><Saturation>1.4</Saturation></SatNode></ASC_CDL>"#
        )).concat()),
        ("refused-depth", r#"<Matrix inBitDepth="10i" outBitDepth="32f"/>"#.to_owned()),
    ];
    seeds.extend(operations.map(|(name, operations)| {
        let operations = operations.replace(" D", r#" inBitDepth="16f" outBitDepth="32f""#);
        let text = format!(
            "<?xml version=\"1.0\"?>\n<ProcessList compCLFversion=\"3.0\" id=\"a\" xmlns=\"urn:AMPAS:CLF:v3.0\">\n\
             <InputDescriptor>in</InputDescriptor>\n{operations}\n</ProcessList>\n"
        );
        (format!("{name}.clf"), text.into_bytes())
    }));
    let academy = r#"compCLFversion="3.0" id="a""#;
    let (matrix, log) = (
        r#"<Matrix inBitDepth="10i" outBitDepth="12i"><Array dim="3 3">4 0 0 0 4 0 0 0 4</Array></Matrix>"#,
        r#"<Log inBitDepth="32f" outBitDepth="32f" style="log2"/>"#,
    );
    let lut = |depth| format!(r#"<LUT1D inBitDepth="{depth}" outBitDepth="32f"><Array dim="2 1">0 1</Array></LUT1D>"#);
    let namespaced = r#"compCLFversion="3.0" id="a" xmlns="urn:AMPAS:CLF:v3.0""#;
    let roots = [
        ("integers", namespaced, matrix.to_owned() + &lut("12i")),
        ("smpte", r#"xmlns="http://www.smpte-ra.org/ns/2136-1/2024""#, format!("<Id>urn:uuid:0</Id>{log}")),
        ("refused-depths", namespaced, matrix.to_owned() + &lut("10i")),
        ("refused-empty", academy, String::new()),
        ("refused-nameless", r#"compCLFversion="3.0" id="""#, log.to_owned()),
    ];
    seeds.extend(roots.map(|(name, root, operations)| {
        let text = format!(
            "<?xml version=\"1.0\"?>\n<ProcessList {root}>\n<InputDescriptor>in</InputDescriptor>\n{operations}\n</ProcessList>\n"
        );
        (format!("{name}.clf"), text.into_bytes())
    }));
    // All that a look needs, with the smallest table.
    let film = onelight::Process::default().compile()?;
    let lut = film.structured(&StructuredSettings { size: 2, ..Default::default() })?;
    let parts = lut.parts().clone();
    let curves = |curves: &Lut1d| Lut1d::new(*curves.domain(), curves.entries().iter().step_by(256).copied().collect());
    let mix = parts
        .mix
        .as_ref()
        .map(|mix| -> Result<_, Fault> { Ok(onelight::lut::Mix { curves: curves(&mix.curves)?, ..mix.clone() }) });
    let develop = onelight::lut::Develop { coupling: None, curves: curves(&parts.develop.curves)? };
    let small = onelight::lut::StructuredParts { develop, mix: mix.transpose()?, ..parts };
    let mut structured = Vec::new();
    ClfProcess::from_structured(&onelight::lut::StructuredLut::new(small)?)?.write(&mut structured)?;
    seeds.push(("structured.clf".to_owned(), structured));
    Ok(seeds)
}

fn range(style: &str) -> String {
    format!(
        "<Range D style=\"{style}\"><minInValue>0</minInValue><maxInValue>2</maxInValue>\
         <minOutValue>1</minOutValue><maxOutValue>2</maxOutValue></Range>"
    )
}

fn exponents(styles: &[&str], parameters: &str) -> String {
    let each = |style| format!(r#"<Exponent D style="{style}"><ExponentParams {parameters}/></Exponent>"#);
    styles.iter().map(each).collect()
}

pub(super) fn spi3d() -> Result<Vec<Seed>, Fault> {
    let mut two = Vec::new();
    spi3d::write(&mut two, &Lut3d::identity(2)?)?;
    let mut three = Vec::new();
    spi3d::write(&mut three, &Lut3d::identity(3)?)?;
    let text = String::from_utf8(two.clone())?;
    let mut shuffled: Vec<&str> = text.lines().collect();
    shuffled[3..].reverse();
    let shuffled = format!("# a comment\r\n\r\n{}\r\n", shuffled.join("\r\n"));
    let huge = "SPILUT 1.0\n3 3\n4096 4096 4096\n0 0 0 0 0 0\n";
    Ok(vec![
        ("two.spi3d".into(), two),
        ("three.spi3d".into(), three),
        ("shuffled.spi3d".into(), shuffled.into_bytes()),
        ("refused-size.spi3d".into(), huge.into()),
    ])
}

pub(super) fn direct_json() -> Result<Vec<Seed>, Fault> {
    use onelight::lut::{
        Coupling, Develop, DirectForm, DirectParts, DirectPrint, ExponentialSum, ExponentialTerm, Expose, IDENTITY,
        NegativeLight, PowerCoding,
    };

    let curves = || Lut1d::sample(4, [-8.0, 4.0], |h| 0.1 * (8.0 + h));
    let sum = |terms: u8| {
        let term = |i: u8| ExponentialTerm { rate: [1.0, 0.5, f32::from(i)], weight: [0.5, 0.25, -0.125] };
        ExponentialSum::new((0..terms).map(term).collect())
    };
    let print = || -> Result<_, Fault> { Ok(DirectPrint { exposure: sum(1)?, curves: curves()? }) };
    let file = |print: Option<DirectPrint>, coding: PowerCoding| -> Result<Vec<u8>, Fault> {
        // What only version 2 can say is beside a print.
        let matrix = [[0.5, -0.5, 0.0], [-0.5, 1.0, -0.5], [0.0, -0.5, 0.5]];
        let coupling = print.as_ref().map(|_| curves().map(|curves| Coupling { curves, matrix })).transpose()?;
        let negative = if print.is_some() { NegativeLight::Compress } else { NegativeLight::Clip };
        let develop = Develop { coupling, curves: curves()? };
        let expose = Expose { negative, ..Expose::by(IDENTITY) };
        let parts = DirectParts { expose, develop, print, projection: sum(2)?, coding };
        let mut file = Vec::new();
        direct_json::write(&mut file, &DirectForm::new(parts)?, ["a look"])?;
        Ok(file)
    };
    let whole = file(Some(print()?), PowerCoding::new(2.4, 0.055)?)?;
    let text = String::from_utf8(whole.clone())?;
    let linear = file(None, PowerCoding::LINEAR)?;
    let old = String::from_utf8(linear.clone())?
        .replace("\"version\": 2", "\"version\": 1")
        .replace(" \"negative_light\": \"clip\",\n", "")
        .replace(" \"coupling\": null,\n", "");
    Ok(vec![
        ("print.json".into(), whole),
        ("linear.json".into(), linear),
        ("version-1.json".into(), old.into()),
        ("refused-version.json".into(), text.replace("\"version\": 2", "\"version\": 3").into()),
        ("refused-number.json".into(), text.replace("0.25", "1e39").into()),
        ("refused-shape.json".into(), text.replace("[1.0, 0.0, 0.0]", "[1.0, 0.0]").into()),
    ])
}

/// The size, the comment with its length, entries: see the target.
pub(super) fn ktx2() -> Vec<Seed> {
    let file = |size: u8, comment: &str, values: &[f32]| {
        let mut bytes = vec![size, comment.len() as u8];
        bytes.extend(comment.as_bytes());
        bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    };
    let ramp: Vec<f32> = (0..81).map(|i| i as f32 * 0.25 - 3.0).collect();
    vec![
        ("two".into(), file(0, "", &ramp[..24])),
        ("three".into(), file(1, "a comment\nof two lines", &ramp)),
        ("nine".into(), file(7, "\u{3b4}E", &[])),
        ("refused-half".into(), file(0, "x", &[7e4])),
        ("refused-nan".into(), file(0, "x", &[f32::NAN])),
    ]
}
