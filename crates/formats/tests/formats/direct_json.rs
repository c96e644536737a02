//! The JSON of a direct form: every bit comes back, the equations in the file are those that are applied, damage is refused.

use std::fs;
use std::path::Path;

use onelight_formats::direct_json;
use onelight_lut::{
    Coupling, Develop, DirectForm, DirectParts, DirectPrint, Domain, ExponentialSum, ExponentialTerm, Expose, Lut1d,
    NegativeLight, PowerCoding,
};
use serde_json::{Value, json};

/// The look of the repository.
fn look() -> (Vec<u8>, DirectForm) {
    let path = "../../fixtures/direct/kodak-5207_kodak-2383.direct.json";
    let file = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let form = direct_json::read(file.as_slice()).unwrap();
    (file, form)
}

/// Curves of `size` points with numbers that no short decimal is.
fn curves(size: usize, gains: [f32; 3]) -> Lut1d {
    let domain = Domain::new([-12.5, -13.1, -12.0], [9.0, 10.5, 11.25]).unwrap();
    let entry = |i: usize| gains.map(|gain| gain * (1.0 + (6.0 * i as f32 / (size - 1) as f32 - 3.0).tanh()));
    Lut1d::new(domain, (0..size).map(entry).collect()).unwrap()
}

fn sum(count: usize) -> ExponentialSum {
    let term = |i: usize| {
        let at = i as f32 / 3.0;
        ExponentialTerm { rate: [0.1 + at, 1.0 / (1.0 + at), 0.7], weight: [1e-30, -0.05 * at, 1.0 / 3.0] }
    };
    ExponentialSum::new((0..count).map(term).collect()).unwrap()
}

fn form(print: bool, coding: PowerCoding) -> DirectForm {
    // What only version 2 can say is in half of them.
    let negative = if print { NegativeLight::Compress } else { NegativeLight::Clip };
    let expose = Expose { negative, ..Expose::by([[4.1, 0.3, 0.0], [0.2, 3.9, 0.15], [0.0, 0.1, 5.2]]) };
    let matrix = [[2.2, -2.0, -0.2], [-2.0, 4.0, -2.0], [-0.2, -2.0, 2.2]];
    let coupling = print.then(|| Coupling { curves: curves(9, [0.9; 3]), matrix });
    let develop = Develop { coupling, curves: curves(17, [1.0, 0.9, 0.95]) };
    let print = print.then(|| DirectPrint { exposure: sum(3), curves: curves(33, [0.5, 0.45, 0.5]) });
    DirectForm::new(DirectParts { expose, develop, print, projection: sum(5), coding }).unwrap()
}

fn text(form: &DirectForm, comments: &[&str]) -> String {
    let mut file = Vec::new();
    direct_json::write(&mut file, form, comments).unwrap();
    String::from_utf8(file).unwrap()
}

fn refused(text: &str) -> String {
    let error = direct_json::parse(text).unwrap_err();
    assert!(!error.is_io() && (error.is_text() || error.is_table()), "{error:?}");
    let sentence = error.to_string();
    assert!(!sentence.contains(char::is_control) && sentence.len() < 500, "{sentence}");
    sentence
}

#[test]
fn a_file_holds_every_bit_of_its_form() {
    let codings = [(1.0, 0.0), (2.4, 0.055), (2.2, 0.0), (1.0 / 0.45, 0.099_296_826_809_44)];
    for (exponent, offset) in codings {
        for print in [false, true] {
            let form = form(print, PowerCoding::new(exponent, offset).unwrap());
            let file = text(&form, &["a look", "\u{3b4}E \"0.3\""]);
            let back = direct_json::parse(&file).unwrap();
            assert!(back == form, "{exponent} {offset}");
            assert_eq!(text(&back, &["a look", "\u{3b4}E \"0.3\""]), file);
        }
    }
    let (file, form) = look();
    let comments: Value = serde_json::from_slice(&file).unwrap();
    let comments = comments["comments"].as_array().unwrap();
    let comments: Vec<&str> = comments.iter().map(|line| line.as_str().unwrap()).collect();
    assert!(text(&form, &comments).as_bytes() == file);
}

#[test]
fn version_1_is_read_as_what_it_meant() {
    let form = form(false, PowerCoding::LINEAR);
    let file = text(&form, &[]);
    let old = file
        .replace("\"version\": 2", "\"version\": 1")
        .replace(" \"negative_light\": \"clip\",\n", "")
        .replace(" \"coupling\": null,\n", "");
    assert!(old.len() < file.len() - 30);
    assert!(direct_json::parse(&old).unwrap() == form);
    // What it could not say is not read over.
    let newer = old.replace("\"version\": 1,", "\"version\": 1,\n \"coupling\": null,");
    assert!(refused(&newer).contains("expected version 2 beside it"));
}

