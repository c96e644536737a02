//! The device that the tests share.

use std::io::{self, Write as _};
use std::sync::OnceLock;

use pollster::block_on;
use wgpu::{Adapter, Device, DeviceDescriptor, Features, Instance, InstanceDescriptor, Limits, Queue};

pub(crate) struct Gpu {
    pub(crate) device: Device,
    pub(crate) queue: Queue,
    pub(crate) name: String,
}

/// The device, or None where there is none and none is demanded.
pub(crate) fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    let said = || {
        let gpu = open();
        // Not by a macro, whose output a test that passes keeps to itself.
        let found = gpu.as_ref().map_or("tests on a GPU were skipped: found no adapter", |gpu| &gpu.name);
        let mut stderr = io::stderr();
        writeln!(stderr, "{found}").unwrap();
        gpu
    };
    GPU.get_or_init(said).as_ref()
}

fn open() -> Option<Gpu> {
    let demanded = std::env::var("ONELIGHT_REQUIRE_GPU").ok();
    let word = demanded.as_deref().filter(|word| *word != "1").unwrap_or_default().to_lowercase();
    let instance = Instance::new(InstanceDescriptor::new_without_display_handle());
    let adapters = block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let names: Vec<_> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let Some(adapter) = adapters.iter().zip(&names).find(|(_, name)| name.to_lowercase().contains(&word)) else {
        assert!(demanded.is_none(), "adapter: found {names:?}, expected one with {word:?} in its name");
        return None;
    };
    Some(device(adapter.0, adapter.1))
}

fn device(adapter: &Adapter, name: &str) -> Gpu {
    let wanted = Features::FLOAT32_FILTERABLE;
    let max_texture_dimension_2d = adapter.limits().max_texture_dimension_2d;
    let descriptor = DeviceDescriptor {
        required_features: adapter.features() & wanted,
        required_limits: Limits { max_texture_dimension_2d, ..Limits::default() },
        ..Default::default()
    };
    let (device, queue) = block_on(adapter.request_device(&descriptor)).unwrap();
    Gpu { device, queue, name: name.to_owned() }
}

/// Another device on the same adapter, whose counters no other test moves.
pub(crate) fn another() -> Option<Gpu> {
    gpu().and_then(|_| open())
}
