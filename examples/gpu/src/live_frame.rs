//! A look as the pass of a frame: anew where its resources change, an upload where they do not.

use std::error::Error;

use onelight_gpu::wgpu::{
    CommandEncoder, Device, Extent3d, LoadOp, Operations, Queue, RenderPassColorAttachment, RenderPassDescriptor,
    StoreOp, Texture, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView,
    util::TextureBlitter,
};
use onelight_gpu::{FilmPass, SpatialPass};

use crate::live_look::{Change, LiveLook};

/// Draws a picture of one size as a [`LiveLook`] has it.
///
/// Colours alone are drawn straight into the frame. With effects the picture is developed into a texture of its own, since a surface can
/// seldom be written by compute, and copied.
pub struct LiveFrame {
    size: [u32; 2],
    film: FilmPass,
    effects: Option<OnFilm>,
    number: u32,
}

/// A pass with effects, and what it writes to.
struct OnFilm {
    pass: SpatialPass,
    shown: Texture,
    blitter: TextureBlitter,
}

impl LiveFrame {
    /// For pictures of this size and targets of this format, one without `Srgb`: what is written is coded for the display already.
    ///
    /// # Errors
    /// If a pass cannot be made: the device does not compute, say.
    pub fn new(
        device: &Device,
        queue: &Queue,
        look: &LiveLook,
        size: [u32; 2],
        target: TextureFormat,
    ) -> Result<Self, Box<dyn Error>> {
        let film = FilmPass::new(device, queue, &look.form()?, target)?;
        Ok(Self { size, effects: OnFilm::new(device, queue, look, size, target)?, film, number: 0 })
    }

    /// Follows a change that the look has made: an upload where the stage stays, a new pass where it does not.
    ///
    /// # Errors
    /// As [`LiveFrame::new`].
    pub fn follow(
        &mut self,
        device: &Device,
        queue: &Queue,
        look: &LiveLook,
        change: Change,
    ) -> Result<(), Box<dyn Error>> {
        let form = look.form()?;
        self.film.upload(queue, &form)?;
        match (change, &self.effects) {
            (Change::Exposure(_), Some(effects)) => effects.pass.upload(queue, &form)?,
            (Change::Exposure(_), None) => {}
            _ => self.effects = OnFilm::new(device, queue, look, self.size, self.film.target_format())?,
        }
        Ok(())
    }

    /// Draws the next frame of the film: each has grain of its own.
    ///
    /// # Errors
    /// If the textures are of another size or kind.
    pub fn draw(
        &mut self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        hdr: &TextureView,
        target: &TextureView,
    ) -> Result<(), onelight_gpu::Error> {
        if let Some(OnFilm { pass, shown, blitter }) = &self.effects {
            pass.set_frame(queue, self.number);
            self.number = self.number.wrapping_add(1);
            let shown = shown.create_view(&Default::default());
            pass.encode(encoder, hdr, &shown)?;
            blitter.copy(device, encoder, &shown, target);
            return Ok(());
        }
        let attachment = RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: Operations { load: LoadOp::Clear(Default::default()), store: StoreOp::Store },
        };
        let mut pass = encoder
            .begin_render_pass(&RenderPassDescriptor { color_attachments: &[Some(attachment)], ..Default::default() });
        self.film.draw(&mut pass, hdr)
    }
}

impl OnFilm {
    fn new(
        device: &Device,
        queue: &Queue,
        look: &LiveLook,
        size: [u32; 2],
        target: TextureFormat,
    ) -> Result<Option<Self>, Box<dyn Error>> {
        let Some(stage) = look.stage(size)? else { return Ok(None) };
        let pass = SpatialPass::new(device, queue, &look.form()?, &stage, TextureFormat::Rgba8Unorm)?;
        let shown = device.create_texture(&TextureDescriptor {
            label: Some("developed"),
            size: Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: pass.target_format(),
            usage: pass.target_usage() | TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        Ok(Some(Self { pass, shown, blitter: TextureBlitter::new(device, target) }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{open, scene};

    const SIZE: [u32; 2] = [96, 54];

    /// Without effects the frame is that of the film pass; effects come and go with their keys, grain from frame to frame.
    #[test]
    fn keys_are_seen_in_the_frame() {
        let Some(gpu) = open().unwrap() else { return };
        let (device, queue, target) = (&gpu.device, &gpu.queue, TextureFormat::Bgra8Unorm);
        let hdr = scene::texture(device, queue, SIZE);
        let hdr = hdr.create_view(&Default::default());
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
        let mut look = LiveLook::new().unwrap();
        let mut frame = LiveFrame::new(device, queue, &look, SIZE, target).unwrap();
        let shown = |frame: &mut LiveFrame| {
            let texture = gpu.texture(SIZE, target, usage).unwrap();
            let mut encoder = device.create_command_encoder(&Default::default());
            frame.draw(device, queue, &mut encoder, &hdr, &texture.create_view(&Default::default())).unwrap();
            queue.submit([encoder.finish()]);
            gpu.read_back(&texture).unwrap()
        };
        let plain = shown(&mut frame);
        assert_eq!(plain, shown(&mut frame), "no grain, no change");
        let mut press = |frame: &mut LiveFrame, change: Change| {
            look.change(change).unwrap();
            frame.follow(device, queue, &look, change).unwrap();
        };
        press(&mut frame, Change::Grain);
        let grainy = shown(&mut frame);
        assert!(grainy != plain && grainy != shown(&mut frame), "frames have grain of their own");
        let mean = |bytes: &[u8]| bytes.iter().map(|v| f64::from(*v)).sum::<f64>() / bytes.len() as f64;
        assert!((mean(&grainy) - mean(&plain)).abs() < 2.0, "{} {}", mean(&grainy), mean(&plain));
        press(&mut frame, Change::Exposure(3));
        assert!(mean(&shown(&mut frame)) > mean(&grainy) + 5.0, "a stop brighter");
        press(&mut frame, Change::Exposure(-3));
        press(&mut frame, Change::Grain);
        assert_eq!(shown(&mut frame), plain);
        press(&mut frame, Change::Halation);
        press(&mut frame, Change::Antihalation);
        assert!(shown(&mut frame) != plain);
    }
}
