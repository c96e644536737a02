use onelight_lut::{
    Channels, DirectForm, FitSample, FitSettings, Interpolation, Lut3d, PixelMap, PixelsMut, PlainLut, SceneSampler,
    Shaper, ShaperKind, Storage, StructuredLut, fit,
};
use onelight_spectra::{DisplayCoding, DisplayLinear};
use rayon::prelude::*;

use super::coordinate::Coordinate;
use super::recipe::{EntryRange, Form, Recipe, ShaperChoice};
use super::shaper_fit::{Fitted, fitted_to};
use crate::about::About;
use crate::certify::{Certified, Certifier, CertifySettings, Gamut};
use crate::direct::DirectSettings;
use crate::error::{Error, ErrorKind};
use crate::look::Look;
use crate::process::ColourSpaces;
use crate::scene::{MID_GREY, finite};
use crate::structured::{Entries, StructuredSettings};
use crate::word::Word as _;

/// A look in a form that is fast to apply, made by [`Look::baked`]. Entries are those that were stored: what is measured is
/// what is written.
///
/// ```
/// use onelight::baked::{Form, Recipe};
/// let baked = onelight::Process::default().look()?.baked(&Recipe::of(Form::Direct))?;
/// let mut pixels = [[0.18_f32; 3]; 100];
/// baked.map_in_place(&mut pixels);
/// assert!((pixels[99][1] - 0.484).abs() < 1e-3);
/// assert_eq!(baked.describe(), "direct, 10 exponentials and 5 for the print, any scene light");
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Baked {
    form: BakedForm,
    pub(super) about: About,
    /// What a certificate said of these numbers, for comments in files.
    pub(super) measured: Option<String>,
}

/// The numbers of a [`Baked`] look, by its form.
///
/// ```
/// use onelight::baked::{BakedForm, Form, Recipe};
/// let baked = onelight::Process::default().look()?.baked(&Recipe { form: Form::Direct, ..Recipe::default() })?;
/// let BakedForm::Direct(direct) = baked.form() else { return Ok(()) };
/// assert!(direct.apply([0.18; 3])[1] > 0.4);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub enum BakedForm {
    /// A shaper and a table; takes scene-linear light.
    Plain(PlainLut),
    /// Plain too, but the light is coded before it comes.
    Coded {
        /// Display-coded entries over the coding.
        table: Lut3d,
        /// How scene-linear light becomes the table's coordinates.
        coordinate: Box<Coordinate>,
    },
    /// The film's curves and a table; takes scene-linear light.
    Structured(Box<StructuredLut>),
    /// Takes scene-linear light; no table.
    Direct(Box<DirectForm>),
}

/// Pixels that one task of a thread pool maps.
const BLOCK: usize = 4096;
/// Colours for each node that a plain table is fitted to.
const FIT_SAMPLES_PER_NODE: usize = 4;

impl Look {
    /// Bakes the look by a recipe: fits the range of a plain table, the entries or the exponentials, and stores them.
    ///
    /// ```
    /// use onelight::baked::Recipe;
    /// let look = onelight::Process::default().look()?;
    /// let baked = look.baked(&Recipe::cube(33))?;
    /// assert!(baked.describe().starts_with("plain 33^3, log2"));
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If a number of the recipe is out of its range, or the look has not the film curves that the form needs.
    pub fn baked(&self, recipe: &Recipe) -> Result<Baked, Error> {
        Baked::new(self, recipe, None)
    }

    /// Measures a baked form of this look: how far it lies from the exact one, over exposures and saturations.
    ///
    /// ```no_run
    /// use onelight::baked::Recipe;
    /// let look = onelight::Process::default().look()?;
    /// let baked = look.baked(&Recipe::cube(33))?;
    /// let report = look.certify(&baked, &Default::default())?;
    /// assert!(report.srgb.overall.mean < 0.1);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the settings are out of range.
    pub fn certify(&self, baked: &Baked, settings: &CertifySettings) -> Result<Certified, Error> {
        Certifier::new(self)?.within_coding(baked.coordinate()).report(|rgb| baked.apply(rgb), baked.gamut(), settings)
    }

