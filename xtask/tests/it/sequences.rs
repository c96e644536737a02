//! Jobs of many pictures: stopped, killed, shared out, run again, with bad frames among them.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::{fs, str, thread, time};

use exr::prelude::{SpecificChannels, WritableImage};
use half::f16;
use serde_json::Value;

use crate::program::program;

/// Writes frame `number`, of grey that no other frame has.
fn write_frame(folder: &Path, number: usize, [width, height]: [usize; 2]) {
    let pixel = |at: exr::prelude::Vec2<usize>| {
        let value = f16::from_f32((1 + (at.0 * 7 + at.1 * 3 + number * 11) % 61) as f32 * 0.02);
        (value, value, f16::from_f32(0.1))
    };
    let image = exr::prelude::Image::from_channels((width, height), SpecificChannels::rgb(pixel));
    image.write().to_file(folder.join(format!("shot.{number:04}.exr"))).unwrap();
}

/// `in/shot.0001.exr` and so on, and an empty `out`.
fn with_frames(count: usize, size: [usize; 2]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    ["in", "out", "other"].iter().for_each(|name| fs::create_dir(folder.path().join(name)).unwrap());
    (1..=count).for_each(|number| write_frame(&folder.path().join("in"), number, size));
    folder
}

/// Through the exact film: long enough for a frame to be stopped in.
const SLOW: [&str; 2] = ["--form", "reference"];

/// The whole job, with more options.
fn job(folder: &Path, output: &str, more: &[&str]) -> Command {
    let mut command = program();
    command.args(["develop", "in/shot.####.exr", output]).args(more);
    command.current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// How many were developed, were there already, and failed.
fn counts(output: &Output) -> [u64; 3] {
    let json: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", sentence(output)));
    ["developed", "already_done", "failed"].map(|key| json[key].as_u64().unwrap())
}

fn sentence(output: &Output) -> &str {
    str::from_utf8(&output.stderr).unwrap()
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap);
    entries.map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap())).collect()
}

fn empty(folder: &Path) {
    files(folder).keys().for_each(|file| fs::remove_file(folder.join(file)).unwrap());
}

fn same(a: &BTreeMap<String, Vec<u8>>, b: &BTreeMap<String, Vec<u8>>) -> bool {
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    a == b
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

/// Stops the job when it has written some frames and is at work on others.
#[cfg(unix)]
fn stop_amid(child: &mut Child, output: &Path, signal_name: &str) {
    let start = time::Instant::now();
    loop {
        assert!(start.elapsed().as_secs() < 60, "nothing was begun");
        assert!(child.try_wait().unwrap().is_none(), "the job was over before it could be stopped");
        let names = || fs::read_dir(output).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let unfinished = || names().any(|name| name.ends_with(".part"));
        if names().filter(|name| name.starts_with("shot")).count() >= 10 && unfinished() {
            signal(child, "-STOP");
            // The frame may have been finished between the look and the signal.
            if unfinished() {
                signal(child, signal_name);
                signal(child, "-CONT");
                return;
            }
            signal(child, "-CONT");
        }
        thread::sleep(time::Duration::from_millis(1));
    }
}

#[cfg(unix)]
#[test]
fn a_killed_job_goes_on_to_the_same_files() {
    let folder = with_frames(60, [64, 36]);
    let folder = folder.path();
    for extension in ["png", "exr"] {
        let [out, other] = ["out", "other"].map(|name| format!("{name}/shot.####.{extension}"));
        let undisturbed =
            job(folder, &other, &[&SLOW[..], &["--json"]].concat()).env("RAYON_NUM_THREADS", "4").output().unwrap();
        assert_eq!(counts(&undisturbed), [60, 0, 0]);

        let mut child = job(folder, &out, &SLOW).spawn().unwrap();
        stop_amid(&mut child, &folder.join("out"), "-KILL");
        assert_eq!(child.wait().unwrap().code(), None);
        let left = files(&folder.join("out"));
        assert!(left.len() < 60 && left.keys().any(|name| name.ends_with(".part")), "{:?}", left.keys());

        let again = job(folder, &out, &[&SLOW[..], &["--frames", "1-60", "--json"]].concat())
            .env("RAYON_NUM_THREADS", "3")
            .output()
            .unwrap();
        let [developed, already_done, failed] = counts(&again);
        assert!(again.status.success() && already_done >= 10 && developed + already_done == 60 && failed == 0);
        assert!(same(&files(&folder.join("out")), &files(&folder.join("other"))));
        ["out", "other"].iter().for_each(|name| empty(&folder.join(name)));
    }
}

#[cfg(unix)]
#[test]
fn a_job_that_is_stopped_leaves_complete_files() {
    let folder = with_frames(60, [64, 36]);
    let folder = folder.path();
    for (name, status) in [("-INT", 130), ("-TERM", 143)] {
        let mut child = job(folder, "out/shot.####.png", &SLOW).spawn().unwrap();
        stop_amid(&mut child, &folder.join("out"), name);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(status), "{}", sentence(&output));
        assert!(sentence(&output).starts_with("stopped: ") && sentence(&output).contains("of 60 frames"));
        let left = files(&folder.join("out"));
        assert!(
            left.len() < 60
                && left.iter().all(|(name, bytes)| name.ends_with(".png") && bytes.ends_with(b"IEND\xae\x42\x60\x82"))
        );
        empty(&folder.join("out"));
    }
}

