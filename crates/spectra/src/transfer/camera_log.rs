/// A logarithm with a straight toe: the shape of every camera log curve, in the parameters that the Common LUT Format
/// gives its `cameraLinToLog` (\[S2014-006\]).
///
/// ```text
/// coded = log_side_slope * log_base(lin_side_slope * linear + lin_side_offset) + log_side_offset   above lin_side_break
/// coded = linear_slope * linear + linear_offset                                                    up to it
/// ```
///
/// The toe goes on below 0, so negative light has a code (itself below that of 0) and comes back.
///
/// ```
/// use onelight_spectra::SceneCurve;
/// let log = SceneCurve::AcesCct.camera_log().expect("ACEScct is a logarithm with a toe");
/// assert_eq!((log.base, log.lin_side_break), (2.0, 0.0078125));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraLog {
    /// Base of the logarithm: 2 or 10.
    pub base: f64,
    /// Coded value per unit of the logarithm.
    pub log_side_slope: f64,
    /// Coded value where the logarithm is 0.
    pub log_side_offset: f64,
    /// Factor on linear light before the logarithm.
    pub lin_side_slope: f64,
    /// Addend to linear light before the logarithm.
    pub lin_side_offset: f64,
    /// Linear light at which the toe ends.
    pub lin_side_break: f64,
    /// Coded value per unit of linear light in the toe.
    pub linear_slope: f64,
    /// Coded value that the toe gives to linear light 0. A CLF file does not carry it: it follows from the joint.
    pub linear_offset: f64,
}

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

    /// Linear light to coded value: finite for input within ±1e300; infinities and NaN stay what they are.
    #[must_use]
    pub fn encode(&self, linear: f64) -> f64 {
        if linear > self.lin_side_break {
            let logarithm = (self.lin_side_slope * linear + self.lin_side_offset).log(self.base);
            self.log_side_slope * logarithm + self.log_side_offset
        } else {
            self.linear_slope * linear + self.linear_offset
        }
    }

    /// Coded value to linear light: the inverse of [`CameraLog::encode`]. Codes of a hundred and more may give
    /// infinity; infinities and NaN stay what they are.
    #[must_use]
    pub fn decode(&self, coded: f64) -> f64 {
        if coded > self.linear_slope * self.lin_side_break + self.linear_offset {
            let power = self.base.powf((coded - self.log_side_offset) / self.log_side_slope);
            (power - self.lin_side_offset) / self.lin_side_slope
        } else {
            (coded - self.linear_offset) / self.linear_slope
        }
    }
}

/// Linear light at which LogC4's coded value is 0: (2^(6 - 14 c/b) - 64) / a.
const LOG_C4_T: f64 = -0.018_056_996_119_911_31;
/// Linear light per coded value in LogC4's toe: 7 ln 2 * 2^(7 - 14 c/b) / (a b).
const LOG_C4_S: f64 = 0.113_597_208_610_589_1;

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const ALL: [CameraLog; 4] =
        [CameraLog::ACES_CCT, CameraLog::LOG_C4, CameraLog::S_LOG3, CameraLog::DAVINCI_INTERMEDIATE];

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
}
