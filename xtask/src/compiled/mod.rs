//! A look in a form that is fast to apply: what `bake` writes and `develop --form` uses.

mod choose;
mod coordinate;
mod shaper_fit;

use anyhow::Result;
use clap::ValueEnum;
use onelight::lut::{
    Channels, DirectForm, FitSample, FitSettings, Interpolation, Lut3d, PixelMap, PixelsMut, PlainLut, SceneSampler,
    Shaper, Storage, StructuredLut, fit,
};
use onelight::spectra::SceneCurve;
use onelight::{DirectSettings, Entries, Look, Nodes, Process, StructuredSettings, TableCoding};
use rayon::prelude::*;

pub(crate) use choose::smallest_under;
pub(crate) use coordinate::Coordinate;
pub(crate) use shaper_fit::{Fitted, fitted_to};

/// The forms a look can be baked to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Form {
    /// A log2 shaper and one table: every program reads it; the scene's range is limited
    Plain,
    /// The film's own curves as axes of the table: any range, several times as accurate
    Structured,
    /// No table: the film's curves and a few exponentials; any range, most accurate
    Direct,
}

impl Form {
    /// Its name on the command line.
    pub(crate) fn word(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// The shapers of the plain form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShaperChoice {
    /// log2 with offset and range fitted to the look
    Log2,
    /// The talk's: log2(u + 0.191406), 0 to 4
    Gotanda,
    /// The table takes ACEScct (AP1 primaries) instead of scene light
    Acescct,
    /// It takes ARRI LogC4 (ARRI Wide Gamut 4)
    Logc4,
    /// It takes Sony S-Log3 (S-Gamut3.Cine)
    Slog3,
    /// It takes DaVinci Intermediate (DaVinci Wide Gamut)
    Intermediate,
    /// It takes PQ (BT.2020), scene 1.0 at 100 cd/m^2
    Pq,
    /// It takes sRGB-coded colour: nothing brighter than white
    Srgb,
    /// It takes log2(x / 0.18) from -11 to +12: Bevy's tone-mapping tables, with linear output
    Bevy,
}

impl ShaperChoice {
    /// The coding that a table takes instead of scene-linear light.
    fn coordinate(self, process: &Process) -> Result<Option<Coordinate>> {
        let curve = match self {
            Self::Log2 | Self::Gotanda => return Ok(None),
            Self::Bevy => return Coordinate::bevy(process).map(Some),
            Self::Acescct => SceneCurve::AcesCct,
            Self::Logc4 => SceneCurve::LogC4,
            Self::Slog3 => SceneCurve::SLog3,
            Self::Intermediate => SceneCurve::DaVinciIntermediate,
            Self::Pq => SceneCurve::Pq,
            Self::Srgb => SceneCurve::Srgb,
        };
        Coordinate::of_curve(curve, process).map(Some)
    }
}

/// Everything that decides what a look is baked to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Recipe {
    pub(crate) form: Form,
    pub(crate) size: usize,
    pub(crate) shaper: ShaperChoice,
    /// Where the range of a plain table ends, in stops about mid grey; `None` fits it.
    pub(crate) stops: Option<f64>,
    pub(crate) entries: Entries,
    pub(crate) storage: Storage,
    pub(crate) coding: TableCoding,
    /// The exponentials of a direct form.
    pub(crate) nodes: Nodes,
}

impl Recipe {
    /// The usual recipe of a form.
    pub(crate) fn usual(form: Form) -> Self {
        let (size, entries) = match form {
            Form::Plain => (33, Entries::Sampled),
            Form::Structured => (32, Entries::Fitted),
            Form::Direct => (0, Entries::Fitted),
        };
        let (storage, coding) = (Storage::F32, TableCoding::Density);
        let nodes = DirectSettings::default().nodes;
        Self { form, size, shaper: ShaperChoice::Log2, stops: None, entries, storage, coding, nodes }
    }
}

