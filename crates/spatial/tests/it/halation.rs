use onelight_film::PerLayer;
use onelight_spatial::{Antihalation, FilmBase, Frame, Halation, HalationSettings, Pitch, Planes, SpatialStage};

use crate::uniform::{halation, whole};

/// Mean of the red layer by distance from a bright point, in um, less the point itself.
fn profile(halation: Halation, pitch_um: f64, pixels: usize) -> Vec<f64> {
    let frame = Frame::new([pixels, pixels], Pitch::new(pitch_um, pitch_um).unwrap()).unwrap();
    let mut exposures = Planes::new(pixels, 0..pixels).unwrap();
    let centre = pixels / 2;
    exposures.row_mut(centre)[0][centre] = 1e6;
    let amounts = whole(&SpatialStage::new(frame).with_halation(halation), &exposures);
    let mut rings = vec![(0.0, 0.0); pixels / 2];
    for y in 0..pixels {
        for x in 0..pixels {
            let distance = (x as f64 - centre as f64).hypot(y as f64 - centre as f64).round() as usize;
            if let Some((sum, count)) = rings.get_mut(distance).filter(|_| distance > 0) {
                (*sum, *count) = (*sum + f64::from(amounts.row(y)[0][x]), *count + 1.0);
            }
        }
    }
    rings.iter().skip(1).map(|(sum, count)| sum / count).collect()
}

#[test]
fn the_ring_has_its_radius_at_every_pitch() {
    for base in [FilmBase::Triacetate, FilmBase::Polyester] {
        for pitch in [3.04, 6.079, 12.158, 24.316] {
            let settings = HalationSettings { base, antihalation: Antihalation::None, ..Default::default() };
            let halation = Halation::new(settings).unwrap();
            let ring = halation.ring_um();
            let rings = profile(halation, pitch, (2.0 * 700.0 / pitch) as usize);
            // The edge of the ring: where the light rises fastest.
            let rise = |i: &usize| rings[*i + 1] - rings[*i];
            let steepest = (1..rings.len() - 1).max_by(|a, b| rise(a).total_cmp(&rise(b))).unwrap();
            let found = (steepest as f64 + 1.5) * pitch;
            assert!((found - ring).abs() < pitch.max(30.0), "{base:?} {pitch}: {found} for {ring}");
        }
    }
}

#[test]
fn strength_falls_with_the_layer_that_swallows() {
    let at_ring = |density| {
        let rings = profile(halation(Antihalation::Density(density)), 12.158, 101);
        rings[22]
    };
    let [open, thin, usual, dense] = [0.0, 0.6, 0.8, 1.0].map(at_ring);
    // Light at the critical angle passes the layer by 1 / 0.74 of its thickness, twice: 10^(2 D / 0.74).
    assert!(open > 30.0 * thin && thin > 2.0 * usual && usual > 2.0 * dense && dense > 0.0);
}

#[test]
fn blue_gets_nothing_and_red_most() {
    let frame = Frame::new([121, 121], Pitch::new(12.158, 12.158).unwrap()).unwrap();
    let mut exposures = Planes::new(121, 0..121).unwrap();
    exposures.row_mut(60).into_iter().for_each(|row| row[60] = 1e6);
    let amounts = whole(&SpatialStage::new(frame).with_halation(halation(Antihalation::None)), &exposures);
    let [red, green, blue] = amounts.row(60).map(|row| row[60 + 24]);
    assert!(red > 5.0 * green && green > 0.0 && blue == 0.0, "{red} {green} {blue}");
}

#[test]
fn settings_out_of_range_are_refused() {
    for density in [-0.1, 3.1, f64::NAN, f64::INFINITY] {
        let settings = HalationSettings { antihalation: Antihalation::Density(density), ..HalationSettings::default() };
        assert!(Halation::new(settings).is_err());
    }
    let returned = PerLayer { red: 1.5, green: 0.0, blue: 0.0 };
    assert!(Halation::new(HalationSettings { returned, ..Default::default() }).is_err());
}

#[test]
fn all_rows_once_from_top_to_bottom() {
    let frame = Frame::new([20, 20], Pitch::new(12.0, 12.0).unwrap()).unwrap();
    let stage = SpatialStage::new(frame).with_halation(halation(Antihalation::default()));
    let rows = |rows| Planes::new(20, rows).unwrap();
    let mut cells = stage.halation_cells().unwrap().unwrap();
    cells.add(&rows(0..7)).unwrap();
    let message = cells.add(&rows(8..20)).unwrap_err().to_string();
    assert_eq!(
        message,
        "exposures for halation: found rows 8 to 20 of 20 pixels, expected rows from 7 to at most 20 of 20 pixels"
    );
    assert!(cells.finish().unwrap_err().to_string().contains("found 7 rows"));
    let exposures = rows(0..20);
    assert!(stage.amounts(&exposures, None, 0..20, &|e: [f32; 3]| e).unwrap_err().to_string().contains("halo"));
}
