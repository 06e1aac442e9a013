//! A small arm as a scenario, and runs of it.

#![expect(clippy::unwrap_used, reason = "a helper of tests")]

use std::collections::BTreeMap;

use congruent_description::{RobotDescription, RobotQ, parse_robot};
use congruent_input::SourceFile;
use congruent_monitors::{
    JointSample, JointStateView, NoRecorder,
    verdict::{CheckResult, Measure, Status},
};
use congruent_scenario::{
    Check, ControllerKind, ControllerSettings, JointMotion, MotionSettings, Scenario, SimulationSettings,
    StartSettings,
};
use congruent_twin::{
    Outcome, Run, RunSetup,
    source::{Advance, JointStateSource, SimulatedRobot, SimulationSource, SourceError},
};
use nalgebra::Isometry3;

/// Two hinges that lift against gravity, a slide along the last link, and a second slide that follows it. The bodies
/// are 0.5 m long; the tool's end is 1.1 m from the shoulder.
const ARM: &str = r#"<robot name="small">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.25 0 0"/><mass value="4"/>
    <inertia ixx="0.01" iyy="0.09" izz="0.09" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.25 0 0"/><mass value="2"/>
    <inertia ixx="0.005" iyy="0.04" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="finger"><inertial><origin xyz="0.05 0 0"/><mass value="0.2"/>
    <inertia ixx="0.0002" iyy="0.0002" izz="0.0002" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0.05 0 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="other"><inertial><origin xyz="0.05 0 0"/><mass value="0.2"/>
    <inertia ixx="0.0002" iyy="0.0002" izz="0.0002" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="300" velocity="3"/><dynamics damping="0.5"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="200" velocity="3"/><dynamics friction="0.5"/></joint>
  <joint name="grip" type="prismatic"><parent link="fore"/><child link="finger"/><origin xyz="0.5 0.05 0"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.1" effort="100" velocity="0.5"/></joint>
  <joint name="follow" type="prismatic"><parent link="fore"/><child link="other"/><origin xyz="0.5 -0.05 0"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.1" effort="100" velocity="0.5"/><mimic joint="grip" multiplier="1"/></joint>
</robot>"#;

/// The arm, after `edits` of its text.
#[track_caller]
pub(crate) fn arm(edits: &[(&str, &str)]) -> RobotDescription {
    let mut text = ARM.to_owned();
    for (from, to) in edits {
        assert!(text.contains(from), "the arm has no {from:?}");
        text = text.replacen(from, to, 1);
    }
    let source = SourceFile { path: "small.urdf".into(), text, is_foreign: false };
    let mut description = parse_robot(None, &source.into()).unwrap();
    description.tip = description.robot.find_link("finger").unwrap();
    description
}

pub(crate) fn controlled(kind: &str, stiffness: f64, damping: f64) -> ControllerSettings {
    ControllerSettings {
        kind: ControllerKind::find(kind).expect("a kind"),
        stiffness: stiffness.into(),
        damping: damping.into(),
        ..ControllerSettings::default()
    }
}

pub(crate) fn servo() -> ControllerSettings {
    controlled("gravity_compensation", 2000.0, 120.0)
}

/// One move of the shoulder and the elbow in 0.8 s, and 0.4 s in which it holds.
pub(crate) fn scenario(controller: ControllerSettings, check: Check) -> Scenario {
    let targets = [("shoulder", 0.4), ("elbow", 0.8)].map(|(name, target)| (name.to_owned(), target));
    let motion = JointMotion {
        move_joints_rad: BTreeMap::from(targets),
        duration_s: Some(0.8),
        ..JointMotion::default()
    };
    Scenario {
        name: "small".to_owned(),
        simulation: SimulationSettings { duration_s: Some(1.2), ..SimulationSettings::default() },
        start: StartSettings {
            joints_rad: BTreeMap::from([("shoulder".to_owned(), -0.3)]),
            joints_m: BTreeMap::from([("grip".to_owned(), 0.02)]),
            ..StartSettings::default()
        },
        controller,
        motion: vec![MotionSettings::Joints(motion)],
        check: vec![check],
        ..Scenario::default()
    }
}

#[track_caller]
pub(crate) fn setup(scenario: Scenario, description: &RobotDescription) -> RunSetup {
    match RunSetup::new(scenario, description.clone()) {
        Ok(setup) => setup,
        Err(found) => panic!("{found:#?}"),
    }
}

/// The message of a scenario that is refused.
#[track_caller]
pub(crate) fn refused(check: Check) -> String {
    let found = RunSetup::new(scenario(servo(), check), arm(&[])).unwrap_err();
    assert_eq!(found.len(), 1, "{found:#?}");
    format!("{}: {}", found[0].code.name, found[0].message)
}

#[track_caller]
pub(crate) fn outcome(setup: &RunSetup, source: Option<Box<dyn JointStateSource + '_>>) -> Outcome {
    let run = match source {
        Some(source) => Run::with_source(setup, source),
        None => Run::new(setup),
    };
    let (outcome, ended) = run.unwrap().finish(&mut setup.checks(), &mut NoRecorder, |_| ());
    ended.unwrap();
    outcome
}

