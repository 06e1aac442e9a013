//! One quantity against its limit, sample after sample, without allocation.

use congruent_description::JointValues;
use congruent_input::{Quantity, SiUnit};

use crate::{
    sample::Sample,
    verdict::{Bound, InstantValue, Measure, Moment},
};

/// Remembers the worst value and the first violation of one quantity.
#[derive(Debug, Clone)]
pub(crate) struct Watch {
    quantity: Quantity,
    unit: SiUnit,
    bound: Bound,
    limit: f64,
    worst: Extreme,
    first_violation: Extreme,
    /// The worst value of the last instant, and its time.
    latest: (f64, f64),
    /// Index of the link, joint or pair that has that value.
    latest_subject: usize,
}

/// A value with its time and configuration; `q` is allocated once.
#[derive(Debug, Clone)]
struct Extreme {
    value: f64,
    subject: usize,
    time_s: f64,
    q: Vec<f64>,
    is_set: bool,
}

/// Time and configuration of a value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WatchedInstant<'a> {
    pub(crate) time_s: f64,
    pub(crate) q: &'a [f64],
}

impl Extreme {
    fn set(&mut self, value: f64, subject: usize, WatchedInstant { time_s, q }: WatchedInstant<'_>) {
        (self.value, self.subject, self.time_s, self.is_set) = (value, subject, time_s, true);
        self.q.copy_from_slice(q);
    }
}

impl Watch {
    /// A watch over `quantity` for a robot with `dof` movable joints.
    pub(crate) fn new(quantity: Quantity, unit: SiUnit, bound: Bound, limit: f64, dof: usize) -> Self {
        let unset = Extreme { value: f64::NAN, subject: 0, time_s: 0.0, q: vec![0.0; dof], is_set: false };
        Self {
            quantity,
            unit,
            bound,
            limit,
            worst: unset.clone(),
            first_violation: unset,
            latest: (f64::NAN, f64::NAN),
            latest_subject: 0,
        }
    }

    /// Evaluates one value of `subject`, an index that `measure` turns into a name.
    pub(crate) fn observe(&mut self, value: f64, subject: usize, sample: &Sample<'_>) {
        self.observe_at(value, subject, WatchedInstant { time_s: sample.time_s, q: sample.joints.state().q });
    }

    /// The same of an instant by its time and configuration.
    pub(crate) fn observe_at(&mut self, value: f64, subject: usize, instant: WatchedInstant<'_>) {
        let time_s = instant.time_s;
        let (latest, at_s) = &mut self.latest;
        #[expect(clippy::float_cmp, reason = "the time of one sample")]
        // One instant has a value for each subject. The first replaces that of the instant before, later ones only if
        // worse.
        if *at_s != time_s || self.bound.is_worse(value, *latest) {
            (*latest, *at_s) = (value, time_s);
            self.latest_subject = subject;
        }
        if !self.worst.is_set || self.bound.is_worse(value, self.worst.value) {
            self.worst.set(value, subject, instant);
        }
        if !self.first_violation.is_set && !self.bound.holds(value, self.limit) {
            self.first_violation.set(value, subject, instant);
        }
    }

    /// The values of the last instant once more, at a later time: none can be worse than the worst so far.
    pub(crate) fn observe_again(&mut self, time_s: f64) {
        self.latest.1 = time_s;
    }

    /// The worst value of this instant, if it has one.
    pub(crate) fn at(&self, time_s: f64) -> Option<InstantValue> {
        let Self { quantity, unit, bound, limit, latest: (value, at_s), latest_subject: subject, .. } = *self;
        #[expect(clippy::float_cmp, reason = "the time of one sample")]
        (at_s == time_s).then_some(InstantValue { quantity, unit, bound, limit, value, subject })
    }

    /// A value of an instant, that of `subject`.
    pub(crate) fn instant(&self, value: f64, subject: usize) -> InstantValue {
        let Self { quantity, unit, bound, limit, .. } = *self;
        InstantValue { quantity, unit, bound, limit, value, subject }
    }

    /// The watched quantity, as measures name it.
    pub(crate) fn quantity(&self) -> Quantity {
        self.quantity
    }

    /// Limit of the quantity, in its unit.
    pub(crate) fn limit(&self) -> f64 {
        self.limit
    }

    /// The worst value so far.
    pub(crate) fn worst(&self) -> Option<f64> {
        self.worst.is_set.then_some(self.worst.value)
    }

    /// The subject of the worst value so far.
    pub(crate) fn worst_subject(&self) -> Option<usize> {
        self.worst.is_set.then_some(self.worst.subject)
    }

    /// Whether a value was outside the limit.
    pub(crate) fn is_violated(&self) -> bool {
        self.first_violation.is_set
    }

    /// The report of this quantity; `joints` are the names that go with `q`.
    pub(crate) fn measure(&self, joints: &[String], name: impl Fn(usize) -> String) -> Measure {
        let moment = |extreme: &Extreme| {
            extreme.is_set.then(|| Moment {
                time_s: extreme.time_s,
                subject: name(extreme.subject),
                value: extreme.value,
                q: JointValues::new(joints, &extreme.q),
            })
        };
        Measure {
            quantity: self.quantity,
            unit: self.unit,
            limit: self.limit,
            bound: self.bound,
            worst: moment(&self.worst),
            first_violation: moment(&self.first_violation),
        }
    }
}
