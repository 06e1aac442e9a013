//! A correction that is held, with the reason in words.

use super::{calibration_report::ReportedFixedParameter, statements};
use crate::estimation::{CorrectedChain, FixedParameter, ParameterUnit};

/// A correction that is held, as reports have it.
pub(crate) fn reported_fixed(chain: &CorrectedChain, fixed: &FixedParameter) -> ReportedFixedParameter {
    let parameters = chain.parameters();
    let terms: Vec<(&str, f64, ParameterUnit)> = fixed
        .correlated_with
        .iter()
        .map(|&(at, factor)| (parameters[at].name.as_str(), factor, parameters[at].unit()))
        .collect();
    let own = &parameters[fixed.parameter];
    ReportedFixedParameter {
        name: own.name.clone(),
        unit: own.unit(),
        held_at: chain.start()[fixed.parameter],
        correlated_with: terms.iter().map(|(name, factor, _)| ((*name).to_owned(), *factor)).collect(),
        reason: statements::why_fixed(own.unit(), &terms),
    }
}
