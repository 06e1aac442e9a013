//! The diagnosis of a run: tool, transport and encoders by the poses, then actuators and payload by the efforts.

use congruent_dynamics::DynamicsError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    actuator,
    encoder::{self, DISTINCT, EncoderFaults},
    fit::Fit,
    observed::Observed,
    payload,
    residual::{Held, OffWindow, Residual, first_contact, residuals},
    store::SampleStore,
    stuck, tool,
    transport::{self, Dropped},
};
use crate::{
    bodies::MovingBodies,
    fault::RunFault,
    proximity::Clearance,
    scenario::{ControllerKind, FaultKind},
    setup::RunSetup,
};

/// What is wrong with the twin, from the samples of the run alone.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunDiagnosis {
    /// The faults that explain what the samples show, the one that began first foremost.
    pub faults: Vec<FoundFault>,
    /// What no known fault explains.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unexplained: Vec<String>,
}

/// A fault with how well it explains the samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FoundFault {
    /// The fault.
    #[serde(flatten)]
    pub fault: RunFault,
    /// The part of the difference that it leaves beyond the noise of the encoders: root mean squares of what remains over what
    /// there was.
    pub remaining: f64,
}

impl RunDiagnosis {
    /// Whether the samples show nothing wrong.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty() && self.unexplained.is_empty()
    }

    /// The faults.
    pub fn run_faults(&self) -> impl Iterator<Item = RunFault> {
        self.faults.iter().map(|found| found.fault.clone())
    }

    /// Each fault, and each thing that is not explained, in a sentence.
    pub fn sentences(&self) -> Vec<String> {
        let faults = self.faults.iter().map(|found| found.fault.sentence());
        faults.chain(self.unexplained.iter().cloned()).collect()
    }
}

/// Diagnoses the samples of a run; `None` if they show nothing wrong. `clearance` is that of the run.
pub(crate) fn diagnose(
    setup: &RunSetup,
    store: &SampleStore,
    clearance: &mut Clearance,
) -> Option<RunDiagnosis> {
    let observed = Observed::new(store, &setup.description.robot, &setup.clock);
    let open = observed.independent_joints();
    let mut search = Search { observed, open, found: Vec::new(), unexplained: Vec::new() };
    search.poses();
    let mut bodies = MovingBodies::new(&setup.bodies, &setup.obstacles);
    let first_contact = first_contact(&search.observed, &mut bodies, clearance);
    search.efforts(setup, first_contact).ok()?;
    let Search { found: mut faults, unexplained, .. } = search;
    faults.sort_by(|a, b| a.fault.from_s.total_cmp(&b.fault.from_s));
    let found = |fit: Fit| FoundFault { fault: fit.fault, remaining: fit.remaining };
    let diagnosis = RunDiagnosis { faults: faults.into_iter().map(found).collect(), unexplained };
    (!diagnosis.is_empty()).then_some(diagnosis)
}

struct Search<'a> {
    observed: Observed<'a>,
    /// Joints whose reported effort is that of their drive, as far as is known.
    open: Vec<usize>,
    found: Vec<Fit>,
    unexplained: Vec<String>,
}

