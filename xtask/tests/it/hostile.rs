//! Files that claim more than they hold: refused in a sentence before memory is taken.

use std::io::{Cursor, Write as _};
use std::path::Path;
use std::process::Stdio;
use std::{fs, str, thread, time};

use exr::prelude::{
    Blocks, Compression, Encoding, Image, ImageAttributes, Layer, LayerAttributes, LineOrder, SpecificChannels, Vec2,
    WritableImage, f16,
};

use crate::program::{fixtures, peak_kib, program};

/// What a run may hold that refuses its input: the program, its threads, a band. In KiB.
const SMALL: u64 = 150_000;

/// How a run ended, and the most memory it was seen to hold, in KiB.
struct Ended {
    code: Option<i32>,
    sentence: String,
    peak: u64,
}

fn develop(folder: &Path, input: &str) -> Ended {
    let mut command = program();
    command.args(["develop", input, "out.png", "--look", "look.toml"]).current_dir(folder);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut peak = 0;
    while child.try_wait().unwrap().is_none() {
        peak = peak.max(peak_kib(&child));
        thread::sleep(time::Duration::from_micros(300));
    }
    let output = child.wait_with_output().unwrap();
    Ended { code: output.status.code(), sentence: String::from_utf8(output.stderr).unwrap(), peak }
}

fn folder(look: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("look.toml"), look).unwrap();
    folder
}

fn corpus(name: &str) -> Vec<u8> {
    fs::read(fixtures().join("corpus").join(name)).unwrap()
}

/// The bytes after `head` overwritten.
fn edited(mut file: Vec<u8>, head: &[u8], with: &[u8]) -> Vec<u8> {
    let at = file.windows(head.len()).position(|window| window == head).unwrap() + head.len();
    file.splice(at..at + with.len(), with.iter().copied());
    file
}

const WINDOW: &[u8] = b"dataWindow\0box2i\0\x10\0\0\0";

/// A data window of so many pixels.
fn window(width: i32, height: i32) -> Vec<u8> {
    [0, 0, width - 1, height - 1].iter().flat_map(|corner: &i32| corner.to_le_bytes()).collect()
}

/// One tile as large as the picture.
fn one_tile(side: usize, compression: Compression) -> Vec<u8> {
    let encoding =
        Encoding { compression, blocks: Blocks::Tiles(Vec2(side, side)), line_order: LineOrder::Unspecified };
    let grey = |Vec2(x, y): Vec2<usize>| f16::from_f32(((x / 8 + y / 8) % 97) as f32);
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| (grey(at), grey(at), grey(at)));
    let layer = Layer::new((side, side), LayerAttributes::default(), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::new(ImageAttributes::with_size((side, side)), layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// The same, but claimed only, in a file that is long enough to make it possible.
fn claimed_tile(side: u16) -> Vec<u8> {
    let claimed = edited(one_tile(64, Compression::ZIP16), WINDOW, &window(side.into(), side.into()));
    let tile = [u32::from(side).to_le_bytes(); 2].concat();
    let mut claimed = edited(claimed, b"tiledesc\0\x09\0\0\0", &tile);
    claimed.resize(1 << 22, 0x5a);
    claimed
}

fn png(header: [u8; 13], data: &[u8]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8; 4], data: &[u8]| {
        file.extend((data.len() as u32).to_be_bytes());
        let start = file.len();
        file.extend(kind);
        file.extend(data);
        let crc = file[start..].iter().fold(!0_u32, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
        });
        file.extend((!crc).to_be_bytes());
    };
    chunk(b"IHDR", &header);
    chunk(b"IDAT", data);
    chunk(b"IEND", &[]);
    file
}

