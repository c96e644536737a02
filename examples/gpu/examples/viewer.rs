//! A window whose frame is developed on film: `cargo run -p onelight-gpu-examples --features window --example viewer`.
//!
//! Up and down change the exposure by a third of a stop, left and right the stock; each is an upload into the pass's
//! resources. Escape ends.

use std::error::Error;
use std::process::ExitCode;
use std::sync::Arc;

use onelight::DirectSettings;
use onelight_gpu::{FilmPass, wgpu};
use onelight_gpu_examples::scene;
use onelight_lut::DirectForm;
use pollster::block_on;
use wgpu::{CurrentSurfaceTexture, Device, Queue, Surface, SurfaceConfiguration, Texture};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop, OwnedDisplayHandle};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

const STOCKS: [&str; 5] = ["kodak-5207", "kodak-5219", "kodak-portra-400", "kodak-ektachrome-100", "fuji-velvia-50"];

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
    let forms = STOCKS.map(|stock| -> Result<DirectForm, onelight::Error> {
        onelight::Process::for_camera(stock)?.compile()?.direct(&DirectSettings::default())
    });
    let forms = forms.into_iter().collect::<Result<Vec<_>, _>>()?;
    let event_loop = EventLoop::new()?;
    let display = event_loop.owned_display_handle();
    let mut viewer = Viewer { display, forms, stock: 0, thirds: 0, frame: None, done: Ok(()) };
    event_loop.run_app(&mut viewer)?;
    viewer.done
}

struct Viewer {
    display: OwnedDisplayHandle,
    forms: Vec<DirectForm>,
    stock: usize,
    /// Exposure in thirds of a stop.
    thirds: i32,
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
    film: FilmPass,
}

impl Viewer {
    /// The stock in use, with the exposure in its first matrix.
    fn form(&self) -> Result<DirectForm, Box<dyn Error>> {
        let form = self.forms[self.stock].clone();
        let expose = form.parts().expose.brighter(self.thirds as f32 / 3.0);
        Ok(form.with_expose(expose)?)
    }

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
        let configuration = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or("the window's surface cannot be drawn to by this adapter")?;
        surface.configure(&device, &configuration);
        let hdr = scene::texture(&device, &queue, [configuration.width, configuration.height]);
        let film = FilmPass::new(&device, &queue, &self.form()?, configuration.format)?;
        Ok(Frame { window, surface, configuration, device, queue, hdr, film })
    }

    /// Shows the stock and exposure in use.
    fn change(&self) -> Result<(), Box<dyn Error>> {
        let Some(frame) = &self.frame else { return Ok(()) };
        frame.film.upload(&frame.queue, &self.form()?)?;
        let title = format!("{}  {:+.1} stops", STOCKS[self.stock], f64::from(self.thirds) / 3.0);
        frame.window.set_title(&title);
        frame.window.request_redraw();
        Ok(())
    }

    fn key(&mut self, event_loop: &ActiveEventLoop, key: &Key) -> Result<(), Box<dyn Error>> {
        let count = self.forms.len();
        match key {
            Key::Named(NamedKey::Escape) => event_loop.exit(),
            Key::Named(NamedKey::ArrowUp) => self.thirds += 1,
            Key::Named(NamedKey::ArrowDown) => self.thirds -= 1,
            Key::Named(NamedKey::ArrowRight) => self.stock = (self.stock + 1) % count,
            Key::Named(NamedKey::ArrowLeft) => self.stock = (self.stock + count - 1) % count,
            _ => return Ok(()),
        }
        self.change()
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
    fn resize(&mut self, width: u32, height: u32) {
        (self.configuration.width, self.configuration.height) = (width.max(1), height.max(1));
        self.surface.configure(&self.device, &self.configuration);
        self.hdr = scene::texture(&self.device, &self.queue, [self.configuration.width, self.configuration.height]);
        self.window.request_redraw();
    }

    fn show(&self) -> Result<(), Box<dyn Error>> {
        let shown = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            CurrentSurfaceTexture::Outdated | CurrentSurfaceTexture::Lost => {
                self.surface.configure(&self.device, &self.configuration);
                self.window.request_redraw();
                return Ok(());
            }
            _ => return Ok(()),
        };
        let view = shown.texture.create_view(&Default::default());
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations::default(),
                })],
                ..Default::default()
            });
            self.film.draw(&mut pass, &self.hdr.create_view(&Default::default()))?;
            // An interface would be drawn here, over the film.
        }
        self.queue.submit([encoder.finish()]);
        self.queue.present(shown);
        Ok(())
    }
}

impl ApplicationHandler for Viewer {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let opened = self.open(event_loop).map(|frame| self.frame = Some(frame));
        let opened = opened.and_then(|()| self.change());
        self.end_on_error(event_loop, opened);
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let done = match (event, &mut self.frame) {
            (WindowEvent::CloseRequested, _) => {
                event_loop.exit();
                Ok(())
            }
            (WindowEvent::Resized(size), Some(frame)) => {
                frame.resize(size.width, size.height);
                Ok(())
            }
            (WindowEvent::RedrawRequested, Some(frame)) => frame.show(),
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
