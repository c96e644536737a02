//! Sharpness, halation and grain on the card against those of the processor.

use onelight::spatial::{
    AmountGranularity, Antihalation, Development, FilmFormat, Frame, Grain, GrainSettings, Halation, HalationSettings,
    Planes, Sharpness, SpatialStage,
};
use onelight_gpu::{Headless, SpatialPass};
use onelight_lut::{DirectForm, DirectParts, ExponentialSum, ExponentialTerm, PowerCoding, StagedMap};
use wgpu::{TextureFormat, TextureUsages};

use crate::adapter::gpu;
use crate::picture::{Verb, develop, floats, source, view};

const SIZE: [usize; 2] = [203, 117];
/// How far amounts of dye may lie from the processor's: exposures differ by some 1e-6 of the largest nearby, and a curve rises by less
/// than an amount of 1 for a factor of 10.
const AMOUNTS: f32 = 1e-4;
/// The same for what is seen.
const SHOWN: f32 = 1e-3;

/// Edges, slopes, and a lamp.
fn pixels() -> Vec<[f32; 4]> {
    let pixel = |i: usize| {
        let (x, y) = (i % SIZE[0], i / SIZE[0]);
        let wave = 0.18 * (0.7 * x as f32).sin().exp2() * if y > 60 { 0.1 } else { 1.0 };
        let lamp = if x.abs_diff(90) < 4 && y.abs_diff(50) < 4 { 500.0 } else { 0.0 };
        [wave + lamp, 0.8 * wave + lamp, 0.5 * wave + lamp, 0.25]
    };
    (0..SIZE[0] * SIZE[1]).map(pixel).collect()
}

fn form(camera: &str) -> DirectForm {
    onelight::Process::for_camera(camera).unwrap().compile().unwrap().direct(&Default::default()).unwrap()
}

/// The same film, seen so that light is 2^-dye, layer by layer.
fn bare(form: &DirectForm) -> DirectForm {
    let unit = |c: usize| std::array::from_fn(|k| if k == c { 1.0 } else { 0.0 });
    let terms = (0..3).map(|c| ExponentialTerm { rate: unit(c), weight: unit(c) }).collect();
    let projection = ExponentialSum::new(terms).unwrap();
    let parts = DirectParts { print: None, projection, coding: PowerCoding::LINEAR, ..form.parts().clone() };
    DirectForm::new(parts).unwrap()
}

#[derive(Clone, Copy)]
struct Wanted {
    width: usize,
    sharpness: bool,
    halation: Option<f64>,
    grain: bool,
}

fn stage(camera: &str, wanted: Wanted) -> SpatialStage {
    let film = onelight::stock(camera).unwrap();
    let frame = Frame::new(SIZE, FilmFormat::Super35.pitch(wanted.width, 1.0).unwrap()).unwrap();
    let frame = frame.at([31, -17]).numbered(5);
    let mut stage = SpatialStage::new(frame);
    if wanted.sharpness {
        stage = stage.with_sharpness(&Sharpness::of_stock(&film).unwrap());
    }
    if let Some(density) = wanted.halation {
        let settings = HalationSettings { antihalation: Antihalation::Density(density), ..Default::default() };
        stage = stage.with_halation(Halation::new(settings).unwrap());
    }
    if wanted.grain {
        let granularity = AmountGranularity::of_stock(&film).unwrap();
        let settings = GrainSettings { seed: 3, ..Default::default() };
        stage = stage.with_grain(Grain::new(granularity, frame.pitch(), settings).unwrap()).unwrap();
    }
    stage
}

struct Curves<'a>(&'a DirectForm);

impl Development for Curves<'_> {
    fn develop(&self, layers: [&mut [f32]; 3]) {
        self.0.develop(layers);
    }
}

/// Amounts of dye, and what is seen of them, as the processor has them.
fn on_processor(form: &DirectForm, stage: &SpatialStage) -> (Planes, Vec<[f32; 3]>) {
    let linear: Vec<[f32; 3]> = pixels().iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let mut exposures = Planes::new(SIZE[0], 0..SIZE[1]).unwrap();
    for (y, row) in linear.chunks(SIZE[0]).enumerate() {
        form.expose(row, exposures.row_mut(y));
    }
    let halo = stage.halation_cells().unwrap().map(|mut cells| {
        cells.add(&exposures).unwrap();
        cells.finish().unwrap()
    });
    let amounts = stage.amounts(&exposures, halo.as_ref(), 0..SIZE[1], &Curves(form)).unwrap();
    let mut shown = vec![[0.0; 3]; linear.len()];
    for (y, row) in shown.chunks_mut(SIZE[0]).enumerate() {
        form.finish(amounts.row(y), row);
    }
    (amounts, shown)
}

fn on_card(gpu: &Headless, form: &DirectForm, stage: &SpatialStage) -> Vec<[f32; 4]> {
    let format = TextureFormat::Rgba32Float;
    let size = SIZE.map(|side| side as u32);
    let pass = SpatialPass::new(&gpu.device, &gpu.queue, form, stage, format).unwrap();
    let from = source(gpu, size, format, &pixels());
    let to = gpu.texture(size, format, pass.target_usage() | TextureUsages::COPY_SRC).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder, &view(&from), &view(&to)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    floats(&gpu.read_back(&to).unwrap())
}

