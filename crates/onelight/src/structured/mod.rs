//! The structured form of a process: the film's own curves as the axes of a table.

mod axes;
mod first_steps;

use nalgebra::{Matrix3, Vector3};
use onelight_film::{DyeAmount, LogExposure, PerLayer};
use onelight_lut::{
    Decode, Expose, FitSample, FitSettings, IDENTITY, Interpolation, Lut3d, PowerCoding, SceneSampler, StructuredLut,
    StructuredParts, fit,
};
use onelight_spectra::{DisplayLinear, TransferCurve};
use rayon::prelude::*;

use crate::error::{Error, ErrorKind};
use crate::positive::Positive;
use crate::reference::Reference;
use crate::word::{Word as _, words};
use axes::{Axes, is_one_layer};
pub(crate) use first_steps::over_log2;
use first_steps::rows;

/// Where the entries of a table come from.
///
/// ```
/// use onelight::{Entries, Word};
/// assert_eq!((Entries::default(), Entries::Sampled.word()), (Entries::Fitted, "sampled"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Entries {
    /// The film's result at each node.
    Sampled,
    /// Moved so that what is read between nodes comes nearest to the film, over colours of all exposures and saturations:
    /// lowers the mean difference to about a half and the largest to a third.
    #[default]
    Fitted,
}

/// What the entries of a table are.
///
/// ```
/// use onelight::{TableCoding, Word};
/// assert_eq!((TableCoding::default(), TableCoding::Display.word()), (TableCoding::Density, "display"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TableCoding {
    /// -log10 of tristimulus values: most accurate in 16 bits and more.
    #[default]
    Density,
    /// Display-coded RGB: better in 10 bits and fewer, and nothing to decode.
    Display,
}

words! {
    Entries, "entries":
        Entries::Sampled = "sampled" "the film's result at each node",
        Entries::Fitted = "fitted" "moved so that what is read between nodes comes nearest to the film";
    TableCoding, "coding":
        TableCoding::Density = "density" "densities: the most accurate in 16 bits and more",
        TableCoding::Display = "display" "display-coded colours: better in 10 bits and fewer";
}

/// How [`Reference::structured`] makes a table.
///
/// ```
/// use onelight::{StructuredSettings, TableCoding};
/// let phone = StructuredSettings { size: 16, coding: TableCoding::Display, ..StructuredSettings::default() };
/// assert!(phone.size < StructuredSettings::default().size);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructuredSettings {
    /// Nodes along each side of the table, 2 to [`Lut3d::MAX_SIZE`].
    pub size: usize,
    /// How the table will be read.
    pub interpolation: Interpolation,
    /// Where its entries come from.
    pub entries: Entries,
    /// What the entries of the table are; always [`TableCoding::Display`] for a scan, whose black is no light at all and has no density.
    pub coding: TableCoding,
}

impl Default for StructuredSettings {
    fn default() -> Self {
        Self {
            size: 32,
            interpolation: Interpolation::default(),
            entries: Entries::default(),
            coding: TableCoding::default(),
        }
    }
}

/// Exposures that a table is fitted to, in stops about mid grey.
const FIT_STOPS: (f64, f64) = (-10.0, 10.0);
/// Colours for the fit are drawn from their own sequence, not that of a certificate.
const FIT_SEED: u64 = 0x666d_6669_745f_3031;
/// Colours for each node, and the fewest and most in all.
const FIT_SAMPLES_PER_NODE: usize = 4;
const FIT_SAMPLES: (usize, usize) = (1 << 14, 1 << 18);
/// Densities end here: 10^-9 of the lamp.
const DENSITY_MAX: f64 = 9.0;
/// Taken off the densities in the table, so that those of bright and middle colours lie near 0, where 16-bit floats are fine:
/// halves what they cost. The decoding matrix makes up for it.
const DENSITY_ORIGIN: f64 = 0.5;

