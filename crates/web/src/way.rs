//! Where a colour comes from: every value on its way, and the curves that it meets.

use onelight::film::{AmountCurve, DyeAmount, LogExposure, PerLayer};
use onelight::spectra::Basis;
use onelight::{Image, Process, Reconstruction, Reference};
use serde::Serialize;

use crate::error::Error;
use crate::film_look::FilmLook;

/// Points of a curve that is drawn.
const POINTS: usize = 97;
/// Of a spectrum's values, every so many are drawn: 5 nm.
const EVERY: usize = 5;

/// One colour from the scene to the screen.
///
/// ```
/// use onelight_web::{FilmLook, Keys, Way};
/// let look = FilmLook::new(&Keys::from_json("{}")?)?;
/// let way = Way::of(&look, [0.18; 3])?;
/// assert_eq!(way.codes, [123, 123, 123]);
/// // A negative and its print: both have curves to draw the points on.
/// assert!(way.print.is_some_and(|print| print.curves[0].x.len() == way.camera.curves[0].x.len()));
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[derive(Debug, Clone, Serialize)]
pub struct Way {
    /// Scene-linear RGB of sRGB's primaries.
    pub scene: [f64; 3],
    /// The spectrum that it stands for: relative power.
    pub light: Spectrum,
    /// The film in the camera.
    pub camera: Developed,
    /// The film or paper that it is printed on.
    pub print: Option<Developed>,
    /// The light from the screen: relative power.
    pub projected: Spectrum,
    /// Its tristimulus values; Y of the bare lamp is 1.
    pub xyz: [f64; 3],
    /// Display-linear RGB.
    pub linear: [f64; 3],
    /// Display codes of 8 bits.
    pub codes: [u8; 3],
}

/// Values over even steps of wavelength.
#[derive(Debug, Clone, Serialize)]
pub struct Spectrum {
    /// The first wavelength in nm.
    pub first_nm: f64,
    /// Nanometres from one value to the next.
    pub step_nm: f64,
    /// The values.
    pub values: Vec<f64>,
}

/// One film's part: three layers, red, green and blue by the light that they record.
#[derive(Debug, Clone, Serialize)]
pub struct Developed {
    /// Layers that differ from each other: 3, or 1 in black and white.
    pub layers: usize,
    /// log10 exposure of each layer.
    pub exposure: [f64; 3],
    /// The exposure at which its curve is read: the other layers have moved it.
    pub effective: [f64; 3],
    /// Amounts of dye, in units of the data sheet's.
    pub amounts: [f64; 3],
    /// Amount of dye over effective log10 exposure, to be drawn.
    pub curves: [Points; 3],
    /// Where an 18 % grey card lies.
    pub grey: [f64; 3],
}

/// A curve as points.
#[derive(Debug, Clone, Serialize)]
pub struct Points {
    /// log10 exposure, increasing.
    pub x: Vec<f64>,
    /// Amount of dye.
    pub y: Vec<f64>,
}

