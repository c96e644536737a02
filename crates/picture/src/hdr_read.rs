//! Reading Radiance pictures (.hdr, .pic): shared exponents, run-length coded in scan lines.

use std::io::{BufRead, Read};

use crate::{
    band::{Band, Bands, ReadingMemory, blocks_in_band},
    decoder_message::one_line,
    description::{Channels, Chromaticities, Description, Source, Tristimulus},
    error::{Error, HdrProblem, Kind},
    file_colours::FileColours,
    input::Input,
    limits::{Limits, allocate, check_claim},
    orientation::{Orientation, upright},
    transfer::Transfer,
};

/// Most bytes of the header.
const MAX_HEADER: u64 = 1 << 16;
/// A run of 127 bytes takes two.
const EXPANSION: u64 = 64;
/// Widths that scan lines of separate channels can have.
const SEPARATE: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// Opens a Radiance picture of `length` bytes.
pub(crate) fn open<'a>(
    mut reader: Input<'a>,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    let header = Header::read(&mut reader)?;
    let [width, height] = header.size;
    limits.check_size("the picture", width, height)?;
    check_claim(header.size, width * height * 4, length, EXPANSION)?;
    let (width, height) = (width as usize, height as usize);
    let mut description = Description::new(width, height, Channels::Rgb, Source::RadianceHdr);
    let colours = FileColours {
        primaries: header.primaries.or(header.is_xyz.then_some(Chromaticities::XYZ)),
        transfer: Some(Transfer::Linear),
        said_by: if header.primaries.is_some() { "the header's PRIMARIES".to_owned() } else { String::new() },
    };
    colours.describe(&mut description);
    if header.is_xyz {
        description.tristimulus = Tristimulus::Xyz;
        description.notes.push("the file's values are the light's CIE XYZ".to_owned());
    }
    let scale = header.exposure.map(|exposure| 1.0 / exposure);
    if scale != [1.0; 3] {
        description
            .notes
            .push("divided the values by the exposure and colour correction of the file's header".to_owned());
    }
    let row = allocate(width, [0; 4])?;
    let bands = HdrBands { reader, size: [width, height], scale, row, next: 0 };
    upright(header.orientation, description, Box::new(bands), limits)
}

/// What stands before the pixels.
struct Header {
    /// Columns and rows of scan lines, as stored.
    size: [u64; 2],
    orientation: Orientation,
    is_xyz: bool,
    primaries: Option<Chromaticities>,
    /// What red, green and blue were multiplied by.
    exposure: [f32; 3],
}

impl Header {
    fn read(reader: &mut Input<'_>) -> Result<Self, Error> {
        let mut lines = reader.by_ref().take(MAX_HEADER);
        let mut header = Self {
            size: [0; 2],
            orientation: Orientation::default(),
            is_xyz: false,
            primaries: None,
            exposure: [1.0; 3],
        };
        loop {
            let line = line(&mut lines)?;
            let Some((key, value)) = line.split_once('=') else {
                if line.trim().is_empty() {
                    break;
                }
                continue;
            };
            let numbers: Vec<f32> = value.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let fits = |v: &f32| v.is_finite() && *v > 0.0;
            match (key.trim(), &numbers[..]) {
                ("FORMAT", _) => {
                    header.is_xyz = match value.trim() {
                        "32-bit_rle_rgbe" => false,
                        "32-bit_rle_xyze" => true,
                        other => return Err(HdrProblem::Format { found: one_line(other) }.into()),
                    };
                }
                // Each of several holds: they multiply.
                ("EXPOSURE", [exposure]) if fits(exposure) => {
                    header.exposure = header.exposure.map(|own| own * exposure);
                }
                ("COLORCORR", [r, g, b]) if [r, g, b].into_iter().all(fits) => {
                    let [own_r, own_g, own_b] = header.exposure;
                    header.exposure = [own_r * r, own_g * g, own_b * b];
                }
                ("PRIMARIES", &[rx, ry, gx, gy, bx, by, wx, wy]) => {
                    header.primaries =
                        Some(Chromaticities { red: [rx, ry], green: [gx, gy], blue: [bx, by], white: [wx, wy] });
                }
                _ => {}
            }
        }
        if !header.exposure.iter().all(|v| v.is_normal()) {
            header.exposure = [1.0; 3];
        }
        let line = line(&mut lines)?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let refused = || Error::from(HdrProblem::Resolution { found: one_line(&line) });
        let [first, count, second, other] = words[..] else { return Err(refused()) };
        let (rows, columns) = (count.parse::<u64>().map_err(|_| refused())?, other.parse().map_err(|_| refused())?);
        // The first axis is that of scan lines; -Y counts down and +X to the right, as usual.
        header.orientation = Orientation::from_exif(Some(match (first, second) {
            ("-Y", "+X") => 1,
            ("-Y", "-X") => 2,
            ("+Y", "-X") => 3,
            ("+Y", "+X") => 4,
            ("+X", "-Y") => 5,
            ("-X", "-Y") => 6,
            ("-X", "+Y") => 7,
            ("+X", "+Y") => 8,
            _ => return Err(refused()),
        }));
        header.size = [columns, rows];
        Ok(header)
    }
}

