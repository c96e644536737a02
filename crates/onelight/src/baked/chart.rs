//! What a look does, drawn: greys, hues, curves and gamut on one sheet.

use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{Chromaticity, DisplayLinear, RgbSpace, TransferCurve};

use super::form::Baked;
use crate::error::Error;
use crate::scene::MID_GREY;

/// A sheet of what a baked look does, sRGB-coded: a grey ramp beside the same light clipped, ramps of six hues, circles of hue at three
/// exposures, the curves of greys, and where colours lie among the display's.
///
/// ```
/// use onelight::baked::{Chart, Recipe};
/// let baked = onelight::Process::default().look()?.baked(&Recipe::cube(17))?;
/// let chart = Chart::of(&baked)?;
/// assert_eq!(chart.pixels().len(), chart.size()[0] * chart.size()[1]);
/// assert!(chart.labels().iter().any(|(_, text)| text.contains("greys")));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    size: [usize; 2],
    pixels: Vec<[u8; 3]>,
    labels: Vec<([usize; 2], String)>,
}

/// Width of the sheet and of its margins, height of a line of text, in pixels.
const WIDTH: usize = 996;
const MARGIN: usize = 12;
const LINE: usize = 24;
/// Width of ramps, and the side of the two plots.
const RAMP: usize = WIDTH - 2 * MARGIN;
const PLOT: usize = (RAMP - MARGIN) / 2;
/// Exposures of ramps and curves, in stops about mid grey.
const STOPS: (f64, f64) = (-8.0, 8.0);
/// Exposures of the circles of hue, in stops.
const CIRCLES: [f64; 3] = [0.0, 2.0, 4.0];
/// The corner of the CIE xy chart that the gamut is drawn in.
const XY: f64 = 0.9;
const BACKGROUND: [u8; 3] = [24, 24, 24];
const GRID: [u8; 3] = [64, 64, 64];
const INK: [u8; 3] = [200, 200, 200];
/// Lines for red, green and blue.
const CHANNELS: [[u8; 3]; 3] = [[255, 96, 96], [96, 224, 96], [112, 144, 255]];

impl Chart {
    /// Draws a look.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn of(look: &Baked) -> Result<Self, Error> {
        let shown = Shown::new(look)?;
        let hues = [[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]].map(|hue| hue.map(f64::from));
        let height = 4 * LINE + 48 + 24 + hues.len() * 24 + CIRCLES.len() * 24 + PLOT + MARGIN;
        let mut sheet = Self { size: [WIDTH, height], pixels: vec![BACKGROUND; WIDTH * height], labels: Vec::new() };
        let at = |x: usize| STOPS.0 + (STOPS.1 - STOPS.0) * x as f64 / (RAMP - 1) as f64;
        let grey = |x: usize| [MID_GREY * at(x).exp2(); 3];
        let mut top = LINE;
        sheet.label(
            [MARGIN, 4],
            format!("{}: greys from {:+} to {:+} stops, below them the light clipped", look.name(), STOPS.0, STOPS.1),
        );
        sheet.ramp(&mut top, 48, |x| shown.coded(grey(x)));
        sheet.ramp(&mut top, 24, |x| shown.clipped(grey(x)));
        sheet.label([MARGIN, top + 4], "primaries and secondaries over the same range".to_owned());
        top += LINE;
        for hue in hues {
            sheet.ramp(&mut top, 24, |x| shown.coded(hue.map(|v| v * MID_GREY * at(x).exp2())));
        }
        sheet.label([MARGIN, top + 4], format!("circles of hue at {CIRCLES:?} stops"));
        top += LINE;
        for stops in CIRCLES {
            sheet.ramp(&mut top, 24, |x| {
                shown.coded(hue_at(x as f64 / RAMP as f64).map(|v| v * MID_GREY * f64::exp2(stops)))
            });
        }
        sheet.label([MARGIN, top + 4], "display-coded greys over stops".to_owned());
        sheet.label([2 * MARGIN + PLOT, top + 4], "CIE xy of colours, and the display".to_owned());
        top += LINE;
        sheet.curves([MARGIN, top], |x| shown.codes([MID_GREY * (STOPS.0 + (STOPS.1 - STOPS.0) * x).exp2(); 3]));
        sheet.gamut([2 * MARGIN + PLOT, top], &shown);
        Ok(sheet)
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Rows from the top, sRGB-coded.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// What to write on it: left and upper edge of each line of text, which is at most 16 pixels high.
    #[must_use]
    pub fn labels(&self) -> &[([usize; 2], String)] {
        &self.labels
    }

