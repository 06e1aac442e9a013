//! A verdict: a word with a sign and a colour, so that none of the three is needed alone.

use maud::{Markup, html};

/// Result of a check or a run, which chooses sign and colour of its badge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum BadgeKind {
    Bad,
    Unclear,
    Good,
}

impl BadgeKind {
    /// The class in the style sheet.
    pub(crate) fn class(self) -> &'static str {
        match self {
            Self::Bad => "bad",
            Self::Unclear => "unclear",
            Self::Good => "good",
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Self::Bad => "\u{2717}",
            Self::Unclear => "!",
            Self::Good => "\u{2713}",
        }
    }
}

/// The word with its sign.
pub(crate) fn badge(outcome: BadgeKind, word: &str) -> Markup {
    html! {
        span.badge.(outcome.class()) { span.sign aria-hidden="true" { (outcome.sign()) } " " (word) }
    }
}
