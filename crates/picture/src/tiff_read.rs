//! Reading TIFF: grey, palette and RGB, with and without alpha, of 1 to 32 bits or floating point.

use rayon::prelude::*;

#[cfg(feature = "icc")]
use crate::icc;
use crate::{
    alpha,
    band::{BAND_PIXELS, Band, Bands, ReadingMemory, RowMut, blocks_in_band},
    description::{Channels, Chromaticities, Description, Source, StoredAlpha, TiffSamples},
    error::{Error, TiffProblem},
    exif,
    file_colours::FileColours,
    input::Input,
    limits::Limits,
    metadata::ExifTags,
    orientation::{Orientation, upright},
    panic_to_error::panic_to_error,
    tiff_directory::{Directory, TiffFile},
    tiff_header::{Colours, Coverage, Header, Sample, tag},
    tiff_pages,
    transfer::Transfer,
};

/// Samples that one task widens: for fewer, handing them to a thread takes longer than the work.
const SAMPLES_TOGETHER: usize = 1 << 14;

/// Opens the picture in a TIFF file of `length` bytes.
pub(crate) fn open<'a>(
    reader: Input<'a>,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    let (mut file, first) = TiffFile::open(reader, length)?;
    let page = tiff_pages::choose(&mut file, first)?;
    let header = Header::read(&mut file, &page.directory, length, limits)?;
    let channels = if header.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
    let samples = match header.sample {
        Sample::Unsigned(_) => TiffSamples::Integer,
        Sample::Float(_) => TiffSamples::Float,
    };
    let source = Source::Tiff { bits: header.sample.bits().max(8), samples };
    let [width, height] = header.size;
    let mut description = Description::new(width, height, channels, source);
    if let Some((_, Coverage::Premultiplied)) = header.alpha {
        description.stored_alpha = StoredAlpha::Premultiplied;
    }
    description.notes.extend(page.notes);
    description.notes.extend(header.notes.iter().cloned());
    colours(&mut file, &page.directory, &mut description);
    description.metadata.exif = ExifTags::read(&mut file, &page.directory);
    let orientation = Orientation::from_exif(file.first(&page.directory, tag::ORIENTATION).ok().flatten());
    let bands = TiffBands { file, header, channels, max_bytes: limits.max_bytes, next: 0, begun: Vec::new() };
    upright(orientation, description, Box::new(bands), limits)
}

/// What a page says of its colours: by its ICC profile, else by its EXIF, else by the program that wrote it.
fn colours(file: &mut TiffFile<Input<'_>>, page: &Directory, description: &mut Description) {
    #[cfg(feature = "icc")]
    match file.bytes(page, tag::ICC_PROFILE, icc::MAX_BYTES as u64) {
        Ok(Some(profile)) => match icc::colours(&profile) {
            Ok(colours) => return colours.describe(description),
            Err(note) => description.notes.push(note),
        },
        Ok(None) => {}
        Err(_) => description.notes.push("left out the file's ICC profile, which is too large or cut off".to_owned()),
    }
    // EXIF is of a camera's own picture, and programs copy it beside floats of any space.
    if let Source::Tiff { samples: TiffSamples::Integer, .. } = description.source {
        if let Some(colours) = exif::colours(file, page) {
            colours.describe(description);
        }
        return;
    }
    let software = file.bytes(page, tag::SOFTWARE, MAX_SOFTWARE).ok().flatten().unwrap_or_default();
    if software.starts_with(b"RawTherapee") && !page.has(tag::ICC_PROFILE) {
        let colours = FileColours {
            primaries: Some(Chromaticities::BT709),
            transfer: Some(Transfer::Srgb),
            said_by: "its writer, RawTherapee, whose files without a profile are sRGB".to_owned(),
        };
        colours.describe(description);
    }
}

/// Most bytes of a program's name.
const MAX_SOFTWARE: u64 = 256;

/// The strips of a TIFF, or its rows of tiles.
struct TiffBands<'a> {
    file: TiffFile<Input<'a>>,
    header: Header,
    channels: Channels,
    /// Most packed bytes of a strip or tile.
    max_bytes: u64,
    /// The next row of pixels.
    next: usize,
    /// The row of strips or tiles that was begun.
    begun: Vec<Part>,
}

