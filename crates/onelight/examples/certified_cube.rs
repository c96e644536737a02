//! A .cube file as a build script makes it, refused if it lies too far from the film.

use std::{env, fs::File, path::PathBuf};

use onelight::{Process, baked::Recipe};

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let look = Process::for_camera("kodak-5207")?.look()?;
    let baked = look.baked(&Recipe::cube(33))?;
    let report = look.certify(&baked, &Default::default())?;
    let mean = report.srgb.overall.mean;
    if mean > 0.1 {
        return Err(format!("{}: mean difference {mean:.3}, expected at most 0.1", baked.describe()).into());
    }
    let path = env::args_os().nth(1).map_or_else(|| env::temp_dir().join("look.cube"), PathBuf::from);
    baked.with_report(&report).write_cube(File::create(&path).map_err(|e| format!("{}: {e}", path.display()))?)?;
    print!("{}\n{report}", path.display());
    Ok(())
}

fn main() {
    if let Err(error) = run() {
        eprintln!("error: {error}");
        std::process::exit(1);
    }
}
