use std::f64::consts::PI;

use crate::constant::{POLYESTER_INDEX, POLYESTER_THICKNESS, TRIACETATE_INDEX, TRIACETATE_THICKNESS};

/// Intervals of the means over directions.
const INTERVALS: usize = 20_000;

/// What the emulsion is coated on.
///
/// ```
/// use onelight_spatial::FilmBase;
/// assert!(FilmBase::Polyester.index() > FilmBase::Triacetate.index());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FilmBase {
    /// Triacetate: camera films.
    #[default]
    Triacetate,
    /// Polyester (ESTAR): print films and some intermediates.
    Polyester,
}

impl FilmBase {
    /// Thickness in um.
    #[must_use]
    pub fn thickness_um(self) -> f64 {
        match self {
            Self::Triacetate => TRIACETATE_THICKNESS.value,
            Self::Polyester => POLYESTER_THICKNESS.value,
        }
    }

    /// Refractive index.
    #[must_use]
    pub fn index(self) -> f64 {
        match self {
            Self::Triacetate => TRIACETATE_INDEX.value,
            Self::Polyester => POLYESTER_INDEX.value,
        }
    }
}

/// Light that scatters through the emulsion into the base and returns from its back, by distance from where it fell.
///
/// `H(r) = R(theta) c^4 / (pi h^2) 10^(-2 D / c)`: light of a diffuse source (Lambert) goes at angle theta to the back, h = twice the
/// thickness, c = cos theta = h / sqrt(h^2 + r^2), is reflected there as Fresnel's equations say, completely beyond the critical angle, and
/// passes an antihalation layer of density D twice at that angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PointSpread {
    /// Twice the thickness of the base, in um.
    path_um: f64,
    index: f64,
    density: f64,
}

impl PointSpread {
    pub(crate) fn new(base: FilmBase, density: f64) -> Self {
        Self { path_um: 2.0 * base.thickness_um(), index: base.index(), density }
    }

    pub(crate) fn path_um(&self) -> f64 {
        self.path_um
    }

    /// Radius from which on reflection is total: the ring's, in um.
    pub(crate) fn ring_um(&self) -> f64 {
        self.path_um / (self.index * self.index - 1.0).sqrt()
    }

    /// Returned light in 1/um^2, for 1 unit of light at the origin.
    #[cfg(test)]
    pub(crate) fn at(&self, r_um: f64) -> f64 {
        self.reflected(r_um) * self.smooth(r_um)
    }

    /// As if all were reflected at the back.
    pub(crate) fn smooth(&self, r_um: f64) -> f64 {
        let c = self.cosine(r_um);
        c.powi(4) / (PI * self.path_um * self.path_um) * 10f64.powf(-2.0 * self.density / c)
    }

    /// What is lost through the back: nothing outside the ring.
    pub(crate) fn lost(&self, r_um: f64) -> f64 {
        (1.0 - self.reflected(r_um)) * self.smooth(r_um)
    }

    /// All of the light that returns, as a share.
    pub(crate) fn returned(&self) -> f64 {
        self.mean(|c| self.fresnel(c))
    }

    /// As if all were reflected at the back.
    pub(crate) fn smooth_returned(&self) -> f64 {
        self.mean(|_| 1.0)
    }

    /// The mean over u = c^2, in which the light of a diffuse source is uniform. In steps of c, so that no density makes a step matter.
    fn mean(&self, share: impl Fn(f64) -> f64) -> f64 {
        let at = |i: usize| {
            let c = (i as f64 + 0.5) / INTERVALS as f64;
            2.0 * c * share(c) * 10f64.powf(-2.0 * self.density / c)
        };
        (0..INTERVALS).map(at).sum::<f64>() / INTERVALS as f64
    }

    fn cosine(&self, r_um: f64) -> f64 {
        self.path_um / self.path_um.hypot(r_um)
    }

    fn reflected(&self, r_um: f64) -> f64 {
        self.fresnel(self.cosine(r_um))
    }

    /// Share of unpolarised light reflected from base to air, by the cosine in the base.
    fn fresnel(&self, cosine: f64) -> f64 {
        let outside = 1.0 - self.index * self.index * (1.0 - cosine * cosine);
        if outside <= 0.0 {
            return 1.0;
        }
        let (n, out) = (self.index, outside.sqrt());
        let s = (n * cosine - out) / (n * cosine + out);
        let p = (cosine - n * out) / (cosine + n * out);
        0.5 * (s * s + p * p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reference() -> serde_json::Value {
        serde_json::from_str(include_str!("../../tests/reference.json")).unwrap()
    }

    #[test]
    fn ring_and_energy_of_an_independent_implementation() {
        let geometry = &reference()["halation_geometry"];
        for (name, base) in
            [("acetate 135 um n 1.48", FilmBase::Triacetate), ("ESTAR 120 um n 1.64", FilmBase::Polyester)]
        {
            let ring = geometry[name]["ring_um"].as_f64().unwrap();
            assert!((PointSpread::new(base, 0.0).ring_um() / ring - 1.0).abs() < 1e-5);
            for (density, returned) in geometry[name]["returned"].as_object().unwrap() {
                let found = PointSpread::new(base, density.parse().unwrap()).returned();
                assert!((found / returned.as_f64().unwrap() - 1.0).abs() < 2e-4, "{name} {density}: {found}");
            }
        }
    }

    #[test]
    fn profile_of_an_independent_implementation() {
        for (name, value) in reference()["halation_psf"].as_object().unwrap() {
            let (r, d) = name.split_once(' ').unwrap();
            let number = |text: &str| text.split_once('=').unwrap().1.parse::<f64>().unwrap();
            let found = PointSpread::new(FilmBase::Triacetate, number(d)).at(number(r));
            assert!((found / value.as_f64().unwrap() - 1.0).abs() < 1e-4, "{name}: {found}");
        }
    }

    #[test]
    fn the_profile_holds_the_returned_energy() {
        for density in [0.0, 0.8] {
            let spread = PointSpread::new(FilmBase::Triacetate, density);
            let ring = 2.0 * PI * 0.5;
            let energy: f64 = (0..200_000).map(|i| (f64::from(i) + 0.5) * 0.5).map(|r| ring * r * spread.at(r)).sum();
            assert!((energy / spread.returned() - 1.0).abs() < 1e-4, "{density}: {energy}");
        }
    }
}