impl Reference {
    /// The structured form: unlimited scene range, one fetch from a small table.
    ///
    /// The first curves are the camera film's own, from log exposure to dye. On a negative the dye amounts are mixed to the
    /// log exposure of the print, which an affine map gives to 0.02 log10, and the second curves are the print's. What is left
    /// for the table is nearly linear in density.
    ///
    /// ```
    /// let film = onelight::Process::for_camera("fuji-velvia-50")?.compile()?;
    /// let settings = onelight::StructuredSettings { size: 8, ..Default::default() };
    /// let lut = film.structured(&settings)?;
    /// let (exact, fast) = (film.develop([0.5, 0.2, 40.0]), lut.apply([0.5, 0.2, 40.0]));
    /// assert!((exact[2] - f64::from(fast[2])).abs() < 0.02);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the size is out of bounds.
    pub fn structured(&self, settings: &StructuredSettings) -> Result<StructuredLut, Error> {
        let axes = Axes::new(self)?;
        let entries = match self.positive() {
            Positive::Scan(_) => TableCoding::Display,
            Positive::Itself | Positive::Print(_) => settings.coding,
        };
        let encode = Encode { film: self, coding: entries };
        let table = encode.sampled(&axes, settings.size)?;
        let decode = match entries {
            TableCoding::Display => Decode::Coded,
            TableCoding::Density => {
                Decode::Density { matrix: rows(&self.rgb_from_entries()), coding: coding(self.coding().curve)? }
            }
        };
        let parts = StructuredParts {
            expose: Expose { input: IDENTITY, ..self.expose() },
            develop: axes.develop.clone(),
            mix: axes.mix()?,
            table,
            decode,
            interpolation: settings.interpolation,
        };
        // Fitted on colours in sRGB primaries: what the input matrix and the clamp leave.
        let lut = StructuredLut::new(parts)?;
        let lut = match settings.entries {
            Entries::Sampled => lut,
            Entries::Fitted => {
                let fitted = encode.fitted(&lut, settings.interpolation)?;
                lut.with_table(if is_one_layer(self) { monotone_diagonal(&fitted)? } else { fitted })
            }
        };
        Ok(StructuredLut::new(StructuredParts { expose: self.expose(), ..lut.parts().clone() })?)
    }

    /// From 10^-entry to linear RGB.
    fn rgb_from_entries(&self) -> Matrix3<f64> {
        self.rgb_from_light() * 10f64.powf(-DENSITY_ORIGIN)
    }
}

/// The entries of a film's table.
struct Encode<'a> {
    film: &'a Reference,
    coding: TableCoding,
}

impl Encode<'_> {
    fn sampled(&self, axes: &Axes, size: usize) -> Result<Lut3d, Error> {
        // Checks the size before anything is allocated.
        let nodes = Lut3d::identity(size)?;
        let positions: Vec<[f64; 3]> =
            (0..size).map(|i| [i as f64 / (size - 1) as f64; 3]).map(|t| axes.positions(t)).collect();
        let entry = |i: usize| {
            let node = [positions[i % size][0], positions[i / size % size][1], positions[i / size / size][2]];
            self.entry(axes.amounts(node))
        };
        Ok(Lut3d::new(size, (0..nodes.entries().len()).into_par_iter().map(entry).collect())?)
    }

    fn fitted(&self, lut: &StructuredLut, how: Interpolation) -> Result<Lut3d, Error> {
        let table = &lut.parts().table;
        let count = (FIT_SAMPLES_PER_NODE * table.entries().len()).clamp(FIT_SAMPLES.0, FIT_SAMPLES.1);
        let drawn = SceneSampler::with_seed(FIT_STOPS.0..=FIT_STOPS.1, FIT_SEED)?.take(count);
        let colours: Vec<[f64; 3]> = drawn.enumerate().map(|(i, rgb)| towards_the_edge(i, rgb)).collect();
        let samples: Vec<FitSample> = colours
            .par_iter()
            .map(|&rgb| {
                let exposure = self.film.exposure_matrix().expose(rgb).map(LogExposure::of);
                let target = self.entry(self.film.camera_amounts(exposure));
                FitSample { coordinates: lut.coordinates(rgb.map(|v| v as f32)), target }
            })
            .collect();
        let difference = self.film.difference()?;
        let to_rgb = self.film.rgb_from_entries();
        let linear = |entry: [f32; 3]| match self.coding {
            TableCoding::Display => self.film.coding().decode_rgb(entry.map(f64::from)),
            TableCoding::Density => {
                DisplayLinear((to_rgb * Vector3::from(entry.map(|d| 10f64.powf(-f64::from(d))))).into())
            }
        };
        let miss = |i: usize, value: [f32; 3]| difference.between(linear(samples[i].target), linear(value));
        Ok(fit(table, how, &samples, miss, FitSettings::default())?)
    }

    /// The entry for dye in the camera film.
    fn entry(&self, amounts: PerLayer<DyeAmount>) -> [f32; 3] {
        match self.coding {
            TableCoding::Display => self.film.coding().encode_rgb(self.film.develop_amounts(amounts)).map(|v| v as f32),
            TableCoding::Density => {
                let density = self.film.light_of_amounts(amounts).map(|v| (-v.log10()).min(DENSITY_MAX));
                density.map(|d| (d - DENSITY_ORIGIN) as f32)
            }
        }
    }
}

