//! A .cube file as a build script makes it, refused if it lies too far from the film:
//! `cargo run --example certified_cube --features formats [FILE]`.

use std::{env, fs::File, path::PathBuf, process::ExitCode};

use onelight::{Process, baked::Recipe};

/// CIEDE2000 in the mean over twenty stops.
const LIMIT: f64 = 0.1;

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let look = Process::for_camera("kodak-5207")?.look()?;
    let baked = look.baked(&Recipe::cube(33))?;
    let report = look.certify(&baked, &Default::default())?;
    let mean = report.srgb.overall.mean;
    if mean > LIMIT {
        return Err(format!("{}: mean difference {mean:.3}, expected at most {LIMIT}", baked.describe()).into());
    }
    let path = env::args_os().nth(1).map_or_else(|| env::temp_dir().join("look.cube"), PathBuf::from);
    baked.write_cube(File::create(&path).map_err(|e| format!("{}: {e}", path.display()))?)?;
    print!("{}\n{report}", path.display());
    Ok(())
}

fn main() -> ExitCode {
    let failed = |error| eprintln!("error: {error}");
    run().map_err(failed).map_or(ExitCode::FAILURE, |()| ExitCode::SUCCESS)
}
