use std::fmt::{self, Display};
use std::io::{self, BufWriter, Write};

use quick_xml::escape::escape;

use super::ClfProcess;
use super::cdl::Cdl;
use super::op::{Beyond, Direction, LogCurve, Op, Power, Range};
use crate::error::Error;
use crate::node_order::blue_fastest;
use onelight_lut::{Interpolation, Lut1d, Lut3d};

/// The `id` of a file without a name; the format wants one.
const NAMELESS: &str = "look";

/// The namespace of the format as SMPTE has it \[ST2136-1\].
pub(super) const NAMESPACE: &str = "http://www.smpte-ra.org/ns/2136-1/2024";

/// Depths of every operation: programs take the numbers as they are.
const DEPTHS: &str = r#"inBitDepth="32f" outBitDepth="32f""#;

/// What a file calls red, green and blue.
const CHANNELS: [&str; 3] = ["R", "G", "B"];

impl ClfProcess {
    /// Writes the file as text, through a buffer of its own.
    ///
    /// Every number is the shortest decimal that reads back as the same number, without an exponent.
    ///
    /// # Errors
    ///
    /// If the writer fails; what it took until then is an incomplete file.
    pub fn write(&self, writer: impl Write) -> Result<(), Error> {
        let mut out = BufWriter::with_capacity(1 << 16, writer);
        let id = if self.name.is_empty() { NAMELESS.to_owned() } else { id_of(&self.name) };
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        // Readers of the Academy's version look for the number, those of SMPTE's for the namespace.
        write!(out, r#"<ProcessList compCLFversion="3" xmlns="{NAMESPACE}" id="{}""#, escape(&id))?;
        if !self.name.is_empty() {
            write!(out, r#" name="{}""#, escape(&self.name))?;
        }
        writeln!(out, ">")?;
        for text in &self.descriptions {
            element(&mut out, "Description", text)?;
        }
        for (name, text) in [("InputDescriptor", &self.input), ("OutputDescriptor", &self.output)] {
            if !text.is_empty() {
                element(&mut out, name, text)?;
            }
        }
        for op in &self.ops {
            operation(&mut out, op)?;
        }
        writeln!(out, "</ProcessList>")?;
        out.flush()?;
        Ok(())
    }
}

/// A name as an identifier: one word.
fn id_of(name: &str) -> String {
    name.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

fn element(out: &mut impl Write, name: &str, text: &str) -> io::Result<()> {
    writeln!(out, "  <{name}>{}</{name}>", escape(text))
}

fn operation(out: &mut impl Write, op: &Op) -> io::Result<()> {
    let name = op.element();
    write!(out, "  <{name} {DEPTHS}")?;
    match op {
        Op::Matrix { rows, offset } => matrix(out, rows, offset)?,
        Op::Range(bounds) => range(out, bounds)?,
        Op::Log { direction, channels } => log(out, *direction, channels)?,
        Op::Exponent { style, channels } => {
            writeln!(out, r#" style="{}">"#, style.word())?;
            per_channel(out, "ExponentParams", channels, |power| match power {
                Power::Basic(exponent) => format!(r#" exponent="{exponent}""#),
                Power::MonCurve(coding) => {
                    format!(r#" exponent="{}" offset="{}""#, coding.exponent(), coding.offset())
                }
            })?;
        }
        Op::Cdl(list) => cdl(out, list)?,
        Op::Lut1d(lut) => lut1d(out, lut)?,
        Op::Lut3d(lut, interpolation) => lut3d(out, lut, *interpolation)?,
    }
    writeln!(out, "  </{name}>")
}

fn matrix(out: &mut impl Write, rows: &[[f64; 3]; 3], offset: &[f64; 3]) -> io::Result<()> {
    let has_offset = *offset != [0.0; 3];
    writeln!(out, ">\n    <Array dim=\"3 {}\">", if has_offset { 4 } else { 3 })?;
    for (row, offset) in rows.iter().zip(offset) {
        write!(out, "{}", Spaced(row))?;
        if has_offset {
            write!(out, " {offset}")?;
        }
        writeln!(out)?;
    }
    writeln!(out, "    </Array>")
}

fn range(out: &mut impl Write, bounds: &Range) -> io::Result<()> {
    let style = match bounds.beyond {
        Beyond::Clamp => "",
        Beyond::Continue => r#" style="noClamp""#,
    };
    writeln!(out, "{style}>")?;
    // First what goes in, then what comes out: SMPTE's schema is a sequence.
    for (side, name) in ["In", "Out"].iter().enumerate() {
        for (end, values) in [("min", bounds.low), ("max", bounds.high)] {
            if let Some(values) = values {
                writeln!(out, "    <{end}{name}Value>{}</{end}{name}Value>", values[side])?;
            }
        }
    }
    Ok(())
}

fn log(out: &mut impl Write, direction: Direction, channels: &[LogCurve; 3]) -> io::Result<()> {
    let forward = direction == Direction::Forward;
    for (base, words) in [(2.0, ["log2", "antiLog2"]), (10.0, ["log10", "antiLog10"])] {
        if *channels == [LogCurve::of_base(base); 3] {
            return writeln!(out, r#" style="{}">"#, words[usize::from(!forward)]);
        }
    }
    let camera = channels.iter().any(|curve| curve.toe.is_some());
    let style = match (camera, forward) {
        (false, true) => "linToLog",
        (false, false) => "logToLin",
        (true, true) => "cameraLinToLog",
        (true, false) => "cameraLogToLin",
    };
    writeln!(out, r#" style="{style}">"#)?;
    per_channel(out, "LogParams", channels, |curve| {
        let LogCurve { base, log_slope, log_offset, lin_slope, lin_offset, toe } = curve;
        let mut text = format!(
            r#" base="{base}" logSideSlope="{log_slope}" logSideOffset="{log_offset}" linSideSlope="{lin_slope}" linSideOffset="{lin_offset}""#
        );
        if let Some(toe) = toe {
            text += &format!(r#" linSideBreak="{}""#, toe.end);
            text += &toe.slope.map_or(String::new(), |slope| format!(r#" linearSlope="{slope}""#));
        }
        text
    })
}

fn cdl(out: &mut impl Write, list: &Cdl) -> io::Result<()> {
    let Cdl { style, slope, offset, power, saturation } = list;
    writeln!(out, r#" style="{}">"#, style.word())?;
    writeln!(out, "    <SOPNode>")?;
    for (name, values) in [("Slope", slope), ("Offset", offset), ("Power", power)] {
        writeln!(out, "      <{name}>{}</{name}>", Spaced(values))?;
    }
    writeln!(out, "    </SOPNode>")?;
    writeln!(out, "    <SatNode>\n      <Saturation>{saturation}</Saturation>\n    </SatNode>")
}

/// One element for all channels, or one for each.
fn per_channel<T: PartialEq>(
    out: &mut impl Write,
    name: &str,
    channels: &[T; 3],
    attributes: impl Fn(&T) -> String,
) -> io::Result<()> {
    let [first, rest @ ..] = channels;
    if rest.iter().all(|channel| channel == first) {
        return writeln!(out, "    <{name}{}/>", attributes(first));
    }
    for (letter, channel) in CHANNELS.iter().zip(channels) {
        writeln!(out, r#"    <{name} channel="{letter}"{}/>"#, attributes(channel))?;
    }
    Ok(())
}

fn lut1d(out: &mut impl Write, lut: &Lut1d) -> io::Result<()> {
    let one = lut.entries().iter().all(|[r, g, b]| r.to_bits() == g.to_bits() && g.to_bits() == b.to_bits());
    let columns = if one { 1 } else { 3 };
    writeln!(out, " interpolation=\"linear\">\n    <Array dim=\"{} {columns}\">", lut.size())?;
    for entry in lut.entries() {
        writeln!(out, "{}", Spaced(&entry[..columns]))?;
    }
    writeln!(out, "    </Array>")
}

/// The table's array, in which blue runs fastest.
fn lut3d(out: &mut impl Write, lut: &Lut3d, interpolation: Interpolation) -> io::Result<()> {
    let how = match interpolation {
        Interpolation::Trilinear => "trilinear",
        Interpolation::Tetrahedral => "tetrahedral",
    };
    let size = lut.size();
    writeln!(out, " interpolation=\"{how}\">\n    <Array dim=\"{size} {size} {size} 3\">")?;
    for (_, entry) in blue_fastest(lut) {
        writeln!(out, "{}", Spaced(&entry))?;
    }
    writeln!(out, "    </Array>")
}

/// Numbers with one space between them.
struct Spaced<'a, T>(&'a [T]);

impl<T: Display> Display for Spaced<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, number) in self.0.iter().enumerate() {
            write!(f, "{}{number}", if i == 0 { "" } else { " " })?;
        }
        Ok(())
    }
}
