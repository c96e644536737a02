//! What is read and written: pairs of pictures, more than caches hold.

use std::sync::atomic::{AtomicUsize, Ordering};

use onelight_gpu::wgpu;
use rayon::prelude::*;
use wgpu::{
    Extent3d, TexelCopyBufferLayout, Texture, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages,
    TextureView,
};

use super::card::Card;
use crate::error::Result;

/// Pairs of pictures that passes take turns over.
const PAIRS: usize = 6;
/// The scene that is scaled up to the pictures.
const SCENE: (usize, usize) = (480, 270);

/// Pictures of one size and format to read.
pub(super) struct Sources {
    pub(super) format: TextureFormat,
    pub(super) size: [u32; 2],
    views: Vec<TextureView>,
}

/// Pictures of one size and format to write.
pub(super) struct Targets {
    views: Vec<TextureView>,
    turn: AtomicUsize,
}

impl Sources {
    /// The fixture scene at six exposures a third of a stop apart, with some grain: neighbours differ, as in a frame.
    pub(super) fn new(card: &Card, scene: &[[f32; 3]], format: TextureFormat, size: [u32; 2]) -> Self {
        let views = (0..PAIRS).map(|pair| {
            let texture = texture(card, format, size, TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST);
            let bytes = bytes(scene, format, size, pair);
            let layout = TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some((bytes.len() / size[1] as usize) as u32),
                rows_per_image: Some(size[1]),
            };
            card.gpu.queue.write_texture(texture.as_image_copy(), &bytes, layout, texture.size());
            texture.create_view(&Default::default())
        });
        Self { format, size, views: views.collect() }
    }
}

impl Targets {
    pub(super) fn new(card: &Card, format: TextureFormat, size: [u32; 2], usage: TextureUsages) -> Self {
        let views = (0..PAIRS).map(|_| texture(card, format, size, usage).create_view(&Default::default()));
        Self { views: views.collect(), turn: AtomicUsize::new(0) }
    }

    /// The next pair of pictures to read and to write, in turns over all.
    pub(super) fn next<'a>(&'a self, sources: &'a Sources) -> (&'a TextureView, &'a TextureView) {
        let turn = self.turn.fetch_add(1, Ordering::Relaxed) % PAIRS;
        (&sources.views[turn], &self.views[turn])
    }
}

/// The scene that all pictures are made of.
pub(super) fn scene() -> Result<Vec<[f32; 3]>> {
    Ok(onelight_fixtures::scene_rgb(SCENE)?)
}

pub(super) fn texture(card: &Card, format: TextureFormat, size: [u32; 2], usage: TextureUsages) -> Texture {
    card.gpu.device.create_texture(&TextureDescriptor {
        label: None,
        size: Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

fn bytes(scene: &[[f32; 3]], format: TextureFormat, [width, height]: [u32; 2], pair: usize) -> Vec<u8> {
    let gain = ((pair as f32 - 2.5) / 3.0).exp2();
    let pixel = |i: u32| {
        let (x, y) = (i % width, i / width);
        let [u, v] = [x as usize * SCENE.0 / width as usize, y as usize * SCENE.1 / height as usize];
        let noise = (i.wrapping_add(pair as u32).wrapping_mul(0x9e37_79b9) >> 16) as f32 / 65536.0 - 0.5;
        let [r, g, b] = scene[v * SCENE.0 + u].map(|v| v * gain * (1.0 + 0.04 * noise));
        [r, g, b, 1.0]
    };
    let channels = (0..width * height).into_par_iter().flat_map_iter(pixel);
    match format {
        TextureFormat::Rgba16Float => channels.flat_map_iter(|v| half::f16::from_f32(v).to_ne_bytes()).collect(),
        _ => channels.flat_map_iter(f32::to_ne_bytes).collect(),
    }
}
