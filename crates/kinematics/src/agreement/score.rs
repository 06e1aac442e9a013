//! Which of several explanations is named first: a price for every free number and every part,
//! then what is left, then what is likelier to be written wrong.

use super::{
    diagnosis::Question,
    hypothesis::{Cause, Hypothesis},
    suspect::{Parameter, Suspect},
    trial::{Bench, Trial},
};

/// The order in which explanations are named; smaller is first.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    /// Free numbers, and one for each part beyond the first.
    price: usize,
    /// What is left: far below the tolerance, below it, or at it.
    left: u8,
    /// Figures that are blamed although nothing stands there.
    unwritten: usize,
    /// The causes, in the catalogue's order.
    causes: Vec<Cause>,
    /// The hypotheses, so that the order is the same on every machine.
    hypotheses: Vec<usize>,
}

pub(super) fn rank(bench: &Bench<'_>, trial: &Trial, question: &Question) -> Rank {
    let parts = || trial.hypotheses.iter().map(|&at| &bench.hypotheses[at]);
    let free: usize = parts().map(|hypothesis| hypothesis.free.len()).sum();
    let residual = trial.mended.residual(question);
    let share =
        (residual.position_m / question.position_m).max(residual.orientation_rad / question.orientation_rad);
    let mut causes: Vec<Cause> = parts().map(|hypothesis| hypothesis.cause).collect();
    causes.sort_unstable();
    Rank {
        price: free + trial.hypotheses.len() - 1,
        left: if share <= 0.1 { 0 } else { u8::from(share > 0.3) + 1 },
        unwritten: parts().filter(|hypothesis| is_unwritten(&bench.case.suspect, hypothesis)).count(),
        causes,
        hypotheses: trial.hypotheses.clone(),
    }
}

/// Whether a single figure is blamed that is zero as it stands: a zero is rarely a slip of the pen.
/// A joint's zero is not asked: tables leave it out.
fn is_unwritten(suspect: &Suspect, hypothesis: &Hypothesis) -> bool {
    if hypothesis.cause == Cause::ZeroOffset {
        return false;
    }
    match hypothesis.free[..] {
        [Parameter::Row(row, entry)] => suspect.entry(row, entry) == Some(0.0),
        [Parameter::Base(component)] => is_zero(&suspect.base.pose, component),
        [Parameter::Tool(component)] => is_zero(&suspect.tool.pose, component),
        _ => false,
    }
}

fn is_zero(pose: &crate::Pose, component: usize) -> bool {
    if component < 3 {
        pose.translation[component] == 0.0
    } else {
        crate::rotation_log(&pose.rotation)[component - 3] == 0.0
    }
}
