use crate::error::{Error, ErrorKind};
use crate::interpolate::{Interpolation, Place, is_entry, tetrahedral, trilinear, weights};
use crate::padded::Padded;

/// A cube of `size`^3 entries over `[0, 1]`^3: three numbers at every node.
///
/// Red runs fastest in memory: the entry of node `[r, g, b]` is number `r + size * (g + size * b)`. Node `i` of
/// an axis lies at `i / (size - 1)`. Coordinates outside `[0, 1]` are clamped to it; NaN counts as 0.
///
/// ```
/// use onelight_lut::{Interpolation, Lut3d};
/// let inverse = Lut3d::new(2, Lut3d::identity(2)?.entries().map(|rgb| rgb.map(|v| 1.0 - v)).collect())?;
/// assert_eq!(inverse.apply([0.25, 0.5, 1.0], Interpolation::Tetrahedral), [0.75, 0.5, 0.0]);
/// assert_eq!(inverse.entry([1, 0, 0]), Some([0.0, 1.0, 1.0]));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Lut3d {
    size: usize,
    /// A zero after each: the loops read sixteen bytes at once.
    entries: Padded,
}

impl Lut3d {
    /// The fewest nodes a side.
    pub const MIN_SIZE: usize = 2;

    /// The most nodes a side: 256 MiB of entries, 16 bytes each.
    pub const MAX_SIZE: usize = 256;

    /// A table of `size` nodes a side from its entries, red fastest.
    ///
    /// # Errors
    ///
    /// If `size` is out of bounds, the number of entries is not `size`^3, or an entry is no number within ±1e38: means of such are
    /// finite.
    #[allow(
        clippy::needless_pass_by_value,
        reason = "callers hand over what they filled, and both would take memory otherwise"
    )]
    pub fn new(size: usize, entries: Vec<[f32; 3]>) -> Result<Self, Error> {
        let expected = node_count(size)?;
        let found = entries.len();
        if found != expected {
            return Err(ErrorKind::EntryCount { size, found, expected }.into());
        }
        match first_not_finite(&entries) {
            Some(index) => Err(ErrorKind::Entry3d { node: node_of(index, size), found: entries[index] }.into()),
            None => Ok(Self { size, entries: Padded::new(&entries) }),
        }
    }

    /// The table that returns its coordinates.
    ///
    /// # Errors
    ///
    /// If `size` is out of bounds.
    pub fn identity(size: usize) -> Result<Self, Error> {
        let entries = (0..node_count(size)?)
            .map(|index| node_of(index, size).map(|i| (i as f64 / (size - 1) as f64) as f32))
            .collect();
        Self::new(size, entries)
    }

    /// The number of nodes along each axis.
    pub fn size(&self) -> usize {
        self.size
    }

    /// All entries in memory order, red fastest.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = [f32; 3]> + DoubleEndedIterator + Clone {
        self.entries.entries().iter().map(|&[r, g, b, _]| [r, g, b])
    }

    /// The entry of a node, red, green and blue counted from 0; none beyond the last node of an axis.
    pub fn entry(&self, node: [usize; 3]) -> Option<[f32; 3]> {
        if node.into_iter().any(|i| i >= self.size) {
            return None;
        }
        let [r, g, b] = node;
        let [red, green, blue, _] = self.entries.entries()[r + self.size * (g + self.size * b)];
        Some([red, green, blue])
    }

    /// The entries as the loops read them.
    pub(crate) fn padded(&self) -> &Padded {
        &self.entries
    }

    /// Reads the table at coordinates in `[0, 1]`.
    #[inline]
    pub fn apply(&self, [red, green, blue]: [f32; 3], interpolation: Interpolation) -> [f32; 3] {
        self.read(red, green, blue, interpolation)
    }

    /// [`Lut3d::apply`] of numbers that come in registers. An array that was just written, number by number, and is read back
    /// two at a time has to wait for memory: a quarter of the time that a look-up takes.
    #[inline]
    pub(crate) fn read(&self, red: f32, green: f32, blue: f32, interpolation: Interpolation) -> [f32; 3] {
        let place = Place::new([red, green, blue], self.size);
        match interpolation {
            Interpolation::Trilinear => trilinear(self.entries.entries(), place),
            Interpolation::Tetrahedral => tetrahedral(self.entries.entries(), place),
        }
        .to_array()
    }

    /// [`Lut3d::apply`] in float64, from the same stored entries.
    pub(crate) fn apply_f64(&self, coordinates: [f64; 3], interpolation: Interpolation) -> [f64; 3] {
        let entries = self.entries.entries();
        let mut sum = [0.0; 3];
        for (entry, weight) in weights(coordinates, self.size, interpolation).into_iter().take(interpolation.nodes()) {
            for (sum, v) in sum.iter_mut().zip(entries[entry as usize]) {
                *sum += weight * f64::from(v);
            }
        }
        sum
    }
}

