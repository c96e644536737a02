use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use onelight::lut::Deviation;
use onelight::{Process, Reference};
use onelight_fixtures::{CAMERA_FILM, ExposedScene, layers, patches};
use onelight_picture::{Picture, Source};
use rayon::prelude::*;
use serde_json::json;

use crate::picture_file::write_exr;
use crate::progress::Clock;
use crate::{Report, folders};

/// Size of the scene, and of the copy that the repository holds.
const SIZE: (usize, usize) = (640, 360);
const SMALL: (usize, usize) = (160, 90);

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder to write to [default: target/onelight/fixtures]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the 160x90 copy that the repository holds, to fixtures/scene
    #[arg(long, conflicts_with = "out")]
    commit: bool,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let film = Process::for_camera(CAMERA_FILM)?.compile()?;
    let size = if arguments.commit { SMALL } else { SIZE };
    let scene = clock.time("render", || ExposedScene::render(size, &film))?;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None if arguments.commit => folders::make(&folders::workspace()?.join("fixtures/scene"))?,
        None => folders::output("fixtures")?,
    };
    let files = [folder.join("scene.exr"), folder.join(format!("exposure_{CAMERA_FILM}.exr"))];
    clock.time("write", || -> Result<()> {
        let of = |pixels: &[[f32; 3]]| {
            let pixels = if arguments.commit { in_half(pixels) } else { pixels.to_vec() };
            // The white is not D65, and no chromaticities say "exposure": a reader takes the default, sRGB.
            Picture::opaque(size.0, size.1, pixels, Source::Exr)
        };
        write_exr(&files[0], &of(&scene.rgb), &[("note", "sRGB primaries, white is the 6500 K black body")])?;
        let note = "R, G, B: exposure of the red, green and blue layer, matching vector included";
        write_exr(&files[1], &of(&scene.exposure), &[("note", note)])
    })?;
    let all: Vec<usize> = (0..scene.rgb.len()).collect();
    let cost = clock.time("compare", || cost_of_rgb(&film, &scene, &all))?;
    let patches = patches(size);
    let at = |(x, y): (usize, usize)| y * size.0 + x;
    let chart = cost_of_rgb(&film, &scene, &patches.color_checker.map(at))?;
    let grey = cost_of_rgb(&film, &scene, &[at(patches.grey_card)])?;
    let wedge = cost_of_rgb(&film, &scene, &patches.wedge.map(at))?;
    let Deviation { mean, p95, p99, max, .. } = cost;
    let shown = files.map(|file| folders::shown(&file));
    let mut text = String::new();
    let _ = writeln!(text, "{}   {}x{}, scene-linear", shown[0], size.0, size.1);
    let _ = writeln!(text, "{}   true exposures of its spectra", shown[1]);
    let _ = writeln!(
        text,
        "going through RGB instead of the true spectra, on {} (CIEDE2000 over all pixels):\n  \
         mean {mean:.2}, p95 {p95:.2}, p99 {p99:.2}, max {max:.2}\n  \
         ColorChecker mean {:.2}, max {:.2}; grey card {:.2}; step wedge max {:.2}",
        Process::default().name(),
        chart.mean,
        chart.max,
        grey.max,
        wedge.max
    );
    let _ = writeln!(text, "time: {}", clock.sentence());
    let json = json!({
        "files": shown,
        "size": [size.0, size.1],
        "cost_of_rgb": { "unit": "CIEDE2000", "mean": mean, "p95": p95, "p99": p99, "max": max,
            "color_checker": { "mean": chart.mean, "max": chart.max }, "grey_card": grey.max, "wedge_max": wedge.max },
        "seconds": clock.json(),
    });
    Ok(Report { text, json, as_json: arguments.json })
}

/// The picture of the true exposures against the picture of the RGB, at some pixels.
fn cost_of_rgb(film: &Reference, scene: &ExposedScene, pixels: &[usize]) -> Result<Deviation> {
    let difference = film.difference()?;
    let of = |&i: &usize| {
        let (rgb, exposure) = (scene.rgb[i].map(f64::from), layers(scene.exposure[i]));
        difference.between(film.develop_exposure(exposure), film.develop_linear(rgb))
    };
    let colours: Vec<[f64; 3]> = pixels.iter().map(|&i| scene.rgb[i].map(f64::from)).collect();
    Ok(Deviation::of(&colours, pixels.par_iter().map(of).collect())?)
}

/// Rounded to half precision, which packs three times as small: plenty for a copy that tests compare with.
fn in_half(pixels: &[[f32; 3]]) -> Vec<[f32; 3]> {
    pixels.iter().map(|rgb| rgb.map(|v| half::f16::from_f32(v).to_f32())).collect()
}

#[cfg(test)]
mod tests {
    use onelight_picture::Limits;

    use super::*;

    /// Half precision, and what another processor's rounding may add.
    const TOLERANCE: f32 = 2e-3;

    #[test]
    fn the_copy_in_the_repository_is_the_scene() {
        let film = Process::for_camera(CAMERA_FILM).unwrap().compile().unwrap();
        let scene = ExposedScene::render(SMALL, &film).unwrap();
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/scene");
        for (file, pixels) in [("scene.exr", scene.rgb), ("exposure_kodak-5207.exr", scene.exposure)] {
            let copy = std::fs::File::open(folder.join(file)).unwrap();
            let copy = Picture::read(copy, file, Limits::default()).unwrap();
            assert_eq!((copy.width, copy.height), SMALL);
            for (i, (a, b)) in copy.rgb.iter().flatten().zip(pixels.iter().flatten()).enumerate() {
                assert!(
                    (a - b).abs() <= TOLERANCE * b.abs() + 1e-6,
                    "{file}, value {i}: {a} in the copy, {b} rendered"
                );
            }
        }
    }
}
