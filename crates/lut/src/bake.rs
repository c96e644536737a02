use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::error::{Error, ErrorKind};
use crate::lut3d::{Lut3d, first_not_finite, node_count, node_of};
use crate::pixels::{Channels, PixelMap, PixelsMut};
use crate::shaper::Shaper;

/// Fills a table of `size` nodes a side with `f` at the scene-linear colours of its nodes, on all threads.
///
/// Node `i` of an axis stands for `shaper.decode(i / (size - 1))`. The result of `f` is rounded to `f32` once
/// and stored as it is, in whatever coding `f` yields. The table does not depend on the number of threads.
///
/// `progress` is called from any thread, after every row of `size` nodes, with the number of nodes done so far;
/// each number comes once, not always in rising order.
///
/// # Errors
///
/// If `size` is out of bounds (see [`Lut3d`]), or `f` yields a value that is not finite in `f32`; the error
/// names the first such node in memory order.
pub fn bake(
    size: usize,
    shaper: &Shaper,
    f: impl Fn([f64; 3]) -> [f64; 3] + Sync,
    progress: impl Fn(usize) + Sync,
) -> Result<Lut3d, Error> {
    along_axis(size, &|coordinate| shaper.decode(coordinate), &f, &progress)
}

/// [`bake`] for a table whose coordinates are the caller's own coding: `f` takes coordinates from 0 to 1.
///
/// ```
/// // Display-coded in, display-coded out.
/// let table = onelight_lut::bake_coordinates(9, |rgb| rgb.map(|v| v * v), |_nodes_done| {})?;
/// assert_eq!(table.apply([0.5; 3], onelight_lut::Interpolation::Trilinear), [0.25; 3]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
///
/// # Errors
///
/// The same as those of [`bake()`].
pub fn bake_coordinates(
    size: usize,
    f: impl Fn([f64; 3]) -> [f64; 3] + Sync,
    progress: impl Fn(usize) + Sync,
) -> Result<Lut3d, Error> {
    along_axis(size, &|coordinate| coordinate, &f, &progress)
}

/// Fills a table of `size` nodes a side by mapping rows of nodes through a compiled form, on all threads: as fast as the form maps
/// pictures. `at` gives the scene-linear colour for coordinates from 0 to 1.
///
/// # Errors
///
/// If `size` is out of bounds, or the form yields a value that is not finite.
pub fn bake_form(size: usize, at: impl Fn([f64; 3]) -> [f64; 3] + Sync, form: &impl PixelMap) -> Result<Lut3d, Error> {
    let mut entries = nodes_at(size, &at)?;
    let rows = [size, size * size];
    form.map_in_place(&mut PixelsMut::new(entries.as_flattened_mut(), Channels::Rgb, rows)?);
    Lut3d::new(size, entries)
}

/// The scene-linear colours of all nodes.
fn nodes_at(size: usize, at: &(dyn Fn([f64; 3]) -> [f64; 3] + Sync)) -> Result<Vec<[f32; 3]>, Error> {
    let mut entries = vec![[0.0; 3]; node_count(size)?];
    let place = |i: usize| i as f64 / (size - 1) as f64;
    entries.par_chunks_mut(size).enumerate().for_each(|(row, nodes)| {
        let (green, blue) = (place(row % size), place(row / size));
        for (red, node) in nodes.iter_mut().enumerate() {
            *node = at([place(red), green, blue]).map(|v| v as f32);
        }
    });
    Ok(entries)
}

/// Compiled once, whatever is baked.
fn along_axis(
    size: usize,
    value_at: &dyn Fn(f64) -> f64,
    f: &(dyn Fn([f64; 3]) -> [f64; 3] + Sync),
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Lut3d, Error> {
    let mut entries = vec![[0.0; 3]; node_count(size)?];
    let axis: Vec<f64> = (0..size).map(|i| value_at(i as f64 / (size - 1) as f64)).collect();
    let done = AtomicUsize::new(0);
    entries.par_chunks_mut(size).enumerate().for_each(|(row, nodes)| {
        let [green, blue] = [axis[row % size], axis[row / size]];
        for (entry, &red) in nodes.iter_mut().zip(&axis) {
            *entry = f([red, green, blue]).map(|v| v as f32);
        }
        progress(done.fetch_add(size, Ordering::Relaxed) + size);
    });
    match first_not_finite(&entries) {
        Some(index) => {
            let node = node_of(index, size);
            let linear = node.map(|i| axis[i]);
            Err(ErrorKind::BakedNode { node, linear, found: entries[index] }.into())
        }
        None => Lut3d::new(size, entries),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Interpolation, PlainLut};
    use std::sync::Mutex;

    fn shaper() -> Shaper {
        Shaper::log2(0.02, 4.0).unwrap()
    }

    fn look([r, g, b]: [f64; 3]) -> [f64; 3] {
        [r / (r + 0.18), (g * b).sqrt(), (b + 0.1 * r).ln_1p()]
    }

    #[test]
    fn a_form_is_baked_as_it_maps_pixels() {
        let form = PlainLut::new(shaper(), bake(5, &shaper(), look, |_| {}).unwrap(), Interpolation::Tetrahedral);
        let at = |t: [f64; 3]| [4.0 * t[0], t[1], 0.5 * t[2]];
        let table = bake_form(6, at, &form).unwrap();
        for (index, entry) in table.entries().enumerate() {
            let coordinates = node_of(index, 6).map(|i| i as f64 / 5.0);
            let pixel = form.apply(at(coordinates).map(|v| v as f32));
            // Whole rows may be rounded otherwise than single pixels.
            assert!(entry.iter().zip(pixel).all(|(a, b)| (a - b).abs() < 1e-6), "{entry:?} {pixel:?}");
        }
        assert!(bake_form(1, at, &form).is_err());
    }

    #[test]
    fn nodes_hold_the_function() {
        let size = 17;
        let lut = bake(size, &shaper(), look, |_| {}).unwrap();
        for index in 0..lut.entries().len() {
            let coordinates = node_of(index, size).map(|i| i as f64 / (size - 1) as f64);
            let want = look(coordinates.map(|t| shaper().decode(t))).map(|v| v as f32);
            for how in [Interpolation::Trilinear, Interpolation::Tetrahedral] {
                assert_eq!(lut.apply(coordinates.map(|t| t as f32), how), want);
            }
        }
    }

    #[test]
    fn threads_do_not_matter() {
        let bake_on = |threads| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap()
                .install(|| bake(19, &shaper(), look, |_| {}).unwrap())
        };
        assert_eq!(bake_on(1), bake_on(7));
    }

    #[test]
    fn progress_tells_every_row_once() {
        let seen = Mutex::new(Vec::new());
        bake(5, &shaper(), look, |done| seen.lock().unwrap().push(done)).unwrap();
        let mut seen = seen.into_inner().unwrap();
        seen.sort_unstable();
        assert_eq!(seen, (1..=25).map(|row| row * 5).collect::<Vec<_>>());
    }

    #[test]
    fn a_node_that_is_not_finite_is_named() {
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let f = |[r, g, b]: [f64; 3]| {
                if r > 3.9 && g < 0.1 && b > 3.9 { [0.0, bad, 0.0] } else { [0.0; 3] }
            };
            let error = bake(3, &shaper(), f, |_| {}).unwrap_err().to_string();
            assert!(error.starts_with("baked function at node [2, 0, 2], linear [4.0, 0.0, 4.0]"), "{error}");
        }
        assert!(bake(1, &shaper(), look, |_| {}).is_err());
        assert!(bake(100_000, &shaper(), look, |_| {}).is_err());
    }
}