/// One line of the header.
fn line(reader: &mut impl BufRead) -> Result<String, Error> {
    let mut bytes = Vec::new();
    reader.read_until(b'\n', &mut bytes)?;
    if bytes.pop() != Some(b'\n') {
        return Err(HdrProblem::Header.into());
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The scan lines of a picture.
struct HdrBands<'a> {
    reader: Input<'a>,
    size: [usize; 2],
    scale: [f32; 3],
    row: Vec<[u8; 4]>,
    next: usize,
}

impl Bands for HdrBands<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let [width, height] = self.size;
        let rows = blocks_in_band(width, 1).min(height - self.next);
        band.become_rows(self.next, rows, width, Channels::Rgb)?;
        for line in band.rgb_mut().chunks_exact_mut(width) {
            self.scan_line()?;
            for (colour, pixel) in line.iter_mut().zip(&self.row) {
                *colour = light(*pixel, self.scale);
            }
        }
        self.next += rows;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let [width, height] = self.size;
        let rows = blocks_in_band(width, 1).min(height);
        ReadingMemory { band_pixels: width as u64 * rows as u64, bytes_beside: 4 * width as u64 }
    }
}

/// A mantissa of 8 bits for each of three, and an exponent for all. Radiance itself adds half a step; other readers do not,
/// and neither does this, so that a channel without light stays without.
fn light([r, g, b, exponent]: [u8; 4], scale: [f32; 3]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = f64::from(i32::from(exponent) - 136).exp2();
    let value = |mantissa: u8, scale: f32| (f64::from(mantissa) * unit * f64::from(scale)) as f32;
    [value(r, scale[0]), value(g, scale[1]), value(b, scale[2])]
}

impl HdrBands<'_> {
    /// Unpacks the next scan line into `row`.
    fn scan_line(&mut self) -> Result<(), Error> {
        let width = self.size[0];
        let start = self.bytes()?;
        let separate = start[0] == 2 && start[1] == 2 && start[2] < 128 && SEPARATE.contains(&width);
        if !separate {
            return self.mixed(start);
        }
        if usize::from(u16::from_be_bytes([start[2], start[3]])) != width {
            return Err(HdrProblem::ScanLine { row: self.next }.into());
        }
        for channel in 0..4 {
            let mut at = 0;
            while at < width {
                let count = usize::from(self.byte()?);
                let (count, run) = if count > 128 { (count - 128, Some(self.byte()?)) } else { (count, None) };
                if count == 0 || count > width - at {
                    return Err(HdrProblem::ScanLine { row: self.next }.into());
                }
                for pixel in at..at + count {
                    self.row[pixel][channel] = match run {
                        Some(value) => value,
                        None => self.byte()?,
                    };
                }
                at += count;
            }
        }
        Ok(())
    }

    /// Whole pixels, of which (1, 1, 1, n) repeats the one before: once, or 256 times as often for each before it.
    fn mixed(&mut self, first: [u8; 4]) -> Result<(), Error> {
        let width = self.size[0];
        let (mut at, mut shift, mut pixel) = (0, 0, first);
        loop {
            if let [1, 1, 1, count] = pixel {
                let count = usize::from(count) << shift;
                if at == 0 || count > width - at {
                    return Err(HdrProblem::ScanLine { row: self.next }.into());
                }
                let before = self.row[at - 1];
                self.row[at..at + count].fill(before);
                at += count;
                shift = (shift + 8).min(24);
            } else {
                self.row[at] = pixel;
                at += 1;
                shift = 0;
            }
            if at == width {
                return Ok(());
            }
            pixel = self.bytes()?;
        }
    }

    fn byte(&mut self) -> Result<u8, Error> {
        let [byte] = self.some()?;
        Ok(byte)
    }

    fn bytes(&mut self) -> Result<[u8; 4], Error> {
        self.some()
    }

    fn some<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let mut bytes = [0; N];
        self.reader.read_exact(&mut bytes).map_err(|error| match error.kind() {
            std::io::ErrorKind::UnexpectedEof => Error::from(Kind::EndsEarly),
            _ => error.into(),
        })?;
        Ok(bytes)
    }
}
