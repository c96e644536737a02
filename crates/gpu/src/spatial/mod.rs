//! What film does to a picture rather than to a colour, in the user's own frame.

mod step;

use onelight_lut::DirectForm;
use onelight_spatial::{AxisMap, GrainNumbers, HalationNumbers, SpatialStage, StageNumbers};
use wgpu::{
    BindGroup, BindGroupLayout, Buffer, BufferDescriptor, BufferUsages, CommandEncoder, ComputePassDescriptor,
    ComputePipeline, Device, Extent3d, Queue, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages,
    TextureView, TextureViewDescriptor,
};

use self::step::{Slot, Step, dispatch, group, layout};
use crate::check::{MAX_SIDE, check_pair, checked};
use crate::error::{Error, ErrorKind, Refused};
use crate::pass::FilmPass;
use crate::pipeline::compute_pipeline;
use crate::settings::LookSettings;
use crate::shader;
use crate::target::{Target, WriteMethod};

/// A look with sharpness, halation and grain, ready to be applied to textures of one size in the user's own frame.
///
/// Exposures, amounts of dye and what lies between are in 32-bit floats: lamps overflow half floats. Five textures of 16 bytes a
/// pixel are made once; a frame makes none. The noise of grain is the CPU's to the bit, exposures come within some 1e-6 of the largest
/// nearby. A stage without any effect is a [`FilmPass`].
///
/// ```no_run
/// use onelight::spatial::{AmountGranularity, FilmFormat, Frame, Grain, GrainSettings, Sharpness, SpatialStage};
/// use onelight_gpu::wgpu::TextureFormat::Rgba16Float;
/// use onelight_gpu::{Headless, SpatialPass};
///
/// let gpu = Headless::open(&Default::default())?;
/// let form = onelight::Process::for_camera("kodak-5219")?.compile()?.direct(&Default::default())?;
/// let film = onelight::stock("kodak-5219")?;
/// let frame = Frame::new([1920, 1080], FilmFormat::Super16.pitch(1920, 1.0)?)?;
/// let grain = Grain::new(AmountGranularity::of_stock(&film)?, frame.pitch(), GrainSettings::default())?;
/// let stage = SpatialStage::new(frame).with_sharpness(&Sharpness::of_stock(&film)?).with_grain(grain)?;
/// let pass = SpatialPass::new(&gpu.device, &gpu.queue, &form, &stage, Rgba16Float)?;
///
/// // In every frame, with the frame's own encoder and number.
/// # use onelight_gpu::wgpu::{CommandEncoder, TextureView};
/// let frame = |encoder: &mut CommandEncoder, hdr: &TextureView, display: &TextureView, number: u32| {
///     pass.set_frame(&gpu.queue, number);
///     pass.encode(encoder, hdr, display)
/// };
/// # let _ = frame;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SpatialPass {
    device: Device,
    film: FilmPass,
    target: Target,
    size: [u32; 2],
    effects: Option<Effects>,
}

/// The steps of a frame.
#[derive(Debug)]
struct Effects {
    source: BindGroupLayout,
    target: BindGroupLayout,
    expose: OfLook,
    before: Vec<Step>,
    develop: OfLook,
    after: Vec<Step>,
    finish: OfLook,
    noise: Option<Noise>,
}

/// A step that reads the look.
#[derive(Debug)]
struct OfLook {
    pipeline: ComputePipeline,
    group: BindGroup,
}

/// The uniform of the noise, whose frame changes.
#[derive(Debug)]
struct Noise {
    uniform: Buffer,
    offset: [i32; 2],
    radius: [i32; 2],
    seed: u32,
}