/// A table whose nodes on the diagonal never go back on the way from its first to its last: all that black and white reads, which a
/// fit by least squares bends back a little where the film's curve is flat.
fn monotone_diagonal(table: &Lut3d) -> Result<Lut3d, Error> {
    let (size, mut entries) = (table.size(), table.entries().collect::<Vec<_>>());
    let diagonal = 1 + size + size * size;
    let (first, last) = (entries[0], entries[(size - 1) * diagonal]);
    let mut before = first;
    for i in 1..size {
        let entry = &mut entries[i * diagonal];
        let held = |c: usize| if last[c] > first[c] { entry[c].max(before[c]) } else { entry[c].min(before[c]) };
        *entry = std::array::from_fn(held);
        before = *entry;
    }
    Ok(Lut3d::new(size, entries)?)
}

/// Every fourth colour is moved to full saturation and every sixteenth to a primary or secondary: the edges of what light
/// can reach, where chance seldom falls and differences are largest.
pub(crate) fn towards_the_edge(i: usize, rgb: [f64; 3]) -> [f64; 3] {
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| rgb[b].total_cmp(&rgb[a]));
    let [most, middle, least] = order;
    let mut moved = rgb;
    if i.is_multiple_of(4) {
        moved[least] = 0.0;
    }
    match i % 32 {
        0 => moved[middle] = 0.0,
        16 => moved[middle] = moved[most],
        _ => {}
    }
    moved
}

/// The transfer curve as the forms have it.
pub(crate) fn coding(curve: TransferCurve) -> Result<PowerCoding, Error> {
    match curve {
        TransferCurve::Linear => Ok(PowerCoding::LINEAR),
        TransferCurve::Srgb => Ok(PowerCoding::new(2.4, 0.055)?),
        TransferCurve::Gamma24 => Ok(PowerCoding::new(2.4, 0.0)?),
        TransferCurve::Gamma26 => Ok(PowerCoding::new(2.6, 0.0)?),
        TransferCurve::Pq | TransferCurve::Hlg => {
            let sentence = format!(
                "output_coding {} is no power, which is all that this form or file codes by, expected output_coding linear, a plain table, or a \
                 structured one of coding display",
                curve.word()
            );
            Err(ErrorKind::Contradiction(sentence).into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codings_are_those_of_the_reference() {
        for curve in [TransferCurve::Linear, TransferCurve::Srgb, TransferCurve::Gamma24, TransferCurve::Gamma26] {
            for i in -100..=1100 {
                let v = f64::from(i) / 1000.0;
                // sRGB rounds the slope of its foot.
                assert!((coding(curve).unwrap().encode(v) - curve.encode(v)).abs() < 2e-5, "{curve:?} {v}");
            }
        }
    }
}
