// What a plain look is bound to. `wgsl` writes the group and the numbers that it is asked for.
@group(0) @binding(0) var<uniform> onelight_look: OnelightPlain;
@group(0) @binding(1) var onelight_table: texture_3d<f32>;

fn onelight_develop(rgb: vec3f) -> vec3f {
    let coordinates = onelight_shaper(rgb, onelight_look);
    return onelight_table_entry(onelight_table, coordinates, onelight_look.last, onelight_look.trilinear);
}
