//! TIFF: every sample type and compression that is read, by strips, by tiles, in planes, of both byte orders.

use std::io::Cursor;

use tiff::encoder::colortype::{self, ColorType};
use tiff::encoder::{Compression, Predictor, TiffEncoder, TiffValue};

use super::{Fault, Seed};

const SIZE: [u32; 2] = [6, 5];

pub(super) fn files() -> Result<Vec<Seed>, Fault> {
    let mut files = Vec::new();
    macro_rules! kinds {
        ($($name:literal $kind:ident $sample:ty),+ $(,)?) => {$(
            for (how, compression) in compressions() {
                files.push((format!("{}-{how}.tif", $name), file::<colortype::$kind>(
                    compression, |i| (i * 5) as $sample)?));
            }
        )+};
    }
    kinds! {
        "grey-8" Gray8 u8, "grey-16" Gray16 u16, "grey-32" Gray32 u32, "grey-float" Gray32Float f32,
        "grey-double" Gray64Float f64,
        "rgb-8" RGB8 u8, "rgb-16" RGB16 u16, "rgb-32" RGB32 u32, "rgb-float" RGB32Float f32, "rgb-double" RGB64Float f64,
        "rgba-8" RGBA8 u8, "rgba-16" RGBA16 u16, "rgba-32" RGBA32 u32, "rgba-float" RGBA32Float f32,
        "rgba-double" RGBA64Float f64,
    }
    let mut big = Cursor::new(Vec::new());
    TiffEncoder::new_big(&mut big)?.write_image::<colortype::RGB8>(2, 2, &[9; 12])?;
    files.push(("big.tif".into(), big.into_inner()));
    let mut predicted = Cursor::new(Vec::new());
    let mut encoder =
        TiffEncoder::new(&mut predicted)?.with_compression(Compression::Lzw).with_predictor(Predictor::Horizontal);
    encoder.write_image::<colortype::RGB16>(4, 2, &[300; 24])?;
    files.push(("predicted.tif".into(), predicted.into_inner()));

    // What the encoder does not write.
    let by_hand = [
        ("half", ByHand { bits: 16, format: 3, ..ByHand::RGB8 }),
        ("big-endian", ByHand { order: Order::Big, bits: 16, ..ByHand::RGB8 }),
        ("planes", ByHand { planes: true, ..ByHand::RGB8 }),
        ("tiles", ByHand { tiles: true, ..ByHand::RGB8 }),
        ("premultiplied", ByHand { samples: 4, extra: Some(1), ..ByHand::RGB8 }),
        ("straight", ByHand { samples: 4, extra: Some(2), ..ByHand::RGB8 }),
        ("grey-alpha", ByHand { samples: 2, extra: Some(2), ..ByHand::RGB8 }),
        ("refused-signed", ByHand { format: 2, ..ByHand::RGB8 }),
        ("tiled-planes", ByHand { planes: true, tiles: true, ..ByHand::RGB8 }),
    ];
    files.extend(by_hand.into_iter().map(|(name, file)| (format!("{name}.tif"), file.bytes())));
    Ok(files)
}

fn compressions() -> [(&'static str, Compression); 4] {
    [
        ("none", Compression::Uncompressed),
        ("lzw", Compression::Lzw),
        ("deflate", Compression::Deflate(Default::default())),
        ("packbits", Compression::Packbits),
    ]
}

fn file<C: ColorType>(compression: Compression, sample: impl Fn(usize) -> C::Inner) -> Result<Vec<u8>, Fault>
where
    [C::Inner]: TiffValue,
{
    let count = (SIZE[0] * SIZE[1]) as usize * C::SAMPLE_FORMAT.len();
    let data: Vec<C::Inner> = (0..count).map(|i| sample(i % 40)).collect();
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes)?.with_compression(compression);
    let mut image = encoder.new_image::<C>(SIZE[0], SIZE[1])?;
    image.rows_per_strip(2)?;
    image.write_data(&data)?;
    Ok(bytes.into_inner())
}

