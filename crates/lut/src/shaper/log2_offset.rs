/// `t = log2(1 + u / offset) / log2(1 + max / offset)` on `[0, max]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Log2Offset {
    offset: f64,
    max: f64,
    /// log2(1 + max / offset), stops.
    stops: f64,
    max_f32: f32,
    per_offset_f32: f32,
    per_stop_f32: f32,
}

impl Log2Offset {
    /// The caller has checked the parameters.
    pub(super) fn new(offset: f64, max: f64) -> Self {
        let stops = stops_above(max, offset);
        Self {
            offset,
            max,
            stops,
            max_f32: max as f32,
            per_offset_f32: (1.0 / offset) as f32,
            per_stop_f32: (1.0 / stops) as f32,
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

    #[inline]
    pub(super) fn encode_f32(&self, linear: f32) -> f32 {
        if linear >= self.max_f32 {
            1.0
        } else if linear > 0.0 {
            let stops = (1.0 + linear * self.per_offset_f32).log2();
            (stops * self.per_stop_f32).min(1.0)
        } else {
            0.0
        }
    }
}

/// log2(1 + linear / offset), without losing small values to the 1.
fn stops_above(linear: f64, offset: f64) -> f64 {
    (linear / offset).ln_1p() * std::f64::consts::LOG2_E
}
