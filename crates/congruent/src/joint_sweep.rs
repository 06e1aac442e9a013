//! A recording of a robot whose joints move one after another, each over its range: `congruent view ROBOT`.

use std::{f64::consts::PI, path::PathBuf};

use congruent_description::{JointKind, Robot, RobotDescription, RobotQ};
use congruent_input::Findings;
use congruent_monitors::{JointSample, JointStateView};
use congruent_recording::RerunFormat;
use congruent_results::{
    RecordingFormat,
    files::{FolderError, OutputFolder},
    record,
    report::{AfterRun, diagnose_run},
};
use congruent_scenario::{AgreementCheck, Check, Scenario, SimulationSettings};
use congruent_twin::{
    Run, RunError, RunSetup,
    source::{Advance, JointStateSource, SourceError},
};
use schemars::JsonSchema;
use serde::Serialize;

/// Time for the range of one joint: down, up and back.
const JOINT_S: f64 = 4.0;
/// Time between two samples, all of which are recorded.
const STEP_S: f64 = 0.01;
/// A joint with a wider range of turns has none: descriptions write large numbers for it.
const WIDEST_RAD: f64 = 8.0 * PI;
/// A joint with a wider range of shifts has none. Unit: m. Kind: choice.
const WIDEST_M: f64 = 100.0;

/// The report of `congruent view ROBOT`: the recording, and how each joint was moved in it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointSweep {
    /// Name and version of this format.
    pub format: &'static str,
    /// Name of the robot.
    pub robot: String,
    /// Path of the recording (.rrd).
    pub recording: PathBuf,
    /// Duration of the recording. Unit: s.
    pub duration_s: f64,
    /// Every joint that can be moved by itself, in the order in which they move.
    pub joints: Vec<SweptJoint>,
    /// Joints that follow others.
    pub follow: Vec<String>,
    /// Whether model and URDF agree at every sample within the robot file's tolerance.
    pub agrees: bool,
}

/// A joint that moves over its range, or why it does not.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweptJoint {
    /// Name of the joint, as in the URDF.
    pub joint: String,
    /// Unit of its position: `rad` or `m`.
    pub unit: &'static str,
    /// Position at which it begins and ends.
    pub start: f64,
    /// The positions between which it moves; the same if it stays.
    pub range: [f64; 2],
    /// Time at which it begins to move, from the start of the recording. Unit: s.
    pub from_s: f64,
    /// Time at which it is back at its start. Unit: s.
    pub until_s: f64,
    /// What decided the range, if it is not that of the description.
    pub note: Option<String>,
}

