use crate::error::{Error, ErrorKind};

/// A uniform wavelength grid in whole nanometres: first, last and step, both ends included.
///
/// ```
/// use onelight_spectra::SpectralShape;
/// assert_eq!(SpectralShape::VISIBLE.len(), 401);
/// assert_eq!(SpectralShape::new(400, 1000, 1)?.wavelengths_nm().last(), Some(1000.0));
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SpectralShape {
    first_nm: u16,
    last_nm: u16,
    step_nm: u16,
}

impl SpectralShape {
    /// 380 to 780 nm by 1 nm: the grid of cameras, eyes and projectors.
    pub const VISIBLE: Self = Self::by_1_nm::<380, 780>();

    /// A grid of `first_nm`, `first_nm + step_nm`, ..., `last_nm`.
    ///
    /// # Errors
    /// If `first_nm >= last_nm`, or the step is 0 or does not divide the range.
    pub fn new(first_nm: u16, last_nm: u16, step_nm: u16) -> Result<Self, Error> {
        if first_nm >= last_nm || step_nm == 0 || !(last_nm - first_nm).is_multiple_of(step_nm) {
            return Err(ErrorKind::Shape { first_nm, last_nm, step_nm }.into());
        }
        Ok(Self { first_nm, last_nm, step_nm })
    }

    /// A grid by 1 nm whose ends are checked when the program is compiled.
    #[must_use]
    pub const fn by_1_nm<const FIRST_NM: u16, const LAST_NM: u16>() -> Self {
        const { assert!(FIRST_NM < LAST_NM) };
        Self { first_nm: FIRST_NM, last_nm: LAST_NM, step_nm: 1 }
    }

    /// The shortest wavelength of the grid in nm.
    #[must_use]
    pub const fn first_nm(self) -> f64 {
        self.first_nm as f64
    }

    /// The longest wavelength of the grid in nm.
    #[must_use]
    pub const fn last_nm(self) -> f64 {
        self.last_nm as f64
    }

    /// Distance between neighbours in nm.
    #[must_use]
    pub const fn step_nm(self) -> f64 {
        self.step_nm as f64
    }

    /// Number of wavelengths, at least 2.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a shape is never empty")]
    pub const fn len(self) -> usize {
        ((self.last_nm - self.first_nm) / self.step_nm) as usize + 1
    }

    /// All wavelengths in nm, increasing.
    pub fn wavelengths_nm(self) -> impl ExactSizeIterator<Item = f64> + DoubleEndedIterator + Clone {
        (0..self.len()).map(move |i| self.first_nm() + i as f64 * self.step_nm())
    }

    /// Weights of the trapezoid rule in nm: the step, and half of it at both ends.
    pub fn trapezoid_weights_nm(self) -> impl ExactSizeIterator<Item = f64> + Clone {
        let last = self.len() - 1;
        (0..self.len()).map(move |i| self.step_nm() * if i == 0 || i == last { 0.5 } else { 1.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_the_range() {
        for shape in [SpectralShape::VISIBLE, SpectralShape::new(400, 1000, 5).unwrap()] {
            let sum: f64 = shape.trapezoid_weights_nm().sum();
            assert!((sum - (shape.last_nm() - shape.first_nm())).abs() < 1e-9);
        }
    }

    #[test]
    fn bad_shapes_are_refused() {
        for (first, last, step) in [(780, 380, 1), (380, 380, 1), (380, 780, 0), (380, 780, 3)] {
            assert!(SpectralShape::new(first, last, step).is_err(), "{first} {last} {step}");
        }
    }
}
