//! Curves between linear light and coded values: of displays in `display`, of cameras and grading programs in `scene`.

mod camera_log;
mod display;
mod scene;

pub use camera_log::CameraLog;
pub use display::TransferCurve;
pub use scene::{CodedSpace, SceneCurve};
