//! From the bytes of a strip or tile to its samples: bit order, compression, predictor, byte order.

use std::io::Read;

use weezl::{BitOrder, LzwStatus, decode::Decoder as LzwDecoder};

use crate::{
    decoder_message::one_line,
    error::{Error, TiffProblem},
    limits::allocate,
    tiff_directory::Order,
};

/// How the bytes of a strip or tile were made of its samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Packing {
    pub(crate) compression: Compression,
    pub(crate) predictor: Predictor,
    /// Whether the lowest bit of a byte comes first (`FillOrder` 2).
    pub(crate) reversed_bits: bool,
    pub(crate) order: Order,
    /// Bits of a sample.
    pub(crate) bits: u8,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Compression {
    None,
    Lzw,
    Deflate,
    PackBits,
    Zstd,
}

/// What was done to samples so that they compress better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Predictor {
    None,
    /// Each sample less that of the pixel before.
    Horizontal,
    /// Bytes of floats, of equal rank together, each less the one a pixel before.
    FloatingPoint,
}

impl Packing {
    /// The samples of `rows` rows of `row_bytes` bytes, of `step` samples a pixel, in the machine's order of bytes. What
    /// `packed` has beyond them is not looked at.
    pub(crate) fn unpack(
        &self,
        mut packed: Vec<u8>,
        rows: usize,
        row_bytes: usize,
        step: usize,
    ) -> Result<Vec<u8>, Error> {
        if self.reversed_bits {
            packed.iter_mut().for_each(|byte| *byte = byte.reverse_bits());
        }
        let bytes = rows * row_bytes;
        let mut samples = match self.compression {
            Compression::None => {
                if packed.len() < bytes {
                    return Err(short(packed.len(), bytes));
                }
                packed.truncate(bytes);
                packed
            }
            compression => {
                let mut samples = allocate(bytes, 0)?;
                match compression {
                    Compression::None => {}
                    Compression::Lzw => lzw(&packed, &mut samples)?,
                    Compression::Deflate => read_all(flate2::read::ZlibDecoder::new(&packed[..]), &mut samples)?,
                    Compression::PackBits => pack_bits(&packed, &mut samples)?,
                    Compression::Zstd => {
                        let decoder = ruzstd::decoding::StreamingDecoder::new(&packed[..]);
                        let decoder = decoder.map_err(|error| TiffProblem::Damaged(one_line(&error.to_string())))?;
                        read_all(decoder, &mut samples)?;
                    }
                }
                samples
            }
        };
        if self.predictor == Predictor::FloatingPoint {
            let mut ranked = allocate(row_bytes, 0)?;
            for row in samples.chunks_exact_mut(row_bytes) {
                self.undo_floating_point(row, &mut ranked, step);
            }
        } else {
            self.to_native(&mut samples);
            if self.predictor == Predictor::Horizontal {
                samples.chunks_exact_mut(row_bytes).for_each(|row| self.undo_horizontal(row, step));
            }
        }
        Ok(samples)
    }

    /// From the file's order of bytes to the machine's.
    fn to_native(self, samples: &mut [u8]) {
        let same = match self.order {
            Order::Little => cfg!(target_endian = "little"),
            Order::Big => cfg!(target_endian = "big"),
        };
        let bytes = usize::from(self.bits / 8);
        if !same && bytes > 1 {
            samples.chunks_exact_mut(bytes).for_each(<[u8]>::reverse);
        }
    }

    fn undo_horizontal(self, row: &mut [u8], step: usize) {
        /// Adds up words of `N` bytes, each to that of the pixel before.
        fn sum<const N: usize>(row: &mut [u8], step: usize, add: impl Fn([u8; N], [u8; N]) -> [u8; N]) {
            let (words, _) = row.as_chunks_mut::<N>();
            for at in step..words.len() {
                words[at] = add(words[at - step], words[at]);
            }
        }
        macro_rules! sum {
            ($word:ty) => {
                sum(row, step, |a, b| <$word>::from_ne_bytes(a).wrapping_add(<$word>::from_ne_bytes(b)).to_ne_bytes())
            };
        }
        match self.bits {
            8 => sum!(u8),
            16 => sum!(u16),
            32 => sum!(u32),
            _ => sum!(u64),
        }
    }

    /// Undoes the predictor of TIFF Technical Note 3, whatever the file's order of bytes.
    fn undo_floating_point(self, row: &mut [u8], ranked: &mut [u8], step: usize) {
        for at in step..row.len() {
            row[at] = row[at].wrapping_add(row[at - step]);
        }
        ranked.copy_from_slice(row);
        let bytes = usize::from(self.bits / 8);
        let count = row.len() / bytes;
        for (index, sample) in row.chunks_exact_mut(bytes).enumerate() {
            // The highest byte comes first.
            for (rank, byte) in sample.iter_mut().enumerate() {
                let rank = if cfg!(target_endian = "little") { bytes - 1 - rank } else { rank };
                *byte = ranked[rank * count + index];
            }
        }
    }
}

fn short(found: usize, expected: usize) -> Error {
    TiffProblem::ChunkBytes { found, expected }.into()
}

