//! The adapter, and the clock on it.

use onelight_gpu::{Headless, HeadlessSettings, wgpu};
use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoder, Device, DeviceType, Features, QuerySet, QuerySetDescriptor,
    QueryType, Queue,
};

use crate::error::{Error, Result};

/// Bytes of a buffer that is copied to learn the card's copy bandwidth: far more than its caches hold.
const COPIED_BYTES: u64 = 256 << 20;
const COPIES: u32 = 8;

/// A card that is measured.
pub(super) struct Card {
    pub(super) gpu: Headless,
    pub(super) name: String,
    pub(super) driver: String,
    pub(super) is_software: bool,
    clock: Clock,
}

/// Two points in time on the card.
struct Clock {
    points: QuerySet,
    resolved: Buffer,
    read: Buffer,
    ns_per_tick: f64,
}

impl Card {
    /// Opens the fastest adapter; software only where that is allowed.
    pub(super) fn open(allow_software: bool) -> Result<Self> {
        let gpu = Headless::open(&HeadlessSettings {
            required_features: Features::TIMESTAMP_QUERY | Features::TIMESTAMP_QUERY_INSIDE_ENCODERS,
            ..Default::default()
        })?;
        let info = gpu.adapter.get_info();
        let is_software = info.device_type == DeviceType::Cpu;
        if is_software && !allow_software {
            return Err(Error::new(format!(
                "adapter: found {}, which is software, expected a graphics card (or --software to try the command)",
                info.name
            )));
        }
        let clock = Clock::new(&gpu.device, &gpu.queue);
        let driver = format!("{} {}", info.driver, info.driver_info).trim().to_owned();
        Ok(Self { gpu, name: info.name, driver, is_software, clock })
    }

    /// Milliseconds on the card that it takes what is encoded.
    pub(super) fn time(&self, encode: impl FnOnce(&mut CommandEncoder) -> Result<()>) -> Result<f64> {
        let Clock { points, resolved, read, ns_per_tick } = &self.clock;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        encoder.write_timestamp(points, 0);
        encode(&mut encoder)?;
        encoder.write_timestamp(points, 1);
        encoder.resolve_query_set(points, 0..2, resolved, 0);
        encoder.copy_buffer_to_buffer(resolved, 0, read, 0, 16);
        self.gpu.queue.submit([encoder.finish()]);
        let ticks = self.gpu.read_buffer(read)?;
        let tick = |i: usize| ticks.get(8 * i..8 * i + 8).and_then(|b| b.try_into().ok()).map_or(0, u64::from_ne_bytes);
        Ok(tick(1).saturating_sub(tick(0)) as f64 * ns_per_tick / 1e6)
    }

    /// Bytes read and written in a second by the card's own copy of buffers.
    pub(super) fn copy_bandwidth(&self) -> Result<f64> {
        let bytes = if self.is_software { COPIED_BYTES / 16 } else { COPIED_BYTES };
        let usage = BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let buffer = || {
            let descriptor = BufferDescriptor { label: None, size: bytes, usage, mapped_at_creation: false };
            self.gpu.device.create_buffer(&descriptor)
        };
        let [from, to] = [buffer(), buffer()];
        let copy = |encoder: &mut CommandEncoder| {
            for _ in 0..COPIES {
                encoder.copy_buffer_to_buffer(&from, 0, &to, 0, bytes);
            }
            Ok(())
        };
        let mut least = self.time(copy)?;
        for _ in 0..4 {
            least = least.min(self.time(copy)?);
        }
        Ok(2.0 * bytes as f64 * f64::from(COPIES) / (least * 1e-3))
    }
}

impl Clock {
    fn new(device: &Device, queue: &Queue) -> Self {
        let points = device.create_query_set(&QuerySetDescriptor { label: None, ty: QueryType::Timestamp, count: 2 });
        let buffer =
            |usage| device.create_buffer(&BufferDescriptor { label: None, size: 16, usage, mapped_at_creation: false });
        Self {
            points,
            resolved: buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
            read: buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST),
            ns_per_tick: f64::from(queue.get_timestamp_period()),
        }
    }
}
