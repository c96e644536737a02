//! DCTL, the language of `DaVinci` Resolve's shaders: the direct form as a program, for all light and without a table.

use std::fmt::Write as _;
use std::io::Write;

use onelight_lut::{
    Coupling, DirectForm, ExponentialSum, LOG_FLOOR, Lut1d, NegativeLight, PowerCoding, Rows, SCENE_MAX,
};

use crate::error::Error;
use crate::text::one_line;

/// Writes a direct form as a DCTL, which Resolve loads as a LUT or by its plugin: `transform` takes scene-linear RGB and gives
/// display-coded RGB, by the equations of [`crate::direct_json`] in 32-bit floats.
///
/// The curves are constants of the program, 12 bytes an entry: graphics cards have 64 KiB for constants, some five thousand entries
/// in all. Every number is the shortest decimal that reads back as the same `f32`. The program was compiled as C and compared with
/// [`DirectForm::apply`], not run in Resolve.
///
/// # Errors
///
/// If the writer fails; what it took until then is an incomplete file.
///
/// ```
/// use onelight_formats::dctl;
/// # use onelight_lut::{
/// #     Develop, DirectForm, DirectParts, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding,
/// # };
/// # let term = ExponentialTerm { rate: [0.5; 3], weight: [1.0; 3] };
/// # let form = DirectForm::new(DirectParts {
/// #     expose: Expose::by(IDENTITY),
/// #     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-8.0, 4.0], |h| 4.0 - h)? },
/// #     print: None,
/// #     projection: ExponentialSum::new(vec![term])?,
/// #     coding: PowerCoding::new(2.4, 0.055)?,
/// # })?;
/// let mut file = Vec::new();
/// dctl::write(&mut file, &form, ["input: scene-linear, 1 is diffuse white"])?;
/// let text = String::from_utf8(file)?;
/// assert!(text.starts_with("// input: scene-linear") && text.contains("__DEVICE__ float3 transform("));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write<S: AsRef<str>>(
    mut writer: impl Write,
    form: &DirectForm,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    writer.write_all(program(form, comments).as_bytes())?;
    writer.flush()?;
    Ok(())
}

fn program<S: AsRef<str>>(form: &DirectForm, comments: impl IntoIterator<Item = S>) -> String {
    let parts = form.parts();
    let mut text = String::new();
    for comment in comments {
        for line in comment.as_ref().split('\n') {
            // A backslash would draw the next line into the comment.
            let _ = writeln!(text, "// {}", one_line(line).trim_end_matches(['\\', ' ']));
        }
    }
    text += "// In: scene-linear RGB. Out: display-coded RGB.\n\n";
    if let Some(Coupling { curves, .. }) = &parts.develop.coupling {
        curve(&mut text, "coupling", curves);
    }
    curve(&mut text, "film", &parts.develop.curves);
    if let Some(print) = &parts.print {
        curve(&mut text, "print", &print.curves);
    }
    coding(&mut text, &parts.coding);

    text += "__DEVICE__ float3 transform(int p_Width, int p_Height, int p_X, int p_Y, float p_R, float p_G, float p_B)\n{\n";
    for (name, from) in [("r", "p_R"), ("g", "p_G"), ("b", "p_B")] {
        let max = number(SCENE_MAX);
        // NaN is unequal to itself, and counts as 0.
        let _ = writeln!(text, "    float {name} = {from} == {from} ? _fminf(_fmaxf({from}, -{max}), {max}) : 0.0f;");
    }
    exposure(&mut text, &parts.expose.input, &parts.expose.matrix, parts.expose.negative);
    if let Some(Coupling { matrix, .. }) = &parts.develop.coupling {
        for channel in 0..3 {
            let _ = writeln!(text, "    float q{channel} = onelight_coupling(h{channel}, {channel});");
        }
        for (channel, row) in matrix.iter().enumerate() {
            let _ = writeln!(text, "    h{channel} += {};", product(row, ["q0", "q1", "q2"]));
        }
    }
    for channel in 0..3 {
        let _ = writeln!(text, "    float x{channel} = onelight_film(h{channel}, {channel});");
    }
    let mut dye = "x";
    if let Some(print) = &parts.print {
        sum(&mut text, &print.exposure, "x", "e");
        for channel in 0..3 {
            let floor = number(LOG_FLOOR);
            let _ = writeln!(
                text,
                "    float y{channel} = onelight_print(_log2f(_fmaxf(e{channel}, {floor})), {channel});"
            );
        }
        dye = "y";
    }
    sum(&mut text, &parts.projection, dye, "v");
    text += "    return make_float3(onelight_code(v0), onelight_code(v1), onelight_code(v2));\n}\n";
    text
}

