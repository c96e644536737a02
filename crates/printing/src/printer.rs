use onelight_film::{PerLayer, Tail};
use onelight_spectra::{Kelvin, SpectralDistribution, SpectralShape, black_body, quantity::Power};

use crate::error::Error;
use crate::filter::{HeatGlass, Wratten};

/// Whether the light between 780 and 1000 nm takes part in printing.
///
/// ```
/// use onelight_printing::{Infrared, Printer};
/// let cut = Printer { infrared: Infrared::Off, ..Printer::default() };
/// assert_eq!(cut.shape().last_nm(), 780.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Infrared {
    /// It does: printing is computed up to 1000 nm.
    #[default]
    On,
    /// It does not: printing is computed up to 780 nm.
    Off,
}

/// How the printer's lamp meets the layers of the print.
///
/// ```
/// use onelight_printing::{Printer, PrinterLight};
/// use onelight_film::PerLayer;
/// let white = Printer { light: PrinterLight::White, beam_density: PerLayer::all(0.0), ..Printer::default() }.beams()?;
/// assert_eq!(white.red, white.blue);
/// # Ok::<(), onelight_printing::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum PrinterLight {
    /// An additive printer: three beams, each behind its own separation filter. Each beam reaches mostly one layer.
    #[default]
    Separations,
    /// A subtractive printer: one white beam, balanced for each layer by itself, as ideal colour-correcting filters would.
    /// The layers' sensitivities overlap in white light: prints lose chroma against separations.
    White,
    /// The colour head of an enlarger: cyan, magenta and yellow dichroic filters moved part of the way into a tungsten lamp's light,
    /// which is mixed. A dichroic filter holds back one third of the spectrum and nothing else, so that the three together leave
    /// a red, a green and a blue band, each as strong as its filter lets it be: [`Printer::filtration`]. Edges at 500 and 600 nm are
    /// stand-ins; no curve of such a head is published.
    ColourHead,
}

/// Where the bands of [`PrinterLight::ColourHead`] meet, and how wide the steps are between them, in nm.
const HEAD_EDGES_NM: [f64; 2] = [500.0, 600.0];
const HEAD_STEP_NM: f64 = 4.0;
/// The least that a dichroic filter lets through.
const HEAD_LEAST: f64 = 0.001;

/// Density that leaves the red, green or blue (0, 1, 2) of [`PrinterLight::ColourHead`].
fn head_density(band: usize, nm: f64) -> f64 {
    let past = |edge: f64| 1.0 / (1.0 + ((edge - nm) / HEAD_STEP_NM).exp());
    let [blue_green, green_red] = HEAD_EDGES_NM.map(past);
    let passed = [green_red, blue_green - green_red, 1.0 - blue_green][band];
    -passed.max(HEAD_LEAST).log10()
}

/// The gelatin filters that are in the printer: all of [`Wratten::ALL`], or fewer to see what each is for. Without No. 70 or No. 99
/// most prints cannot be calibrated.
///
/// ```
/// use onelight_printing::{Filters, Wratten};
/// let without_blue = Filters::of(&[Wratten::No70, Wratten::No99, Wratten::No2B]);
/// assert!(!without_blue.contains(Wratten::No98) && Filters::default().contains(Wratten::No98));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Filters([bool; Wratten::ALL.len()]);

impl Filters {
    /// These filters and no others.
    #[must_use]
    pub fn of(filters: &[Wratten]) -> Self {
        Self(Wratten::ALL.map(|filter| filters.contains(&filter)))
    }

    /// Whether a filter is in place.
    #[must_use]
    pub fn contains(self, filter: Wratten) -> bool {
        self.iter().any(|held| held == filter)
    }

    /// Those in place, in the order of [`Wratten::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Wratten> {
        Wratten::ALL.into_iter().zip(self.0).filter_map(|(filter, held)| held.then_some(filter))
    }
}

impl Default for Filters {
    fn default() -> Self {
        Self([true; Wratten::ALL.len()])
    }
}

