//! Tables that more than one kind of file is tried with, and what damage does to pictures of them.

use onelight_formats::{Error, PngDepth};
use onelight_lut::Lut3d;

/// Not separable, with entries beyond 0 and 1.
pub(crate) fn bent(size: usize) -> Lut3d {
    let identity = Lut3d::identity(size).unwrap();
    let bend = |[x, y, z]: [f32; 3]| [1.2 * x * x - 0.1 * y, y.sqrt(), 0.9 * z - 0.05 + 0.2 * x];
    Lut3d::new(size, identity.entries().map(bend).collect()).unwrap()
}

/// What a table may become in a picture.
pub(crate) fn nearest_code(table: &Lut3d, depth: PngDepth) -> Vec<[f32; 3]> {
    let max = if depth == PngDepth::Eight { 255.0 } else { 65_535.0 };
    table.entries().map(|entry| entry.map(|v| (v.clamp(0.0, 1.0) * max).round() / max)).collect()
}

/// A file that `read` takes, cut everywhere, with every byte changed, and with a size it does not have.
pub(crate) fn damage(file: &[u8], read: impl Fn(&[u8]) -> Result<Lut3d, Error>) {
    assert!(read(file).is_ok());
    // The last twelve bytes are the end mark, which no pixel waits for.
    for end in 0..file.len() - 16 {
        let error = read(&file[..end]).unwrap_err();
        assert!(error.is_picture(), "{error}");
    }
    for at in 0..file.len() {
        let mut bytes = file.to_vec();
        bytes[at] ^= 0x55;
        let _ = read(&bytes);
    }
    assert!(read(b"no PNG at all").unwrap_err().is_picture());
    for claim in [0_u32, 1, 100_000, u32::MAX] {
        let mut bytes = file.to_vec();
        bytes[16..20].copy_from_slice(&claim.to_be_bytes());
        bytes[20..24].copy_from_slice(&claim.to_be_bytes());
        assert!(read(&bytes).is_err());
    }
}

/// A picture's size and codes from 0 to 1, by the png crate alone.
pub(crate) fn decoded(file: &[u8]) -> ([usize; 2], Vec<[f32; 3]>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    let (pixels, _) = bytes.as_chunks::<3>();
    let pixels = pixels.iter().map(|pixel| pixel.map(|code| f32::from(code) / 255.0)).collect();
    ([info.width as usize, info.height as usize], pixels)
}
