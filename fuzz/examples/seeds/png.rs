//! PNG: every colour type and depth, interlaced or not, and the pictures that hold tables.

use onelight::lut::Lut3d;
use onelight_formats::{PngDepth, StripGreen, hald, strip};
use png::{BitDepth, ColorType, Encoder};

use super::{Fault, Seed};

const KINDS: [(&str, ColorType, u8, &[BitDepth]); 5] = {
    use BitDepth::{Eight, Four, One, Sixteen, Two};
    [
        ("grey", ColorType::Grayscale, 1, &[One, Two, Four, Eight, Sixteen]),
        ("grey-alpha", ColorType::GrayscaleAlpha, 2, &[Eight, Sixteen]),
        ("palette", ColorType::Indexed, 1, &[One, Two, Four, Eight]),
        ("rgb", ColorType::Rgb, 3, &[Eight, Sixteen]),
        ("rgba", ColorType::Rgba, 4, &[Eight, Sixteen]),
    ]
};

const SIZE: [usize; 2] = [9, 7];

pub(super) fn files() -> Result<Vec<Seed>, Fault> {
    let mut files = Vec::new();
    for (name, colour, samples, depths) in KINDS {
        for depth in depths {
            let bits = *depth as u8;
            for interlaced in [false, true] {
                let rows = passes(interlaced).into_iter().flat_map(|[width, height]| {
                    (0..height).map(move |y| row(width, y, usize::from(samples), usize::from(bits)))
                });
                let name = format!("{name}-{bits}{}.png", if interlaced { "-interlaced" } else { "" });
                files.push((name, raw(colour, bits, interlaced, &rows.collect::<Vec<_>>())));
            }
        }
    }
    let mut texts = Vec::new();
    let mut encoder = Encoder::new(&mut texts, 2, 2);
    encoder.set_color(ColorType::Rgb);
    encoder.set_source_gamma(png::ScaledFloat::new(1.0 / 2.2));
    encoder.set_compression(png::Compression::High);
    encoder.add_text_chunk("Software".into(), "onelight".into())?;
    encoder.add_ztxt_chunk("Comment".into(), "text".repeat(9))?;
    encoder.add_itxt_chunk("Title".into(), "\u{4e00}".into())?;
    encoder.write_header()?.write_image_data(&[7; 12])?;
    files.push(("texts.png".into(), texts));

    for (name, depth) in [("8", PngDepth::Eight), ("16", PngDepth::Sixteen)] {
        let mut square = Vec::new();
        hald::write(&mut square, &Lut3d::identity(4)?, depth, ["hald"])?;
        files.push((format!("hald-{name}.png"), square));
        let mut row_of_tiles = Vec::new();
        strip::write(&mut row_of_tiles, &Lut3d::identity(3)?, depth, StripGreen::Up, [""; 0])?;
        files.push((format!("strip-{name}.png"), row_of_tiles));
    }
    // A look in black and white, of one channel: level 2.
    let mut grey = Vec::new();
    let mut encoder = Encoder::new(&mut grey, 8, 8);
    encoder.set_color(ColorType::Grayscale);
    encoder.write_header()?.write_image_data(&(0..64).map(|i| i * 4).collect::<Vec<u8>>())?;
    files.push(("hald-grey.png".into(), grey));
    Ok(files)
}

/// Width and height of each pass.
fn passes(interlaced: bool) -> Vec<[usize; 2]> {
    // First column and row of a pass, and the steps to the next.
    const ADAM7: [[usize; 4]; 7] =
        [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
    if !interlaced {
        return vec![SIZE];
    }
    let count = |size: usize, first: usize, step: usize| size.saturating_sub(first).div_ceil(step);
    let passes = ADAM7.map(|[x, y, across, down]| [count(SIZE[0], x, across), count(SIZE[1], y, down)]);
    passes.into_iter().filter(|size| !size.contains(&0)).collect()
}

/// A row with its filter, of which every kind comes.
fn row(width: usize, y: usize, samples: usize, bits: usize) -> Vec<u8> {
    let bytes = (width * samples * bits).div_ceil(8);
    std::iter::once((y % 5) as u8).chain((0..bytes).map(|x| (x * 3 + y) as u8)).collect()
}

fn raw(colour: ColorType, bits: u8, interlaced: bool, rows: &[Vec<u8>]) -> Vec<u8> {
    let mut header: Vec<u8> = SIZE.iter().flat_map(|side| (*side as u32).to_be_bytes()).collect();
    header.extend([bits, colour as u8, 0, 0, u8::from(interlaced)]);
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut file, b"IHDR", &header);
    if colour == ColorType::Indexed {
        chunk(&mut file, b"PLTE", &(0..3 << bits.min(6)).map(|i| i as u8).collect::<Vec<_>>());
        chunk(&mut file, b"tRNS", &[255, 51]);
    }
    // Cut in two: chunks need not end where rows do.
    let data = stored(&rows.concat());
    let (first, second) = data.split_at(data.len() / 2);
    chunk(&mut file, b"IDAT", first);
    chunk(&mut file, b"IDAT", second);
    chunk(&mut file, b"IEND", &[]);
    file
}

/// A zlib stream of one block that is not compressed.
fn stored(data: &[u8]) -> Vec<u8> {
    let length = data.len() as u16;
    let [mut low, mut high] = [1_u32, 0_u32];
    for byte in data {
        low = (low + u32::from(*byte)) % 65_521;
        high = (high + low) % 65_521;
    }
    let mut out = vec![0x78, 0x01, 1];
    out.extend(length.to_le_bytes());
    out.extend((!length).to_le_bytes());
    out.extend(data);
    out.extend((high << 16 | low).to_be_bytes());
    out
}

fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(data);
    let crc = file[start..].iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    });
    file.extend((!crc).to_be_bytes());
}
