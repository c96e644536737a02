//! Random looks that do not contradict themselves.

use onelight::printing::Calibration;
use onelight::{
    Aim, ColourSpaces, DyeModel, FilmProcess, Filters, HeatGlass, Infrared, Matching, PrinterLight, Printing,
    Projector, Reconstruction, StockKind, Tail, TransferCurve, Word, WorkingSpace, Wratten, stock, stock_ids,
};
use proptest::prelude::*;

pub(crate) fn word<T: Word + std::fmt::Debug>() -> impl Strategy<Value = T> {
    (0..T::ALL.len()).prop_map(|i| T::ALL[i].0)
}

fn of_kind(kind: StockKind) -> impl Strategy<Value = String> {
    let ids: Vec<String> = stock_ids().filter(|id| stock(id).unwrap().kind() == kind).map(str::to_owned).collect();
    prop::sample::select(ids)
}

/// A camera film, and a print film where it needs one.
pub(crate) fn films() -> impl Strategy<Value = (String, Option<String>)> {
    prop_oneof![
        3 => (of_kind(StockKind::Negative), of_kind(StockKind::Print)).prop_map(|(camera, print)| (camera, Some(print))),
        1 => of_kind(StockKind::Reversal).prop_map(|camera| (camera, None)),
    ]
}

/// Films and the settings that every look has.
fn film() -> impl Strategy<Value = FilmProcess> {
    let spaces = (word::<WorkingSpace>(), word::<WorkingSpace>(), word::<TransferCurve>());
    let numbers = (0.05..3.0, prop_oneof![Just(0.0), -10.0..10.0]);
    let switches = (word::<DyeModel>(), word::<Matching>(), word::<Reconstruction>(), word::<Projector>());
    (films(), word::<Aim>(), numbers, switches, spaces).prop_map(
        |(
            (camera, print),
            aim,
            (neutral_density, overexposure),
            (dyes, matching, reconstruction, projector),
            spaces,
        )| {
            let usual = FilmProcess::default();
            FilmProcess {
                camera: camera.into(),
                print: print.as_deref().map(Printing::on),
                aim,
                neutral_density: if aim == Aim::Sheet { usual.neutral_density } else { neutral_density },
                overexposure,
                dyes,
                matching,
                reconstruction,
                projector,
                spaces: ColourSpaces { input_space: spaces.0, output_space: spaces.1, output_coding: spaces.2 },
            }
        },
    )
}

/// Settings of the printer, for a look that is printed.
pub(crate) fn process() -> impl Strategy<Value = FilmProcess> {
    let filters = prop::sample::subsequence(Wratten::ALL.to_vec(), 2..=4).prop_map(|filters| Filters::of(&filters));
    let parts = (word::<PrinterLight>(), filters, word::<Infrared>(), word::<HeatGlass>(), word::<Tail>());
    let beams = prop::array::uniform3(0.0..4.0);
    let calibration = prop_oneof![3 => Just(Calibration::Exact), 1 => (0_u8..=30).prop_map(Calibration::Iterations)];
    (film(), parts, beams, calibration).prop_map(|(film, parts, beam_density, calibration)| {
        let Some(print) = film.print.clone() else { return film };
        let (light, filters, infrared, glass, red_tail) = parts;
        let filters = if light == PrinterLight::White { Filters::default() } else { filters };
        let print = Printing { light, filters, infrared, glass, red_tail, beam_density, calibration, ..print };
        FilmProcess { print: Some(print), ..film }
    })
}
