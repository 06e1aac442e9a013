//! Samples that a check of forces does not evaluate, because forces act that are not declared, with the reasons.

/// Numbers of samples that are not evaluated, by reason.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NotEvaluated {
    /// Contact, or a joint at its stop.
    pub(super) constrained: u64,
    /// A joint faster than its velocity limit.
    pub(super) fast: u64,
    /// The source of joint states has no forces.
    pub(super) unknown: u64,
    /// The equations of motion have no solution.
    pub(super) refused: u64,
}

impl NotEvaluated {
    /// Number of samples that were not evaluated, for any reason.
    pub(super) fn count(&self) -> u64 {
        self.constrained + self.fast + self.unknown + self.refused
    }

    /// Remarks on the samples that were not evaluated; `compared` samples were.
    pub(super) fn notes(&self, compared: u64) -> Vec<String> {
        let whole = [
            (self.constrained, "contact, or a joint at its stop"),
            (self.fast, "a joint faster than its velocity limit"),
            (self.unknown, "no forces known, as in playback"),
            (self.refused, "a joint without inertia, or a value that is not a number"),
        ];
        let sum = self.count();
        let mut notes: Vec<String> = whole
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, why)| format!("{count} of {} samples not evaluated: {why}", sum + compared))
            .collect();
        if sum > compared && compared > 0 {
            let samples = if compared == 1 { "sample" } else { "samples" };
            notes.push(format!("only {compared} {samples} evaluated: weak check"));
        }
        notes
    }
}
