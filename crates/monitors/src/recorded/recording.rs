//! How much of the log could be used: instants at which every joint is known, and the longest time without a sample.

use congruent_input::{Quantity, SiUnit, display::quantity};
use congruent_scenario::RecordingCheck;

use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::{Interruption, LeftOutInstants, Sample},
    verdict::Bound,
    watch::Watch,
};

/// Default for the smallest share of instants that are used. Kind: judgement; a log of which a tenth is missing is not one of the
/// whole motion.
pub(crate) const USED_SHARE: f64 = 0.9;

pub(crate) struct RecordingMonitor {
    share: Watch,
    longest: Watch,
    samples: u64,
    left_out: LeftOutInstants,
    gaps: u64,
    gap_s: f64,
    before_s: f64,
    begin_s: f64,
    /// Parts behind the first, and the time between parts, which nobody has recorded.
    parts: u64,
    between_parts_s: f64,
    /// Joints between base and tip that no instant has.
    unknown: Vec<String>,
    /// The period of the samples, as a rule.
    period_s: f64,
}

impl RecordingMonitor {
    pub(crate) fn new(check: &RecordingCheck, context: &CheckContext<'_>) -> Self {
        let watch = |quantity, unit, bound, limit| Watch::new(quantity, unit, bound, limit, context.dof());
        let used = check.used_share.unwrap_or(USED_SHARE);
        let longest_s = check.longest_gap_s.unwrap_or(f64::INFINITY);
        Self {
            share: watch(Quantity::UsedShare, SiUnit::Ratio, Bound::AtLeast, used),
            longest: watch(Quantity::LongestGap, SiUnit::Second, Bound::AtMost, longest_s),
            samples: 0,
            left_out: LeftOutInstants::default(),
            gaps: 0,
            gap_s: 0.0,
            before_s: f64::NAN,
            begin_s: f64::NAN,
            parts: 0,
            between_parts_s: 0.0,
            unknown: context.unknown.to_vec(),
            period_s: context.clock.step_s,
        }
    }

    /// The share of the time in which samples are: without gaps, and without instants that were left out elsewhere.
    fn used_share(&self) -> f64 {
        if !self.unknown.is_empty() {
            // No instant has every joint.
            return 0.0;
        }
        let all_s = self.before_s - self.begin_s - self.between_parts_s;
        let LeftOutInstants { incomplete, unusable } = self.left_out;
        #[expect(clippy::cast_precision_loss, reason = "no log has 2^52 samples")]
        let left_out = (incomplete + unusable) as f64 / self.instants() as f64;
        let in_gaps = if all_s > 0.0 { (self.gap_s - self.period_s).max(0.0) / all_s } else { 0.0 };
        1.0 - left_out.max(in_gaps)
    }

    /// Instants that there would be if each message could be used.
    fn instants(&self) -> u64 {
        self.samples + self.left_out.incomplete + self.left_out.unusable
    }

    fn leave_out(&mut self, left_out: LeftOutInstants) {
        self.left_out.incomplete += left_out.incomplete;
        self.left_out.unusable += left_out.unusable;
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.unknown.is_empty() {
            notes.push(format!(
                "never in the log, though between base and tip: {}; name under [source] as `held` what stayed at its [start]",
                self.unknown.join(", ")
            ));
        }
        let LeftOutInstants { incomplete, unusable } = self.left_out;
        let all = self.instants();
        if incomplete > 0 {
            notes.push(format!("{incomplete} of {all} instants left out: a joint is not known at them"));
        }
        if unusable > 0 {
            notes.push(format!(
                "{unusable} of {all} messages not used: unreadable, late, lost, or at a time that does not advance"
            ));
        }
        if self.parts > 0 {
            let parts = self.parts + 1;
            notes.push(format!(
                "{parts} parts, between which the clock goes back: each follows the one before by a second"
            ));
        }
        if self.gaps > 0 {
            let gaps = if self.gaps == 1 { "gap" } else { "gaps" };
            let total = quantity(self.gap_s, "s");
            notes.push(format!("{} {gaps} of {total} in all: nothing is judged in them", self.gaps));
        }
        notes
    }
}

impl Monitor for RecordingMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        self.leave_out(sample.left_out);
        if self.before_s.is_nan() {
            self.begin_s = sample.time_s;
        } else if sample.interruption == Some(Interruption::NewPart) {
            self.parts += 1;
            self.between_parts_s += sample.time_s - self.before_s;
        } else {
            let since_s = sample.time_s - self.before_s;
            self.longest.observe(since_s, 0, sample);
            if sample.interruption == Some(Interruption::Gap) {
                self.gaps += 1;
                self.gap_s += since_s;
            }
        }
        self.before_s = sample.time_s;
        if sample.is_last {
            self.end(sample);
        }
    }

    fn end(&mut self, sample: &Sample<'_>) {
        // Nobody has seen what the robot did after its last sample.
        self.leave_out(sample.left_out_after);
        self.share.observe(self.used_share(), 0, sample);
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |_| "the log".to_owned();
        let longest = Some(&self.longest).filter(|watch| watch.limit().is_finite());
        let watches = std::iter::once(&self.share).chain(longest);
        Observed {
            samples: self.samples,
            measures: watches.map(|watch| watch.measure(&names.joints, name)).collect(),
            notes: self.notes(),
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.share.is_violated() || self.longest.is_violated()
    }
}
