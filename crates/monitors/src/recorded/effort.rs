//! Recorded efforts against inverse dynamics at the recorded motion: with friction, armature, a delay and a factor for each joint, the
//! unexplained part of their variance, and what they are: torques, torques without gravity, or currents.

use congruent_identification::{EffortFit, EffortKind, RecognisedEffort, RecordedRow};
use congruent_input::{
    Quantity, SiUnit,
    display::{listed, number},
};
use congruent_scenario::EffortCheck;

use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::Watch,
};

/// Default limit. Kind: measured; 0.02 of a UR5e, 0.3 of the worst joint of a Panda, nearly 1 of another robot.
pub(crate) const UNEXPLAINED_SHARE: f64 = 0.5;

pub(crate) struct RecordedEffortMonitor {
    fit: EffortFit,
    /// The driven joints, among the moving ones.
    joints: Vec<usize>,
    share: Watch,
    samples: u64,
    found: Option<RecognisedEffort>,
}

impl RecordedEffortMonitor {
    pub(crate) fn new(check: &EffortCheck, context: &CheckContext<'_>) -> Self {
        let tree = context.dynamics.clone().at(0.0).0.clone();
        let limit = check.unexplained_share.unwrap_or(UNEXPLAINED_SHARE);
        Self {
            joints: tree.driven_joints().to_vec(),
            fit: EffortFit::new(tree, context.clock.step_s),
            share: Watch::new(Quantity::UnexplainedShare, SiUnit::Ratio, Bound::AtMost, limit, context.dof()),
            samples: 0,
            found: None,
        }
    }

    fn notes(&self, names: &Names) -> Vec<String> {
        let Some(found) = &self.found else { return Vec::new() };
        match found.kind {
            EffortKind::None => {
                vec!["the log has no efforts of a joint that moves, or they do not change".to_owned()]
            }
            EffortKind::Torque => vec!["efforts are torques".to_owned()],
            EffortKind::TorqueWithoutGravity => {
                vec!["efforts are torques without those of gravity".to_owned()]
            }
            EffortKind::Unknown => {
                vec!["efforts are neither torques nor currents by the masses of the description".to_owned()]
            }
            EffortKind::Current => {
                let constants = self.joints.iter().zip(&found.factors).filter_map(|(&joint, factor)| {
                    let (factor, error) = (*factor)?;
                    Some(format!("{} {} ± {}", names.joints[joint], number(factor), number(error)))
                });
                let constants: Vec<String> = constants.collect();
                let constants: Vec<&str> = constants.iter().map(String::as_str).collect();
                vec![format!("efforts are currents; torque for a unit of each: {}", listed(&constants))]
            }
        }
    }
}

/// Which of the parts that are left counts for a kind.
fn part(kind: EffortKind) -> usize {
    match kind {
        EffortKind::Torque => 0,
        EffortKind::TorqueWithoutGravity => 1,
        EffortKind::Current | EffortKind::None | EffortKind::Unknown => 2,
    }
}

impl Monitor for RecordedEffortMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if sample.since_s.is_none() {
            self.fit.break_here();
        }
        let effort = sample.joints.recorded_effort;
        if !effort.is_empty() {
            self.samples += 1;
            self.fit.push(RecordedRow { time_s: sample.time_s, q: sample.joints.measured.q, effort });
        }
        if sample.is_last {
            self.end(sample);
        }
    }

    fn end(&mut self, sample: &Sample<'_>) {
        let found = self.fit.recognised();
        for (&joint, left) in self.joints.iter().zip(&found.left_of_joints) {
            if let Some(left) = left {
                self.share.observe(left[part(found.kind)], joint, sample);
            }
        }
        self.found = Some(found);
    }

    fn finish(&self, names: &Names) -> Observed {
        let is_judged = self.found.as_ref().is_some_and(|found| found.kind != EffortKind::None);
        Observed {
            samples: if is_judged { self.samples } else { 0 },
            measures: vec![self.share.measure(&names.joints, |joint| names.joints[joint].clone())],
            notes: self.notes(names),
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.share.is_violated()
    }
}
