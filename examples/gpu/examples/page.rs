//! Writes a WebGPU page that needs nothing else: `cargo run -p onelight-gpu-examples --example page [film.html [stock]]`.
//!
//! The page's own shader calls `onelight_develop`; the look comes as bytes.

use std::error::Error;
use std::process::ExitCode;

use onelight_gpu::{CURVE_ROWS, FormKind, LookBytes, LookSettings, MAX_POINTS, wgsl};
use serde_json::json;

const PAGE: &str = include_str!("page.html");

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
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "film.html".to_owned());
    let stock = arguments.next().unwrap_or_else(|| "kodak-5207".to_owned());
    let form = onelight::Process::for_camera(&stock)?.compile()?.direct(&Default::default())?;
    let settings = LookSettings::default();
    let look = LookBytes::new(&form, settings.storage)?;
    let curves = look
        .curves
        .iter()
        .map(|curves| json!({ "row": curves.row, "points": curves.points, "bytes": base64(&curves.bytes) }));
    let bytes = json!({
        "uniform": base64(&look.uniform),
        "curves": curves.collect::<Vec<_>>(),
        "width": MAX_POINTS,
        "rows": CURVE_ROWS,
    });
    let shader = json!(wgsl(FormKind::Direct, &settings));
    let page = PAGE
        .replace("LOOK_BYTES", &bytes.to_string())
        .replace("LOOK_WGSL", &shader.to_string())
        .replace("LOOK_NAME", &stock);
    std::fs::write(&path, page)?;
    println!("{path}: {stock}");
    Ok(())
}

/// Six bits a letter, as a page's `atob` reads them.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let quad = |three: &[u8]| -> [char; 4] {
        let word = (0..3).fold(0u32, |word, i| word << 8 | u32::from(three.get(i).copied().unwrap_or(0)));
        let letter = |i: usize| char::from(LETTERS[(word >> (18 - 6 * i) & 63) as usize]);
        std::array::from_fn(|i| if i <= three.len() { letter(i) } else { '=' })
    };
    bytes.chunks(3).flat_map(quad).collect()
}