    fn label(&mut self, at: [usize; 2], text: String) {
        self.labels.push((at, text));
    }

    fn set(&mut self, [x, y]: [usize; 2], colour: [u8; 3]) {
        if x < self.size[0] && y < self.size[1] {
            self.pixels[y * self.size[0] + x] = colour;
        }
    }

    fn ramp(&mut self, top: &mut usize, height: usize, colour: impl Fn(usize) -> [u8; 3]) {
        for x in 0..RAMP {
            let colour = colour(x);
            (*top..*top + height).for_each(|y| self.set([MARGIN + x, y], colour));
        }
        *top += height;
    }

    /// Codes of greys from 0 at the bottom to 1 at the top, with a grid of two stops and quarters.
    fn curves(&mut self, [left, top]: [usize; 2], codes: impl Fn(f64) -> [f64; 3]) {
        let last = (PLOT - 1) as f64;
        for i in 0..PLOT {
            for part in 0..=8 {
                self.set([left + (last * f64::from(part) / 8.0) as usize, top + i], GRID);
            }
            for part in 0..=4 {
                self.set([left + i, top + (last * f64::from(part) / 4.0) as usize], GRID);
            }
        }
        // Four points to the pixel: steep curves have no gaps.
        for i in 0..4 * PLOT {
            let x = i as f64 / (4 * PLOT - 1) as f64;
            for (code, ink) in codes(x).into_iter().zip(CHANNELS) {
                let y = (last * (1.0 - code.clamp(0.0, 1.0))).round() as usize;
                self.set([left + (last * x) as usize, top + y], ink);
            }
        }
    }

    /// Colours of all hues, saturations and exposures as points of the CIE xy chart, in the triangle of the display.
    fn gamut(&mut self, [left, top]: [usize; 2], shown: &Shown<'_>) {
        let last = (PLOT - 1) as f64;
        let place = |c: Chromaticity| {
            [
                left + (last * (c.x / XY).clamp(0.0, 1.0)) as usize,
                top + (last * (1.0 - (c.y / XY).clamp(0.0, 1.0))) as usize,
            ]
        };
        for step in 0..=9 {
            let offset = (last * f64::from(step) / 9.0) as usize;
            for i in 0..PLOT {
                self.set([left + offset, top + i], GRID);
                self.set([left + i, top + offset], GRID);
            }
        }
        let [r, g, b] = shown.space.primaries;
        for (from, to) in [(r, g), (g, b), (b, r)] {
            for i in 0..=2 * PLOT {
                let t = i as f64 / (2 * PLOT) as f64;
                self.set(place(Chromaticity::new(from.x + t * (to.x - from.x), from.y + t * (to.y - from.y))), INK);
            }
        }
        for hue in 0..180 {
            for saturation in [0.25, 0.5, 0.75, 1.0] {
                for stops in [-2.0, 0.0, 2.0, 4.0] {
                    let full = hue_at(f64::from(hue) / 180.0);
                    let rgb = full.map(|v| (1.0 - saturation + saturation * v) * MID_GREY * f64::exp2(stops));
                    let xyz = shown.to_xyz * Vector3::from(*shown.linear(rgb));
                    if xyz.sum() > 0.0 {
                        self.set(place(Chromaticity::of(&xyz)), shown.coded(rgb));
                    }
                }
            }
        }
    }
}

