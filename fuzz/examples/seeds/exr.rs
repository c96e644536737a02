//! OpenEXR: every compression, sample type and way of cutting a picture; and what is refused.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::math::RoundingMode;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes, Layer,
    LayerAttributes, Layers, Levels, LineOrder, Text, Vec2, f16,
};

use super::{Fault, Seed};

const SIZE: [usize; 2] = [20, 18];

const COMPRESSIONS: [(&str, Compression); 10] = [
    ("none", Compression::Uncompressed),
    ("rle", Compression::RLE),
    ("zips", Compression::ZIP1),
    ("zip", Compression::ZIP16),
    ("piz", Compression::PIZ),
    ("pxr24", Compression::PXR24),
    ("b44", Compression::B44),
    ("b44a", Compression::B44A),
    ("dwaa", Compression::DWAA(None)),
    ("dwab", Compression::DWAB(None)),
];

pub(super) fn files() -> Result<Vec<Seed>, Fault> {
    let mut files = Vec::new();
    for (name, compression) in COMPRESSIONS {
        for (cut, blocks, order) in [
            ("lines", Blocks::ScanLines, LineOrder::Increasing),
            ("tiles", Blocks::Tiles(Vec2(16, 8)), LineOrder::Unspecified),
        ] {
            let encoding = Encoding { compression, blocks, line_order: order };
            let channels = [("A", half(3)), ("B", float(2)), ("G", half(1)), ("R", half(0))];
            files.push((format!("{name}-{cut}.exr"), file(vec![layer(None, encoding, &channels)])?));
        }
        // One sample type alone is decoded by other code than several.
        let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Decreasing };
        let channels = [("B", count(2)), ("G", count(1)), ("R", count(0))];
        files.push((format!("{name}-integers.exr"), file(vec![layer(None, encoding, &channels)])?));
    }
    let usual =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let rgb = || [("B", half(2)), ("G", half(1)), ("R", half(0))];
    files.push(("grey.exr".into(), file(vec![layer(None, usual, &[("Y", half(0))])])?));
    let layers = [("a.R", half(0)), ("b.x.A", half(3)), ("b.x.B", half(2)), ("b.x.G", half(1)), ("b.x.R", half(0))];
    files.push(("layers.exr".into(), file(vec![layer(None, usual, &layers)])?));
    let parts = vec![layer(Some("depth"), usual, &[("Z", float(0))]), layer(Some("beauty"), usual, &rgb())];
    files.push(("parts.exr".into(), file(parts)?));
    for (name, levels) in [("mip", Level::Mip), ("rip", Level::Rip)] {
        files.push((format!("{name}.exr"), levels.file()?));
    }
    let lines = file(vec![layer(None, usual, &rgb())])?;
    files.push(("moved.exr".into(), edited(&lines, b"dataWindow\0box2i\0\x10\0\0\0", &moved())?));
    files.push(("refused-deep.exr".into(), replaced(&lines, b"\x0d\0\0\0scanlineimage", b"\x0c\0\0\0deepscanline")?));
    let luminance = file(vec![layer(None, usual, &[("B", half(2)), ("G", half(1)), ("R", half(0)), ("U", half(0))])])?;
    files.push((
        "refused-subsampled.exr".into(),
        edited(&luminance, b"U\0\x01\0\0\0\x01\0\0\0", &[2, 0, 0, 0, 2, 0, 0, 0])?,
    ));
    Ok(files)
}

/// A smooth value, so that files stay small.
fn value(index: usize, channel: usize) -> f32 {
    let [x, y] = [index % SIZE[0], index / SIZE[0]];
    match channel {
        3 => ((x / 4) as f32 * 0.25).min(1.0),
        _ => (x / 2 * (channel + 1)) as f32 * 0.125 + (y / 3) as f32,
    }
}

fn half(channel: usize) -> FlatSamples {
    FlatSamples::F16((0..SIZE[0] * SIZE[1]).map(|i| f16::from_f32(value(i, channel))).collect())
}

