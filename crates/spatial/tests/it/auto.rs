use onelight_spatial::{
    AmountGranularity, Antihalation, FilmFormat, Finish, Frame, Grain, GrainSettings, HalationProbe, Planes, Sharpness,
    SharpnessProbe, SpatialStage, Verdict, grain_decision,
};

use crate::film::Film;
use crate::uniform::halation;

const SIZE: [usize; 2] = [448, 256];

/// A picture whose detail is so many pixels wide, with lights of so many stops above grey.
fn picture(detail: f64, lights: f32) -> Planes {
    let mut planes = Planes::new(SIZE[0], 0..SIZE[1]).unwrap();
    for y in 0..SIZE[1] {
        for (k, row) in planes.row_mut(y).into_iter().enumerate() {
            for (x, e) in row.iter_mut().enumerate() {
                let (x, y) = (x as f64, y as f64);
                let wave =
                    (x / detail + 0.3 * k as f64).sin() * (0.7 * y / detail).cos() + (0.19 * (x + y) / detail).sin();
                let bright = if ((x - 300.0).hypot(y - 120.0)) < 9.0 { lights.exp2() } else { 0.0 };
                *e = (0.5 * wave).exp2() as f32 + bright;
            }
        }
    }
    planes
}

fn sharpness_decision(film: &Film, frame: &Frame, exposures: &Planes) -> (Verdict, String) {
    let mut probe = SharpnessProbe::new(&Sharpness::of_stock(&film.stock).unwrap(), frame);
    for rows in probe.exposure_rows() {
        let mut band = Planes::new(SIZE[0], rows.clone()).unwrap();
        for y in rows {
            (0..3).for_each(|k| band.row_mut(y)[k].copy_from_slice(exposures.row(y)[k]));
        }
        probe.add(&band, &|e: [f32; 3]| film.develop(e), film).unwrap();
    }
    let decision = probe.finish().unwrap();
    (decision.verdict(), decision.to_string())
}

/// Differences that an effect makes, in rising order, on every eleventh pixel.
fn differences(film: &Film, frame: &Frame, exposures: &Planes, stage: &SpatialStage) -> Vec<f64> {
    let develop = |e: [f32; 3]| film.develop(e);
    let halo = stage.halation_cells().unwrap().map(|mut cells| {
        cells.add(exposures).unwrap();
        cells.finish().unwrap()
    });
    let with = stage.amounts(exposures, halo.as_ref(), 0..SIZE[1], &develop).unwrap();
    let without = SpatialStage::new(*frame).amounts(exposures, None, 0..SIZE[1], &develop).unwrap();
    let shown = |planes: &Planes, x: usize, y: usize| film.display_linear(planes.row(y).map(|l| f64::from(l[x])));
    let mut all: Vec<f64> = (0..SIZE[0] * SIZE[1])
        .step_by(11)
        .map(|i| (i % SIZE[0], i / SIZE[0]))
        .map(|(x, y)| film.difference(shown(&with, x, y), shown(&without, x, y)))
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn sharpness_is_left_out_where_it_is_not_seen_and_there_alone() {
    let film = Film::new("kodak-5219");
    let sharpness = Sharpness::of_stock(&film.stock).unwrap();
    let (mut skipped, mut run) = (0, 0);
    for width in [1024, 2048, 4096] {
        let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(width, 1.0).unwrap()).unwrap().at([130, 64]);
        for detail in [1.5, 6.0, 25.0, 60.0] {
            let exposures = picture(detail, -9.0);
            let (verdict, line) = sharpness_decision(&film, &frame, &exposures);
            let all = differences(&film, &frame, &exposures, &SpatialStage::new(frame).with_sharpness(&sharpness));
            let p99 = all[all.len() * 99 / 100];
            match verdict {
                // One pixel in a hundred may change by what the eye just sees, half of that more than the sample has.
                Verdict::NotVisible => assert!(p99 < 0.55, "{width} {detail}: {line}, in truth {p99}"),
                Verdict::Visible => assert!(p99 > 0.2, "{width} {detail}: {line}, in truth {p99}"),
            }
            skipped += i32::from(verdict == Verdict::NotVisible);
            run += i32::from(verdict == Verdict::Visible);
        }
    }
    assert!(skipped >= 3 && run >= 3, "{skipped} skipped, {run} run");
}

