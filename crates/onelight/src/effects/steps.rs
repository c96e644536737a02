use std::f64::consts::LOG10_2;

use onelight_film::{DyeAmount, LogExposure, PerLayer};
use onelight_lut::{DirectForm, StagedMap, StructuredLut};
use onelight_spatial::{Development, Finish};
use onelight_spectra::{DisplayCoding, DisplayDifference, DisplayLinear};

use crate::baked::{Baked, BakedForm};
use crate::error::{Error, ErrorKind};
use crate::look::Look;
use crate::reference::Reference;

/// A film look in three steps: scene light to exposures, exposures to dye in the camera film, dye to display-coded colours. Between them
/// lies what film does to a picture rather than to a colour.
///
/// ```
/// use onelight::FilmSteps;
/// use onelight::spatial::Development;
/// let look = onelight::Process::default().look()?;
/// let steps = FilmSteps::of(&look, None)?;
/// let (mut red, mut green, mut blue) = ([0.0], [0.0], [0.0]);
/// steps.expose(&[[2.0, 0.5, 0.1]], [&mut red, &mut green, &mut blue]);
/// steps.develop([&mut red, &mut green, &mut blue]);
/// let mut shown = [[0.0; 3]];
/// steps.finish([&red, &green, &blue], &mut shown);
/// let whole = look.develop([2.0, 0.5, 0.1]);
/// assert!(whole.iter().zip(shown[0]).all(|(a, b)| (a - f64::from(b)).abs() < 1e-6));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FilmSteps<'a> {
    film: &'a Reference,
    form: Form<'a>,
    difference: DisplayDifference,
}

#[derive(Debug, Clone, Copy)]
enum Form<'a> {
    Exact,
    Direct(&'a DirectForm),
    /// With the amounts of dye at the ends of its axes, where these are not amounts themselves.
    Structured(&'a StructuredLut, Option<[[f32; 2]; 3]>),
}

impl<'a> FilmSteps<'a> {
    /// Of a look, computed exactly or as it was baked.
    ///
    /// # Errors
    /// If the look is no simulation of film, or its baked form is a plain table.
    pub fn of(look: &'a Look, baked: Option<&'a Baked>) -> Result<Self, Error> {
        let film = look.film()?;
        let form = match baked.map(Baked::form) {
            None => Form::Exact,
            Some(BakedForm::Direct(direct)) => Form::Direct(direct),
            Some(BakedForm::Structured(lut)) => Form::Structured(lut, film.axis_amounts(lut)),
            Some(BakedForm::Plain(_) | BakedForm::Coded { .. }) => {
                let sentence = "a plain table knows no dye, which sharpness, halation and grain change: expected form direct, structured or reference";
                return Err(ErrorKind::Contradiction(sentence.to_owned()).into());
            }
        };
        Ok(Self { difference: film.difference()?, film, form })
    }

    /// Of a film and its direct form.
    ///
    /// ```
    /// use onelight::{DirectSettings, FilmProcess, FilmSteps, LiveDirect};
    /// let live = LiveDirect::new(&FilmProcess::default(), DirectSettings::default())?;
    /// let steps = FilmSteps::direct(live.film(), live.form())?;
    /// # let _ = steps;
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// None with the display spaces that are built in.
    pub fn direct(film: &'a Reference, direct: &'a DirectForm) -> Result<Self, Error> {
        Ok(Self { difference: film.difference()?, film, form: Form::Direct(direct) })
    }

    /// Scene-linear RGB of the look's input space to the exposure of each layer, hard inputs as in [`Reference::develop`].
    pub fn expose(&self, linear: &[[f32; 3]], layers: [&mut [f32]; 3]) {
        match self.form {
            Form::Exact => {
                let [red, green, blue] = layers;
                for (((rgb, red), green), blue) in linear.iter().zip(red).zip(green).zip(blue) {
                    [*red, *green, *blue] = self.film.exposure(rgb.map(f64::from)).map(|e| e as f32).to_array();
                }
            }
            Form::Direct(direct) => direct.expose(linear, layers),
            Form::Structured(lut, _) => lut.expose(linear, layers),
        }
    }

    /// Dye in the camera film to display-coded RGB.
    pub fn finish(&self, amounts: [&[f32]; 3], shown: &mut [[f32; 3]]) {
        let [red, green, blue] = amounts;
        match self.form {
            Form::Exact => {
                for (((rgb, red), green), blue) in shown.iter_mut().zip(red).zip(green).zip(blue) {
                    let linear = self.film.develop_amounts(dye([*red, *green, *blue].map(f64::from)));
                    *rgb = self.coding().encode_rgb(linear).map(|v| v as f32);
                }
            }
            Form::Direct(direct) => {
                direct.finish(amounts, shown);
                let coding = self.coding();
                // The form codes by powers alone: PQ and HLG are put on its linear light.
                if coding.curve.is_hdr() {
                    let coded = |rgb: [f32; 3]| coding.encode_rgb(DisplayLinear(rgb.map(f64::from))).map(|v| v as f32);
                    shown.iter_mut().for_each(|rgb| *rgb = coded(*rgb));
                }
            }
            Form::Structured(lut, None) => lut.finish(amounts, shown),
            Form::Structured(lut, Some(ends)) => {
                let of_axis = |layer: usize| {
                    let [least, most] = ends[layer];
                    amounts[layer].iter().map(|a| (a - least) / (most - least)).collect::<Vec<f32>>()
                };
                let [red, green, blue] = [of_axis(0), of_axis(1), of_axis(2)];
                lut.finish([&red, &green, &blue], shown);
            }
        }
    }

    /// Dye in the camera film for greys so many stops above mid grey.
    pub(super) fn greys(&self, stops: impl Iterator<Item = f64>) -> Vec<[f64; 3]> {
        let grey = self.film.mid_grey();
        let at = |stops: f64| grey.map(|h| LogExposure(h.0 + stops * LOG10_2));
        stops.map(|stops| self.film.camera_amounts(at(stops)).map(|a| a.0).to_array()).collect()
    }

    fn coding(&self) -> DisplayCoding {
        self.film.coding()
    }
}

impl Development for FilmSteps<'_> {
    fn develop(&self, layers: [&mut [f32]; 3]) {
        match self.form {
            Form::Exact => {
                let [red, green, blue] = layers;
                for ((red, green), blue) in red.iter_mut().zip(green).zip(blue) {
                    let exposure = PerLayer::from([*red, *green, *blue].map(f64::from)).map(LogExposure::of);
                    [*red, *green, *blue] = self.film.camera_amounts(exposure).map(|a| a.0 as f32).to_array();
                }
            }
            Form::Direct(direct) => direct.develop(layers),
            Form::Structured(lut, ends) => {
                let [red, green, blue] = layers;
                lut.develop([&mut *red, &mut *green, &mut *blue]);
                for (layer, [least, most]) in [red, green, blue].into_iter().zip(ends.into_iter().flatten()) {
                    layer.iter_mut().for_each(|a| *a = least + *a * (most - least));
                }
            }
        }
    }
}