#[test]
fn a_triple_of_numbers_is_a_line_and_keys_keep_their_order() {
    let file = text(&form(true, PowerCoding::LINEAR), &[]);
    let start =
        "{\n \"format\": \"onelight direct form\",\n \"version\": 2,\n \"comments\": [],\n \"equations\": [\n  \"in: ";
    assert!(file.starts_with(start), "{file:.200}");
    assert!(file.ends_with(" \"coding\": {\n  \"exponent\": 1.0,\n  \"offset\": 0.0\n }\n}\n"));
    assert!(file.contains("\n \"input_max\": 1e30,\n \"log_floor\": 1e-12,\n \"input\": [\n  [1.0, 0.0, 0.0],\n"));
    let places: Vec<usize> = ["\"entries\"", "\"from\"", "\"to\""].iter().map(|key| file.find(key).unwrap()).collect();
    assert!(places.is_sorted(), "{places:?}");
}

#[test]
fn what_is_no_such_file_is_refused() {
    let file = text(&form(true, PowerCoding::new(2.4, 0.055).unwrap()), &[]);
    let change = |from: &str, to: &str| {
        assert!(file.contains(from), "{from}");
        refused(&file.replacen(from, to, 1))
    };
    for (sentence, says) in [
        (refused(""), "line 1: JSON: EOF while parsing a value; expected a file of"),
        (refused("[1, 2]"), "line 1: JSON: "),
        (
            change("\"version\": 2", "\"version\": 3"),
            "kind of file: found \"onelight direct form\" version 3, expected \"onelight direct form\" version 1 or 2",
        ),
        (
            change("\"version\": 2", "\"version\": 1"),
            "coupling: found a file of version 1 with it, expected version 2 beside it",
        ),
        (change("\"negative_light\"", "\"negative\""), "negative_light: found no such key, expected \"clip\""),
        (change("\"coupling\"", "\"couplings\""), "coupling: found no such key, expected null"),
        (change("\"compress\"", "\"fade\""), "JSON: unknown variant `fade`"),
        (change("[2.2, -2.0, -0.2]", "[2.2, -2.0]"), "JSON: invalid length 2"),
        (change("onelight direct form", "a\\u0007picture"), "kind of file: found \"a picture\" version 2"),
        (change("\"exponent\": 2.4", "\"exponent\": 0.1"), "coding: exponent of a coding: found 0.1, expected"),
        (change("\"exponent\": 2.4", "\"exponent\": 1e400"), "JSON: number out of range"),
        (change("\"projection\"", "\"projektion\""), "JSON: missing field `projection`"),
        (change("\"projection\"", "\"input\""), "JSON: duplicate field `input`"),
        (change("1e30", "65504.0"), "input_max: found 65504, expected the numbers of the format, input_max 1e30"),
        (change("1e-12", "0.0"), "log_floor: found 0, expected"),
        (change("[1.0, 0.0, 0.0]", "[1.0, 0.0]"), "line 21: JSON: invalid length 2"),
        (change("[1.0, 0.0, 0.0]", "[1.0, NaN, 0.0]"), "line 21: JSON: expected value"),
        (change("[1.0, 0.0, 0.0]", "[1.0, null, 0.0]"), "line 21: JSON: invalid type: null"),
        (change("[1.0, 0.0, 0.0]", "[1.0, 1e39, 0.0]"), "line 21: JSON: number out of range"),
        (
            change("-12.5, -13.1", "99.5, -13.1"),
            "curves of the coupling: domain of a table: found [99.5, -13.1, -12.0] to",
        ),
        (change("\"rate\": [0.1,", "\"rate\": [-1e300,"), "JSON: number out of range"),
    ] {
        assert!(sentence.contains(says), "{sentence} for {says}");
    }
    let many = refused(&file.replacen("\"projection\": [", &format!("\"projection\": [{}", term().repeat(1024)), 1));
    assert!(many.contains("JSON: invalid length 1025, expected a list of at most 1024 items"), "{many}");
    let none: Value = serde_json::from_str(&file).unwrap();
    for (key, value, says) in [
        ("projection", json!([]), "projection: size of the sum of exponentials: found 0, expected 1 to 1024"),
        ("exposure", json!("x".repeat(5000)), "JSON: invalid type: string \"xxx"),
        (
            "curves",
            json!({"from": [0, 0, 0], "to": [1, 1, 1], "entries": [[0, 0, 0]]}),
            "curves: size of the 1D LUT: found 1",
        ),
        (
            "curves",
            json!({"from": [0, 0, 0], "to": [1, 1, 1], "entries": [[0, 0, 0], [0, 2e38, 0]]}),
            "curves: entry 1 of a 1D",
        ),
    ] {
        let mut changed = none.clone();
        changed[key] = value;
        let sentence = refused(&changed.to_string());
        assert!(sentence.contains(says), "{sentence} for {says}");
    }
}

fn term() -> &'static str {
    "{\"rate\": [0, 0, 0], \"weight\": [0, 0, 0]},"
}

#[test]
fn endless_and_deep_input_ends() {
    let endless = direct_json::read(std::io::repeat(b' ')).unwrap_err();
    assert!(endless.is_too_large(), "{endless}");
    assert!(refused(&"[".repeat(1 << 20)).contains("line 1"));
    let deep = format!("{{\"comments\": {}", "[".repeat(1 << 20));
    assert!(refused(&deep).contains("line 1"));
}

