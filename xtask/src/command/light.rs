use std::fmt::Write as _;

use anyhow::Result;
use clap::{ArgGroup, Args};
use onelight::film::{Camera, FrameBufferScale};
use onelight::spectra::{Kelvin, lamp_rgb_w_per_m2, white_lumens_per_watt};
use serde_json::json;

use crate::{Report, exposure};

/// A lamp as physics gives it, and what becomes of it: steps 1 and 2 of the talk.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("amount").required(true).args(["lux", "lumen"]))]
pub(crate) struct Arguments {
    /// Illuminance in lux
    #[arg(long, value_name = "LUX", value_parser = amount)]
    lux: Option<f64>,
    /// Luminous flux in lumen
    #[arg(long, value_name = "LUMEN", value_parser = amount)]
    lumen: Option<f64>,
    /// Colour of the lamp as the temperature of a black body
    #[arg(long, default_value_t = 6500.0, value_name = "KELVIN")]
    kelvin: f64,
    /// Shutter time in s, such as 1/60
    #[arg(long, default_value = "1/60", value_name = "S", value_parser = exposure::seconds, conflicts_with = "lumen")]
    shutter: f64,
    /// F-number of the lens
    #[arg(long, default_value_t = 2.8, value_name = "N", conflicts_with = "lumen")]
    f_number: f64,
    /// Speed of the film
    #[arg(long, default_value_t = 100.0, value_name = "SPEED", conflicts_with = "lumen")]
    iso: f64,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

fn amount(text: &str) -> Result<f64, String> {
    let expected = || "expected a number from 0 to 1e12".to_owned();
    text.parse().ok().filter(|v| (0.0..=1e12).contains(v)).ok_or_else(expected)
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let Arguments { lux, lumen, kelvin, shutter, f_number, iso, json } = *arguments;
    let rgb = lamp_rgb_w_per_m2(Kelvin::new(kelvin)?, lux.or(lumen).unwrap_or_default())?;
    let [r, g, b] = rgb;
    let mut text = String::new();
    let Some(lux) = lux else {
        let lumen = lumen.unwrap_or_default();
        let _ = writeln!(text, "{lumen} lm of {kelvin} K: {r:.4}, {g:.4}, {b:.4} W (RGB, white is 6500 K)");
        let json_value = json!({ "lumen": lumen, "kelvin": kelvin, "rgb_w": [r, g, b] });
        return Ok(Report { text, json: json_value, as_json: json });
    };
    let camera = Camera::new(shutter, f_number)?;
    // F of the talk divides the exposure: the square of the f-number.
    let scale = FrameBufferScale::new(shutter, f_number * f_number, iso)?;
    let stored = [r, g, b].map(|v| scale.stored(v));
    let scene = camera.scene_value(lux, iso)?;
    let _ = writeln!(text, "{lux} lux of {kelvin} K: {r:.4}, {g:.4}, {b:.4} W/m^2 (RGB, white is 6500 K)");
    let _ = writeln!(text, "with {shutter:.5} s at f/{f_number}, ISO {iso}:");
    let [sr, sg, sb] = stored;
    let _ = writeln!(
        text,
        "  a white surface is stored as {sr:.4}, {sg:.4}, {sb:.4} mJ/m^2 per F per ISO 100 (factor {:.4})",
        scale.stored(1.0)
    );
    let _ = writeln!(text, "  the film gets {:.4} lux s", camera.focal_plane_exposure(lux / std::f64::consts::PI));
    let _ = writeln!(
        text,
        "  which is scene value {scene:.4}: {:+.2} stops from a white that is properly exposed",
        scene.log2()
    );
    let json_value = json!({
        "lux": lux, "kelvin": kelvin, "rgb_w_per_m2": [r, g, b],
        "stored_mj_per_m2_per_f_per_iso100": stored, "scale": scale.stored(1.0),
        "exposure_lux_s": camera.focal_plane_exposure(lux / std::f64::consts::PI), "scene_value": scene,
        "lumens_per_watt": white_lumens_per_watt(),
    });
    Ok(Report { text, json: json_value, as_json: json })
}