impl Search<'_> {
    /// What is measured against what the poses show.
    fn poses(&mut self) {
        if let Some(tool) = tool::displaced(&self.observed).filter(|tool| tool.fit.explains()) {
            self.found.push(tool.fit);
            self.open.retain(|&joint| Some(joint) != tool.joint_before);
        }
        let late = |observed: &Observed<'_>, open: &[usize]| {
            let encoders = encoder::faults(observed, open);
            let late = transport::late(observed, open);
            (late.filter(|late| late.gain > encoders.gain + DISTINCT), encoders)
        };
        let (mut found, mut encoders) = late(&self.observed, &self.open);
        // Readings that arrive late repeat when the robot has stood, not when it stands.
        self.observed.late = found.as_ref().map(|late| (late.window, late.steps));
        if let Some(Dropped { fit, is_held, would_show }) = transport::dropped(&self.observed, &self.open) {
            self.found.push(fit);
            // A reading that got lost unseen is as late as one of a latency.
            self.observed.is_used =
                is_held.iter().zip(&would_show).map(|(is_held, shows)| *shows && !is_held).collect();
            found = transport::late(&self.observed, &self.open);
            self.observed.is_used = is_held.into_iter().map(|is_held| !is_held).collect();
            encoders = encoder::faults(&self.observed, &self.open);
            found = found.filter(|late| late.gain > encoders.gain + DISTINCT);
            self.observed.late = found.as_ref().map(|late| (late.window, late.steps));
        }
        match found {
            Some(late) => self.found.push(late.fit),
            None => self.encoders(encoders),
        }
    }

    /// Takes the faults of encoders, and says what noise hides and what nothing explains.
    fn encoders(&mut self, encoders: EncoderFaults) {
        let observed = &self.observed;
        for (joint, hypotheses) in encoders.hidden {
            let kinds: Vec<String> = hypotheses.iter().map(|fit| fit.fault.words()).collect();
            self.unexplained.push(format!("noise hides which fault it is: {}", kinds.join("; or ")));
            self.open.retain(|&other| other != joint);
        }
        for fit in encoders.found {
            // Efforts of a drive that counts the other way round, or moves another joint, are not compared.
            if matches!(fit.fault.kind, FaultKind::FlippedAxis | FaultKind::SwappedJoints) {
                self.open.retain(|&joint| !fit.fault.joints.contains(&observed.name(joint)));
            }
            self.found.push(fit);
        }
        let is_named = |joint: usize| {
            let name = observed.name(joint);
            self.found.iter().any(|fit| fit.fault.joints.contains(&name))
        };
        let (unknown, open): (Vec<usize>, Vec<usize>) =
            self.open.iter().partition(|&&joint| !is_named(joint) && encoder::is_wrong(observed, joint));
        self.open = open;
        self.unexplained.extend(unknown.into_iter().map(|joint| {
            let name = observed.name(joint);
            format!("joint {name}: the encoder differs from the poses, and no known fault explains how")
        }));
    }

    /// The efforts that are reported against those that the motion needs.
    fn efforts(&mut self, setup: &RunSetup, first_contact: Option<usize>) -> Result<(), DynamicsError> {
        match setup.controller.kind {
            ControllerKind::Kinematic => {
                self.not_followed();
                return Ok(());
            }
            // Nobody asks the joints to be anywhere, and no drive reports an effort.
            ControllerKind::Passive => return Ok(()),
            _ => {}
        }
        let limits = setup.actuator_limits();
        let mut residuals = residuals(&self.observed, setup.declared_dynamics(), &limits)?;
        if let Some(contact) = first_contact {
            residuals.retain(|residual| residual.sample < contact);
        }
        let robot = self.observed.robot;
        let masters: Vec<usize> =
            robot.joints().iter().filter_map(|joint| robot.coordinate(joint.mimic?.master)).collect();
        // The effort of a joint that others follow moves those as well.
        self.open.retain(|joint| !masters.contains(joint));
        let (mut off, mut alone) = (Vec::new(), Vec::new());
        for &joint in &self.open {
            let of = |held: Held| self.off_window(&residuals, (joint, held));
            let stuck =
                of(Held::Counts).and_then(|window| stuck::fault(&self.observed, joint, window.samples));
            let window = of(if stuck.is_some() { Held::Counts } else { Held::LeftOut });
            let Some(window) = window else { continue };
            off.push((joint, window));
            alone.extend(stuck.or_else(|| actuator::fault(&self.observed, joint, &residuals, window)));
        }
        let joints: Vec<usize> = off.iter().map(|&(joint, _)| joint).collect();
        let together = off.iter().map(|&(_, window)| window).reduce(OffWindow::with);
        let Some(together) = together else { return Ok(()) };
        let load = payload::fault(&self.observed, &setup.description, &joints, (&residuals, together))?;
        let load = load.filter(Fit::explains);
        let score_alone: f64 = alone.iter().map(Fit::score).sum();
        match load {
            // One cause for all joints that are off, unless each has a better one of its own.
            Some(load) if alone.len() < off.len() || load.score() < score_alone => self.found.push(load),
            _ => self.found.extend(alone),
        }
        Ok(())
    }

    /// Joints of a robot that is placed at its setpoints, and are not there.
    fn not_followed(&mut self) {
        for &joint in &self.open {
            let behind = stuck::behind_setpoint(&self.observed, joint);
            self.found.extend(behind.and_then(|window| stuck::fault(&self.observed, joint, window)));
        }
    }

    /// When the residual of a joint is more than the length of a step makes it, until the joint stops at a limit.
    fn off_window(&self, residuals: &[Residual], (joint, held): (usize, Held)) -> Option<OffWindow> {
        let before_limit = self.observed.samples_before_limit(joint);
        let usable = residuals.partition_point(|residual| residual.sample < before_limit);
        let residuals = &residuals[..usable];
        OffWindow::of(residuals, self.observed.samples(), (joint, held))
    }
}