#[test]
fn no_cut_or_change_of_a_byte_panics() {
    let file = text(&form(true, PowerCoding::new(2.4, 0.055).unwrap()), &["one"]);
    for end in 0..file.trim_end().len() {
        assert!(direct_json::parse(&file[..end]).is_err(), "{end}");
    }
    let mut bytes = file.into_bytes();
    for at in (0..bytes.len()).step_by(5) {
        let kept = bytes[at];
        for change in [b'"', b'9', b'-', 0xff] {
            bytes[at] = change;
            if let Ok(form) = direct_json::read(bytes.as_slice()) {
                assert!(direct_json::parse(&text(&form, &[])).unwrap() == form, "{at}");
            }
        }
        bytes[at] = kept;
    }
}

/// The file as its equations read it.
struct Written(Value);

impl Written {
    fn triple(value: &Value) -> [f64; 3] {
        std::array::from_fn(|i| value[i].as_f64().unwrap())
    }

    fn rows(&self, key: &str) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| Self::triple(&self.0[key][i]))
    }

    fn sum(terms: &Value, x: [f64; 3]) -> [f64; 3] {
        let terms = terms.as_array().unwrap().iter().map(|t| [Self::triple(&t["rate"]), Self::triple(&t["weight"])]);
        terms.fold([0.0; 3], |sum, [rate, weight]| {
            let passed = (-(0..3).map(|k| rate[k] * x[k]).sum::<f64>()).exp2();
            std::array::from_fn(|j| sum[j] + weight[j] * passed)
        })
    }

    fn log2(&self, exposure: [f64; 3]) -> [f64; 3] {
        exposure.map(|e| e.max(self.0["log_floor"].as_f64().unwrap()).log2())
    }

    fn curve(curves: &Value, h: [f64; 3]) -> [f64; 3] {
        let [from, to] = [Self::triple(&curves["from"]), Self::triple(&curves["to"])];
        let entries: Vec<_> = curves["entries"].as_array().unwrap().iter().map(Self::triple).collect();
        std::array::from_fn(|j| {
            let last = entries.len() - 1;
            let at = ((h[j] - from[j]) / (to[j] - from[j])).clamp(0.0, 1.0) * last as f64;
            let i = (at as usize).min(last - 1);
            entries[i][j] + (at - i as f64) * (entries[i + 1][j] - entries[i][j])
        })
    }
}

#[test]
fn the_equations_are_those_of_the_form() {
    for (file, form) in [look(), {
        let form = form(true, PowerCoding::new(2.4, 0.055).unwrap());
        (text(&form, &[]).into_bytes(), form)
    }] {
        equations_are_those_of(&file, &form);
    }
}

fn equations_are_those_of(file: &[u8], form: &DirectForm) {
    let file = Written(serde_json::from_slice(file).unwrap());
    let multiply = |rows: [[f64; 3]; 3], v: [f64; 3]| rows.map(|row| (0..3).map(|k| row[k] * v[k]).sum::<f64>());
    let [exponent, offset] = ["exponent", "offset"].map(|key| file.0["coding"][key].as_f64().unwrap());
    let end = (offset / (exponent - 1.0) * exponent / (1.0 + offset)).powf(exponent);
    let slope = offset / (exponent - 1.0) / end;
    let code = |v: f64| {
        let size = v.abs();
        let coded = if size <= end { slope * size } else { (1.0 + offset) * size.powf(1.0 / exponent) - offset };
        coded.copysign(v)
    };
    for rgb in [[0.18; 3], [0.0, 0.0, 0.0], [4.0, 0.2, 0.01], [0.001, 0.0, 30.0], [-1.0, 2.0, 0.5]] {
        let light = multiply(file.rows("input"), rgb);
        let part = |sign: f64| light.map(|v| (sign * v).clamp(0.0, file.0["input_max"].as_f64().unwrap()));
        let (p, n) = (multiply(file.rows("exposure"), part(1.0)), multiply(file.rows("exposure"), part(-1.0)));
        let compresses = file.0["negative_light"] == "compress";
        let mut h = file.log2(p);
        for ((h, p), n) in h.iter_mut().zip(p).zip(n) {
            let p = p.max(1e-12);
            *h -= if compresses { std::f64::consts::LOG2_E * n.max(0.0).min(88.0 * p) / p } else { 0.0 };
        }
        let coupling = &file.0["coupling"];
        if !coupling.is_null() {
            let matrix: [[f64; 3]; 3] = std::array::from_fn(|i| Written::triple(&coupling["matrix"][i]));
            let shift = multiply(matrix, Written::curve(&coupling["curves"], h));
            h = std::array::from_fn(|i| h[i] + shift[i]);
        }
        let dye = Written::curve(&file.0["curves"], h);
        let print = &file.0["print"];
        let dye = Written::curve(&print["curves"], file.log2(Written::sum(&print["exposure"], dye)));
        let out = Written::sum(&file.0["projection"], dye).map(code);
        let ours = form.apply(rgb.map(|v| v as f32));
        for (a, b) in out.into_iter().zip(ours) {
            assert!((a - f64::from(b)).abs() < 2e-5, "{rgb:?}: {out:?} {ours:?}");
        }
    }
}