impl SpatialPass {
    /// A pass for a direct form, a stage and a format of target, one of `Rgba8Unorm`, `Rgba16Float` and `Rgba32Float`.
    ///
    /// # Errors
    /// If the format is another, the device does not compute, the picture is larger than [`MAX_SIDE`] or as [`FilmPass::new`].
    pub fn new(
        device: &Device,
        queue: &Queue,
        form: &DirectForm,
        stage: &SpatialStage,
        target: TextureFormat,
    ) -> Result<Self, Error> {
        let film = FilmPass::with_settings(device, queue, form, target, &LookSettings::default())?;
        let target = Target::new(target)?;
        if target.write_method(device) != WriteMethod::Compute {
            return Err(ErrorKind::SpatialTarget { found: target.format() }.into());
        }
        let numbers = stage.numbers();
        let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
        let [width, height] = [side(numbers.frame.width()), side(numbers.frame.height())];
        if width.max(height) > MAX_SIDE {
            return Err(ErrorKind::Side { width, height, max: MAX_SIDE }.into());
        }
        let size = [width, height];
        let any = numbers.scatter.is_some()
            || numbers.halation.is_some()
            || numbers.adjacency.is_some()
            || numbers.grain.is_some();
        let effects = any.then(|| Maker { device, queue, size }.effects(&film, target, &numbers));
        Ok(Self { device: device.clone(), film, target, size, effects })
    }

    /// The number of the next frames in their sequence: each has grain of its own. It shows from the next submission on.
    pub fn set_frame(&self, queue: &Queue, number: u32) {
        if let Some(noise) = self.effects.as_ref().and_then(|effects| effects.noise.as_ref()) {
            queue.write_buffer(&noise.uniform, 0, &noise.bytes(number));
        }
    }

    /// Uploads another direct form into the resources that are there, as [`FilmPass::upload`]; the effects stay those of the stage. It
    /// shows from the next submission on.
    ///
    /// # Errors
    /// As [`FilmPass::upload`].
    pub fn upload(&self, queue: &Queue, form: &DirectForm) -> Result<(), Error> {
        self.film.upload(queue, form)
    }

    /// Develops `source` into `target`, both of the stage's size; otherwise as [`FilmPass::encode`].
    ///
    /// # Errors
    /// As [`FilmPass::encode`], or if the textures have another size than the stage.
    pub fn encode(
        &self,
        encoder: &mut CommandEncoder,
        source: &TextureView,
        target: &TextureView,
    ) -> Result<(), Error> {
        check_pair(source, target, self.target.format(), self.target_usage())?;
        let to = [target.texture().width(), target.texture().height()];
        if to != self.size {
            return Err(ErrorKind::StageSize { found: to, expected: self.size }.into());
        }
        let Some(effects) = &self.effects else { return self.film.encode(encoder, source, target) };
        let from = checked(&self.device, Refused::SourceAndTarget, || {
            group(&self.device, &effects.source, &[Slot::Floats(source)])
        })?;
        let both = checked(&self.device, Refused::SourceAndTarget, || {
            let slots = [Slot::Floats(source), Slot::Written(target, self.target.format())];
            group(&self.device, &effects.target, &slots)
        })?;
        let look = self.film.look().bind_group();
        let mut pass =
            encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("onelight"), timestamp_writes: None });
        let of_look = |pass: &mut wgpu::ComputePass<'_>, step: &OfLook, textures: Option<&BindGroup>| {
            pass.set_pipeline(&step.pipeline);
            pass.set_bind_group(0, look, &[]);
            pass.set_bind_group(1, &step.group, &[]);
            if let Some(textures) = textures {
                pass.set_bind_group(2, textures, &[]);
            }
            dispatch(pass, self.size);
        };
        of_look(&mut pass, &effects.expose, Some(&from));
        effects.before.iter().for_each(|step| step.run(&mut pass));
        of_look(&mut pass, &effects.develop, None);
        effects.after.iter().for_each(|step| step.run(&mut pass));
        of_look(&mut pass, &effects.finish, Some(&both));
        Ok(())
    }

    /// The usage that [`SpatialPass::encode`] needs a target to allow.
    pub fn target_usage(&self) -> TextureUsages {
        WriteMethod::Compute.usage()
    }

    /// The format of its targets.
    pub fn target_format(&self) -> TextureFormat {
        self.target.format()
    }
}

impl Noise {
    fn bytes(&self, number: u32) -> Vec<u8> {
        let ints = self.offset.into_iter().chain(self.radius).map(i32::cast_unsigned);
        words(ints.chain([number, self.seed, 0, 0]))
    }
}

/// Makes the resources of one size.
struct Maker<'a> {
    device: &'a Device,
    queue: &'a Queue,
    size: [u32; 2],
}

