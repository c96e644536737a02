use onelight::{Process, TransferCurve, WorkingSpace};

use super::law::limit;
use super::measure::{Quantity, Row, rows};

/// Everything, and no limit broken.
fn kept(process: &Process) -> Vec<Row> {
    let rows = rows(process, None, || ()).unwrap();
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
    // Above the certificates' figures on these films only where the plain table has ended.
    assert!(worst(&rows, "structured", Quantity::Film) < 0.3 && worst(&rows, "plain", Quantity::Film) < 1.0);
    assert!(worst(&rows, "plain past its end", Quantity::Film) > 1.0);
    let colours: usize = rows.iter().filter(|row| row.form == "film").map(|row| row.colours).sum();
    assert!(colours > 50_000, "{colours}");
    assert!(rows.iter().all(|row| row.colours > 0));
}

#[test]
fn hard_inputs_break_no_limit_in_other_spaces() {
    kept(&Process {
        input_space: WorkingSpace::AcesCg,
        output_space: WorkingSpace::P3,
        output_coding: TransferCurve::Gamma24,
        ..Process::for_camera("kodak-ektachrome-100").unwrap()
    });
}
