//! Every copy of the pixel loops against the scalar definition of each form.

use half::f16;
use onelight_lut::{
    Channels, Coupling, Decode, Develop, DirectForm, DirectParts, DirectPrint, Domain, ExponentialSum, ExponentialTerm,
    Expose, IDENTITY, Interpolation, Lut1d, Lut3d, Mix, NegativeLight, PixelMap, Pixels, PixelsMut, PlainLut,
    PowerCoding, Rows, Sample, SceneSampler, Shaper, SimdLevel, StructuredLut, StructuredParts,
};

/// Coordinates in a table differ by their roundings, some 3e-7; the forms here change by less than 20 over the table, and a
/// few roundings of the result come on top.
const FLOAT: f32 = 1e-5;

const MIXED: Rows = [[0.9, 0.08, 0.02], [0.05, 0.9, 0.05], [-0.02, 0.1, 0.92]];

const HARD: [f32; 14] = [
    f32::NAN,
    -f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e-40,
    -1e-40,
    f32::MIN_POSITIVE,
    f32::MAX,
    f32::MIN,
    1e30,
    16.0,
];

fn table(size: usize) -> Lut3d {
    let identity = Lut3d::identity(size).unwrap();
    let look =
        |[x, y, z]: [f32; 3]| [x * x + 0.05 * y, (1.5 * y).sin() * (1.0 - 0.1 * x), (z + 0.1).sqrt() - 0.2 * x * y];
    Lut3d::new(size, identity.entries().map(look).collect()).unwrap()
}

/// A curve that rises, a little otherwise in each channel.
fn curves(low: f32, high: f32, top: f32) -> Lut1d {
    let entry = |i: i32| {
        let t = i as f32 / 255.0;
        let s = t * t * (3.0 - 2.0 * t);
        [top * s, top * 0.98 * s, top * 0.95 * s + 0.01]
    };
    Lut1d::new(Domain::common(low, high).unwrap(), (0..256).map(entry).collect()).unwrap()
}

fn plain(how: Interpolation) -> PlainLut {
    PlainLut::new(Shaper::log2(0.02, 16.0).unwrap(), table(17), how)
}

/// Light of a wide gamut, compressed where primaries are converted.
fn expose(input: Rows) -> Expose {
    let negative = if input == MIXED { NegativeLight::Compress } else { NegativeLight::Clip };
    Expose { input, negative, ..Expose::by(MIXED) }
}

/// Layers that hold each other back.
fn develop(top: f32) -> Develop {
    let matrix = [[0.5, -0.4, -0.1], [-0.4, 0.8, -0.4], [-0.1, -0.4, 0.5]];
    let coupling = Coupling { curves: curves(-9.0, 4.0, 1.5), matrix };
    Develop { coupling: Some(coupling), curves: curves(-10.0, 5.0, top) }
}

pub(crate) fn structured(decode: Decode, mix: Option<Mix>) -> StructuredLut {
    let parts = StructuredParts {
        expose: expose(if mix.is_some() { MIXED } else { IDENTITY }),
        develop: develop(1.0),
        mix,
        table: table(9),
        decode,
        interpolation: Interpolation::Tetrahedral,
    };
    StructuredLut::new(parts).unwrap()
}

pub(crate) fn density() -> Decode {
    Decode::Density { matrix: MIXED, coding: PowerCoding::new(2.4, 0.055).unwrap() }
}

pub(crate) fn mix() -> Option<Mix> {
    Some(Mix { matrix: MIXED, offset: [0.01, 0.0, -0.01], curves: curves(0.0, 1.1, 1.0) })
}

fn sum(terms: usize, light: f32) -> ExponentialSum {
    let term = |i: usize| {
        let t = i as f32 / terms as f32;
        let weight = [t - 0.1, 1.1 - t, 0.5].map(|w| light * w / terms as f32);
        ExponentialTerm { rate: [2.0 * t, 2.0 * (1.0 - t), 1.5 * (t - 0.5).abs()], weight }
    };
    ExponentialSum::new((0..terms).map(term).collect()).unwrap()
}

pub(crate) fn direct(print: Option<DirectPrint>) -> DirectForm {
    let coding = PowerCoding::new(2.4, 0.055).unwrap();
    let parts = DirectParts { expose: expose(MIXED), develop: develop(2.0), print, projection: sum(13, 1.5), coding };
    DirectForm::new(parts).unwrap()
}

pub(crate) fn print() -> Option<DirectPrint> {
    Some(DirectPrint { exposure: sum(6, 4.0), curves: curves(-6.0, 3.0, 2.0) })
}