/// `size`^3, if a table may have that size.
pub(crate) fn node_count(size: usize) -> Result<usize, Error> {
    if (Lut3d::MIN_SIZE..=Lut3d::MAX_SIZE).contains(&size) {
        Ok(size * size * size)
    } else {
        Err(ErrorKind::Size { what: "3D LUT", found: size, min: Lut3d::MIN_SIZE, max: Lut3d::MAX_SIZE }.into())
    }
}

/// The node whose entry has this number in memory.
pub(crate) fn node_of(index: usize, size: usize) -> [usize; 3] {
    [index % size, index / size % size, index / (size * size)]
}

/// The first entry in memory that has a NaN, an infinity or what is nearly one.
pub(crate) fn first_not_finite(entries: &[[f32; 3]]) -> Option<usize> {
    entries.iter().position(|entry| !is_entry(entry))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SceneSampler;
    use approx::assert_abs_diff_eq;

    const BOTH: [Interpolation; 2] = [Interpolation::Trilinear, Interpolation::Tetrahedral];

    /// A few roundings of values near 1, and of a position among up to 32 cells.
    const ROUNDING: f32 = 2e-6;

    fn filled(size: usize, f: impl Fn([f32; 3]) -> [f32; 3]) -> Lut3d {
        let identity = Lut3d::identity(size).unwrap();
        Lut3d::new(size, identity.entries().map(f).collect()).unwrap()
    }

    /// Not affine, not symmetric, different in every channel.
    fn curved([x, y, z]: [f32; 3]) -> [f32; 3] {
        [x * x + 0.3 * y * z, (3.0 * y).sin() * (1.0 - 0.5 * x), (z + 0.1).sqrt() - x * y * z]
    }

    /// Coordinates all over the cube.
    fn coordinates() -> impl Iterator<Item = [f32; 3]> {
        let shaper = crate::Shaper::log2(0.02, 4.0).unwrap();
        SceneSampler::new(-8.0..=4.0).unwrap().take(5000).map(move |rgb| rgb.map(|u| shaper.encode(u) as f32))
    }

    #[test]
    fn identity_returns_its_input() {
        for size in [2, 5, 17, 33] {
            let lut = Lut3d::identity(size).unwrap();
            for (rgb, how) in coordinates().flat_map(|rgb| BOTH.map(|how| (rgb, how))) {
                let out = lut.apply(rgb, how);
                for c in 0..3 {
                    assert_abs_diff_eq!(out[c], rgb[c], epsilon = ROUNDING);
                }
            }
        }
    }

    #[test]
    fn affine_maps_come_back() {
        let map = |[x, y, z]: [f32; 3]| [0.5 * x - 0.25 * y + 0.125 * z + 0.1, -x + 0.3 * y, 0.2 * z + 0.7 * y - 0.4];
        let lut = filled(9, map);
        for (rgb, how) in coordinates().flat_map(|rgb| BOTH.map(|how| (rgb, how))) {
            for (out, want) in lut.apply(rgb, how).into_iter().zip(map(rgb)) {
                assert_abs_diff_eq!(out, want, epsilon = ROUNDING);
            }
        }
    }

    #[test]
    fn nodes_are_exact_where_their_coordinates_are() {
        // Sizes 2^k + 1: i / (size - 1) and its product with size - 1 are exact in f32.
        for size in [2, 3, 17] {
            let lut = filled(size, curved);
            for (index, entry) in lut.entries().enumerate() {
                let at = node_of(index, size).map(|i| i as f32 / (size - 1) as f32);
                for how in BOTH {
                    assert_eq!(lut.apply(at, how), entry);
                }
            }
        }
    }

    #[test]
    fn memory_order_is_red_fastest() {
        let mut entries = vec![[0.0; 3]; 27];
        entries[2 + 3 * (1 + 3 * 2)] = [1.0, 2.0, 3.0];
        let lut = Lut3d::new(3, entries).unwrap();
        for how in BOTH {
            assert_eq!(lut.apply([1.0, 0.5, 1.0], how), [1.0, 2.0, 3.0]);
        }
    }

    #[test]
    fn interpolations_agree_on_the_edges_of_cells_and_differ_inside() {
        let lut = filled(5, curved);
        for i in 0..=100 {
            let t = i as f32 / 100.0;
            for at in [[t, 0.25, 0.5], [0.75, t, 1.0], [0.0, 0.5, t]] {
                let [a, b] = BOTH.map(|how| lut.apply(at, how));
                for c in 0..3 {
                    assert_abs_diff_eq!(a[c], b[c], epsilon = ROUNDING);
                }
            }
        }
        let [a, b] = BOTH.map(|how| lut.apply([0.3, 0.9, 0.4], how));
        assert!((a[0] - b[0]).abs() > 1e-3);
    }

    #[test]
    fn greys_are_read_from_greys_by_tetrahedra() {
        // Entries off the diagonal are wild; trilinear sees them, tetrahedral does not.
        let size = 5;
        let identity = Lut3d::identity(size).unwrap();
        let wild = identity.entries().map(|[x, y, z]| if x == y && y == z { [2.0 * x + 1.0; 3] } else { [50.0; 3] });
        let lut = Lut3d::new(size, wild.collect()).unwrap();
        for i in 0..=100 {
            let t = i as f32 / 100.0;
            let out = lut.apply([t; 3], Interpolation::Tetrahedral);
            assert_abs_diff_eq!(out[0], 2.0 * t + 1.0, epsilon = ROUNDING);
        }
        assert!(lut.apply([0.1; 3], Interpolation::Trilinear)[0] > 10.0);
    }

    #[test]
    fn tetrahedra_meet_at_their_faces() {
        // Cross each of the planes x = y, y = z, x = z inside a cell, by a step whose own effect is bounded.
        let lut = filled(3, curved);
        let step = 1e-5;
        for i in 1..50 {
            let [a, b] = [i as f32 / 100.0, ((i * 7) % 50) as f32 / 100.0];
            for (low, high) in [
                ([a, a + step, b], [a + step, a, b]),
                ([b, a, a + step], [b, a + step, a]),
                ([a, b, a + step], [a + step, b, a]),
            ] {
                let [low, high] = [low, high].map(|at| lut.apply(at, Interpolation::Tetrahedral));
                for c in 0..3 {
                    assert_abs_diff_eq!(low[c], high[c], epsilon = 10.0 * step);
                }
            }
        }
    }

    #[test]
    fn cells_meet_at_their_faces() {
        let lut = filled(5, curved);
        for how in BOTH {
            for [x, y] in [[0.1, 0.9], [0.33, 0.2], [0.6, 0.55]] {
                let below = lut.apply([x, y, 0.5 - 1e-6], how);
                let above = lut.apply([x, y, 0.5 + 1e-6], how);
                for c in 0..3 {
                    assert_abs_diff_eq!(below[c], above[c], epsilon = 1e-5);
                }
            }
        }
    }

    #[test]
    fn outside_the_cube_the_faces_hold() {
        let lut = filled(4, curved);
        for how in BOTH {
            let at = |rgb| lut.apply(rgb, how);
            assert_eq!(at([-1.0, 2.0, 0.3]), at([0.0, 1.0, 0.3]));
            assert_eq!(at([f32::NAN, 0.4, 0.3]), at([0.0, 0.4, 0.3]));
            assert_eq!(at([f32::INFINITY, f32::NEG_INFINITY, 0.3]), at([1.0, 0.0, 0.3]));
        }
    }

    #[test]
    fn sizes_and_entries_are_checked() {
        for size in [0, 1, 257, usize::MAX] {
            assert!(Lut3d::new(size, Vec::new()).is_err());
            assert!(Lut3d::identity(size).is_err());
        }
        assert_eq!(
            Lut3d::new(2, vec![[0.0; 3]; 7]).unwrap_err().to_string(),
            "entries of a 3D LUT of size 2: found 7, expected 8"
        );
        let mut entries = vec![[0.0; 3]; 8];
        entries[5][1] = f32::INFINITY;
        assert_eq!(
            Lut3d::new(2, entries).unwrap_err().to_string(),
            "entry of a 3D LUT at node [1, 0, 1]: found [0.0, inf, 0.0], expected numbers within ±1e38"
        );
    }
}
