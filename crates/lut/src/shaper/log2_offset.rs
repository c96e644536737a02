use crate::log2_exp2::log2;

/// `t = log2(1 + u / offset) / log2(1 + max / offset)` on `[0, max]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Log2Offset {
    offset: f64,
    max: f64,
    /// log2(1 + max / offset), stops.
    stops: f64,
    numbers: LogNumbers,
}

/// A [`Log2Offset`] as pixel loops have it: `log2(1 + per_offset u) per_stop`, 1 from `max` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LogNumbers {
    pub(crate) max: f32,
    pub(crate) per_offset: f32,
    pub(crate) per_stop: f32,
}

impl LogNumbers {
    #[inline]
    pub(crate) fn encode(&self, linear: f32) -> f32 {
        if linear >= self.max {
            1.0
        } else if linear > 0.0 {
            (log2(1.0 + linear * self.per_offset) * self.per_stop).min(1.0)
        } else {
            0.0
        }
    }
}

impl Log2Offset {
    /// The caller has checked the parameters.
    pub(super) fn new(offset: f64, max: f64) -> Self {
        let stops = stops_above(max, offset);
        Self {
            offset,
            max,
            stops,
            numbers: LogNumbers { max: max as f32, per_offset: (1.0 / offset) as f32, per_stop: (1.0 / stops) as f32 },
        }
    }

    pub(super) fn offset(&self) -> f64 {
        self.offset
    }

    pub(super) fn max(&self) -> f64 {
        self.max
    }

    pub(super) fn encode(&self, linear: f64) -> f64 {
        // Written so that NaN takes the last branch.
        if linear >= self.max {
            1.0
        } else if linear > 0.0 {
            stops_above(linear, self.offset) / self.stops
        } else {
            0.0
        }
    }

    pub(super) fn decode(&self, coordinate: f64) -> f64 {
        if coordinate >= 1.0 {
            self.max
        } else if coordinate > 0.0 {
            let stops = coordinate * self.stops;
            self.offset * (stops * std::f64::consts::LN_2).exp_m1()
        } else {
            0.0
        }
    }

    pub(super) fn numbers(&self) -> &LogNumbers {
        &self.numbers
    }
}

/// log2(1 + linear / offset), without losing small values to the 1.
fn stops_above(linear: f64, offset: f64) -> f64 {
    (linear / offset).ln_1p() * std::f64::consts::LOG2_E
}
