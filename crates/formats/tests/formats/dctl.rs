//! DCTL compiled as C, with a few lines in place of Resolve's types, against the form itself.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use onelight_formats::{dctl, direct_json};
use onelight_lut::{DirectForm, DirectParts, DirectPrint, Expose, NegativeLight, PowerCoding, SceneSampler};

/// What Resolve gives a DCTL, as far as ours uses it.
const SHIM: &str = "#include <math.h>
#include <stdio.h>
#define __DEVICE__ static
#define __CONSTANT__ static const
typedef struct { float x, y, z; } float3;
static float3 make_float3(float x, float y, float z) { float3 v = { x, y, z }; return v; }
#define _fabs fabsf
#define _exp2f exp2f
#define _floorf floorf
#define _fmaxf fmaxf
#define _fminf fminf
#define _log2f log2f
#define _powf powf
";
const MAIN: &str = "int main(void)
{
    float r, g, b;
    while (scanf(\"%f %f %f\", &r, &g, &b) == 3) {
        float3 v = transform(1, 1, 0, 0, r, g, b);
        printf(\"%.9g %.9g %.9g\\n\", v.x, v.y, v.z);
    }
    return 0;
}
";

fn film() -> DirectForm {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/direct/kodak-5207_kodak-2383.direct.json");
    direct_json::read(fs::File::open(path).unwrap()).unwrap()
}

/// Compiles and runs the program over colours.
fn run(form: &DirectForm, colours: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let folder = tempfile::tempdir().unwrap();
    let [source, program, input] = ["look.c", "look", "in.txt"].map(|name| folder.path().join(name));
    let mut text = Vec::new();
    dctl::write(&mut text, form, ["a look", "of two lines\nand a backslash \\"]).unwrap();
    fs::write(&source, [SHIM, std::str::from_utf8(&text).unwrap(), MAIN].concat()).unwrap();
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let compiled = Command::new(compiler)
        .args(["-std=c99", "-O1", "-ffp-contract=off", "-Wall", "-Werror", "-Wno-unused-function", "-o"])
        .arg(&program)
        .arg(&source)
        .arg("-lm")
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let lines = colours.iter().fold(String::new(), |mut text, [r, g, b]| {
        writeln!(text, "{r:e} {g:e} {b:e}").unwrap();
        text
    });
    fs::write(&input, lines).unwrap();
    let output = Command::new(&program).stdin(fs::File::open(&input).unwrap()).output().unwrap();
    assert!(output.status.success());
    let numbers: Vec<f32> =
        String::from_utf8(output.stdout).unwrap().split_ascii_whitespace().map(|word| word.parse().unwrap()).collect();
    numbers.as_chunks().0.to_vec()
}

/// Two libraries' logarithms and powers of 32 bits: what `direct_json` allows its equations too.
const TOLERANCE: f32 = 2e-5;

#[test]
fn the_program_is_the_form() {
    let film = film();
    let parts = film.parts();
    let plain = Expose { negative: NegativeLight::Clip, ..parts.expose };
    let no_print = DirectParts { print: None, coding: PowerCoding::LINEAR, ..parts.clone() };
    let print = parts
        .print
        .as_ref()
        .map(|print| DirectPrint { exposure: print.exposure.clone(), curves: print.curves.clone() });
    let mut uncoupled =
        DirectParts { expose: plain, print, coding: PowerCoding::new(2.4, 0.0).unwrap(), ..parts.clone() };
    uncoupled.develop.coupling = None;
    let hard = [
        [0.0; 3],
        [f32::NAN, 0.18, 0.18],
        [f32::INFINITY, 0.1, 0.2],
        [-0.3, 0.5, 2.0],
        [1e30; 3],
        [-1e35, 1.0, 1.0],
        [1e-30; 3],
        [-1.0; 3],
    ];
    let drawn = SceneSampler::with_seed(-12.0..=12.0, 7).unwrap().take(4000).map(|rgb| rgb.map(|v| v as f32));
    let colours: Vec<[f32; 3]> = hard.into_iter().chain(drawn).collect();
    for (name, form) in [
        ("film", film.clone()),
        ("without a print", DirectForm::new(no_print).unwrap()),
        ("without coupling", DirectForm::new(uncoupled).unwrap()),
    ] {
        let found = run(&form, &colours);
        assert_eq!(found.len(), colours.len());
        for (rgb, found) in colours.iter().zip(found) {
            let expected = form.apply(*rgb);
            let apart = |i: usize| (found[i] - expected[i]).abs() / expected[i].abs().max(1.0);
            let far = (0..3).map(apart).fold(0.0, f32::max);
            assert!(far <= TOLERANCE && !far.is_nan(), "{name}: {rgb:?} becomes {found:?}, expected {expected:?}");
        }
    }
}

#[test]
fn comments_end_with_their_lines() {
    let mut file = Vec::new();
    dctl::write(&mut file, &film(), ["one\ntwo \\", "three"]).unwrap();
    let text = String::from_utf8(file).unwrap();
    assert!(text.starts_with("// one\n// two\n// three\n// In: scene-linear RGB."), "{}", &text[..80]);
}