#[test]
fn bad_frames_are_reported_and_the_rest_go_on() {
    let folder = with_frames(6, [20, 10]);
    let folder = folder.path();
    let frame = |number: usize| folder.join(format!("in/shot.{number:04}.exr"));
    let whole = fs::read(frame(2)).unwrap();
    fs::write(frame(2), &whole[..whole.len() - 9]).unwrap();
    fs::write(frame(3), b"no picture").unwrap();
    fs::remove_file(frame(4)).unwrap();
    fs::create_dir(frame(4)).unwrap();
    let run =
        |more: &[&str]| job(folder, "out/shot.####.png", &[&["--frames", "1-7"], more].concat()).output().unwrap();

    let output = run(&[]);
    assert_eq!(output.status.code(), Some(2));
    let (text, lines) = (str::from_utf8(&output.stdout).unwrap(), sentence(&output));
    for (number, why) in [(2, "truncated"), (3, "unknown format"), (4, "is a folder"), (7, "no such file")] {
        let line = lines.lines().find(|line| line.starts_with(&format!("failed: in/shot.000{number}.exr: "))).unwrap();
        assert!(line.contains(why) && text.contains(line), "{line}\n{text}");
    }
    assert!(lines.ends_with("error: 4 of 7 frames were not developed\n"), "{lines}");
    assert!(text.contains("7 frames: 3 developed, 0 already done, 4 failed"), "{text}");
    assert_eq!(
        files(&folder.join("out")).into_keys().collect::<Vec<_>>(),
        [1, 5, 6].map(|n| format!("shot.000{n}.png"))
    );

    fs::write(frame(2), whole).unwrap();
    let output = run(&["--json"]);
    assert_eq!((counts(&output), output.status.code()), ([1, 3, 3], Some(2)));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let outcomes = json["pictures"].as_array().unwrap().iter().map(|picture| picture["outcome"].as_str().unwrap());
    let [done, failed] = ["already done", "failed"];
    assert_eq!(outcomes.collect::<Vec<_>>(), [done, "developed", failed, failed, done, done, failed]);
    assert!(json["pictures"][6]["error"].as_str().unwrap().starts_with("in/shot.0007.exr: there is no such file"));
}

/// Nothing is skipped but what would come out the same.
#[test]
fn what_has_changed_is_developed_again() {
    for extension in ["png", "exr"] {
        let folder = with_frames(4, [20, 10]);
        let folder = folder.path();
        let out = |number: usize| folder.join(format!("out/shot.000{number}.{extension}"));
        let pattern = format!("out/shot.####.{extension}");
        let run = |more: &[&str]| counts(&job(folder, &pattern, &[&["--json"], more].concat()).output().unwrap());
        assert_eq!(run(&[]), [4, 0, 0]);
        assert_eq!(run(&[]), [0, 4, 0]);
        let good = files(&folder.join("out"));

        // Outputs that are not what they should be: cut short, of another frame, of no job, gone.
        let bytes = fs::read(out(1)).unwrap();
        for cut in [1, bytes.len() / 2, bytes.len() - 30] {
            fs::write(out(1), &bytes[..bytes.len() - cut]).unwrap();
            assert_eq!(run(&["--frames", "1"]), [1, 0, 0], "{cut} bytes cut off");
        }
        fs::copy(out(1), out(2)).unwrap();
        let single = program().arg("develop").arg("in/shot.0003.exr").arg(out(3)).current_dir(folder).output().unwrap();
        assert!(single.status.success());
        fs::remove_file(out(4)).unwrap();
        assert_eq!(run(&[]), [3, 1, 0]);
        assert!(same(&files(&folder.join("out")), &good));

        // Inputs and settings that are others.
        write_frame(&folder.join("in"), 2, [20, 10]);
        assert_eq!(run(&[]), [1, 3, 0], "another time");
        if extension == "exr" {
            continue;
        }
        for more in [
            &["--ev", "1"],
            &["--points", "1,0,0"],
            &["--form", "plain"],
            &["--buffer", "half"],
            &["--input-space", "srgb"],
        ] {
            assert_eq!(run(more), [4, 0, 0], "{more:?}");
            assert_eq!(run(more), [0, 4, 0], "{more:?}");
        }
        assert_eq!(run(&["--input-space", "srgb", "--memory", "0.01", "--max-pixels", "200"]), [0, 4, 0]);
        assert_eq!(run(&["--max-pixels", "199"]), [0, 0, 4]);
    }
}

