use super::super::job::Developed;

/// What became of a frame.
#[derive(Debug)]
pub(super) enum Outcome {
    Developed(Developed),
    /// The output is there and is what would be made.
    AlreadyDone,
    /// Why, in one sentence that starts with a path.
    Failed(String),
}