/// Scene light with hard numbers strewn in, as RGBA.
pub(crate) fn scene(pixels: usize) -> Vec<f32> {
    let colours = SceneSampler::new(-10.0..=7.0).unwrap().take(pixels);
    let mut samples: Vec<f32> =
        colours.flat_map(|[r, g, b]| [r as f32, g as f32, b as f32, (r * 0.3) as f32]).collect();
    for (k, hard) in HARD.into_iter().cycle().enumerate().take(samples.len() / 5) {
        samples[5 * k] = hard;
    }
    samples
}

/// Where the pixels of a picture lie among its samples.
#[derive(Clone, Copy)]
struct Layout {
    channels: Channels,
    width: usize,
    height: usize,
    stride: usize,
}

impl Layout {
    fn pixels<S: Sample>(self, samples: &[S]) -> Pixels<'_, S> {
        Pixels::with_stride(samples, self.channels, [self.width, self.height], self.stride).unwrap()
    }

    fn pixels_mut<S: Sample>(self, samples: &mut [S]) -> PixelsMut<'_, S> {
        PixelsMut::with_stride(samples, self.channels, [self.width, self.height], self.stride).unwrap()
    }
}

/// What a sample's distance from the one wanted may be.
trait Near: Sample {
    fn is_near(self, want: Self) -> bool;
    fn bits(self) -> u32;
}

impl Near for f32 {
    fn is_near(self, want: Self) -> bool {
        (self - want).abs() <= FLOAT
    }
    fn bits(self) -> u32 {
        self.to_bits()
    }
}

impl Near for f16 {
    fn is_near(self, want: Self) -> bool {
        // A neighbour where rounding goes the other way.
        (f32::from(self) - f32::from(want)).abs() <= FLOAT + f32::from(want).abs() / 1024.0
    }
    fn bits(self) -> u32 {
        u32::from(self.to_bits())
    }
}

impl Near for u16 {
    fn is_near(self, want: Self) -> bool {
        // 1e-5 is 0.66 codes.
        self.abs_diff(want) <= 1
    }
    fn bits(self) -> u32 {
        u32::from(self)
    }
}

impl Near for u8 {
    fn is_near(self, want: Self) -> bool {
        self.abs_diff(want) <= 1
    }
    fn bits(self) -> u32 {
        u32::from(self)
    }
}

/// Rows with a few samples between them that are nobody's.
fn laid_out<S: Sample>(rgba: &[f32], channels: Channels, width: usize, gap: usize) -> (Vec<S>, Layout) {
    let count = channels.count();
    let height = 3;
    let layout = Layout { channels, width, height, stride: width * count + gap };
    let mut samples = vec![S::from_f32(0.77); layout.stride * height];
    for (pixel, rgba) in rgba.chunks_exact(4).take(width * height).enumerate() {
        let at = pixel / width * layout.stride + pixel % width * count;
        for (to, v) in samples[at..at + count].iter_mut().zip(rgba) {
            *to = S::from_f32(*v);
        }
    }
    (samples, layout)
}

fn follows<S: Near, T: Near>(form: &impl PixelMap, level: SimdLevel, [here, there]: [Channels; 2], width: usize) {
    let gap = width % 3 * 5;
    let rgba = scene(3 * width);
    let (from, from_layout) = laid_out::<S>(&rgba, here, width, gap);
    let (mut to, to_layout) = laid_out::<T>(&[], there, width, gap);
    let before = to.clone();
    form.map_on(level, &from_layout.pixels(&from), &mut to_layout.pixels_mut(&mut to)).unwrap();
    for (at, (to, before)) in to.iter().zip(&before).enumerate() {
        let [row, column] = [at / to_layout.stride.max(1), at % to_layout.stride.max(1)];
        let [pixel, channel] = [column / there.count(), column % there.count()];
        if pixel >= width {
            assert_eq!(to.bits(), before.bits(), "between rows");
            continue;
        }
        let from = &from[row * from_layout.stride + pixel * here.count()..][..here.count()];
        if channel == 3 {
            let Some(alpha) = from.get(3) else {
                assert_eq!(to.bits(), T::from_f32(1.0).bits());
                continue;
            };
            if std::any::TypeId::of::<S>() == std::any::TypeId::of::<T>() {
                assert_eq!(to.bits(), alpha.bits(), "alpha");
            } else if alpha.to_f32().is_finite() {
                assert!(to.is_near(T::from_f32(alpha.to_f32())), "alpha");
            }
            continue;
        }
        let rgb = [from[0].to_f32(), from[1].to_f32(), from[2].to_f32()];
        let want = T::from_f32(form.apply(rgb)[channel]);
        assert!(to.is_near(want), "{} {rgb:?}: {} for {}", level.name(), to.to_f32(), want.to_f32());
    }
}