/// Shards beside each other in one folder, and two runs of one job at once, are one undisturbed job.
#[test]
fn runs_at_once_do_not_disturb_each_other() {
    let folder = with_frames(20, [48, 27]);
    let folder = folder.path();
    assert_eq!(counts(&job(folder, "other/shot.####.png", &["--json"]).output().unwrap()), [20, 0, 0]);
    let all_at_once = |each: &[&[&str]]| -> Vec<[u64; 3]> {
        let start = |more: &&[&str]| job(folder, "out/shot.####.png", &[&["--json"], *more].concat()).spawn().unwrap();
        let children: Vec<Child> = each.iter().map(start).collect();
        children.into_iter().map(|child| counts(&child.wait_with_output().unwrap())).collect()
    };
    let shards = all_at_once(&[&["--shard", "1/3"], &["--shard", "2/3"], &["--shard", "3/3"]]);
    assert_eq!(shards, [[7, 0, 0], [7, 0, 0], [6, 0, 0]]);
    assert!(same(&files(&folder.join("out")), &files(&folder.join("other"))));

    empty(&folder.join("out"));
    for [developed, already_done, failed] in all_at_once(&[&[], &[]]) {
        assert_eq!([developed + already_done, failed], [20, 0]);
    }
    assert!(same(&files(&folder.join("out")), &files(&folder.join("other"))));
    let none = job(folder, "out/shot.####.png", &["--shard", "30/30", "--json"]).output().unwrap();
    assert_eq!(counts(&none), [0, 0, 0]);
    assert!(none.status.success());
}

/// A limit on the size of files stands for a full disk.
#[cfg(unix)]
#[test]
fn frames_that_do_not_fit_are_named() {
    let folder = with_frames(2, [20, 10]);
    let folder = folder.path();
    write_frame(&folder.join("in"), 3, [300, 200]);
    let limited = format!(
        "ulimit -f 16; exec '{}' develop 'in/shot.####.exr' 'out/shot.####.exr' --form plain",
        env!("CARGO_BIN_EXE_xtask")
    );
    let output = Command::new("sh").args(["-c", &limited]).current_dir(folder).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", sentence(&output));
    let lines: Vec<&str> = sentence(&output).lines().collect();
    assert!(lines[0].starts_with("failed: out/shot.0003.exr: cannot be written: "), "{lines:?}");
    assert_eq!(lines[1..], ["error: 1 of 3 frames were not developed"]);
    assert_eq!(files(&folder.join("out")).into_keys().collect::<Vec<_>>(), ["shot.0001.exr", "shot.0002.exr"]);
}

#[test]
fn a_shot_is_exposed_as_one_and_stills_each_by_itself() {
    let folder = with_frames(3, [20, 10]);
    let folder = folder.path();
    let output = job(folder, "out/shot.####.png", &["--ev", "auto"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(sentence(&output).contains("the shot flickers, expected stops"), "{}", sentence(&output));
    let mut stills = program();
    stills.args(["develop", "in/*.exr", "out/*.film.png", "--ev", "auto", "--json"]).current_dir(folder);
    assert_eq!(counts(&stills.output().unwrap()), [3, 0, 0]);
    let mut unquoted = program();
    unquoted.args(["develop", "in/shot.0001.exr", "in/shot.0002.exr", "out"]).current_dir(folder);
    assert!(sentence(&unquoted.output().unwrap()).contains("quote a pattern"));
}
