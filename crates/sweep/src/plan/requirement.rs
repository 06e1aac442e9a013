//! `[require]`: the share of cases that must pass.

use congruent_input::Diagnostic;
use congruent_results::report::PassingShare;
use congruent_scenario::{CaseSampling, Range};

use super::written::WrittenRequirement;
use crate::codes;

/// The share that a plan requires.
pub(super) fn passing_share(
    written: WrittenRequirement,
    sampling: CaseSampling,
) -> Result<PassingShare, Diagnostic> {
    let fault = |message: String| Diagnostic::error(codes::sweep::REQUIREMENT, message);
    let WrittenRequirement { passing, confidence } = written;
    for (name, value) in [("passing", passing), ("confidence", confidence)] {
        if !Range::InnerShare.contains(value) {
            return Err(fault(format!("{name} = {value} is not above 0 and below 1")).with_help(
                "passing = 0.99 and confidence = 0.95: that every case passes, no number of cases shows",
            ));
        }
    }
    if let Some(why) = sampling.no_sample() {
        return Err(
            fault(why.to_owned()).with_help("sampling = \"latin_hypercube\", \"sobol\" or \"random\"")
        );
    }
    Ok(PassingShare { passing, confidence })
}