fn in_place_follows<S: Near>(form: &impl PixelMap, level: SimdLevel, channels: Channels, width: usize) {
    let (mut from, layout) = laid_out::<S>(&scene(3 * width), channels, width, 7);
    let mut to = from.clone();
    form.map_on(level, &layout.pixels(&from), &mut layout.pixels_mut(&mut to)).unwrap();
    form.map_in_place_on(level, &mut layout.pixels_mut(&mut from));
    let bits = |samples: &[S]| samples.iter().map(|s| s.bits()).collect::<Vec<_>>();
    assert_eq!(bits(&from), bits(&to));
}

const CHANNELS: [[Channels; 2]; 4] = [
    [Channels::Rgba, Channels::Rgba],
    [Channels::Rgb, Channels::Rgb],
    [Channels::Rgb, Channels::Rgba],
    [Channels::Rgba, Channels::Rgb],
];

const WIDTHS: [usize; 7] = [1, 7, 8, 127, 128, 129, 1000];

#[test]
fn every_form_on_every_level_follows_its_scalar_definition() {
    fn all(form: &impl PixelMap) {
        for level in SimdLevel::available() {
            for (channels, width) in CHANNELS.into_iter().flat_map(|c| WIDTHS.map(|w| (c, w))) {
                follows::<f32, f32>(form, level, channels, width);
                follows::<f32, u8>(form, level, channels, width);
            }
        }
    }
    all(&plain(Interpolation::Tetrahedral));
    all(&plain(Interpolation::Trilinear));
    all(&structured(Decode::Coded, None));
    all(&structured(Decode::Coded, mix()));
    all(&structured(density(), mix()));
    all(&direct(None));
    all(&direct(print()));
}

#[test]
fn tables_of_every_length_in_memory_are_read_alike() {
    for size in [2, 40, 41, 80, 81] {
        for how in [Interpolation::Tetrahedral, Interpolation::Trilinear] {
            let form = PlainLut::new(Shaper::log2(0.02, 16.0).unwrap(), table(size), how);
            for level in SimdLevel::available() {
                follows::<f32, f32>(&form, level, [Channels::Rgba; 2], 129);
                follows::<f32, f32>(&form, level, [Channels::Rgb; 2], 129);
            }
        }
    }
}