/// A printer: a 3200 K lamp whose light is split by Wratten 70, 99 and 98 behind a 2B (\[Gotanda2010\], step 5).
///
/// The default is a printer as built; its other settings show what each part does. With the default tail infrared light changes
/// nothing that an eye sees; with a held tail and no glass the calibration has no solution. docs/talk.md has the figures.
///
/// ```
/// use onelight_printing::{HeatGlass, Printer};
/// let bare = Printer { glass: HeatGlass::None, ..Printer::default() };
/// // The red beam's filter opens again in the infrared, which is what the glass is for.
/// let at_900_nm = |printer: Printer| Ok::<_, onelight_printing::Error>(printer.beams()?.red.at(900.0));
/// assert!(at_900_nm(bare)? > at_900_nm(Printer::default())?);
/// # Ok::<(), onelight_printing::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printer {
    /// Three beams behind separation filters, or one white beam.
    pub light: PrinterLight,
    /// The gelatin filters that are in place.
    pub filters: Filters,
    /// Neutral density in the red, green and blue beam: what makes equal lights a good first guess. An exact calibration
    /// takes it out again; one that starts from equal lights and stops early does not.
    pub beam_density: PerLayer<f64>,
    /// Whether infrared light takes part in printing.
    pub infrared: Infrared,
    /// The glass that should keep infrared light from the film.
    pub glass: HeatGlass,
    /// How the print's red layer goes on beyond its published sensitivity.
    pub red_tail: Tail,
}

impl Default for Printer {
    fn default() -> Self {
        Self {
            light: PrinterLight::default(),
            filters: Filters::default(),
            beam_density: BEAM_DENSITY,
            infrared: Infrared::default(),
            glass: HeatGlass::default(),
            red_tail: Tail::default(),
        }
    }
}

/// Neutral density in the beams of the talk's printer.
const BEAM_DENSITY: PerLayer<f64> = PerLayer { red: 0.5, green: 0.55, blue: 0.9 };

impl Printer {
    /// The wavelengths that take part: 400 to 1000 nm by 1 nm, or to 780 nm without infrared.
    #[must_use]
    pub fn shape(self) -> SpectralShape {
        match self.infrared {
            Infrared::On => SpectralShape::by_1_nm::<400, 1000>(),
            Infrared::Off => SpectralShape::by_1_nm::<400, 780>(),
        }
    }

    /// The three beams at unit strength: power relative to the bare lamp at 560 nm. With [`PrinterLight::White`] they differ
    /// in neutral density only.
    ///
    /// # Errors
    /// If a neutral density lies beyond what a density may be.
    pub fn beams(self) -> Result<PerLayer<SpectralDistribution<Power>>, Error> {
        let shape = self.shape();
        let lamp = black_body(Kelvin::TUNGSTEN, shape);
        let separations = PerLayer { red: Wratten::No70, green: Wratten::No99, blue: Wratten::No98 };
        let bands = PerLayer { red: 0, green: 1, blue: 2 };
        let beams = separations.zip_map(self.beam_density, |filter, grey| (filter, grey));
        beams.zip_map(bands, |(filter, grey), band| (filter, grey, band)).try_map(|(filter, grey, band), _| {
            let mut density = SpectralDistribution::from_fn(shape, |_| grey)?.stacked_on(&self.glass.density(shape)?);
            let separation = (self.light == PrinterLight::Separations).then_some(filter);
            if self.light == PrinterLight::ColourHead {
                density = density.stacked_on(&SpectralDistribution::from_fn(shape, |nm| head_density(band, nm))?);
            }
            for filter in separation.into_iter().chain([Wratten::No2B]).filter(|filter| self.filters.contains(*filter))
            {
                density = density.stacked_on(&filter.density(shape)?);
            }
            Ok(lamp.through(&density.transmittance()))
        })
    }
}

impl Printer {
    /// What the dials of a colour head show for these lights: densities of the cyan, magenta and yellow filter (times 100 on the
    /// dial), the least of them 0.
    ///
    /// ```
    /// use onelight_film::PerLayer;
    /// use onelight_printing::{Printer, PrinterLight, PrinterLights};
    /// let head = Printer { light: PrinterLight::ColourHead, beam_density: PerLayer::all(0.0), ..Printer::default() };
    /// let dials = head.filtration(PrinterLights(PerLayer { red: 10.0, green: 1.0, blue: 5.0 }));
    /// assert_eq!((dials.red, dials.green), (0.0, 1.0));
    /// ```
    #[must_use]
    pub fn filtration(self, lights: PrinterLights) -> PerLayer<f64> {
        let bands = lights.0.zip_map(self.beam_density, |light, grey| light.log10() - grey);
        let brightest = bands.to_array().into_iter().fold(f64::NEG_INFINITY, f64::max);
        bands.map(|band| brightest - band)
    }
}