#[test]
fn halation_is_left_out_where_it_is_not_seen_and_there_alone() {
    let film = Film::new("kodak-5207");
    let (mut skipped, mut run) = (0, 0);
    for width in [1024, 4096] {
        let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(width, 1.0).unwrap()).unwrap();
        for density in [0.0, 0.6, 1.0] {
            for lights in [-9.0, 2.0, 9.0] {
                let exposures = picture(20.0, lights);
                let halation = halation(Antihalation::Density(density));
                let mut probe = HalationProbe::new(&halation, &frame).unwrap();
                probe.add(&exposures).unwrap();
                let decision = probe.finish(&|e: [f32; 3]| film.develop(e), &film).unwrap();
                let all = differences(&film, &frame, &exposures, &SpatialStage::new(frame).with_halation(halation));
                let largest = all[all.len() - 1];
                let case = format!("{width} {density} {lights}: {decision}, in truth {largest}");
                // The probe takes each cell for one place: half as much again is within its reach.
                match decision.verdict() {
                    Verdict::NotVisible => assert!(largest < 0.65, "{case}"),
                    Verdict::Visible => assert!(largest > 0.25, "{case}"),
                }
                skipped += i32::from(decision.verdict() == Verdict::NotVisible);
                run += i32::from(decision.verdict() == Verdict::Visible);
            }
        }
    }
    assert!(skipped >= 5 && run >= 5, "{skipped} skipped, {run} run");
}

#[test]
fn grain_is_left_out_of_small_pictures() {
    // From the model's prototype: 36 mm pictures under about 390 pixels (5207) and 300 (5219).
    for (id, limit) in [("kodak-5207", 390), ("kodak-5219", 300)] {
        let film = Film::new(id);
        let greys: Vec<[f64; 3]> = (-4..=4).map(|i| film.grey(0.5 * f64::from(i))).collect();
        let verdict = |width: usize| {
            let frame = Frame::new([width, width], FilmFormat::Still36.pitch(width, 1.0).unwrap()).unwrap();
            let sheet = AmountGranularity::of_stock(&film.stock).unwrap();
            let grain = Grain::new(sheet, frame.pitch(), GrainSettings::default()).unwrap();
            let decision = grain_decision(&grain, &frame, &greys, &film);
            decision.verdict()
        };
        assert_eq!(verdict(limit * 6 / 5), Verdict::Visible, "{id}");
        assert_eq!(verdict(limit * 4 / 5), Verdict::NotVisible, "{id}");
    }
}

#[test]
fn small_pictures_have_a_sample_too() {
    let film = Film::new("kodak-5219");
    for size in [[1, 1], [17, 3], [70, 5]] {
        let frame = Frame::new(size, FilmFormat::Super35.pitch(2048, 1.0).unwrap()).unwrap().at([-3, 40]);
        let mut probe = SharpnessProbe::new(&Sharpness::of_stock(&film.stock).unwrap(), &frame);
        for rows in probe.exposure_rows() {
            let mut exposures = Planes::new(size[0], rows.clone()).unwrap();
            exposures.row_mut(rows.start)[1][0] = 5.0;
            probe.add(&exposures, &|e: [f32; 3]| film.develop(e), &film).unwrap();
        }
        assert!(probe.finish().unwrap().to_string().starts_with("sharpness: "));
    }
}

#[test]
fn a_picture_that_was_not_looked_at_has_no_decision() {
    let film = Film::new("kodak-5219");
    let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(2048, 1.0).unwrap()).unwrap();
    let mut probe = SharpnessProbe::new(&Sharpness::of_stock(&film.stock).unwrap(), &frame);
    let rows = probe.exposure_rows();
    let develop = |e: [f32; 3]| film.develop(e);
    let skipped = Planes::new(SIZE[0], rows[1].clone()).unwrap();
    let message = probe.add(&skipped, &develop, &film).unwrap_err().to_string();
    assert!(message.starts_with("exposures for sharpness: found rows ") && message.contains("the next of the rows"));
    probe.add(&Planes::new(SIZE[0], rows[0].clone()).unwrap(), &develop, &film).unwrap();
    assert!(probe.finish().unwrap_err().to_string().contains("found 1 rows of blocks, expected all "));
    let halation = HalationProbe::new(&halation(Antihalation::None), &frame).unwrap();
    assert!(halation.finish(&develop, &film).is_err());
}
