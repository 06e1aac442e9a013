//! Samples that a check of forces leaves out, since forces act that are not declared, with the reasons.

/// Numbers of samples by the reason.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LeftOut {
    /// Contact or the stop of a joint.
    pub(super) constrained: u64,
    /// A source without forces.
    pub(super) unknown: u64,
    /// Equations that have no solution.
    pub(super) refused: u64,
}

impl LeftOut {
    /// What was left out, in words; `compared` samples were not.
    pub(super) fn notes(&self, compared: u64) -> Vec<String> {
        let whole = [
            (self.constrained, "contact or the stop of a joint acts"),
            (self.unknown, "the source does not know the forces, as in playback"),
            (self.refused, "a joint carries no inertia, or a value is no number"),
        ];
        let sum: u64 = whole.iter().map(|(count, _)| count).sum();
        let mut notes: Vec<String> = whole
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, why)| format!("{count} of {} samples are left out: {why}", sum + compared))
            .collect();
        if sum > compared && compared > 0 {
            notes.push(format!("most samples are left out: the check says little, with {compared} samples"));
        }
        notes
    }
}