/// Strength of the red, green and blue beam: what a printing lab sets in points, here as factors on [`Printer::beams`], above 0.
///
/// ```
/// use onelight_film::PerLayer;
/// use onelight_printing::PrinterLights;
/// // Twelve points are a stop.
/// let brighter = PrinterLights(PerLayer::all(100.0)).offset(PerLayer { red: 12.0, green: 0.0, blue: 0.0 });
/// assert!((brighter.0.red - 200.0).abs() < 1.0 && brighter.0.green == 100.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrinterLights(pub PerLayer<f64>);

/// A printer point in log10 exposure: a fortieth of a decade, a twelfth of a stop (\[Case2001\]).
pub const POINT_LOG_EXPOSURE: f64 = 0.025;

impl PrinterLights {
    /// The lights so many points brighter. More light makes a print denser: +1 red adds cyan.
    #[must_use]
    pub fn offset(self, points: PerLayer<f64>) -> Self {
        Self(self.0.zip_map(points, |light, points| light * 10f64.powf(POINT_LOG_EXPOSURE * points)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn infrared_is_the_range_beyond_780_nm() {
        assert_eq!(Printer::default().shape().last_nm(), 1000.0);
        let cut = Printer { infrared: Infrared::Off, ..Printer::default() };
        assert_eq!((cut.shape().first_nm(), cut.shape().last_nm()), (400.0, 780.0));
    }

    #[test]
    fn twelve_points_are_a_stop() {
        let lights = PrinterLights(PerLayer::all(3.0)).offset(PerLayer { red: 12.0, green: 0.0, blue: -40.0 }).0;
        assert!((lights.red / 6.0 - 1.0).abs() < 3e-3 && lights.green == 3.0 && (lights.blue - 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_filter_taken_away_lets_more_light_through_where_it_was() {
        let whole = Printer::default().beams().unwrap();
        let but = |gone: Wratten| {
            let rest: Vec<Wratten> = Wratten::ALL.into_iter().filter(|filter| *filter != gone).collect();
            Printer { filters: Filters::of(&rest), ..Printer::default() }.beams().unwrap()
        };
        let blue_at = |beams: PerLayer<SpectralDistribution<Power>>, nm| beams.red.at(nm).unwrap();
        assert!(blue_at(but(Wratten::No70), 550.0) > 100.0 * blue_at(whole.clone(), 550.0));
        assert_eq!(but(Wratten::No70).green, whole.green);
        assert_ne!(but(Wratten::No2B).green, whole.green);
        let white = Printer { light: PrinterLight::White, beam_density: PerLayer::all(0.0), ..Printer::default() };
        let white = white.beams().unwrap();
        assert!(white.red == white.green && white.green == white.blue && white.red.at(560.0).unwrap() > 0.5);
    }

    #[test]
    fn the_bands_of_a_colour_head_are_the_whole_light_between_its_edges() {
        let open = |light| Printer { light, beam_density: PerLayer::all(0.0), ..Printer::default() }.beams().unwrap();
        let (head, white) = (open(PrinterLight::ColourHead), open(PrinterLight::White));
        for nm in [420.0, 470.0, 500.0, 550.0, 600.0, 640.0, 690.0] {
            let bands: f64 = head.as_ref().map(|beam| beam.at(nm).unwrap()).to_array().iter().sum();
            assert!((bands / white.red.at(nm).unwrap() - 1.0).abs() < 0.0021, "{nm}");
        }
    }

    #[test]
    fn each_beam_is_brightest_in_its_colour() {
        let beams = Printer::default().beams().unwrap();
        let peak = |beam: &SpectralDistribution<Power>| beam.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|p| p.0);
        assert!(peak(&beams.red).unwrap() > 640.0);
        assert!((520.0..570.0).contains(&peak(&beams.green).unwrap()));
        assert!(peak(&beams.blue).unwrap() < 480.0);
    }
}