/// NaN and infinities as the film takes them.
fn finite(v: f32) -> f64 {
    let limit = onelight::SCENE_MAX;
    if v.is_nan() { 0.0 } else { f64::from(v).clamp(-limit, limit) }
}

/// Pixels of one task.
const BLOCK: usize = 4096;
/// Colours for each node that a plain table is fitted to.
const FIT_SAMPLES_PER_NODE: usize = 4;

/// A plain table moved towards the film between its nodes, over the range of its shaper.
fn fitted_plain(film: &Look, shaper: &Shaper, table: &Lut3d) -> Result<Lut3d> {
    let stops = (shaper.max() / SceneSampler::MID_GREY).log2();
    let count = FIT_SAMPLES_PER_NODE * table.entries().len();
    let colours: Vec<[f64; 3]> = SceneSampler::new(-10.0f64.min(stops)..=stops)?.take(count).collect();
    let samples: Vec<FitSample> = colours
        .par_iter()
        .map(|&rgb| FitSample {
            coordinates: rgb.map(|v| shaper.encode(v) as f32),
            target: film.develop(rgb).map(|v| v as f32),
        })
        .collect();
    let difference = film.difference()?;
    let linear = |coded: [f32; 3]| coded.map(|v| film.coding().decode(f64::from(v)));
    let miss = |i: usize, value: [f32; 3]| difference.between(linear(samples[i].target), linear(value));
    Ok(fit(table, Interpolation::Tetrahedral, &samples, miss, FitSettings::default())?)
}

/// A baked look. Entries are those that were stored: what is measured is what is written.
pub(crate) enum Compiled {
    /// Scene-linear light in.
    Plain(PlainLut),
    /// Plain too, but the light is coded before it comes.
    Coded { table: Lut3d, coordinate: Box<Coordinate> },
    /// Scene-linear light in.
    Structured(Box<StructuredLut>),
    /// Scene-linear light in; no table.
    Direct(Box<DirectForm>),
}

impl Compiled {
    /// Bakes a look; `scene` holds colours that a plain table's range is fitted to instead of the usual ones.
    pub(crate) fn new(film: &Look, process: &Process, recipe: &Recipe, scene: Option<&[[f64; 3]]>) -> Result<Self> {
        match recipe.form {
            Form::Plain => {
                if let Some(coordinate) = recipe.shaper.coordinate(process)? {
                    let table = recipe.storage.stored(&coordinate.bake(film, recipe.size)?)?;
                    return Ok(Self::Coded { table, coordinate: Box::new(coordinate) });
                }
                let shaper = match (recipe.shaper, scene) {
                    (ShaperChoice::Gotanda, _) => Shaper::gotanda(),
                    (_, Some(colours)) => fitted_to(film, &Fitted::Scene(colours))?,
                    (_, None) => fitted_to(film, &Fitted::Look { stops: recipe.stops })?,
                };
                let table = film.bake(recipe.size, |t| t.map(|t| shaper.decode(t)))?;
                let table = match recipe.entries {
                    Entries::Sampled => table,
                    Entries::Fitted => fitted_plain(film, &shaper, &table)?,
                };
                let table = recipe.storage.stored(&table)?;
                Ok(Self::Plain(PlainLut::new(shaper, table, Interpolation::Tetrahedral)))
            }
            Form::Structured => {
                let settings = StructuredSettings {
                    size: recipe.size,
                    interpolation: Interpolation::Tetrahedral,
                    entries: recipe.entries,
                    coding: recipe.coding,
                };
                let lut = film.film()?.structured(&settings)?;
                let table = recipe.storage.stored(&lut.parts().table)?;
                Ok(Self::Structured(Box::new(lut.with_table(table))))
            }
            Form::Direct => {
                let direct = film.film()?.direct(&DirectSettings { nodes: recipe.nodes })?;
                Ok(Self::Direct(Box::new(direct)))
            }
        }
    }

