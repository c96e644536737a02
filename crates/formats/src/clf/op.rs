use onelight_lut::{Interpolation, Lut1d, Lut3d, PowerCoding};

use super::cdl::Cdl;

/// Smallest value whose logarithm is taken: the smallest normal `f32`, as the format wants it \[S2014-006\].
const LOG_MIN: f64 = f32::MIN_POSITIVE as f64;

/// One operation. The numbers have been checked: they are finite, and nothing divides by 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Op {
    Matrix {
        rows: [[f64; 3]; 3],
        offset: [f64; 3],
    },
    Range(Range),
    Log {
        direction: Direction,
        channels: [LogCurve; 3],
    },
    Exponent {
        style: ExponentStyle,
        channels: [Power; 3],
    },
    Cdl(Cdl),
    /// Over the domain 0 to 1.
    Lut1d(Lut1d),
    Lut3d(Lut3d, Interpolation),
}

/// Whether a curve is used as its parameters say it, or its inverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    Forward,
    Reverse,
}

/// What becomes of values beyond two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    /// Input and output at the lower end.
    pub(super) low: Option<[f64; 2]>,
    /// Input and output at the upper end; at least one end is there.
    pub(super) high: Option<[f64; 2]>,
    pub(super) beyond: Beyond,
}

/// Values beyond the ends of a [`Range`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beyond {
    Clamp,
    /// Follow the line; both ends are there.
    Continue,
}

/// `log_slope * log_base(lin_slope * x + lin_offset) + log_offset`, below `toe` a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LogCurve {
    pub(super) base: f64,
    pub(super) log_slope: f64,
    pub(super) log_offset: f64,
    pub(super) lin_slope: f64,
    pub(super) lin_offset: f64,
    pub(super) toe: Option<Toe>,
}

/// The line of a camera's log curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Toe {
    /// Linear value where the line ends.
    pub(super) end: f64,
    /// The line's slope; that of the curve if none is given.
    pub(super) slope: Option<f64>,
}

/// What kind of power an `Exponent` is. Only the format's own styles are made, so that each has its word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ExponentStyle {
    word: &'static str,
    pub(super) shape: Shape,
    negatives: Negatives,
    direction: Direction,
}

/// A power alone, or one with a straight foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Basic,
    MonCurve,
}

/// What becomes of negative values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Negatives {
    /// 0 for a power; along the foot's line for a curve that has one.
    Plain,
    Mirror,
    PassThrough,
}

/// The parameters of one channel of an `Exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Power {
    /// `x^exponent`; the exponent is above 0.
    Basic(f64),
    /// A power with a straight foot.
    MonCurve(PowerCoding),
}

impl Op {
    /// The name of its element in the file.
    pub(super) fn element(&self) -> &'static str {
        match self {
            Self::Matrix { .. } => "Matrix",
            Self::Range(_) => "Range",
            Self::Log { .. } => "Log",
            Self::Exponent { .. } => "Exponent",
            Self::Cdl(_) => "ASC_CDL",
            Self::Lut1d(_) => "LUT1D",
            Self::Lut3d(..) => "LUT3D",
        }
    }

    pub(super) fn apply(&self, rgb: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Matrix { rows, offset } => {
                let [r, g, b] = rgb;
                std::array::from_fn(|i| rows[i][0] * r + rows[i][1] * g + rows[i][2] * b + offset[i])
            }
            Self::Range(range) => rgb.map(|v| range.apply(v)),
            Self::Log { direction, channels } => std::array::from_fn(|i| match direction {
                Direction::Forward => channels[i].forward(rgb[i]),
                Direction::Reverse => channels[i].reverse(rgb[i]),
            }),
            Self::Exponent { style, channels } => std::array::from_fn(|i| style.apply(channels[i], rgb[i])),
            Self::Cdl(cdl) => cdl.apply(rgb),
            Self::Lut1d(lut) => lut.apply(rgb.map(|v| v as f32)).map(f64::from),
            Self::Lut3d(lut, interpolation) => lut.apply(rgb.map(|v| v as f32), *interpolation).map(f64::from),
        }
    }
}

impl Range {
    /// Both ends unchanged, and clamped to.
    pub(super) fn clamp(low: f64, high: f64) -> Self {
        Self { low: Some([low; 2]), high: Some([high; 2]), beyond: Beyond::Clamp }
    }

    /// A range with a lower end alone: what is above goes through.
    pub(super) fn floor(low: f64) -> Self {
        Self { low: Some([low; 2]), high: None, beyond: Beyond::Clamp }
    }

    fn apply(&self, v: f64) -> f64 {
        let line = match (self.low, self.high) {
            (Some([from, at]), Some([to, end])) => {
                // Not from an end of the line: at 1e30 that would leave nothing of the colour.
                let slope = (end - at) / (to - from);
                v * slope + (at - from * slope)
            }
            (Some([input, output]), None) | (None, Some([input, output])) => v + (output - input),
            (None, None) => v,
        };
        if self.beyond == Beyond::Continue {
            return line;
        }
        // `max` and `min` return the number beside a NaN.
        let above = self.low.map_or(line, |[_, output]| line.max(output));
        self.high.map_or(above, |[_, output]| above.min(output))
    }
}

