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

/// A picture narrower than the blurs is as if its edges went on for ever: the same as with those pixels around it. Light and what is blurred
/// pixel by pixel to rounding; where adjacency is blurred in cells, the outermost cell's mean goes on and not the outermost pixel.
#[test]
fn narrow_pictures_are_as_if_their_edges_went_on() {
    const AROUND: usize = 90;
    const BRIGHTEST: f32 = 3.2;
    // Of the light of this picture: the Ektachrome has no adjacency.
    let films = [("kodak-ektachrome-100", 1e-6), ("kodak-5219", 0.06)];
    let sizes = [([3, 7], 12.158), ([1, 40], 6.0), ([25, 2], 3.0)];
    for ((id, allowed), (size, um)) in films.into_iter().flat_map(|film| sizes.map(|size| (film, size))) {
        let sharpness = Sharpness::of_stock(&stock(id)).unwrap();
        let pitch = Pitch::new(um, um).unwrap();
        let light = |x: usize, y: usize, k: usize| 0.2 + ((x * 31 + y * 17 + k * 7) % 13) as f32 / 4.0;
        let picture = |size: [usize; 2], around: usize, inner: [usize; 2]| {
            let mut planes = Planes::new(size[0], 0..size[1]).unwrap();
            for y in 0..size[1] {
                for (k, row) in planes.row_mut(y).into_iter().enumerate() {
                    for (x, e) in row.iter_mut().enumerate() {
                        let inside = |at: usize, side: usize| at.saturating_sub(around).min(side - 1);
                        *e = light(inside(x, inner[0]), inside(y, inner[1]), k);
                    }
                }
            }
            planes
        };
        let stage = |size: [usize; 2], offset: i32| {
            SpatialStage::new(Frame::new(size, pitch).unwrap().at([offset, offset])).with_sharpness(&sharpness)
        };
        let wide = size.map(|side| side + 2 * AROUND);
        let alone = whole(&stage(size, 0), &picture(size, 0, size));
        let within = whole(&stage(wide, -(AROUND as i32)), &picture(wide, AROUND, size));
        let mut largest = 0.0f32;
        for y in 0..size[1] {
            for (a, b) in alone.row(y).into_iter().zip(within.row(y + AROUND)) {
                for (a, b) in a.iter().zip(&b[AROUND..]) {
                    largest = largest.max((a - b).abs());
                }
            }
        }
        assert!(largest <= allowed * BRIGHTEST, "{id} {size:?} {um}: {largest}");
    }
}
