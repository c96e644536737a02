use onelight::printing::Calibration;
use onelight::{Aim, FilmProcess, Matching};
use proptest::prelude::*;

use super::cases;
use super::settings::process;

proptest! {
    #![proptest_config(cases(96))]

    #[test]
    fn calibration_reaches_its_aim_or_says_why(process in process()) {
        let film = match process.compile() {
            Ok(film) => film,
            Err(error) => return is_a_sentence(&error.to_string()),
        };
        let grey = film.stages([0.18; 3]);
        let Some(print) = grey.print else { return Ok(()) };
        prop_assert!(film.printer_lights().unwrap().0.to_array().iter().all(|g| g.is_finite() && *g > 0.0));
        // Absolute matching puts the grey card elsewhere on the negative than the printer was set for.
        if process.print.as_ref().is_some_and(|print| print.calibration != Calibration::Exact) || process.matching != Matching::Grey {
            return Ok(());
        }
        let target = film.print_target().unwrap();
        for (found, aim) in print.exposure.to_array().into_iter().zip(target.to_array()) {
            // The solution of three equations in float64, by beams that may nearly be two.
            prop_assert!((found.0 - aim.0).abs() < 1e-6, "{found:?} for {aim:?} of {process:?}");
        }
        if process.aim == Aim::Neutral && process.projector != onelight::Projector::TheatreUnadapted {
            let wanted = 10_f64.powf(-process.neutral_density);
            prop_assert!(grey.linear.iter().all(|v| (v - wanted).abs() < 1e-6), "{:?} for {wanted}", grey.linear);
        }
    }
}

pub(crate) fn is_a_sentence(error: &str) -> Result<(), TestCaseError> {
    prop_assert!(!error.is_empty() && !error.contains('\n') && error.len() < 1000, "{error}");
    Ok(())
}

#[test]
fn most_looks_compile() {
    // Else the laws here would hold of nothing.
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut draw = || process().new_tree(&mut runner).unwrap().current();
    let drawn: Vec<FilmProcess> = (0..60).map(|_| draw()).collect();
    let made = drawn.iter().filter(|process| process.compile().is_ok()).count();
    assert!(made >= 15, "{made} of 60");
    let printed = drawn.iter().filter(|process| process.print.is_some() && process.compile().is_ok()).count();
    assert!(printed >= 8, "{printed} of 60");
}
