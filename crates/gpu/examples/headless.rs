//! Develops a picture on the GPU without a window and writes it: `cargo run --example headless [film.png [stock]]`.

mod scene;

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;

use onelight_gpu::{FilmPass, wgpu};
use pollster::block_on;
use wgpu::{BufferUsages, TextureUsages};

const SIZE: [u32; 2] = [960, 540];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "film.png".to_owned());
    let stock = arguments.next().unwrap_or_else(|| "kodak-5207".to_owned());
    let form = onelight::Process::for_camera(&stock)?.compile()?.direct(&Default::default())?;

    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = block_on(adapter.request_device(&Default::default()))?;

    let film = FilmPass::new(&device, &queue, &form, wgpu::TextureFormat::Rgba8Unorm)?;
    let hdr = scene::texture(&device, &queue, SIZE[0], SIZE[1]);
    let display = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("display"),
        size: hdr.size(),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: film.target_format(),
        usage: film.target_usage() | TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    film.encode(&mut encoder, &hdr.create_view(&Default::default()), &display.create_view(&Default::default()))?;

    // Rows of 960 pixels are whole multiples of 256 bytes, as copies want them.
    let read = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read"),
        size: u64::from(4 * SIZE[0] * SIZE[1]),
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIZE[0]), rows_per_image: Some(SIZE[1]) };
    let to = wgpu::TexelCopyBufferInfo { buffer: &read, layout };
    encoder.copy_texture_to_buffer(display.as_image_copy(), to, display.size());
    queue.submit([encoder.finish()]);
    read.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;

    let mut png = png::Encoder::new(BufWriter::new(File::create(&path)?), SIZE[0], SIZE[1]);
    png.set_color(png::ColorType::Rgba);
    png.set_depth(png::BitDepth::Eight);
    png.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    png.write_header()?.write_image_data(&read.slice(..).get_mapped_range()?)?;
    println!("{path}: {stock} on {}", adapter.get_info().name);
    Ok(())
}
