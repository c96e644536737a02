//! The logarithms with a straight toe that makers of cameras and grading programs publish.
//!
//! Digits as printed miss at the joint of the two pieces, so that a curve would fall there. The pieces are made to meet: by
//! the toe's end where both cross near the printed one, else by the toe's offset or slope. No code moves by more than 1.1e-4, a ninth of a
//! 10-bit code, and but for F-Log by more than 3e-6.

use super::camera_log::CameraLog;

impl CameraLog {
    /// ACEScct (\[S2016-001\]): log2(x) above 2^-7.
    pub(super) const ACES_CCT: Self = Self {
        base: 2.0,
        log_side_slope: 1.0 / 17.52,
        log_side_offset: 9.72 / 17.52,
        lin_side_slope: 1.0,
        lin_side_offset: 0.0,
        lin_side_break: 0.007_812_5,
        linear_slope: 10.540_237_741_654_5,
        linear_offset: 0.072_905_534_195_835_5,
    };

    /// ARRI LogC4 (\[ArriLogC4\]): there a = (2^18 - 16) / 117.45, b = 928/1023, c = 95/1023, and the toe ends at
    /// coded 0, linear t, with the slope 1/s of the logarithm.
    pub(super) const LOG_C4: Self = Self {
        base: 2.0,
        log_side_slope: 928.0 / 1023.0 / 14.0,
        log_side_offset: 95.0 / 1023.0 - 6.0 / 14.0 * 928.0 / 1023.0,
        lin_side_slope: (262_144.0 - 16.0) / 117.45,
        lin_side_offset: 64.0,
        lin_side_break: LOG_C4_T,
        linear_slope: 1.0 / LOG_C4_S,
        linear_offset: -LOG_C4_T / LOG_C4_S,
    };

    /// S-Log3 (\[SonySLog3\]). The toe ends at code 171.2102946929 as printed; four more digits make the pieces meet.
    pub(super) const S_LOG3: Self = Self {
        base: 10.0,
        log_side_slope: 261.5 / 1023.0,
        log_side_offset: 420.0 / 1023.0,
        lin_side_slope: 1.0 / (0.18 + 0.01),
        lin_side_offset: 0.01 / (0.18 + 0.01),
        lin_side_break: 0.011_25,
        linear_slope: (171.210_294_692_860_6 - 95.0) / 0.011_25 / 1023.0,
        linear_offset: 95.0 / 1023.0,
    };

    /// DaVinci Intermediate (\[DaVinciIntermediate\]). The slope of the toe is printed as 10.44426855, with which the
    /// curve would fall by 3.4e-10 at the joint; this one makes the pieces meet.
    pub(super) const DAVINCI_INTERMEDIATE: Self = Self {
        base: 2.0,
        log_side_slope: 0.073_292_48,
        log_side_offset: 7.0 * 0.073_292_48,
        lin_side_slope: 1.0,
        lin_side_offset: 0.007_5,
        lin_side_break: 0.002_624_09,
        linear_slope: 10.444_268_419_074_49,
        linear_offset: 0.0,
    };

    /// ARRI LogC3 at exposure index 800 (\[ArriLogC3\]). The offset of the toe is printed as 0.092809.
    pub(super) const LOG_C3: Self = Self {
        base: 10.0,
        log_side_slope: 0.247_190,
        log_side_offset: 0.385_537,
        lin_side_slope: 5.555_556,
        lin_side_offset: 0.052_272,
        lin_side_break: 0.010_591,
        linear_slope: 5.367_655,
        linear_offset: 0.092_808_749_827_894_82,
    };

    /// Panasonic V-Log (\[PanasonicVLog\]). The offset of the toe is printed as 0.125.
    pub(super) const V_LOG: Self = Self {
        base: 10.0,
        log_side_slope: 0.241_514,
        log_side_offset: 0.598_206,
        lin_side_slope: 1.0,
        lin_side_offset: 0.008_73,
        lin_side_break: 0.01,
        linear_slope: 5.6,
        linear_offset: 0.124_999_688_765_003_08,
    };

    /// Fujifilm F-Log (\[FujiFLog\]). The toe is printed to end at 0.00089, 1.0e-4 of code above the logarithm.
    pub(super) const F_LOG: Self = Self {
        base: 10.0,
        log_side_slope: 0.344_676,
        log_side_offset: 0.790_453,
        lin_side_slope: 0.555_556,
        lin_side_offset: 0.009_468,
        lin_side_break: 0.000_566_346_796_987_97,
        linear_slope: 8.735_631,
        linear_offset: 0.092_864,
    };

    /// Fujifilm F-Log2 (\[FujiFLog2\]). The toe is printed to end at 0.000889.
    pub(super) const F_LOG2: Self = Self {
        base: 10.0,
        log_side_slope: 0.245_281,
        log_side_offset: 0.384_316,
        lin_side_slope: 5.555_556,
        lin_side_offset: 0.064_829,
        lin_side_break: 0.000_888_888_142_948_392_2,
        linear_slope: 8.799_461,
        linear_offset: 0.092_864,
    };

