//! Develops a picture on the GPU without a window and writes it:
//! `cargo run -p onelight-gpu-examples --example headless [film.png [stock]]`.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::process::ExitCode;

use onelight_gpu::FilmPass;
use onelight_gpu::wgpu::TextureFormat::{Rgba8Unorm, Rgba16Float};
use onelight_gpu_examples::{open, scene};

const SIZE: [u32; 2] = [960, 540];

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "film.png".to_owned());
    let stock = arguments.next().unwrap_or_else(|| "kodak-5207".to_owned());
    let form = onelight::Process::for_camera(&stock)?.compile()?.direct(&Default::default())?;

    let Some(gpu) = open()? else { return Ok(()) };
    let film = FilmPass::new(&gpu.device, &gpu.queue, &form, Rgba8Unorm)?;
    let hdr = gpu.upload(SIZE, Rgba16Float, &scene::bytes(SIZE))?;
    let pixels = gpu.develop(&film, &hdr)?;

    let file = File::create(&path).map_err(|error| format!("{path}: cannot be written: {error}"))?;
    let mut png = png::Encoder::new(BufWriter::new(file), SIZE[0], SIZE[1]);
    png.set_color(png::ColorType::Rgba);
    png.set_depth(png::BitDepth::Eight);
    png.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    png.write_header()?.write_image_data(&pixels)?;
    println!("{path}: {stock} on {}", gpu.name());
    Ok(())
}
