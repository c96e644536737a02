use std::fmt;
use std::str::FromStr;

use crate::constant::checked;
use crate::error::{Error, ErrorKind};

/// Widths of frames that are believed, in mm.
const WIDTHS_MM: [f64; 2] = [1.0, 500.0];
/// Pitches that are believed, in um: from a hundredth of a dye cloud's area to a picture of one pixel on the largest sheet film.
const PITCHES_UM: [f64; 2] = [0.75, 500_000.0];
/// Most characters of a word that a message repeats.
const SHOWN: usize = 40;

const NAMES: [(&str, FilmFormat); 6] = [
    ("super35", FilmFormat::Super35),
    ("academy", FilmFormat::Academy),
    ("super16", FilmFormat::Super16),
    ("super8", FilmFormat::Super8),
    ("still36", FilmFormat::Still36),
    ("65mm", FilmFormat::Film65),
];

/// How large the picture is on the film: decides how coarse grain and how wide halos are in pixels.
///
/// ```
/// use onelight_spatial::FilmFormat;
/// let pitch = FilmFormat::Super35.pitch(2048, 1.0)?;
/// assert!((pitch.x_um() - 12.158).abs() < 1e-3);
/// assert_eq!("10.26mm".parse(), Ok(FilmFormat::width(10.26)?));
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilmFormat {
    /// 35 mm film, full aperture: 24.9 mm wide.
    Super35,
    /// 35 mm film with room for sound: 21.95 mm.
    Academy,
    /// 16 mm film: 12.52 mm.
    Super16,
    /// 8 mm film: 5.79 mm.
    Super8,
    /// 35 mm still film: 36 mm.
    Still36,
    /// 65 mm film: 52.48 mm.
    Film65,
    /// Another width, in mm; made by [`FilmFormat::width`].
    Width(Millimetres),
}

/// A width between 1 and 500 mm.
///
/// ```
/// use onelight_spatial::FilmFormat;
/// assert_eq!(FilmFormat::width(24.9)?.width_mm(), 24.9);
/// assert!(FilmFormat::width(0.0).is_err() && FilmFormat::width(501.0).is_err());
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Millimetres(f64);

impl FilmFormat {
    /// A frame of a width of one's own.
    ///
    /// # Errors
    /// If the width is not between 1 and 500 mm.
    pub fn width(mm: f64) -> Result<Self, Error> {
        Ok(Self::Width(Millimetres(checked("width of the frame on film", mm, WIDTHS_MM, " mm")?)))
    }

    /// The formats that have a name, with it.
    ///
    /// ```
    /// use onelight_spatial::FilmFormat;
    /// assert!(FilmFormat::named().any(|(name, format)| name == "super8" && format.width_mm() == 5.79));
    /// ```
    pub fn named() -> impl Iterator<Item = (&'static str, Self)> {
        NAMES.into_iter()
    }

    /// Width of the frame in mm.
    #[must_use]
    pub fn width_mm(self) -> f64 {
        match self {
            Self::Super35 => 24.9,
            Self::Academy => 21.95,
            Self::Super16 => 12.52,
            Self::Super8 => 5.79,
            Self::Still36 => 36.0,
            Self::Film65 => 52.48,
            Self::Width(Millimetres(mm)) => mm,
        }
    }

    /// The size on film of a pixel of a picture that fills the frame with `width` pixels. `pixel_aspect` is a pixel's width over its
    /// height, on the film. A crop keeps the pitch of the whole frame.
    ///
    /// # Errors
    /// If a pixel is smaller than 0.75 um or larger than 500 mm on the film, or the aspect is not between 1/8 and 8.
    pub fn pitch(self, width: usize, pixel_aspect: f64) -> Result<Pitch, Error> {
        let aspect = checked("pixel aspect", pixel_aspect, [0.125, 8.0], "")?;
        let x = 1000.0 * self.width_mm() / width as f64;
        Pitch::new(x, x / aspect)
    }
}

impl fmt::Display for FilmFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match NAMES.iter().find(|(_, format)| format == self) {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "{}mm", self.width_mm()),
        }
    }
}

impl FromStr for FilmFormat {
    type Err = Error;

    /// A name as [`FilmFormat`] displays it, or a width such as `24.9mm`.
    fn from_str(text: &str) -> Result<Self, Error> {
        if let Some((_, format)) = NAMES.iter().find(|(name, _)| *name == text) {
            return Ok(*format);
        }
        match text.strip_suffix("mm").map(|number| number.trim().parse::<f64>()) {
            Some(Ok(mm)) => Self::width(mm),
            _ => {
                let expected = NAMES.map(|(name, _)| name).join(", ");
                let found = text.chars().filter(|c| !c.is_control()).take(SHOWN).collect();
                Err(ErrorKind::Format { found, expected }.into())
            }
        }
    }
}

/// The size of a pixel on the film, in um.
///
/// ```
/// use onelight_spatial::Pitch;
/// assert_eq!(Pitch::new(6.0, 12.0)?.x_um(), 6.0);
/// assert!(Pitch::new(0.01, 0.01).is_err());
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pitch {
    x_um: f64,
    y_um: f64,
}

impl Pitch {
    /// From width and height of a pixel.
    ///
    /// # Errors
    /// If one is not between 0.75 um and 500 mm.
    pub fn new(x_um: f64, y_um: f64) -> Result<Self, Error> {
        let checked = |um| checked("size of a pixel on film", um, PITCHES_UM, " um");
        Ok(Self { x_um: checked(x_um)?, y_um: checked(y_um)? })
    }

    /// Width of a pixel.
    #[must_use]
    pub fn x_um(self) -> f64 {
        self.x_um
    }

    /// Height of a pixel.
    #[must_use]
    pub fn y_um(self) -> f64 {
        self.y_um
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_widths_are_read_as_they_are_shown() {
        for format in NAMES.map(|(_, format)| format).into_iter().chain([FilmFormat::width(9.35).unwrap()]) {
            assert_eq!(format.to_string().parse(), Ok(format));
        }
        for wrong in ["", "mm", "0mm", "-3mm", "nanmm", "1e9mm", "35", "Super35"] {
            assert!(wrong.parse::<FilmFormat>().is_err(), "{wrong}");
        }
        let message = "x\u{7}".repeat(500).parse::<FilmFormat>().unwrap_err().to_string();
        assert!(message.len() < 200 && !message.contains(char::is_control), "{message}");
    }

    #[test]
    fn a_crop_and_a_wide_pixel() {
        let pitch = FilmFormat::Super35.pitch(4096, 2.0).unwrap();
        assert_eq!(pitch.y_um() * 2.0, pitch.x_um());
        assert!(FilmFormat::Super35.pitch(0, 1.0).is_err());
        assert!(FilmFormat::Super35.pitch(100, f64::NAN).is_err());
        assert_eq!(FilmFormat::Still36.pitch(1, 1.0).unwrap().x_um(), 36000.0);
    }
}
