//! Film as the last pass of a frame of one's own: `cargo run -p onelight-gpu-examples --example frame`.

use onelight::Process;
use onelight_gpu::wgpu::{TextureFormat::Rgba8Unorm, TextureUsages};
use onelight_gpu::{FilmPass, Headless};
use onelight_gpu_examples::{open, scene};

fn main() {
    if let Err(error) = open().map_err(Into::into).and_then(|gpu| gpu.map_or(Ok(()), |gpu| frames(&gpu))) {
        eprintln!("error: {error}");
        std::process::exit(1);
    }
}

fn frames(gpu: &Headless) -> Result<(), Box<dyn std::error::Error>> {
    let look = |stock| Process::for_camera(stock)?.compile()?.direct(&Default::default());
    let film = FilmPass::new(&gpu.device, &gpu.queue, &look("kodak-5207")?, Rgba8Unorm)?;
    let hdr = scene::texture(&gpu.device, &gpu.queue, [960, 540]); // the engine's scene-linear light
    let display = gpu.texture([960, 540], Rgba8Unorm, film.target_usage() | TextureUsages::COPY_SRC)?;
    for stock in ["kodak-5207", "kodak-5219"] {
        film.upload(&gpu.queue, &look(stock)?)?; // another stock: no pipeline, no wait
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        film.encode(&mut encoder, &hdr.create_view(&Default::default()), &display.create_view(&Default::default()))?;
        gpu.queue.submit([encoder.finish()]);
        let middle = 4 * (270 * 960 + 480);
        println!("{stock} on {}: the middle is {:?}", gpu.name(), &gpu.read_back(&display)?[middle..middle + 4]);
    }
    Ok(())
}
