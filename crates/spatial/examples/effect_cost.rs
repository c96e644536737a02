//! What each effect costs for a pixel, on one thread and on all: `cargo run --release -p onelight-spatial --example effect_cost`.

use std::hint::black_box;
use std::time::Instant;

use onelight_film::{SheetText, Stock};
use onelight_spatial::{
    AmountGranularity, Antihalation, Development, FilmFormat, Frame, Grain, GrainSettings, Halation, HalationSettings,
    Planes, Sharpness, SpatialStage, StageBuffers,
};

/// Runs of which the fastest counts.
const RUNS: usize = 5;
/// Rows of a band.
const BAND: usize = 384;

/// Development that does nothing: what is measured is the effects.
struct Nothing;

impl Development for Nothing {
    fn develop(&self, _: [&mut [f32]; 3]) {}
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let f = onelight_stocks::find("kodak-5219").ok_or("no such stock")?;
    let stock = Stock::parse(&SheetText {
        id: f.id,
        stock_toml: f.stock_toml,
        sensitivity_csv: f.sensitivity_csv,
        characteristic_csv: f.characteristic_csv,
        dye_density_csv: f.dye_density_csv,
    })?
    .with_figures(f.mtf_csv, f.granularity_csv)?;
    let sharpness = Sharpness::of_stock(&stock)?;
    let sheet = AmountGranularity::of_stock(&stock)?;
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let all = rayon::ThreadPoolBuilder::new().build()?;
    println!("ns per pixel, {RUNS} runs, the fastest; kodak-5219 on Super 35");
    println!("{:>18} {:>12} {:>12}", "", "one thread", "all");
    for [width, height] in [[2048, 1152], [4096, 2304]] {
        let frame = Frame::new([width, height], FilmFormat::Super35.pitch(width, 1.0)?)?;
        let exposures = picture(width, height)?;
        let grain = Grain::new(sheet.clone(), frame.pitch(), GrainSettings::default())?;
        let halation = |antihalation| Halation::new(HalationSettings { antihalation, ..Default::default() });
        let plain = SpatialStage::new(frame);
        let stages = [
            ("nothing", plain.clone()),
            ("sharpness", plain.clone().with_sharpness(&sharpness)),
            ("grain", plain.clone().with_grain(grain.clone())?),
            ("halation 0.8", plain.clone().with_halation(halation(Antihalation::default())?)),
            ("halation none", plain.clone().with_halation(halation(Antihalation::None)?)),
            (
                "all, 0.8",
                plain.with_sharpness(&sharpness).with_grain(grain)?.with_halation(halation(Antihalation::default())?),
            ),
        ];
        println!("{width} x {height}");
        for (name, stage) in stages {
            let time = |pool: &rayon::ThreadPool| pool.install(|| fastest(&stage, &exposures));
            let (one, all) = (time(&one)?, time(&all)?);
            println!("{name:>18} {one:>12.2} {all:>12.2}");
        }
    }
    Ok(())
}

/// Edges, slopes, lights.
fn picture(width: usize, height: usize) -> Result<Planes, onelight_spatial::Error> {
    let mut planes = Planes::new(width, 0..height)?;
    for y in 0..height {
        for row in planes.row_mut(y) {
            for (x, e) in row.iter_mut().enumerate() {
                *e = ((x * 7 + y * 13) % 101) as f32 / 80.0 + if (x * 31 + y * 17) % 9973 == 0 { 300.0 } else { 0.0 };
            }
        }
    }
    Ok(planes)
}

fn fastest(stage: &SpatialStage, exposures: &Planes) -> Result<f64, onelight_spatial::Error> {
    let pixels = (exposures.width() * exposures.rows().len()) as f64;
    let mut buffers = StageBuffers::default();
    let mut fastest = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        let halo = match stage.halation_cells()? {
            Some(mut cells) => {
                cells.add(exposures)?;
                Some(cells.finish()?)
            }
            None => None,
        };
        for start in exposures.rows().step_by(BAND) {
            let rows = start..(start + BAND).min(exposures.rows().end);
            black_box(stage.amounts_in(&mut buffers, exposures, halo.as_ref(), rows, &Nothing)?);
        }
        fastest = fastest.min(start.elapsed().as_secs_f64() * 1e9 / pixels);
    }
    Ok(fastest)
}