#[test]
fn float64_is_the_same_form_without_the_rounding() {
    fn all(form: &impl PixelMap) {
        for pixel in scene(20_000).as_chunks::<4>().0 {
            let rgb = [pixel[0], pixel[1], pixel[2]];
            let (single, double) = (form.apply(rgb), form.apply_f64(rgb.map(f64::from)));
            for (single, double) in single.into_iter().zip(double) {
                assert!((f64::from(single) - double).abs() <= f64::from(FLOAT), "{rgb:?}: {single} for {double}");
            }
        }
    }
    all(&plain(Interpolation::Tetrahedral));
    all(&plain(Interpolation::Trilinear));
    all(&structured(Decode::Coded, None));
    all(&structured(density(), mix()));
    all(&direct(None));
    all(&direct(print()));
    // A table of coordinates is the shaper itself, which float64 has by another path.
    for how in [Interpolation::Tetrahedral, Interpolation::Trilinear] {
        let form = PlainLut::new(Shaper::log2(0.02, 16.0).unwrap(), Lut3d::identity(17).unwrap(), how);
        for rgb in SceneSampler::new(-10.0..=6.0).unwrap().take(1000) {
            let expected = rgb.map(|v| form.shaper().encode(v));
            assert!(form.apply_f64(rgb).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{rgb:?}");
        }
    }
}

#[test]
fn instructions_can_be_chosen() {
    let (form, rgba) = (plain(Interpolation::Tetrahedral), scene(1000));
    let of = |level: SimdLevel| {
        let mut to = vec![0.0_f32; rgba.len()];
        let from = Pixels::new(&rgba, Channels::Rgba, [1000, 1]).unwrap();
        form.map_on(level, &from, &mut PixelsMut::new(&mut to, Channels::Rgba, [1000, 1]).unwrap()).unwrap();
        to.into_iter().map(f32::to_bits).collect::<Vec<_>>()
    };
    let available = SimdLevel::available();
    assert_eq!(available.last().unwrap().name(), SimdLevel::best().name());
    assert!(of(*available.last().unwrap()) == of(SimdLevel::best()));
    let mut names: Vec<_> = available.iter().map(|level| level.name()).collect();
    names.dedup();
    assert_eq!(names.len(), available.len());
}

#[test]
fn every_pair_of_sample_types_follows() {
    fn from<S: Near>(form: &PlainLut, level: SimdLevel, channels: [Channels; 2], width: usize) {
        follows::<S, f32>(form, level, channels, width);
        follows::<S, f16>(form, level, channels, width);
        follows::<S, u16>(form, level, channels, width);
        follows::<S, u8>(form, level, channels, width);
        in_place_follows::<S>(form, level, channels[0], width);
    }
    let form = plain(Interpolation::Tetrahedral);
    for level in SimdLevel::available() {
        for (channels, width) in CHANNELS.into_iter().flat_map(|c| WIDTHS.map(|w| (c, w))) {
            from::<f32>(&form, level, channels, width);
            from::<f16>(&form, level, channels, width);
            from::<u16>(&form, level, channels, width);
            from::<u8>(&form, level, channels, width);
        }
    }
}

#[test]
fn alpha_comes_back_bit_for_bit() {
    fn all<S: Near>(samples: impl Iterator<Item = S>, level: SimdLevel) {
        let pixels: Vec<S> = samples.flat_map(|a| [S::default(), S::default(), S::default(), a]).collect();
        let layout = Layout { channels: Channels::Rgba, width: pixels.len() / 4, height: 1, stride: pixels.len() };
        let mut to = vec![S::default(); pixels.len()];
        let form = plain(Interpolation::Tetrahedral);
        form.map_on(level, &layout.pixels(&pixels), &mut layout.pixels_mut(&mut to)).unwrap();
        for (to, from) in to.iter().zip(&pixels).skip(3).step_by(4) {
            assert_eq!(to.bits(), from.bits());
        }
    }
    for level in SimdLevel::available() {
        all(0..=u8::MAX, level);
        all(0..=u16::MAX, level);
        all((0..=u16::MAX).map(f16::from_bits), level);
        all((0..=u32::MAX).step_by(65_521).map(f32::from_bits), level);
    }
}

#[test]
fn hard_numbers_count_as_stated() {
    fn same(form: &impl PixelMap, level: SimdLevel, hard: [f32; 3], plain: [f32; 3]) {
        let mut both = [hard, plain];
        let layout = Layout { channels: Channels::Rgb, width: 2, height: 1, stride: 6 };
        form.map_in_place_on(level, &mut layout.pixels_mut(both.as_flattened_mut()));
        assert!(both[0].iter().all(|v| v.is_finite()), "{hard:?}");
        assert_eq!(both[0], both[1], "{hard:?} for {plain:?}");
    }
    fn all(form: &impl PixelMap, level: SimdLevel) {
        same(form, level, [f32::NAN, -f32::NAN, 0.5], [0.0, 0.0, 0.5]);
        same(form, level, [f32::INFINITY, 0.5, f32::NEG_INFINITY], [1e30, 0.5, -1e30]);
        same(form, level, [f32::MAX, 0.5, f32::MIN], [1e30, 0.5, -1e30]);
        same(form, level, [-0.0, 1e-45, 0.18], [0.0, 0.0, 0.18]);
    }
    let plain = plain(Interpolation::Tetrahedral);
    for level in SimdLevel::available() {
        all(&plain, level);
        all(&structured(density(), mix()), level);
        all(&direct(print()), level);
        same(&plain, level, [-5.0, 17.0, 1.0], [0.0, 16.0, 1.0]);
    }
}

#[test]
fn eight_bits_seldom_differ() {
    // Rounding moves a value by some 1e-6 of the range, 3e-4 of a code: so many of a thousand lie that near to an edge.
    let rgba: Vec<f32> = scene(40_000).into_iter().map(|v| if v.is_finite() { v } else { 0.0 }).collect();
    let layout = Layout { channels: Channels::Rgba, width: 40_000, height: 1, stride: 160_000 };
    let form = plain(Interpolation::Tetrahedral);
    let mut to = vec![0_u8; rgba.len()];
    form.map(&layout.pixels(&rgba), &mut layout.pixels_mut(&mut to)).unwrap();
    let differ = rgba
        .as_chunks::<4>()
        .0
        .iter()
        .zip(to.as_chunks::<4>().0)
        .filter(|([r, g, b, _], to)| form.apply([*r, *g, *b]).map(u8::from_f32)[..] != to[..3]);
    let differ = differ.count();
    assert!(differ < 40, "{differ} of 40000");
}

#[test]
fn no_pixels_are_no_trouble() {
    let form = plain(Interpolation::Tetrahedral);
    for [width, height] in [[0, 0], [0, 3], [3, 0]] {
        let layout = Layout { channels: Channels::Rgba, width, height, stride: 4 * width };
        form.map::<f32, u8>(&layout.pixels(&[]), &mut layout.pixels_mut(&mut [])).unwrap();
        form.map_in_place::<f32>(&mut layout.pixels_mut(&mut []));
    }
    form.map_colours(&mut []);
}