    /// Scene-linear RGB of the look's input space to display-coded RGB.
    pub(crate) fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Plain(lut) => lut.apply(linear),
            Self::Coded { table, .. } => table.apply(self.coordinates_for_file(linear), Interpolation::Tetrahedral),
            Self::Structured(lut) => lut.apply(linear),
            Self::Direct(direct) => direct.apply(linear),
        }
    }

    /// What a file of this look expects for scene-linear RGB: the light itself, or its coding.
    pub(crate) fn coordinates_for_file(&self, linear: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Plain(_) | Self::Structured(_) | Self::Direct(_) => linear,
            Self::Coded { coordinate, .. } => coordinate.encode(linear.map(finite)).map(|v| v as f32),
        }
    }

    /// The same look with other entries, such as those read back from a file.
    pub(crate) fn with_table(&self, table: Lut3d) -> Self {
        match self {
            Self::Plain(lut) => Self::Plain(PlainLut::new(*lut.shaper(), table, lut.interpolation())),
            Self::Coded { coordinate, .. } => Self::Coded { table, coordinate: coordinate.clone() },
            Self::Structured(lut) => Self::Structured(Box::new(lut.with_table(table))),
            Self::Direct(direct) => Self::Direct(direct.clone()),
        }
    }

    /// Which form it is.
    pub(crate) fn form(&self) -> Form {
        match self {
            Self::Plain(_) | Self::Coded { .. } => Form::Plain,
            Self::Structured(_) => Form::Structured,
            Self::Direct(_) => Form::Direct,
        }
    }

    /// Its table, as stored; the direct form has none.
    pub(crate) fn table(&self) -> Option<&Lut3d> {
        match self {
            Self::Plain(lut) => Some(lut.table()),
            Self::Coded { table, .. } => Some(table),
            Self::Structured(lut) => Some(&lut.parts().table),
            Self::Direct(_) => None,
        }
    }

    /// [`Compiled::apply`] to every pixel in place, on all threads.
    pub(crate) fn map_colours(&self, pixels: &mut [[f32; 3]]) {
        match self {
            Self::Plain(lut) => lut.map_colours(pixels),
            Self::Coded { .. } => pixels.par_iter_mut().for_each(|rgb| *rgb = self.apply(*rgb)),
            Self::Structured(lut) => lut.map_colours(pixels),
            Self::Direct(direct) => pixels.par_chunks_mut(BLOCK).for_each(|block| {
                let width = block.len();
                if let Ok(mut row) = PixelsMut::new(block.as_flattened_mut(), Channels::Rgb, [width, 1]) {
                    direct.map_in_place(&mut row);
                }
            }),
        }
    }

    /// The brightest scene value that the form tells from brighter ones.
    pub(crate) fn max(&self) -> Option<f64> {
        match self {
            Self::Plain(lut) => Some(lut.shaper().max()),
            Self::Coded { coordinate, .. } => Some(coordinate.max()),
            Self::Structured(_) | Self::Direct(_) => None,
        }
    }

    /// Nodes along each side, and how scene light gets there.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Plain(lut) => {
                let (size, max) = (lut.table().size(), lut.shaper().max());
                let onelight::lut::ShaperKind::Log2Offset { offset, .. } = lut.shaper().kind() else {
                    return format!("plain {size}^3");
                };
                let stops = (max / SceneSampler::MID_GREY).log2();
                format!("plain {size}^3, log2(u + {offset:.5}), scene light 0 to {max:.2} ({stops:+.1} stops)")
            }
            Self::Coded { table, coordinate } => {
                format!("plain {}^3, takes {}, scene light to {:.2}", table.size(), coordinate.name, coordinate.max())
            }
            Self::Structured(lut) => {
                let stages = if lut.parts().mix.is_some() { "camera and print curves" } else { "camera curves" };
                format!("structured {}^3, {stages}, any scene light", lut.parts().table.size())
            }
            Self::Direct(direct) => {
                let parts = direct.parts();
                let projection = parts.projection.terms().len();
                let print =
                    parts.print.as_ref().map(|print| format!(" and {} for the print", print.exposure.terms().len()));
                format!("direct, {projection} exponentials{}, any scene light", print.unwrap_or_default())
            }
        }
    }
}