impl LogCurve {
    /// The logarithm of a base, with neither slopes nor offsets of its own.
    pub(super) fn of_base(base: f64) -> Self {
        Self { base, log_slope: 1.0, log_offset: 0.0, lin_slope: 1.0, lin_offset: 0.0, toe: None }
    }

    fn forward(&self, v: f64) -> f64 {
        match self.line() {
            Some((end, slope, offset)) if v <= end => slope * v + offset,
            _ => self.log(v),
        }
    }

    fn reverse(&self, v: f64) -> f64 {
        match self.line() {
            Some((end, slope, offset)) if v <= slope * end + offset => (v - offset) / slope,
            _ => (((v - self.log_offset) / self.log_slope * self.base.ln()).exp() - self.lin_offset) / self.lin_slope,
        }
    }

    /// End, slope and offset of the toe's line, which meets the curve at its end.
    pub(super) fn line(&self) -> Option<(f64, f64, f64)> {
        let Toe { end, slope } = self.toe?;
        let tangent = self.log_slope * self.lin_slope / ((self.lin_slope * end + self.lin_offset) * self.base.ln());
        let slope = slope.unwrap_or(tangent);
        Some((end, slope, self.log(end) - slope * end))
    }

    fn log(&self, v: f64) -> f64 {
        let inside = (self.lin_slope * v + self.lin_offset).max(LOG_MIN);
        self.log_slope * inside.log2() / self.base.log2() + self.log_offset
    }
}

impl ExponentStyle {
    /// The output's coding as a power alone.
    pub(super) const BASIC_MIRROR_REV: Self =
        Self::new("basicMirrorRev", Shape::Basic, Negatives::Mirror, Direction::Reverse);

    /// The output's coding with a straight foot.
    pub(super) const MON_CURVE_MIRROR_REV: Self =
        Self::new("monCurveMirrorRev", Shape::MonCurve, Negatives::Mirror, Direction::Reverse);

    const fn new(word: &'static str, shape: Shape, negatives: Negatives, direction: Direction) -> Self {
        Self { word, shape, negatives, direction }
    }

    /// What the file calls it.
    pub(super) fn word(self) -> &'static str {
        self.word
    }

    pub(super) fn from_word(word: &str) -> Option<Self> {
        STYLES.into_iter().find(|style| style.word == word)
    }

    fn apply(self, power: Power, v: f64) -> f64 {
        match power {
            Power::Basic(exponent) => self.basic(exponent, v),
            Power::MonCurve(coding) => self.mon_curve(&coding, v),
        }
    }

    fn basic(self, exponent: f64, v: f64) -> f64 {
        let exponent = match self.direction {
            Direction::Forward => exponent,
            Direction::Reverse => 1.0 / exponent,
        };
        match self.negatives {
            Negatives::Plain => v.max(0.0).powf(exponent),
            Negatives::Mirror => v.abs().powf(exponent).copysign(v),
            Negatives::PassThrough => {
                if v < 0.0 {
                    v
                } else {
                    v.powf(exponent)
                }
            }
        }
    }

    fn mon_curve(self, coding: &PowerCoding, v: f64) -> f64 {
        if v < 0.0 && self.negatives == Negatives::Plain && coding.offset() > 0.0 {
            // Half way along the foot, coded and in linear light.
            let coded = 0.5 * coding.offset() / (coding.exponent() - 1.0);
            let linear = coding.decode(coded);
            return match self.direction {
                Direction::Forward => v * linear / coded,
                Direction::Reverse => v * coded / linear,
            };
        }
        match self.direction {
            Direction::Forward => coding.decode(v),
            Direction::Reverse => coding.encode(v),
        }
    }
}

const STYLES: [ExponentStyle; 10] = {
    use Direction::{Forward, Reverse};
    use Negatives::{Mirror, PassThrough, Plain};
    use Shape::{Basic, MonCurve};
    [
        ExponentStyle::new("basicFwd", Basic, Plain, Forward),
        ExponentStyle::new("basicRev", Basic, Plain, Reverse),
        ExponentStyle::new("basicMirrorFwd", Basic, Mirror, Forward),
        ExponentStyle::BASIC_MIRROR_REV,
        ExponentStyle::new("basicPassThruFwd", Basic, PassThrough, Forward),
        ExponentStyle::new("basicPassThruRev", Basic, PassThrough, Reverse),
        ExponentStyle::new("monCurveFwd", MonCurve, Plain, Forward),
        ExponentStyle::new("monCurveRev", MonCurve, Plain, Reverse),
        ExponentStyle::new("monCurveMirrorFwd", MonCurve, Mirror, Forward),
        ExponentStyle::MON_CURVE_MIRROR_REV,
    ]
};
