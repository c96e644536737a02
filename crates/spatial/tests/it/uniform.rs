use onelight_spatial::{
    Antihalation, FilmFormat, Frame, Halation, HalationSettings, Pitch, Planes, Sharpness, SpatialStage,
};

use crate::film::stock;

pub(crate) fn as_it_is(exposure: [f32; 3]) -> [f32; 3] {
    exposure
}

/// The amounts of a whole picture.
pub(crate) fn whole(stage: &SpatialStage, exposures: &Planes) -> Planes {
    let halo = stage.halation_cells().unwrap().map(|mut cells| {
        cells.add(exposures).unwrap();
        cells.finish().unwrap()
    });
    stage.amounts(exposures, halo.as_ref(), exposures.rows(), &as_it_is).unwrap()
}

pub(crate) fn halation(antihalation: Antihalation) -> Halation {
    Halation::new(HalationSettings { antihalation, ..Default::default() }).unwrap()
}

#[test]
fn uniform_fields_come_out_to_the_bit() {
    for id in ["kodak-5207", "kodak-5219", "kodak-ektachrome-100"] {
        let sharpness = Sharpness::of_stock(&stock(id)).unwrap();
        for width in [512, 2048, 4096, 12000] {
            let frame = Frame::new([331, 67], FilmFormat::Super35.pitch(width, 1.0).unwrap()).unwrap().at([13, -7]);
            let stage = SpatialStage::new(frame).with_sharpness(&sharpness).with_halation(halation(Antihalation::None));
            for exposure in [0.0f32, 0.1, 1.234_567, 3e4] {
                let mut exposures = Planes::new(331, 0..67).unwrap();
                (0..67).for_each(|y| exposures.row_mut(y).into_iter().for_each(|row| row.fill(exposure)));
                assert_eq!(whole(&stage, &exposures), exposures, "{id} {width} {exposure}");
            }
        }
    }
}

#[test]
fn scatter_and_halation_move_light_and_neither_make_nor_lose_any() {
    let sharpness = Sharpness::of_stock(&stock("kodak-5219")).unwrap();
    let returned = onelight_film::PerLayer::all(1.0);
    for (pitch, density) in [(24.0, 0.8), (12.158, 0.8), (24.0, 0.0), (40.0, 0.0)] {
        let frame = Frame::new([801, 801], Pitch::new(pitch, pitch).unwrap()).unwrap();
        let settings =
            HalationSettings { antihalation: Antihalation::Density(density), returned, ..Default::default() };
        let halation = Halation::new(settings).unwrap();
        let mut exposures = Planes::new(801, 0..801).unwrap();
        exposures.row_mut(400).into_iter().for_each(|row| row[400] = 1e6);
        // Adjacency clamps at 0 about a point: light alone.
        let stage = SpatialStage::new(frame).with_halation(halation);
        let amounts = whole(&stage, &exposures);
        for k in 0..3 {
            let all: f64 = (0..801).map(|y| amounts.row(y)[k].iter().map(|e| f64::from(*e)).sum::<f64>()).sum();
            assert!((all / 1e6 - 1.0).abs() < 1e-4, "{pitch} {density}: {all}");
        }
        let stage = SpatialStage::new(frame).with_sharpness(&sharpness);
        let amounts = whole(&stage, &exposures);
        assert!((0..801).all(|y| amounts.row(y).into_iter().flatten().all(|a| *a >= 0.0)));
    }
}
