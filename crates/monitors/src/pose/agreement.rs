//! Model against twin: position and orientation of every link, at every sample.

use congruent_description::{RobotDescription, Tolerance};
use congruent_input::{Quantity, SiUnit};
use congruent_scenario::{AgreementCheck, Check};

use crate::{
    Names,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// The limits of agreement that a picture or a plot of a run is for: the tightest of its checks, each part by itself, or else those
/// of the robot file.
pub fn agreement_tolerance(checks: &[Check], declared: Tolerance) -> Tolerance {
    let tightest = |part: usize, declared: f64| {
        let limits = checks.iter().filter_map(|check| match check {
            Check::Agreement(check) => check.limits()[part],
            _ => None,
        });
        limits.min_by(f64::total_cmp).unwrap_or(declared)
    };
    Tolerance {
        position_m: tightest(0, declared.position_m),
        orientation_rad: tightest(1, declared.orientation_rad),
    }
}

pub(crate) struct AgreementMonitor {
    position: Watch,
    orientation: Watch,
    samples: u64,
    has_table: bool,
}

impl AgreementMonitor {
    /// Limits that are not given are the robot file's tolerance.
    pub(crate) fn new(check: &AgreementCheck, description: &RobotDescription) -> Self {
        let dof = description.robot.dof();
        let [position_m, orientation_rad] = check.limits();
        let position_m = position_m.unwrap_or(description.tolerance.position_m);
        let orientation_rad = orientation_rad.unwrap_or(description.tolerance.orientation_rad);
        Self {
            position: Watch::new(Quantity::Position, SiUnit::Metre, Bound::AtMost, position_m, dof),
            orientation: Watch::new(
                Quantity::Orientation,
                SiUnit::Radian,
                Bound::AtMost,
                orientation_rad,
                dof,
            ),
            samples: 0,
            has_table: description.dh.is_some(),
        }
    }
}

impl AgreementMonitor {
    /// A remark if the model comes from the URDF itself, so that no table was checked.
    fn notes(&self) -> Vec<String> {
        let note = "no table: the kinematics of the URDF was compared with the physics";
        if self.has_table { Vec::new() } else { vec![note.to_owned()] }
    }
}

impl Monitor for AgreementMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        for (link, error) in sample.errors.iter().enumerate() {
            self.position.observe(error.position_m, link, sample);
            self.orientation.observe(error.orientation_rad, link, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |link: usize| names.links[link].clone();
        Observed {
            samples: self.samples,
            measures: vec![
                self.position.measure(&names.joints, name),
                self.orientation.measure(&names.joints, name),
            ],
            notes: self.notes(),
            ..Observed::default()
        }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        [&self.position, &self.orientation].into_iter().filter_map(|watch| watch.at(time_s)).for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.position.is_violated() || self.orientation.is_violated()
    }
}
