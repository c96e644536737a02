//! What a developed frame is known by: a digest of all that decides how it looks.

use std::fmt::Write as _;
use std::path::Path;
use std::time::UNIX_EPOCH;
use std::{fs, io};

use anyhow::Result;
use onelight::Look;
use sha2::{Digest, Sha256};

use super::super::job::{DIGEST_KEY, Settings};
use super::plan::Frame;
use crate::own_stock::hex;
use crate::picture_file::text_of_complete_picture;

/// All that decides how the frames of a job look, but the frames.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Recipe(String);

impl Recipe {
    /// Of the settings: look, options, program. What a form makes of the film counts by the form's description and
    /// the program's version.
    ///
    /// # Errors
    /// Those of compiling the look.
    pub(super) fn new(settings: &Settings) -> Result<Self> {
        let Settings { look, film, exposure, scene, input, on_film, target, white_luminance, metadata, limits: _ } =
            settings;
        let mut text = String::new();
        let mut line = |key: &str, value: &dyn std::fmt::Display| {
            let _ = writeln!(text, "{key}: {value}");
        };
        line("onelight", &env!("CARGO_PKG_VERSION"));
        line("film", &film_in_numbers(&look.look()?));
        line("form", &film.describe());
        line("exposure", &format_args!("{exposure:?}"));
        line("scene", &scene.in_numbers());
        line("input", &format_args!("{input:?}"));
        // Figures of the sheet that colours do not show.
        line("effects", &format_args!("{:?}", film.effects()));
        line("on film", &format_args!("{on_film:?}"));
        line("target", &format_args!("{target:?}"));
        line("white luminance", &format_args!("{white_luminance:?}"));
        line("metadata", &format_args!("{metadata:?}"));
        // Data sheets of one's own count by their digests, wherever they are.
        line("look", &look.text_anywhere());
        Ok(Self(text))
    }

    /// The digest of one frame: the recipe, its number, and the input's name, size and time.
    ///
    /// # Errors
    /// If the file cannot be asked.
    pub(super) fn digest(&self, frame: &Frame) -> io::Result<String> {
        let Frame { input, number, .. } = frame;
        let found = fs::metadata(input)?;
        let time = match found.modified()?.duration_since(UNIX_EPOCH) {
            Ok(after) => format!("{after:?}"),
            Err(before) => format!("-{:?}", before.duration()),
        };
        let name = input.file_name().unwrap_or_default();
        Ok(hex(&Sha256::digest(format!("{}input: {number}, {name:?}, {} bytes, {time}\n", self.0, found.len()))))
    }
}

/// Whether `output` is complete and was developed by this digest.
pub(super) fn is_done(output: &Path, digest: &str) -> bool {
    text_of_complete_picture(output, DIGEST_KEY).is_some_and(|found| found == digest)
}

/// A digest of what the film makes of some colours: another where the physics or its data have changed, though the version
/// has not. Rounded far above what processors differ by.
fn film_in_numbers(film: &Look) -> String {
    const LEVELS: [f64; 5] = [0.0, 0.004, 0.18, 1.0, 30.0];
    const STEPS: f64 = (1 << 20) as f64;
    let mut digest = Sha256::new();
    for red in LEVELS {
        for green in LEVELS {
            for blue in LEVELS {
                for value in film.develop([red, green, blue]) {
                    digest.update(((value * STEPS).round() as i64).to_le_bytes());
                }
            }
        }
    }
    hex(&digest.finalize())
}

#[cfg(test)]
mod tests {
    use onelight::ProcessKeys;

    use super::*;

    fn numbers(change: impl FnOnce(&mut ProcessKeys)) -> String {
        let mut keys = ProcessKeys::default();
        change(&mut keys);
        film_in_numbers(&keys.process().unwrap().look().unwrap())
    }

    /// A tenth of a printer point is 0.0025 in log10 exposure.
    #[test]
    fn small_changes_of_the_film_show() {
        let film = numbers(|_| {});
        assert_eq!(film, numbers(|_| {}));
        assert_ne!(film, numbers(|keys| keys.points[2] = 0.1));
        assert_ne!(film, numbers(|keys| keys.neutral_density = 0.7001));
    }

    /// The first test of FIPS 180-2: digests are the same for every build.
    #[test]
    fn digests_are_sha_256() {
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hex(&Sha256::digest("abc")), expected);
    }
}
