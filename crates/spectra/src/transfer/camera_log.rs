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
