//! How the picture of a TIFF is stored, checked before memory is taken for it.

use std::io::{Read, Seek};

use crate::{
    error::{Error, TiffProblem},
    limits::{Limits, check_claim},
    tiff_directory::{Directory, TiffFile},
    tiff_unpack::{Packing, Predictor},
};

/// The tags that are read.
pub(crate) mod tag {
    pub(crate) const NEW_SUBFILE_TYPE: u16 = 254;
    pub(crate) const SUBFILE_TYPE: u16 = 255;
    pub(crate) const WIDTH: u16 = 256;
    pub(crate) const HEIGHT: u16 = 257;
    pub(crate) const BITS: u16 = 258;
    pub(crate) const COMPRESSION: u16 = 259;
    pub(crate) const PHOTOMETRIC: u16 = 262;
    pub(crate) const FILL_ORDER: u16 = 266;
    pub(crate) const STRIP_OFFSETS: u16 = 273;
    pub(crate) const ORIENTATION: u16 = 274;
    pub(crate) const SAMPLES: u16 = 277;
    pub(crate) const ROWS_PER_STRIP: u16 = 278;
    pub(crate) const STRIP_BYTES: u16 = 279;
    pub(crate) const PLANES: u16 = 284;
    pub(crate) const SOFTWARE: u16 = 305;
    pub(crate) const PREDICTOR: u16 = 317;
    pub(crate) const COLOUR_MAP: u16 = 320;
    pub(crate) const TILE_WIDTH: u16 = 322;
    pub(crate) const TILE_HEIGHT: u16 = 323;
    pub(crate) const TILE_OFFSETS: u16 = 324;
    pub(crate) const TILE_BYTES: u16 = 325;
    pub(crate) const SUB_IFDS: u16 = 330;
    pub(crate) const EXTRA_SAMPLES: u16 = 338;
    pub(crate) const SAMPLE_FORMAT: u16 = 339;
    pub(crate) const ICC_PROFILE: u16 = 34_675;
    pub(crate) const DNG_VERSION: u16 = 50_706;
}

/// More than Deflate, LZW or PackBits can give for one byte.
const EXPANSION: u64 = 2048;
/// Zstandard stands for 128 KiB of one value with four bytes.
const EXPANSION_ZSTD: u64 = 1 << 15;
/// Most samples of a pixel: a file has tens of inks, masks and passes, not thousands.
const MAX_SAMPLES: u64 = 64;

/// How pixels are stored.
#[derive(Debug)]
pub(crate) struct Header {
    pub(crate) size: [usize; 2],
    pub(crate) colours: Colours,
    /// Samples of a pixel in the file.
    pub(crate) samples: usize,
    pub(crate) sample: Sample,
    /// Which sample is coverage, and whether colours are multiplied by it.
    pub(crate) alpha: Option<(usize, Coverage)>,
    /// Width and height of a strip or tile.
    pub(crate) chunk: [usize; 2],
    pub(crate) tiled: bool,
    /// 1 where a pixel's samples lie side by side, else one plane a sample.
    pub(crate) planes: usize,
    pub(crate) packing: Packing,
    /// Where strips or tiles lie, and how many bytes they have.
    pub(crate) chunks: Vec<[u64; 2]>,
    /// What the user should know of samples that are left out or guessed.
    pub(crate) notes: Vec<String>,
}

/// What the first samples of a pixel are.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Colours {
    Grey,
    /// Grey, of which 0 is white.
    GreyFromWhite,
    Rgb,
    /// The colours of the numbers.
    Palette(Vec<[f32; 3]>),
}

/// How a sample is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sample {
    /// Unsigned integers of so many bits, up to 8 or 16 or 32.
    Unsigned(u8),
    /// IEEE floats of 16, 32 or 64 bits.
    Float(u8),
}

/// What an alpha channel has done to the colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coverage {
    Straight,
    Premultiplied,
}

impl Sample {
    /// Bits of a sample.
    pub(crate) fn bits(self) -> u8 {
        match self {
            Self::Unsigned(bits) | Self::Float(bits) => bits,
        }
    }
}

impl Colours {
    /// Samples that colour takes.
    pub(crate) fn samples(&self) -> usize {
        if *self == Self::Rgb { 3 } else { 1 }
    }
}

