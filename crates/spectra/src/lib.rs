//! Light and colour for film simulation: what a scene emits, what an eye and a display make of it.
//!
//! - [`SpectralDistribution`]: a quantity over wavelength whose meaning is in its type
//! - [`Observer`], [`illuminant()`], [`black_body`]: the CIE 1931 eye and the lights
//! - [`RgbSpace`], [`TransferCurve`]: displays and working spaces, with any white
//! - [`SceneCurve`], [`CodedSpace`]: the codings of cameras and grading programs
//! - [`SceneWhite`], [`chromatic_adaptation`]: light that is to look white
//! - [`BufferFormat`]: what a low-precision frame buffer keeps of a picture
//! - [`Basis`]: a spectrum for an RGB value ([`Reconstruction`] says which)
//! - [`lux_to_w_per_m2`], [`lamp_rgb_w_per_m2`]: photometric to radiometric quantities
//! - [`DisplayDifference`]: CIEDE2000 between two pictures (feature `ciede2000`, on by default)
//! - [`TablePoints`], [`Pchip`]: measured curves, linear or monotone cubic between their points
//!
//! ```
//! use onelight_spectra::{Basis, Observer, Reconstruction, SpectralShape};
//!
//! // The light of a scene value (0.18, 0.1, 0.02), and the colour an eye sees in it.
//! let basis = Basis::new(Reconstruction::Smooth)?;
//! let light = basis.spectrum([0.18, 0.1, 0.02]);
//! let [red, _, blue] = basis.rgb_of(&light);
//! assert!((red - 0.18).abs() < 1e-9 && (blue - 0.02).abs() < 1e-9);
//! # Ok::<(), onelight_spectra::Error>(())
//! ```
//!
//! # Which RGB
//! Three kinds of RGB meet in a picture's way:
//!
//! - scene-linear: light of the scene, a grey card at [`MID_GREY`], no upper end. [`Basis`] takes it, about the 6500 K white.
//! - display-linear: light of a screen, whose white is 1: [`DisplayLinear`], which [`DisplayDifference`] takes.
//! - coded: what files and cables carry. [`CodedSpace`], [`SceneCurve`] and [`TransferCurve`] `encode` linear values and `decode`
//!   coded ones.
//!
//! What comes in is scene-linear everywhere, what goes out is coded or [`DisplayLinear`]; the first and the second are `[f64; 3]`, and
//! names say which.
//!
//! # Out of scope
//! Film, printers, look-up tables and pictures; colour appearance; fluorescence.
//! Keys in square brackets are resolved in REFERENCES.md at the top of the repository.

mod blackbody;
mod buffer;
mod built_in;
mod color_checker;
#[cfg(feature = "ciede2000")]
mod difference;
mod display_linear;
mod distribution;
mod error;
mod illuminant;
mod linear;
mod observer;
mod pchip;
mod photometry;
mod reconstruction;
mod rgb;
mod scene_value;
mod scene_white;
mod shape;
mod tabulated;
mod transfer;

pub use blackbody::{Kelvin, black_body, planck_radiance};
pub use buffer::BufferFormat;
pub use color_checker::{Patch, color_checker};
#[cfg(feature = "ciede2000")]
pub use difference::{DisplayDifference, ciede2000};
pub use display_linear::DisplayLinear;
pub use distribution::{Light, Quantity, SpectralDistribution, quantity};
pub use error::Error;
pub use illuminant::{Illuminant, illuminant, xenon_lamp};
pub use nalgebra;
pub use observer::Observer;
pub use pchip::Pchip;
pub use photometry::{LUMENS_PER_WATT_555_NM, lamp_rgb_w_per_m2, lumen_to_w, lux_to_w_per_m2, white_lumens_per_watt};
pub use reconstruction::{Basis, Reconstruction};
pub use rgb::{Chromaticity, RgbSpace};
pub use scene_value::{MID_GREY, SCENE_MAX, finite};
pub use scene_white::{SceneWhite, chromatic_adaptation};
pub use shape::SpectralShape;
pub use tabulated::{Extrapolation, TablePoints};
pub use transfer::{CameraLog, CodedSpace, DisplayCoding, HDR_WHITE_CD_M2, SceneCurve, TransferCurve};

/// The examples of README.md, compiled and run with the tests.
#[cfg(all(doctest, feature = "ciede2000"))]
#[doc = include_str!("../README.md")]
struct Readme;