    /// Bakes the look with the range of a plain table fitted to somebody's own colours, scene-linear RGB of the input space.
    ///
    /// # Errors
    /// The same as those of [`Look::baked`].
    pub fn baked_for_scene(&self, recipe: &Recipe, colours: &[[f64; 3]]) -> Result<Baked, Error> {
        Baked::new(self, recipe, Some(colours))
    }
}

impl Baked {
    pub(super) fn new(look: &Look, recipe: &Recipe, scene: Option<&[[f64; 3]]>) -> Result<Self, Error> {
        check_input(look, recipe)?;
        let form = match recipe.form {
            Form::Plain => match recipe.shaper.coordinate(look.spaces())? {
                Some(coordinate) => {
                    let table = coordinate.bake(look, recipe.size)?;
                    let table = match recipe.range {
                        EntryRange::Unit => unit(&table)?,
                        EntryRange::Any => table,
                    };
                    let table = recipe.storage.stored(&table)?;
                    BakedForm::Coded { table, coordinate: Box::new(coordinate) }
                }
                None => BakedForm::Plain(plain(look, recipe, scene)?),
            },
            Form::Structured => {
                let settings = StructuredSettings {
                    size: recipe.size,
                    interpolation: Interpolation::Tetrahedral,
                    entries: recipe.entries,
                    coding: recipe.coding,
                };
                let lut = look.film()?.structured(&settings)?;
                let table = recipe.storage.stored(&lut.parts().table)?;
                BakedForm::Structured(Box::new(lut.with_table(table)))
            }
            Form::Direct => {
                let film = look.film()?;
                let settings = DirectSettings { nodes: recipe.nodes };
                // It codes by powers alone: PQ and HLG are put on its linear light.
                let direct = match film.coding().curve.is_hdr() {
                    true => film.in_linear_light().direct(&settings)?,
                    false => film.direct(&settings)?,
                };
                BakedForm::Direct(Box::new(direct))
            }
        };
        Ok(Self { form, about: look.about().clone(), measured: None })
    }

