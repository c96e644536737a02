//! Files that were hit: no panic, no great allocation; one sentence or a whole picture.

use super::{
    exr::{COMPRESSIONS, Stored, file, floats, halves, layer},
    plain::{png_files, tiff_files},
    *,
};

/// A good file, its name in messages, and the number of its bytes that are header.
type Good = (String, Vec<u8>);

fn good_files() -> Vec<Good> {
    let picture = sample(37, 35);
    let mut files = Vec::new();
    for compression in COMPRESSIONS {
        for stored in [Stored::lines(compression), Stored::tiles(compression)] {
            let channels = [
                ("R", halves(&picture, 0)),
                ("G", halves(&picture, 1)),
                ("B", floats(&picture, 2)),
                ("A", halves(&picture, 0)),
            ];
            files.push((format!("{stored:?}"), file(vec![layer(None, [37, 35], stored, &channels)])));
        }
    }
    files.extend(png_files());
    files.extend(tiff_files());
    files
}

fn assert_sound(name: &str, bytes: &[u8]) {
    // Small limits, so that a damaged header does not make the test slow.
    let limits = Limits { max_pixels: 1 << 14, max_side: 1 << 12, max_bytes: 1 << 26 };
    match Picture::read(Cursor::new(bytes), "", limits) {
        Ok(picture) => {
            let count = picture.width * picture.height;
            assert_eq!(picture.rgb.len(), count, "{name}");
            assert!(picture.alpha.is_none_or(|alpha| alpha.len() == count), "{name}");
        }
        Err(error) => {
            let sentence = error.to_string();
            assert!(!sentence.is_empty() && !sentence.contains('\n'), "{name}: {sentence:?}");
            let kinds = [error.is_damaged(), error.is_unsupported(), error.is_limit()];
            assert_eq!(kinds.iter().filter(|is| **is).count(), 1, "{name}: {sentence}");
        }
    }
}

#[test]
fn flipped_bytes_do_no_harm() {
    let mut random = Random(1);
    for (name, good) in good_files() {
        for round in 0..200 {
            let mut bytes = good.clone();
            for _ in 0..=round % 3 {
                // Half of the blows go to the first bytes, where the structure is.
                let end = if round % 2 == 0 { bytes.len() } else { bytes.len().min(600) };
                let at = random.below(end);
                bytes[at] = match random.below(4) {
                    0 => 0,
                    1 => 0xff,
                    2 => bytes[at] ^ (1 << random.below(8)),
                    _ => random.below(256) as u8,
                };
            }
            assert_sound(&format!("{name}, round {round}"), &bytes);
        }
    }
}

#[test]
fn truncated_files_are_refused() {
    for (name, good) in good_files() {
        let step = (good.len() / 60).max(1);
        for length in (0..good.len()).step_by(step) {
            assert_sound(&name, &good[..length]);
            // A PNG and a TIFF may end with what no pixel needs.
            let must_fail = name.starts_with("Stored") || length < good.len() / 2;
            assert!(!must_fail || read_bytes(&good[..length]).is_err(), "{name} cut to {length} bytes");
        }
    }
}

#[test]
fn a_table_that_shows_a_block_twice_is_refused() {
    let picture = sample(37, 35);
    let channels = [("R", halves(&picture, 0)), ("G", halves(&picture, 1)), ("B", halves(&picture, 2))];
    for stored in [Stored::lines(COMPRESSIONS[2]), Stored::tiles(COMPRESSIONS[3])] {
        let mut bytes = file(vec![layer(None, [37, 35], stored, &channels)]);
        // The table begins where the first offset points back to its own end.
        let count = if matches!(stored.blocks, ::exr::prelude::Blocks::ScanLines) { 35 } else { 3 * 5 };
        let table =
            (0..bytes.len() - 8).find(|at| bytes[*at..at + 8] == ((at + 8 * count) as u64).to_le_bytes()).unwrap();
        let first = bytes[table..table + 8].to_vec();
        bytes[table + 8..table + 16].copy_from_slice(&first);
        assert!(refusal(&bytes).contains("block 2 of"), "{}", refusal(&bytes));
        bytes[table..table + 8].fill(0);
        assert!(refusal(&bytes).contains("block 1 of"), "{}", refusal(&bytes));
    }
}

#[test]
fn a_dwa_block_that_claims_the_world_is_refused() {
    let picture = sample(64, 64);
    let channels = [
        ("R", halves(&picture, 0)),
        ("G", halves(&picture, 1)),
        ("B", halves(&picture, 2)),
        ("A", halves(&picture, 0)),
    ];
    let good = file(vec![layer(None, [64, 64], Stored::lines(COMPRESSIONS[8]), &channels)]);
    let table = (0..good.len() - 8).find(|at| good[*at..at + 8] == ((at + 16) as u64).to_le_bytes()).unwrap();
    let counters = table + 16 + 8;
    for counter in [1, 6, 7, 8, 9] {
        for claim in [1_u64 << 40, i64::MAX as u64] {
            let mut bytes = good.clone();
            bytes[counters + counter * 8..][..8].copy_from_slice(&claim.to_le_bytes());
            assert!(refusal(&bytes).contains("a DWA block claims"), "counter {counter}: {}", refusal(&bytes));
        }
    }
}
