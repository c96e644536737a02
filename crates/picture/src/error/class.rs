/// The kinds of errors that a caller may tell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    Limit,
    Unsupported,
    Damaged,
    Unwritable,
    Io,
}
