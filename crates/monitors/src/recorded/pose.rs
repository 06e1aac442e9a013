//! Recorded poses against those of the model at the joint positions of the same instant.

use congruent_input::{Quantity, SiUnit, display::quantity};
use congruent_kinematics::{Pose, PoseError};
use congruent_scenario::{PoseCheck, PoseOrigin};

use crate::{
    CheckContext, ComparedPoses, Names, PoseSample,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::{Watch, WatchedInstant},
};

/// Default limits: m and rad. Kind: measured; nominal models of arms of one make differ from their controllers by up to 1.7 mm and
/// 4.5 mrad (UR), and from trackers by 2.1 mm (UR10, ABB IRB 120).
const POSITION_M: f64 = 2e-3;
const ORIENTATION_RAD: f64 = 0.01;

/// The default limits, m and rad.
pub(crate) fn default_limits() -> [f64; 2] {
    [POSITION_M, ORIENTATION_RAD]
}

pub(crate) struct PoseMonitor<'a> {
    poses: &'a [ComparedPoses],
    position: Watch,
    orientation: Watch,
    /// Poses of each selection.
    compared: Vec<u64>,
    /// The worst pose since the sample before, for the position and for the orientation: value and selection.
    pending: [Option<(f64, usize)>; 2],
    /// The same up to the sample that was seen last.
    latest: [Option<(f64, usize)>; 2],
}

impl<'a> PoseMonitor<'a> {
    pub(crate) fn new(check: &PoseCheck, context: &CheckContext<'a>) -> Self {
        let [position_m, orientation_rad] = check.limits();
        let watch = |quantity, unit, limit| Watch::new(quantity, unit, Bound::AtMost, limit, context.dof());
        Self {
            poses: context.poses,
            position: watch(Quantity::Position, SiUnit::Metre, position_m.unwrap_or(POSITION_M)),
            orientation: watch(
                Quantity::Orientation,
                SiUnit::Radian,
                orientation_rad.unwrap_or(ORIENTATION_RAD),
            ),
            compared: vec![0; context.poses.len()],
            pending: [None; 2],
            latest: [None; 2],
        }
    }

    /// How many poses of a topic were compared, and what poses of that origin cannot show.
    fn notes(&self) -> Vec<String> {
        let mut topics: Vec<(&ComparedPoses, u64, u64)> = Vec::new();
        for (poses, &compared) in self.poses.iter().zip(&self.compared) {
            let is_same = |of: &ComparedPoses| of.topic == poses.topic && of.origin == poses.origin;
            match topics.iter_mut().find(|(of, ..)| is_same(of)) {
                Some((_, frames, all)) => (*frames, *all) = (*frames + 1, *all + compared),
                None => topics.push((poses, 1, compared)),
            }
        }
        let note = |(poses, frames, compared): (&ComparedPoses, u64, u64)| {
            let frames = if frames > 1 { format!(" of {frames} frames") } else { String::new() };
            format!("{}: {compared} poses{frames}, {}", poses.topic, shows(poses))
        };
        topics.into_iter().map(note).collect()
    }
}

/// What poses of an origin show.
fn shows(poses: &ComparedPoses) -> String {
    let shows = match poses.origin {
        PoseOrigin::Derived => {
            "computed from the same joints by a URDF: they show whether it is this robot, nothing of the arm"
        }
        PoseOrigin::Controller => {
            "computed by the controller from the same encoders: no error of an encoder can be seen"
        }
        PoseOrigin::Measured => "measured",
    };
    let fitted = if poses.frames_are_fitted {
        "; base and target were fitted to this log, so a constant error of either is not found"
    } else {
        ""
    };
    let clock = if poses.offset_s == 0.0 {
        String::new()
    } else {
        format!(
            "; their times were corrected by {}, since their clock is another one than that of the joints",
            quantity(poses.offset_s * 1e3, "ms")
        )
    };
    format!("{shows}{fitted}{clock}")
}

impl Monitor for PoseMonitor<'_> {
    fn observe(&mut self, _sample: &mut Sample<'_>) {
        self.latest = std::mem::take(&mut self.pending);
    }

    fn observe_pose(&mut self, pose: &PoseSample<'_>) {
        let compared = &self.poses[pose.of];
        self.compared[pose.of] += 1;
        let by_model = Pose::from(compared.frame_from_target(pose.root_from_links));
        let PoseError { position_m, orientation_rad } =
            PoseError::to_isometry(&by_model, &pose.frame_from_target);
        let instant = WatchedInstant { time_s: pose.time_s, q: pose.q };
        self.position.observe_at(position_m, pose.of, instant);
        keep_worst(&mut self.pending[0], position_m, pose.of);
        if !compared.position_only {
            self.orientation.observe_at(orientation_rad, pose.of, instant);
            keep_worst(&mut self.pending[1], orientation_rad, pose.of);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |of: usize| self.poses[of].name.clone();
        let with_orientation = self.poses.iter().any(|poses| !poses.position_only);
        let watches = [Some(&self.position), with_orientation.then_some(&self.orientation)];
        Observed {
            samples: self.compared.iter().sum(),
            measures: watches.into_iter().flatten().map(|watch| watch.measure(&names.joints, name)).collect(),
            notes: self.notes(),
            ..Observed::default()
        }
    }

    fn values(&self, _time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        let watches = [&self.position, &self.orientation].into_iter().zip(self.latest);
        watches
            .filter_map(|(watch, latest)| latest.map(|(value, of)| watch.instant(value, of)))
            .for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.position.is_violated() || self.orientation.is_violated()
    }
}

/// Keeps the larger value; NaN counts as larger than every number.
fn keep_worst(worst: &mut Option<(f64, usize)>, value: f64, of: usize) {
    if worst.is_none_or(|(known, _)| Bound::AtMost.is_worse(value, known)) {
        *worst = Some((value, of));
    }
}
