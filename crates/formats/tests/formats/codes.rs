//! Tables as text of integer codes.

use onelight_formats::{lut_3dl, vlt};
use onelight_lut::Lut3d;

use crate::tables::bent;

fn codes(lines: &str) -> Vec<[f32; 3]> {
    let line = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect::<Vec<f32>>().try_into().unwrap();
    lines.lines().map(line).collect()
}

fn nearest(entry: [f32; 3]) -> [f32; 3] {
    entry.map(|v| (v.clamp(0.0, 1.0) * 4095.0).round())
}

#[test]
fn a_vlt_has_its_header_and_red_fastest() {
    let table = bent(vlt::SIZE);
    let mut bytes = Vec::new();
    vlt::write(&mut bytes, &table).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let body =
        text.strip_prefix("# panasonic vlt file version 1.0\n# source vlt file \"\"\nLUT_3D_SIZE 17\n\n").unwrap();
    assert_eq!(codes(body), table.entries().map(nearest).collect::<Vec<_>>());
    let error = vlt::write(Vec::new(), &bent(9)).unwrap_err();
    assert!(error.is_table() && error.to_string().contains("found 9, expected 17"), "{error}");
}

#[test]
fn a_3dl_has_its_mesh_and_blue_fastest() {
    let table = Lut3d::identity(17).unwrap();
    let mut bytes = Vec::new();
    lut_3dl::write(&mut bytes, &table, ["one\ntwo"]).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let mut lines = text.lines();
    assert_eq!([lines.next(), lines.next()], [Some("# one"), Some("# two")]);
    let mesh: Vec<u32> = lines.next().unwrap().split(' ').map(|word| word.parse().unwrap()).collect();
    assert_eq!((mesh.len(), mesh[0], mesh[8], mesh[16]), (17, 0, 512, 1023));
    assert!(mesh.windows(2).all(|pair| (63..=64).contains(&(pair[1] - pair[0]))), "{mesh:?}");
    let rest = codes(&lines.collect::<Vec<_>>().join("\n"));
    assert_eq!((rest.len(), rest[1], rest[17]), (4913, [0.0, 0.0, 256.0], [0.0, 256.0, 0.0]));
}
