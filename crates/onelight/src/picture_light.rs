//! From the values of a picture file to the light that meets a film.

use nalgebra::{Matrix3, Vector3};
use onelight_picture::{
    Band, Chromaticities, Description, RowMut, Source, StoredAlpha, TiffSamples, Transfer, Tristimulus,
};
use onelight_spectra::{Chromaticity, RgbSpace, TransferCurve, finite};
use rayon::prelude::*;

use crate::code_light::{CodeLight, looked_up};
use crate::error::Error;
use crate::input_coding::InputCoding;
use crate::meter::Meter;
use crate::picture_colours::space_of;
use crate::picture_coverage::Coverage;
use crate::picture_notes::{LightNote, LightSetting};
use crate::process::ColourSpaces;
use crate::word::{Word as _, words};

/// What is known better than the file says it; [`InputColours::default`] believes the file.
///
/// ```
/// use onelight::{InputColours, InputCoding, Word};
/// let log = InputColours { coding: Some(InputCoding::parse("logc3")?), ..InputColours::default() };
/// assert_ne!(log, InputColours::default());
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InputColours {
    /// How the numbers are coded; a camera's curve brings its primaries where those are [`InputPrimaries::OfFile`].
    pub coding: Option<InputCoding>,
    /// Whose word counts for the primaries.
    pub primaries: InputPrimaries,
    /// What (1, 1, 1) of the picture's space is; `None` takes XYZ absolutely and all others relatively.
    pub white: Option<InputWhite>,
}

/// Whose word counts for the primaries of a picture.
///
/// ```
/// assert_eq!(onelight::InputPrimaries::default(), onelight::InputPrimaries::OfFile);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InputPrimaries {
    /// The file's, and the look's where it says nothing.
    #[default]
    OfFile,
    /// Those of the look, whatever the file says.
    OfLook,
}

/// What (1, 1, 1) of a picture's space is.
///
/// ```
/// use onelight::{InputWhite, Word};
/// assert_eq!(InputWhite::parse("absolute")?, InputWhite::Absolute);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputWhite {
    /// White, whatever the white of the space: pictures are balanced to their spaces.
    Relative,
    /// Light of that chromaticity, seen beside D65: one light is one colour in every space.
    Absolute,
}

words! {
    InputWhite, "input_white":
        InputWhite::Relative = "relative" "white, whatever the white of the space: pictures are balanced to their spaces",
        InputWhite::Absolute = "absolute" "light of that chromaticity, seen beside D65: one light is one colour in every space";
}

