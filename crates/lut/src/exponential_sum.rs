use crate::error::{Error, ErrorKind};
use crate::number::Number;
use crate::scene_light::check_rows;

/// Three sums of exponentials over three variables: `out[j] = sum over terms of weight[j] 2^-(rate . x)`.
///
/// ```
/// use onelight_lut::{ExponentialSum, ExponentialTerm};
/// // A grey filter that halves the light for each unit of the first variable.
/// let filter = ExponentialSum::new(vec![ExponentialTerm { rate: [1.0, 0.0, 0.0], weight: [1.0, 0.8, 0.6] }])?;
/// assert!((filter.apply([2.0, 9.0, 9.0])[1] - 0.2).abs() < 1e-6);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ExponentialSum {
    terms: Vec<ExponentialTerm>,
}

/// One exponential of an [`ExponentialSum`]: for a film, its dyes' densities at one wavelength and the light found there.
///
/// ```
/// use onelight_lut::{ExponentialSum, ExponentialTerm};
/// let term = ExponentialTerm { rate: [1.0, 0.0, 0.0], weight: [0.5, 1.0, 1.0] };
/// assert_eq!(ExponentialSum::new(vec![term])?.apply([1.0, 9.0, 9.0])[0], 0.25);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialTerm {
    /// Halvings for each unit of the three variables.
    pub rate: [f32; 3],
    /// What it adds to each sum where the variables are 0; may be negative.
    pub weight: [f32; 3],
}

impl ExponentialSum {
    /// The most terms: the visible wavelengths and more, by 1 nm.
    pub const MAX_TERMS: usize = 1024;

    /// A sum of these terms.
    ///
    /// # Errors
    /// If there are none or more than [`ExponentialSum::MAX_TERMS`], or a number is not finite.
    pub fn new(terms: Vec<ExponentialTerm>) -> Result<Self, Error> {
        if terms.is_empty() || terms.len() > Self::MAX_TERMS {
            let (found, max) = (terms.len(), Self::MAX_TERMS);
            return Err(ErrorKind::Size { what: "sum of exponentials", found, min: 1, max }.into());
        }
        for term in &terms {
            check_rows("term of a sum of exponentials", &[term.rate, term.weight, [0.0; 3]])?;
        }
        Ok(Self { terms })
    }

    /// The terms, in the order given.
    pub fn terms(&self) -> &[ExponentialTerm] {
        &self.terms
    }

    /// Each sum times a number.
    pub(crate) fn scaled(&self, factors: [f32; 3]) -> Result<Self, Error> {
        let weight = |weight: [f32; 3]| std::array::from_fn(|j| factors[j] * weight[j]);
        Self::new(self.terms.iter().map(|term| ExponentialTerm { weight: weight(term.weight), ..*term }).collect())
    }

    /// The three sums at one place.
    #[inline]
    pub fn apply(&self, x: [f32; 3]) -> [f32; 3] {
        self.apply_in(x)
    }

    /// The one definition of [`ExponentialSum::apply`], for float32 and float64.
    #[inline]
    pub(crate) fn apply_in<N: Number>(&self, x: [N; 3]) -> [N; 3] {
        let mut sums = [N::ZERO; 3];
        for ExponentialTerm { rate, weight } in &self.terms {
            let power = (-(N::of(rate[0]) * x[0] + N::of(rate[1]) * x[1] + N::of(rate[2]) * x[2])).exp2();
            for (sum, weight) in sums.iter_mut().zip(weight) {
                *sum = *sum + N::of(*weight) * power;
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_checked() {
        assert!(ExponentialSum::new(Vec::new()).is_err());
        let term = |v| ExponentialTerm { rate: [v; 3], weight: [1.0; 3] };
        assert!(ExponentialSum::new(vec![term(1.0); ExponentialSum::MAX_TERMS + 1]).is_err());
        assert!(ExponentialSum::new(vec![term(f32::NAN)]).is_err());
    }
}
