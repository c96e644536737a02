//! The `.cube` form against its own laws: what is written comes back, and the numbers of the text decide.

use std::io::{self, BufReader, Read};

use approx::assert_abs_diff_eq;
use onelight_formats::CubeFile;
use onelight_lut::{Domain, Interpolation, Lut1d, Lut3d, PlainLut, SceneSampler, Shaper, bake};

/// Not separable, steep near 0, with values from 1e-9 to above 1.
fn look([r, g, b]: [f64; 3]) -> [f64; 3] {
    [r / (r + 0.18 + 0.1 * g), 1e-9 + g * g / (1.0 + b), (b / 0.01).ln_1p() / 4.0]
}

fn plain() -> PlainLut {
    let shaper = Shaper::log2(0.02, 4.0).unwrap();
    let table = bake(17, &shaper, look, |_| {}).unwrap();
    PlainLut::new(shaper, table, Interpolation::Tetrahedral)
}

fn text(file: &CubeFile) -> String {
    let mut bytes = Vec::new();
    file.write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn curves(domain: Domain) -> Lut1d {
    Lut1d::new(domain, vec![[0.0, -0.0, 1e-30], [0.1, 1.0 / 3.0, f32::MIN_POSITIVE], [1.0, 1e38, 12.5]]).unwrap()
}

#[test]
fn every_form_comes_back_bit_for_bit() {
    let uneven = Domain::new([-1.0, 0.0, 0.1], [1.0, 4.0, 0.3]).unwrap();
    let common = Domain::common(-0.125, 11.52).unwrap();
    let table = plain().table().clone();
    let files = [
        CubeFile::from_1d(curves(Domain::UNIT)),
        CubeFile::from_1d(curves(uneven)),
        CubeFile::from_3d(Domain::UNIT, table.clone()),
        CubeFile::from_3d(uneven, table.clone()),
        CubeFile::from_both(curves(common), common, table).unwrap(),
        CubeFile::from_plain(&plain(), 1000).unwrap(),
    ];
    for file in files {
        let file = file.with_title("a title").with_comments(["one", "", "  two"]);
        let text = text(&file);
        let back = CubeFile::parse(&text).unwrap();
        assert_eq!(back, file);
        assert_eq!(CubeFile::read(text.as_bytes()).unwrap(), file);
        // Equality takes -0 for 0; the text does not.
        assert_eq!(self::text(&back), text);
    }
}

#[test]
fn headers_are_those_of_each_form() {
    let header = |file: &CubeFile, lines: usize| {
        let text = text(file);
        text.lines().take(lines).collect::<Vec<_>>().join("\n")
    };
    let uneven = Domain::new([-1.0, 0.0, 0.0], [1.0, 4.0, 1.0]).unwrap();
    assert_eq!(
        header(&CubeFile::from_1d(curves(uneven)), 4),
        "LUT_1D_SIZE 3\nDOMAIN_MIN -1 0 0\nDOMAIN_MAX 1 4 1\n0 -0 0.000000000000000000000000000001"
    );
    assert_eq!(
        header(&CubeFile::from_3d(Domain::UNIT, Lut3d::identity(2).unwrap()), 4),
        "LUT_3D_SIZE 2\n0 0 0\n1 0 0\n0 1 0"
    );
    assert_eq!(
        header(&CubeFile::from_plain(&plain(), 9).unwrap().with_comments(["from a test"]).with_title("look"), 7),
        "# TITLE \"look\"\n# from a test\nLUT_1D_SIZE 9\nLUT_1D_INPUT_RANGE 0 4\nLUT_3D_SIZE 17\nLUT_3D_INPUT_RANGE 0 1\n0 0 0"
    );
}

#[test]
fn no_number_has_an_exponent() {
    let text = text(&CubeFile::from_1d(curves(Domain::UNIT)));
    for line in text.lines().skip(1) {
        assert!(!line.contains(['e', 'E']), "{line}");
    }
}

#[test]
fn a_file_follows_the_form_it_was_made_from() {
    let plain = plain();
    let file = CubeFile::from_plain(&plain, CubeFile::SHAPER_POINTS).unwrap();
    let edges = [[0.0; 3], [4.0; 3], [1e-3; 3], [9.0, -1.0, f32::NAN]];
    let scene = SceneSampler::new(-12.0..=6.0).unwrap().take(20_000);
    for rgb in scene.map(|rgb| rgb.map(|u| u as f32)).chain(edges) {
        let [want, found] = [plain.apply(rgb), file.apply(rgb, plain.interpolation())];
        for c in 0..3 {
            assert_abs_diff_eq!(found[c], want[c], epsilon = 3e-6 * want[c].max(1.0));
        }
    }
}

#[test]
fn the_shaper_table_is_as_good_as_its_docs_say() {
    let (offset, max) = (0.02, 4.0);
    let shaper = Shaper::log2(offset, max).unwrap();
    for points in [257, 4096] {
        let table = Lut1d::sample(points, [0.0, max], |u| shaper.encode(u)).unwrap();
        let step = max / (points - 1) as f64;
        let stated = (step / offset).powi(2) / (8.0 * (max / offset).ln_1p());
        // The first cell has the strongest bend, and its middle is where a chord is furthest off.
        let u = step / 2.0;
        let found = f64::from(table.apply([u as f32; 3])[0]) - shaper.encode(u);
        assert!(found.abs() <= stated + 1e-7, "{points}");
        if points == 4096 {
            assert!((0.9..1.1).contains(&(found.abs() / stated)));
        }
    }
}

#[test]
fn the_numbers_of_the_text_decide() {
    let file = CubeFile::parse(
        "LUT_1D_SIZE 2\nLUT_1D_INPUT_RANGE 0 2\nLUT_3D_SIZE 2\nLUT_3D_INPUT_RANGE 0 0.5\n\
         0 0 0\n0.5 0.5 0.25\n\
         0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 7\n",
    )
    .unwrap();
    for how in [Interpolation::Trilinear, Interpolation::Tetrahedral] {
        assert_eq!(file.apply([2.0, 0.5, 1.0], how), [1.0, 0.25, 0.25 + blue(how)]);
        assert_eq!(file.apply([9.0, 9.0, 9.0], how), file.apply([2.0; 3], how));
    }

    /// The 7 instead of 1 in the last entry, seen at (1, 1/4, 1/4).
    fn blue(how: Interpolation) -> f32 {
        match how {
            Interpolation::Trilinear => 6.0 / 16.0,
            Interpolation::Tetrahedral => 6.0 / 4.0,
        }
    }
}

#[test]
fn loose_writing_is_read() {
    let want =
        CubeFile::parse("TITLE \"a b\"\n# note\nLUT_1D_SIZE 2\nDOMAIN_MIN 0 0 0\nDOMAIN_MAX 1 2 4\n0 0 0\n1 1 1\n")
            .unwrap();
    for text in [
        "TITLE \"a b\"\r\n# note\r\nLUT_1D_SIZE 2\r\nDOMAIN_MIN 0 0 0\r\nDOMAIN_MAX 1 2 4\r\n0 0 0\r\n1 1 1\r\n",
        "\u{feff}title a b\n\n#note\nlut_1d_size\t2\nDomain_Max\t1\t2\t4\n\n 0\t0 0 \n\n+1 1. 1e0",
        "LUT_1D_SIZE 2\nDOMAIN_MAX 1 2 4\n0 0 0\n  # note\n1 1 .1E1\n\n",
    ] {
        let found = CubeFile::parse(text).unwrap();
        assert_eq!(found.lut1d(), want.lut1d(), "{text}");
        assert_eq!(found.comments(), want.comments(), "{text}");
        assert!(found.title().is_empty() || found.title() == "a b");
    }
    let range = CubeFile::parse("LUT_1D_SIZE 2\nLUT_1D_INPUT_RANGE 0 4\n0 0 0\n1 1 1").unwrap();
    assert_eq!(range.lut1d().unwrap().domain().max(), [4.0; 3]);
    let latin1 = b"TITLE \"caf\xe9\"\nLUT_1D_SIZE 2\n0 0 0\n1 1 1\n";
    assert_eq!(CubeFile::read(&latin1[..]).unwrap().title(), "caf\u{fffd}");
}

#[test]
fn titles_and_comments_stay_on_their_lines() {
    let long = "\u{e4}".repeat(301);
    let file = CubeFile::from_1d(curves(Domain::UNIT))
        .with_title(&format!("a \"b\"\nLUT_3D_SIZE 2 {long}"))
        .with_comments(["first\r\nLUT_1D_SIZE 9\n", "tab\there \u{1}", &long]);
    assert!(file.title().starts_with("a 'b' LUT_3D_SIZE 2 \u{e4}"));
    assert_eq!(file.comments()[..4], ["first", "LUT_1D_SIZE 9", "", "tab here"]);
    assert_eq!(file.comments()[4..].concat(), long);
    let text = text(&file);
    assert!(text.lines().all(|line| line.len() <= 250));
    assert_eq!(CubeFile::parse(&text).unwrap(), file);
}

#[test]
fn hostile_texts_are_named_and_placed() {
    let cases: &[(&str, usize, &str)] = &[
        ("", 1, "found no table"),
        ("\n\n# only this\n", 3, "found no table"),
        ("LUT_3D_SIZE 100000\n", 1, "found \"100000\", expected a whole number from 2 to 256"),
        ("LUT_3D_SIZE 1\n", 1, "from 2 to 256"),
        ("LUT_3D_SIZE -2\n", 1, "from 2 to 256"),
        ("LUT_3D_SIZE 2.0\n", 1, "found \"2.0\""),
        ("LUT_3D_SIZE\n", 1, "found \"\""),
        ("LUT_3D_SIZE 99999999999999999999999999\n", 1, "from 2 to 256"),
        ("LUT_1D_SIZE 1048577\n", 1, "from 2 to 1048576"),
        ("\nLUT_2D_SIZE 4\n", 2, "found \"LUT_2D_SIZE\", expected TITLE"),
        ("\u{0}\n", 1, "keyword: found"),
        ("LUT_1D_SIZE 2\nLUT_1D_SIZE 2\n", 2, "LUT_1D_SIZE again"),
        ("TITLE \"a\"\nTITLE \"b\"\n", 2, "TITLE again"),
        ("0 0 0\n", 1, "before it"),
        ("LUT_1D_SIZE 2\n0 0 0\n", 2, "found 1 data lines, expected 2"),
        ("LUT_3D_SIZE 256\n", 1, "found 0 data lines, expected 16777216"),
        ("LUT_3D_SIZE 2\n0 0 0\n0 0 0\n", 3, "found 2 data lines, expected 8"),
        ("LUT_1D_SIZE 2\n0 0 0\n0 0 0\n0 0 0\n", 4, "expected 2 and no more"),
        ("LUT_1D_SIZE 2\n0 0 0\nTITLE \"x\"\n0 0 0\n", 3, "TITLE after the first data line"),
        ("LUT_1D_SIZE 2\n0 0\n", 2, "numbers in a data line: found 2, expected 3"),
        ("LUT_1D_SIZE 2\n0 0 0 0 0\n", 2, "found 5, expected 3"),
        ("LUT_1D_SIZE 2\n0,5 0 0\n", 2, "found \"0,5\", expected a number"),
        ("LUT_1D_SIZE 2\n0 zero 0\n", 2, "found \"zero\", expected a number"),
        ("LUT_1D_SIZE 2\n0 0 # 0\n", 2, "found \"#\", expected a number"),
        ("LUT_1D_SIZE 2\n0 nan 0\n", 2, "found \"nan\", expected a number finite"),
        ("LUT_1D_SIZE 2\nNaN 0 0\n", 2, "found \"NaN\", expected a number finite"),
        ("LUT_1D_SIZE 2\ninf 0 0\n", 2, "found \"inf\", expected a number finite"),
        ("LUT_1D_SIZE 2\n0 0 -inf\n", 2, "found \"-inf\""),
        ("LUT_1D_SIZE 2\n0 0 1e39\n", 2, "found \"1e39\", expected a number finite"),
        ("DOMAIN_MIN 0 0\n", 1, "numbers in DOMAIN_MIN: found 2, expected 3"),
        ("LUT_1D_INPUT_RANGE 0 1 2\n", 1, "found 3, expected 2"),
        ("LUT_1D_INPUT_RANGE 1 1\n", 1, "expected finite ends"),
        ("LUT_1D_INPUT_RANGE 0 inf\n", 1, "found \"inf\""),
        ("LUT_1D_SIZE 2\nDOMAIN_MIN 0 2 0\n0 0 0\n", 3, "DOMAIN_MIN and DOMAIN_MAX: found"),
        ("LUT_1D_SIZE 2\nLUT_3D_INPUT_RANGE 0 1\n0 0 0\n", 3, "found LUT_3D_INPUT_RANGE"),
        ("LUT_3D_SIZE 2\nLUT_1D_INPUT_RANGE 0 1\n0 0 0\n", 3, "found LUT_1D_INPUT_RANGE"),
        ("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\nDOMAIN_MAX 2 2 2\n0 0 0\n", 4, "found DOMAIN_MIN or DOMAIN_MAX"),
        ("LUT_1D_SIZE 2\nLUT_1D_INPUT_RANGE 0 1\nDOMAIN_MAX 2 2 2\n0 0 0\n", 4, "expected one of the two"),
    ];
    for &(text, line, message) in cases {
        let error = CubeFile::parse(text).unwrap_err();
        assert!(error.is_text() && !error.is_io(), "{text:?}: {error}");
        assert_eq!(error.line(), Some(line), "{text:?}: {error}");
        assert!(error.to_string().contains(message), "{text:?}: {error}");
    }
}

#[test]
fn endless_inputs_end() {
    for (byte, message) in [
        (b'a', "more than 4096 bytes"),
        (b'0', "more than 4096 bytes"),
        (b'\n', "lines without data: found more than 131072"),
    ] {
        let error = CubeFile::read(BufReader::new(io::repeat(byte))).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    }
    let comments = format!("#{}\n", "c".repeat(1000)).repeat(1100);
    let error = CubeFile::parse(&comments).unwrap_err();
    assert!(error.to_string().contains("comments: found more than"), "{error}");
}

#[test]
fn tables_of_video_range_are_refused() {
    let file = "LUT_3D_SIZE 2\nLUT_IN_VIDEO_RANGE\n0 0 0\n";
    let error = CubeFile::parse(file).unwrap_err();
    assert_eq!(error.line(), Some(2));
    assert!(error.to_string().contains("expected a table of full range"), "{error}");
}

#[test]
fn failing_readers_and_writers_are_told_apart() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("unplugged"))
        }
    }
    impl io::Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::Error::other("unplugged"))
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let read = CubeFile::read(BufReader::new(Broken)).unwrap_err();
    let written = CubeFile::from_1d(curves(Domain::UNIT)).write(Broken);
    for error in [read, written.unwrap_err()] {
        assert!(error.is_io() && !error.is_text());
        assert!(error.to_string().ends_with("unplugged"));
        assert!(std::error::Error::source(&error).is_none());
    }
}

#[test]
fn two_tables_want_common_domains() {
    let uneven = Domain::new([0.0; 3], [1.0, 1.0, 2.0]).unwrap();
    let cube = Lut3d::identity(2).unwrap();
    let first = CubeFile::from_both(curves(uneven), Domain::UNIT, cube.clone());
    assert!(first.unwrap_err().to_string().contains("1D table"));
    let second = CubeFile::from_both(curves(Domain::UNIT), uneven, cube);
    assert!(second.unwrap_err().to_string().contains("3D table"));
}
