/// Exposure in lux s that a properly metered mid grey gets, times the exposure index: the middle of what meters use.
pub(crate) const MID_GREY_LUX_S: f64 = 8.1;
