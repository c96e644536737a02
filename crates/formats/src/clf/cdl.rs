/// A colour decision list of the American Society of Cinematographers: slope, offset and power, then saturation about the luma of
/// BT.709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cdl {
    pub(super) style: CdlStyle,
    pub(super) slope: [f64; 3],
    pub(super) offset: [f64; 3],
    pub(super) power: [f64; 3],
    pub(super) saturation: f64,
}

/// Which way a list is used, and whether it clamps to 0 to 1 on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CdlStyle {
    Forward,
    Reverse,
    ForwardNoClamp,
    ReverseNoClamp,
}

/// What red, green and blue give to luma: three of four decimals, as the list has them.
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

impl Cdl {
    /// Changes nothing but what a style clamps.
    pub(super) const NEUTRAL: Self =
        Self { style: CdlStyle::Forward, slope: [1.0; 3], offset: [0.0; 3], power: [1.0; 3], saturation: 1.0 };

    /// Step by step as section 6.4.7 of \[S2014-006\] has it.
    pub(super) fn apply(&self, rgb: [f64; 3]) -> [f64; 3] {
        let Self { style, slope, offset, power, saturation } = *self;
        let clamp = |rgb: [f64; 3]| match style {
            // NaN becomes 0.
            CdlStyle::Forward | CdlStyle::Reverse => rgb.map(|v| if v > 0.0 { v.min(1.0) } else { 0.0 }),
            CdlStyle::ForwardNoClamp | CdlStyle::ReverseNoClamp => rgb,
        };
        // A negative value that was not clamped has no power.
        let raised = |v: f64, power: f64| if v < 0.0 { v } else { v.powf(power) };
        match style {
            CdlStyle::Forward | CdlStyle::ForwardNoClamp => {
                let placed = clamp(std::array::from_fn(|i| rgb[i] * slope[i] + offset[i]));
                clamp(saturated(std::array::from_fn(|i| raised(placed[i], power[i])), saturation))
            }
            CdlStyle::Reverse | CdlStyle::ReverseNoClamp => {
                let even = clamp(saturated(clamp(rgb), 1.0 / saturation));
                clamp(std::array::from_fn(|i| (raised(even[i], 1.0 / power[i]) - offset[i]) / slope[i]))
            }
        }
    }
}

impl CdlStyle {
    const ALL: [(Self, &'static str); 4] = [
        (Self::Forward, "Fwd"),
        (Self::Reverse, "Rev"),
        (Self::ForwardNoClamp, "FwdNoClamp"),
        (Self::ReverseNoClamp, "RevNoClamp"),
    ];

    /// What the file calls it.
    pub(super) fn word(self) -> &'static str {
        Self::ALL.into_iter().find(|(style, _)| *style == self).map_or("", |(_, word)| word)
    }

    pub(super) fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(_, own)| *own == word).map(|(style, _)| style)
    }

    /// Whether slope and saturation are divided by.
    pub(super) fn is_reverse(self) -> bool {
        matches!(self, Self::Reverse | Self::ReverseNoClamp)
    }
}

fn saturated(rgb: [f64; 3], saturation: f64) -> [f64; 3] {
    let luma: f64 = rgb.iter().zip(LUMA).map(|(v, weight)| v * weight).sum();
    rgb.map(|v| luma + saturation * (v - luma))
}
