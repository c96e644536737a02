//! What the files of a baked look say of themselves: comments, titles, descriptors, names.

use super::coordinate::Coordinate;
use super::form::{Baked, BakedForm};
use crate::process::ColourSpaces;
use crate::word::{Word as _, WorkingSpace};

impl Baked {
    /// Lines for files that hold comments: the look, what goes in, what comes out, and `measured`, such as
    /// [`Certified::summary`](crate::certify::Certified::summary); `None` for that of [`Baked::with_report`].
    ///
    /// ```
    /// use onelight::baked::{Recipe, ShaperChoice};
    /// let recipe = Recipe { size: 9, ..Recipe::taking(ShaperChoice::Logc4) };
    /// let comments = onelight::Process::default().look()?.baked(&recipe)?.comments(None);
    /// assert!(comments[1].starts_with("input: ARRI LogC4, ARRI Wide Gamut 4 primaries, 18 % grey at 0.2784"));
    /// # Ok::<(), onelight::Error>(())
    /// ```
    #[must_use]
    pub fn comments(&self, measured: Option<&str>) -> Vec<String> {
        let (version, name, aim) = (env!("CARGO_PKG_VERSION"), self.name(), self.about.aim.word());
        vec![
            format!("onelight {version}: {name}, {aim} aim, {}", self.describe()),
            format!("input: {}", self.input_in_words()),
            format!("output: {}", self.output_in_words()),
            measured.or(self.measured.as_deref()).unwrap_or("not certified").to_owned(),
        ]
    }

    /// What goes in, with its primaries, the place of an 18 % grey and where the range ends.
    #[must_use]
    pub fn input_in_words(&self) -> String {
        if self.coordinate().is_some_and(Coordinate::is_scan) {
            return "Cineon codes of printing density, D-min at 95, grey of the digital LAD at 445, 0 to 1023 (full range)".to_owned();
        }
        let balance = self.balance_in_words();
        let end = self.max().map_or("any scene light".to_owned(), |max| format!("scene light to {max:.2}"));
        match self.coordinate() {
            Some(coordinate) => {
                let (name, primaries, grey) = (coordinate.name(), coordinate.primaries(), coordinate.grey());
                format!(
                    "{name}, {primaries} primaries, 18 % grey at {grey:.4}, codes 0 to 1 (full range), {end}{balance}"
                )
            }
            None => {
                let primaries = self.spaces().input_space.word();
                format!("scene-linear light, {primaries} primaries, 18 % grey at 0.18, {end}{balance}")
            }
        }
    }

    /// What is made of the light before the film, where something is.
    fn balance_in_words(&self) -> String {
        let ColourSpaces { ev, scene_white, .. } = self.spaces();
        let white = scene_white
            .map(|white| format!(", light of {} K and a tint of {} made neutral", white.kelvin(), white.tint()));
        let exposed = (*ev != 0.0).then(|| format!(", exposed by {ev:+} stops"));
        exposed.unwrap_or_default() + &white.unwrap_or_default()
    }

    /// What comes out: primaries and coding of the display.
    #[must_use]
    pub fn output_in_words(&self) -> String {
        let ColourSpaces { output_space, output_coding, .. } = self.spaces();
        let white = self.coding().white_cd_m2;
        let white = output_coding.is_hdr().then(|| format!(", (1, 1, 1) at {white} cd/m2"));
        format!(
            "display {} primaries, {} coding, 0 to 1 (full range){}",
            output_space.word(),
            output_coding.word(),
            white.unwrap_or_default()
        )
    }

    /// One line under which a program lists the look: its films, and what its file takes.
    #[must_use]
    pub fn title(&self) -> String {
        format!("{}, takes {}", self.name(), self.coordinate().map_or("scene-linear light", |taken| taken.name()))
    }

    /// The middle of file names: what a file takes, such as `logc4`, `scene-linear` or, with other primaries than sRGB's,
    /// `scene-linear-acescg`.
    #[must_use]
    pub fn input_word(&self) -> String {
        match (self.form(), self.spaces().input_space) {
            (BakedForm::Coded { coordinate, .. }, _) => coordinate.word().to_owned(),
            (_, WorkingSpace::Srgb) => "scene-linear".to_owned(),
            (_, space) => format!("scene-linear-{}", space.word()),
        }
    }
}