fn lzw(packed: &[u8], samples: &mut [u8]) -> Result<(), Error> {
    // TIFF's own order has the highest bit first, so that a strip begins with the code 256 as 0x80.
    if let [0, second, ..] = packed
        && second & 1 == 1
    {
        return Err(TiffProblem::Compression { found: "LZW of before 1990, of low bits first".to_owned() }.into());
    }
    let mut decoder = LzwDecoder::with_tiff_size_switch(BitOrder::Msb, 8);
    let (mut read, mut written) = (0, 0);
    while written < samples.len() {
        let step = decoder.decode_bytes(&packed[read..], &mut samples[written..]);
        read += step.consumed_in;
        written += step.consumed_out;
        match step.status {
            Ok(LzwStatus::Ok) if step.consumed_in + step.consumed_out > 0 => {}
            Ok(_) if written < samples.len() => return Err(short(written, samples.len())),
            Ok(_) => {}
            Err(error) => return Err(TiffProblem::Damaged(one_line(&error.to_string())).into()),
        }
    }
    Ok(())
}

fn pack_bits(packed: &[u8], samples: &mut [u8]) -> Result<(), Error> {
    let expected = samples.len();
    let (mut rest, mut written) = (packed, 0);
    while written < expected {
        let Some((&head, after)) = rest.split_first() else { return Err(short(written, expected)) };
        let count = match head {
            0..=127 => usize::from(head) + 1,
            128 => {
                rest = after;
                continue;
            }
            129..=255 => 257 - usize::from(head),
        };
        let room = count.min(expected - written);
        let to = &mut samples[written..written + room];
        let used = if head < 128 { count.min(after.len()) } else { 1 };
        if after.is_empty() || (head < 128 && used < room) {
            return Err(short(written, expected));
        }
        if head < 128 {
            to.copy_from_slice(&after[..room]);
        } else {
            to.fill(after[0]);
        }
        rest = &after[used..];
        written += room;
    }
    Ok(())
}

fn read_all(mut decoder: impl Read, samples: &mut [u8]) -> Result<(), Error> {
    let mut written = 0;
    while written < samples.len() {
        match decoder.read(&mut samples[written..]) {
            Ok(0) => return Err(short(written, samples.len())),
            Ok(bytes) => written += bytes,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(error) => return Err(TiffProblem::Damaged(one_line(&error.to_string())).into()),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const PACKING: Packing = Packing {
        compression: Compression::None,
        predictor: Predictor::None,
        reversed_bits: false,
        order: Order::Big,
        bits: 16,
    };

    #[test]
    fn words_come_in_the_order_of_the_machine() {
        assert_eq!(
            PACKING.unpack(vec![1, 2, 3, 4, 9], 1, 4, 1).unwrap(),
            [0x0102_u16.to_ne_bytes(), 0x0304_u16.to_ne_bytes()].concat()
        );
        assert!(PACKING.unpack(vec![1, 2, 3], 1, 4, 1).is_err());
    }

    #[test]
    fn differences_are_those_of_whole_pixels() {
        let packing = Packing { bits: 8, predictor: Predictor::Horizontal, ..PACKING };
        // Two pixels of four samples, the second 1, 2, 3 and 4 above the first; then the next row begins anew.
        let rows = vec![10, 20, 30, 40, 1, 2, 3, 4, 9, 9, 9, 9, 255, 0, 0, 0];
        let expected = [10, 20, 30, 40, 11, 22, 33, 44, 9, 9, 9, 9, 8, 9, 9, 9];
        assert_eq!(packing.unpack(rows, 2, 8, 4).unwrap(), expected);
    }

    /// Packs as the note says: bytes of one rank together, the highest first, then differences.
    #[test]
    fn floats_come_back_from_their_ranks() {
        let values = [0.25_f32, -7.5e9, f32::MIN_POSITIVE, 3.0, 0.0, f32::INFINITY];
        for step in [1, 2, 3] {
            let mut ranked: Vec<u8> =
                (0..4).flat_map(|rank| values.iter().map(move |value| value.to_be_bytes()[rank])).collect();
            for at in (step..ranked.len()).rev() {
                ranked[at] = ranked[at].wrapping_sub(ranked[at - step]);
            }
            let packing = Packing { bits: 32, predictor: Predictor::FloatingPoint, ..PACKING };
            let expected: Vec<u8> = values.iter().flat_map(|value| value.to_ne_bytes()).collect();
            assert_eq!(packing.unpack(ranked, 1, 24, step).unwrap(), expected);
        }
    }

    #[test]
    fn runs_and_literals_are_unpacked_and_cut_short_ones_refused() {
        let packing = Packing { compression: Compression::PackBits, bits: 8, ..PACKING };
        let packed = vec![128, 1, 7, 8, 254, 9];
        assert_eq!(packing.unpack(packed.clone(), 1, 5, 1).unwrap(), [7, 8, 9, 9, 9]);
        for length in 0..packed.len() {
            assert!(packing.unpack(packed[..length].to_vec(), 1, 5, 1).is_err(), "{length}");
        }
    }

    #[test]
    fn reversed_bits_are_turned_before_all_else() {
        let packing = Packing { compression: Compression::PackBits, reversed_bits: true, bits: 8, ..PACKING };
        assert_eq!(packing.unpack(vec![0b1000_0000, 0b1000_0000, 0b0100_0000], 1, 2, 1).unwrap(), [1, 2]);
    }

    #[test]
    fn old_lzw_is_named() {
        let packing = Packing { compression: Compression::Lzw, bits: 8, ..PACKING };
        assert!(packing.unpack(vec![0, 1, 0, 0], 1, 2, 1).unwrap_err().to_string().contains("before 1990"));
    }
}
