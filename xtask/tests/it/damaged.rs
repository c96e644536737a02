//! Four hundred damaged pictures through the real `develop`: each ends with a complete picture, or with one sentence and nothing.

use std::path::{Path, PathBuf};
use std::process::{Child, Output, Stdio};
use std::time::{Duration, Instant};
use std::{fs, str, thread};

use onelight_picture::{Limits, Picture};

use crate::program::{fixtures, program};

/// How many files are made.
const FILES: usize = 400;

/// No file takes so long, on any machine; one that does hangs.
const HANGS: Duration = Duration::from_secs(60);

/// A small generator with a fixed start, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }
}

/// The corpora of pictures, by name; `found-` are those that once did harm.
fn corpora() -> Vec<(String, Vec<u8>)> {
    let top = fixtures().join("corpus");
    let mut files: Vec<PathBuf> = ["exr", "tiff", "png", "jpeg", "hdr"]
        .iter()
        .flat_map(|target| fs::read_dir(top.join(target)).unwrap().map(|entry| entry.unwrap().path()))
        .collect();
    files.sort();
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    files.into_iter().map(|path| (name(&path), fs::read(&path).unwrap())).collect()
}

/// One of the ways that files come to harm.
fn damaged(good: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = good.to_vec();
    match random.below(5) {
        // A transfer that broke off.
        0 => bytes.truncate(random.below(good.len())),
        // Bits that fell over, half of them in the header.
        1 | 2 => {
            for _ in 0..=random.below(8) {
                let end = if random.below(2) == 0 { bytes.len() } else { bytes.len().min(400) };
                bytes[random.below(end)] ^= 1 << random.below(8);
            }
        }
        // A sector of another file, or of nothing.
        3 => {
            let start = random.below(bytes.len());
            let end = bytes.len().min(start + 512);
            let nothing = random.below(2) == 0;
            for at in start..end {
                bytes[at] = if nothing { 0 } else { other[at % other.len()] };
            }
        }
        // The head of one file and the tail of another.
        _ => {
            let (head, tail) = (random.below(good.len()), random.below(other.len()));
            bytes = [&good[..head], &other[tail..]].concat();
        }
    }
    bytes
}

fn developing(folder: &Path, input: &str, output: &str) -> Child {
    // No film: what is tried here is reading.
    let arguments = ["develop", input, output, "--look", "look.toml"];
    let mut command = program();
    command.args(arguments).current_dir(folder).env("RAYON_NUM_THREADS", "2");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn end_of(mut child: Child, name: &str) -> Output {
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > HANGS {
            child.kill().unwrap();
            panic!("{name}: still running after {HANGS:?}");
        }
        thread::sleep(Duration::from_millis(2));
    }
    child.wait_with_output().unwrap()
}

/// Develops one file; whether there was a picture in it.
fn survives(folder: &Path, index: usize, name: &str, bytes: &[u8]) -> bool {
    // The format is recognised by the bytes.
    let (input, output) = (format!("{index}.in"), format!("{index}.{}", ["png", "exr"][index % 2]));
    fs::write(folder.join(&input), bytes).unwrap();
    let done = end_of(developing(folder, &input, &output), name);
    let (said, failed) = (str::from_utf8(&done.stdout).unwrap(), str::from_utf8(&done.stderr).unwrap());
    let written = folder.join(&output);
    match done.status.code() {
        Some(0) => {
            let picture = Picture::read(fs::File::open(&written).unwrap(), "", Limits::default());
            let picture = picture.unwrap_or_else(|error| panic!("{name}: what was written is no picture: {error}"));
            assert_eq!(picture.rgb.len(), picture.width * picture.height, "{name}");
            assert!(failed.is_empty(), "{name}: {failed}");
            true
        }
        Some(2) => {
            assert!(said.is_empty() && !written.exists(), "{name}: {said}");
            let sentence = failed.strip_suffix('\n').unwrap_or(failed);
            assert!(sentence.starts_with(&format!("error: {input}: ")), "{name}: {failed}");
            assert!(!sentence.contains(char::is_control) && sentence.len() < 600, "{name}: {failed:?}");
            assert!(!sentence.contains("panicked"), "{name}: {failed}");
            false
        }
        other => panic!("{name}: ended with {other:?} ({:?}): {failed}", done.status),
    }
}

#[test]
fn damaged_pictures_end_in_a_picture_or_a_sentence() {
    let corpora = corpora();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("look.toml"), "version = 1\napproach = \"clip\"\n").unwrap();
    let mut random = Random(7);
    let mut files: Vec<(String, Vec<u8>)> =
        corpora.iter().filter(|(name, _)| name.starts_with("found-")).cloned().collect();
    // Every file of the corpora is hit, and again in other ways.
    for (turn, (name, good)) in corpora.iter().cycle().enumerate() {
        if files.len() >= FILES {
            break;
        }
        let other = &corpora[random.below(corpora.len())].1;
        files.push((format!("{name}, turn {turn}"), damaged(good, other, &mut random)));
    }
    let read: usize = thread::scope(|scope| {
        let workers: Vec<_> = (0..2)
            .map(|worker| {
                let (files, folder) = (&files, folder.path());
                scope.spawn(move || {
                    let own = files.iter().enumerate().skip(worker).step_by(2);
                    own.filter(|(index, (name, bytes))| survives(folder, *index, name, bytes)).count()
                })
            })
            .collect();
        workers.into_iter().map(|worker| worker.join().unwrap()).sum()
    });
    // Some were read and most refused.
    assert!(read > FILES / 20 && read < FILES / 2, "{read} of {FILES} were read");
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 1 + files.len() + read, "{left:?}");
}