impl Header {
    /// Of a page, checked against limits and the length of the file.
    pub(crate) fn read<R: Read + Seek>(
        file: &mut TiffFile<R>,
        page: &Directory,
        length: u64,
        limits: &Limits,
    ) -> Result<Self, Error> {
        let mut must = |tag| file.first(page, tag)?.ok_or_else(|| Error::from(TiffProblem::TagMissing { tag }));
        let (width, height) = (must(tag::WIDTH)?, must(tag::HEIGHT)?);
        limits.check_size("the picture", width, height)?;
        let photometric = must(tag::PHOTOMETRIC)?;
        let compression = file.first(page, tag::COMPRESSION)?.unwrap_or(1);
        let samples = file.first(page, tag::SAMPLES)?.unwrap_or(1);
        let sample = sample(file, page)?;
        let mut notes = Vec::new();
        let colours = colours(file, page, photometric, compression, sample)?;
        if samples > MAX_SAMPLES || (samples as usize) < colours.samples() {
            return Err(TiffProblem::Samples { found: samples, expected: colours.samples(), max: MAX_SAMPLES }.into());
        }
        let samples = samples as usize;
        let extra = file.numbers(page, tag::EXTRA_SAMPLES)?;
        let alpha = alpha(colours.samples()..samples, extra.as_deref(), &mut notes);
        let planes = if file.first(page, tag::PLANES)? == Some(2) { samples } else { 1 };
        let packing = Packing {
            compression: compression_of(compression)?,
            predictor: predictor(file, page, compression, sample)?,
            reversed_bits: file.first(page, tag::FILL_ORDER)? == Some(2),
            order: file.order(),
            bits: sample.bits(),
        };

        let row_bytes = |width: u64| (width * samples as u64 * u64::from(sample.bits())).div_ceil(8);
        let expansion = match compression {
            1 => 1,
            50_000 => EXPANSION_ZSTD,
            _ => EXPANSION,
        };
        check_claim([width, height], row_bytes(width).saturating_mul(height), length, expansion)?;
        let tiled = page.has(tag::TILE_WIDTH);
        let side = |file: &mut TiffFile<R>, tag| file.first(page, tag).map(Option::unwrap_or_default);
        let [across, down] = if tiled {
            [side(file, tag::TILE_WIDTH)?, side(file, tag::TILE_HEIGHT)?]
        } else {
            [width, file.first(page, tag::ROWS_PER_STRIP)?.unwrap_or(height).min(height)]
        };
        if across == 0 || down == 0 || across > limits.max_side || down > limits.max_side {
            return Err(TiffProblem::ChunkSize { found: [across, down], max: limits.max_side }.into());
        }
        let together = [width.next_multiple_of(across), down];
        // As they lie in the file, and as they were unpacked.
        let bytes = row_bytes(together[0]).saturating_mul(down);
        limits.check_bytes("a strip or row of tiles", together, bytes)?;
        let count = width.div_ceil(across) * height.div_ceil(down) * planes as u64;
        let chunks = chunks(file, page, tiled, count, compression == 1)?;
        Ok(Self {
            size: [width as usize, height as usize],
            colours,
            samples,
            sample,
            alpha,
            chunk: [across as usize, down as usize],
            tiled,
            planes,
            packing,
            chunks,
            notes,
        })
    }
}

fn sample<R: Read + Seek>(file: &mut TiffFile<R>, page: &Directory) -> Result<Sample, Error> {
    let bits = file.numbers(page, tag::BITS)?.unwrap_or_else(|| vec![1]);
    let formats = file.numbers(page, tag::SAMPLE_FORMAT)?.unwrap_or_else(|| vec![1]);
    let (Some(&first), Some(&format)) = (bits.first(), formats.first()) else {
        return Err(TiffProblem::SampleFormat.into());
    };
    if bits.iter().any(|other| *other != first) || formats.iter().any(|other| *other != format) {
        return Err(TiffProblem::MixedSamples.into());
    }
    match (format, first) {
        (1, 1 | 2 | 4 | 8 | 16 | 32) => Ok(Sample::Unsigned(first as u8)),
        (3, 16 | 32 | 64) => Ok(Sample::Float(first as u8)),
        (1 | 3, _) => Err(TiffProblem::Bits { found: first }.into()),
        _ => Err(TiffProblem::SampleFormat.into()),
    }
}

fn colours<R: Read + Seek>(
    file: &mut TiffFile<R>,
    page: &Directory,
    photometric: u64,
    compression: u64,
    sample: Sample,
) -> Result<Colours, Error> {
    let refused = |found: &str| Err(TiffProblem::Colours { found: found.to_owned() }.into());
    match photometric {
        0 => Ok(Colours::GreyFromWhite),
        1 => Ok(Colours::Grey),
        2 => Ok(Colours::Rgb),
        3 => palette(file, page, sample),
        4 => refused("a transparency mask"),
        5 => refused("CMYK or other inks"),
        6 if matches!(compression, 6 | 7) => Err(TiffProblem::Compression { found: "JPEG".to_owned() }.into()),
        6 => refused("YCbCr"),
        8..=10 => refused("CIE L*a*b*"),
        32_844 | 32_845 => refused("SGI LogLuv"),
        other => refused(&format!("of the unknown photometric interpretation {other}")),
    }
}

