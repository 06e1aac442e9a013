//! Frames and clocks of recorded poses that neither the log nor the robot states, fitted to the log.

use congruent_agreement::compare::Model;
use congruent_calibration::{
    CalibrationOptions, calibrate, corrected_robot,
    measurements::{MeasuredRow, WrittenOrientation},
};
use congruent_description::{RobotDescription, RobotQ};
use congruent_input::{
    Findings,
    display::{length, quantity},
};
use congruent_monitors::ComparedPoses;
use congruent_scenario::{LoggedPoseSettings, PoseOrigin, PoseSettings};
use nalgebra::Isometry3;

use super::{
    paired::{OFFSETS_S, PairedPose, pairs},
    pose_clock::{PoseClock, PositionsOverOffsets, pose_clock},
    replayed::Replayed,
};

/// Rounds of frames and clock, each with the other's result.
const ROUNDS: usize = 3;
/// A target that turns by more while its recorded rotation stays is a point without a rotation, rad.
const TURNED_RAD: f64 = 0.05;
const SAME_ROTATION_RAD: f64 = 1e-9;

/// Fills in the frames and clocks of the poses, and says what it found.
///
/// # Errors
/// The log cannot be read.
pub(super) fn fit(
    replayed: &Replayed<'_>,
    poses: &mut [LoggedPoseSettings],
    taken: &mut Vec<String>,
) -> Result<(), Findings> {
    let is_open = |pose: &LoggedPoseSettings| pose.origin != PoseOrigin::Derived;
    if !poses.iter().any(is_open) {
        return Ok(());
    }
    let mut open: Vec<&mut LoggedPoseSettings> = poses.iter_mut().filter(|pose| is_open(pose)).collect();
    let placed: Vec<LoggedPoseSettings> =
        open.iter().map(|pose| placed(pose, replayed.description)).collect();
    let pairs = pairs(replayed, &placed)?;
    for (pose, pairs) in open.iter_mut().zip(&pairs) {
        let fitted = PoseFit { description: replayed.description, pairs };
        taken.extend(fitted.fill(pose));
    }
    Ok(())
}

/// The pose with any frame of the robot, so that its joint positions can be read.
fn placed(pose: &LoggedPoseSettings, description: &RobotDescription) -> LoggedPoseSettings {
    let base = description.robot.link(description.base).name.clone();
    LoggedPoseSettings { from_link: Some(base), ..pose.clone() }
}

/// The poses of one topic with their joint positions.
struct PoseFit<'a> {
    description: &'a RobotDescription,
    pairs: &'a [PairedPose],
}

