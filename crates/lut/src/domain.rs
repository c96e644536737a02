use crate::error::{Error, ErrorKind};
use crate::number::Number;

/// The box of inputs that a table covers: per channel, the input of its first and of its last entry.
///
/// ```
/// use onelight_lut::Domain;
/// assert_eq!(Domain::common(-1.0, 3.0)?.as_common(), Some([-1.0, 3.0]));
/// assert!(Domain::new([0.0; 3], [1.0, 0.0, 1.0]).is_err());
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    min: [f32; 3],
    max: [f32; 3],
}

impl Domain {
    /// 0 to 1 in every channel.
    pub const UNIT: Self = Self { min: [0.0; 3], max: [1.0; 3] };

    /// A domain with its own ends per channel.
    ///
    /// # Errors
    ///
    /// If an end or the distance between two ends is not finite, or a maximum is not above its minimum.
    pub fn new(min: [f32; 3], max: [f32; 3]) -> Result<Self, Error> {
        let spans = min.iter().zip(&max).all(|(min, max)| {
            let span = max - min;
            min.is_finite() && max.is_finite() && span.is_finite() && span > 0.0
        });
        if spans { Ok(Self { min, max }) } else { Err(ErrorKind::Domain { min, max }.into()) }
    }

    /// A domain with the same ends in every channel.
    ///
    /// # Errors
    ///
    /// The same as those of [`Domain::new`].
    pub fn common(min: f32, max: f32) -> Result<Self, Error> {
        Self::new([min; 3], [max; 3])
    }

    /// The inputs of the first entries.
    pub fn min(&self) -> [f32; 3] {
        self.min
    }

    /// The inputs of the last entries.
    pub fn max(&self) -> [f32; 3] {
        self.max
    }

    /// The ends, where all channels share them.
    pub fn as_common(&self) -> Option<[f32; 2]> {
        let [min, max] = [self.min[0], self.max[0]];
        (self.min == [min; 3] && self.max == [max; 3]).then_some([min, max])
    }

    /// Where each channel of a colour lies in the domain: 0 at its minimum, 1 at its maximum.
    ///
    /// Inputs outside the domain give numbers outside 0 to 1, NaN gives NaN.
    ///
    /// ```
    /// let domain = onelight_lut::Domain::common(-1.0, 3.0)?;
    /// assert_eq!(domain.normalise([-1.0, 0.0, 5.0]), [0.0, 0.25, 1.5]);
    /// # Ok::<(), onelight_lut::Error>(())
    /// ```
    #[inline]
    pub fn normalise(&self, rgb: [f32; 3]) -> [f32; 3] {
        self.normalised(rgb)
    }

    /// The one definition of [`Domain::normalise`], for float32 and float64.
    #[inline]
    pub(crate) fn normalised<N: Number>(&self, rgb: [N; 3]) -> [N; 3] {
        std::array::from_fn(|c| {
            let (min, max) = (N::of(self.min[c]), N::of(self.max[c]));
            (rgb[c] - min) / (max - min)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_checked() {
        for (min, max) in
            [(0.0, 0.0), (1.0, 0.0), (f32::NAN, 1.0), (0.0, f32::NAN), (0.0, f32::INFINITY), (f32::MIN, f32::MAX)]
        {
            assert!(Domain::common(min, max).is_err(), "{min} to {max}");
        }
        assert!(Domain::new([0.0, 0.0, 2.0], [1.0, 1.0, 1.0]).is_err());
    }

    #[test]
    fn only_equal_ends_are_common() {
        assert_eq!(Domain::UNIT.as_common(), Some([0.0, 1.0]));
        let uneven = Domain::new([0.0; 3], [1.0, 1.0, 2.0]).unwrap();
        assert_eq!(uneven.as_common(), None);
    }
}