fn palette<R: Read + Seek>(file: &mut TiffFile<R>, page: &Directory, sample: Sample) -> Result<Colours, Error> {
    let Sample::Unsigned(bits @ (1 | 2 | 4 | 8)) = sample else {
        return Err(TiffProblem::PaletteBits { found: sample.bits() }.into());
    };
    let entries = file.numbers(page, tag::COLOUR_MAP)?.unwrap_or_default();
    let count = 1 << bits;
    if entries.len() != 3 * count {
        return Err(TiffProblem::Palette { found: entries.len(), expected: 3 * count }.into());
    }
    // Some writers give bytes where words are due; those have no word above 255.
    let most = if entries.iter().all(|entry| *entry < 256) { 255.0 } else { 65_535.0 };
    let value = |index: usize| entries[index] as f32 / most;
    Ok(Colours::Palette((0..count).map(|i| [value(i), value(count + i), value(2 * count + i)]).collect()))
}

/// The sample among the surplus ones that is coverage.
fn alpha(surplus: std::ops::Range<usize>, extra: Option<&[u64]>, notes: &mut Vec<String>) -> Option<(usize, Coverage)> {
    let alpha = match extra {
        // 1: associated (premultiplied), 2: unassociated, 0: not said.
        Some(extra) => surplus.clone().zip(extra).find_map(|(sample, kind)| match kind {
            1 => Some((sample, Coverage::Premultiplied)),
            2 => Some((sample, Coverage::Straight)),
            _ => None,
        }),
        None if surplus.len() == 1 => {
            notes.push("took the TIFF's extra channel, of which it says nothing, for straight alpha".to_owned());
            Some((surplus.start, Coverage::Straight))
        }
        None => None,
    };
    match surplus.len() - usize::from(alpha.is_some()) {
        0 => {}
        1 => notes.push("left out an extra channel of the TIFF, which is not said to be alpha".to_owned()),
        more => notes.push(format!("left out {more} extra channels of the TIFF, which are not said to be alpha")),
    }
    alpha
}

fn compression_of(number: u64) -> Result<crate::tiff_unpack::Compression, Error> {
    use crate::tiff_unpack::Compression;
    let refused = |found: &str| Err(TiffProblem::Compression { found: found.to_owned() }.into());
    match number {
        1 => Ok(Compression::None),
        5 => Ok(Compression::Lzw),
        8 | 32_946 => Ok(Compression::Deflate),
        32_773 => Ok(Compression::PackBits),
        50_000 => Ok(Compression::Zstd),
        2..=4 => refused("fax"),
        6 | 7 => refused("JPEG"),
        34_676 | 34_677 => refused("SGI LogLuv"),
        34_712 => refused("JPEG 2000"),
        34_887 => refused("LERC"),
        34_925 => refused("LZMA"),
        50_001 => refused("WebP"),
        50_002 | 52_546 => refused("JPEG XL"),
        other => refused(&format!("the unknown number {other}")),
    }
}

fn predictor<R: Read + Seek>(
    file: &mut TiffFile<R>,
    page: &Directory,
    compression: u64,
    sample: Sample,
) -> Result<Predictor, Error> {
    // The tag belongs to these compressions; some writers leave it beside others, where it means nothing.
    if !matches!(compression, 5 | 8 | 32_946 | 50_000) {
        return Ok(Predictor::None);
    }
    match (file.first(page, tag::PREDICTOR)?.unwrap_or(1), sample) {
        (1, _) => Ok(Predictor::None),
        (2, sample) if sample.bits() >= 8 => Ok(Predictor::Horizontal),
        (3, Sample::Float(_)) => Ok(Predictor::FloatingPoint),
        (found, _) => Err(TiffProblem::Predictor { found }.into()),
    }
}

/// Where each strip or tile lies, and its bytes.
fn chunks<R: Read + Seek>(
    file: &mut TiffFile<R>,
    page: &Directory,
    tiled: bool,
    count: u64,
    stored: bool,
) -> Result<Vec<[u64; 2]>, Error> {
    // Some writers keep tiles under the tags of strips.
    let mut either = |[of_tiles, of_strips]: [u16; 2]| {
        let tag = if tiled && page.has(of_tiles) { of_tiles } else { of_strips };
        Ok::<_, Error>((tag, file.numbers(page, tag)?))
    };
    let (tag, offsets) = either([tag::TILE_OFFSETS, tag::STRIP_OFFSETS])?;
    let offsets = offsets.ok_or(TiffProblem::TagMissing { tag })?;
    let (bytes_tag, bytes) = either([tag::TILE_BYTES, tag::STRIP_BYTES])?;
    let bytes = match bytes {
        Some(bytes) => bytes,
        // The picture's size tells how many bytes there are where they are stored as they are.
        None if stored => vec![u64::MAX; offsets.len()],
        None => return Err(TiffProblem::TagMissing { tag: bytes_tag }.into()),
    };
    if (offsets.len() as u64) < count || (bytes.len() as u64) < count {
        let found = offsets.len().min(bytes.len()) as u64;
        return Err(TiffProblem::ChunkCount { found, expected: count }.into());
    }
    Ok(offsets.into_iter().zip(bytes).take(count as usize).map(<[u64; 2]>::from).collect())
}
