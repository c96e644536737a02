use std::fmt::Debug;

use half::f16;
use onelight::lut::{Interpolation, Lut3d};
use onelight_formats::{ClfProcess, CubeFile, PngDepth, StripGreen, direct_json, hald, spi3d, strip};

use super::{Met, hard_colours, refused};

const BOTH: [Interpolation; 2] = [Interpolation::Trilinear, Interpolation::Tetrahedral];

/// A `.cube` gives finite colours for all colours, and is the same when written and read again.
pub fn cube(bytes: &[u8]) -> Met {
    let file = match CubeFile::read(bytes) {
        Ok(file) => file,
        Err(error) => return refused(&error),
    };
    for rgb in hard_colours() {
        for interpolation in BOTH {
            finite(rgb, file.apply(rgb, interpolation));
        }
    }
    written_again(&file, |file, out| file.write(out), |bytes| CubeFile::read(bytes));
    Met::Read
}

/// A CLF is the same when written and read again; one that ends in a table gives finite colours for all colours.
pub fn clf(bytes: &[u8]) -> Met {
    let process = match ClfProcess::read(bytes) {
        Ok(process) => process,
        Err(error) => return refused(&error),
    };
    let ends_in_table = process.operations().last().is_some_and(|last| last.starts_with("LUT"));
    for rgb in hard_colours() {
        let out = process.apply(rgb);
        if ends_in_table {
            finite(rgb, out);
        }
    }
    written_again(&process, |process, out| process.write(out), |bytes| ClfProcess::read(bytes));
    Met::Read
}

/// An `.spi3d` gives finite colours for all colours, and is the same when written and read again.
pub fn spi3d(bytes: &[u8]) -> Met {
    match spi3d::read(bytes) {
        Ok(table) => {
            applied(&table);
            written_again(&table, |table, out| spi3d::write(out, table), |bytes| spi3d::read(bytes));
            Met::Read
        }
        Err(error) => refused(&error),
    }
}

/// The JSON of a direct form is applied to all colours, and is the same when written and read again. What it gives may be
/// infinite or NaN: its weights may be as large as floats are.
pub fn direct_form(bytes: &[u8]) -> Met {
    match direct_json::read(bytes) {
        Ok(form) => {
            for rgb in hard_colours() {
                std::hint::black_box(form.apply(rgb));
            }
            written_again(
                &form,
                |form, out| direct_json::write(out, form, ["a comment"]),
                |bytes| direct_json::read(bytes),
            );
            Met::Read
        }
        Err(error) => refused(&error),
    }
}

/// A KTX2 file of ours, which we write and do not read, holds the table and the comment for an independent reader: the
/// bytes are the table's size, the comment with its length, and entries as `f32`.
pub fn ktx2(bytes: &[u8]) -> Met {
    let [size, length, rest @ ..] = bytes else { return Met::Refused };
    let size = Lut3d::MIN_SIZE + usize::from(size % 8);
    let (comment, rest) = rest.split_at(usize::from(*length).min(rest.len()));
    let comment = String::from_utf8_lossy(comment);
    let (words, _) = rest.as_chunks::<4>();
    let mut values = words.iter().map(|word| f32::from_le_bytes(*word)).chain(std::iter::repeat(0.5));
    let mut value = || values.next().unwrap_or_default();
    let entries = (0..size.pow(3)).map(|_| [value(), value(), value()]).collect();
    let table = match Lut3d::new(size, entries) {
        Ok(table) => table,
        Err(error) => return refused(&error),
    };
    let mut file = Vec::new();
    if let Err(error) = onelight_formats::ktx2::write(&mut file, &table, [&comment]) {
        return refused(&error);
    }
    let reader = ktx2::Reader::new(&file).unwrap_or_else(|error| panic!("the file is no KTX2: {error}"));
    let header = reader.header();
    assert_eq!([header.pixel_width, header.pixel_height, header.pixel_depth], [size as u32; 3]);
    let level = reader.levels().next().unwrap_or_else(|| panic!("no level"));
    let (texels, rest) = level.data.as_chunks::<8>();
    assert_eq!((texels.len(), rest.len()), (size.pow(3), 0));
    for (texel, [r, g, b]) in texels.iter().zip(table.entries()) {
        let halves = [r, g, b, 1.0].map(f16::from_f32);
        assert_eq!(texel.as_chunks::<2>().0, halves.map(f16::to_le_bytes));
    }
    for (key, value) in reader.key_value_data() {
        assert!(key == "KTXwriter" || key == "comment", "{key:?}");
        assert_eq!(value.last(), Some(&0), "{key:?}");
    }
    Met::Read
}

/// A PNG as a Hald or a strip: a table that is read gives finite colours, and is the same when written and read again.
pub(super) fn png(bytes: &[u8]) {
    match hald::read(bytes) {
        Ok(table) => {
            applied(&table);
            let write = |table: &Lut3d, out: &mut Vec<u8>| hald::write(out, table, PngDepth::Sixteen, [""; 0]);
            written_again(&table, write, |bytes| hald::read(bytes));
        }
        Err(error) => _ = refused(&error),
    }
    for green in [StripGreen::Down, StripGreen::Up] {
        match strip::read(bytes, green) {
            Ok(table) => {
                let write =
                    |table: &Lut3d, out: &mut Vec<u8>| strip::write(out, table, PngDepth::Sixteen, green, [""; 0]);
                written_again(&table, write, |bytes| strip::read(bytes, green));
            }
            Err(error) => _ = refused(&error),
        }
    }
}

fn applied(table: &Lut3d) {
    for rgb in hard_colours() {
        for interpolation in BOTH {
            finite(rgb, table.apply(rgb, interpolation));
        }
    }
}

fn finite(rgb: [f32; 3], out: [f32; 3]) {
    assert!(out.iter().all(|v| v.is_finite()), "{rgb:?} became {out:?}");
}

/// What was read comes back from its own file, and that file is the same again.
fn written_again<T: PartialEq + Debug, E: Debug>(
    read: &T,
    write: impl Fn(&T, &mut Vec<u8>) -> Result<(), E>,
    read_again: impl Fn(&[u8]) -> Result<T, E>,
) {
    let text = |value: &T| {
        let mut out = Vec::new();
        write(value, &mut out).unwrap_or_else(|error| panic!("cannot be written: {error:?}"));
        out
    };
    let first = text(read);
    let again = read_again(&first).unwrap_or_else(|error| {
        panic!("our own file is refused: {error:?}\n{}", String::from_utf8_lossy(&first));
    });
    assert!(again == *read, "{read:?}\nbecame\n{again:?}\nby\n{}", String::from_utf8_lossy(&first));
    assert!(text(&again) == first, "written twice, the files differ");
}
