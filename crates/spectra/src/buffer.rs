use crate::transfer::TransferCurve;

/// A frame buffer of low precision: what a picture becomes by being stored in it.
///
/// Values are rounded to the nearest the format holds, halfway cases to the even code (some GPUs cut off instead). NaN
/// becomes 0, what is over the largest value becomes the largest, infinity too; formats without a sign make 0 of
/// negative values. Scale the light before, so that the scene fits the format.
///
/// ```
/// use onelight_spectra::BufferFormat;
/// assert_eq!(BufferFormat::Float7e3.quantise([0.18, -1.0, 100.0]), [0.1796875, 0.0, 31.875]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BufferFormat {
    /// Linear light in 0..1, 8 bits a channel.
    Unorm8,
    /// Light in 0..1, coded with the curve of sRGB (\[IEC61966-2-1\]), 8 bits a channel.
    Unorm8Srgb,
    /// "float10": 7 bits of mantissa, 3 of exponent with a bias of 3, no sign, no infinity, denormals; at most 31.875.
    Float7e3,
    /// Floats without a sign, 6, 6 and 5 bits of mantissa, 5 of exponent with a bias of 15, denormals.
    R11G11B10,
    /// IEEE 754 binary16; at most 65504 either side of 0.
    Half,
}

impl BufferFormat {
    /// The five formats, from the fewest bits to the most.
    pub const ALL: [Self; 5] = [Self::Unorm8, Self::Unorm8Srgb, Self::Float7e3, Self::R11G11B10, Self::Half];

    /// Its name as graphics programs write it, such as `unorm8-srgb`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unorm8 => "unorm8",
            Self::Unorm8Srgb => "unorm8-srgb",
            Self::Float7e3 => "float7e3",
            Self::R11G11B10 => "r11g11b10",
            Self::Half => "half",
        }
    }

    /// The largest linear value of red, green and blue.
    #[must_use]
    pub fn max(self) -> [f64; 3] {
        match self.floats() {
            Some(channels) => channels.map(|float| float.max),
            None => [1.0; 3],
        }
    }

    /// Linear RGB as it comes back, linear, from a buffer of this format.
    #[must_use]
    pub fn quantise(self, linear: [f64; 3]) -> [f64; 3] {
        let clean = linear.map(|v| match self {
            _ if v.is_nan() => 0.0,
            Self::Half => v,
            // Not max(): it may let -0.0 through.
            _ if v <= 0.0 => 0.0,
            _ => v,
        });
        match (self, self.floats()) {
            (_, Some([red, green, blue])) => [red.round(clean[0]), green.round(clean[1]), blue.round(clean[2])],
            (Self::Unorm8Srgb, _) => {
                clean.map(|v| TransferCurve::Srgb.decode(round_unorm8(TransferCurve::Srgb.encode(v))))
            }
            _ => clean.map(round_unorm8),
        }
    }

    /// The float formats of the channels, if floats they are.
    const fn floats(self) -> Option<[SmallFloat; 3]> {
        match self {
            Self::Unorm8 | Self::Unorm8Srgb => None,
            Self::Float7e3 => Some([SmallFloat { mantissa_bits: 7, least_exponent: -2, max: 31.875 }; 3]),
            Self::R11G11B10 => {
                let eleven = SmallFloat { mantissa_bits: 6, least_exponent: -14, max: 65024.0 };
                Some([eleven, eleven, SmallFloat { mantissa_bits: 5, least_exponent: -14, max: 64512.0 }])
            }
            Self::Half => Some([SmallFloat { mantissa_bits: 10, least_exponent: -14, max: 65504.0 }; 3]),
        }
    }
}

/// A binary float with denormals.
#[derive(Clone, Copy)]
struct SmallFloat {
    mantissa_bits: i32,
    /// Exponent of the smallest normal number; denormals share its step.
    least_exponent: i32,
    max: f64,
}

impl SmallFloat {
    /// The nearest number of the format, halfway cases to the even mantissa, never over `max`.
    fn round(self, value: f64) -> f64 {
        let magnitude = value.abs().min(self.max);
        // The biased exponent of a double; that of its own denormals is far below any format's here.
        let exponent = (magnitude.to_bits() >> 52) as i32 - 1023;
        let step = 2_f64.powi(exponent.max(self.least_exponent) - self.mantissa_bits);
        ((magnitude / step).round_ties_even() * step).copysign(value)
    }
}