impl InputColours {
    /// The primaries of the file, as far as they count.
    #[must_use]
    pub fn primaries_of<'a>(&self, picture: &'a Description) -> Option<&'a Chromaticities> {
        let is_of_file = self.primaries == InputPrimaries::OfFile && !self.has_own_space();
        picture.primaries.as_ref().filter(|_| is_of_file)
    }

    /// Whether the coding decides the primaries.
    #[must_use]
    pub fn has_own_space(&self) -> bool {
        self.own_space().is_some() || self.coding == Some(InputCoding::Cineon)
    }

    fn own_space(&self) -> Option<RgbSpace> {
        self.coding.filter(|_| self.primaries == InputPrimaries::OfFile).and_then(InputCoding::space)
    }

    fn coding_of(&self, picture: &Description) -> Coding {
        match (self.coding, &picture.transfer) {
            (Some(InputCoding::Display(_)), None) if picture.source == Source::Exr => Coding::Of(Transfer::Linear),
            (Some(coding), _) => Coding::Named(coding),
            (None, Some(transfer)) => Coding::Of(transfer.clone()),
            (None, None) if holds_floats(picture) => Coding::Of(Transfer::Linear),
            (None, None) => Coding::Of(Transfer::Srgb),
        }
    }

    /// From a picture's primaries to those of a look; `None` where they are the same.
    fn to_input_space(self, picture: &Description, spaces: &ColourSpaces) -> Result<Option<Matrix3<f64>>, Error> {
        let (look, white) = (spaces.input_space.space(), Chromaticity::black_body_6500_k());
        let of_file = self.primaries_of(picture);
        let own = self.own_space().or_else(|| of_file.map(space_of));
        let is_xyz = of_file.is_some() && picture.tristimulus == Tristimulus::Xyz;
        let usual = if is_xyz { InputWhite::Absolute } else { InputWhite::Relative };
        match self.white.unwrap_or(usual) {
            // The picture's white is taken for the scene's: primaries count, the white point does not.
            InputWhite::Relative => Ok(own.map(|own| own.to_about(&look, white)).transpose()?),
            InputWhite::Absolute => {
                let to_srgb = RgbSpace::SRGB.from_xyz()? * own.unwrap_or(look).to_xyz()?;
                Ok(Some(RgbSpace::SRGB.to_about(&look, white)? * to_srgb))
            }
        }
    }

    /// What is taken for granted of a picture, and what its file says and is believed: a sentence each, for the user.
    #[must_use]
    pub fn notes(&self, picture: &Description, spaces: &ColourSpaces) -> Vec<LightNote> {
        let mut notes = Vec::new();
        if self.coding.is_none() && picture.transfer.is_none() {
            let unsaid = |text: &str| LightNote { text: text.to_owned(), decided_by: Some(LightSetting::Coding) };
            if !holds_floats(picture) {
                notes.push(unsaid("the file does not say how its integers are coded: taken for sRGB"));
            } else if matches!(picture.source, Source::Tiff { .. }) {
                notes.push(unsaid("the file does not say what its floats are: taken for linear light"));
            }
        }
        notes.extend(self.said_by_file(picture).map(|text| LightNote { text, decided_by: None }));
        let is_linear = matches!(picture.source, Source::Exr | Source::Tiff { samples: TiffSamples::Float, .. });
        let is_named =
            self.primaries == InputPrimaries::OfLook || self.coding.is_some_and(|coding| coding.space().is_some());
        if picture.source == Source::Jpeg {
            let text = "a JPEG is a finished picture: its coding is undone, what the camera made of the scene is not";
            notes.push(LightNote { text: text.to_owned(), decided_by: None });
        } else if is_linear && picture.primaries.is_none() && !is_named {
            let text = format!("the file names no primaries: taken for those of {}", spaces.input_space.word());
            notes.push(LightNote { text, decided_by: Some(LightSetting::Primaries) });
        }
        notes
    }

    /// What a file says of its colours and is believed.
    fn said_by_file(&self, picture: &Description) -> Option<String> {
        let said_by = picture.colours_said_by.as_ref()?;
        let transfer = picture.transfer.as_ref().filter(|_| self.coding.is_none()).map(|transfer| match transfer {
            Transfer::Linear => "linear".to_owned(),
            Transfer::Srgb => "sRGB-coded".to_owned(),
            Transfer::Power(power) => format!("coded by a power of 1/{power:.4}"),
            Transfer::Bt709 => "coded by BT.709's camera curve".to_owned(),
            Transfer::Pq => "PQ-coded, white at 203 cd/m2".to_owned(),
            Transfer::Hlg => "HLG-coded, white at 75 %".to_owned(),
            Transfer::Curves(_) => "coded by curves of its own".to_owned(),
        });
        let of_file = self.primaries == InputPrimaries::OfFile
            && self.coding.is_none_or(|coding| matches!(coding, InputCoding::Display(_)));
        let primaries = picture.primaries.filter(|_| of_file).map(|own| {
            let named = [
                (Chromaticities::BT709, "sRGB primaries"),
                (Chromaticities::P3_D65, "Display P3 primaries"),
                (Chromaticities::P3_DCI, "DCI-P3 primaries"),
                (Chromaticities::BT2020, "BT.2020 primaries"),
                (Chromaticities::ADOBE_RGB, "Adobe RGB primaries"),
                (Chromaticities::AP1, "ACEScg primaries"),
                (Chromaticities::AP0, "ACES2065-1 primaries"),
                (Chromaticities::XYZ, "CIE XYZ"),
            ];
            named.iter().find(|(named, _)| named.is_near(&own)).map_or("primaries of its own", |(_, name)| name)
        });
        let said: Vec<&str> = primaries.into_iter().chain(transfer.as_deref()).collect();
        (!said.is_empty()).then(|| format!("read as {}, by {said_by}", said.join(", ")))
    }
}

