//! Which pictures a job reads and writes, known before the first is touched.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use super::numbers::{FrameNumbers, Shard, ranges};
use super::pattern::{Pattern, Piece, Place};

/// One picture of a job.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Frame {
    pub(super) input: PathBuf,
    pub(super) output: PathBuf,
    /// Its number in the shot; 0 for pictures that have names.
    pub(super) number: u32,
}

/// The pictures of a job, in order.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Plan {
    pub(super) frames: Vec<Frame>,
    /// Whether they are the frames of one shot.
    pub(super) numbered: bool,
    /// What the user should know.
    pub(super) notes: Vec<String>,
}

/// What `input` and `output` ask for; `None` where they name one picture.
///
/// # Errors
/// One sentence: names that do not go together, no pictures, a picture that would be both read and written.
pub(crate) fn plan(
    input: &Path,
    output: &Path,
    numbers: Option<&FrameNumbers>,
    shard: Option<Shard>,
) -> Result<Option<Plan>> {
    // A file that is there under this very name is what is meant.
    let from = if input.is_file() { None } else { Pattern::in_path(input)? };
    let to = Pattern::in_path(output)?;
    let (from, to) = match (from, to) {
        (None, None) => {
            if let Some(option) = numbers.map(|_| "--frames").or(shard.map(|_| "--shard")) {
                bail!(
                    "{}: is one picture, for which {option} changes nothing, expected a pattern such as shot.####.exr",
                    input.display()
                );
            }
            return Ok(None);
        }
        (None, Some(_)) => bail!("{}: names many pictures, but {} is one", output.display(), input.display()),
        (Some(from), Some(to)) if same_kind(&from, &to) => (from, to),
        (Some(from), _) => {
            bail!(
                "{}: has no {}, which is where the pictures of {} differ",
                output.display(),
                sign(&from),
                input.display()
            )
        }
    };
    if !folder(&to).is_dir() {
        bail!(
            "{}: cannot be written, as the folder {} does not exist (it is not made for you)",
            output.display(),
            folder(&to).display()
        );
    }
    let mut notes = Vec::new();
    let pieces: Vec<Piece> = match (from.place, numbers) {
        (Place::Number { .. }, Some(numbers)) => numbers.0.iter().map(|number| Piece::Number(*number)).collect(),
        (Place::Name, Some(_)) => {
            bail!("{}: has no frame numbers, expected #### in it for --frames", input.display())
        }
        (_, None) => listed(&from)?,
    };
    if pieces.is_empty() {
        bail!("{}: no picture has such a name", input.display());
    }
    if numbers.is_none() {
        notes.extend(gaps(&pieces));
    }
    let number = |piece: &Piece| match piece {
        Piece::Number(number) => number.cast_unsigned(),
        Piece::Name(_) => 0,
    };
    let frame = |piece| Frame { input: there(&from, piece), output: to.path(piece), number: number(piece) };
    let frames: Vec<Frame> = pieces.iter().map(frame).collect();
    if same_folder(&from, &to) {
        check_apart(&frames)?;
    }
    let frames = match shard {
        Some(shard) => shard.of(frames),
        None => frames,
    };
    Ok(Some(Plan { frames, numbered: matches!(from.place, Place::Number { .. }), notes }))
}

/// The path of a picture that comes in, as the sign of its number is written there.
fn there(from: &Pattern, piece: &Piece) -> PathBuf {
    let usual = from.path(piece);
    from.other_path(piece).filter(|other| other.is_file() && !usual.is_file()).unwrap_or(usual)
}

fn same_kind(from: &Pattern, to: &Pattern) -> bool {
    std::mem::discriminant(&from.place) == std::mem::discriminant(&to.place)
}

fn sign(pattern: &Pattern) -> &'static str {
    match pattern.place {
        Place::Number { .. } => "#### (or @@@@, $F4, %04d)",
        Place::Name => "*",
    }
}

