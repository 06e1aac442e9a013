//! A common mistake: a change of one link's parameters without a free parameter.

use crate::{
    diagnosis::{cause_names::DynamicsCause, hypothesis::FaultySide},
    model::Inertial,
};

/// The changed parameters of one link; `None` if the mistake cannot have happened there.
pub(in crate::diagnosis) type ParameterChange<'a> = Box<dyn Fn(usize, &Inertial) -> Option<Inertial> + 'a>;

/// One common mistake, applicable to any link.
pub(in crate::diagnosis) struct CommonMistake<'a> {
    pub(in crate::diagnosis) cause: DynamicsCause,
    pub(in crate::diagnosis) detail: String,
    /// For each link a detail that replaces `detail` there.
    details_at_links: &'a [Option<String>],
    pub(in crate::diagnosis) change: ParameterChange<'a>,
}

impl<'a> CommonMistake<'a> {
    /// A mistake that is the same at every link.
    pub(super) fn new(
        cause: DynamicsCause,
        detail: impl Into<String>,
        change: impl Fn(&Inertial) -> Inertial + 'a,
    ) -> Self {
        Self::at_link(cause, detail, move |_, parameters| Some(change(parameters)))
    }

    /// A mistake that depends on the link.
    pub(super) fn at_link(
        cause: DynamicsCause,
        detail: impl Into<String>,
        change: impl Fn(usize, &Inertial) -> Option<Inertial> + 'a,
    ) -> Self {
        Self { cause, detail: detail.into(), details_at_links: &[], change: Box::new(change) }
    }

    /// The same mistake with other details at some links.
    pub(super) fn with_details_at_links(self, details_at_links: &'a [Option<String>]) -> Self {
        Self { details_at_links, ..self }
    }

    /// The detail of the mistake at one link.
    pub(super) fn detail_at(&self, link: usize) -> &str {
        self.details_at_links.get(link).and_then(Option::as_deref).unwrap_or(&self.detail)
    }
}

impl FaultySide {
    /// The factor that undoes a wrong unit (candidate) or makes it (reference); `per_right_unit` of the wrong unit are one right
    /// unit.
    pub(super) fn factor(self, per_right_unit: f64) -> f64 {
        match self {
            Self::Candidate => per_right_unit.recip(),
            Self::Reference => per_right_unit,
        }
    }
}