/// Whether a picture's samples are light where its file does not say what they are.
fn holds_floats(picture: &Description) -> bool {
    matches!(picture.source, Source::Exr | Source::RadianceHdr | Source::Tiff { samples: TiffSamples::Float, .. })
}

/// How the values of a file become scene-linear light in a look's input space.
///
/// Values go one by one through the coding, over what lies behind them ([`Coverage`]), through what the caller makes of them (a camera, a
/// frame buffer; `None` leaves them), and from the file's primaries to the look's. A meter sees them before the last step.
///
/// ```
/// use std::io::Cursor;
/// use onelight::picture::{Limits, Picture, Source, open};
/// use onelight::{ColourSpaces, InputColours, LightSeen, PictureLight};
/// # let mut file = Cursor::new(Vec::new());
/// # Picture::opaque(3, 2, vec![[0.09; 3]; 6], Source::Exr).write_exr(&mut file, &[])?;
/// let mut picture = open(file, "grey.exr", Limits::default())?;
/// let light = PictureLight::new(picture.description(), &ColourSpaces::default(), &InputColours::default())?;
/// let mut seen = LightSeen::default();
/// while let Some(band) = picture.next_band()? {
///     light.expose(band, 1.0, None, Some(&mut seen));
///     assert!((band.rgb()[0][1] - 0.18).abs() < 1e-6);
/// }
/// assert!((seen.meter.exposure() - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PictureLight {
    /// What becomes of alpha: kept unless something else is set here.
    pub coverage: Coverage,
    coding: Coding,
    /// The light of codes, from the first large band on.
    codes: CodeLight,
    stored_alpha: StoredAlpha,
    /// From the file's primaries to those of the look; `None` where they are the same.
    to_input: Option<Matrix3<f64>>,
    /// Luminance of the file's primaries.
    luminance: Vector3<f64>,
}

/// How values are coded.
#[derive(Debug, Clone, PartialEq)]
enum Coding {
    Named(InputCoding),
    Of(Transfer),
}

/// What a caller makes of a pixel's light before the film gets it.
pub type SceneStep<'a> = &'a (dyn Fn([f32; 3]) -> [f32; 3] + Sync);

/// What was seen of a picture's light.
///
/// ```
/// assert_eq!(onelight::LightSeen::default().hard, 0);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LightSeen {
    /// Pixels that hold NaN or infinity.
    pub hard: usize,
    /// The luminance of all others that are covered.
    pub meter: Meter,
}

impl PictureLight {
    /// For a picture that goes into a look of these spaces.
    ///
    /// # Errors
    /// If the file's chromaticities make no colour space.
    pub fn new(picture: &Description, spaces: &ColourSpaces, input: &InputColours) -> Result<Self, Error> {
        let to_input = input.to_input_space(picture, spaces)?;
        let to_xyz = spaces.input_space.space().with_white(Chromaticity::black_body_6500_k()).to_xyz()?;
        Ok(Self {
            codes: CodeLight::default(),
            coverage: Coverage::Kept,
            coding: input.coding_of(picture),
            stored_alpha: picture.stored_alpha,
            to_input: to_input.filter(|matrix| *matrix != Matrix3::identity()),
            luminance: (to_xyz * to_input.unwrap_or_else(Matrix3::identity)).row(1).transpose(),
        })
    }

