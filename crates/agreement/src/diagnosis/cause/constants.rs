//! `base` and `tool`: a declared transform is off in one component, in its translation, in its rotation, or
//! in all components. Fewer components cost less, so that one wrong value is not explained by six.

use std::ops::Range;

use crate::diagnosis::{
    candidate::ModelParameter,
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

pub(super) fn hypotheses(_: &ModelPair) -> Vec<PoseHypothesis> {
    let single = (0..6).map(|component| component..component + 1);
    let parts: Vec<Range<usize>> = single.chain([0..3, 3..6, 0..6]).collect();
    let tool = |part: &Range<usize>| {
        PoseHypothesis::fit(Cause::Tool, FaultPlace::Tool, part.clone().map(ModelParameter::Tool).collect())
    };
    let base = |part: &Range<usize>| {
        PoseHypothesis::fit(Cause::Base, FaultPlace::Base, part.clone().map(ModelParameter::Base).collect())
    };
    parts.iter().map(tool).chain(parts.iter().map(base)).collect()
}
