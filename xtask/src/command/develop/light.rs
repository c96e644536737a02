//! What the command line says of the values of a picture, and what it tells of how they were read.

use onelight::{InputCoding, LightNote, LightSetting, Process, Word as _};
use onelight_picture::{Description, Source};

use super::input::InputSettings;

/// What the user should know of how a picture is read.
pub(super) fn notes(picture: &Description, process: &Process, input: &InputSettings) -> Vec<String> {
    let mut notes = Vec::new();
    let colours = &input.colours;
    if picture.primaries.is_some() && colours.primaries_of(picture).is_none() {
        let by = match colours.coding.filter(|_| colours.has_own_space()) {
            Some(coding) => format!("--input-coding {}", coding.word()),
            None => format!("--input-space {}", process.spaces().input_space.word()),
        };
        notes.push(format!("the file's own chromaticities give way to {by}"));
    }
    match (colours.coding, &picture.transfer) {
        (Some(InputCoding::Display(_)), None) if picture.source == Source::Exr => {
            notes.push("an EXR holds linear light: --input-coding is not used".to_owned());
        }
        (Some(coding), said) => {
            if said.is_some() && picture.source != Source::RadianceHdr {
                notes.push(format!("the file's own coding gives way to --input-coding {}", coding.word()));
            }
            if !matches!(coding, InputCoding::Display(_)) {
                notes.push(format!("read as {}, full range", coding.name()));
            }
        }
        (None, _) => {}
    }
    notes.extend(colours.notes(picture, process.spaces()).iter().map(with_option));
    notes
}

/// A note with the option that decides otherwise.
pub(super) fn with_option(note: &LightNote) -> String {
    let option = match note.decided_by {
        None => return note.text.clone(),
        Some(LightSetting::Coding) => "--input-coding says otherwise",
        Some(LightSetting::Primaries) => "--input-space says otherwise",
        Some(LightSetting::Background) => "--background chooses another, none keeps the alpha",
    };
    format!("{note} ({option})")
}
