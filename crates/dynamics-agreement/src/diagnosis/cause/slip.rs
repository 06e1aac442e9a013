//! A slip: a change of one link's parameters without a free number.

use crate::{
    diagnosis::{cause_names::DynamicsCause, hypothesis::FaultySide},
    side::Inertial,
};

/// What becomes of one link's parameters; `None` if the slip cannot have happened there.
pub(in crate::diagnosis) type Change<'a> = Box<dyn Fn(usize, &Inertial) -> Option<Inertial> + 'a>;

/// One slip, for any link.
pub(in crate::diagnosis) struct Slip<'a> {
    pub(in crate::diagnosis) cause: DynamicsCause,
    pub(in crate::diagnosis) detail: String,
    /// At one link, if it has another one there.
    details_at_links: &'a [Option<String>],
    pub(in crate::diagnosis) change: Change<'a>,
}

impl<'a> Slip<'a> {
    /// A slip that is the same at every link.
    pub(super) fn new(
        cause: DynamicsCause,
        detail: impl Into<String>,
        change: impl Fn(&Inertial) -> Inertial + 'a,
    ) -> Self {
        Self::at_link(cause, detail, move |_, parameters| Some(change(parameters)))
    }

    /// A slip that depends on the link.
    pub(super) fn at_link(
        cause: DynamicsCause,
        detail: impl Into<String>,
        change: impl Fn(usize, &Inertial) -> Option<Inertial> + 'a,
    ) -> Self {
        Self { cause, detail: detail.into(), details_at_links: &[], change: Box::new(change) }
    }

    /// With another detail at some links.
    pub(super) fn with_details_at_links(self, details_at_links: &'a [Option<String>]) -> Self {
        Self { details_at_links, ..self }
    }

    /// The detail at one link.
    pub(super) fn detail_at(&self, link: usize) -> &str {
        self.details_at_links.get(link).and_then(Option::as_deref).unwrap_or(&self.detail)
    }
}

impl FaultySide {
    /// The factor that undoes or does a wrong unit, of which so many make one right unit.
    pub(super) fn factor(self, per_right_unit: f64) -> f64 {
        match self {
            Self::Candidate => per_right_unit.recip(),
            Self::Reference => per_right_unit,
        }
    }
}