#[derive(Clone, Copy, PartialEq)]
enum Order {
    Little,
    Big,
}

/// An uncompressed file of 20 x 18 pixels.
#[derive(Clone, Copy)]
struct ByHand {
    order: Order,
    bits: u16,
    samples: u16,
    /// 1 unsigned, 2 signed, 3 floating point.
    format: u16,
    extra: Option<u16>,
    planes: bool,
    tiles: bool,
}

impl ByHand {
    const RGB8: Self =
        Self { order: Order::Little, bits: 8, samples: 3, format: 1, extra: None, planes: false, tiles: false };

    fn bytes(self) -> Vec<u8> {
        const SIDE: u32 = 18;
        const TILE: u32 = 16;
        let pieces = if self.tiles { 4 } else { 1 } * if self.planes { u32::from(self.samples) } else { 1 };
        let area = if self.tiles { TILE * TILE } else { SIDE * SIDE };
        let piece = area * u32::from(self.bits) / 8 * if self.planes { 1 } else { u32::from(self.samples) };

        const SHORT: u16 = 3;
        const LONG: u16 = 4;
        let each = |value: u16| vec![u32::from(value); self.samples.into()];
        let offsets = (0..pieces).map(|i| 8 + i * piece).collect();
        let mut tags: Vec<(u16, u16, Vec<u32>)> = vec![
            (256, SHORT, vec![SIDE]),
            (257, SHORT, vec![SIDE]),
            (258, SHORT, each(self.bits)),
            (259, SHORT, vec![1]),
            (262, SHORT, vec![if self.samples < 3 { 1 } else { 2 }]),
            (277, SHORT, vec![self.samples.into()]),
            (284, SHORT, vec![if self.planes { 2 } else { 1 }]),
            (339, SHORT, each(self.format)),
        ];
        if let Some(extra) = self.extra {
            tags.push((338, SHORT, vec![extra.into()]));
        }
        let lengths = vec![piece; pieces as usize];
        if self.tiles {
            tags.extend([(322, SHORT, vec![TILE]), (323, SHORT, vec![TILE])]);
            tags.extend([(324, LONG, offsets), (325, LONG, lengths)]);
        } else {
            tags.extend([(273, LONG, offsets), (278, SHORT, vec![SIDE]), (279, LONG, lengths)]);
        }
        tags.sort();

        let directory = 8 + pieces * piece;
        let mut file = match self.order {
            Order::Little => b"II\x2a\0".to_vec(),
            Order::Big => b"MM\0\x2a".to_vec(),
        };
        self.put(&mut file, LONG, directory);
        file.extend((0..pieces * piece).map(|i| (i / 7 % 56) as u8));
        self.put(&mut file, SHORT, tags.len() as u32);
        let mut beyond = directory + 2 + 12 * tags.len() as u32 + 4;
        let mut values = Vec::new();
        for (tag, kind, numbers) in tags {
            self.put(&mut file, SHORT, tag.into());
            self.put(&mut file, SHORT, kind.into());
            self.put(&mut file, LONG, numbers.len() as u32);
            let mut own = Vec::new();
            numbers.iter().for_each(|number| self.put(&mut own, kind, *number));
            if own.len() > 4 {
                self.put(&mut file, LONG, beyond);
                beyond += own.len() as u32;
                values.extend(own);
            } else {
                own.resize(4, 0);
                file.extend(own);
            }
        }
        file.extend([0; 4]);
        file.extend(values);
        file
    }

    /// Appends a number as a SHORT (3) or a LONG (4).
    fn put(self, out: &mut Vec<u8>, kind: u16, number: u32) {
        let little = self.order == Order::Little;
        match kind {
            3 if little => out.extend((number as u16).to_le_bytes()),
            3 => out.extend((number as u16).to_be_bytes()),
            _ if little => out.extend(number.to_le_bytes()),
            _ => out.extend(number.to_be_bytes()),
        }
    }
}