impl Finish for FilmSteps<'_> {
    fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3] {
        match self.form {
            Form::Exact => self.film.develop_amounts(dye(amounts)).0,
            _ => self.display_linear_of(&[amounts])[0],
        }
    }

    fn display_linear_of(&self, amounts: &[[f64; 3]]) -> Vec<[f64; 3]> {
        if let Form::Exact = self.form {
            return amounts.iter().map(|amounts| self.film.develop_amounts(dye(*amounts)).0).collect();
        }
        let [red, green, blue] = [0, 1, 2].map(|layer| amounts.iter().map(|a| a[layer] as f32).collect::<Vec<f32>>());
        let mut shown = vec![[0.0; 3]; amounts.len()];
        FilmSteps::finish(self, [&red, &green, &blue], &mut shown);
        shown.into_iter().map(|rgb| *self.coding().decode_rgb(rgb.map(f64::from))).collect()
    }

    fn lab(&self, display_linear: [f64; 3]) -> [f64; 3] {
        self.difference.lab(DisplayLinear(display_linear))
    }

    fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        self.difference.between(DisplayLinear(a), DisplayLinear(b))
    }
}

fn dye(amounts: [f64; 3]) -> PerLayer<DyeAmount> {
    PerLayer::from(amounts).map(DyeAmount)
}

impl Reference {
    /// Exposure of the three layers, not its logarithm.
    fn exposure(&self, rgb: [f64; 3]) -> PerLayer<f64> {
        self.exposure_matrix().expose(self.light(rgb))
    }

    /// The amounts of dye between which the coordinates of a structured form lie that has them for its axes; `None` for one whose first
    /// curves give amounts.
    fn axis_amounts(&self, lut: &StructuredLut) -> Option<[[f32; 2]; 3]> {
        let ends = || self.camera_curves().map(|curve| curve.amount_range().into_inner()).to_array();
        lut.parts().mix.is_none().then(|| ends().map(|(least, most)| [least.0 as f32, most.0 as f32]))
    }
}