impl Way {
    /// The way of a scene-linear colour in the look's input space.
    ///
    /// # Errors
    /// Those of [`FilmLook::exact`], and a look without film.
    pub fn of(look: &FilmLook, rgb: [f64; 3]) -> Result<Self, Error> {
        let film = look.exact()?.film()?;
        let stages = film.stages(rgb);
        let reconstruction = match look.process() {
            Process::Film(film) => film.reconstruction,
            Process::First(_) | Process::Print(_) | Process::Tone(_) => Reconstruction::default(),
        };
        let light = Basis::new(reconstruction)?.spectrum(stages.scene);
        let camera = Developed {
            layers: layers(look, Process::camera)?,
            exposure: logs(stages.exposure),
            effective: logs(stages.effective),
            amounts: dyes(stages.amounts),
            curves: film.camera_curves().map(points).to_array(),
            grey: logs(film.inter_image().effective(film.mid_grey())),
        };
        let print = stages.print.zip(printed(film)).map(|(print, (curves, target))| {
            let exposure = logs(print.exposure);
            Ok::<_, Error>(Developed {
                layers: layers(look, Process::print)?,
                exposure,
                effective: exposure,
                amounts: dyes(print.amounts),
                curves: curves.map(points).to_array(),
                grey: logs(target),
            })
        });
        let spectrum = |shape: onelight::spectra::SpectralShape, values: &[f64]| {
            let mut nm = shape.wavelengths_nm();
            let (first, second) = (nm.next().unwrap_or_default(), nm.next().unwrap_or_default());
            let values = values.iter().step_by(EVERY).copied().collect();
            Spectrum { first_nm: first, step_nm: EVERY as f64 * (second - first), values }
        };
        Ok(Self {
            scene: stages.scene,
            light: spectrum(light.shape(), light.values()),
            camera,
            print: print.transpose()?,
            projected: spectrum(stages.spectrum.shape(), stages.spectrum.values()),
            xyz: stages.xyz,
            linear: *stages.linear,
            codes: stages.coded.map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8),
        })
    }
}

/// How many layers of a look's film differ.
fn layers(look: &FilmLook, film: impl Fn(&Process) -> Option<&onelight::StockRef>) -> Result<usize, Error> {
    let image = film(look.process()).map(|film| onelight::stock(film.id())).transpose()?.map(|stock| stock.image());
    Ok(if image == Some(Image::Silver) { 1 } else { 3 })
}

fn printed(film: &Reference) -> Option<(PerLayer<&AmountCurve>, PerLayer<LogExposure>)> {
    film.print_curves().zip(film.print_target())
}

fn logs(layers: PerLayer<LogExposure>) -> [f64; 3] {
    layers.map(|h| h.0).to_array()
}

fn dyes(layers: PerLayer<DyeAmount>) -> [f64; 3] {
    layers.map(|amount| amount.0).to_array()
}

/// A curve over its range and a little beyond, where it is flat.
fn points(curve: &AmountCurve) -> Points {
    let (start, end) = (curve.range().start().0, curve.range().end().0);
    let room = 0.05 * (end - start);
    let (start, end) = (start - room, end + room);
    let x: Vec<f64> = (0..POINTS).map(|i| start + (end - start) * i as f64 / (POINTS - 1) as f64).collect();
    let y = x.iter().map(|x| curve.amount(LogExposure(*x)).0).collect();
    Points { x, y }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::Keys;

    #[test]
    fn points_lie_on_their_curves() {
        let keys = r#"{ "camera": "kodak-portra-400", "print": "kodak-endura-premier", "interimage": "none" }"#;
        let look = FilmLook::new(&Keys::from_json(keys).unwrap()).unwrap();
        let way = Way::of(&look, [0.6, 0.2, 0.05]).unwrap();
        for film in [&way.camera, way.print.as_ref().unwrap()] {
            assert_eq!((film.layers, film.exposure), (3, film.effective));
            for layer in 0..3 {
                let Points { x, y } = &film.curves[layer];
                let next = x.iter().position(|x| *x > film.effective[layer]).unwrap_or(POINTS - 1).max(1);
                let between = |a: f64, b: f64, v: f64| (a.min(b) - 1e-9..=a.max(b) + 1e-9).contains(&v);
                assert!(between(y[next - 1], y[next], film.amounts[layer]), "{layer}: {:?}", film.amounts);
            }
        }
        assert_eq!((way.light.first_nm, way.projected.values.len()), (380.0, 81));
    }

    #[test]
    fn black_and_white_has_one_layer() {
        let keys = Keys::from_json(r#"{ "camera": "kodak-tri-x-400" }"#).unwrap().fitting().unwrap();
        let way = Way::of(&FilmLook::new(&keys).unwrap(), [0.18; 3]).unwrap();
        assert_eq!((way.camera.layers, way.print.map(|print| print.layers)), (1, Some(1)));
    }
}