/// A look as it is seen on an sRGB sheet.
struct Shown<'a> {
    look: &'a Baked,
    space: RgbSpace,
    /// From display-linear RGB of the output: tristimulus values, and sRGB.
    to_xyz: Matrix3<f64>,
    to_srgb: Matrix3<f64>,
    /// From scene-linear RGB in sRGB primaries to those of the input.
    to_input: Matrix3<f64>,
}

impl<'a> Shown<'a> {
    fn new(look: &'a Baked) -> Result<Self, Error> {
        let (spaces, white) = (look.spaces(), Chromaticity::black_body_6500_k());
        let space = spaces.output_space.space();
        Ok(Self {
            look,
            space,
            to_xyz: space.to_xyz()?,
            to_srgb: space.to_about(&RgbSpace::SRGB, Chromaticity::D65)?,
            to_input: RgbSpace::SRGB.to_about(&spaces.input_space.space(), white)?,
        })
    }

    fn codes(&self, rgb: [f64; 3]) -> [f64; 3] {
        let input = self.to_input * Vector3::from(rgb);
        self.look.apply([input.x, input.y, input.z].map(|v| v as f32)).map(f64::from)
    }

    fn linear(&self, rgb: [f64; 3]) -> DisplayLinear {
        self.look.coding().decode_rgb(self.codes(rgb))
    }

    fn coded(&self, rgb: [f64; 3]) -> [u8; 3] {
        let srgb = self.to_srgb * Vector3::from(*self.linear(rgb));
        eight_bits([srgb.x, srgb.y, srgb.z])
    }

    fn clipped(&self, rgb: [f64; 3]) -> [u8; 3] {
        eight_bits(rgb)
    }
}

fn eight_bits(linear: [f64; 3]) -> [u8; 3] {
    linear.map(|v| (TransferCurve::Srgb.encode(v).clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// Red, yellow, green, cyan, blue, magenta and red again, for 0 to 1.
fn hue_at(turn: f64) -> [f64; 3] {
    [0.0, 2.0, 4.0].map(|shift| (((turn * 6.0 + 6.0 - shift) % 6.0 - 3.0).abs() - 1.0).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baked::Recipe;
    use crate::{Process, ToneMapping, ToneProcess};

    #[test]
    fn hues_go_round() {
        for (sixth, hue) in [[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]].into_iter().enumerate() {
            let found = hue_at(sixth as f64 / 6.0);
            assert!((0..3).all(|c| (found[c] - f64::from(hue[c])).abs() < 1e-12), "{sixth}: {found:?}");
        }
    }

    /// Of a look that does nothing, what is drawn is known.
    #[test]
    fn a_look_that_clips_is_drawn_as_light_clipped() {
        let process = Process::from(ToneProcess { mapping: ToneMapping::Clip, ..ToneProcess::default() });
        let baked = process.look().unwrap().baked(&Recipe::cube(33)).unwrap();
        let chart = Chart::of(&baked).unwrap();
        let [width, height] = chart.size();
        let pixel = |x: usize, y: usize| chart.pixels()[y * width + x];
        for x in (MARGIN..WIDTH - MARGIN).step_by(37) {
            let (shown, light) = (pixel(x, LINE + 10), pixel(x, LINE + 48 + 10));
            assert!((0..3).all(|c| shown[c].abs_diff(light[c]) <= 2), "{x}: {shown:?} {light:?}");
            assert!(shown[0] == shown[1] && shown[1] == shown[2], "{shown:?}");
        }
        let row: Vec<u8> = (MARGIN..WIDTH - MARGIN).map(|x| pixel(x, LINE + 10)[1]).collect();
        assert!(row.is_sorted() && row[0] < 10 && row[RAMP - 1] == 255);
        // The curve of greys ends at the upper right of its plot; all text lies on the sheet.
        let top = height - MARGIN - PLOT;
        assert!(CHANNELS.contains(&pixel(MARGIN + PLOT - 2, top)));
        assert!(chart.labels().iter().all(|([x, y], text)| x + 8 * text.len() < width && y + 16 <= height));
    }
}
