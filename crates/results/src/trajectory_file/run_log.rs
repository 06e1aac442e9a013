//! The samples of a run as a log of ROS 2: what a robot of this description would publish, and the checks as diagnostics.

use std::path::Path;

use congruent_description::{LinkIndex, Robot, RobotDescription};
use congruent_input::{display::quantity, folder_of, serde_name};
use congruent_logs::{DiagnosticLevel, JointTopic, LogWriter, WrittenDiagnostic, WrittenEdge, WrittenJoints};
use congruent_monitors::{
    Recorder, RecordingError, Sample,
    verdict::{CheckResult, Status},
};
use congruent_twin::RunSetup;
use congruent_writers::{RobotFormat, robot_text};

use super::{failed::failed, stride::Stride};
use crate::{
    execute::Recording,
    report::{RunReport, lines},
};

/// Writes a log while the run goes on.
pub(super) struct RunLog {
    log: LogWriter,
    /// Names of the movable joints.
    joints: Vec<String>,
    /// The links that move against the one before.
    edges: Vec<MovingEdge>,
    stride: Stride,
    /// Time of the latest message.
    time_s: f64,
}

/// Two links, one behind the other, with a joint between them that moves.
struct MovingEdge {
    parent: LinkIndex,
    child: LinkIndex,
    /// Names of the two.
    names: [String; 2],
}

impl RunLog {
    pub(super) fn create(path: &Path, setup: &RunSetup, stride: Stride) -> Result<Self, RecordingError> {
        let (description, robot) = (&setup.description, &setup.description.robot);
        let mut log = LogWriter::create(path).map_err(failed)?;
        if let Some(urdf) = urdf_of(description, path) {
            log.description(&urdf).map_err(failed)?;
        }
        let fixed: Vec<WrittenEdge<'_>> = fixed_edges(robot).collect();
        log.static_transforms(fixed.into_iter()).map_err(failed)?;
        let moving = robot.joints().iter().filter(|joint| joint.kind.is_movable());
        let edges = moving.map(|joint| MovingEdge {
            parent: joint.parent,
            child: joint.child,
            names: [joint.parent, joint.child].map(|link| robot.link(link).name.clone()),
        });
        let joints = robot.movable_joint_names().map(str::to_owned).collect();
        Ok(Self { log, joints, edges: edges.collect(), stride, time_s: 0.0 })
    }
}

/// The description as its file has it; one that is no URDF is written as such, if it can be.
fn urdf_of(description: &RobotDescription, path: &Path) -> Option<String> {
    if let Some(places) = &description.places.urdf {
        return Some(places.source().text.clone());
    }
    let folder = folder_of(path).canonicalize().ok()?;
    Some(robot_text(description, RobotFormat::Urdf, &folder).ok()?.text)
}

fn fixed_edges(robot: &Robot) -> impl Iterator<Item = WrittenEdge<'_>> {
    let fixed = robot.joints().iter().filter(|joint| !joint.kind.is_movable());
    fixed.map(|joint| WrittenEdge {
        frame: &robot.link(joint.parent).name,
        child: &robot.link(joint.child).name,
        frame_from_child: joint.parent_from_joint,
    })
}

impl Recorder for RunLog {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if !self.stride.takes(sample) {
            return Ok(());
        }
        self.time_s = sample.time_s;
        let measured = sample.joints.measured;
        let setpoint = sample.joints.setpoint.map(|setpoint| (setpoint.q, setpoint.qd, setpoint.effort));
        let both = [
            (JointTopic::Measured, Some((measured.q, measured.qd, measured.effort))),
            (JointTopic::Desired, setpoint),
        ];
        for (topic, state) in both {
            let Some((position, velocity, effort)) = state else { continue };
            let joints = WrittenJoints { names: &self.joints, position, velocity, effort };
            self.log.joint_states(topic, sample.time_s, &joints).map_err(failed)?;
        }
        let edges = self.edges.iter().map(|MovingEdge { parent, child, names: [frame, child_frame] }| {
            let [root_from_parent, root_from_child] = [parent, child].map(|link| sample.twin[link.get()]);
            WrittenEdge {
                frame,
                child: child_frame,
                frame_from_child: root_from_parent.inv_mul(&root_from_child),
            }
        });
        self.log.transforms(sample.time_s, edges).map_err(failed)
    }
}

impl Recording for RunLog {
    fn finish(mut self: Box<Self>, report: &RunReport) -> Result<(), RecordingError> {
        let diagnostics: Vec<_> = report.checks.iter().map(|check| diagnostic(check, report)).collect();
        self.log.diagnostics(self.time_s, &diagnostics).map_err(failed)?;
        self.log.finish().map_err(failed)
    }
}

/// The result of a check, with the worst value and the limit of each of its quantities.
fn diagnostic(check: &CheckResult, report: &RunReport) -> WrittenDiagnostic {
    let level = match check.status {
        Status::Pass => DiagnosticLevel::Ok,
        Status::Skipped | Status::Inconclusive => DiagnosticLevel::Warn,
        Status::Fail | Status::Error => DiagnosticLevel::Error,
    };
    let values = check.measures.iter().flat_map(|measure| {
        let (name, unit) = (measure.quantity.to_string(), measure.unit.symbol());
        let worst = measure.worst.as_ref().map(|worst| (name.clone(), quantity(worst.value, unit)));
        worst.into_iter().chain([(format!("limit of {name}"), quantity(measure.limit, unit))])
    });
    WrittenDiagnostic {
        level,
        name: format!("{}: {}", report.scenario, check.check),
        message: lines(check).into_iter().next().unwrap_or_else(|| serde_name(&check.status).to_owned()),
        hardware_id: report.robot.clone(),
        values: values.collect(),
    }
}