fn folder(pattern: &Pattern) -> &Path {
    if pattern.folder.as_os_str().is_empty() { Path::new(".") } else { &pattern.folder }
}

/// The pictures in the folder that have such names.
fn listed(from: &Pattern) -> Result<Vec<Piece>> {
    let folder = folder(from);
    let unreadable = || format!("{}: the folder cannot be read", folder.display());
    let mut pieces = BTreeSet::new();
    for entry in fs::read_dir(folder).with_context(unreadable)? {
        let name = entry.with_context(unreadable)?.file_name();
        match name.to_str() {
            Some(name) => {
                if let Some(piece) = from.piece_of(name)
                    && !pieces.insert(piece)
                {
                    bail!("{}: two files have the number of this one, expected one", folder.join(name).display());
                }
            }
            None if from.piece_of(&name.to_string_lossy()).is_some() => {
                bail!("{}: the name is not UTF-8, expected one that is", folder.join(name).display())
            }
            None => {}
        }
    }
    Ok(pieces.into_iter().collect())
}

/// The numbers that are missing between the first and the last.
fn gaps(pieces: &[Piece]) -> Option<String> {
    const SPAN: usize = 1_000_000;
    let numbers: BTreeSet<i32> = pieces
        .iter()
        .filter_map(|piece| match piece {
            Piece::Number(number) => Some(*number),
            Piece::Name(_) => None,
        })
        .collect();
    let (first, last) = (*numbers.first()?, *numbers.last()?);
    let missing: Vec<i32> = (first..=last).filter(|number| !numbers.contains(number)).take(SPAN).collect();
    (!missing.is_empty()).then(|| {
        format!("frames {} are not there (with --frames {first}-{last} they would count as failed)", ranges(&missing))
    })
}

