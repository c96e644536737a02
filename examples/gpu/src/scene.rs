//! A stand-in for a renderer: scene-linear light over 14 stops, hues above, greys below.

use onelight_gpu::wgpu::{
    Device, Extent3d, Queue, TexelCopyBufferLayout, Texture, TextureDescriptor, TextureDimension, TextureFormat,
    TextureUsages,
};

/// Stops about mid grey from the left edge to the right.
const STOPS: [f32; 2] = [-7.0, 7.0];
/// Part of the height that hues take.
const HUES: f32 = 0.8;

/// Scene-linear RGB at a place of the picture; both coordinates go from 0 to 1, from the top left corner.
fn light(x: f32, y: f32) -> [f32; 3] {
    let level = 0.18 * (STOPS[0] + (STOPS[1] - STOPS[0]) * x).exp2();
    if y > HUES {
        // A continuous wedge above steps of a stop.
        let stepped = 0.18 * (STOPS[0] + ((STOPS[1] - STOPS[0]) * x).floor()).exp2();
        return [if y > (1.0 + HUES) / 2.0 { stepped } else { level }; 3];
    }
    let hue = 6.0 * y / HUES;
    let channel = |shift: f32| ((hue + shift).rem_euclid(6.0) - 3.0).abs() - 1.0;
    [0.0, 4.0, 2.0].map(|shift| level * (0.05 + 0.95 * channel(shift).clamp(0.0, 1.0)))
}

/// The picture's pixels as half floats, red, green, blue, alpha, row by row: the bytes of a texture of `Rgba16Float`.
pub fn bytes([width, height]: [u32; 2]) -> Vec<u8> {
    let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let pixels = places.map(|[x, y]| light((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32));
    pixels.flat_map(|[r, g, b]| [r, g, b, 1.0]).flat_map(|v| half::f16::from_f32(v).to_ne_bytes()).collect()
}

/// The picture as a texture of `Rgba16Float` that a pass can read.
pub fn texture(device: &Device, queue: &Queue, size: [u32; 2]) -> Texture {
    let [width, height] = size;
    let extent = Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&TextureDescriptor {
        label: Some("scene"),
        size: extent,
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format: TextureFormat::Rgba16Float,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let layout = TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(8 * width), rows_per_image: Some(height) };
    queue.write_texture(texture.as_image_copy(), &bytes(size), layout, extent);
    texture
}
