use std::io::Write;

use super::CubeFile;
use crate::error::Error;
use onelight_lut::{Domain, Lut1d, Lut3d};

/// Bytes gathered before they go to the writer.
const BLOCK: usize = 1 << 16;

impl CubeFile {
    /// Writes the file as text, in blocks, so the writer needs no buffer of its own.
    ///
    /// OpenColorIO knows no `TITLE` in Resolve's form, so there the title goes into a comment, `# TITLE "..."`,
    /// which [`CubeFile::read`] knows again.
    ///
    /// Every number is the shortest decimal that reads back as the same `f32`, without an exponent, which some
    /// programs do not read. So nothing is lost to rounding at any magnitude, where a fixed number of decimals
    /// either wears shadows away or fills the file with noise.
    ///
    /// # Errors
    ///
    /// If the writer fails; what it took until then is an incomplete file.
    pub fn write(&self, writer: impl Write) -> Result<(), Error> {
        let mut out = Blocks { writer, block: Vec::with_capacity(BLOCK + 1024) };
        self.write_text(&mut out.block)?;
        self.write_sizes(&mut out.block)?;
        for &entry in self.lut1d().map(Lut1d::entries).into_iter().flatten() {
            out.numbers(entry)?;
        }
        for entry in self.lut3d().map(Lut3d::entries).into_iter().flatten() {
            out.numbers(entry)?;
        }
        out.finish()
    }

    fn write_text(&self, out: &mut Vec<u8>) -> Result<(), Error> {
        let title = self.title();
        if !title.is_empty() {
            let mark = match (&self.lut1d, &self.lut3d) {
                (Some(_), Some(_)) => "# ",
                _ => "",
            };
            writeln!(out, "{mark}TITLE \"{title}\"")?;
        }
        for comment in self.comments() {
            let space = if comment.is_empty() { "" } else { " " };
            writeln!(out, "#{space}{comment}")?;
        }
        Ok(())
    }

    fn write_sizes(&self, out: &mut Vec<u8>) -> Result<(), Error> {
        match (&self.lut1d, &self.lut3d) {
            (Some(lut1d), Some((domain3d, lut3d))) => {
                writeln!(out, "LUT_1D_SIZE {}", lut1d.size())?;
                write_range(out, "LUT_1D_INPUT_RANGE", lut1d.domain())?;
                writeln!(out, "LUT_3D_SIZE {}", lut3d.size())?;
                write_range(out, "LUT_3D_INPUT_RANGE", domain3d)
            }
            (Some(lut), None) => {
                writeln!(out, "LUT_1D_SIZE {}", lut.size())?;
                write_domain(out, lut.domain())
            }
            (None, Some((domain, lut))) => {
                writeln!(out, "LUT_3D_SIZE {}", lut.size())?;
                write_domain(out, domain)
            }
            (None, None) => Ok(()),
        }
    }
}

/// The constructors have seen to it that all channels share the ends of a range.
fn write_range(out: &mut Vec<u8>, keyword: &str, domain: &Domain) -> Result<(), Error> {
    let [min, max] = [domain.min()[0], domain.max()[0]];
    Ok(writeln!(out, "{keyword} {min} {max}")?)
}

fn write_domain(out: &mut Vec<u8>, domain: &Domain) -> Result<(), Error> {
    if *domain != Domain::UNIT {
        for (keyword, [r, g, b]) in [("DOMAIN_MIN", domain.min()), ("DOMAIN_MAX", domain.max())] {
            writeln!(out, "{keyword} {r} {g} {b}")?;
        }
    }
    Ok(())
}

struct Blocks<W> {
    writer: W,
    block: Vec<u8>,
}

impl<W: Write> Blocks<W> {
    fn numbers(&mut self, [r, g, b]: [f32; 3]) -> Result<(), Error> {
        let start = self.block.len();
        write!(self.block, "{r}")?;
        let end = self.block.len();
        // The curves of a shaper are equal in all channels, and copying is cheaper than formatting.
        for (number, before) in [(g, r), (b, r)] {
            self.block.push(b' ');
            if number.to_bits() == before.to_bits() {
                self.block.extend_from_within(start..end);
            } else {
                write!(self.block, "{number}")?;
            }
        }
        self.block.push(b'\n');
        if self.block.len() >= BLOCK {
            self.writer.write_all(&self.block)?;
            self.block.clear();
        }
        Ok(())
    }

    fn finish(mut self) -> Result<(), Error> {
        self.writer.write_all(&self.block)?;
        self.writer.flush()?;
        Ok(())
    }
}
