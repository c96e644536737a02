use onelight_spatial::{
    AmountGranularity, Antihalation, FilmFormat, Frame, Grain, GrainSettings, HaloField, Pitch, Planes, Sharpness,
    SpatialStage, StageRun,
};
use rayon::prelude::*;

use crate::film::stock;
use crate::uniform::halation;

const SIZE: [usize; 2] = [701, 259];

fn curve(exposure: [f32; 3]) -> [f32; 3] {
    exposure.map(|e| 0.6 * (1.0 + 20.0 * e).log10())
}

/// A picture of edges, slopes and lights.
fn exposures(rows: std::ops::Range<usize>) -> Planes {
    let mut planes = Planes::new(SIZE[0], rows.clone()).unwrap();
    for y in rows {
        for (k, row) in planes.row_mut(y).into_iter().enumerate() {
            for (x, e) in row.iter_mut().enumerate() {
                let wave = ((x * (k + 3) + y * 7) % 41) as f32 / 41.0;
                let light = if (x * 31 + y * 17) % 997 == 0 { 300.0 } else { 0.0 };
                *e = 0.02 + wave * wave * if x > 350 { 0.1 } else { 1.0 } + light;
            }
        }
    }
    planes
}

fn stage(frame: Frame) -> SpatialStage {
    let film = stock("kodak-5207");
    let grain =
        Grain::new(AmountGranularity::of_stock(&film).unwrap(), frame.pitch(), GrainSettings::default()).unwrap();
    let sharpness = Sharpness::of_stock(&film).unwrap();
    SpatialStage::new(frame)
        .with_sharpness(&sharpness)
        .with_grain(grain)
        .unwrap()
        .with_halation(halation(Antihalation::Density(0.3)))
}

fn halo(stage: &SpatialStage, band: usize) -> HaloField {
    let mut cells = stage.halation_cells().unwrap().unwrap();
    for start in (0..SIZE[1]).step_by(band) {
        cells.add(&exposures(start..(start + band).min(SIZE[1]))).unwrap();
    }
    cells.finish().unwrap()
}

#[test]
fn bands_and_threads_give_the_same_bytes() {
    for width in [2048, 4096, 12000] {
        let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(width, 1.0).unwrap()).unwrap().at([301, 77]);
        let stage = stage(frame);
        let whole = stage.amounts(&exposures(0..SIZE[1]), Some(&halo(&stage, 1000)), 0..SIZE[1], &curve).unwrap();
        for (band, threads) in [(SIZE[1], 1), (SIZE[1], 5), (37, 2), (64, 3), (200, 2)] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let halo = halo(&stage, band);
                for start in (0..SIZE[1]).step_by(band) {
                    let rows = start..(start + band).min(SIZE[1]);
                    let needed = exposures(stage.exposure_rows(rows.clone()));
                    let amounts = stage.amounts(&needed, Some(&halo), rows.clone(), &curve).unwrap();
                    for y in rows {
                        assert!(
                            amounts.row(y) == whole.row(y),
                            "{width}: row {y} in bands of {band}, {threads} threads"
                        );
                    }
                }
            });
        }
        for y in [0, 100, SIZE[1] - 1] {
            let needed = exposures(stage.exposure_rows(y..y + 1));
            let alone = stage.amounts(&needed, Some(&halo(&stage, 64)), y..y + 1, &curve).unwrap();
            assert!(alone.row(y) == whole.row(y), "{width}: row {y} alone");
        }
    }
}

#[test]
fn a_run_down_the_picture_gives_the_same_bytes() {
    for (width, effects) in [(2048, true), (4096, true), (12000, true), (4096, false)] {
        let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(width, 1.0).unwrap()).unwrap().at([301, 77]);
        let stage = if effects { stage(frame) } else { SpatialStage::new(frame) };
        let halo = || effects.then(|| halo(&stage, 64));
        let whole = stage.amounts(&exposures(0..SIZE[1]), halo().as_ref(), 0..SIZE[1], &curve).unwrap();
        for (band, at_least) in [(1, 1), (7, 40), (37, 1), (64, 64), (SIZE[1], 1)] {
            let mut run = StageRun::new(stage.clone(), halo()).unwrap();
            let mut done = 0;
            for start in (0..SIZE[1]).step_by(band) {
                let (planes, rows) = run.add(band.min(SIZE[1] - start)).unwrap();
                let coming = exposures(rows.clone());
                planes.par_rows_mut(rows.clone()).zip(rows).for_each(|(layers, y)| {
                    layers.into_iter().zip(coming.row(y)).for_each(|(layer, from)| layer.copy_from_slice(from));
                });
                let ready = run.ready();
                if ready == 0 || ready < at_least && start + band < SIZE[1] {
                    continue;
                }
                let amounts = run.amounts(ready, &curve).unwrap();
                for y in done..done + ready {
                    assert!(amounts.row(y) == whole.row(y), "{width}: row {y} in bands of {band}");
                }
                done += ready;
            }
            assert_eq!(done, SIZE[1], "{width}: bands of {band}");
            assert!(run.add(1).is_err() && run.amounts(1, &curve).is_err());
        }
    }
}

