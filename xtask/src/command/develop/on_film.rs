//! Where a picture lies on the film.

use anyhow::{Context, Result, bail};
use clap::Args;
use onelight::FilmEffects;
use onelight::spatial::Frame;
use onelight_picture::Description;

/// A picture that is part of a larger frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Args)]
#[command(next_help_heading = "Picture as part of a frame, for --film-format")]
pub(crate) struct OnFilm {
    /// Width in pixels of the whole frame that fills the film format [default: that of the picture; of an EXR's display window]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(1..))]
    frame_width: Option<u32>,
    /// Where the picture's first pixel lies in the whole frame: grain of a crop is then that of the whole [default: 0,0; an EXR's
    /// data window adds its own place]
    #[arg(long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    frame_offset: Option<Place>,
}

/// Pixels to the right and down.
type Place = [i32; 2];

fn place(text: &str) -> Result<Place, String> {
    let place = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    place.ok_or_else(|| "expected whole pixels to the right and down, such as 1024,0".to_owned())
}

impl OnFilm {
    /// Refuses a place on a film of unknown size.
    pub(super) fn check(&self, effects: Option<&FilmEffects>) -> Result<()> {
        let option = self.frame_width.map(|_| "--frame-width").or(self.frame_offset.map(|_| "--frame-offset"));
        match option {
            Some(option) if effects.is_none() => {
                bail!("{option} changes nothing without --film-format, expected both or neither")
            }
            _ => Ok(()),
        }
    }

    /// The picture's pixels on the film, as the frame of this number.
    pub(super) fn frame(&self, effects: &FilmEffects, picture: &Description, number: u32) -> Result<Frame> {
        let windows = &picture.windows;
        let width = self.frame_width.map_or(windows.display_size[0], |width| width as usize);
        let pitch = effects.pitch(width, f64::from(windows.pixel_aspect))?;
        let [x, y] = self.frame_offset.unwrap_or_default();
        let of = |axis: usize, own: i32| {
            let place = i64::from(windows.data_origin[axis]) - i64::from(windows.display_origin[axis]) + i64::from(own);
            i32::try_from(place).context("the picture lies further from its frame's origin than 2^31 pixels")
        };
        Ok(Frame::new([picture.width, picture.height], pitch)?.at([of(0, x)?, of(1, y)?]).numbered(number))
    }
}

#[cfg(test)]
mod tests {
    use onelight::spatial::FilmFormat;
    use onelight::{Effects, FilmProcess};
    use onelight_picture::{Channels, Source, Windows};

    use super::*;

    fn effects() -> FilmEffects {
        let effects = Effects { film_format: Some(FilmFormat::Super35), ..Effects::default() };
        FilmEffects::new(&FilmProcess { effects, ..FilmProcess::default() }).unwrap().unwrap()
    }

    #[test]
    fn a_data_window_and_an_offset_are_places_in_the_frame() {
        let windows = Windows { data_origin: [90, 45], display_origin: [-10, 5], ..Windows::of_size(2048, 1152) };
        let picture = Description { windows, ..Description::new(200, 100, Channels::Rgb, Source::Exr) };
        let none = OnFilm { frame_width: None, frame_offset: None };
        let frame = none.frame(&effects(), &picture, 7).unwrap();
        assert_eq!((frame.offset(), frame.number(), frame.width()), ([100, 40], 7, 200));
        assert_eq!(frame.pitch(), FilmFormat::Super35.pitch(2048, 1.0).unwrap());
        // The same part as a file of its own.
        let alone = Description::new(200, 100, Channels::Rgb, Source::Exr);
        let part = OnFilm { frame_width: Some(2048), frame_offset: Some([100, 40]) };
        assert_eq!(part.frame(&effects(), &alone, 7).unwrap(), frame);
        let far = OnFilm { frame_offset: Some([i32::MAX, 0]), ..none };
        assert!(far.frame(&effects(), &picture, 0).is_err());
    }

    #[test]
    fn wide_pixels_are_wide_on_the_film() {
        let windows = Windows { pixel_aspect: 2.0, ..Windows::of_size(1024, 1152) };
        let picture = Description { windows, ..Description::new(1024, 1152, Channels::Rgb, Source::Exr) };
        let pitch = OnFilm { frame_width: None, frame_offset: None }.frame(&effects(), &picture, 0).unwrap().pitch();
        assert_eq!(pitch.x_um(), 2.0 * pitch.y_um());
        let thin = Windows { pixel_aspect: 100.0, ..windows };
        let picture = Description { windows: thin, ..picture };
        let error = OnFilm { frame_width: None, frame_offset: None }.frame(&effects(), &picture, 0).unwrap_err();
        assert!(error.to_string().starts_with("pixel aspect: found 100"), "{error}");
    }

    #[test]
    fn places_are_two_numbers() {
        assert_eq!(place("1024, -3"), Ok([1024, -3]));
        for text in ["", "1", "1,2,3", "1.5,2", "a,b"] {
            assert!(place(text).unwrap_err().contains("1024,0"), "{text}");
        }
        let beside = OnFilm { frame_width: None, frame_offset: Some([1, 1]) };
        assert!(beside.check(None).unwrap_err().to_string().starts_with("--frame-offset changes nothing"));
        assert!(beside.check(Some(&effects())).is_ok());
    }
}
