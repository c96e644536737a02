//! Opening a picture file, and how its values become light: as `cargo xtask develop` does it.

use std::io::Cursor;
use std::sync::Arc;

use onelight::{Background, ColourSpaces, Coverage, CoverageSeen, InputColours, LightNote, PictureLight, WorkingSpace};
use onelight_picture::{Channels, Limits, PictureReader, open};

use crate::error::Error;

/// The bytes of a file with its name, which are read more than once.
#[derive(Debug, Clone)]
pub(crate) struct PictureFile {
    bytes: Bytes,
    name: String,
}

#[derive(Debug, Clone)]
struct Bytes(Arc<Vec<u8>>);

impl AsRef<[u8]> for Bytes {
    fn as_ref(&self) -> &[u8] {
        &self.0
    }
}

/// How a picture is read.
#[derive(Debug, Clone)]
pub(crate) struct Reading {
    pub(crate) light: PictureLight,
    /// What the user should know of it, a sentence each.
    pub(crate) notes: Vec<String>,
    /// Whether nothing of the picture is left uncovered.
    pub(crate) is_covered: bool,
}

impl PictureFile {
    pub(crate) fn new(bytes: Vec<u8>, name: &str) -> Self {
        Self { bytes: Bytes(Arc::new(bytes)), name: name.to_owned() }
    }

    /// The picture from its top.
    pub(crate) fn open(&self) -> Result<PictureReader<'static>, Error> {
        Ok(open(Cursor::new(self.bytes.clone()), &self.name, Limits::default())?)
    }

    /// How its values become light of an input space; `background` lies behind a picture with alpha, where one is named. Looks through
    /// all of a picture that has alpha.
    pub(crate) fn reading(&self, space: WorkingSpace, background: Option<Background>) -> Result<Reading, Error> {
        let mut reader = self.open()?;
        let description = reader.description().clone();
        let spaces = ColourSpaces { input_space: space, ..ColourSpaces::default() };
        let colours = InputColours::default();
        let mut light = PictureLight::new(&description, &spaces, &colours)?;
        let mut notes: Vec<String> = description.notes.iter().map(|note| sentence(note)).collect();
        notes.extend(colours.notes(&description, &spaces).iter().map(sentence_of));
        let mut is_covered = true;
        if description.channels == Channels::Rgba {
            let mut seen = CoverageSeen::default();
            while let Some(band) = reader.next_band()? {
                seen.add(band);
            }
            let (coverage, more) = seen.decide(&description, background);
            light.coverage = coverage;
            notes.extend(more.iter().map(sentence_of));
            is_covered = coverage != Coverage::Kept || seen.covers_all();
        }
        Ok(Reading { light, notes, is_covered })
    }
}

/// The background for the page's word: nothing named, `none` or `black`.
pub(crate) fn background(word: &str) -> Option<Background> {
    match word {
        "none" => Some(Background::None),
        "black" => Some(Background::Light([0.0; 3])),
        _ => None,
    }
}

fn sentence_of(note: &LightNote) -> String {
    sentence(&note.text)
}

/// With a capital letter and a full stop.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().map(|first| first.to_uppercase().collect()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