impl Bands for TiffBands<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let [width, height] = self.header.size;
        let together = self.header.chunk[1];
        // Whole rows of strips or tiles, or a part of one.
        let end = if self.is_tall() {
            (self.next + blocks_in_band(width, 1)).min((self.next / together + 1) * together)
        } else {
            self.next + blocks_in_band(width, together) * together
        };
        let rows = self.next..end.min(height);
        band.become_rows(rows.start, rows.len(), width, self.channels)?;
        for row in rows.start / together..rows.end.div_ceil(together) {
            if row * together >= rows.start {
                self.begin(row)?;
            }
            for part in &self.begun {
                part.place(&self.header, band);
            }
        }
        if let Some((_, Coverage::Premultiplied)) = self.header.alpha {
            band.rows_mut().for_each(|row| {
                if let Some(alpha) = row.alpha {
                    alpha::straighten(row.rgb, alpha);
                }
            });
        }
        self.next = rows.end;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let ([width, height], [across, down]) = (self.header.size, self.header.chunk);
        let rows = if self.is_tall() { blocks_in_band(width, 1) } else { blocks_in_band(width, down) * down };
        let pixels = |width: usize| (width as u64).saturating_mul(down as u64);
        // A row of strips or tiles unpacked, one of them packed.
        let pixels_held = pixels(width.next_multiple_of(across)).saturating_add(pixels(across));
        let bits = u64::from(self.header.sample.bits().max(8));
        let bytes_beside = pixels_held.saturating_mul(self.header.samples as u64 * bits / 8);
        ReadingMemory { band_pixels: width as u64 * rows.min(height) as u64, bytes_beside }
    }
}

impl TiffBands<'_> {
    /// Whether a row of strips or tiles is more than a band.
    fn is_tall(&self) -> bool {
        self.header.size[0].saturating_mul(self.header.chunk[1]) > BAND_PIXELS
    }

    /// Unpacks a row of strips or tiles.
    fn begin(&mut self, row: usize) -> Result<(), Error> {
        self.begun.clear();
        let Header { size: [width, height], chunk, planes, .. } = self.header;
        let (across, down) = (width.div_ceil(chunk[0]), height.div_ceil(chunk[1]));
        for plane in 0..planes {
            for column in 0..across {
                let part = self.unpack(plane * across * down + row * across + column, [column, row], plane)?;
                self.begun.push(part);
            }
        }
        Ok(())
    }

    fn unpack(&mut self, index: usize, [column, row]: [usize; 2], plane: usize) -> Result<Part, Error> {
        let header = &self.header;
        let ([width, height], [across, down]) = (header.size, header.chunk);
        let (left, top) = (column * across, row * down);
        // A tile is whole even where the picture ends, the last strip is not.
        let rows = if header.tiled { down } else { down.min(height - top) };
        let step = if header.planes > 1 { 1 } else { header.samples };
        let row_bytes = (across * step * usize::from(header.sample.bits())).div_ceil(8);
        let [at, mut bytes] = header.chunks[index];
        if header.packing.compression == crate::tiff_unpack::Compression::None {
            bytes = bytes.min((rows * row_bytes) as u64);
        }
        if bytes > self.max_bytes {
            let max = self.max_bytes;
            return Err(TiffProblem::PackedBytes { found: bytes, max }.into());
        }
        let packed = self.file.read_at(at, bytes)?;
        let packing = header.packing;
        let mut samples = panic_to_error(|| packing.unpack(packed, rows, row_bytes, step))??;
        if packing.bits < 8 {
            samples = widened(&samples, row_bytes, across * step, packing.bits);
        }
        Ok(Part {
            left,
            top,
            size: [across.min(width - left), rows.min(height - top)],
            stride: across * step,
            step,
            plane: if header.planes > 1 { plane } else { 0 },
            samples,
        })
    }
}

/// A byte for each of `count` samples of a row, of fewer bits, the highest first.
fn widened(bytes: &[u8], row_bytes: usize, count: usize, bits: u8) -> Vec<u8> {
    let per_byte = usize::from(8 / bits);
    let mask = u8::MAX >> (8 - bits);
    let rows = bytes.chunks_exact(row_bytes);
    let sample = |row: &[u8], at: usize| row[at / per_byte] >> (8 - bits as usize * (at % per_byte + 1)) & mask;
    rows.flat_map(|row| (0..count).map(move |at| sample(row, at))).collect()
}

