//! Random looks that do not contradict themselves.

use onelight::printing::Calibration;
use onelight::{
    Aim, ColourSpaces, DyeModel, FilmProcess, Filters, HeatGlass, Image, Infrared, InterImage, InterImageChoice,
    Matching, PrintCurves, PrinterLight, Printing, Projector, Reconstruction, ScanRule, Stock, StockKind, Tail,
    TransferCurve, White, WideGamut, Word, WorkingSpace, Wratten, stock, stock_ids,
};
use proptest::prelude::*;

pub(crate) fn word<T: Word + std::fmt::Debug>() -> impl Strategy<Value = T> {
    (0..T::ALL.len()).prop_map(|i| T::ALL[i].0)
}

/// A camera film as it is or scanned, or on something that it is printed on.
pub(crate) fn films() -> impl Strategy<Value = (String, Option<String>)> {
    let stocks: Vec<Stock> = stock_ids().map(|id| stock(id).unwrap()).collect();
    let pairs = stocks.iter().flat_map(|camera| {
        let prints = stocks.iter().filter(|print| camera.is_printed_on(print));
        prints.map(|print| (camera.id().to_owned(), Some(print.id().to_owned())))
    });
    let alone = stocks.iter().filter(|camera| camera.kind().is_camera_film());
    let alone: Vec<_> = alone.map(|camera| (camera.id().to_owned(), None)).collect();
    prop_oneof![3 => prop::sample::select(pairs.collect::<Vec<_>>()), 1 => prop::sample::select(alone)]
}

fn inter_image() -> impl Strategy<Value = InterImageChoice> {
    let fixed =
        (0.0..=1.0, 0.0..=0.3).prop_map(|(near, far)| InterImageChoice::Fixed(InterImage::new(near, far).unwrap()));
    prop_oneof![
        2 => Just(InterImageChoice::Film),
        1 => Just(InterImageChoice::Fixed(InterImage::NONE)),
        1 => fixed,
    ]
}

/// Films and the settings that every look has.
fn film() -> impl Strategy<Value = FilmProcess> {
    let spaces = (word::<WorkingSpace>(), word::<WorkingSpace>(), word::<TransferCurve>());
    let numbers = (0.05..3.0, prop_oneof![Just(0.0), -10.0..10.0]);
    let switches = (word::<DyeModel>(), word::<Matching>(), word::<Reconstruction>(), word::<Projector>());
    let seen = (inter_image(), word::<WideGamut>(), word::<White>());
    (films(), word::<Aim>(), numbers, switches, seen, spaces).prop_map(
        |(
            (camera, print),
            aim,
            (neutral_density, overexposure),
            (dyes, matching, reconstruction, projector),
            (inter_image, gamut, white),
            spaces,
        )| {
            let usual = FilmProcess::default();
            // A negative without a print is scanned, by whose rule there is neither sheet aim nor light.
            let is_scan = print.is_none() && stock(&camera).unwrap().kind() == StockKind::Negative;
            let scan = is_scan.then(ScanRule::default);
            let (aim, projector, white) =
                if is_scan { (usual.aim, usual.projector, usual.white) } else { (aim, projector, white) };
            let shown = stock(print.as_ref().unwrap_or(&camera)).unwrap();
            // Nothing projects paper.
            let projector = if shown.kind().is_reflective() { Projector::ViewingBooth } else { projector };
            let silver = stock(&camera).unwrap().image() == Image::Silver;
            let inter_image = if silver { InterImageChoice::Film } else { inter_image };
            FilmProcess {
                camera: camera.into(),
                print: print.as_deref().map(Printing::on),
                scan,
                aim,
                neutral_density: if aim == Aim::Sheet { usual.neutral_density } else { neutral_density },
                overexposure,
                dyes,
                matching,
                inter_image,
                reconstruction,
                gamut,
                projector,
                white,
                effects: usual.effects,
                spaces: ColourSpaces {
                    input_space: spaces.0,
                    output_space: spaces.1,
                    output_coding: spaces.2,
                    ..ColourSpaces::default()
                },
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
    (film(), parts, word::<PrintCurves>(), beams, calibration).prop_map(
        |(film, parts, curves, beam_density, calibration)| {
            let Some(print) = film.print.clone() else { return film };
            let (light, filters, infrared, glass, red_tail) = parts;
            // One layer has no layer of its own for red, and no dyes to take apart.
            let silver = stock(print.film.id()).unwrap().image() == Image::Silver;
            let red_tail = if silver { Tail::default() } else { red_tail };
            let curves = if silver || film.dyes == DyeModel::Literal { PrintCurves::Neutral } else { curves };
            // An exact calibration undoes them.
            let beam_density = match calibration {
                Calibration::Exact => Printing::default().beam_density,
                Calibration::Iterations(_) => beam_density,
            };
            let filters = if light == PrinterLight::Separations { filters } else { Filters::default() };
            let print =
                Printing { curves, light, filters, infrared, glass, red_tail, beam_density, calibration, ..print };
            FilmProcess { print: Some(print), ..film }
        },
    )
}
