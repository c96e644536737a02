use super::machine::Machine;
use super::measure::Look;
use super::peers::Elsewhere;
use super::scope::Scope;
use super::stopwatch::Timing;
use super::studies::{Growth, Studies};
use crate::effect_decisions::DecisionSummary;

/// Everything that is on the page.
pub(super) struct Contents {
    pub(super) scope: Scope,
    pub(super) machine: Machine,
    pub(super) colours: usize,
    pub(super) rounds: usize,
    /// Width and height of the picture timed on.
    pub(super) frame: [usize; 2],
    /// What is on that picture.
    pub(super) content: &'static str,
    pub(super) copy: Timing,
    pub(super) looks: Vec<(Look, Studies)>,
    /// How cost grows, measured on the first look.
    pub(super) growth: Growth,
    /// Whether `auto` leaves out what can be seen.
    pub(super) decisions: [DecisionSummary; 2],
    pub(super) elsewhere: Elsewhere,
    /// How long each part took, in words.
    pub(super) clock: String,
}