/// A strip or tile, unpacked.
struct Part {
    left: usize,
    /// Its first row in the picture.
    top: usize,
    /// What of it lies in the picture.
    size: [usize; 2],
    /// Samples from one of its rows to the next.
    stride: usize,
    /// Samples of a pixel in it.
    step: usize,
    /// The first of the picture's samples that it has.
    plane: usize,
    /// In the machine's order of bytes.
    samples: Vec<u8>,
}

impl Part {
    fn place(&self, header: &Header, band: &mut Band) {
        let numbers = matches!(header.colours, Colours::Palette(_));
        let inverted = header.colours == Colours::GreyFromWhite;
        match header.sample {
            // The numbers of a palette's colours.
            Sample::Unsigned(..=8) if numbers => self.put(header, band, |[byte]| f32::from(byte)),
            Sample::Unsigned(bits @ ..8) => {
                let most = f32::from(u8::MAX >> (8 - bits));
                self.put(header, band, |[byte]| turned(f32::from(byte) / most, inverted));
            }
            Sample::Unsigned(8) => self.put(header, band, |[byte]| turned(f32::from(byte) / 255.0, inverted)),
            Sample::Unsigned(16) => {
                self.put(header, band, |word| turned(f32::from(u16::from_ne_bytes(word)) / 65_535.0, inverted));
            }
            Sample::Unsigned(_) => {
                let most = f64::from(u32::MAX);
                self.put(header, band, |word| turned((f64::from(u32::from_ne_bytes(word)) / most) as f32, inverted));
            }
            Sample::Float(16) => {
                self.put(header, band, |word| turned(half::f16::from_ne_bytes(word).to_f32(), inverted));
            }
            Sample::Float(32) => self.put(header, band, |word| turned(f32::from_ne_bytes(word), inverted)),
            Sample::Float(_) => self.put(header, band, |word| turned(f64::from_ne_bytes(word) as f32, inverted)),
        }
    }

    fn put<const N: usize>(&self, header: &Header, band: &mut Band, value: impl Fn([u8; N]) -> f32 + Sync) {
        // The rows that both have.
        let rows = self.top.max(band.top())..(self.top + self.size[1]).min(band.top() + band.rows());
        if rows.is_empty() {
            return;
        }
        let (samples, _) = self.samples.as_chunks::<N>();
        let samples = &samples[(rows.start - self.top) * self.stride..(rows.end - self.top) * self.stride];
        let rows = band.some_rows_mut(rows.start - band.top()..rows.end - band.top());
        let rows = rows.zip(samples.par_chunks_exact(self.stride));
        rows.with_min_len(SAMPLES_TOGETHER / self.stride + 1).for_each(|(mut row, samples)| {
            for first in 0..self.step {
                let values = samples[first..].iter().step_by(self.step).map(|sample| value(*sample));
                self.put_channel(header, &mut row, self.plane + first, values);
            }
        });
    }

    /// Writes one sample of each pixel of a row of the part.
    fn put_channel(&self, header: &Header, row: &mut RowMut<'_>, channel: usize, values: impl Iterator<Item = f32>) {
        let columns = self.left..self.left + self.size[0];
        if let Some((sample, _)) = header.alpha
            && sample == channel
        {
            if let Some(alpha) = &mut row.alpha {
                alpha[columns].iter_mut().zip(values).for_each(|(alpha, value)| *alpha = value);
            }
            return;
        }
        if channel >= header.colours.samples() {
            return;
        }
        let colours = row.rgb[columns].iter_mut().zip(values);
        match &header.colours {
            Colours::Rgb => colours.for_each(|(colour, value)| colour[channel] = value),
            Colours::Palette(palette) => colours.for_each(|(colour, value)| *colour = palette[value as usize]),
            Colours::Grey | Colours::GreyFromWhite => colours.for_each(|(colour, value)| *colour = [value; 3]),
        }
    }
}

/// A value counted from white, if it is `inverted`.
fn turned(value: f32, inverted: bool) -> f32 {
    if inverted { 1.0 - value } else { value }
}
