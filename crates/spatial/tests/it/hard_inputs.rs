use onelight_spatial::{
    AmountGranularity, Antihalation, FilmFormat, Frame, Grain, GrainSettings, Pitch, Planes, Sharpness, SpatialStage,
};

use crate::film::{Film, stock};
use crate::uniform::{halation, whole};

fn stage(frame: Frame, id: &str) -> SpatialStage {
    let film = stock(id);
    let grain =
        Grain::new(AmountGranularity::of_stock(&film).unwrap(), frame.pitch(), GrainSettings::default()).unwrap();
    SpatialStage::new(frame)
        .with_sharpness(&Sharpness::of_stock(&film).unwrap())
        .with_grain(grain)
        .unwrap()
        .with_halation(halation(Antihalation::None))
}

#[test]
fn numbers_that_are_no_exposures_have_one_result() {
    let film = Film::new("kodak-5219");
    let hard = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -5.0, 1e30, f32::MAX, 1e-40, 0.0, 1e6];
    let clean = |e: f32| if e > 0.0 { e.min(1e30) } else { 0.0 };
    for size in [[1, 1], [17, 3], [3, 17], [40, 40]] {
        for width in [64, 2048, 8192] {
            let frame = Frame::new(size, FilmFormat::Super16.pitch(width, 1.0).unwrap()).unwrap();
            let stage = stage(frame, "kodak-5219");
            for (i, &value) in hard.iter().enumerate() {
                let mut exposures = Planes::new(size[0], 0..size[1]).unwrap();
                let mut cleaned = exposures.clone();
                let (x, y) = (i % size[0], i % size[1]);
                (0..3).for_each(|k| exposures.row_mut(y)[k][x] = value);
                (0..3).for_each(|k| cleaned.row_mut(y)[k][x] = clean(value));
                let develop = |planes: &Planes| {
                    let mut cells = stage.halation_cells().unwrap().unwrap();
                    cells.add(planes).unwrap();
                    let halo = cells.finish().unwrap();
                    stage.amounts(planes, Some(&halo), 0..size[1], &|e: [f32; 3]| film.develop(e)).unwrap()
                };
                let found = develop(&exposures);
                assert_eq!(found, develop(&cleaned), "{size:?} {width} {value}");
                let all = (0..size[1]).flat_map(|y| found.row(y).into_iter().flatten().copied().collect::<Vec<_>>());
                // Less than no dye only by grain: 6 times the strongest pixel's scatter.
                assert!(all.into_iter().all(|a| a.is_finite() && a > -1.5 && a < 10.0), "{size:?} {width} {value}");
            }
        }
    }
}

#[test]
fn no_exposure_is_negative_and_no_dark_side_runs_black() {
    // Edges of up to 16 stops, points of 1e6: light spreads, it never goes below the least exposure.
    let sharpness = Sharpness::of_stock(&stock("kodak-5219")).unwrap();
    for pitch in [24.0, 12.158, 6.0, 2.0] {
        let frame = Frame::new([301, 60], Pitch::new(pitch, pitch).unwrap()).unwrap();
        let stage = SpatialStage::new(frame).with_halation(halation(Antihalation::None));
        for bright in [4.0, 1e3, 6.5e4, 1e6] {
            let mut exposures = Planes::new(301, 0..60).unwrap();
            for y in 0..60 {
                exposures.row_mut(y).into_iter().for_each(|row| {
                    row.fill(0.01);
                    row[..40].fill(bright);
                    if y == 30 {
                        row[200] = bright;
                    }
                });
            }
            let halo = whole(&stage, &exposures);
            let least = |planes: &Planes| {
                let rows = (0..60).flat_map(|y| planes.row(y)).flatten().copied();
                rows.fold(f32::INFINITY, f32::min)
            };
            // Halation spreads by means of exposures: only the fit of the profile's hole can take away, and only from what was added.
            assert!(least(&halo) > 0.0099 * (1.0 - 0.23), "{pitch} {bright}: {}", least(&halo));
            let sharp = SpatialStage::new(frame).with_sharpness(&sharpness);
            let mut seen = f32::INFINITY;
            let watch = |e: [f32; 3]| e;
            let amounts = sharp.amounts(&exposures, None, 0..60, &watch).unwrap();
            seen = seen.min(least(&amounts));
            assert!(seen >= 0.0, "{pitch} {bright}: {seen}");
        }
    }
}

#[test]
fn undershoot_beside_an_edge_is_bounded() {
    // In amounts: at most the strength of adjacency times the step that the curve leaves of it.
    let film = Film::new("kodak-5219");
    let sharpness = Sharpness::of_stock(&film.stock).unwrap();
    for pitch in [12.158, 3.0] {
        let frame = Frame::new([800, 1], Pitch::new(pitch, pitch).unwrap()).unwrap();
        let stage = SpatialStage::new(frame).with_sharpness(&sharpness);
        for stops in [2.0f32, 4.0, 6.0, 8.0, 10.0] {
            let mut exposures = Planes::new(800, 0..1).unwrap();
            exposures.row_mut(0).into_iter().for_each(|row| {
                row.fill(1.0);
                row[..400].fill(stops.exp2());
            });
            let amounts = stage.amounts(&exposures, None, 0..1, &|e: [f32; 3]| film.develop(e)).unwrap();
            let grey = film.grey(0.0);
            for (row, grey) in amounts.row(0).into_iter().zip(grey) {
                let least = row.iter().copied().fold(f32::INFINITY, f32::min);
                assert!(f64::from(least) > grey - 0.085, "{pitch} {stops}: {least} for {grey}");
            }
        }
    }
}

#[test]
fn unequal_pixels_blur_alike_on_the_film() {
    // A wide bar across and one along: what is 6 um wide and 12 um high must spread twice as many pixels across.
    let sharpness = Sharpness::of_stock(&stock("kodak-5207")).unwrap();
    let edge = |pitch: [f64; 2], along_x: bool| {
        let size = if along_x { [400, 3] } else { [3, 400] };
        let frame = Frame::new(size, Pitch::new(pitch[0], pitch[1]).unwrap()).unwrap();
        let mut exposures = Planes::new(size[0], 0..size[1]).unwrap();
        for y in 0..size[1] {
            exposures.row_mut(y).into_iter().for_each(|row| {
                for (x, e) in row.iter_mut().enumerate() {
                    *e = if (if along_x { x } else { y }) < 200 { 1.0 } else { 0.2 };
                }
            });
        }
        let amounts = whole(&SpatialStage::new(frame).with_sharpness(&sharpness), &exposures);
        (0..400).map(|i| if along_x { amounts.row(1)[1][i] } else { amounts.row(i)[1][1] }).collect::<Vec<f32>>()
    };
    for (square, wide) in
        [(edge([6.0, 6.0], true), edge([6.0, 12.0], true)), (edge([6.0, 6.0], false), edge([12.0, 6.0], false))]
    {
        for (a, b) in square.iter().zip(&wide) {
            assert!((a - b).abs() < 2e-3, "{a} {b}");
        }
    }
}
