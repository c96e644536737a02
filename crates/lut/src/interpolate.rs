use glam::Vec3A;

/// How a 3D table is read between its nodes.
///
/// Both are continuous, exact at the nodes (a coordinate is a float32 and may miss its node by a rounding) and exact for affine maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// From the eight corners of the cell, linearly along each axis: what texture units do.
    Trilinear,
    /// From the four corners of one of six tetrahedra that share the cell's diagonal from (0,0,0) to (1,1,1).
    ///
    /// Greys (equal coordinates) are then read from greys alone.
    #[default]
    Tetrahedral,
}

/// A place in a table: the cell and how far into it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Index of the cell's first corner.
    corner: usize,
    /// Steps in the entries towards the next node along red, green and blue.
    step: [usize; 3],
    /// 0 to 1 along each axis.
    fraction: Vec3A,
}

impl Place {
    /// Where the coordinates, clamped to `[0, 1]`, lie in a table of `size` (2 and more) nodes a side.
    #[inline]
    pub(crate) fn new(coordinates: [f32; 3], size: usize) -> Self {
        let step = [1, size, size * size];
        let (r, red) = cell(coordinates[0], size);
        let (g, green) = cell(coordinates[1], size);
        let (b, blue) = cell(coordinates[2], size);
        Self { corner: r + g * step[1] + b * step[2], step, fraction: Vec3A::new(red, green, blue) }
    }
}

/// Along one axis: the node at or below a coordinate, and the distance from it in cells.
///
/// The last node belongs to the last cell, so `index + 1` is always a node. NaN counts as 0.
#[inline]
pub(crate) fn cell(coordinate: f32, size: usize) -> (usize, f32) {
    // Not `clamp`, which would let NaN through.
    let inside = if coordinate > 0.0 { coordinate.min(1.0) } else { 0.0 };
    let position = inside * (size - 1) as f32;
    let index = (position as usize).min(size - 2);
    (index, position - index as f32)
}

/// A weight for each of the nodes that a place is read from: number of the entry, weight; those of a tetrahedron are four.
pub(crate) type Weights = [(u32, f32); 8];

/// The weights by which entries make the value at coordinates: those of the other functions here, for fitting. Unused places
/// hold weight 0.
pub(crate) fn weights(coordinates: [f32; 3], size: usize, how: Interpolation) -> Weights {
    let place = Place::new(coordinates, size);
    let [r, g, b] = place.step;
    let fraction = place.fraction.to_array();
    let entry = |step: usize| (place.corner + step) as u32;
    match how {
        Interpolation::Trilinear => std::array::from_fn(|corner| {
            let (mut step, mut weight) = (0, 1.0);
            for (axis, along) in [r, g, b].into_iter().enumerate() {
                let far = corner >> axis & 1 == 1;
                step += if far { along } else { 0 };
                weight *= if far { fraction[axis] } else { 1.0 - fraction[axis] };
            }
            (entry(step), weight)
        }),
        Interpolation::Tetrahedral => {
            let mut order = [0, 1, 2];
            order.sort_by(|&i, &k| fraction[k].total_cmp(&fraction[i]));
            let [most, middle, least] = order.map(|axis| fraction[axis]);
            let first = place.step[order[0]];
            let mut weights = [(entry(0), 0.0); 8];
            weights[0].1 = 1.0 - most;
            weights[1] = (entry(first), most - middle);
            weights[2] = (entry(first + place.step[order[1]]), middle - least);
            weights[3] = (entry(r + g + b), least);
            weights
        }
    }
}

/// Linear along red, then green, then blue.
#[inline]
pub(crate) fn trilinear(entries: &[[f32; 3]], place: Place) -> Vec3A {
    let [r, g, b] = place.step;
    let [x, y, z] = place.fraction.to_array();
    let at = |step: usize| Vec3A::from_array(entries[place.corner + step]);
    let near = mix(mix(at(0), at(r), x), mix(at(g), at(r + g), x), y);
    let far = mix(mix(at(b), at(r + b), x), mix(at(g + b), at(r + g + b), x), y);
    mix(near, far, z)
}

/// From the first corner to the last along the axes in falling order of their fractions.
#[inline]
pub(crate) fn tetrahedral(entries: &[[f32; 3]], place: Place) -> Vec3A {
    let [r, g, b] = place.step;
    let [x, y, z] = place.fraction.to_array();
    // The first two axes of the way; on a shared face either order gives the same value.
    let (first, second, most, middle, least) = if x >= y {
        if y >= z {
            (r, g, x, y, z)
        } else if x >= z {
            (r, b, x, z, y)
        } else {
            (b, r, z, x, y)
        }
    } else if z >= y {
        (b, g, z, y, x)
    } else if z >= x {
        (g, b, y, z, x)
    } else {
        (g, r, y, x, z)
    };
    let at = |step: usize| Vec3A::from_array(entries[place.corner + step]);
    at(0) * (1.0 - most) + at(first) * (most - middle) + at(first + second) * (middle - least) + at(r + g + b) * least
}

/// A weighted mean rather than `a + (b - a) t`: finite for all finite ends, and exactly `b` at 1.
#[inline]
fn mix(a: Vec3A, b: Vec3A, t: f32) -> Vec3A {
    a * (1.0 - t) + b * t
}
