//! Frames and clocks of recorded poses that neither the log nor the robot states, fitted to the log.

use congruent_agreement::compare::Model;
use congruent_calibration::{
    CalibrationOptions, calibrate, corrected_robot,
    measurements::{MeasuredRow, WrittenOrientation},
    report::Recommendation,
};
use congruent_description::{LinkIndex, RobotDescription, RobotQ};
use congruent_input::{
    Findings,
    display::{length, quantity},
};
use congruent_monitors::ComparedPoses;
use congruent_scenario::{FilePlace, LoggedPoseSettings, PoseOrigin, PoseSettings};
use nalgebra::Isometry3;

use super::{
    paired::{OFFSETS_S, PairedPose, pairs},
    pose_fit::{FittedPoses, PoseClock, PoseOverOffsets, PosesToFit},
    replayed::Replayed,
    survey_words::LEFT_OUT,
};

/// A target that turns by more while its recorded rotation stays is a point without a rotation, rad.
const TURNED_RAD: f64 = 0.05;
const SAME_ROTATION_RAD: f64 = 1e-9;

/// Fills in the frames and clocks of the poses, and says what it found. Poses of which none can be compared are taken out.
///
/// # Errors
/// The log cannot be read.
pub(super) fn fit(
    replayed: &Replayed<'_>,
    poses: &mut Vec<LoggedPoseSettings>,
    taken: &mut Vec<String>,
) -> Result<(), Findings> {
    let is_open = |pose: &LoggedPoseSettings| pose.origin != PoseOrigin::Derived;
    let placed: Vec<LoggedPoseSettings> =
        poses.iter().filter(|pose| is_open(pose)).map(|pose| placed(pose, replayed.description)).collect();
    if placed.is_empty() {
        return Ok(());
    }
    let mut pairs = pairs(replayed, &placed)?.into_iter();
    poses.retain_mut(|pose| {
        if !is_open(pose) {
            return true;
        }
        let pairs = pairs.next().unwrap_or_default();
        let fitted = PoseFit { description: replayed.description, pairs: &pairs }.fill(pose);
        let is_compared = fitted.is_ok();
        taken.push(fitted.unwrap_or_else(|why| format!("{LEFT_OUT}poses of {}: {why}", pose.topic)));
        is_compared
    });
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
    /// Fills in frames and clock; returns what to say of them, or why the poses cannot be compared.
    fn fill(&self, pose: &mut LoggedPoseSettings) -> Result<String, String> {
        let frame = pose.from_link.as_deref().or(pose.frame.as_deref()).and_then(|name| self.link(name));
        let child = pose.child.as_deref().and_then(|name| self.link(name));
        if self.pairs.is_empty() {
            return Err("no pose is between two joint states, or none has a rotation; `--clock log` orders by the times of the \
                        recorder"
                .to_owned());
        }
        let refused = || "its frames do not fit the robot".to_owned();
        pose.position_only = self.has_one_rotation();
        let found = match (frame, pose.link.is_some() || child.is_some()) {
            (Some(_), true) => self.fit_of(pose).ok_or_else(refused)?,
            (Some(_), false) => self.nearest_target(pose).ok_or_else(refused)?,
            (None, _) => self.fit_frames(pose)?,
        };
        let compared = self.compared(pose).ok_or_else(refused)?;
        pose.position_only = self.is_point(&compared);
        (pose.offset_s, pose.drift) = (found.clock.offset_s, found.clock.drift);
        // With the frames of the settings: the fitted ones of a known frame are only there for the clock.
        let over_offsets = self.over_offsets(&compared);
        let rms_m = if frame.is_none() { found.rms_m } else { rms_m(&over_offsets, &found.clock) };
        let frames = match (frame.is_none(), pose.link_from_target.is_some()) {
            (true, _) => {
                let frame = pose.frame.clone().unwrap_or_default();
                format!(", in frame \"{frame}\", which was fitted to the log together with the target")
            }
            (false, true) => {
                ", taken as poses of the tip: the TCP of the robot file is farther away".to_owned()
            }
            (false, false) => String::new(),
        };
        Ok(format!("{}: {} (rms) from the model{frames}{}", pose.topic, length(rms_m), clock_words(&found)))
    }

    fn link(&self, name: &str) -> Option<LinkIndex> {
        let robot = &self.description.robot;
        robot.link_indices().find(|&link| robot.link(link).name == name.trim_start_matches('/'))
    }

    /// What the settings are of the robot.
    fn compared(&self, pose: &LoggedPoseSettings) -> Option<ComparedPoses> {
        let isometry = |pose: &PoseSettings| pose.isometry(FilePlace::nowhere()).ok();
        let tip_from_tcp = self.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        let stated = pose.link.as_deref().or(pose.child.as_deref()).and_then(|name| self.link(name));
        let target = match &pose.link_from_target {
            Some(target) => isometry(target)?,
            None if stated.is_none() => tip_from_tcp,
            None => Isometry3::identity(),
        };
        Some(ComparedPoses {
            name: pose.topic.clone(),
            topic: pose.topic.clone(),
            origin: pose.origin,
            from_link: pose
                .from_link
                .as_deref()
                .or(pose.frame.as_deref())
                .and_then(|name| self.link(name))?,
            link_from_frame: isometry(&pose.link_from_frame)?,
            link: stated.unwrap_or(self.description.tip),
            link_from_target: target,
            frames_are_fitted: false,
            position_only: pose.position_only,
            offset_s: pose.offset_s,
        })
    }

    fn over_offsets(&self, compared: &ComparedPoses) -> Vec<PoseOverOffsets> {
        over_offsets(self.description, compared, self.pairs)
    }

    /// Frames and clock from the frames of the settings on.
    fn fit_of(&self, pose: &LoggedPoseSettings) -> Option<FittedPoses> {
        let poses = self.over_offsets(&self.compared(pose)?);
        Some(PosesToFit { poses: &poses, with_rotations: !pose.position_only }.fit())
    }

    /// The messages do not name the target: it is the tip or the TCP, whichever is nearer.
    fn nearest_target(&self, pose: &mut LoggedPoseSettings) -> Option<FittedPoses> {
        let of_tcp = self.fit_of(pose)?;
        let tip = LoggedPoseSettings {
            link: Some(self.description.robot.link(self.description.tip).name.clone()),
            link_from_target: Some(PoseSettings::default()),
            ..pose.clone()
        };
        let distance = |pose: &LoggedPoseSettings| -> Option<f64> {
            Some(rms_m(&self.over_offsets(&self.compared(pose)?), &of_tcp.clock))
        };
        if self.description.tip_from_tcp.is_some() && distance(&tip)? < distance(pose)? {
            *pose = tip;
        }
        Some(of_tcp)
    }

    /// Base and target in closed form, then by least squares together with the clock.
    fn fit_frames(&self, pose: &mut LoggedPoseSettings) -> Result<FittedPoses, String> {
        let robot = &self.description.robot;
        let [base, tip] =
            [self.description.base, self.description.tip].map(|link| robot.link(link).name.clone());
        let rows: Vec<MeasuredRow> = self
            .pairs
            .iter()
            .enumerate()
            .map(|(at, pair)| MeasuredRow {
                line: at + 1,
                q: pair.q[OFFSETS_S.len() / 2].clone(),
                tip_in_base_m: [0, 1, 2].map(|axis| Some(pair.frame_from_target.translation.vector[axis])),
                orientation: (!pose.position_only).then(|| orientation(&pair.frame_from_target)),
            })
            .collect();
        let options = CalibrationOptions {
            free: vec!["base".to_owned(), "tool".to_owned()],
            suggestions: 0,
            ..CalibrationOptions::default()
        };
        let mut report = calibrate(self.description, &rows, &options).map_err(|error| error.message)?;
        // Whether the model is right is what the run judges: here any base and target will do.
        report.recommended = Recommendation::LeastSquares;
        let corrected =
            corrected_robot(self.description, &options, &report).map_err(|error| error.message)?;
        let corrected = corrected.ok_or("its frame cannot be fitted to the robot")?;
        let base_from_measured =
            corrected.measured_from_base.map_or_else(Isometry3::identity, |of| of.to_isometry().inverse());
        let target = corrected.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
        pose.from_link = Some(base);
        pose.link = Some(tip);
        pose.frames_are_fitted = true;
        pose.link_from_frame = written(&base_from_measured);
        pose.link_from_target = Some(written(&target));
        let found = self.fit_of(pose).ok_or("its frame cannot be fitted to the robot")?;
        pose.link_from_frame = written(&(base_from_measured * found.frame.inverse()));
        pose.link_from_target = Some(written(&(target * found.target)));
        Ok(found)
    }

    fn has_one_rotation(&self) -> bool {
        let rotations = || self.pairs.iter().map(|pair| pair.frame_from_target.rotation);
        let Some(first) = rotations().next() else { return false };
        self.pairs.len() > 1 && rotations().all(|rotation| rotation.angle_to(&first) < SAME_ROTATION_RAD)
    }

    /// Whether the recorded rotation stays while that of the model turns.
    fn is_point(&self, compared: &ComparedPoses) -> bool {
        let Ok(mut model) = Model::new(self.description) else { return false };
        let mut rotation = |q: &RobotQ| {
            model.root_from_links(q).ok().map(|poses| compared.frame_from_target(poses).rotation)
        };
        let middle = OFFSETS_S.len() / 2;
        let Some(first) = self.pairs.first().and_then(|pair| rotation(&pair.q[middle])) else {
            return false;
        };
        let mut turned = self.pairs.iter().filter_map(|pair| rotation(&pair.q[middle]));
        self.has_one_rotation() && turned.any(|rotation| rotation.angle_to(&first) > TURNED_RAD)
    }
}

