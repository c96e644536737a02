use onelight::{ColourSpaces, FilmProcess, Process, TransferCurve, WorkingSpace};

use super::cases::{Case, Order, general};
use super::law::limit;
use super::measure::{Quantity, Row, each, largest, neighbours, not_finite, rows};

/// Everything, and no limit broken.
fn kept(process: &Process) -> Vec<Row> {
    let rows = rows(&process.clone().into(), None, || ()).unwrap();
    for row in &rows {
        for (quantity, worst) in &row.found {
            let most = limit(row, *quantity).unwrap_or(f64::INFINITY);
            assert!(worst.value <= most, "{quantity:?}: {} of {most} at {:?} of {row:?}", worst.value, worst.at);
        }
    }
    rows
}

fn worst(rows: &[Row], form: &str, quantity: Quantity) -> f64 {
    let of_form = rows.iter().filter(|row| row.form == form);
    let found = of_form.flat_map(|row| &row.found).filter(|(q, _)| *q == quantity).map(|(_, worst)| worst.value);
    found.reduce(f64::max).unwrap_or_else(|| panic!("no {quantity:?} of {form}"))
}

#[test]
fn hard_inputs_break_no_limit_on_a_negative() {
    let rows = kept(&Process::default());
    // What was measured is not nothing.
    for form in ["direct", "structured", "plain"] {
        assert!(worst(&rows, form, Quantity::Rounding) > 1e-7 && worst(&rows, form, Quantity::Film) > 0.01, "{form}");
        assert!(worst(&rows, form, Quantity::Vectors) > 1e-7 && worst(&rows, form, Quantity::Step) > 10.0, "{form}");
    }
    assert!(worst(&rows, "film", Quantity::Step) > 10.0);
    // Above the certificates' figures on these films only where the plain table has ended, which it has outside the sRGB primaries too.
    assert!(worst(&rows, "structured", Quantity::Film) < 0.34);
    let talk = kept(&FilmProcess::default().as_in_the_talk().into());
    assert!(worst(&talk, "structured", Quantity::Film) < 0.3 && worst(&talk, "plain", Quantity::Film) < 1.0);
    assert!(worst(&rows, "plain past its end", Quantity::Film) > 1.0);
    let colours: usize = rows.iter().filter(|row| row.form == "film").map(|row| row.colours).sum();
    assert!(colours > 50_000, "{colours}");
    assert!(rows.iter().all(|row| row.colours > 0));
}

#[test]
fn hard_inputs_break_no_limit_in_other_spaces() {
    let mut process = Process::for_camera("kodak-ektachrome-100").unwrap();
    *process.spaces_mut() = ColourSpaces {
        input_space: WorkingSpace::AcesCg,
        output_space: WorkingSpace::P3,
        output_coding: TransferCurve::Gamma24,
        ..ColourSpaces::default()
    };
    kept(&process);
}

/// Two strands behind two colours of another case.
fn greys_and_a_circle() -> (Case, usize) {
    let grey = |i: i32| [i as f32; 3];
    (Case::new("a case").with(Order::Greys, (0..4).map(grey)).with(Order::Circle, (10..13).map(grey)), 2)
}

#[test]
fn faults_are_found_where_they_are() {
    let (case, first) = greys_and_a_circle();
    let values = [9.0, 9.0, 0.1, 0.2, 0.15, 0.4, 0.0, 3.0, 5.0];
    let step = |a: usize, b: usize| f64::abs(values[a] - values[b]);
    // From the last of the circle to its first; never from one strand to the next.
    let found = largest(&case, first, step).unwrap();
    assert_eq!((found.value, found.at), (5.0, [12.0; 3]));
    let is_greys = |strand: &super::cases::Strand| strand.order == Order::Greys;
    let fall = neighbours(&case, first, is_greys, |a, b| (values[a] - values[b]).max(0.0)).unwrap();
    assert!((fall.value - 0.05).abs() < 1e-12 && fall.at == [1.0; 3]);
    assert_eq!(each(&case, first, |i| values[i]).at, [12.0; 3]);
    let mut pixels = vec![[0.0; 3]; 9];
    (pixels[0][0], pixels[4][1], pixels[8][2]) = (f64::NAN, f64::NAN, f64::INFINITY);
    let found = not_finite(&case, first, |i| pixels[i]);
    assert_eq!((found.value, found.at), (2.0, [2.0; 3]));
    let loose = Case::new("loose").with(Order::Loose, [[1.0; 3]; 2]);
    assert!(largest(&loose, 0, step).is_none());
}

#[test]
fn the_cases_are_what_they_say() {
    let cases = general(WorkingSpace::Srgb).unwrap();
    let colours = |name: &str| -> Vec<[f32; 3]> {
        let case = cases.iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"));
        case.strands.iter().flat_map(|strand| strand.colours.clone()).collect()
    };
    let holds = |name: &str, of: &dyn Fn(&[f32; 3]) -> bool| colours(name).iter().any(of);
    assert!(colours("zeros").iter().any(|rgb| rgb.iter().all(|v| v.to_bits() == (-0.0_f32).to_bits())));
    assert!(holds("subnormals", &|rgb| rgb[1].is_subnormal() && rgb[0] == 0.18));
    assert!(holds("1e-12 to 1e30", &|rgb| *rgb == [1e-12; 3]) && holds("1e-12 to 1e30", &|rgb| *rgb == [1e30; 3]));
    for c in 0..3 {
        assert!(holds("NaN and infinities", &|rgb| rgb[c].is_nan() && rgb[(c + 1) % 3] == 0.18));
        assert!(holds("NaN and infinities", &|rgb| rgb[c] == f32::NEG_INFINITY && rgb[(c + 1) % 3] == f32::INFINITY));
        assert!(holds("negatives", &|rgb| rgb[c] < 0.0 && rgb[(c + 1) % 3] == 0.18));
    }
    // Outside sRGB, all of it, from -10 to +14 stops.
    let locus = colours("spectral locus");
    assert!(locus.len() == 31 * 25 && locus.iter().filter(|rgb| rgb.iter().any(|v| *v < 0.0)).count() > 700);
    let peaks = locus.iter().map(|rgb| rgb.iter().copied().fold(0.0, f32::max));
    let (low, high) = peaks.fold((f32::MAX, 0.0_f32), |(low, high), v| (low.min(v), high.max(v)));
    assert!((low / 0.18 * 1024.0 - 1.0).abs() < 1e-5 && (high / 0.18 / 16384.0 - 1.0).abs() < 1e-5);
}
