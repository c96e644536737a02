//! Develops an OpenEXR picture of any size in the memory of a band: `cargo run --example develop_in_bands [-- shot.exr]`.

use onelight::lut::{Channels, PixelMap, PixelsMut};
use onelight_picture::{Limits, PngSettings, open, write_png};
use std::{env, error::Error, fs::File, io::BufWriter, path::Path, process::ExitCode};

fn main() -> ExitCode {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/scene/scene.exr");
    let given = env::args_os().nth(1).map(|input| (input.clone().into(), Path::new(&input).with_extension("film.png")));
    let (input, output) = given.unwrap_or_else(|| (scene, env::temp_dir().join("scene.film.png")));
    develop(&input, &output).inspect_err(|error| eprintln!("error: {error}")).map_or(1.into(), |()| 0.into())
}

fn develop(input: &Path, output: &Path) -> Result<(), Box<dyn Error>> {
    let form = onelight::Process::default().compile()?.direct(&Default::default())?;
    let file = File::open(input).map_err(|error| format!("{}: cannot be read: {error}", input.display()))?;
    let mut picture = open(file, &input.display().to_string(), Limits::default())?;
    let file = File::create(output).map_err(|error| format!("{}: cannot be written: {error}", output.display()))?;
    write_png(BufWriter::new(file), &picture.description().clone(), PngSettings::default(), &[], |sink| {
        while let Some(band) = picture.next_band()? {
            let size = [band.width(), band.rows()];
            form.map_in_place(&mut PixelsMut::new(band.rgb_mut().as_flattened_mut(), Channels::Rgb, size)?);
            sink.write(band.view())?;
        }
        Ok::<(), Box<dyn Error>>(())
    })?;
    println!("{}", output.display());
    Ok(())
}
