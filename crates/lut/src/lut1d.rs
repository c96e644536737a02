use crate::domain::Domain;
use crate::error::{Error, ErrorKind};
use crate::interpolate::cell;
use crate::interpolate::is_entry;
use crate::number::Number;

/// Three curves, one per channel, as numbers at equal steps over a [`Domain`], read linearly between them.
///
/// Inputs outside the domain read the first or last entry; NaN reads the first.
///
/// ```
/// use onelight_lut::Lut1d;
/// let roots = Lut1d::sample(1024, [0.0, 4.0], f64::sqrt)?;
/// assert!((roots.apply([1.0, 2.25, 9.0])[1] - 1.5).abs() < 1e-4);
/// assert_eq!(roots.apply([1.0, 2.25, 9.0])[2], 2.0);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Lut1d {
    domain: Domain,
    entries: Vec<[f32; 3]>,
}

impl Lut1d {
    /// The fewest entries: the two ends of the domain.
    pub const MIN_SIZE: usize = 2;

    /// The most entries, 2^20: 12 MiB.
    pub const MAX_SIZE: usize = 1 << 20;

    /// A table from its entries, red, green and blue; the first lies at the domain's minimum.
    ///
    /// # Errors
    ///
    /// If there are fewer than [`Lut1d::MIN_SIZE`] or more than [`Lut1d::MAX_SIZE`] entries, or one of them is
    /// no number within ±1e38: means of such are finite.
    pub fn new(domain: Domain, entries: Vec<[f32; 3]>) -> Result<Self, Error> {
        check_size(entries.len())?;
        match entries.iter().position(|e| !is_entry(e)) {
            Some(index) => Err(ErrorKind::Entry1d { index, found: entries[index] }.into()),
            None => Ok(Self { domain, entries }),
        }
    }

    /// One curve for all channels: `size` values of `f` at equal steps over `[first, last]`.
    ///
    /// # Errors
    ///
    /// If the size is out of bounds, the domain is (see [`Domain::new`]), or `f` yields a value not finite in
    /// `f32`.
    pub fn sample(size: usize, [first, last]: [f64; 2], f: impl Fn(f64) -> f64) -> Result<Self, Error> {
        check_size(size)?;
        let domain = Domain::common(first as f32, last as f32)?;
        let entries = (0..size)
            .map(|i| {
                let part = i as f64 / (size - 1) as f64;
                [f(first * (1.0 - part) + last * part) as f32; 3]
            })
            .collect();
        Self::new(domain, entries)
    }

    /// The inputs that the first and the last entry stand for.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The entries from the domain's minimum to its maximum, each red, green and blue.
    pub fn entries(&self) -> &[[f32; 3]] {
        &self.entries
    }

    /// The number of entries of each curve.
    pub fn size(&self) -> usize {
        self.entries.len()
    }

    /// The least and the largest entry of each channel: what is read lies between them.
    pub(crate) fn ends(&self) -> [[f32; 2]; 3] {
        let mut ends = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
        for entry in &self.entries {
            for (ends, v) in ends.iter_mut().zip(entry) {
                *ends = [ends[0].min(*v), ends[1].max(*v)];
            }
        }
        ends
    }

    /// Reads each channel's curve at that channel's input.
    #[inline]
    pub fn apply(&self, rgb: [f32; 3]) -> [f32; 3] {
        self.apply_in(rgb)
    }

    /// The one definition of [`Lut1d::apply`], for float32 and float64.
    #[inline]
    pub(crate) fn apply_in<N: Number>(&self, rgb: [N; 3]) -> [N; 3] {
        let coordinates = self.domain.normalised(rgb);
        std::array::from_fn(|channel| {
            let (index, t) = cell(coordinates[channel], self.entries.len());
            let [low, high] = [index, index + 1].map(|i| N::of(self.entries[i][channel]));
            low * (N::ONE - t) + high * t
        })
    }
}

pub(crate) fn check_size(found: usize) -> Result<(), Error> {
    if (Lut1d::MIN_SIZE..=Lut1d::MAX_SIZE).contains(&found) {
        Ok(())
    } else {
        Err(ErrorKind::Size { what: "1D LUT", found, min: Lut1d::MIN_SIZE, max: Lut1d::MAX_SIZE }.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn uneven() -> Lut1d {
        let domain = Domain::new([-1.0, 0.0, 2.0], [1.0, 4.0, 3.0]).unwrap();
        Lut1d::new(domain, vec![[0.0, 1.0, -5.0], [0.5, 0.0, 7.0], [2.0, 3.0, 9.0]]).unwrap()
    }

    #[test]
    fn each_channel_has_its_curve_and_domain() {
        let lut = uneven();
        assert_eq!(lut.apply([-1.0, 0.0, 2.0]), [0.0, 1.0, -5.0]);
        assert_eq!(lut.apply([0.0, 2.0, 2.5]), [0.5, 0.0, 7.0]);
        assert_eq!(lut.apply([1.0, 4.0, 3.0]), [2.0, 3.0, 9.0]);
        assert_eq!(lut.apply([0.5, 1.0, 2.25]), [1.25, 0.5, 1.0]);
    }

    #[test]
    fn outside_the_domain_the_ends_hold() {
        let lut = uneven();
        let [first, last] = [[0.0, 1.0, -5.0], [2.0, 3.0, 9.0]];
        assert_eq!(lut.apply([-9.0; 3]), first);
        assert_eq!(lut.apply([f32::NEG_INFINITY; 3]), first);
        assert_eq!(lut.apply([f32::NAN; 3]), first);
        assert_eq!(lut.apply([9.0; 3]), last);
        assert_eq!(lut.apply([f32::INFINITY; 3]), last);
    }

    #[test]
    fn affine_curves_come_back() {
        let lut = Lut1d::sample(65_536, [-2.0, 6.0], |u| 0.25 * u - 1.0).unwrap();
        for i in 0..1000 {
            let u = -2.0 + 8.0 * (i as f32 + 0.3) / 1000.0;
            assert_abs_diff_eq!(lut.apply([u; 3])[1], 0.25 * u - 1.0, epsilon = 4e-7);
        }
    }

    #[test]
    fn entries_and_sizes_are_checked() {
        assert!(Lut1d::new(Domain::UNIT, vec![[0.0; 3]]).is_err());
        assert!(Lut1d::sample(1, [0.0, 1.0], |u| u).is_err());
        assert!(Lut1d::sample(Lut1d::MAX_SIZE + 1, [0.0, 1.0], |u| u).is_err());
        assert!(Lut1d::sample(4, [0.0, 0.0], |u| u).is_err());
        assert!(Lut1d::sample(4, [0.0, 1.0], |u| 1.0 / u).is_err());
        let error = Lut1d::new(Domain::UNIT, vec![[0.0; 3], [0.0, f32::NAN, 0.0]]);
        assert_eq!(
            error.unwrap_err().to_string(),
            "entry 1 of a 1D LUT: found [0.0, NaN, 0.0], expected numbers within ±1e38"
        );
    }
}
