//! How far the tables of looks lie from the film, as a table of all that is printed on what.

use std::fmt::Write as _;

use onelight::baked::{Form, Recipe};
use onelight::certify::Certifier;
use onelight::lut::{Certificate, SamplingLaw, Search, Storage};
use onelight::{FilmProcess, Process, WorkingSpace};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::error::Result;
use crate::progress::{OnProgress, Steps};

/// The structured table of each look, 32^3 in half floats, against the exact film on so many colours: as text and as JSON.
///
/// # Errors
/// If a look does not compile or cannot be baked.
pub fn certificates(looks: &[FilmProcess], colours: usize, tell: OnProgress<'_>) -> Result<(String, Value)> {
    let recipe = Recipe { storage: Storage::F16, ..Recipe::of(Form::Structured) };
    let law = SamplingLaw { count: colours, ..SamplingLaw::default() };
    let steps = Steps::new("certifying", looks.len() as u64, tell);
    let certify = |look: &FilmProcess| -> Result<(String, Certificate)> {
        let film = Process::from(look.clone()).look()?;
        let measure = Certifier::new(&film)?;
        let samples = measure.samples(&law, WorkingSpace::Srgb)?;
        let table = film.baked(&recipe)?;
        let found = measure.certify(&samples, |rgb| table.apply(rgb), Search::SamplesOnly)?;
        steps.step();
        Ok((film.name().to_owned(), found))
    };
    let found: Vec<(String, Certificate)> = looks.par_iter().map(certify).collect::<Result<_>>()?;
    let mut text = format!(
        "CIEDE2000 of the structured table, 32^3 in half floats, from the exact film: {colours} sRGB colours from -10 to +10 stops\n\
         | films | mean | 99 % below | largest |\n|---|---|---|---|\n"
    );
    for (name, Certificate { overall, max_found, .. }) in &found {
        let _ = writeln!(
            text,
            "| {} | {:.3} | {:.3} | {max_found:.2} |",
            name.replace('_', " on "),
            overall.mean,
            overall.p99
        );
    }
    text += &by_print(&found);
    let largest = found.iter().map(|(_, certificate)| certificate.max_found).fold(0.0, f64::max);
    let _ = writeln!(text, "{} looks, none further off than {largest:.2}", found.len());
    let rows = found.iter().map(|(name, certificate)| json!({ "films": name, "certificate": certificate }));
    Ok((text, rows.collect()))
}

/// The same, grouped by what the picture is on.
fn by_print(found: &[(String, Certificate)]) -> String {
    let mut groups: Vec<(&str, Vec<(&str, &Certificate)>)> = Vec::new();
    for (name, certificate) in found {
        let (camera, print) = name.split_once('_').unwrap_or((name, "itself"));
        let print = print.split('@').next().unwrap_or(print);
        match groups.iter_mut().find(|(of, _)| *of == print) {
            Some((_, group)) => group.push((camera, certificate)),
            None => groups.push((print, vec![(camera, certificate)])),
        }
    }
    let mut text =
        "\n| on | looks | mean | largest mean | median largest | largest |\n|---|---|---|---|---|---|\n".to_owned();
    for (print, mut group) in groups {
        group.sort_by(|a, b| a.1.max_found.total_cmp(&b.1.max_found));
        let means = || group.iter().map(|(_, certificate)| certificate.overall.mean);
        let (camera, worst) = group[group.len() - 1];
        let _ = writeln!(
            text,
            "| {print} | {} | {:.3} | {:.3} | {:.2} | {:.2} ({camera}) |",
            group.len(),
            means().sum::<f64>() / group.len() as f64,
            means().fold(0.0, f64::max),
            group[group.len() / 2].1.max_found,
            worst.max_found
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use onelight::Printing;

    /// One look of each kind that prints and each that is shown itself, in colour and in black and white.
    const TWELVE: [(&str, Option<&str>); 12] = [
        ("kodak-5206", Some("kodak-2383")),
        ("kodak-portra-800@push-1", Some("kodak-5384")),
        ("kodak-portra-400", Some("kodak-endura-premier")),
        ("fuji-pro-400h", Some("fuji-crystal-archive-dpii")),
        ("agfa-vista-100", Some("fuji-fujiflex")),
        ("fuji-velvia-50", None),
        ("fuji-velvia-50", Some("kodak-radiance-iii")),
        ("kodak-ektachrome-100", Some("ilford-ilfochrome-micrographic")),
        ("fuji-fp-100c", None),
        ("fuji-instax", None),
        ("kodak-5222", Some("kodak-2302")),
        ("kodak-tri-x-400@9-min", Some("kodak-polymax-fine-art@grade-3")),
    ];

    #[test]
    fn twelve_looks_have_tables_as_near_as_those_of_negatives_on_print_film() {
        let looks = TWELVE.map(|(camera, print)| FilmProcess {
            camera: camera.into(),
            print: print.map(Printing::on),
            ..FilmProcess::default()
        });
        let (text, rows) = certificates(&looks, 1 << 9, &|_| {}).unwrap();
        for row in rows.as_array().unwrap() {
            let mean = row["certificate"]["overall"]["mean"].as_f64().unwrap();
            assert!(mean < 0.15, "{text}");
        }
        assert!(text.contains("| itself | 3 |") && text.contains("| kodak-polymax-fine-art | 1 |"), "{text}");
    }
}
