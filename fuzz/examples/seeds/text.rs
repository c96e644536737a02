//! Looks with every key and word, stocks of every kind with every key.

use onelight::film::{DyeModel, Matching, PrintCurves, Tail, WideGamut};
use onelight::printing::{Aim, HeatGlass, Infrared, PrinterLight, Projector, White};
use onelight::spectra::{Reconstruction, TransferCurve};
use onelight::{Approach, Process, Word, WorkingSpace};

use super::{Fault, Seed};

pub(super) fn looks() -> Vec<Seed> {
    let mut seeds = vec![
        ("all.toml".to_owned(), Process::default().to_toml().into_bytes()),
        (
            "numbers.toml".to_owned(),
            b"version = 1\nneutral_density = 0.9\noverexposure = -1.5\nbeam_density = [0.1, 0, 2]\n\
              points = [25, -1.0, 0]\ncalibration = \"3\"\nfilters = [\"70\", \"99\", \"98\"]\n"
                .to_vec(),
        ),
        (
            "first.toml".to_owned(),
            b"version = 1 # of the format\napproach = 'first'\n[first]\ncontrast = 1.2\nbrightness = 0.1\n\
              temperature = 5000\nsaturation = 0.9\ncurve = [[-6, 0.01], [0, 0.45], [4.5, 0.85]]\n"
                .to_vec(),
        ),
        ("reversal.toml".to_owned(), b"version = 1\ncamera = \"fuji-velvia-50\"\nprint = \"none\"\n".to_vec()),
        (
            "film.toml".to_owned(),
            b"version = 2\ninterimage = \"0.5,0.1\"\nwhite = \"lamp\"\ngamut = \"clip\"\nprint_curves = \"principal\"\n"
                .to_vec(),
        ),
        (
            "effects.toml".to_owned(),
            b"version = 2\nfilm_format = \"super16\"\ngrain = \"on\"\nsharpness = \"off\"\nhalation = \"auto\"\n\
              antihalation = \"0.4\"\nseed = 4294967295\n"
                .to_vec(),
        ),
        (
            "exposed.toml".to_owned(),
            b"version = 2\nev = -1.5\nscene_white = \"3200,10\"\noutput_space = \"dci-p3\"\noutput_coding = \"gamma26\"\n".to_vec(),
        ),
        (
            "print-alone.toml".to_owned(),
            b"version = 2\ncamera = \"none\"\nprint = \"kodak-2393\"\naim = \"sheet\"\npoints = [1, -2.5, 0]\n".to_vec(),
        ),
        (
            "white-luminance.toml".to_owned(),
            b"version = 2\noutput_space = \"rec2020\"\noutput_coding = \"pq\"\nwhite_luminance = 100\n".to_vec(),
        ),
        ("paper.toml".to_owned(), b"version = 2\ncamera = \"kodak-5222@9-min\"\nprint = \"kodak-polymax-fine-art\"\n".to_vec()),
        (
            "refused-idle-beams.toml".to_owned(),
            b"version = 2\nbeam_density = [0.1, 0, 2]\ncalibration = \"exact\"\n".to_vec(),
        ),
        ("refused-version.toml".to_owned(), b"version = 3\n".to_vec()),
        ("refused-newer-key.toml".to_owned(), b"version = 1\nwhite = \"film\"\n".to_vec()),
        ("refused-contradiction.toml".to_owned(), b"version = 1\napproach = \"clip\"\naim = \"sheet\"\n".to_vec()),
    ];
    fn words<T: Word>(seeds: &mut Vec<Seed>, version: u8) {
        seeds.extend(T::ALL.iter().map(|(_, word, _)| {
            (format!("{}-{word}.toml", T::KEY), format!("version = {version}\n{} = \"{word}\"\n", T::KEY).into_bytes())
        }));
    }
    words::<Approach>(&mut seeds, 1);
    words::<Aim>(&mut seeds, 1);
    words::<DyeModel>(&mut seeds, 1);
    words::<Matching>(&mut seeds, 1);
    // Only sheets with an axis in lux s can be absolute.
    if let Some((_, text)) = seeds.iter_mut().find(|(name, _)| name == "matching-absolute.toml") {
        text.extend(b"camera = \"kodak-5219\"\n");
    }
    words::<Reconstruction>(&mut seeds, 1);
    words::<PrinterLight>(&mut seeds, 1);
    words::<Infrared>(&mut seeds, 1);
    words::<HeatGlass>(&mut seeds, 1);
    words::<Tail>(&mut seeds, 1);
    words::<Projector>(&mut seeds, 1);
    words::<TransferCurve>(&mut seeds, 1);
    // Absolute light goes out in wide primaries.
    for word in ["pq", "hlg"] {
        let name = format!("output_coding-{word}.toml");
        if let Some((_, text)) = seeds.iter_mut().find(|(found, _)| *found == name) {
            text.extend(b"output_space = \"p3\"\n");
        }
    }
    words::<WideGamut>(&mut seeds, 2);
    words::<White>(&mut seeds, 2);
    words::<PrintCurves>(&mut seeds, 2);
    for end in ["input", "output"] {
        seeds.extend(WorkingSpace::ALL.iter().map(|(_, word, _)| {
            (format!("{end}_space-{word}.toml"), format!("version = 1\n{end}_space = \"{word}\"\n").into_bytes())
        }));
    }
    seeds
}

/// Built-in films under the id that the target expects, with every so many rows of their tables.
pub(super) fn stocks() -> Result<Vec<Seed>, Fault> {
    let mut seeds = Vec::new();
    for id in ["kodak-5207", "kodak-gold-200", "kodak-2383", "fuji-velvia-50"] {
        let files = onelight_stocks::find(id).ok_or("no such stock")?;
        let toml = files.stock_toml.replacen(&format!("id = \"{id}\""), "id = \"film\"", 1);
        let tables = [files.sensitivity_csv, files.characteristic_csv, files.dye_density_csv].map(thinned);
        let texts: Vec<&str> = std::iter::once(&toml).chain(&tables).map(|text| text.trim_end()).collect();
        seeds.push((id.to_owned(), format!("{}\n", texts.join("\n%\n")).into_bytes()));
    }
    Ok(seeds)
}

fn thinned(table: &str) -> String {
    const STEP: usize = 4;
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let head = lines.next().unwrap_or_default();
    let rows: Vec<&str> = lines.collect();
    let kept = rows.iter().enumerate().filter(|(i, _)| i % STEP == 0 || i + 1 == rows.len()).map(|(_, row)| *row);
    std::iter::once(head).chain(kept).collect::<Vec<_>>().join("\n")
}