fn rms_m(poses: &[PoseOverOffsets], clock: &PoseClock) -> f64 {
    let squares: f64 = poses.iter().map(|at| at.distance_m(clock).powi(2)).sum();
    #[expect(clippy::cast_precision_loss, reason = "some hundred")]
    let mean = squares / poses.len().max(1) as f64;
    mean.sqrt()
}

/// The poses with those of the model at each offset.
pub(super) fn over_offsets(
    description: &RobotDescription,
    compared: &ComparedPoses,
    pairs: &[PairedPose],
) -> Vec<PoseOverOffsets> {
    let Ok(mut model) = Model::new(description) else { return Vec::new() };
    let mut at = |q: &RobotQ| Some(compared.frame_from_target(model.root_from_links(q).ok()?));
    let over = pairs.iter().filter_map(|pair| {
        let by_model: Vec<Isometry3<f64>> = pair.q.iter().map(&mut at).collect::<Option<_>>()?;
        Some(PoseOverOffsets { time_s: pair.time_s, by_model, recorded: pair.frame_from_target })
    });
    over.collect()
}

/// An orientation as measurements have it.
pub(super) fn orientation(pose: &Isometry3<f64>) -> WrittenOrientation {
    let rotation = pose.rotation.quaternion();
    WrittenOrientation::QuaternionWxyz([rotation.w, rotation.i, rotation.j, rotation.k])
}

/// The clock, if it is another one, for a line.
fn clock_words(found: &FittedPoses) -> String {
    let clock = &found.clock;
    if clock.offset_s == 0.0 {
        return String::new();
    }
    let [offset, sigma] = [clock.offset_s, clock.sigma_s].map(|s| quantity(s * 1e3, "ms"));
    let drift = if clock.drift == 0.0 {
        String::new()
    } else {
        format!(" and {} ppm", quantity(clock.drift * 1e6, ""))
    };
    format!(
        "; its times are corrected by {offset} (standard deviation {sigma}){drift}: another clock than that of the joints"
    )
}

fn written(pose: &Isometry3<f64>) -> PoseSettings {
    let rotation = pose.rotation.quaternion();
    PoseSettings {
        xyz_m: Some(pose.translation.vector.into()),
        quaternion_wxyz: Some([rotation.w, rotation.i, rotation.j, rotation.k]),
        ..PoseSettings::default()
    }
}