fn same_folder(a: &Pattern, b: &Pattern) -> bool {
    matches!((folder(a).canonicalize(), folder(b).canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Refuses an output that is an input: this frame's, another's, or that of the next run.
fn check_apart(frames: &[Frame]) -> Result<()> {
    let inputs: BTreeSet<_> = frames.iter().filter_map(|frame| frame.input.file_name()).collect();
    match frames.iter().find(|frame| frame.output.file_name().is_some_and(|name| inputs.contains(name))) {
        Some(frame) => bail!(
            "{}: would be both read and written, expected outputs of other names or in another folder",
            frame.output.display()
        ),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_files(names: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("out")).unwrap();
        names.iter().for_each(|name| fs::write(folder.path().join(name), "").unwrap());
        folder
    }

    /// Names of inputs and outputs.
    fn planned(
        folder: &Path,
        input: &str,
        output: &str,
        frames: Option<&str>,
    ) -> Result<Option<Vec<(String, String)>>> {
        let frames = frames.map(|frames| frames.parse::<FrameNumbers>().unwrap());
        let plan = plan(&folder.join(input), &folder.join(output), frames.as_ref(), None)?;
        let name = |path: &Path| path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
        Ok(plan.map(|plan| plan.frames.iter().map(|frame| (name(&frame.input), name(&frame.output))).collect()))
    }

    fn pair(input: &str, output: &str) -> (String, String) {
        (input.to_owned(), output.to_owned())
    }

    #[test]
    fn frames_are_those_asked_for_or_those_there() {
        let folder = with_files(&["a.0002.exr", "a.0010.exr", "a.10.exr", "a.0003.png", "b.exr", ".c.exr"]);
        let folder = folder.path();
        assert_eq!(
            planned(folder, "a.####.exr", "out/f_#.png", Some("1-2")).unwrap().unwrap(),
            [pair("a.0001.exr", "out/f_1.png"), pair("a.0002.exr", "out/f_2.png")]
        );
        assert_eq!(
            planned(folder, "a.####.exr", "out/a.%04d.png", None).unwrap().unwrap(),
            [pair("a.0002.exr", "out/a.0002.png"), pair("a.0010.exr", "out/a.0010.png")]
        );
        assert_eq!(
            planned(folder, "*.exr", "out/*.png", None).unwrap().unwrap(),
            [
                pair("a.0002.exr", "out/a.0002.png"),
                pair("a.0010.exr", "out/a.0010.png"),
                pair("a.10.exr", "out/a.10.png"),
                pair("b.exr", "out/b.png")
            ]
        );
        assert_eq!(planned(folder, "b.exr", "out/b.png", None).unwrap(), None);
        // A file of this very name is one picture.
        fs::write(folder.join("c.####.exr"), "").unwrap();
        assert_eq!(planned(folder, "c.####.exr", "out/b.png", None).unwrap(), None);
    }

    #[test]
    fn frames_before_0_are_found_as_they_are_written() {
        let folder = with_files(&["a.-0002.exr", "a.-001.exr", "a.0000.exr"]);
        let folder = folder.path();
        let expected = [
            pair("a.-0002.exr", "out/a.-002.png"),
            pair("a.-001.exr", "out/a.-001.png"),
            pair("a.0000.exr", "out/a.0000.png"),
        ];
        for frames in [None, Some("-2-0")] {
            assert_eq!(planned(folder, "a.@@@@.exr", "out/a.%04d.png", frames).unwrap().unwrap(), expected);
        }
        let mut back = planned(folder, "a.$F4.exr", "out/a.%04d.png", Some("0--2")).unwrap().unwrap();
        back.reverse();
        assert_eq!(back, expected);
        fs::write(folder.join("a.-0001.exr"), "").unwrap();
        let message = planned(folder, "a.####.exr", "out/a.####.png", None).unwrap_err().to_string();
        assert!(message.contains("two files have the number"), "{message}");
    }

    #[test]
    fn missing_frames_are_told() {
        let folder = with_files(&["a.1.exr", "a.2.exr", "a.5.exr"]);
        let [input, output] = ["a.#.exr", "out/a.#.png"].map(|name| folder.path().join(name));
        let plan = plan(&input, &output, None, None).unwrap().unwrap();
        assert_eq!(plan.notes, ["frames 3-4 are not there (with --frames 1-5 they would count as failed)"]);
        assert!(plan.numbered);
    }

    #[test]
    fn names_that_do_not_go_together_are_refused() {
        let folder = with_files(&["a.0001.exr", "a.exr"]);
        let folder = folder.path();
        for (input, output, frames, expected) in [
            ("a.####.exr", "out/a.png", None, "a.png: has no ####"),
            ("a.####.exr", "out/*.png", None, "*.png: has no ####"),
            ("*.exr", "out/a.####.png", None, "a.####.png: has no *,"),
            ("a.exr", "out/a.####.png", None, "names many pictures"),
            ("a.exr", "out/a.png", Some("1-2"), "a.exr: is one picture, for which --frames changes nothing"),
            ("*.exr", "out/*.png", Some("1-2"), "has no frame numbers"),
            ("b.####.exr", "out/b.####.png", None, "b.####.exr: no picture has such a name"),
            ("no/a.####.exr", "out/b.####.png", None, "the folder cannot be read"),
            ("a.####.exr", "no/a.####.png", None, "does not exist (it is not made for you)"),
            ("a.####.exr", "a.####.exr", None, "a.0001.exr: would be both read and written"),
            ("a.##.exr", "out/../a.####.exr", Some("1-1000"), "a.1000.exr: would be both read and written"),
            ("a.####.exr", "a.##.##.png", None, "2 parts"),
        ] {
            let message = planned(folder, input, output, frames).unwrap_err().to_string();
            assert!(message.contains(expected) && !message.contains('\n'), "{message}");
        }
        // What one run has written, the next would read.
        assert!(planned(folder, "*.exr", "*.film.exr", None).is_ok());
        fs::write(folder.join("a.film.exr"), "").unwrap();
        assert!(
            planned(folder, "*.exr", "*.film.exr", None).unwrap_err().to_string().contains("both read and written")
        );
    }
}
