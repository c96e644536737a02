//! The picture under a microdensitometer: what the sheet's maker would read off it.

use onelight_film::{Density, DyeAmount, DyeDensitometer, Granularity, PerLayer, Stock, StockKind};
use onelight_spatial::{AmountGranularity, Frame, Grain, GrainSettings, Pitch, Planes, SpatialStage};
use onelight_spectra::SpectralShape;

use crate::film::stock;

/// A reading grid fine enough for apertures down to 24 um.
const PITCH_UM: f64 = 3.04;
const SIDE: usize = 1280;

/// Standard deviations, as the three filters see them, of density read over discs of a diameter in um, on a uniform field.
fn read(planes: &Planes, amounts: [f32; 3], slope: [[f64; 3]; 3], diameter_um: f64) -> [f64; 3] {
    let radius = diameter_um / 2.0 / PITCH_UM;
    // Half-pixel steps, so that the disc's edge counts by area.
    let reach = radius.ceil() as isize + 1;
    let mut disc = Vec::new();
    for dy in -reach..=reach {
        for dx in -reach..=reach {
            let inside = |i: i32, n: isize| n as f64 + (f64::from(i) + 0.5) / 8.0 - 0.5;
            let share = (0..64).filter(|i| inside(i % 8, dx).hypot(inside(i / 8, dy)) < radius).count() as f64 / 64.0;
            if share > 0.0 {
                disc.push((dx, dy, share));
            }
        }
    }
    let area: f64 = disc.iter().map(|(.., share)| share).sum();
    // Transmittance by density from each filter's slope: grain is a small part of density.
    let light: Vec<[f64; 3]> = (0..SIDE)
        .flat_map(|y| {
            let rows = planes.row(y);
            (0..SIDE).map(move |x| {
                let off: [f64; 3] = std::array::from_fn(|k| f64::from(rows[k][x] - amounts[k]));
                slope.map(|row| 10f64.powf(-(row[0] * off[0] + row[1] * off[1] + row[2] * off[2])))
            })
        })
        .collect();
    let step = (radius as usize).max(4);
    let places: Vec<usize> = (reach as usize..SIDE - reach as usize).step_by(step).collect();
    let mut densities: Vec<[f64; 3]> = Vec::new();
    for &y in &places {
        for &x in &places {
            let mut sum = [0.0; 3];
            for (dx, dy, share) in &disc {
                let at = (y as isize + dy) as usize * SIDE + (x as isize + dx) as usize;
                for k in 0..3 {
                    sum[k] += share * light[at][k];
                }
            }
            densities.push(sum.map(|s| -(s / area).log10()));
        }
    }
    let count = densities.len() as f64;
    std::array::from_fn(|k| {
        let mean = densities.iter().map(|d| d[k]).sum::<f64>() / count;
        (densities.iter().map(|d| (d[k] - mean).powi(2)).sum::<f64>() / count).sqrt()
    })
}

/// What the figure has where its green curve is so far above D-min: density above D-min and scatter of the three layers.
fn figure_at(stock: &Stock, green: f64) -> PerLayer<(f64, f64)> {
    let figure = stock.granularity().unwrap();
    let [mut low, mut high] = figure.green.range();
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (figure.green.at(middle).0 < green) == (stock.kind() == StockKind::Negative) {
            low = middle;
        } else {
            high = middle;
        }
    }
    figure.map(|layer| layer.at(low))
}

/// Largest deviation of each layer from the sheet, for each diameter, at densities above D-min of the green layer.
fn largest(id: &str, greens: &[f64], diameters: &[f64]) -> Vec<[f64; 3]> {
    let film = stock(id);
    let sheet = AmountGranularity::of_stock(&film).unwrap();
    let reader = DyeDensitometer::new(&film.dyes_on(SpectralShape::VISIBLE).unwrap(), film.densitometry());
    let base = match film.kind() {
        StockKind::Negative => reader.density(PerLayer::all(DyeAmount(0.0))),
        _ => film.characteristic().map(onelight_film::CharacteristicCurve::d_min),
    };
    let frame = Frame::new([SIDE, SIDE], Pitch::new(PITCH_UM, PITCH_UM).unwrap()).unwrap();
    let grain = Grain::new(sheet, frame.pitch(), GrainSettings { print_blur_um: 0.0, ..Default::default() }).unwrap();
    let mut largest = vec![[0.0f64; 3]; diameters.len()];
    for green in greens {
        let published = figure_at(&film, *green);
        let target = published.zip_map(base, |(density, _), base| Density(density + base.0));
        let amounts = reader.unmix(target, PerLayer::all(DyeAmount(0.5))).unwrap();
        let slope = reader.density_and_slope(amounts).1;
        let amounts = amounts.map(|a| a.0 as f32).to_array();
        let exposures = Planes::new(SIDE, 0..SIDE).unwrap();
        let stage = SpatialStage::new(frame).with_grain(grain.clone()).unwrap();
        let planes = stage.amounts(&exposures, None, 0..SIDE, &|_: [f32; 3]| amounts).unwrap();
        for (largest, diameter) in largest.iter_mut().zip(diameters) {
            let found = read(&planes, amounts, slope, *diameter);
            for ((found, (_, sigma)), largest) in found.into_iter().zip(published.to_array()).zip(largest) {
                // Selwyn: the scatter goes with the root of the aperture's area, as long as it is far larger than a cloud.
                let expected =
                    sigma * Granularity::APERTURE_UM / diameter * (disc_share(*diameter) / disc_share(48.0)).sqrt();
                let off = found / expected - 1.0;
                if off.abs() > largest.abs() {
                    *largest = off;
                }
            }
        }
    }
    largest
}

/// Variance over a disc of clouds of 1.5 um, over that of clouds of no size: to first order in their ratio.
fn disc_share(diameter_um: f64) -> f64 {
    1.0 - 4.0 * 1.5 / (std::f64::consts::PI.sqrt() * diameter_um)
}

#[test]
fn the_picture_measures_as_the_sheet_says() {
    let (vision3, older): (&[f64], &[f64]) = (&[0.05, 0.4, 1.4], &[0.15, 0.8]);
    let films = [
        ("kodak-5207", vision3),
        ("kodak-5219", vision3),
        ("kodak-5203", older),
        ("kodak-5213", older),
        ("kodak-5277", older),
        ("kodak-5248", older),
        ("kodak-ektachrome-100", older),
    ];
    for (id, densities) in films {
        let found = largest(id, densities, &[24.0, 48.0, 96.0]);
        // The rows of docs/spatial.md, shown by `--nocapture`.
        let percent = found.iter().map(|layers| layers.map(|off| format!("{:.1}", 100.0 * off)).join(" "));
        eprintln!("| {id} | {} |", percent.collect::<Vec<_>>().join(" | "));
        // The grid itself blurs an aperture of 24 um: 3 % low.
        for (layers, limit) in found.iter().zip([0.04, 0.03, 0.05]) {
            assert!(layers.iter().all(|off| off.abs() < limit), "{id}: {found:?}");
        }
    }
}
