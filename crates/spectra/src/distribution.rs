use std::marker::PhantomData;

use crate::error::{Error, ErrorKind};
use crate::linear::linear_at;
use crate::shape::SpectralShape;

/// What the numbers of a [`SpectralDistribution`] mean, and which are allowed. Implemented by the markers in [`quantity`].
///
/// ```
/// use onelight_spectra::{Quantity, quantity::Reflectance};
/// assert!(Reflectance::allows(0.5) && !Reflectance::allows(1.5));
/// assert_eq!(Reflectance::ALLOWED, "0 to 1");
/// ```
pub trait Quantity: Copy + private::Sealed {
    /// Name of the quantity in messages, such as `radiant power`.
    const NAME: &'static str;
    /// The values allowed, in words.
    const ALLOWED: &'static str;
    /// Whether a distribution of this quantity may hold `value`.
    fn allows(value: f64) -> bool;
}

mod private {
    pub trait Sealed {}
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident: $text:literal, $allowed:literal, $test:expr;)*) => {
        /// The meanings a [`SpectralDistribution`] can have.
        ///
        /// ```
        /// use onelight_spectra::{SpectralDistribution, SpectralShape, quantity::Reflectance};
        /// let error = SpectralDistribution::<Reflectance>::from_fn(SpectralShape::VISIBLE, |nm| nm / 779.0).unwrap_err();
        /// assert!(error.to_string().ends_with("expected 0 to 1"));
        /// ```
        pub mod quantity {
            $($(#[$doc])* #[derive(Debug, Clone, Copy, PartialEq, Eq)] pub enum $name {})*
        }
        $(impl private::Sealed for quantity::$name {}
        impl Quantity for quantity::$name {
            const NAME: &'static str = $text;
            const ALLOWED: &'static str = $allowed;
            fn allows(value: f64) -> bool { let test: fn(f64) -> bool = $test; test(value) }
        })*
    };
}

quantities! {
    /// Radiant power per nm: W/nm, W/(m^2 nm), W/(m^2 sr nm) or relative to the value at 560 nm.
    Power: "radiant power", "a finite value >= 0", |v| v.is_finite() && v >= 0.0;
    /// As [`Power`], but a value may be negative: a difference of two lights, or what a linear formula gives for a colour that
    /// no light has.
    SignedPower: "signed radiant power", "a finite value", |v| v.is_finite();
    /// Fraction of light reflected, 0 to 1.
    Reflectance: "reflectance", "0 to 1", |v| (0.0..=1.0).contains(&v);
    /// Fraction of light transmitted, 0 to 1 (a density a little below 0 may lift it above 1).
    Transmittance: "transmittance", "a finite value >= 0", |v| v.is_finite() && v >= 0.0;
    /// Optical density: -log10 of a transmittance; within 300 of 0, so that the transmittance is a finite number.
    OpticalDensity: "optical density", "-300 to 300", |v| v.abs() <= MAX_DENSITY;
    /// Response of a receiver (eye, emulsion, densitometer) per unit of power.
    Responsivity: "responsivity", "a finite value >= 0", |v| v.is_finite() && v >= 0.0;
}

/// What a receiver answers to: light, or a difference of lights.
///
/// ```
/// use onelight_spectra::{Light, SpectralDistribution, SpectralShape, quantity::{Responsivity, SignedPower}};
/// fn seen<L: Light>(light: &SpectralDistribution<L>) -> Result<f64, onelight_spectra::Error> {
///     Ok(light.response(&SpectralDistribution::<Responsivity>::from_fn(light.shape(), |_nm| 1.0)?))
/// }
/// let difference = SpectralDistribution::<SignedPower>::from_fn(SpectralShape::VISIBLE, |nm| nm - 580.0)?;
/// assert!(seen(&difference)?.abs() < 1e-9);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
pub trait Light: Quantity {}
impl Light for quantity::Power {}
impl Light for quantity::SignedPower {}

/// The largest optical density, positive or negative.
const MAX_DENSITY: f64 = 300.0;

/// A quantity over wavelength on a uniform grid, checked when made and infallible afterwards.
///
/// ```
/// use onelight_spectra::{SpectralDistribution, SpectralShape, quantity::OpticalDensity};
/// let glass = SpectralDistribution::<OpticalDensity>::from_fn(SpectralShape::VISIBLE, |_nm| 0.3)?;
/// assert!((glass.transmittance().values()[0] - 0.501187).abs() < 1e-6);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralDistribution<Q> {
    shape: SpectralShape,
    values: Vec<f64>,
    quantity: PhantomData<Q>,
}

impl<Q: Quantity> SpectralDistribution<Q> {
    /// One value per wavelength of `shape`.
    ///
    /// # Errors
    /// If the count is not `shape.len()` or a value is not allowed for `Q`.
    pub fn new(shape: SpectralShape, values: Vec<f64>) -> Result<Self, Error> {
        if values.len() != shape.len() {
            return Err(ErrorKind::Length { quantity: Q::NAME, found: values.len(), expected: shape.len() }.into());
        }
        for (nm, &found) in shape.wavelengths_nm().zip(&values) {
            if !Q::allows(found) {
                return Err(ErrorKind::Value { quantity: Q::NAME, nm, found, expected: Q::ALLOWED }.into());
            }
        }
        Ok(Self::trusted(shape, values))
    }