/// Why there is no recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The robot cannot be drawn.
    #[error(transparent)]
    Robot(#[from] Findings),
    /// The samples cannot be computed or written.
    #[error(transparent)]
    Run(#[from] RunError),
    /// There is no folder for the recording.
    #[error(transparent)]
    Folder(#[from] FolderError),
}

/// Records the robot while each joint in turn moves over its range, in a folder of the robot's name in `out`. Nothing acts on
/// the robot: it needs no masses.
///
/// # Errors
/// [`SweepError`] if the robot has no model, or the recording cannot be written.
pub fn joint_sweep(description: RobotDescription, out: &std::path::Path) -> Result<JointSweep, SweepError> {
    let robot = &description.robot;
    let name = format!("{}_joints", robot.name());
    let (joints, follow) = swept(robot);
    let duration_s = joints.last().map_or(0.0, |joint| joint.until_s).max(STEP_S);
    let scenario = Scenario {
        name: name.clone(),
        robot: description.path.display().to_string(),
        simulation: SimulationSettings {
            step_s: STEP_S,
            duration_s: Some(duration_s),
            ..SimulationSettings::default()
        },
        check: vec![Check::Agreement(AgreementCheck::default())],
        ..Scenario::default()
    };
    let setup = RunSetup::new(scenario, description)?;
    let folder = OutputFolder::create(out, &name, &setup.inputs)?;
    let source = SweepSource::new(&setup.description.robot, &joints, duration_s);
    let run = Run::with_source(&setup, Box::new(source))?;
    // Nothing acts on the robot, so that there is no physics that the poses could be diagnosed with.
    let causes = |run: &mut Run<'_>, outcome: &mut _| AfterRun::from_samples(diagnose_run(run, outcome));
    let recorded = record(run, &[&RerunFormat], &folder, causes, |_| ());
    recorded.result?;
    Ok(JointSweep {
        format: "congruent-joint-sweep/1",
        robot: setup.description.name.clone(),
        recording: folder.file(RerunFormat.file_name()),
        duration_s,
        joints,
        follow,
        agrees: recorded.report.exit_code == 0,
    })
}

/// The joints in the order of the robot, and those that follow others.
fn swept(robot: &Robot) -> (Vec<SweptJoint>, Vec<String>) {
    let (mut joints, mut follow) = (Vec::new(), Vec::new());
    let mut from_s = 0.0;
    for joint in robot.movable_joints().iter().map(|&joint| robot.joint(joint)) {
        if joint.mimic.is_some() {
            follow.push(joint.name.clone());
            continue;
        }
        let (range, note) = range_of(joint.kind, joint.position_range());
        // Zero, or the end of the range that is nearest to it: the pose in which the other joints wait.
        let start = 0.0_f64.clamp(range[0], range[1]);
        let is_moving = range[1] > range[0];
        let until_s = if is_moving { from_s + JOINT_S } else { from_s };
        let (joint, unit) = (joint.name.clone(), joint.kind.unit());
        joints.push(SweptJoint { joint, unit, start, range, from_s, until_s, note });
        from_s = until_s;
    }
    (joints, follow)
}

/// The range over which a joint moves, and what decided it if it is not that of the description.
fn range_of(kind: JointKind, range: Option<(f64, f64)>) -> ([f64; 2], Option<String>) {
    let widest = if kind.is_angular() { WIDEST_RAD } else { WIDEST_M };
    let range_and_note = |range: [f64; 2], note: &str| (range, Some(note.to_owned()));
    match range {
        Some((lower, upper)) if upper < lower || lower.is_nan() || upper.is_nan() => {
            range_and_note([0.0; 2], "its position limits are empty or not numbers, so it is not moved")
        }
        Some((lower, upper)) if upper - lower <= widest => {
            let note = (upper <= lower)
                .then(|| "its lower and upper position limits are equal, so it is not moved".to_owned());
            ([lower, upper], note)
        }
        _ if kind.is_angular() => range_and_note([0.0, 2.0 * PI], "without limits: one turn"),
        _ => range_and_note([0.0; 2], "a sliding joint without position limits: it is not moved"),
    }
}

/// Where the joint is `time_s` after it began: down to the lower end, up to the upper one and back, slow at the ends.
fn position(joint: &SweptJoint, time_s: f64) -> f64 {
    let [lower, upper] = joint.range;
    let quarter_s = JOINT_S / 4.0;
    // Half a cosine: no jump of the velocity at the ends, and pi/2 times the mean velocity in the middle.
    let ease = |share: f64| 0.5 - 0.5 * libm::cos(PI * share.clamp(0.0, 1.0));
    let between =
        |from: f64, to: f64, begins: f64, lasts: f64| from + (to - from) * ease((time_s - begins) / lasts);
    match time_s {
        t if t <= quarter_s => between(joint.start, lower, 0.0, quarter_s),
        t if t <= 3.0 * quarter_s => between(lower, upper, quarter_s, 2.0 * quarter_s),
        _ => between(upper, joint.start, 3.0 * quarter_s, quarter_s),
    }
}

/// The joints at one instant after another.
struct SweepSource<'a> {
    robot: &'a Robot,
    /// Coordinate of each swept joint.
    joints: Vec<(usize, &'a SweptJoint)>,
    duration_s: f64,
    time_s: f64,
    q: RobotQ,
}

impl<'a> SweepSource<'a> {
    fn new(robot: &'a Robot, joints: &'a [SweptJoint], duration_s: f64) -> Self {
        let coordinate =
            |joint: &SweptJoint| robot.movable_joint_names().position(|name| name == joint.joint);
        let joints = joints.iter().filter_map(|joint| Some((coordinate(joint)?, joint))).collect();
        let mut source = Self { robot, joints, duration_s, time_s: 0.0, q: RobotQ::zeros(robot.dof()) };
        source.place(0.0);
        source
    }

    fn place(&mut self, time_s: f64) {
        self.time_s = time_s;
        for &(coordinate, joint) in &self.joints {
            let is_moving = (joint.from_s..joint.until_s).contains(&time_s);
            self.q[coordinate] = if is_moving { position(joint, time_s - joint.from_s) } else { joint.start };
        }
        // After all joints are placed, since a joint that follows may come before its master.
        self.robot.apply_mimic(&mut self.q);
    }
}

impl JointStateSource for SweepSource<'_> {
    fn joints(&self) -> JointSample<'_> {
        JointSample::measured(JointStateView { q: &self.q, qd: &[], effort: &[] })
    }

    fn advance(&mut self, wanted_s: f64) -> Result<Advance, SourceError> {
        self.place(wanted_s);
        Ok(Advance::At(wanted_s))
    }

    fn is_last(&self) -> bool {
        // Half a step: times are multiples of the step, with its rounding.
        self.time_s > self.duration_s - STEP_S / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(range: [f64; 2]) -> SweptJoint {
        let start = 0.0_f64.clamp(range[0], range[1]);
        SweptJoint { joint: "a".into(), unit: "rad", start, range, from_s: 0.0, until_s: JOINT_S, note: None }
    }

    #[test]
    fn a_joint_reaches_both_ends_and_comes_back() {
        let joint = joint([-1.0, 2.0]);
        let positions: Vec<f64> = (0..=400).map(|step| position(&joint, f64::from(step) * 0.01)).collect();
        let lowest = positions.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = positions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((lowest + 1.0).abs() < 1e-12 && (highest - 2.0).abs() < 1e-12, "{lowest} {highest}");
        assert!(positions[0].abs() < 1e-12 && positions[400].abs() < 1e-12);
        let jumps = positions.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        // The fastest leg is 2 rad in 1 s: at most pi rad/s.
        assert!(jumps.fold(0.0, f64::max) < 0.01 * PI, "no jump");
    }

    #[test]
    fn a_joint_without_limits_turns_once_and_a_shift_stays() {
        let one_turn = ([0.0, 2.0 * PI], Some("without limits: one turn".to_owned()));
        assert_eq!(range_of(JointKind::Continuous, None), one_turn);
        assert_eq!(range_of(JointKind::Revolute, Some((-1e16, 1e16))), one_turn);
        let (range, note) = range_of(JointKind::Prismatic, Some((f64::NEG_INFINITY, f64::INFINITY)));
        assert!(range[0].to_bits() == range[1].to_bits() && note.unwrap().contains("it is not moved"));
        assert_eq!(range_of(JointKind::Revolute, Some((0.5, 1.5))), ([0.5, 1.5], None));
        assert!(range_of(JointKind::Revolute, Some((0.5, 0.5))).1.unwrap().contains("are equal"));
    }
}
