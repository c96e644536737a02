//! Whether an effect can be seen in a picture at all.

mod grain;
mod halation;
mod sharpness;

use std::fmt;

pub use grain::grain_decision;
pub use halation::HalationProbe;
pub use sharpness::SharpnessProbe;

use crate::frame::Frame;

/// One of the effects.
///
/// ```
/// assert_eq!(onelight_spatial::Effect::Sharpness.to_string(), "sharpness");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Scatter and adjacency.
    Sharpness,
    /// Light that returns from the base.
    Halation,
    /// Dye clouds.
    Grain,
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sharpness => "sharpness",
            Self::Halation => "halation",
            Self::Grain => "grain",
        })
    }
}

/// What a look at a picture came to.
///
/// ```
/// use onelight_spatial::Verdict;
/// let runs = |verdict| matches!(verdict, Verdict::Visible);
/// assert!(runs(Verdict::Visible) && !runs(Verdict::NotVisible));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// The effect can be seen: run it.
    Visible,
    /// It cannot: leave it out.
    NotVisible,
}

/// Whether an effect can be seen, and why; shown as a line such as `grain: 0.20 L*, 0.45 b* at 400 px of 36.0 mm: not visible, skipped`.
///
/// ```
/// # use onelight_spatial::{FilmFormat, Frame, HalationProbe, HalationSettings, Halation, Planes, Verdict};
/// # struct Screen;
/// # impl onelight_spatial::Finish for Screen {
/// #     fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3] { amounts.map(|a| 10f64.powf(-a)) }
/// #     fn lab(&self, display_linear: [f64; 3]) -> [f64; 3] { display_linear.map(|v| 116.0 * v.cbrt() - 16.0) }
/// #     fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 { (self.lab(a)[0] - self.lab(b)[0]).abs() }
/// # }
/// let frame = Frame::new([80, 60], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let mut probe = HalationProbe::new(&Halation::new(HalationSettings::default())?, &frame)?;
/// probe.add(&Planes::new(80, 0..60)?)?;
/// let decision = probe.finish(&|e: [f32; 3]| e, &Screen)?;
/// assert_eq!(decision.verdict(), Verdict::NotVisible, "a black frame");
/// assert_eq!(decision.to_string(), "halation: at most 0.00 dE at 80 px of 0.973 mm: not visible, skipped");
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    effect: Effect,
    verdict: Verdict,
    measured: String,
}

impl Decision {
    fn new(effect: Effect, is_visible: bool, measured: &str, frame: &Frame) -> Self {
        let verdict = if is_visible { Verdict::Visible } else { Verdict::NotVisible };
        let mm = frame.width() as f64 * frame.pitch().x_um() / 1000.0;
        let decimals = if mm < 10.0 { 3 } else { 1 };
        Self { effect, verdict, measured: format!("{measured} at {} px of {mm:.decimals$} mm", frame.width()) }
    }

    /// The effect.
    #[must_use]
    pub fn effect(&self) -> Effect {
        self.effect
    }

    /// Whether to run it.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }
}

impl fmt::Display for Decision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = match self.verdict {
            Verdict::Visible => "visible",
            Verdict::NotVisible => "not visible, skipped",
        };
        write!(f, "{}: {}: {verdict}", self.effect, self.measured)
    }
}