    /// Makes light of a band's values, still in the file's primaries, and shows it to a meter.
    pub fn measure(&self, band: &mut Band, scene: Option<SceneStep<'_>>, seen: &mut LightSeen) {
        self.each_row(band, scene, Some(seen), |_| {});
    }

    /// The same, then converts it and makes it `ev` stops brighter.
    pub fn expose(&self, band: &mut Band, ev: f64, scene: Option<SceneStep<'_>>, seen: Option<&mut LightSeen>) {
        let scale = ev.exp2();
        match self.to_input {
            // NaN and infinity stay in their channels: only the film says what they mean.
            None if scale == 1.0 => self.each_row(band, scene, seen, |_| {}),
            None => self.each_row(band, scene, seen, |rgb| *rgb = rgb.map(|v| (f64::from(v) * scale) as f32)),
            Some(matrix) => {
                let matrix = matrix * scale;
                self.each_row(band, scene, seen, |rgb| {
                    let own = Vector3::from(rgb.map(|v| finite(f64::from(v))));
                    *rgb = <[f64; 3]>::from(matrix * own).map(|v| v as f32);
                });
            }
        }
    }

    fn each_row(
        &self,
        band: &mut Band,
        scene: Option<SceneStep<'_>>,
        seen: Option<&mut LightSeen>,
        change: impl Fn(&mut [f32; 3]) + Sync,
    ) {
        let is_large = band.width() * band.rows() >= CodeLight::COUNT;
        let codes = (is_large && !self.coding.is_linear()).then(|| self.codes.made(|rgb| self.coding.light(rgb)));
        let rows = band.rows_mut().map(|mut row| {
            if let Some(codes) = codes {
                row.rgb
                    .iter_mut()
                    .for_each(|rgb| *rgb = looked_up(codes, *rgb).unwrap_or_else(|| self.coding.light(*rgb)));
            } else if !self.coding.is_linear() {
                row.rgb.iter_mut().for_each(|rgb| *rgb = self.coding.light(*rgb));
            }
            self.coverage.apply(&mut row, self.stored_alpha);
            if let Some(scene) = scene {
                row.rgb.iter_mut().for_each(|rgb| *rgb = scene(*rgb));
            }
            let seen = seen.is_some().then(|| self.look_at(&row));
            row.rgb.iter_mut().for_each(&change);
            seen
        });
        let rows: Vec<Option<RowLight>> = rows.collect();
        if self.coverage != Coverage::Kept {
            band.leave_out_alpha();
        }
        if let Some(seen) = seen {
            for row in rows.iter().flatten() {
                seen.hard += row.hard;
                row.logs.iter().for_each(|log2| seen.meter.add_log2(*log2));
            }
        }
    }

    fn look_at(&self, row: &RowMut<'_>) -> RowLight {
        let mut seen = RowLight { hard: 0, logs: Vec::with_capacity(row.rgb.len()) };
        let kept = self.coverage == Coverage::Kept;
        for (x, rgb) in row.rgb.iter().enumerate() {
            seen.hard += usize::from(rgb.iter().any(|v| !v.is_finite()));
            let luminance = self.luminance.dot(&Vector3::from(rgb.map(f64::from)));
            let covered = !kept || row.alpha.as_ref().is_none_or(|alpha| alpha[x] != 0.0);
            if covered && luminance > 0.0 && luminance.is_finite() {
                seen.logs.push(luminance.log2());
            }
        }
        seen
    }
}

/// What one row of a picture adds to [`LightSeen`].
struct RowLight {
    hard: usize,
    /// log2 luminance of its lit pixels.
    logs: Vec<f64>,
}

impl Coding {
    fn is_linear(&self) -> bool {
        matches!(self, Self::Named(InputCoding::Display(TransferCurve::Linear)) | Self::Of(Transfer::Linear))
    }

    fn light(&self, rgb: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Named(curve) => rgb.map(|v| curve.decode(f64::from(v)) as f32),
            Self::Of(transfer) => transfer.light(rgb),
        }
    }
}
