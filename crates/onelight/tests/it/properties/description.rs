//! Descriptions of looks: any text is read or refused, and what is read compiles or says why it does not.

use onelight::{
    Aim, Approach, DyeModel, EffectChoice, HeatGlass, Infrared, Matching, PrinterLight, Process, ProcessKeys,
    Projector, Reconstruction, Tail, TransferCurve, Word, WorkingSpace,
};
use proptest::prelude::*;

use super::calibration::is_a_sentence;
use super::cases;
use super::settings::films;

/// Words of a choice, quoted.
fn words<T: Word>() -> BoxedStrategy<String> {
    let words: Vec<String> = T::ALL.iter().map(|(_, word, _)| format!("{word:?}")).collect();
    prop::sample::select(words).boxed()
}

/// A number within the range of its key, as TOML has it.
fn number(range: std::ops::Range<f64>) -> BoxedStrategy<String> {
    range.prop_map(|v| format!("{v:?}")).boxed()
}

fn triple(range: std::ops::Range<f64>) -> BoxedStrategy<String> {
    prop::array::uniform3(range).prop_map(|v| format!("{v:?}")).boxed()
}

/// What no key expects, or only just.
fn hostile() -> BoxedStrategy<String> {
    let fixed = [
        "nan",
        "-nan",
        "inf",
        "-inf",
        "1e308",
        "-1e308",
        "5e-324",
        "-0.0",
        "9223372036854775807",
        "-1",
        "0",
        "31",
        "true",
        "\"\"",
        "\"none\"",
        "\"NONE\"",
        "\"exact\"",
        "\"-1\"",
        "\"99999999999\"",
        "[]",
        "[[]]",
        "[[], []]",
        "[nan, nan, nan]",
        "[inf, 0.0, 0.0]",
        "[1.0, 2.0]",
        "[1.0, 2.0, 3.0, 4.0]",
        "[\"70\", \"70\"]",
        "[\"\"]",
        "{}",
        "{ a = 1 }",
        "2026-01-01",
        "\"\\u0000\"",
        "\"\u{4e00}\u{1f39e}\"",
        "'''\n'''",
        "[1e300, -1e300, 0.0]",
        "[[-1.0, 0.3], [0.5, 0.6]]",
        "[[nan, nan]]",
        "[[0.0, 0.5], [0.0, 0.5]]",
    ];
    let fixed = prop::sample::select(fixed.map(str::to_owned).to_vec());
    prop_oneof![4 => fixed, 1 => "[ -~]{0,12}", 1 => "\\PC{0,8}".prop_map(|text| format!("{text:?}"))].boxed()
}

/// A line for a key: mostly what it takes.
fn line(key: &'static str, value: BoxedStrategy<String>) -> BoxedStrategy<Option<String>> {
    let value = prop_oneof![30 => value, 1 => hostile()];
    prop_oneof![5 => Just(None), 2 => value.prop_map(move |value| Some(format!("{key} = {value}")))].boxed()
}

fn keys() -> Vec<BoxedStrategy<Option<String>>> {
    let filters = prop::sample::subsequence(vec!["70", "99", "98", "2b"], 0..=4).prop_map(|f| format!("{f:?}")).boxed();
    let calibration = prop_oneof![Just("\"exact\"".to_owned()), (0..40).prop_map(|n| format!("\"{n}\""))].boxed();
    vec![
        line("approach", words::<Approach>()),
        line("aim", words::<Aim>()),
        line("neutral_density", number(0.05..3.0)),
        line("overexposure", number(-10.0..10.0)),
        line("dyes", words::<DyeModel>()),
        line("matching", words::<Matching>()),
        line("reconstruction", words::<Reconstruction>()),
        line("light", words::<PrinterLight>()),
        line("filters", filters),
        line("beam_density", triple(0.0..4.0)),
        line("calibration", calibration),
        line("points", triple(-50.0..50.0)),
        line("infrared", words::<Infrared>()),
        line("glass", words::<HeatGlass>()),
        line("red_tail", words::<Tail>()),
        line("projector", words::<Projector>()),
        line("film_format", prop_oneof![Just("\"super16\"".to_owned()), Just("\"none\"".to_owned())].boxed()),
        line("grain", words::<EffectChoice>()),
        line("sharpness", words::<EffectChoice>()),
        line("halation", words::<EffectChoice>()),
        line("seed", prop_oneof![3 => Just("0".to_owned()), 1 => (0u32..).prop_map(|n| n.to_string())].boxed()),
        line("input_space", words::<WorkingSpace>()),
        line("output_space", words::<WorkingSpace>()),
        line("output_coding", words::<TransferCurve>()),
    ]
}

