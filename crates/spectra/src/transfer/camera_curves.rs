//! Curves of cameras that are no logarithm with a straight toe: mirrored, of three pieces, with a root or a square for a toe.

/// Canon gives light as a part of a reflectance of 90 % (\[CanonLog\]).
const CANON_WHITE: f64 = 0.9;

/// A logarithm of Canon's: code = step * log10(gain * light + 1) + offset.
#[derive(Clone, Copy)]
struct CanonCurve {
    step: f64,
    gain: f64,
    offset: f64,
}

impl CanonCurve {
    fn encode(self, light: f64) -> f64 {
        self.step * (self.gain * light + 1.0).log10() + self.offset
    }

    fn decode(self, coded: f64) -> f64 {
        (10_f64.powf((coded - self.offset) / self.step) - 1.0) / self.gain
    }
}

const C_LOG2: CanonCurve = CanonCurve { step: 0.241_360_77, gain: 87.099_375_46, offset: 0.092_864_125 };

/// Canon Log 2 (\[CanonLog\], version 1.2): below 0 the logarithm turned about the code of 0.
pub(super) fn c_log2_encode(linear: f64) -> f64 {
    let light = linear / CANON_WHITE;
    if light < 0.0 { 2.0 * C_LOG2.offset - C_LOG2.encode(-light) } else { C_LOG2.encode(light) }
}

pub(super) fn c_log2_decode(coded: f64) -> f64 {
    let below = coded < C_LOG2.offset;
    let light = if below { -C_LOG2.decode(2.0 * C_LOG2.offset - coded) } else { C_LOG2.decode(coded) };
    CANON_WHITE * light
}

const C_LOG3: CanonCurve = CanonCurve { step: 0.367_268_45, gain: 14.983_25, offset: 0.122_405_37 };
/// The line of Canon Log 3 between its two logarithms: half its length in light, the code of 0, and its slope, printed as 1.9754798, with
/// which the pieces miss each other by 2.6e-9.
const C_LOG3_END: f64 = 0.014;
const C_LOG3_ZERO: f64 = 0.125_122_19;
const C_LOG3_SLOPE: f64 = 1.975_479_983_117_230_7;

/// Canon Log 3 (\[CanonLog\], version 1.2): a line about 0, a logarithm above it and the same below.
pub(super) fn c_log3_encode(linear: f64) -> f64 {
    let light = linear / CANON_WHITE;
    if light.abs() <= C_LOG3_END {
        C_LOG3_SLOPE * light + C_LOG3_ZERO
    } else if light < 0.0 {
        2.0 * C_LOG3_ZERO - C_LOG3.encode(-light)
    } else {
        C_LOG3.encode(light)
    }
}

pub(super) fn c_log3_decode(coded: f64) -> f64 {
    let from_zero = coded - C_LOG3_ZERO;
    let light = if from_zero.abs() <= C_LOG3_SLOPE * C_LOG3_END {
        from_zero / C_LOG3_SLOPE
    } else if from_zero < 0.0 {
        -C_LOG3.decode(2.0 * C_LOG3_ZERO - coded)
    } else {
        C_LOG3.decode(coded)
    };
    CANON_WHITE * light
}

/// Where the cube root of N-Log ends, in light. Printed as 0.328, where the logarithm lies 1.3e-4 of code above the root; here both
/// are equal.
const N_LOG_END: f64 = 0.316_730_607_914_939_5;

/// Nikon N-Log (\[NikonNLog\]): a cube root, which goes on below its zero at -0.0075, and a logarithm.
pub(super) fn n_log_encode(linear: f64) -> f64 {
    let ten_bit = if linear <= N_LOG_END { 650.0 * (linear + 0.007_5).cbrt() } else { 150.0 * linear.ln() + 619.0 };
    ten_bit / 1023.0
}

pub(super) fn n_log_decode(coded: f64) -> f64 {
    let ten_bit = 1023.0 * coded;
    if coded <= n_log_encode(N_LOG_END) {
        (ten_bit / 650.0).powi(3) - 0.007_5
    } else {
        ((ten_bit - 619.0) / 150.0).exp()
    }
}

/// The light of Apple Log's code 0, the least that it holds.
pub(super) const APPLE_LOG_LEAST: f64 = -0.056_410_88;
const APPLE_LOG_END: f64 = 0.01;
/// Printed as 47.28711236, with which the pieces miss each other by 2.7e-9.
const APPLE_LOG_SQUARE: f64 = 47.287_112_983_171_08;

/// Apple Log (\[AppleLog\]): a parabola from code 0, and a logarithm.
pub(super) fn apple_log_encode(linear: f64) -> f64 {
    if linear <= APPLE_LOG_END {
        APPLE_LOG_SQUARE * (linear.max(APPLE_LOG_LEAST) - APPLE_LOG_LEAST).powi(2)
    } else {
        0.085_504_79 * (linear + 0.009_640_52).log2() + 0.693_369_45
    }
}

pub(super) fn apple_log_decode(coded: f64) -> f64 {
    if coded <= apple_log_encode(APPLE_LOG_END) {
        (coded.max(0.0) / APPLE_LOG_SQUARE).sqrt() + APPLE_LOG_LEAST
    } else {
        ((coded - 0.693_369_45) / 0.085_504_79).exp2() - 0.009_640_52
    }
}
