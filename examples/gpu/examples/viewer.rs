//! A window whose frame is developed on film: `cargo run -p onelight-gpu-examples --features window --example viewer`.
//!
//! Up and down change the exposure by a third of a stop, left and right the film. `g`, `s` and `h` turn grain, sharpness and halation on and
//! off, `n` takes the antihalation layer away, `f` goes through the formats of film. `w` changes what a viewer takes for white, `a` what grey
//! is aimed at; `r`, `t` and `b` give the printer's red, green and blue light a point more, with shift one less. The title says what is on.
//! Escape ends.

use std::error::Error;
use std::process::ExitCode;
use std::sync::Arc;

use onelight_gpu::wgpu;
use onelight_gpu_examples::live_frame::LiveFrame;
use onelight_gpu_examples::live_look::{Change, LiveLook};
use onelight_gpu_examples::scene;
use pollster::block_on;
use wgpu::{CurrentSurfaceTexture, Device, Queue, Surface, SurfaceConfiguration, Texture, TextureViewDescriptor};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop, OwnedDisplayHandle};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

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
    let event_loop = EventLoop::new()?;
    let display = event_loop.owned_display_handle();
    let mut viewer = Viewer { display, look: LiveLook::new()?, frame: None, done: Ok(()) };
    event_loop.run_app(&mut viewer)?;
    viewer.done
}

struct Viewer {
    display: OwnedDisplayHandle,
    look: LiveLook,
    frame: Option<Frame>,
    /// What ended the program, if not the user.
    done: Result<(), Box<dyn Error>>,
}

/// A window with its surface, and the pass that draws into it.
struct Frame {
    window: Arc<Window>,
    surface: Surface<'static>,
    configuration: SurfaceConfiguration,
    device: Device,
    queue: Queue,
    hdr: Texture,
    film: LiveFrame,
}

impl Viewer {
    fn open(&self, event_loop: &ActiveEventLoop) -> Result<Frame, Box<dyn Error>> {
        let attributes = Window::default_attributes().with_inner_size(LogicalSize::new(960, 540));
        let window = Arc::new(event_loop.create_window(attributes)?);
        let descriptor = wgpu::InstanceDescriptor::new_with_display_handle(Box::new(self.display.clone()));
        let instance = wgpu::Instance::new(descriptor);
        let surface = instance.create_surface(window.clone())?;
        let options = wgpu::RequestAdapterOptions { compatible_surface: Some(&surface), ..Default::default() };
        let adapter = block_on(instance.request_adapter(&options))?;
        let (device, queue) = block_on(adapter.request_device(&Default::default()))?;
        let size = window.inner_size();
        let mut configuration = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or("the window's surface cannot be drawn to by this adapter")?;
        // What is written is coded for the display already.
        configuration.view_formats = vec![configuration.format.remove_srgb_suffix()];
        surface.configure(&device, &configuration);
        let size = [configuration.width, configuration.height];
        let hdr = scene::texture(&device, &queue, size);
        let film = LiveFrame::new(&device, &queue, &self.look, size, configuration.view_formats[0])?;
        Ok(Frame { window, surface, configuration, device, queue, hdr, film })
    }

    /// Says what is on, and draws it.
    fn show(&self) {
        if let Some(frame) = &self.frame {
            frame.window.set_title(&self.look.title());
            frame.window.request_redraw();
        }
    }

    fn key(&mut self, event_loop: &ActiveEventLoop, key: &Key) -> Result<(), Box<dyn Error>> {
        let change = match key {
            Key::Named(NamedKey::Escape) => {
                event_loop.exit();
                None
            }
            Key::Named(NamedKey::ArrowUp) => Some(Change::Exposure(1)),
            Key::Named(NamedKey::ArrowDown) => Some(Change::Exposure(-1)),
            Key::Named(NamedKey::ArrowRight) => Some(Change::Stock(1)),
            Key::Named(NamedKey::ArrowLeft) => Some(Change::Stock(-1)),
            Key::Character(letters) => letters.chars().next().and_then(Change::of_letter),
            _ => None,
        };
        let (Some(change), Some(frame)) = (change, &mut self.frame) else { return Ok(()) };
        match self.look.change(change) {
            Ok(()) => frame.film.follow(&frame.device, &frame.queue, &self.look, change)?,
            // No printer reaches it: the look stays.
            Err(error) => eprintln!("{error}"),
        }
        self.show();
        Ok(())
    }
}

impl Viewer {
    fn end_on_error(&mut self, event_loop: &ActiveEventLoop, done: Result<(), Box<dyn Error>>) {
        if done.is_err() {
            self.done = done;
            event_loop.exit();
        }
    }
}

impl Frame {
    fn resize(&mut self, look: &LiveLook, width: u32, height: u32) -> Result<(), Box<dyn Error>> {
        (self.configuration.width, self.configuration.height) = (width.max(1), height.max(1));
        self.surface.configure(&self.device, &self.configuration);
        let size = [self.configuration.width, self.configuration.height];
        self.hdr = scene::texture(&self.device, &self.queue, size);
        self.film = LiveFrame::new(&self.device, &self.queue, look, size, self.configuration.view_formats[0])?;
        self.window.request_redraw();
        Ok(())
    }

    fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        let shown = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            CurrentSurfaceTexture::Outdated | CurrentSurfaceTexture::Lost => {
                self.surface.configure(&self.device, &self.configuration);
                self.window.request_redraw();
                return Ok(());
            }
            _ => return Ok(()),
        };
        let format = self.configuration.view_formats.first().copied();
        let view = shown.texture.create_view(&TextureViewDescriptor { format, ..Default::default() });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let hdr = self.hdr.create_view(&Default::default());
        self.film.draw(&self.device, &self.queue, &mut encoder, &hdr, &view)?;
        // An interface would be drawn here, over the film.
        self.queue.submit([encoder.finish()]);
        self.queue.present(shown);
        Ok(())
    }
}

impl ApplicationHandler for Viewer {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let opened = self.open(event_loop).map(|frame| self.frame = Some(frame));
        self.show();
        self.end_on_error(event_loop, opened);
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let done = match (event, &mut self.frame) {
            (WindowEvent::CloseRequested, _) => {
                event_loop.exit();
                Ok(())
            }
            (WindowEvent::Resized(size), Some(frame)) => frame.resize(&self.look, size.width, size.height),
            (WindowEvent::RedrawRequested, Some(frame)) => {
                if self.look.moves() {
                    frame.window.request_redraw();
                }
                frame.draw()
            }
            (
                WindowEvent::KeyboardInput {
                    event: KeyEvent { logical_key, state: ElementState::Pressed, .. }, ..
                },
                _,
            ) => self.key(event_loop, &logical_key),
            _ => Ok(()),
        };
        self.end_on_error(event_loop, done);
    }
}