#[test]
fn rows_that_are_not_there_have_no_amounts() {
    let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(4096, 1.0).unwrap()).unwrap();
    let message = StageRun::new(stage(frame), None).unwrap_err().to_string();
    assert!(message.starts_with("halo: found none"), "{message}");
    let sharp = SpatialStage::new(frame).with_sharpness(&Sharpness::of_stock(&stock("kodak-5207")).unwrap());
    let mut run = StageRun::new(sharp, None).unwrap();
    assert_eq!(run.ready(), 0);
    assert_eq!(
        run.add(300).unwrap_err().to_string(),
        "exposures: found 300 rows, expected 1 to 259, which the picture has left"
    );
    run.add(100).unwrap();
    let ready = run.ready();
    assert!((1..90).contains(&ready), "{ready} of 100 rows, as those below need others");
    let message = run.amounts(ready + 1, &curve).unwrap_err().to_string();
    assert_eq!(message, format!("amounts: found {} rows, expected 1 to {ready}, which are ready", ready + 1));
}

#[test]
fn the_grain_of_a_crop_is_the_crop_of_the_grain() {
    let pitch = FilmFormat::Super35.pitch(4096, 1.0).unwrap();
    let film = stock("kodak-5219");
    let grain = Grain::new(AmountGranularity::of_stock(&film).unwrap(), pitch, GrainSettings::default()).unwrap();
    let grey = |_: [f32; 3]| [0.4; 3];
    let field = |size: [usize; 2], offset| {
        let frame = Frame::new(size, pitch).unwrap().at(offset).numbered(11);
        let exposures = Planes::new(size[0], 0..size[1]).unwrap();
        SpatialStage::new(frame)
            .with_grain(grain.clone())
            .unwrap()
            .amounts(&exposures, None, 0..size[1], &grey)
            .unwrap()
    };
    let whole = field([1100, 150], [0, 0]);
    let crop = field([600, 70], [333, 41]);
    for y in 0..70 {
        for (whole, crop) in whole.row(y + 41).into_iter().zip(crop.row(y)) {
            assert_eq!(&whole[333..933], crop, "row {y}");
        }
    }
    // Left of and above the origin there is grain too.
    assert_eq!(field([20, 9], [-5, -3]).row(3)[0][5..], whole.row(0)[0][..15]);
}

#[test]
fn missing_rows_are_refused() {
    let stage = stage(Frame::new(SIZE, Pitch::new(12.158, 12.158).unwrap()).unwrap());
    let halo = halo(&stage, 64);
    let needed = stage.exposure_rows(100..120);
    assert!(needed.start < 95 && needed.end > 125);
    let message = stage.amounts(&exposures(100..120), Some(&halo), 100..120, &curve).unwrap_err().to_string();
    assert!(message.starts_with("exposures: found rows 100 to 120 of 701 pixels, expected rows "), "{message}");
    for rows in [5..5, 200..SIZE[1] + 1] {
        assert!(stage.amounts(&exposures(0..SIZE[1]), Some(&halo), rows, &curve).is_err());
    }
    assert_eq!(stage.exposure_rows(0..SIZE[1]), 0..SIZE[1]);
    let plain = SpatialStage::new(*stage.frame());
    assert_eq!(plain.exposure_rows(7..8), 7..8);
    let same = plain.amounts(&exposures(7..8), None, 7..8, &curve).unwrap();
    assert_eq!(same.row(7)[1][5], curve(std::array::from_fn(|k| exposures(7..8).row(7)[k][5]))[1]);
}

#[test]
fn what_was_made_for_another_picture_is_refused() {
    let pitch = Pitch::new(12.158, 12.158).unwrap();
    let frame = Frame::new(SIZE, pitch).unwrap();
    let halo = halo(&stage(frame), 64);
    let message = |other: Frame| {
        let rows = 0..other.height();
        let exposures = Planes::new(other.width(), rows.clone()).unwrap();
        stage(other).amounts(&exposures, Some(&halo), rows, &curve).unwrap_err().to_string()
    };
    let others = [
        frame.at([1, 0]),
        Frame::new([SIZE[0] + 1, SIZE[1]], pitch).unwrap(),
        Frame::new(SIZE, Pitch::new(6.0, 6.0).unwrap()).unwrap(),
    ];
    assert!(others.map(message).iter().all(|message| message.starts_with("halo: found that of another picture")));
    // The next of a sequence has the same cells: whose exposures they hold is the caller's affair.
    assert!(stage(frame.numbered(1)).amounts(&exposures(0..SIZE[1]), Some(&halo), 0..1, &curve).is_ok());
    let film = stock("kodak-5207");
    let grain = Grain::new(AmountGranularity::of_stock(&film).unwrap(), pitch, GrainSettings::default()).unwrap();
    let finer = SpatialStage::new(Frame::new(SIZE, Pitch::new(6.0, 6.0).unwrap()).unwrap());
    let message = finer.with_grain(grain).unwrap_err().to_string();
    assert_eq!(message, "grain: found pixels of 12.158 by 12.158 um, expected pixels of 6 by 6 um");
}
