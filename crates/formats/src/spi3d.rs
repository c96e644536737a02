//! `.spi3d`: a table as text.

use std::io::{BufWriter, Read, Write};

use onelight_lut::Lut3d;

use crate::error::{Error, TextProblem};
use crate::node_order::{blue_fastest, place_of};
use crate::text::{number, quoted, read_text};

/// The most bytes of an `.spi3d` file that are read.
const MAX_BYTES: u64 = 1 << 30;

/// Writes a table as `.spi3d`, the 3D table of Sony Pictures Imageworks, over coordinates from 0 to 1.
///
/// The format has neither a shaper nor comments: a [`crate::OcioConfig`] can go beside it. OpenColorIO clamps what
/// goes in to 0 to 1. Numbers are the shortest decimals that read back as the same `f32`.
///
/// # Errors
///
/// If the writer fails; what it took until then is an incomplete file.
///
/// ```
/// use onelight_formats::spi3d;
///
/// let table = onelight_lut::Lut3d::identity(2)?;
/// let mut file = Vec::new();
/// spi3d::write(&mut file, &table)?;
/// assert!(file.starts_with(b"SPILUT 1.0\n3 3\n2 2 2\n0 0 0 0 0 0\n"));
/// assert_eq!(spi3d::read(file.as_slice())?, table);
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write(writer: impl Write, table: &Lut3d) -> Result<(), Error> {
    let mut out = BufWriter::with_capacity(1 << 16, writer);
    let size = table.size();
    writeln!(out, "SPILUT 1.0\n3 3\n{size} {size} {size}")?;
    // Blue fastest, as the format's other writers have it; readers go by the indices.
    for ([red, green, blue], [r, g, b]) in blue_fastest(table) {
        writeln!(out, "{red} {green} {blue} {r} {g} {b}")?;
    }
    out.flush()?;
    Ok(())
}

/// Reads an `.spi3d` file, to its end, of at most 1 GiB.
///
/// Entries may come in any order, every node once. Blank lines and lines that start with `#` are skipped.
///
/// # Errors
///
/// If the input fails or is too large, the header is not that of a table with three equal sizes in bounds (see [`Lut3d`]),
/// a node is missing, comes twice or lies outside, or a number is not finite in `f32`.
pub fn read(input: impl Read) -> Result<Lut3d, Error> {
    let text = read_text(input, MAX_BYTES)?;
    let mut lines = Lines { text: text.lines().enumerate(), last: 1 };
    let size = header(&mut lines)?;
    let count = size.pow(3);
    // A size is believed only where the file is long enough.
    let mut ahead = lines.clone();
    let found = std::iter::from_fn(|| ahead.next_words()).take(count).count();
    if found < count {
        return Err(Error::text(ahead.last, TextProblem::Truncated { found, expected: count }));
    }
    // A NaN is a node that has not come: no number of the file is one.
    let mut entries = vec![[f32::NAN; 3]; count];
    let mut found = 0;
    while let Some((line, words)) = lines.next_words() {
        let fail = |problem| Error::text(line, problem);
        if found == count {
            return Err(fail(TextProblem::TooManyDataLines { expected: count }));
        }
        let (node, entry) = entry(words).map_err(fail)?;
        let outside = || unexpected("node", quoted(words), "three indices below the size");
        let index = node.iter().all(|&i| i < size).then(|| place_of(node, size));
        let slot = index.and_then(|index| entries.get_mut(index)).ok_or_else(outside).map_err(fail)?;
        if !slot[0].is_nan() {
            return Err(fail(unexpected("node", format!("{node:?} again"), "every node once")));
        }
        *slot = entry;
        found += 1;
    }
    Ok(Lut3d::new(size, entries)?)
}

/// Lines that say something, counted from 1.
#[derive(Clone)]
struct Lines<'a> {
    text: std::iter::Enumerate<std::str::Lines<'a>>,
    last: usize,
}

impl<'a> Lines<'a> {
    fn next_words(&mut self) -> Option<(usize, &'a str)> {
        loop {
            let (index, line) = self.text.next()?;
            self.last = index + 1;
            let line = line.trim();
            if !line.is_empty() && !line.starts_with('#') {
                return Some((self.last, line));
            }
        }
    }

    /// The next line, where the header still wants one.
    fn expect(&mut self, expected: &'static str) -> Result<(usize, &'a str), Error> {
        self.next_words()
            .ok_or_else(|| Error::text(self.last, unexpected("header", "the end of the file".to_owned(), expected)))
    }
}

fn header(lines: &mut Lines<'_>) -> Result<usize, Error> {
    let (line, words) = lines.expect("SPILUT 1.0")?;
    let heading = words.split_ascii_whitespace().map(str::to_ascii_uppercase);
    if !heading.eq(["SPILUT", "1.0"].map(str::to_owned)) {
        return Err(Error::text(line, unexpected("first line", format!("{:?}", quoted(words)), "SPILUT 1.0")));
    }
    let (line, words) = lines.expect("3 3")?;
    if !words.split_ascii_whitespace().eq(["3", "3"]) {
        let found = format!("{:?}", quoted(words));
        return Err(Error::text(line, unexpected("channels in and out", found, "3 3")));
    }
    let expected = "three times the same size from 2 to 256";
    let (line, words) = lines.expect(expected)?;
    let sizes: Vec<Option<usize>> = words.split_ascii_whitespace().take(4).map(|word| word.parse().ok()).collect();
    match sizes.as_slice() {
        &[Some(size @ Lut3d::MIN_SIZE..=Lut3d::MAX_SIZE), Some(green), Some(blue)] if green == size && blue == size => {
            Ok(size)
        }
        _ => Err(Error::text(line, unexpected("sizes", format!("{:?}", quoted(words)), expected))),
    }
}

fn entry(words: &str) -> Result<([usize; 3], [f32; 3]), TextProblem> {
    let all: [&str; 6] = words
        .split_ascii_whitespace()
        .collect::<Vec<_>>()
        .try_into()
        .map_err(|all: Vec<_>| TextProblem::NumberCount { what: "a data line", found: all.len(), expected: 6 })?;
    let [r, g, b, values @ ..] = all;
    let mut node = [0; 3];
    for (index, word) in node.iter_mut().zip([r, g, b]) {
        *index = word.parse().map_err(|_| unexpected("node", quoted(word), "three indices below the size"))?;
    }
    let mut entry = [0.0; 3];
    for (value, word) in entry.iter_mut().zip(values) {
        *value = number("a data line", word)?;
    }
    Ok((node, entry))
}

fn unexpected(what: &'static str, found: String, expected: &'static str) -> TextProblem {
    TextProblem::Unexpected { what, found, expected }
}
