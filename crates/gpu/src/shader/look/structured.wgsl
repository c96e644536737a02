// What a structured look is bound to. `wgsl` writes the group and the numbers that it is asked for.
@group(0) @binding(0) var<uniform> onelight_look: OnelightStructured;
@group(0) @binding(1) var onelight_table: texture_3d<f32>;
@group(0) @binding(2) var onelight_points: texture_2d<f32>;

fn onelight_develop(rgb: vec3f) -> vec3f {
    let coordinates = onelight_coordinates(rgb, onelight_look, onelight_points);
    let entry = onelight_table_entry(onelight_table, coordinates, onelight_look.last, onelight_look.trilinear);
    return onelight_decode(entry, onelight_look);
}
