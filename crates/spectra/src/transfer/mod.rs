//! Curves between linear light and coded values: of displays in `display`, of cameras and grading programs in `scene`.

mod camera_curves;
mod camera_log;
mod display;
mod display_coding;
mod hdr;
mod makers;
mod scene;

pub use camera_log::CameraLog;
pub use display::TransferCurve;
pub use display_coding::DisplayCoding;
pub use hdr::HDR_WHITE_CD_M2;
pub use scene::{CodedSpace, SceneCurve};
