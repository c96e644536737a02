//! The two curves of high dynamic range video.

/// The luminance of diffuse white, linear 1.0, in cd/m^2 (\[BT2408\]).
pub const HDR_WHITE_CD_M2: f64 = 203.0;

/// Linear light of PQ's code 1: 10000 cd/m^2 in units of white.
pub(super) const PQ_PEAK: f64 = 10_000.0 / HDR_WHITE_CD_M2;
// The constants of [ST2084] under its names.
const PQ_M1: f64 = 2610.0 / 16384.0;
const PQ_M2: f64 = 2523.0 / 4096.0 * 128.0;
const PQ_C1: f64 = 3424.0 / 4096.0;
const PQ_C2: f64 = 2413.0 / 4096.0 * 32.0;
const PQ_C3: f64 = 2392.0 / 4096.0 * 32.0;

pub(super) fn pq_encode(linear: f64) -> f64 {
    let power = (linear.clamp(0.0, PQ_PEAK) / PQ_PEAK).powf(PQ_M1);
    ((PQ_C1 + PQ_C2 * power) / (1.0 + PQ_C3 * power)).powf(PQ_M2)
}

pub(super) fn pq_decode(coded: f64) -> f64 {
    let power = coded.clamp(0.0, 1.0).powf(1.0 / PQ_M2);
    // The code of 0 may round to just under c1. max() would make 0 of NaN.
    let above = if power < PQ_C1 { 0.0 } else { power - PQ_C1 };
    PQ_PEAK * (above / (PQ_C2 - PQ_C3 * power)).powf(1.0 / PQ_M1)
}

// The constants of HLG under the names of [BT2100]; b = 1 - 4 a, c = 1/2 - a ln(4 a).
const HLG_A: f64 = 0.178_832_77;
const HLG_B: f64 = 1.0 - 4.0 * HLG_A;
const HLG_C: f64 = 0.559_910_729_529_562;
/// The scene light of [BT2100], whose code is 1 at 1, at a code of 75 %: diffuse white.
const HLG_WHITE: f64 = 0.264_962_560_421_007_2;

/// Luminance of the display that HLG's nominal system gamma is for, in cd/m^2, and that gamma.
pub(super) const HLG_PEAK: f64 = 1000.0;
pub(super) const HLG_GAMMA: f64 = 1.2;

/// The OETF of HLG of light whose white is coded 0.75; odd.
pub(super) fn hlg_encode(linear: f64) -> f64 {
    hlg_oetf(linear * HLG_WHITE)
}

pub(super) fn hlg_decode(coded: f64) -> f64 {
    hlg_oetf_inverse(coded) / HLG_WHITE
}

/// The OETF of HLG, 1 at 1; odd.
pub(super) fn hlg_oetf(linear: f64) -> f64 {
    let light = linear.abs();
    let coded = if light <= 1.0 / 12.0 { (3.0 * light).sqrt() } else { HLG_A * (12.0 * light - HLG_B).ln() + HLG_C };
    coded.copysign(linear)
}

pub(super) fn hlg_oetf_inverse(coded: f64) -> f64 {
    let v = coded.abs();
    let light = if v <= 0.5 { v * v / 3.0 } else { (((v - HLG_C) / HLG_A).exp() + HLG_B) / 12.0 };
    light.copysign(coded)
}
