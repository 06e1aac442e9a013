//! The injected faults against the named causes.

use std::{collections::BTreeMap, fmt};

use congruent_agreement::diagnosis::{Cause, Diagnosis, Equivalence, ExplainedFault, Explanation};

use crate::faults::InjectedFault;

/// The result of a diagnosis for the faults that were injected.
pub(crate) struct Outcome {
    named: Cause,
    verdict: Verdict,
    faults: Vec<ExplainedFault>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Verdict {
    /// The first cause is the true one, in its place.
    First,
    /// The true one is listed as indistinguishable from the first.
    Listed,
    /// Two faults that a single one explains within the tolerance.
    Simpler,
    Missed,
}

impl Outcome {
    pub(crate) fn from_diagnosis(diagnosis: &Diagnosis, faults: &[&InjectedFault]) -> Self {
        let first = &diagnosis.explanations[0];
        let verdict = if is_true(first, faults) {
            Verdict::First
        } else if is_listed(diagnosis, faults) {
            Verdict::Listed
        } else if !first.faults.is_empty() && first.faults.len() < faults.len() {
            Verdict::Simpler
        } else {
            Verdict::Missed
        };
        Self { named: first.cause(), verdict, faults: first.faults.clone() }
    }
}

/// Whether the true cause is listed as indistinguishable from the first; a cause that is only also within the
/// tolerance does not count.
fn is_listed(diagnosis: &Diagnosis, faults: &[&InjectedFault]) -> bool {
    let mut equal = diagnosis
        .indistinguishable
        .iter()
        .filter(|(_, equivalence)| *equivalence != Equivalence::WithinTolerance);
    equal.any(|(each, _)| is_true(each, faults))
}

fn is_true(explanation: &Explanation, faults: &[&InjectedFault]) -> bool {
    let has = |fault: &&InjectedFault| {
        explanation.faults.iter().any(|named| named.cause == fault.cause && named.place == fault.place)
    };
    explanation.faults.len() == faults.len() && faults.iter().all(has)
}

/// Counts of results for each injected cause.
#[derive(Default)]
pub(crate) struct Matrix {
    named: BTreeMap<(String, Cause), usize>,
    verdicts: BTreeMap<(String, Verdict), usize>,
    missed: Vec<String>,
}

impl Matrix {
    pub(crate) fn count(&mut self, robot: &str, faults: &[&InjectedFault], outcome: &Outcome) {
        let injected: Vec<String> = faults.iter().map(|fault| fault.cause.to_string()).collect();
        let label = if faults.len() == 1 { injected[0].clone() } else { "pair".to_owned() };
        if outcome.verdict == Verdict::Missed {
            let places: Vec<_> = faults.iter().map(|fault| &fault.place).collect();
            self.missed.push(format!("{robot}: {injected:?} at {places:?}, named {:?}", outcome.faults));
        }
        *self.named.entry((label.clone(), outcome.named)).or_default() += 1;
        *self.verdicts.entry((label, outcome.verdict)).or_default() += 1;
    }

    /// Faults that were neither named nor listed.
    pub(crate) fn missed(&self) -> &[String] {
        &self.missed
    }

    /// Share of faults that were named first, listed, or explained by something simpler.
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    pub(crate) fn explained(&self) -> f64 {
        let all: usize = self.verdicts.values().sum();
        1.0 - self.missed.len() as f64 / all as f64
    }
}

impl fmt::Display for Matrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut labels: Vec<&String> = self.verdicts.keys().map(|(label, _)| label).collect();
        labels.dedup();
        writeln!(
            f,
            "{:22} {:>6} {:>6} {:>7} {:>6}  named",
            "injected", "first", "listed", "simpler", "missed"
        )?;
        for label in labels {
            let count = |verdict| self.verdicts.get(&(label.clone(), verdict)).copied().unwrap_or_default();
            let of = |((injected, _), _): &(&(String, Cause), &usize)| injected == label;
            let named: Vec<String> =
                self.named.iter().filter(of).map(|((_, cause), count)| format!("{cause} {count}")).collect();
            writeln!(
                f,
                "{label:22} {:6} {:6} {:7} {:6}  {}",
                count(Verdict::First),
                count(Verdict::Listed),
                count(Verdict::Simpler),
                count(Verdict::Missed),
                named.join(", ")
            )?;
        }
        let all: usize = self.verdicts.values().sum();
        writeln!(f, "{all} faults, {:.2} % explained", 100.0 * self.explained())?;
        self.missed.iter().take(40).try_for_each(|missed| writeln!(f, "missed {missed}"))
    }
}
