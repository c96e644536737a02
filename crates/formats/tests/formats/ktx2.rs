//! KTX2 textures as an independent reader finds them.

use ::ktx2::{Format, Reader};
use half::f16;
use onelight_formats::ktx2;
use onelight_lut::Lut3d;

fn bent(size: usize) -> Lut3d {
    let identity = Lut3d::identity(size).unwrap();
    Lut3d::new(size, identity.entries().map(|[x, y, z]| [x * x - 0.2, 40.0 * y, 1e-6 + z]).collect()).unwrap()
}

fn file(table: &Lut3d, comments: &[&str]) -> Vec<u8> {
    let mut file = Vec::new();
    ktx2::write(&mut file, table, comments).unwrap();
    file
}

#[test]
fn an_independent_reader_finds_the_table() {
    for (size, comments) in [(2, &[][..]), (3, &["x"]), (32, &["max dE 0.3", "\u{3b4}"]), (33, &["four"])] {
        let table = bent(size);
        let file = file(&table, comments);
        let reader = Reader::new(&file).unwrap();
        let header = reader.header();
        assert_eq!(header.format, Some(Format::R16G16B16A16_SFLOAT));
        assert_eq!([header.pixel_width, header.pixel_height, header.pixel_depth], [size as u32; 3]);
        assert_eq!([header.type_size, header.layer_count, header.face_count, header.level_count], [2, 0, 1, 1]);
        assert!(header.supercompression_scheme.is_none());
        assert!(reader.writer().unwrap().starts_with("onelight-lut "));
        let pairs: Vec<_> = reader.key_value_data().collect();
        assert_eq!(pairs.len(), if comments.is_empty() { 1 } else { 2 });
        let levels: Vec<_> = reader.levels().collect();
        assert_eq!(levels.len(), 1);
        let (texels, rest) = levels[0].data.as_chunks::<8>();
        assert_eq!((texels.len(), rest.len()), (size.pow(3), 0));
        assert_eq!((levels[0].data.as_ptr() as usize - file.as_ptr() as usize) % 8, 0);
        for (texel, entry) in texels.iter().zip(table.entries()) {
            let (halfs, _) = texel.as_chunks::<2>();
            let values: Vec<_> = halfs.iter().map(|&half| f16::from_le_bytes(half)).collect();
            let [r, g, b] = entry.map(f16::from_f32);
            assert_eq!(values, [r, g, b, f16::ONE]);
        }
    }
}

#[test]
fn the_descriptor_is_that_of_four_halfs() {
    let file = file(&bent(2), &[]);
    let reader = Reader::new(&file).unwrap();
    let basic = reader.basic_dfd().unwrap();
    assert_eq!(basic.bytes_planes, [8, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(basic.color_model, Some(::ktx2::ColorModel::RGBSDA));
    assert_eq!(basic.transfer_function, Some(::ktx2::TransferFunction::Linear));
    let samples: Vec<_> = basic.sample_information.iter().collect();
    assert_eq!(samples.len(), 4);
    for (i, sample) in samples.iter().enumerate() {
        assert_eq!(sample.bit_offset, 16 * i as u16);
        assert_eq!(sample.bit_length.get(), 16);
        assert_eq!([sample.lower, sample.upper], [(-1.0_f32).to_bits(), 1.0_f32.to_bits()]);
    }
}

#[test]
fn what_is_no_half_is_refused() {
    let mut entries = vec![[0.5; 3]; 8];
    entries[6][2] = 7e4;
    let error = ktx2::write(Vec::new(), &Lut3d::new(2, entries).unwrap(), [""; 0]).unwrap_err();
    assert!(error.to_string().contains("node [0, 1, 1]"), "{error}");
}
