//! The light of the values that integers are read as.

use std::sync::OnceLock;

use rayon::prelude::*;

/// The light of every code of 16 bits, among which are those of 8, from its first use on: a power for each sample takes longer than the
/// film does.
#[derive(Debug, Clone, Default)]
pub(crate) struct CodeLight(OnceLock<Vec<[f32; 3]>>);

impl CodeLight {
    /// How many codes there are: for fewer pixels each is quicker by itself.
    pub(crate) const COUNT: usize = 1 << 16;

    /// All of them by the light of colours, of which each channel is a function of that channel alone.
    pub(crate) fn made(&self, light: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> &[[f32; 3]] {
        self.0.get_or_init(|| (0..=u16::MAX).into_par_iter().map(|code| light([value(code); 3])).collect())
    }
}

/// What it holds follows from the coding that it stands beside.
impl PartialEq for CodeLight {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The light of a colour whose channels are values of codes, to the bit; none for any other.
pub(crate) fn looked_up(codes: &[[f32; 3]], rgb: [f32; 3]) -> Option<[f32; 3]> {
    let [red, green, blue] = rgb.map(|v| {
        let code = (v * f32::from(u16::MAX) + 0.5) as u16;
        (value(code).to_bits() == v.to_bits()).then_some(usize::from(code))
    });
    Some([codes.get(red?)?[0], codes.get(green?)?[1], codes.get(blue?)?[2]])
}

fn value(code: u16) -> f32 {
    f32::from(code) / f32::from(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_have_their_own_light_and_other_values_none() {
        let light = |rgb: [f32; 3]| [rgb[0].powf(2.2), rgb[1].sqrt(), -rgb[2]];
        let all = CodeLight::default();
        let codes = all.made(light);
        for code in 0..=u8::MAX {
            let rgb = [f32::from(code) / 255.0, value((257 * u16::from(code)).saturating_add(1)), 1.0];
            assert_eq!(looked_up(codes, rgb), Some(light(rgb)), "{rgb:?}");
        }
        for v in [f32::NAN, f32::INFINITY, -0.0, -0.25, 0.123_456_7, 1.000_1, 1e30] {
            assert_eq!(looked_up(codes, [v, 0.0, 0.0]), None, "{v}");
        }
    }
}