/// What a step along an axis does with its sums.
enum Sum<'a> {
    Stored,
    /// Their distance from the first, times the share; the second added to it.
    Gain(f32, &'a TextureView, Option<&'a TextureView>),
}

impl Maker<'_> {
    fn effects(&self, film: &FilmPass, target: Target, numbers: &StageNumbers) -> Effects {
        let [exposures, between] = [self.full(), self.full()];
        let axis = self.axis_pipeline(&exposures, &between);
        let (mut before, mut after) = (Vec::new(), Vec::new());
        let (narrow, wide) = match &numbers.scatter {
            Some(scatter) => {
                let [narrow, wide] = [self.full(), self.full()];
                for (maps, to) in [(&scatter.narrow, &narrow), (&scatter.wide, &wide)] {
                    before.extend(self.both_axes(&axis, maps, [&exposures, &between, to], [self.size; 2]));
                }
                (narrow, wide)
            }
            None => (exposures.clone(), exposures.clone()),
        };
        let halo = match &numbers.halation {
            Some(halation) => {
                before.extend(self.halo(&axis, halation, &exposures, &between));
                between.clone()
            }
            None => wide.clone(),
        };
        // Read by nobody after scatter.
        let amounts = if numbers.scatter.is_some() { exposures.clone() } else { self.full() };
        let blurred = match &numbers.adjacency {
            Some(adjacency) => {
                let blurred = if numbers.scatter.is_some() { narrow.clone() } else { self.full() };
                after.extend(self.both_axes(&axis, &adjacency.blur, [&amounts, &between, &blurred], [self.size; 2]));
                blurred
            }
            None => amounts.clone(),
        };
        let share = numbers.scatter.as_ref().map_or([0.0; 3], |scatter| scatter.share);
        let pull = numbers.halation.as_ref().map_or([0.0; 3], |halation| halation.pull);
        let exposed = self.uniform(&words([share, pull].iter().flat_map(|layers| four(*layers))));
        let develop = [
            Slot::Uniform(&exposed),
            Slot::Floats(&narrow),
            Slot::Floats(&wide),
            Slot::Floats(&halo),
            Slot::Written(&amounts, TextureFormat::Rgba32Float),
        ];
        let (taps, tables, rows, noise, finish) = self.grain(numbers, &mut after);
        let finish_slots = [
            Slot::Uniform(&finish),
            Slot::Numbers(&taps),
            Slot::Numbers(&tables),
            Slot::Floats(&amounts),
            Slot::Floats(&blurred),
            Slot::Integers(&rows),
        ];
        let source = layout(self.device, &[Slot::Floats(&exposures)]);
        let target_layout = layout(self.device, &[Slot::Floats(&exposures), Slot::Written(&amounts, target.format())]);
        let exposure_slots = [Slot::Written(&exposures, TextureFormat::Rgba32Float)];
        let of_look = |text: String, entry: &str, slots: &[Slot<'_>], textures: Option<&BindGroupLayout>| {
            let own = layout(self.device, slots);
            let layouts: Vec<&BindGroupLayout> = [film.look().layout(), &own].into_iter().chain(textures).collect();
            let pipeline = compute_pipeline(self.device, text, entry, &layouts);
            OfLook { pipeline, group: group(self.device, &own, slots) }
        };
        Effects {
            expose: of_look(shader::spatial_expose(), "onelight_expose_pixel", &exposure_slots, Some(&source)),
            before,
            develop: of_look(shader::spatial_develop(), "onelight_develop_pixel", &develop, None),
            after,
            finish: of_look(
                shader::spatial_finish(target),
                "onelight_finish_pixel",
                &finish_slots,
                Some(&target_layout),
            ),
            source,
            target: target_layout,
            noise,
        }
    }

    /// The field of halation, at each pixel, in `to`.
    fn halo(
        &self,
        axis: &AxisPipeline,
        halation: &HalationNumbers,
        exposures: &TextureView,
        to: &TextureView,
    ) -> Vec<Step> {
        let count = |map: &AxisMap| map.first.len() as u32;
        let [width, height] = self.size;
        let cells = [count(&halation.to_cells[0]), count(&halation.to_cells[1])];
        let texture = |size| self.texture(size, TextureFormat::Rgba32Float);
        let [means, between, field] = [texture(cells), texture(cells), texture(cells)];
        let gains = [texture(cells), texture(cells)];
        let (narrow, wide) = (texture([cells[0], height]), texture([width, cells[1]]));
        let mut steps =
            self.both_axes(axis, &halation.to_cells, [exposures, &narrow, &means], [[cells[0], height], cells]);
        for (i, (share, [x, y])) in halation.gaussians.iter().enumerate() {
            let (gain, last) = (&gains[i % 2], &gains[(i + 1) % 2]);
            steps.push(self.along(axis, x, 0, [&means, &between], &Sum::Stored, cells));
            let sum = Sum::Gain(*share, &means, (i > 0).then_some(last));
            steps.push(self.along(axis, y, 1, [&between, gain], &sum, cells));
        }
        let gain = &gains[(halation.gaussians.len() + 1) % 2];
        let reach = halation.hole_reach.map(|reach| reach as u32);
        let uniform = self.uniform(&words([reach[0], reach[1], 0, 0]));
        let weights = self.numbers(&words(halation.hole.iter().map(|w| w.to_bits())));
        let slots = [
            Slot::Uniform(&uniform),
            Slot::Numbers(&weights),
            Slot::Floats(&means),
            Slot::Floats(gain),
            Slot::Written(&field, TextureFormat::Rgba32Float),
        ];
        let own = layout(self.device, &slots);
        let pipeline = compute_pipeline(self.device, shader::SPATIAL_HOLE.to_owned(), "onelight_halo", &[&own]);
        steps.push(Step { pipeline, group: group(self.device, &own, &slots), size: cells });
        steps.extend(self.both_axes(axis, &halation.to_pixels, [&field, &wide, to], [[width, cells[1]], self.size]));
        steps
    }

    /// Taps, tables, noise, and the uniform of the last step.
    fn grain(
        &self,
        numbers: &StageNumbers,
        after: &mut Vec<Step>,
    ) -> (Buffer, Buffer, TextureView, Option<Noise>, Buffer) {
        let strength = numbers.adjacency.as_ref().map_or([0.0; 3], |adjacency| adjacency.strength);
        let Some(grain) = &numbers.grain else {
            let nothing = || self.numbers(&words([0; 4]));
            let rows = self.texture([1, 1], TextureFormat::Rgba32Sint);
            let finish = self.uniform(&words(four(strength).into_iter().chain([0; 12])));
            return (nothing(), nothing(), rows, None, finish);
        };
        let GrainNumbers { seed, taps: [x, y], scale, axes, intervals } = grain;
        let radius = [x.len() - 1, y.len() - 1].map(|radius| radius as i32);
        let taps = self.numbers(&words(x.iter().chain(y).map(|tap| tap.cast_unsigned())));
        let tables = self.numbers(&words(intervals.iter().flatten().flatten().map(|v| v.to_bits())));
        let rows =
            self.texture([self.size[0], self.size[1] + 2 * radius[1].cast_unsigned()], TextureFormat::Rgba32Sint);
        let noise = Noise { uniform: self.uniform(&[0; 32]), offset: numbers.frame.offset(), radius, seed: *seed };
        self.queue.write_buffer(&noise.uniform, 0, &noise.bytes(numbers.frame.number()));
        let slots =
            [Slot::Uniform(&noise.uniform), Slot::Numbers(&taps), Slot::Written(&rows, TextureFormat::Rgba32Sint)];
        let own = layout(self.device, &slots);
        let pipeline = compute_pipeline(self.device, shader::SPATIAL_NOISE.to_owned(), "onelight_noise_rows", &[&own]);
        let size = [self.size[0], self.size[1] + 2 * radius[1].cast_unsigned()];
        after.push(Step { pipeline, group: group(self.device, &own, &slots), size });
        let floats = [strength, axes.map(|axis| axis[0]), axes.map(|axis| axis[1])];
        let count = intervals[0].len() as u32;
        let last = [scale.to_bits(), x.len() as u32, radius[1].cast_unsigned(), count];
        let finish = self.uniform(&words(floats.into_iter().flat_map(four).chain(last)));
        (taps, tables, rows, Some(noise), finish)
    }

    /// A map along x, then one along y, of pictures that come out in these sizes.
    fn both_axes(
        &self,
        axis: &AxisPipeline,
        [x, y]: &[AxisMap; 2],
        [from, between, to]: [&TextureView; 3],
        sizes: [[u32; 2]; 2],
    ) -> Vec<Step> {
        vec![
            self.along(axis, x, 0, [from, between], &Sum::Stored, sizes[0]),
            self.along(axis, y, 1, [between, to], &Sum::Stored, sizes[1]),
        ]
    }

    fn along(
        &self,
        AxisPipeline { layout, pipeline }: &AxisPipeline,
        map: &AxisMap,
        axis: u32,
        [from, to]: [&TextureView; 2],
        sum: &Sum<'_>,
        size: [u32; 2],
    ) -> Step {
        let (adds, share, own, base) = match sum {
            Sum::Stored => (0, 0.0, from, from),
            Sum::Gain(share, own, None) => (1, *share, *own, from),
            Sum::Gain(share, own, Some(base)) => (2, *share, *own, *base),
        };
        let uniform = self.uniform(&words([map.count as u32, axis, adds, share.to_bits()]));
        let first = self.numbers(&words(map.first.iter().copied()));
        let weights = self.numbers(&words(map.weights.iter().flatten().map(|w| w.to_bits())));
        let slots = axis_slots(&uniform, &first, &weights, [from, own, base], to);
        Step { pipeline: pipeline.clone(), group: group(self.device, layout, &slots), size }
    }

    fn axis_pipeline(&self, from: &TextureView, to: &TextureView) -> AxisPipeline {
        let (uniform, numbers) = (self.uniform(&[0; 16]), self.numbers(&[0; 16]));
        let layout = layout(self.device, &axis_slots(&uniform, &numbers, &numbers, [from; 3], to));
        let text = shader::SPATIAL_AXIS.to_owned();
        let pipeline = compute_pipeline(self.device, text, "onelight_along_axis", &[&layout]);
        AxisPipeline { layout, pipeline }
    }

    fn full(&self) -> TextureView {
        self.texture(self.size, TextureFormat::Rgba32Float)
    }

    fn texture(&self, [width, height]: [u32; 2], format: TextureFormat) -> TextureView {
        let texture = self.device.create_texture(&TextureDescriptor {
            label: Some("onelight step"),
            size: Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        texture.create_view(&TextureViewDescriptor::default())
    }

    fn uniform(&self, bytes: &[u8]) -> Buffer {
        self.buffer(bytes, BufferUsages::UNIFORM)
    }

    fn numbers(&self, bytes: &[u8]) -> Buffer {
        self.buffer(bytes, BufferUsages::STORAGE)
    }

    fn buffer(&self, bytes: &[u8], usage: BufferUsages) -> Buffer {
        let buffer = self.device.create_buffer(&BufferDescriptor {
            label: Some("onelight step"),
            size: bytes.len().next_multiple_of(16) as u64,
            usage: usage | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }
}

/// What every map along an axis runs.
struct AxisPipeline {
    layout: BindGroupLayout,
    pipeline: ComputePipeline,
}

fn axis_slots<'a>(
    uniform: &'a Buffer,
    first: &'a Buffer,
    weights: &'a Buffer,
    [from, own, base]: [&'a TextureView; 3],
    to: &'a TextureView,
) -> [Slot<'a>; 7] {
    [
        Slot::Uniform(uniform),
        Slot::Numbers(first),
        Slot::Numbers(weights),
        Slot::Floats(from),
        Slot::Floats(own),
        Slot::Floats(base),
        Slot::Written(to, TextureFormat::Rgba32Float),
    ]
}

/// Three layers as the shaders' four words.
fn four([red, green, blue]: [f32; 3]) -> [u32; 4] {
    [red, green, blue, 0.0].map(f32::to_bits)
}

fn words(words: impl IntoIterator<Item = u32>) -> Vec<u8> {
    words.into_iter().flat_map(u32::to_ne_bytes).collect()
}

#[cfg(all(test, feature = "native"))]
mod tests;
