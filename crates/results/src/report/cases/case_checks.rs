//! What is kept of a case: the outcome of each check, and its worst values.

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::{Bound, CheckResult, Status};
use congruent_scenario::CheckKind;

/// The checks of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseChecks {
    /// Number of the case, from 0.
    pub case: u64,
    /// The checks in the order of the scenario, or why there is no result of the whole run.
    pub checks: Result<Vec<CheckOfCase>, String>,
}

/// One check of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckOfCase {
    pub(super) kind: CheckKind,
    pub(super) is_default: bool,
    pub(super) status: Status,
    pub(super) values: Vec<ValueOfCase>,
}

/// The worst value of a quantity in a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ValueOfCase {
    pub(super) quantity: Quantity,
    pub(super) unit: SiUnit,
    pub(super) bound: Bound,
    pub(super) limit: f64,
    /// Whether it is the smallest distance of the pairs whose distance changes in the run.
    pub(super) is_of_changing_pairs: bool,
    pub(super) value: f64,
}

impl CaseChecks {
    /// What is kept of the run of a case that had these checks, and that ended with an error if there is one.
    pub fn new(case: u64, checks: &[CheckResult], error: Option<&str>) -> Self {
        let checks = match error {
            Some(error) => Err(error.to_owned()),
            None => Ok(checks.iter().map(CheckOfCase::new).collect()),
        };
        Self { case, checks }
    }
}

impl CheckOfCase {
    fn new(check: &CheckResult) -> Self {
        let mut values: Vec<ValueOfCase> = Vec::new();
        for measure in &check.measures {
            let Some(moment) = &measure.worst else { continue };
            let found = ValueOfCase {
                quantity: measure.quantity,
                unit: measure.unit,
                bound: measure.bound,
                limit: measure.limit,
                is_of_changing_pairs: false,
                value: moment.value,
            };
            // A check that fails may have a measure for each pair or link: the worst of them is the check's.
            match values.iter_mut().find(|known| known.quantity == found.quantity) {
                Some(known) if known.bound.is_worse(found.value, known.value) => *known = found,
                Some(_) => {}
                None => values.push(found),
            }
        }
        if let (Some(&first), Some(changing)) = (values.first(), &check.nearest_that_changes) {
            values.push(ValueOfCase { is_of_changing_pairs: true, value: changing.value, ..first });
        }
        Self { kind: check.check, is_default: check.is_default, status: check.status, values }
    }
}