    /// Scene-linear RGB of the look's input space to display-coded RGB. NaN counts as 0, infinities as the largest number.
    #[must_use]
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        match &self.form {
            BakedForm::Plain(lut) => lut.apply(linear),
            BakedForm::Coded { table, .. } => {
                table.apply(self.coordinates_for_file(linear), Interpolation::Tetrahedral)
            }
            BakedForm::Structured(lut) => lut.apply(linear),
            BakedForm::Direct(direct) => self.coded(direct.apply(linear)),
        }
    }

    /// [`Baked::apply`] to every pixel, on all threads.
    pub fn map_in_place(&self, pixels: &mut [[f32; 3]]) {
        match &self.form {
            BakedForm::Plain(lut) => lut.map_colours(pixels),
            BakedForm::Coded { .. } => pixels.par_iter_mut().for_each(|rgb| *rgb = self.apply(*rgb)),
            BakedForm::Structured(lut) => lut.map_colours(pixels),
            BakedForm::Direct(direct) => pixels.par_chunks_mut(BLOCK).for_each(|block| {
                let width = block.len();
                match PixelsMut::new(block.as_flattened_mut(), Channels::Rgb, [width, 1]) {
                    Ok(mut row) => direct.map_in_place(&mut row),
                    // A row of its own length always is a picture; were it not, its pixels would still be mapped.
                    Err(_) => direct.map_colours(block),
                }
                if self.coding().curve.is_hdr() {
                    block.iter_mut().for_each(|rgb| *rgb = self.coded(*rgb));
                }
            }),
        }
    }

    /// What a direct form gives, coded as the look is where the form cannot.
    fn coded(&self, rgb: [f32; 3]) -> [f32; 3] {
        let coding = self.coding();
        match coding.curve.is_hdr() {
            true => coding.encode_rgb(DisplayLinear(rgb.map(f64::from))).map(|v| v as f32),
            false => rgb,
        }
    }

    /// How what comes out is coded.
    #[must_use]
    pub fn coding(&self) -> DisplayCoding {
        self.about.coding()
    }

    /// What a file of this look expects for scene-linear RGB: the light itself, or its coding.
    #[must_use]
    pub fn coordinates_for_file(&self, linear: [f32; 3]) -> [f32; 3] {
        match &self.form {
            BakedForm::Coded { coordinate, .. } => {
                coordinate.encode(linear.map(|v| finite(f64::from(v)))).map(|v| v as f32)
            }
            BakedForm::Plain(_) | BakedForm::Structured(_) | BakedForm::Direct(_) => linear,
        }
    }

    /// The same look with other entries, such as those read back from a file; the direct form has none.
    #[must_use]
    pub fn with_table(&self, table: Lut3d) -> Self {
        let form = match &self.form {
            BakedForm::Plain(lut) => BakedForm::Plain(PlainLut::new(*lut.shaper(), table, lut.interpolation())),
            BakedForm::Coded { coordinate, .. } => BakedForm::Coded { table, coordinate: coordinate.clone() },
            BakedForm::Structured(lut) => BakedForm::Structured(Box::new(lut.with_table(table))),
            BakedForm::Direct(direct) => BakedForm::Direct(direct.clone()),
        };
        Self { form, about: self.about.clone(), measured: None }
    }

    /// The same look with its entries stored in another way; the direct form has none.
    ///
    /// # Errors
    /// If an entry cannot be stored.
    pub fn stored(&self, storage: Storage) -> Result<Self, Error> {
        match self.table() {
            Some(table) => Ok(self.with_table(storage.stored(table)?)),
            None => Ok(self.clone()),
        }
    }

    /// The same look with what was measured of it, for the comments of its files.
    #[must_use]
    pub fn with_report(self, report: &Certified) -> Self {
        Self { measured: Some(report.summary()), ..self }
    }

    /// The numbers, by their form.
    #[must_use]
    pub fn form(&self) -> &BakedForm {
        &self.form
    }

    /// The table, as stored; the direct form has none.
    #[must_use]
    pub fn table(&self) -> Option<&Lut3d> {
        match &self.form {
            BakedForm::Plain(lut) => Some(lut.table()),
            BakedForm::Coded { table, .. } => Some(table),
            BakedForm::Structured(lut) => Some(&lut.parts().table),
            BakedForm::Direct(_) => None,
        }
    }

    /// The coding that the form takes; `None` for scene-linear light.
    #[must_use]
    pub fn coordinate(&self) -> Option<&Coordinate> {
        match &self.form {
            BakedForm::Coded { coordinate, .. } => Some(coordinate),
            BakedForm::Plain(_) | BakedForm::Structured(_) | BakedForm::Direct(_) => None,
        }
    }

    /// The brightest scene value that the form tells from brighter ones; `None` where there is no end.
    #[must_use]
    pub fn max(&self) -> Option<f64> {
        match &self.form {
            BakedForm::Plain(lut) => Some(lut.shaper().max()),
            BakedForm::Coded { coordinate, .. } => Some(coordinate.max()),
            BakedForm::Structured(_) | BakedForm::Direct(_) => None,
        }
    }

    /// The colours that the form takes: a plain table those inside its own primaries.
    #[must_use]
    pub fn gamut(&self) -> Gamut {
        match &self.form {
            BakedForm::Plain(_) | BakedForm::Coded { .. } => Gamut::Srgb,
            BakedForm::Structured(_) | BakedForm::Direct(_) => Gamut::Wide,
        }
    }

    /// The name of the look: `kodak-5207_kodak-2383`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.about.name
    }

    /// The RGB that comes in and goes out.
    #[must_use]
    pub fn spaces(&self) -> &ColourSpaces {
        &self.about.spaces
    }

    /// Nodes along each side, and how scene light gets there: one line for people.
    #[must_use]
    pub fn describe(&self) -> String {
        match &self.form {
            BakedForm::Plain(lut) => {
                let (size, max) = (lut.table().size(), lut.shaper().max());
                let ShaperKind::Log2Offset { offset, .. } = lut.shaper().kind() else {
                    return format!("plain {size}^3");
                };
                let stops = (max / MID_GREY).log2();
                format!("plain {size}^3, log2(u + {offset:.5}), scene light 0 to {max:.2} ({stops:+.1} stops)")
            }
            BakedForm::Coded { table, coordinate } if coordinate.is_scan() => {
                format!("plain {}^3, takes Cineon codes 0 to 1023", table.size())
            }
            BakedForm::Coded { table, coordinate } => {
                let (size, name, max) = (table.size(), coordinate.name(), coordinate.max());
                format!("plain {size}^3, takes {name}, scene light to {max:.2}")
            }
            BakedForm::Structured(lut) => {
                let stages = if lut.parts().mix.is_some() { "camera and print curves" } else { "camera curves" };
                format!("structured {}^3, {stages}, any scene light", lut.parts().table.size())
            }
            BakedForm::Direct(direct) => {
                let parts = direct.parts();
                let projection = parts.projection.terms().len();
                let print =
                    parts.print.as_ref().map(|print| format!(" and {} for the print", print.exposure.terms().len()));
                format!("direct, {projection} exponentials{}, any scene light", print.unwrap_or_default())
            }
        }
    }
}

