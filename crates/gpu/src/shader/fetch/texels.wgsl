// A 3D table from single texels. Twin: `Lut3d::apply`.

// From four corners: the first to the last along the axes in falling order of their fractions.
fn onelight_tetrahedral(table: texture_3d<f32>, corner: vec3i, fraction: vec3f) -> vec3f {
    let xy = fraction.x >= fraction.y;
    let yz = fraction.y >= fraction.z;
    let xz = fraction.x >= fraction.z;
    let x_most = xy && xz;
    let y_most = !xy && yz;
    let z_least = yz && xz;
    let x_least = !xy && !xz;
    let first = vec3i(vec3<bool>(x_most, y_most, !x_most && !y_most));
    let second = vec3i(1) - vec3i(vec3<bool>(x_least, !x_least && !z_least, z_least));
    let low = min(fraction.x, fraction.y);
    let high = max(fraction.x, fraction.y);
    let most = max(high, fraction.z);
    let least = min(low, fraction.z);
    let middle = max(low, min(high, fraction.z));
    return textureLoad(table, corner, 0).rgb * (1.0 - most)
        + textureLoad(table, corner + first, 0).rgb * (most - middle)
        + textureLoad(table, corner + second, 0).rgb * (middle - least)
        + textureLoad(table, corner + vec3i(1), 0).rgb * least;
}

// From eight corners, linearly along red, then green, then blue.
fn onelight_trilinear(table: texture_3d<f32>, corner: vec3i, fraction: vec3f) -> vec3f {
    let x = fraction.x;
    let a = mix(textureLoad(table, corner, 0).rgb, textureLoad(table, corner + vec3i(1, 0, 0), 0).rgb, x);
    let b = mix(textureLoad(table, corner + vec3i(0, 1, 0), 0).rgb, textureLoad(table, corner + vec3i(1, 1, 0), 0).rgb, x);
    let c = mix(textureLoad(table, corner + vec3i(0, 0, 1), 0).rgb, textureLoad(table, corner + vec3i(1, 0, 1), 0).rgb, x);
    let d = mix(textureLoad(table, corner + vec3i(0, 1, 1), 0).rgb, textureLoad(table, corner + vec3i(1), 0).rgb, x);
    return mix(mix(a, b, fraction.y), mix(c, d, fraction.y), fraction.z);
}

// `last` is the number of the last node of an axis; `trilinear` is 0 for tetrahedra.
fn onelight_table_entry(table: texture_3d<f32>, coordinates: vec3f, last: f32, trilinear: u32) -> vec3f {
    let position = clamp(coordinates, vec3f(0.0), vec3f(1.0)) * last;
    // The last node belongs to the last cell.
    let corner = min(vec3i(position), vec3i(i32(last) - 1));
    let fraction = position - vec3f(corner);
    if trilinear != 0u {
        return onelight_trilinear(table, corner, fraction);
    }
    return onelight_tetrahedral(table, corner, fraction);
}