    /// The values that `f` has at each wavelength of the grid, which it gets in nm.
    ///
    /// # Errors
    /// If a value is not allowed for `Q`.
    pub fn from_fn(shape: SpectralShape, f: impl FnMut(f64) -> f64) -> Result<Self, Error> {
        Self::new(shape, shape.wavelengths_nm().map(f).collect())
    }

    /// For values that the arithmetic of this crate keeps allowed.
    pub(crate) fn trusted(shape: SpectralShape, values: Vec<f64>) -> Self {
        Self { shape, values, quantity: PhantomData }
    }

    /// The wavelengths that the values belong to.
    #[must_use]
    pub fn shape(&self) -> SpectralShape {
        self.shape
    }

    /// The values, one for each wavelength of [`SpectralDistribution::shape`], in order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Wavelength in nm and value, in order.
    pub fn iter(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.shape.wavelengths_nm().zip(self.values.iter().copied())
    }

    /// The value at `wavelength_nm`, linear between grid points, `None` outside the grid.
    #[must_use]
    pub fn at(&self, wavelength_nm: f64) -> Option<f64> {
        let Self { shape, values, .. } = self;
        linear_at(|i| shape.first_nm() + i as f64 * shape.step_nm(), values, wavelength_nm)
    }

    /// Integral over the grid by the trapezoid rule: the unit of the values times nm.
    #[must_use]
    pub fn integral(&self) -> f64 {
        self.shape.trapezoid_weights_nm().zip(&self.values).map(|(w, v)| w * v).sum()
    }

    /// Both on one grid, value by value.
    ///
    /// # Panics
    /// If the grids differ: a mistake of the program, never of its input.
    fn zip<R: Quantity, S: Quantity>(
        &self,
        other: &SpectralDistribution<R>,
        f: impl Fn(f64, f64) -> f64,
    ) -> SpectralDistribution<S> {
        assert_eq!(self.shape, other.shape, "{} and {} are on different grids", Q::NAME, R::NAME);
        let values = self.values.iter().zip(&other.values).map(|(a, b)| f(*a, *b)).collect();
        SpectralDistribution::trusted(self.shape, values)
    }
}

impl<L: Light> SpectralDistribution<L> {
    /// What a receiver makes of this light: the integral of power times responsivity over nm. Both must share one grid.
    ///
    /// # Panics
    /// If the two distributions are on different grids.
    #[must_use]
    pub fn response(&self, receiver: &SpectralDistribution<quantity::Responsivity>) -> f64 {
        self.zip::<_, quantity::SignedPower>(receiver, |a, b| a * b).integral()
    }
}

impl From<SpectralDistribution<quantity::Power>> for SpectralDistribution<quantity::SignedPower> {
    fn from(light: SpectralDistribution<quantity::Power>) -> Self {
        Self::trusted(light.shape, light.values)
    }
}

/// Fails if a value is negative: then it is not the power of a light.
impl TryFrom<SpectralDistribution<quantity::SignedPower>> for SpectralDistribution<quantity::Power> {
    type Error = Error;

    fn try_from(light: SpectralDistribution<quantity::SignedPower>) -> Result<Self, Error> {
        Self::new(light.shape, light.values)
    }
}

impl SpectralDistribution<quantity::Power> {
    /// The light behind a filter. Both must share one grid.
    ///
    /// # Panics
    /// If the two distributions are on different grids.
    #[must_use]
    pub fn through(&self, filter: &SpectralDistribution<quantity::Transmittance>) -> Self {
        self.zip(filter, |a, b| (a * b).min(f64::MAX))
    }

    /// The light reflected by a surface. Both must share one grid.
    ///
    /// # Panics
    /// If the two distributions are on different grids.
    #[must_use]
    pub fn reflected_by(&self, surface: &SpectralDistribution<quantity::Reflectance>) -> Self {
        self.zip(surface, |a, b| a * b)
    }

    /// The same light `factor` times as strong. A factor below 0 or NaN counts as 0, and no value becomes infinite.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let factor = if factor > 0.0 { factor.min(f64::MAX) } else { 0.0 };
        Self::trusted(self.shape, self.values.iter().map(|v| (v * factor).min(f64::MAX)).collect())
    }
}

impl SpectralDistribution<quantity::OpticalDensity> {
    /// 10 to the power of minus the density.
    #[must_use]
    pub fn transmittance(&self) -> SpectralDistribution<quantity::Transmittance> {
        SpectralDistribution::trusted(self.shape, self.values.iter().map(|d| 10f64.powf(-d)).collect())
    }

