use glam::{Vec3A, Vec4};

use crate::number::Number;

/// How a 3D table is read between its nodes.
///
/// Both are continuous, exact at the nodes (a coordinate is a float32 and may miss its node by a rounding) and exact for affine maps.
///
/// ```
/// use onelight_lut::{Interpolation, bake_coordinates};
/// // White at one corner alone: the middle of the cell is an eighth of it, or half of it along the diagonal of greys.
/// let corner = bake_coordinates(2, |rgb| [rgb[0] * rgb[1] * rgb[2]; 3], |_nodes_done| {})?;
/// assert_eq!(corner.apply([0.5; 3], Interpolation::Trilinear), [0.125; 3]);
/// assert_eq!(corner.apply([0.5; 3], Interpolation::Tetrahedral), [0.5; 3]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
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

impl Interpolation {
    /// How many nodes a value is read from.
    pub(crate) fn nodes(self) -> usize {
        match self {
            Self::Trilinear => 8,
            Self::Tetrahedral => 4,
        }
    }
}

/// The largest entry of a table, either side of 0: weights come to 1 but for their rounding, and a mean of the largest floats
/// would be infinite.
pub(crate) const ENTRY_MAX: f32 = 1e38;

/// Whether a table may hold this entry.
pub(crate) fn is_entry(entry: &[f32; 3]) -> bool {
    entry.iter().all(|v| v.abs() <= ENTRY_MAX)
}

/// A place in a table: the cell and how far into it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<N> {
    /// Index of the cell's first corner.
    corner: usize,
    /// Steps in the entries towards the next node along red, green and blue.
    step: [usize; 3],
    /// 0 to 1 along each axis.
    fraction: [N; 3],
}

impl<N: Number> Place<N> {
    /// Where the coordinates, clamped to `[0, 1]`, lie in a table of `size` (2 and more) nodes a side.
    #[inline]
    pub(crate) fn new(coordinates: [N; 3], size: usize) -> Self {
        let step = [1, size, size * size];
        let (r, red) = cell(coordinates[0], size);
        let (g, green) = cell(coordinates[1], size);
        let (b, blue) = cell(coordinates[2], size);
        Self { corner: r + g * step[1] + b * step[2], step, fraction: [red, green, blue] }
    }
}

/// Along one axis: the node at or below a coordinate, and the distance from it in cells.
///
/// The last node belongs to the last cell, so `index + 1` is always a node. NaN counts as 0.
#[inline]
pub(crate) fn cell<N: Number>(coordinate: N, size: usize) -> (usize, N) {
    // Not `clamp`, which would let NaN through.
    let inside = if coordinate > N::ZERO { coordinate.min(N::ONE) } else { N::ZERO };
    let position = inside * N::of_index(size - 1);
    let index = position.to_index().min(size - 2);
    (index, position - N::of_index(index))
}

/// A weight for each of the nodes that a place is read from: number of the entry, weight; those of a tetrahedron are four.
pub(crate) type Weights<N> = [(u32, N); 8];

/// The weights by which entries make the value at coordinates: those of the other functions here, for fitting and for reading
/// in float64. Unused positions hold weight 0.
pub(crate) fn weights<N: Number>(coordinates: [N; 3], size: usize, how: Interpolation) -> Weights<N> {
    let place = Place::new(coordinates, size);
    let [r, g, b] = place.step;
    let fraction = place.fraction;
    let entry = |step: usize| (place.corner + step) as u32;
    match how {
        Interpolation::Trilinear => std::array::from_fn(|corner| {
            let (mut step, mut weight) = (0, N::ONE);
            for (axis, along) in [r, g, b].into_iter().enumerate() {
                let far = corner >> axis & 1 == 1;
                step += if far { along } else { 0 };
                weight = weight * if far { fraction[axis] } else { N::ONE - fraction[axis] };
            }
            (entry(step), weight)
        }),
        Interpolation::Tetrahedral => {
            let mut order = [0, 1, 2];
            order.sort_by(|&i, &k| fraction[k].total_cmp(&fraction[i]));
            let [most, middle, least] = order.map(|axis| fraction[axis]);
            let first = place.step[order[0]];
            let mut weights = [(entry(0), N::ZERO); 8];
            weights[0].1 = N::ONE - most;
            weights[1] = (entry(first), most - middle);
            weights[2] = (entry(first + place.step[order[1]]), middle - least);
            weights[3] = (entry(r + g + b), least);
            weights
        }
    }
}

/// Linear along red, then green, then blue.
#[inline]
pub(crate) fn trilinear(entries: &[[f32; 4]], place: Place<f32>) -> Vec3A {
    let [r, g, b] = place.step;
    let [x, y, z] = place.fraction;
    let at = |step: usize| Vec3A::from_vec4(Vec4::from_array(entries[place.corner + step]));
    let near = mix(mix(at(0), at(r), x), mix(at(g), at(r + g), x), y);
    let far = mix(mix(at(b), at(r + b), x), mix(at(g + b), at(r + g + b), x), y);
    mix(near, far, z)
}

/// From the first corner to the last along the axes in falling order of their fractions.
#[inline]
pub(crate) fn tetrahedral(entries: &[[f32; 4]], place: Place<f32>) -> Vec3A {
    let [r, g, b] = place.step;
    let [x, y, z] = place.fraction;
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
    let at = |step: usize| Vec3A::from_vec4(Vec4::from_array(entries[place.corner + step]));
    at(0) * (1.0 - most) + at(first) * (most - middle) + at(first + second) * (middle - least) + at(r + g + b) * least
}

/// A weighted mean rather than `a + (b - a) t`: finite for all finite ends, and exactly `b` at 1.
#[inline]
fn mix(a: Vec3A, b: Vec3A, t: f32) -> Vec3A {
    a * (1.0 - t) + b * t
}
