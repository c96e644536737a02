//! The effects on planes of exposures, each and together, beside the direct form alone and a copy. Development does nothing: what is measured is
//! the effects.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use onelight_benches::{FULL_HD, Forms, NEGATIVE, Size, Threads, ULTRA_HD, film, natural, pool};
use onelight_film::{SheetText, Stock};
use onelight_lut::{Channels, PixelMap, Pixels, PixelsMut};
use onelight_spatial::{
    AmountGranularity, Antihalation, Development, FilmFormat, Frame, Grain, GrainSettings, Halation, HalationSettings,
    Planes, Sharpness, SpatialStage, StageBuffers,
};

/// Rows of a band.
const BAND: usize = 384;
/// Numbers of a pixel of an RGBA picture.
const RGBA: usize = 4;

struct Nothing;

impl Development for Nothing {
    fn develop(&self, _: [&mut [f32]; 3]) {}
}

type Failure = Box<dyn std::error::Error>;

fn stock() -> Result<Stock, Failure> {
    let f = onelight_stocks::find("kodak-5219").ok_or("no such stock")?;
    let text = SheetText {
        id: f.id,
        stock_toml: f.stock_toml,
        sensitivity_csv: f.sensitivity_csv,
        characteristic_csv: f.characteristic_csv,
        dye_density_csv: f.dye_density_csv,
    };
    Ok(Stock::parse(&text)?.with_figures(f.mtf_csv, f.granularity_csv)?)
}

/// The effects on a picture that fills a frame of Super 35.
fn stages(stock: &Stock, [width, height]: Size) -> Result<Vec<(&'static str, SpatialStage)>, Failure> {
    let frame = Frame::new([width, height], FilmFormat::Super35.pitch(width, 1.0)?)?;
    let sharpness = Sharpness::of_stock(stock)?;
    let grain = Grain::new(AmountGranularity::of_stock(stock)?, frame.pitch(), GrainSettings::default())?;
    let halation = |antihalation| Halation::new(HalationSettings { antihalation, ..Default::default() });
    let plain = SpatialStage::new(frame);
    let sharp = plain.clone().with_sharpness(&sharpness);
    Ok(vec![
        ("no effect", plain.clone()),
        ("sharpness", sharp.clone()),
        ("grain", plain.clone().with_grain(grain.clone())?),
        ("halation, 0.8", plain.clone().with_halation(halation(Antihalation::default())?)),
        ("halation, none", plain.with_halation(halation(Antihalation::None)?)),
        ("all, 0.8", sharp.with_grain(grain)?.with_halation(halation(Antihalation::default())?)),
    ])
}

fn run(stage: &SpatialStage, exposures: &Planes, buffers: &mut StageBuffers) -> Result<(), onelight_spatial::Error> {
    let halo = match stage.halation_cells()? {
        Some(mut cells) => {
            cells.add(exposures)?;
            Some(cells.finish()?)
        }
        None => None,
    };
    for start in exposures.rows().step_by(BAND) {
        let rows = start..(start + BAND).min(exposures.rows().end);
        black_box(stage.amounts_in(buffers, exposures, halo.as_ref(), rows, &Nothing)?);
    }
    Ok(())
}

fn planes(picture: &[f32], [width, height]: Size) -> Result<Planes, onelight_spatial::Error> {
    let mut planes = Planes::new(width, 0..height)?;
    for (y, row) in picture.chunks_exact(RGBA * width).enumerate() {
        for (k, layer) in planes.row_mut(y).into_iter().enumerate() {
            layer.iter_mut().zip(row.chunks_exact(RGBA)).for_each(|(e, pixel)| *e = pixel[k]);
        }
    }
    Ok(planes)
}

fn spatial(c: &mut Criterion) {
    let film = film(NEGATIVE).expect("a built-in process compiles");
    let Forms { direct, .. } = Forms::new(&film).expect("a built-in film is finite");
    let stock = stock().expect("a built-in stock is readable");
    for (name, size) in [("1080p", FULL_HD), ("4K", ULTRA_HD)] {
        let picture = natural(size);
        let exposures = planes(&picture, size).expect("a picture of this size");
        let stages = stages(&stock, size).expect("a stock with figures");
        for threads in Threads::EACH {
            let pool = pool(threads).expect("the system gives threads");
            let mut group = c.benchmark_group(format!("effects on {name}, {}", threads.name()));
            group.throughput(Throughput::Elements((size[0] * size[1]) as u64));
            group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(800));
            let mut to = picture.clone();
            group.bench_function("copy, RGBA", |b| b.iter(|| to.copy_from_slice(black_box(&picture))));
            let from = Pixels::new(&picture, Channels::Rgba, size).expect("as many samples as it says");
            let mut to = PixelsMut::new(&mut to, Channels::Rgba, size).expect("as many samples as it says");
            group.bench_function("direct form, f32 to f32", |b| {
                b.iter(|| pool.install(|| direct.map(black_box(&from), &mut to)).expect("pictures of one size"));
            });
            let mut buffers = StageBuffers::default();
            for (name, stage) in &stages {
                let mut all = || pool.install(|| run(stage, black_box(&exposures), &mut buffers));
                group.bench_function(*name, |b| b.iter(|| all().expect("rows of the picture")));
            }
        }
    }
}

criterion_group!(benches, spatial);
criterion_main!(benches);
