//! What the picture passes before and after the effects on dye: given from outside.

/// Exposure to dye: the curves of the camera film, with whatever couples its layers pixel by pixel.
///
/// Any closure of one pixel is one:
///
/// ```
/// use onelight_spatial::Development;
/// let curve = |exposure: [f32; 3]| exposure.map(|e| e / (e + 0.2));
/// let (mut red, mut green, mut blue) = ([0.2], [0.6], [0.0]);
/// curve.develop([&mut red, &mut green, &mut blue]);
/// assert_eq!((red, green, blue), ([0.5], [0.75], [0.0]));
/// ```
pub trait Development: Sync {
    /// Turns the exposure of the three layers, red, green and blue, into amounts of dye, in place. Exposures are between 0 and 1e30.
    ///
    /// Each pixel's result must depend on that pixel alone: rows are handed over in pieces.
    fn develop(&self, layers: [&mut [f32]; 3]);
}

impl<F: Fn([f32; 3]) -> [f32; 3] + Sync> Development for F {
    fn develop(&self, [red, green, blue]: [&mut [f32]; 3]) {
        for ((red, green), blue) in red.iter_mut().zip(green).zip(blue) {
            [*red, *green, *blue] = self([*red, *green, *blue]);
        }
    }
}

/// Dye in the camera film to what is seen, and how differences are seen: for what must be known of the picture's end, the mean of grain and
/// whether an effect is visible.
pub trait Finish: Sync {
    /// Display-linear RGB that the film with these amounts of dye makes, printed and projected as the case may be. May be negative or above 1.
    /// Amounts may be slightly below 0.
    fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3];

    /// The same of many amounts: what maps whole rows faster than single pixels says how.
    fn display_linear_of(&self, amounts: &[[f64; 3]]) -> Vec<[f64; 3]> {
        amounts.iter().map(|amounts| self.display_linear(*amounts)).collect()
    }

    /// CIELAB of display-linear RGB.
    fn lab(&self, display_linear: [f64; 3]) -> [f64; 3];

    /// The difference of two display-linear colours, CIEDE2000.
    fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64;
}