    /// Two layers on one another: densities add, and are held within 300 of 0. Both must share one grid.
    ///
    /// # Panics
    /// If the two distributions are on different grids.
    #[must_use]
    pub fn stacked_on(&self, other: &Self) -> Self {
        self.zip(other, |a, b| held(a + b))
    }

    /// The density of `amount` times as much of the same dye, held within 300 of 0; a NaN amount counts as 0.
    #[must_use]
    pub fn scaled(&self, amount: f64) -> Self {
        let amount = if amount.is_nan() { 0.0 } else { amount.clamp(f64::MIN, f64::MAX) };
        Self::trusted(self.shape, self.values.iter().map(|v| held(v * amount)).collect())
    }
}

fn held(density: f64) -> f64 {
    density.clamp(-MAX_DENSITY, MAX_DENSITY)
}

#[cfg(test)]
mod tests {
    use super::quantity::{OpticalDensity, Power, Reflectance, SignedPower, Transmittance};
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn transmittance_of_summed_densities_is_the_product() {
        let shape = SpectralShape::VISIBLE;
        let a = SpectralDistribution::<OpticalDensity>::from_fn(shape, |nm| nm / 500.0).unwrap();
        let b = SpectralDistribution::<OpticalDensity>::from_fn(shape, |nm| 3.0 - nm / 300.0).unwrap();
        let both = a.stacked_on(&b).transmittance();
        for i in 0..shape.len() {
            let product = a.transmittance().values()[i] * b.transmittance().values()[i];
            assert_relative_eq!(both.values()[i], product, max_relative = 1e-13);
        }
    }

    #[test]
    fn a_difference_of_lights_is_a_light_where_nothing_is_negative() {
        let shape = SpectralShape::VISIBLE;
        let signed = |from: f64| SpectralDistribution::<SignedPower>::from_fn(shape, |nm| nm - from).unwrap();
        let light = SpectralDistribution::<Power>::try_from(signed(380.0)).unwrap();
        assert_eq!(SpectralDistribution::<SignedPower>::from(light), signed(380.0));
        let error = SpectralDistribution::<Power>::try_from(signed(400.0)).unwrap_err();
        assert_eq!(error.to_string(), "radiant power at 380 nm: found -20, expected a finite value >= 0");
        assert!(SpectralDistribution::<SignedPower>::from_fn(shape, |_| f64::INFINITY).is_err());
        let eye = SpectralDistribution::from_fn(shape, |_| 1.0).unwrap();
        assert!((signed(580.0).response(&eye)).abs() < 1e-9);
    }

    #[test]
    fn values_that_a_quantity_does_not_allow_are_refused() {
        let shape = SpectralShape::VISIBLE;
        assert!(SpectralDistribution::<Power>::new(shape, vec![1.0; 400]).is_err());
        assert!(SpectralDistribution::<Power>::from_fn(shape, |nm| if nm == 500.0 { f64::NAN } else { 1.0 }).is_err());
        let error = SpectralDistribution::<Reflectance>::from_fn(shape, |nm| nm / 700.0).unwrap_err();
        assert_eq!(error.to_string(), "reflectance at 701 nm: found 1.0014285714285713, expected 0 to 1");
    }

    #[test]
    fn arithmetic_keeps_values_that_are_allowed() {
        let shape = SpectralShape::VISIBLE;
        let density = |d: f64| SpectralDistribution::<OpticalDensity>::from_fn(shape, |_| d);
        for d in [300.1, -300.1, f64::NAN, f64::INFINITY] {
            let error = density(d).unwrap_err().to_string();
            assert!(error.ends_with(&format!("found {d}, expected -300 to 300")), "{error}");
        }
        for d in [300.0, -300.0, 0.0, 1.0] {
            let film = density(d).unwrap();
            for made in
                [film.stacked_on(&film), film.scaled(f64::MAX), film.scaled(f64::NEG_INFINITY), film.scaled(f64::NAN)]
            {
                assert!(made.values().iter().all(|v| OpticalDensity::allows(*v)), "{d}");
                assert!(made.transmittance().values().iter().all(|v| Transmittance::allows(*v)), "{d}");
            }
        }
        let light = SpectralDistribution::<Power>::from_fn(shape, |nm| if nm < 500.0 { 0.0 } else { 1e300 }).unwrap();
        let clear = density(-300.0).unwrap().transmittance();
        assert!(light.through(&clear).values().iter().all(|v| Power::allows(*v)));
        for factor in [-1.0, f64::NAN, f64::INFINITY, f64::MAX] {
            assert!(light.scaled(factor).values().iter().all(|v| Power::allows(*v)), "{factor}");
        }
        assert_eq!(light.scaled(-1.0).integral(), 0.0);
    }

    #[test]
    fn value_between_grid_points_is_linear() {
        let ramp = SpectralDistribution::<Power>::from_fn(SpectralShape::VISIBLE, |nm| nm).unwrap();
        assert_relative_eq!(ramp.at(500.25).unwrap(), 500.25);
        assert_relative_eq!(ramp.at(780.0).unwrap(), 780.0);
        assert_eq!(ramp.at(379.9), None);
    }
}