fn float(channel: usize) -> FlatSamples {
    FlatSamples::F32((0..SIZE[0] * SIZE[1]).map(|i| value(i, channel)).collect())
}

fn count(channel: usize) -> FlatSamples {
    FlatSamples::U32((0..SIZE[0] * SIZE[1]).map(|i| value(i, channel) as u32).collect())
}

fn layer(name: Option<&str>, encoding: Encoding, channels: &[(&str, FlatSamples)]) -> Layer<AnyChannels<FlatSamples>> {
    let channels = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
    let attributes = LayerAttributes { layer_name: name.map(Text::from), ..Default::default() };
    Layer::new((SIZE[0], SIZE[1]), attributes, encoding, AnyChannels::sort(channels))
}

fn file(layers: Vec<Layer<AnyChannels<FlatSamples>>>) -> Result<Vec<u8>, Fault> {
    let mut bytes = Cursor::new(Vec::new());
    let image = Image {
        attributes: ImageAttributes::with_size((SIZE[0], SIZE[1])),
        layer_data: layers.into_iter().collect::<Layers<_>>(),
    };
    image.write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// Smaller resolutions in the same file.
#[derive(Clone, Copy)]
enum Level {
    Mip,
    Rip,
}

impl Level {
    fn file(self) -> Result<Vec<u8>, Fault> {
        const WIDTHS: [usize; 3] = [4, 2, 1];
        let samples = |size: [usize; 2]| FlatSamples::F32(vec![0.5; size[0] * size[1]]);
        let levels = || match self {
            Self::Mip => Levels::Mip {
                rounding_mode: RoundingMode::Down,
                level_data: WIDTHS.map(|side| samples([side, side])).into_iter().collect(),
            },
            Self::Rip => Levels::Rip {
                rounding_mode: RoundingMode::Down,
                level_data: exr::image::RipMaps {
                    map_data: WIDTHS.iter().flat_map(|y| WIDTHS.map(|x| samples([x, *y]))).collect(),
                    level_count: Vec2(WIDTHS.len(), WIDTHS.len()),
                },
            },
        };
        let encoding = Encoding {
            compression: Compression::ZIP16,
            blocks: Blocks::Tiles(Vec2(4, 4)),
            line_order: LineOrder::Unspecified,
        };
        let channels = ["B", "G", "R"].map(|name| AnyChannel::new(name, levels()));
        let layer = Layer::new(
            (WIDTHS[0], WIDTHS[0]),
            LayerAttributes::default(),
            encoding,
            AnyChannels::sort(channels.into_iter().collect()),
        );
        let mut bytes = Cursor::new(Vec::new());
        Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)?;
        Ok(bytes.into_inner())
    }
}

/// A data window that begins left of the display window's first pixel.
fn moved() -> Vec<u8> {
    let corners = [-3, 0, SIZE[0] as i32 - 4, SIZE[1] as i32 - 1];
    corners.iter().flat_map(|corner| corner.to_le_bytes()).collect()
}

/// The bytes after `head` overwritten.
fn edited(file: &[u8], head: &[u8], with: &[u8]) -> Result<Vec<u8>, Fault> {
    let at = find(file, head)? + head.len();
    let mut file = file.to_vec();
    file.splice(at..at + with.len(), with.iter().copied());
    Ok(file)
}

fn replaced(file: &[u8], part: &[u8], with: &[u8]) -> Result<Vec<u8>, Fault> {
    let at = find(file, part)?;
    let mut file = file.to_vec();
    file.splice(at..at + part.len(), with.iter().copied());
    Ok(file)
}

fn find(file: &[u8], part: &[u8]) -> Result<usize, Fault> {
    let at = file.windows(part.len()).position(|window| window == part);
    at.ok_or_else(|| format!("no {} in the file", part.escape_ascii()).into())
}
