//! How far the files of a bake lie from the film.

use std::fmt::Write as _;

use anyhow::{Context, Result};
use onelight::baked::{AsWritten, Baked, FileFormat};
use onelight::certify::{Certifier, Gamut, Tint, in_words, summary};
use onelight::lut::{Certificate, Deviation, SamplingLaw, Search, deviation};
use onelight::{GamutEffect, Look, Word as _, WorkingSpace};
use serde_json::{Map, Value, json};

use super::tints::{self, Tinted};
use crate::look::ChosenLook;

/// A table whose largest certified difference is above this deserves a warning, unless `--max-de` names another.
const WARN_ABOVE: f64 = 2.0;

/// Certificates of the files' numbers as written, and the deviation on the user's own pictures.
pub(super) struct Measured {
    /// By format, in the order asked for.
    files: Vec<(FileFormat, Certificate)>,
    rec2020: Option<Certificate>,
    scene: Option<Deviation>,
    /// What light outside the sRGB primaries does on the user's own pictures; `None` without them or without film.
    gamut: Option<GamutEffect>,
    /// The tint of greys that the look itself has, whatever it is baked to.
    tint: Tint,
    /// The same for either white and aim.
    tints: Vec<Tinted>,
    limit: f64,
}

impl Measured {
    pub(super) fn new(
        look: &ChosenLook,
        film: &Look,
        baked: &Baked,
        formats: &[FileFormat],
        scene: Option<&[[f64; 3]]>,
        max_de: Option<f64>,
    ) -> Result<Self> {
        let measure = Certifier::new(film)?.within_coding(baked.coordinate());
        let samples = measure.samples(&SamplingLaw::default(), WorkingSpace::Srgb)?;
        let mut written = Vec::new();
        for &format in formats {
            written.push(baked.as_written(format)?);
        }
        let mut files = Vec::new();
        for (&format, written) in formats.iter().zip(&written) {
            files.push((format, measure.certify(&samples, |rgb| written.apply(rgb), Search::Ascent)?));
        }
        let first = &written[0];
        let rec2020 = match baked.gamut() {
            Gamut::Wide => {
                let samples = measure.samples(&SamplingLaw::default(), WorkingSpace::Rec2020)?;
                let map = |rgb| first.apply(rgb);
                Some(measure.certify_in(WorkingSpace::Rec2020, &samples, map, Search::Ascent)?)
            }
            Gamut::Srgb => None,
        };
        let gamut = match (film, scene) {
            (Look::Film(film), Some(colours)) => Some(film.gamut_effect(colours)?),
            _ => None,
        };
        let scene = scene.map(|colours| on_scene(film, first, colours)).transpose()?;
        let (tint, limit) = (measure.tint(), max_de.unwrap_or(WARN_ABOVE));
        Ok(Self { files, rec2020, scene, gamut, tint, tints: tints::of(look)?, limit })
    }

    /// The certificate of the first format.
    fn srgb(&self) -> &Certificate {
        &self.files[0].1
    }

    /// One line for comments in files.
    pub(super) fn summary(&self) -> String {
        summary(self.srgb())
    }

    pub(super) fn text(&self) -> String {
        let mut text = in_words(self.srgb(), "sRGB");
        for (format, certificate) in &self.files[1..] {
            let (mean, max) = (certificate.overall.mean, certificate.max_found);
            let _ = writeln!(text, "  the same for {}: mean {mean:.3}, max {max:.3}", format.word());
        }
        if let Some(wide) = &self.rec2020 {
            let (mean, max) = (wide.overall.mean, wide.max_found);
            let _ = writeln!(text, "  the same for Rec.2020 colours: mean {mean:.3}, max {max:.3}");
        }
        let _ = writeln!(text, "{}", self.tint);
        text += &tints::text(&self.tints);
        if let Some(d) = &self.scene {
            let _ = writeln!(
                text,
                "on the scene given, {} pixels: mean {:.3}, p95 {:.3}, p99 {:.3}, max {:.3} at {:.4}, {:.4}, {:.4}",
                d.count, d.mean, d.p95, d.p99, d.max, d.worst[0], d.worst[1], d.worst[2]
            );
        }
        if let Some(effect) = &self.gamut {
            let _ = writeln!(text, "  {effect}");
        }
        text
    }

    pub(super) fn warnings(&self) -> Vec<String> {
        self.srgb().failures(self.limit)
    }

    pub(super) fn json(&self) -> Map<String, Value> {
        let Tint { mid_grey, largest, stops } = self.tint;
        let json = json!({
            "unit": "CIEDE2000",
            "certificate": self.srgb(),
            "certificates": self.files.iter().map(|(f, c)| (f.word().to_owned(), json!(c))).collect::<Map<_, _>>(),
            "certificate_rec2020": self.rec2020,
            "scene": self.scene,
            "scene_gamut": self.gamut,
            "tint": { "unit": "CIELAB C*", "mid_grey": mid_grey, "largest": largest, "stops": stops },
            "tints": tints::json(&self.tints),
            "limit": self.limit,
            "failures": self.warnings(),
        });
        if let Value::Object(map) = json { map } else { Map::new() }
    }
}

fn on_scene(film: &Look, written: &AsWritten, colours: &[[f64; 3]]) -> Result<Deviation> {
    let difference = film.difference()?;
    let table = |rgb: [f64; 3]| film.coding().decode_rgb(written.apply(rgb.map(|v| v as f32)).map(f64::from));
    deviation(colours, |rgb| film.develop_linear(rgb), table, |a, b| difference.between(*a, *b)).context("the scene")
}