impl PoseFit<'_> {
    /// Fills in frames and clock; returns what to say of them.
    fn fill(&self, pose: &mut LoggedPoseSettings) -> Option<String> {
        let robot = &self.description.robot;
        let link = |name: &str| {
            robot.link_indices().find(|&link| robot.link(link).name == name.trim_start_matches('/'))
        };
        let frame = pose.from_link.as_deref().or(pose.frame.as_deref()).and_then(link);
        let child = pose.child.as_deref().and_then(link);
        if self.pairs.is_empty() {
            return Some(format!(
                "{}: no pose is between two joint states, so nothing of it is compared",
                pose.topic
            ));
        }
        let topic = pose.topic.clone();
        let found = match (frame, pose.link.is_some() || child.is_some()) {
            (Some(_), true) => self.clock_of(&self.compared(pose)?),
            (Some(_), false) => self.nearest_target(pose)?,
            (None, _) => self.fit_frames(pose)?,
        };
        pose.position_only = self.is_point(&self.compared(pose)?);
        (pose.offset_s, pose.drift) = (found.offset_s, found.drift);
        let frames = match (frame.is_none(), pose.link_from_target.is_some()) {
            (true, _) => format!(
                ", in frame {:?} that was fitted to the log with the target",
                pose.frame.clone().unwrap_or_default()
            ),
            (false, true) => ", if they are those of the tip: those of the TCP are farther away".to_owned(),
            (false, false) => String::new(),
        };
        let clock = if found.offset_s == 0.0 {
            String::new()
        } else {
            let [offset, sigma] = [found.offset_s, found.sigma_s].map(|s| quantity(s, "s"));
            let drift = quantity(found.drift * 1e6, "");
            format!(
                "; its clock is taken to be {offset} (sigma {sigma}) and {drift} ppm beside that of the joints"
            )
        };
        Some(format!("{topic}: {} from the model{frames}{clock}", length(found.rms_m)))
    }

    /// What the settings are of the robot.
    fn compared(&self, pose: &LoggedPoseSettings) -> Option<ComparedPoses> {
        let robot = &self.description.robot;
        let link = |name: &str| {
            robot.link_indices().find(|&link| robot.link(link).name == name.trim_start_matches('/'))
        };
        let isometry = |pose: &PoseSettings| pose.isometry(congruent_scenario::FilePlace::nowhere()).ok();
        let tip_from_tcp = self.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        let stated = pose.link.as_deref().or(pose.child.as_deref()).and_then(link);
        let target = match &pose.link_from_target {
            Some(target) => isometry(target)?,
            None if stated.is_none() => tip_from_tcp,
            None => Isometry3::identity(),
        };
        Some(ComparedPoses {
            name: pose.topic.clone(),
            topic: pose.topic.clone(),
            origin: pose.origin,
            from_link: pose.from_link.as_deref().or(pose.frame.as_deref()).and_then(link)?,
            link_from_frame: isometry(&pose.link_from_frame)?,
            link: stated.unwrap_or(self.description.tip),
            link_from_target: target,
            frames_are_fitted: false,
            position_only: pose.position_only,
        })
    }

    /// The clock of poses whose frames are known.
    fn clock_of(&self, compared: &ComparedPoses) -> PoseClock {
        pose_clock(&self.positions(compared))
    }

    fn positions(&self, compared: &ComparedPoses) -> Vec<PositionsOverOffsets> {
        let Ok(mut model) = Model::new(self.description) else { return Vec::new() };
        let mut at = |q: &RobotQ| {
            let poses = model.root_from_links(q).ok()?;
            Some(compared.frame_from_target(poses).translation.vector)
        };
        let mut positions = Vec::with_capacity(self.pairs.len());
        for pair in self.pairs {
            let by_model: Option<Vec<_>> = pair.q.iter().map(&mut at).collect();
            let Some(by_model) = by_model else { continue };
            let recorded = pair.frame_from_target.translation.vector;
            positions.push(PositionsOverOffsets { time_s: pair.time_s, by_model, recorded });
        }
        positions
    }

    /// The messages do not name the target: it is the tip or the TCP, whichever is nearer.
    fn nearest_target(&self, pose: &mut LoggedPoseSettings) -> Option<PoseClock> {
        let of_tcp = self.clock_of(&self.compared(pose)?);
        let tip = LoggedPoseSettings {
            link: Some(self.description.robot.link(self.description.tip).name.clone()),
            link_from_target: Some(PoseSettings::default()),
            ..pose.clone()
        };
        let of_tip = self.clock_of(&self.compared(&tip)?);
        if self.description.tip_from_tcp.is_some() && of_tip.rms_m < of_tcp.rms_m {
            *pose = tip;
            return Some(of_tip);
        }
        Some(of_tcp)
    }

    /// Base and target by least squares, and the clock, in turn.
    fn fit_frames(&self, pose: &mut LoggedPoseSettings) -> Option<PoseClock> {
        let robot = &self.description.robot;
        let [base, tip] =
            [self.description.base, self.description.tip].map(|link| robot.link(link).name.clone());
        let mut clock = PoseClock::default();
        pose.position_only = self.has_one_rotation();
        for _ in 0..ROUNDS {
            let rows = self.pairs.iter().enumerate().map(|(at, pair)| row(at, pair, &clock));
            let measured = |row: MeasuredRow| MeasuredRow {
                orientation: row.orientation.filter(|_| !pose.position_only),
                ..row
            };
            let rows: Vec<MeasuredRow> = rows.map(measured).collect();
            let options = CalibrationOptions {
                free: vec!["base".to_owned(), "tool".to_owned()],
                suggestions: 0,
                ..CalibrationOptions::default()
            };
            let report = calibrate(self.description, &rows, &options).ok()?;
            let corrected = corrected_robot(self.description, &options, &report).ok()??;
            let base_from_measured = corrected
                .measured_from_base
                .map_or_else(Isometry3::identity, |of| of.to_isometry().inverse());
            let target = corrected.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
            pose.from_link = Some(base.clone());
            pose.link_from_frame = written(&base_from_measured);
            pose.link = Some(tip.clone());
            pose.link_from_target = Some(written(&target));
            pose.frames_are_fitted = true;
            clock = self.clock_of(&self.compared(pose)?);
        }
        Some(clock)
    }

    fn has_one_rotation(&self) -> bool {
        let rotations = || self.pairs.iter().map(|pair| pair.frame_from_target.rotation);
        let Some(first) = rotations().next() else { return false };
        rotations().all(|rotation| rotation.angle_to(&first) < SAME_ROTATION_RAD)
    }

    /// Whether the recorded rotation stays while that of the model turns.
    fn is_point(&self, compared: &ComparedPoses) -> bool {
        let Ok(mut model) = Model::new(self.description) else { return false };
        let mut rotation = |q: &RobotQ| {
            model.root_from_links(q).ok().map(|poses| compared.frame_from_target(poses).rotation)
        };
        let Some(first) = self.pairs.first().and_then(|pair| rotation(&pair.q[OFFSETS_S.len() / 2])) else {
            return false;
        };
        let mut turned = self.pairs.iter().filter_map(|pair| rotation(&pair.q[OFFSETS_S.len() / 2]));
        self.has_one_rotation() && turned.any(|rotation| rotation.angle_to(&first) > TURNED_RAD)
    }
}

/// A row of measurements at the time of the joints.
fn row(at: usize, pair: &PairedPose, clock: &PoseClock) -> MeasuredRow {
    let offset_s = clock.offset_s + clock.drift * pair.time_s;
    let after = OFFSETS_S.partition_point(|known| *known < offset_s).clamp(1, OFFSETS_S.len() - 1);
    let share = (offset_s - OFFSETS_S[after - 1]) / (OFFSETS_S[after] - OFFSETS_S[after - 1]);
    let mut q = pair.q[after - 1].clone();
    q.iter_mut().zip(&pair.q[after]).for_each(|(q, next)| *q += share * (next - *q));
    let rotation = pair.frame_from_target.rotation.quaternion();
    let wxyz = [rotation.w, rotation.i, rotation.j, rotation.k];
    MeasuredRow {
        line: at + 1,
        q,
        tip_in_base_m: [0, 1, 2].map(|axis| Some(pair.frame_from_target.translation.vector[axis])),
        orientation: Some(WrittenOrientation::QuaternionWxyz(wxyz)),
    }
}

fn written(pose: &Isometry3<f64>) -> PoseSettings {
    let rotation = pose.rotation.quaternion();
    PoseSettings {
        xyz_m: Some(pose.translation.vector.into()),
        quaternion_wxyz: Some([rotation.w, rotation.i, rotation.j, rotation.k]),
        ..PoseSettings::default()
    }
}