impl BakedForm {
    /// The kind of form, as a recipe names it.
    #[must_use]
    pub fn kind(&self) -> Form {
        match self {
            Self::Plain(_) | Self::Coded { .. } => Form::Plain,
            Self::Structured(_) => Form::Structured,
            Self::Direct(_) => Form::Direct,
        }
    }
}

/// Whether a table takes what the look does: light, or codes of a scanned negative.
fn check_input(look: &Look, recipe: &Recipe) -> Result<(), Error> {
    let is_print = matches!(look, Look::Print(_));
    let sentence = match (recipe.form, recipe.shaper == ShaperChoice::Cineon) {
        (Form::Plain, is_cineon) if is_cineon == is_print => return Ok(()),
        (Form::Plain, true) => {
            "shaper cineon takes codes of a scanned negative, which a camera film is not exposed by, expected camera none".to_owned()
        }
        (Form::Plain, false) => {
            let found = recipe.shaper.word();
            format!("camera is none: a print takes codes of a scanned negative, expected shaper cineon instead of {found}")
        }
        _ if !is_print => return Ok(()),
        (form, _) => {
            let found = form.word();
            format!("camera is none: the {found} form is made of a camera film's curves, expected form plain")
        }
    };
    Err(ErrorKind::Contradiction(sentence).into())
}

fn plain(look: &Look, recipe: &Recipe, scene: Option<&[[f64; 3]]>) -> Result<PlainLut, Error> {
    let shaper = match (recipe.shaper, scene) {
        (ShaperChoice::Gotanda, _) => Shaper::gotanda(),
        (_, Some(colours)) => fitted_to(look, &Fitted::Scene(colours))?,
        (_, None) => fitted_to(look, &Fitted::Look { stops: recipe.stops })?,
    };
    let table = look.bake(recipe.size, |t| t.map(|t| shaper.decode(t)))?;
    let table = match recipe.entries {
        Entries::Sampled => table,
        Entries::Fitted => fitted_plain(look, &shaper, &table)?,
    };
    let table = recipe.storage.stored(&table)?;
    Ok(PlainLut::new(shaper, table, Interpolation::Tetrahedral))
}

/// The same table with its entries cut to 0 to 1.
fn unit(table: &Lut3d) -> Result<Lut3d, Error> {
    Ok(Lut3d::new(table.size(), table.entries().map(|entry| entry.map(|v| v.clamp(0.0, 1.0))).collect())?)
}

/// A plain table moved towards the look between its nodes, over the range of its shaper.
fn fitted_plain(look: &Look, shaper: &Shaper, table: &Lut3d) -> Result<Lut3d, Error> {
    let stops = (shaper.max() / MID_GREY).log2();
    let count = FIT_SAMPLES_PER_NODE * table.entries().len();
    let colours: Vec<[f64; 3]> = SceneSampler::new(-10.0f64.min(stops)..=stops)?.take(count).collect();
    let samples: Vec<FitSample> = colours
        .par_iter()
        .map(|&rgb| FitSample {
            coordinates: rgb.map(|v| shaper.encode(v) as f32),
            target: look.develop(rgb).map(|v| v as f32),
        })
        .collect();
    let difference = look.difference()?;
    let linear = |coded: [f32; 3]| look.coding().decode_rgb(coded.map(f64::from));
    let miss = |i: usize, value: [f32; 3]| difference.between(linear(samples[i].target), linear(value));
    Ok(fit(table, Interpolation::Tetrahedral, &samples, miss, FitSettings::default())?)
}