/// The result of the only check of a run.
#[track_caller]
pub(crate) fn result(setup: &RunSetup) -> CheckResult {
    outcome(setup, None).checks.swap_remove(0)
}

/// The result if the physics is that of another robot than the declared one.
#[track_caller]
pub(crate) fn result_with_physics_of(physics: &RobotDescription, setup_: &RunSetup) -> CheckResult {
    let scenario = Scenario { check: Vec::new(), ..setup_.scenario.clone() };
    let other = setup(scenario, physics);
    outcome(setup_, Some(Box::new(SimulationSource::new(&other).unwrap()))).checks.swap_remove(0)
}

/// The result if the source says something else than the physics does, from `state` at every sample.
#[track_caller]
pub(crate) fn result_distorted(setup: &RunSetup, distort: fn(&mut Said)) -> CheckResult {
    let source = Distorted::new(SimulationSource::new(setup).unwrap(), distort);
    outcome(setup, Some(Box::new(source))).checks.swap_remove(0)
}

#[track_caller]
pub(crate) fn measure<'a>(result: &'a CheckResult, quantity: &str) -> &'a Measure {
    let found = result.measures.iter().find(|measure| measure.quantity.name() == quantity);
    found.unwrap_or_else(|| panic!("no {quantity}: {result:#?}"))
}

/// The worst value of a quantity.
#[track_caller]
pub(crate) fn worst(result: &CheckResult, quantity: &str) -> f64 {
    measure(result, quantity).worst.as_ref().unwrap_or_else(|| panic!("no value: {result:#?}")).value
}

#[track_caller]
pub(crate) fn passes(result: &CheckResult) {
    assert_eq!(result.status, Status::Pass, "{result:#?}");
}

/// The check fails by this quantity at this subject, and by no other.
#[track_caller]
pub(crate) fn fails(result: &CheckResult, quantity: &str, subject: &str) {
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    for measure in &result.measures {
        let violation = measure.first_violation.as_ref();
        assert_eq!(violation.is_some(), measure.quantity.name() == quantity, "{result:#?}");
        assert!(violation.is_none_or(|moment| moment.subject == subject), "{result:#?}");
    }
}

/// Whether a remark has this text.
#[track_caller]
pub(crate) fn notes(result: &CheckResult, text: &str) {
    assert!(result.notes.iter().any(|note| note.contains(text)), "no {text:?} in {:#?}", result.notes);
}

/// What a source says of the joints and links.
pub(crate) struct Said {
    pub(crate) time_s: f64,
    pub(crate) measured_q: RobotQ,
    pub(crate) measured_qd: Vec<f64>,
    pub(crate) true_q: RobotQ,
    pub(crate) root_from_links: Vec<Isometry3<f64>>,
}

/// A source that does not say what its physics does.
struct Distorted<'a> {
    physics: SimulationSource<'a>,
    said: Said,
    distort: fn(&mut Said),
}

impl<'a> Distorted<'a> {
    fn new(physics: SimulationSource<'a>, distort: fn(&mut Said)) -> Self {
        let joints = physics.joints();
        let said = Said {
            time_s: 0.0,
            measured_q: joints.measured.q.clone(),
            measured_qd: joints.measured.qd.to_vec(),
            true_q: joints.state().q.clone(),
            root_from_links: vec![Isometry3::identity(); 16],
        };
        Self { physics, said, distort }
    }
}

impl JointStateSource for Distorted<'_> {
    fn joints(&self) -> JointSample<'_> {
        let joints = self.physics.joints();
        JointSample {
            truth: Some(JointStateView { q: &self.said.true_q, ..joints.state() }),
            measured: JointStateView {
                q: &self.said.measured_q,
                qd: &self.said.measured_qd,
                ..joints.measured
            },
            setpoint: joints.setpoint,
            recorded_effort: &[],
        }
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        if self.said.time_s == 0.0 {
            return self.physics.root_from_links_into(root_from_links);
        }
        root_from_links.copy_from_slice(&self.said.root_from_links[..root_from_links.len()]);
        true
    }

    fn is_last(&self) -> bool {
        self.physics.is_last()
    }

    fn simulated(&self) -> Option<&dyn SimulatedRobot> {
        self.physics.simulated()
    }

    fn advance(&mut self, time_s: f64) -> Result<Advance, SourceError> {
        self.physics.advance(time_s)?;
        let joints = self.physics.joints();
        self.said.time_s = time_s;
        self.said.measured_q.copy_from_slice(joints.measured.q);
        self.said.measured_qd = joints.measured.qd.to_vec();
        self.said.true_q.copy_from_slice(joints.state().q);
        self.physics.root_from_links_into(&mut self.said.root_from_links[..5]);
        (self.distort)(&mut self.said);
        Ok(Advance::At(time_s))
    }
}