#[test]
fn effects_are_those_of_the_processor() {
    let Some(gpu) = gpu() else { return };
    let none = Wanted { width: 2048, sharpness: false, halation: None, grain: false };
    let all = Wanted { sharpness: true, halation: Some(0.6), grain: true, ..none };
    for (camera, wanted) in [
        ("kodak-5207", Wanted { sharpness: true, ..none }),
        ("kodak-5207", Wanted { grain: true, ..none }),
        ("kodak-5207", Wanted { halation: Some(0.8), ..none }),
        ("kodak-5219", all),
        ("kodak-5219", Wanted { width: 6000, halation: Some(0.0), ..all }),
        ("kodak-ektachrome-100", all),
    ] {
        let (form, stage) = (form(camera), stage(camera, wanted));
        let bare = bare(&form);
        let (amounts, _) = on_processor(&bare, &stage);
        let (_, shown) = on_processor(&form, &stage);
        let mut largest = [0.0f32; 2];
        for (i, found) in on_card(gpu, &bare, &stage).iter().enumerate() {
            for (layer, amount) in amounts.row(i / SIZE[0]).into_iter().enumerate() {
                largest[0] = largest[0].max((-found[layer].log2() - amount[i % SIZE[0]]).abs());
            }
        }
        for (found, expected) in on_card(gpu, &form, &stage).iter().zip(&shown) {
            assert_eq!(found[3], 0.25, "alpha");
            (0..3).for_each(|k| largest[1] = largest[1].max((found[k] - expected[k]).abs()));
        }
        eprintln!(
            "{}: {camera}, {} pixels: amounts {:.1e}, shown {:.1e}",
            gpu.name(),
            wanted.width,
            largest[0],
            largest[1]
        );
        assert!(largest[0] <= AMOUNTS && largest[1] <= SHOWN, "{camera}: {largest:?}");
    }
}

#[test]
fn without_effects_it_is_the_film_pass() {
    let Some(gpu) = gpu() else { return };
    let form = form("kodak-5207");
    let none = Wanted { width: 2048, sharpness: false, halation: None, grain: false };
    let format = TextureFormat::Rgba32Float;
    let pass = onelight_gpu::FilmPass::new(&gpu.device, &gpu.queue, &form, format).unwrap();
    let plain = develop(gpu, &pass, &source(gpu, SIZE.map(|side| side as u32), format, &pixels()), Verb::Encode);
    assert_eq!(floats(&plain), on_card(gpu, &form, &stage("kodak-5207", none)));
}

#[test]
fn another_exposure_is_an_upload() {
    let Some(gpu) = gpu() else { return };
    let all = Wanted { width: 2048, sharpness: true, halation: Some(0.6), grain: true };
    let (form, stage, format) = (form("kodak-5219"), stage("kodak-5219", all), TextureFormat::Rgba32Float);
    let brighter = form.clone().with_expose(form.parts().expose.brighter(1.0)).unwrap();
    let pass = SpatialPass::new(&gpu.device, &gpu.queue, &form, &stage, format).unwrap();
    pass.upload(&gpu.queue, &brighter).unwrap();
    let from = source(gpu, SIZE.map(|side| side as u32), format, &pixels());
    let to = gpu.texture(SIZE.map(|side| side as u32), format, pass.target_usage() | TextureUsages::COPY_SRC).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder, &view(&from), &view(&to)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    let found = floats(&gpu.read_back(&to).unwrap());
    assert_eq!(found, on_card(gpu, &brighter, &stage));
    assert!(found != on_card(gpu, &form, &stage));
}

#[test]
fn frames_have_grain_of_their_own_and_other_sizes_are_refused() {
    let Some(gpu) = gpu() else { return };
    let form = form("kodak-5219");
    let wanted = Wanted { width: 2048, sharpness: false, halation: None, grain: true };
    let format = TextureFormat::Rgba32Float;
    let stage = stage("kodak-5219", wanted);
    let pass = SpatialPass::new(&gpu.device, &gpu.queue, &form, &stage, format).unwrap();
    let frame = |number: u32, size: [u32; 2]| {
        let pixels = vec![[0.18, 0.18, 0.18, 1.0]; (size[0] * size[1]) as usize];
        let from = source(gpu, size, format, &pixels);
        let to = gpu.texture(size, format, pass.target_usage() | TextureUsages::COPY_SRC).unwrap();
        pass.set_frame(&gpu.queue, number);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let encoded = pass.encode(&mut encoder, &view(&from), &view(&to));
        gpu.queue.submit([encoder.finish()]);
        encoded.map(|()| floats(&gpu.read_back(&to).unwrap()))
    };
    let size = SIZE.map(|side| side as u32);
    let [first, second, again] = [1, 2, 1].map(|number| frame(number, size).unwrap());
    assert!(first != second && first == again);
    let message = frame(1, [64, 64]).unwrap_err().to_string();
    assert_eq!(message, "size of the textures: found 64 x 64, expected 203 x 117 as the stage is for");
    let error = SpatialPass::new(&gpu.device, &gpu.queue, &form, &stage, TextureFormat::Bgra8Unorm).unwrap_err();
    assert!(error.to_string().contains("found Bgra8Unorm, expected Rgba8Unorm"), "{error}");
}