    /// RED Log3G10, version 3 (\[RedLog3G10\]): the pieces meet at -0.01, code 0.
    pub(super) const LOG3G10: Self = Self {
        base: 10.0,
        log_side_slope: 0.224_282,
        log_side_offset: 0.0,
        lin_side_slope: 155.975_327,
        lin_side_offset: 0.01 * 155.975_327 + 1.0,
        lin_side_break: -0.01,
        linear_slope: 15.192_7,
        linear_offset: 0.01 * 15.192_7,
    };

    /// DJI D-Log (\[DjiDLog\]). The toe is printed to end at 0.0078.
    pub(super) const D_LOG: Self = Self {
        base: 10.0,
        log_side_slope: 0.256_663,
        log_side_offset: 0.584_555,
        lin_side_slope: 0.989_2,
        lin_side_offset: 0.010_8,
        lin_side_break: 0.007_827_156_200_341_792,
        linear_slope: 6.025,
        linear_offset: 0.092_9,
    };
}

/// Linear light at which LogC4's coded value is 0: (2^(6 - 14 c/b) - 64) / a.
const LOG_C4_T: f64 = -0.018_056_996_119_911_31;
/// Linear light per coded value in LogC4's toe: 7 ln 2 * 2^(7 - 14 c/b) / (a b).
const LOG_C4_S: f64 = 0.113_597_208_610_589_1;

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const ALL: [CameraLog; 10] = [
        CameraLog::ACES_CCT,
        CameraLog::LOG_C4,
        CameraLog::S_LOG3,
        CameraLog::DAVINCI_INTERMEDIATE,
        CameraLog::LOG_C3,
        CameraLog::V_LOG,
        CameraLog::F_LOG,
        CameraLog::F_LOG2,
        CameraLog::LOG3G10,
        CameraLog::D_LOG,
    ];

    #[test]
    fn the_pieces_meet() {
        for log in ALL {
            let toe = log.encode(log.lin_side_break);
            let above = log.encode(log.lin_side_break.next_up());
            assert!((toe - above).abs() < 1e-15, "{log:?}: {toe} {above}");
        }
    }

    #[test]
    fn log_c4_constants_follow_from_its_formulae() {
        let (a, b, c): (f64, f64, f64) = ((2_f64.powi(18) - 16.0) / 117.45, (1023.0 - 95.0) / 1023.0, 95.0 / 1023.0);
        let s = 7.0 * std::f64::consts::LN_2 * (7.0 - 14.0 * c / b).exp2() / (a * b);
        let t = ((14.0 * (-c / b) + 6.0).exp2() - 64.0) / a;
        assert_relative_eq!(LOG_C4_S, s, max_relative = 1e-14);
        assert_relative_eq!(LOG_C4_T, t, max_relative = 1e-14);
    }

    #[test]
    fn davinci_toe_is_the_published_one_to_its_digits() {
        let log = CameraLog::DAVINCI_INTERMEDIATE;
        assert!((log.encode(log.lin_side_break) - 10.444_268_55 * log.lin_side_break).abs() < 4e-10);
        // The printed cut, 0.02740668, and the printed code of -0.01.
        assert!((log.encode(log.lin_side_break) - 0.027_406_68).abs() < 3e-8);
        assert!((log.encode(-0.01) + 0.104_443).abs() < 5e-7);
    }

    /// The printed pieces, side by side with ours: toe's slope and offset, its end, and the most that any code moves.
    #[test]
    fn codes_stay_those_of_the_printed_digits() {
        for (log, slope, offset, end, most) in [
            (CameraLog::LOG_C3, 5.367_655, 0.092_809, 0.010_591, 3e-7),
            (CameraLog::V_LOG, 5.6, 0.125, 0.01, 4e-7),
            (CameraLog::F_LOG, 8.735_631, 0.092_864, 0.000_89, 1.1e-4),
            (CameraLog::F_LOG2, 8.799_461, 0.092_864, 0.000_889, 1e-7),
            (CameraLog::LOG3G10, 15.192_7, 0.151_927, -0.01, 1e-12),
            (CameraLog::D_LOG, 6.025, 0.092_9, 0.007_8, 3e-6),
        ] {
            for i in -2000..=20_000 {
                let v = f64::from(i) * 1e-5;
                let above = log.log_side_slope * (log.lin_side_slope * v + log.lin_side_offset).log10();
                let printed = if v > end { above + log.log_side_offset } else { slope * v + offset };
                assert!((log.encode(v) - printed).abs() <= most, "{log:?} at {v}: {}, {printed}", log.encode(v));
            }
        }
    }
}
