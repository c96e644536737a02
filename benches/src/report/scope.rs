use serde::Serialize;

use crate::effect_decisions::Cases;

/// How many forms, colours and rounds are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scope {
    /// Every form, many colours, a picture of 4K.
    Full,
    /// Fewer forms, fewer colours, a smaller picture: to see that all works.
    Quick,
}

impl Scope {
    /// Rounds of each timing.
    pub(super) fn rounds(self) -> usize {
        match self {
            Self::Full => 15,
            Self::Quick => 3,
        }
    }

    /// Pictures that it is looked at whether effects can be seen in them.
    pub(super) fn decision_cases(self) -> Cases {
        match self {
            Self::Full => Cases::All,
            Self::Quick => Cases::Few,
        }
    }

    /// Width and height of the scene that the picture to time on is enlarged from.
    pub(super) fn scene_size(self) -> (usize, usize) {
        match self {
            Self::Full => (960, 540),
            Self::Quick => (160, 90),
        }
    }
}