fn round_unorm8(value: f64) -> f64 {
    (value.clamp(0.0, 1.0) * 255.0).round_ties_even() / 255.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use half::f16;

    /// The value of each finite code of a float without sign, in order, from the definition of the format.
    fn values(mantissa_bits: u32, bias: i32, finite_codes: u32) -> Vec<f64> {
        let scale = 2_f64.powi(mantissa_bits as i32);
        let value = |code: u32| {
            let (exponent, mantissa) = (code >> mantissa_bits, code & ((1 << mantissa_bits) - 1));
            let fraction = f64::from(mantissa) / scale;
            match exponent {
                0 => fraction * 2_f64.powi(1 - bias),
                _ => (1.0 + fraction) * 2_f64.powi(exponent as i32 - bias),
            }
        };
        (0..finite_codes).map(value).collect()
    }

    /// Format, channel, and every value that is not negative, in order of code.
    fn tables() -> Vec<(BufferFormat, usize, Vec<f64>)> {
        let unorm: Vec<f64> = (0..=255).map(|code| f64::from(code) / 255.0).collect();
        let srgb = unorm.iter().map(|v| TransferCurve::Srgb.decode(*v)).collect();
        vec![
            (BufferFormat::Unorm8, 1, unorm),
            (BufferFormat::Unorm8Srgb, 2, srgb),
            (BufferFormat::Float7e3, 0, values(7, 3, 1024)),
            (BufferFormat::R11G11B10, 0, values(6, 15, 31 << 6)),
            (BufferFormat::R11G11B10, 1, values(6, 15, 31 << 6)),
            (BufferFormat::R11G11B10, 2, values(5, 15, 31 << 5)),
            (BufferFormat::Half, 0, values(10, 15, 31 << 10)),
        ]
    }

    #[test]
    fn every_code_comes_back_and_the_last_is_the_largest() {
        for (format, channel, values) in tables() {
            for v in &values {
                assert_eq!(format.quantise([*v; 3])[channel], *v, "{format:?}");
            }
            assert_eq!(values.last(), Some(&format.max()[channel]), "{format:?}");
        }
    }

    #[test]
    fn between_two_codes_the_nearer_and_halfway_the_even() {
        for (format, channel, values) in tables() {
            let quantise = |v: f64| format.quantise([v; 3])[channel];
            for (code, pair) in values.windows(2).enumerate() {
                let (low, high) = (pair[0], pair[1]);
                let middle = match format {
                    // Nearest in code, not in light.
                    BufferFormat::Unorm8Srgb => TransferCurve::Srgb.decode((code as f64 + 0.5) / 255.0),
                    _ => 0.5 * (low + high),
                };
                assert_eq!(quantise(middle - 1e-6 * (high - low)), low, "{format:?} under {middle}");
                assert_eq!(quantise(middle + 1e-6 * (high - low)), high, "{format:?} over {middle}");
                // The middles of the unorm formats are not doubles.
                if format.floats().is_some() {
                    let even = if code % 2 == 0 { low } else { high };
                    assert_eq!(quantise(middle), even, "{format:?} at {middle}");
                }
            }
        }
    }

    #[test]
    fn half_agrees_with_the_half_crate() {
        // Every sixteenth of a step of every half, and its negative; beyond the last the crate has infinity.
        for code in 0..=f16::MAX.to_bits() {
            let (low, high) = (f16::from_bits(code), f16::from_bits(code + 1));
            let step = if high.is_finite() { f64::from(high) - f64::from(low) } else { 15.0 };
            for part in 0..16 {
                for sign in [1.0, -1.0] {
                    let v = sign * (f64::from(low) + f64::from(part) / 16.0 * step);
                    // Exact in f32, so that the crate rounds once.
                    assert_eq!(f64::from(v as f32), v);
                    let expected = f64::from(f16::from_f32(v as f32));
                    assert_eq!(BufferFormat::Half.quantise([v; 3]), [expected; 3], "{v}");
                }
            }
        }
    }

    #[test]
    fn hard_values() {
        for format in BufferFormat::ALL {
            assert_eq!(format.quantise([f64::NAN; 3]), [0.0; 3]);
            for v in [f64::INFINITY, f64::MAX, 65520.0] {
                assert_eq!(format.quantise([v; 3]), format.max(), "{format:?}");
            }
            let negative = if format == BufferFormat::Half { format.max().map(|v| -v) } else { [0.0; 3] };
            assert_eq!(format.quantise([f64::NEG_INFINITY; 3]), negative);
            assert_eq!(format.quantise([-1e9; 3]), negative);
            let nothing = format.quantise([f64::from_bits(1); 3]);
            assert_eq!(nothing, [0.0; 3]);
            if format != BufferFormat::Half {
                assert!(format.quantise([-0.0; 3]).iter().all(|v| v.is_sign_positive()), "{format:?}");
            }
        }
    }
}