/// The table at the end.
fn first() -> BoxedStrategy<String> {
    let point = (-6.0..6.0, 0.0..1.0).prop_map(|(stops, value): (f64, f64)| format!("[{stops:?}, {value:?}]"));
    let curve = prop::collection::vec(point, 0..4).prop_map(|points| format!("[{}]", points.join(", "))).boxed();
    let lines = vec![
        line("contrast", number(0.0..4.0)),
        line("brightness", number(-1.0..1.0)),
        line("temperature", number(2000.0..20000.0)),
        line("saturation", number(0.0..4.0)),
        line("curve", curve),
    ];
    let table =
        lines.prop_map(|lines| format!("[first]\n{}", lines.into_iter().flatten().collect::<Vec<_>>().join("\n")));
    prop_oneof![4 => Just(String::new()), 1 => table].boxed()
}

/// A description with every key somewhere, in any order.
fn description() -> impl Strategy<Value = String> {
    let films = prop_oneof![
        20 => films().prop_map(|(camera, print)| {
            let alone = if onelight::stock(&camera).unwrap().kind() == onelight::StockKind::Negative { "scan" } else { "none" };
            format!("camera = {camera:?}\nprint = {:?}", print.as_deref().unwrap_or(alone))
        }),
        1 => (hostile(), hostile()).prop_map(|(camera, print)| format!("camera = {camera}\nprint = {print}")),
    ];
    let version =
        prop_oneof![30 => Just("version = 1".to_owned()), 1 => hostile().prop_map(|v| format!("version = {v}"))];
    (version, films, keys(), first()).prop_flat_map(|(version, films, lines, first)| {
        let lines: Vec<String> = [version, films].into_iter().chain(lines.into_iter().flatten()).collect();
        (Just(lines).prop_shuffle(), Just(first)).prop_map(|(lines, first)| format!("{}\n{first}\n", lines.join("\n")))
    })
}

/// Reads, compiles and uses a description as far as it goes.
fn goes_as_far_as_it_can(text: &str) -> Result<Reached, TestCaseError> {
    let keys = match ProcessKeys::from_toml("look.toml", text) {
        Ok(keys) => keys,
        Err(error) => {
            is_a_sentence(&error.to_string())?;
            return Ok(Reached::Text);
        }
    };
    let made = keys.process().and_then(|process| Ok((process.look()?, process)));
    let (look, process) = match made {
        Ok(made) => made,
        Err(error) => {
            is_a_sentence(&error.to_string())?;
            return Ok(Reached::Keys);
        }
    };
    // What compiles holds no NaN, so that it is what is read again.
    prop_assert_eq!(&Process::from_toml("look.toml", &process.to_toml()).unwrap(), &process);
    for rgb in [[0.18; 3], [f64::NAN, 1e30, -1.0], [0.0, 1e-9, 40.0]] {
        let out = look.develop(rgb);
        prop_assert!(out.iter().all(|v| v.is_finite()), "{rgb:?} became {out:?} by {process:?}");
    }
    Ok(Reached::Look)
}

#[derive(Debug, PartialEq)]
enum Reached {
    Text,
    Keys,
    Look,
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn any_description_is_refused_or_compiles_or_says_why_not(text in description()) {
        goes_as_far_as_it_can(&text)?;
    }

    #[test]
    fn any_text_is_read_or_refused(text in "\\PC{0,200}", tail in "[a-z_ =\\[\\]\"0-9.\n]{0,200}") {
        goes_as_far_as_it_can(&text)?;
        goes_as_far_as_it_can(&format!("version = 1\n{tail}"))?;
    }

    #[test]
    fn a_description_with_a_slip_is_no_worse(text in description(), at in any::<prop::sample::Index>(), by in "\\PC{0,3}") {
        let boundaries: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
        let i = boundaries[at.index(boundaries.len())];
        goes_as_far_as_it_can(&format!("{}{by}{}", &text[..i], &text[i..]))?;
        goes_as_far_as_it_can(&text[..i])?;
    }
}

#[test]
fn descriptions_reach_every_end() {
    // Else the laws above would hold of nothing.
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let texts: Vec<String> = (0..150).map(|_| description().new_tree(&mut runner).unwrap().current()).collect();
    let reached: Vec<Reached> = texts.iter().map(|text| goes_as_far_as_it_can(text).unwrap()).collect();
    for end in [Reached::Text, Reached::Keys, Reached::Look] {
        let count = reached.iter().filter(|found| **found == end).count();
        assert!(count >= 5, "{end:?}: {count} of {}", reached.len());
    }
}
