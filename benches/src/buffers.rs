//! What low-precision frame buffers between scene and film cost: the largest visible step on a grey ramp.

use onelight::spectra::{BufferFormat, MID_GREY};
use onelight::{DisplayLinear, Look};

use crate::error::Result;

/// A buffer and the level that mid grey is stored at.
pub struct Case {
    /// The buffer, and the value that a light is stored at.
    pub name: &'static str,
    format: BufferFormat,
    /// Stored value over scene value.
    scale: f64,
}

impl Case {
    /// Scene light as it comes back from the buffer.
    pub fn stored(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.format.quantise(rgb.map(|v| v * self.scale)).map(|v| v / self.scale)
    }
}

/// The buffers that are compared: as they are, and with the talk's scale factor for the small float.
pub const CASES: [Case; 7] = [
    Case { name: "8 bit linear, white at 4", format: BufferFormat::Unorm8, scale: 0.25 },
    Case { name: "8 bit sRGB-coded, white at 4", format: BufferFormat::Unorm8Srgb, scale: 0.25 },
    Case { name: "float 7e3, grey at 0.18", format: BufferFormat::Float7e3, scale: 1.0 },
    Case { name: "float 7e3, grey at 0.72", format: BufferFormat::Float7e3, scale: 4.0 },
    Case { name: "R11G11B10, grey at 0.18", format: BufferFormat::R11G11B10, scale: 1.0 },
    Case { name: "R11G11B10, grey at 0.72", format: BufferFormat::R11G11B10, scale: 4.0 },
    Case { name: "half", format: BufferFormat::Half, scale: 1.0 },
];

/// Greys of the ramp: from -8 to +4 stops about mid grey, in thousandths of a stop.
const RAMP_STOPS: (f64, f64) = (-8.0, 4.0);
const RAMP_STEPS: u32 = 12_000;

/// Largest CIEDE2000 between neighbours on a grey ramp from -8 to +4 stops after the buffer and the film.
///
/// # Errors
/// If the look's display has no white.
pub fn largest_step(case: &Case, film: &Look) -> Result<f64> {
    let difference = film.difference()?;
    let (mut largest, mut last) = (0f64, None::<([f64; 3], DisplayLinear)>);
    for i in 0..=RAMP_STEPS {
        let stops = RAMP_STOPS.0 + (RAMP_STOPS.1 - RAMP_STOPS.0) * f64::from(i) / f64::from(RAMP_STEPS);
        let stored = case.stored([MID_GREY * stops.exp2(); 3]);
        if last.is_some_and(|(value, _)| value == stored) {
            continue;
        }
        let shown = film.develop_linear(stored);
        if let Some((_, before)) = last {
            largest = largest.max(difference.between(before, shown));
        }
        last = Some((stored, shown));
    }
    Ok(largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_factor_buys_what_the_talk_says() {
        let film = onelight::Process::default().look().unwrap();
        let step = |name: &str| {
            let case = CASES.iter().find(|case| case.name == name).unwrap();
            largest_step(case, &film).unwrap()
        };
        // Measured with the model: 5.6, 0.8, 0.22, 0.06.
        assert!((4.0..7.0).contains(&step("8 bit linear, white at 4")), "{}", step("8 bit linear, white at 4"));
        let (small, scaled) = (step("float 7e3, grey at 0.18"), step("float 7e3, grey at 0.72"));
        assert!((0.6..1.0).contains(&small) && (0.15..0.3).contains(&scaled), "{small} {scaled}");
        assert!(step("half") < 0.1);
    }
}