#[test]
fn claims_are_refused_before_memory_is_taken() {
    let folder = folder("version = 1\napproach = \"clip\"\n");
    let scan = || corpus("exr/zip-lines.exr");
    // 16000 x 16000 RGBA of 16 bits in 2 MB is what Deflate can just pack.
    let interlaced = [0, 0, 0x3e, 0x80, 0, 0, 0x3e, 0x80, 16, 6, 0, 0, 1];
    let claims: [(&str, Vec<u8>, &str); 10] = [
        ("billion", edited(scan(), WINDOW, &window(1_000_000_000, 1_000_000_000)), "data window"),
        ("large", edited(scan(), WINDOW, &window(60_000, 60_000)), "expected up to 268435456 pixels"),
        ("short", edited(scan(), WINDOW, &window(16_000, 16_000)), "cannot hold"),
        (
            "tile",
            edited(one_tile(8, Compression::ZIP16), b"tiledesc\0\x09\0\0\0", &[0, 0, 1, 0, 0, 0, 1, 0]),
            "a tile is",
        ),
        ("deep", corpus("exr/refused-deep.exr"), "deep data"),
        ("parts", parts(), "OpenEXR header"),
        ("bomb", claimed_tile(10_000), "takes 2289 MiB of memory at once, expected up to 1024 MiB"),
        ("interlaced", png(interlaced, &vec![0; 2_000_000]), "takes 1954 MiB of memory at once"),
        ("tag", corpus("tiff/found-tag-of-many-numbers.tif"), "claims 8388608 numbers"),
        ("strip", strip(), "takes 1099 MiB of memory at once"),
    ];
    for (name, bytes, expected) in claims {
        fs::write(folder.path().join(name), bytes).unwrap();
        let Ended { code, sentence, peak } = develop(folder.path(), name);
        assert_eq!(code, Some(2), "{name}: {sentence}");
        assert!(sentence.contains(expected) && sentence.trim_end().lines().count() == 1, "{name}: {sentence}");
        assert!(peak < SMALL, "{name}: {peak} KiB");
        assert!(!folder.path().join("out.png").exists());
    }
}

/// A header that goes on for thousands of parts.
fn parts() -> Vec<u8> {
    let file = corpus("exr/parts.exr");
    let word = |at: usize| at + file[at..].iter().position(|byte| *byte == 0).unwrap() + 1;
    let mut end = 8;
    while file[end] != 0 {
        let size = word(word(end));
        end = size + 4 + u32::from_le_bytes(file[size..size + 4].try_into().unwrap()) as usize;
    }
    let header = &file[8..=end];
    [&file[..8], &header.repeat((4 << 20) / header.len())].concat()
}

/// A TIFF of one strip, PackBits, that claims 12000 x 12000 doubles.
fn strip() -> Vec<u8> {
    let side = 12_000_u32;
    let mut file = b"II\x2a\0\x08\0\0\0".to_vec();
    let entries = [
        (256, side),
        (257, side),
        (258, 64),
        (259, 32_773),
        (262, 1),
        (273, 200),
        (277, 1),
        (278, side),
        (279, 600_000),
        (339, 3),
    ];
    file.extend((entries.len() as u16).to_le_bytes());
    for (tag, value) in entries {
        file.extend((tag as u16).to_le_bytes());
        file.extend([4_u16.to_le_bytes(), 1_u16.to_le_bytes(), 0_u16.to_le_bytes()].concat());
        file.extend(value.to_le_bytes());
    }
    file.resize(800_000, 0);
    file
}

#[test]
fn what_is_within_the_limits_takes_what_they_say() {
    let folder = folder("version = 1\napproach = \"clip\"\n");
    let side = 2000;
    let samples = (side * side * 6 / 1024) as u64;
    // The program, its threads and a band of a small picture, in KiB: a bound that a few more copies of the samples would break.
    let program = 60_000;
    // As the reader counts: blocks while they are unpacked, and the row that waits.
    for (compression, times) in [
        (Compression::ZIP16, 4),
        (Compression::RLE, 4),
        (Compression::PIZ, 4),
        (Compression::PXR24, 4),
        (Compression::B44A, 4),
        (Compression::DWAA(None), 6),
    ] {
        fs::write(folder.path().join("a.exr"), one_tile(side, compression)).unwrap();
        let Ended { code, sentence, peak } = develop(folder.path(), "a.exr");
        assert_eq!(code, Some(0), "{compression}: {sentence}");
        assert!(peak < times * samples + program, "{compression}: {peak} KiB of {samples} KiB of samples");
        println!("{compression}: {peak} KiB, samples {samples} KiB");
        fs::remove_file(folder.path().join("out.png")).unwrap();
    }
}

#[test]
fn a_look_of_a_million_lines_is_refused() {
    let folder = folder("");
    let mut look = fs::File::create(folder.path().join("look.toml")).unwrap();
    look.write_all("version = 1\n".repeat(1_000_000).as_bytes()).unwrap();
    fs::write(folder.path().join("a.exr"), corpus("exr/zip-lines.exr")).unwrap();
    let Ended { code, sentence, peak } = develop(folder.path(), "a.exr");
    assert_eq!(code, Some(2));
    assert!(sentence.contains("look.toml: more than 65536 bytes"), "{sentence}");
    assert!(peak < SMALL, "{peak} KiB");
}