/// The log2 exposures `h0`, `h1` and `h2` of the light `r`, `g` and `b`.
fn exposure(text: &mut String, input: &Rows, matrix: &Rows, negative: NegativeLight) {
    let (floor, max) = (number(LOG_FLOOR), number(SCENE_MAX));
    for (channel, row) in input.iter().enumerate() {
        let _ = writeln!(text, "    float u{channel} = {};", product(row, ["r", "g", "b"]));
    }
    for channel in 0..3 {
        let _ = writeln!(text, "    float a{channel} = _fminf(_fmaxf(u{channel}, 0.0f), {max});");
        if negative == NegativeLight::Compress {
            let _ = writeln!(text, "    float m{channel} = _fminf(_fmaxf(-u{channel}, 0.0f), {max});");
        }
    }
    for (channel, row) in matrix.iter().enumerate() {
        let _ = writeln!(text, "    float p{channel} = _fmaxf({}, {floor});", product(row, ["a0", "a1", "a2"]));
        let _ = write!(text, "    float h{channel} = _log2f(p{channel})");
        if negative == NegativeLight::Compress {
            let n = product(row, ["m0", "m1", "m2"]);
            let log2_e = number(std::f32::consts::LOG2_E);
            let _ = write!(text, " - {log2_e} * _fminf(_fmaxf({n}, 0.0f), 88.0f * p{channel}) / p{channel}");
        }
        text.push_str(";\n");
    }
}

/// The table of a curve, and the function that reads it.
fn curve(text: &mut String, name: &str, curve: &Lut1d) {
    let entries = curve.entries();
    let _ = writeln!(text, "__CONSTANT__ float onelight_{name}_entries[{}] = {{", 3 * entries.len());
    for entry in entries {
        let _ = writeln!(text, "    {},", entry.map(number).join(", "));
    }
    text.push_str("};\n\n");
    let steps = (entries.len() - 1) as f32;
    let domain = curve.domain();
    let per_channel = |values: [f32; 3]| {
        let [first, second, third] = values.map(number);
        format!("channel == 0 ? {first} : channel == 1 ? {second} : {third}")
    };
    let scale = std::array::from_fn(|i| steps / (domain.max()[i] - domain.min()[i]));
    let _ = write!(
        text,
        "__DEVICE__ float onelight_{name}(float h, int channel)\n{{\n\
         \x20   float from = {};\n\
         \x20   float scale = {};\n\
         \x20   float at = _fminf(_fmaxf((h - from) * scale, 0.0f), {});\n\
         \x20   int below = (int)_fminf(_floorf(at), {});\n\
         \x20   float part = at - (float)below;\n\
         \x20   float low = onelight_{name}_entries[3 * below + channel];\n\
         \x20   float high = onelight_{name}_entries[3 * below + 3 + channel];\n\
         \x20   return low * (1.0f - part) + high * part;\n}}\n\n",
        per_channel(domain.min()),
        per_channel(scale),
        number(steps),
        number(steps - 1.0),
    );
}

/// Sums of exponentials `to0`, `to1` and `to2` of three numbers.
fn sum(text: &mut String, sum: &ExponentialSum, of: &str, to: &str) {
    let _ = writeln!(text, "    float {to}0 = 0.0f, {to}1 = 0.0f, {to}2 = 0.0f;");
    let names: [String; 3] = std::array::from_fn(|i| format!("{of}{i}"));
    let names = [0, 1, 2].map(|i| names[i].as_str());
    for (index, term) in sum.terms().iter().enumerate() {
        let power = product(&term.rate, names);
        let _ = writeln!(text, "    float {to}_{index} = _exp2f(-({power}));");
        for (channel, weight) in term.weight.iter().enumerate() {
            let _ = writeln!(text, "    {to}{channel} += {} * {to}_{index};", number(*weight));
        }
    }
}

/// The function that codes a value for the display, odd about 0.
fn coding(text: &mut String, coding: &PowerCoding) {
    text.push_str("__DEVICE__ float onelight_code(float v)\n{\n");
    let (exponent, offset) = (coding.exponent(), coding.offset());
    if exponent == 1.0 {
        text.push_str("    return v;\n}\n\n");
        return;
    }
    text.push_str("    float size = _fabs(v);\n");
    let single = |v: f64| number(v as f32);
    let power = format!("{} * _powf(size, {}) - {}", single(1.0 + offset), single(1.0 / exponent), single(offset));
    if offset == 0.0 {
        let _ = writeln!(text, "    float code = {power};");
    } else {
        let end = (offset / (exponent - 1.0) * exponent / (1.0 + offset)).powf(exponent);
        let slope = offset / (exponent - 1.0) / end;
        let _ = writeln!(text, "    float code = size <= {} ? {} * size : {power};", single(end), single(slope));
    }
    text.push_str("    return v < 0.0f ? -code : code;\n}\n\n");
}

/// A row times three variables.
fn product(row: &[f32; 3], names: [&str; 3]) -> String {
    let [a, b, c] = row.map(number);
    format!("{a} * {} + {b} * {} + {c} * {}", names[0], names[1], names[2])
}

/// A number of C; those below 0 in brackets.
fn number(value: f32) -> String {
    if value < 0.0 { format!("({value:?}f)") } else { format!("{value:?}f") }
}
