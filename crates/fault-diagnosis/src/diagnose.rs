//! The diagnosis of a run: tool, transport and encoders by the poses, then actuators and payload by the efforts.

use congruent_description::RobotDescription;
use congruent_dynamics::DynamicsError;
use congruent_input::display::quantity;
use congruent_monitors::{ActuatorLimits, RunClock, RunDynamics, SampleStore};
use congruent_proximity::{Clearance, MovingBodies};
use congruent_scenario::{ControllerKind, FaultKind, RunFault};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    actuator,
    encoder::{self, DISTINCT, EncoderFaults},
    fit::{FaultFit, Window},
    observed::ObservedRun,
    payload,
    residual::{HeldSamples, OffWindow, Residual, first_contact, is_blind, residuals},
    stuck, tool,
    transport::{self, Dropped},
};

/// The faults of the twin, found from the samples of the run alone.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunDiagnosis {
    /// The faults that explain the samples, in order of their beginning.
    pub faults: Vec<FoundFault>,
    /// Deviations that no known fault explains, or several faults equally well.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unexplained: Vec<String>,
}

/// A fault with how well it explains the samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FoundFault {
    /// Kind, joints, values and times of the fault.
    #[serde(flatten)]
    pub fault: RunFault,
    /// Relative residual of the fault beyond the noise of the encoders: root mean square of the residual over that of the
    /// difference.
    pub remaining: f64,
}

impl RunDiagnosis {
    /// Whether the samples show no deviation.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty() && self.unexplained.is_empty()
    }

    /// The faults without their residuals.
    pub fn run_faults(&self) -> impl Iterator<Item = RunFault> {
        self.faults.iter().map(|found| found.fault.clone())
    }

    /// Each fault, and each deviation that is not explained, in a sentence.
    pub fn sentences(&self) -> Vec<String> {
        let faults = self.faults.iter().map(|found| found.fault.sentence());
        faults.chain(self.unexplained.iter().cloned()).collect()
    }
}

/// What a diagnosis knows of a run beside its samples: what the scenario declares, and nothing of its faults.
#[derive(Debug)]
pub struct DiagnosedRun<'a> {
    /// The robot with its model.
    pub description: &'a RobotDescription,
    /// Length and number of the steps (s), and gravity (m/s^2, world).
    pub clock: &'a RunClock,
    /// The kind of the controller.
    pub controller: ControllerKind,
    /// What each moving joint's actuator can do.
    pub actuators: Vec<ActuatorLimits>,
    /// Masses, payloads and resistances as declared.
    pub dynamics: RunDynamics<'a>,
    /// The obstacles that move, from the start of the run on.
    pub bodies: MovingBodies<'a>,
}

/// Diagnoses the samples of a run; `None` if they show no deviation. `clearance` is that of the run.
pub fn diagnose(
    mut run: DiagnosedRun<'_>,
    store: &SampleStore,
    clearance: &mut Clearance,
) -> Option<RunDiagnosis> {
    let observed = ObservedRun::new(store, &run.description.robot, run.clock);
    let open = observed.independent_joints();
    let mut search = Search { observed, open, found: Vec::new(), unexplained: Vec::new() };
    // Poses before efforts: the efforts that a motion needs are computed from positions, which a fault of encoders or transport
    // would falsify.
    search.poses();
    let first_contact = first_contact(&search.observed, &mut run.bodies, clearance);
    search.efforts(run, first_contact).ok()?;
    search.delivered_shares();
    let Search { found: mut faults, unexplained, .. } = search;
    faults.sort_by(|a, b| a.fault.from_s.total_cmp(&b.fault.from_s));
    let found = |fit: FaultFit| FoundFault { fault: fit.fault, remaining: fit.remaining };
    let diagnosis = RunDiagnosis { faults: faults.into_iter().map(found).collect(), unexplained };
    (!diagnosis.is_empty()).then_some(diagnosis)
}

struct Search<'a> {
    observed: ObservedRun<'a>,
    /// Joints whose reported effort is that of their drive, as far as is known.
    open: Vec<usize>,
    found: Vec<FaultFit>,
    unexplained: Vec<String>,
}

impl Search<'_> {
    /// The measured positions against those by the poses of the links.
    fn poses(&mut self) {
        // The tool first: a link at another pose makes the position of the joint before it appear wrong.
        if let Some(tool) = tool::displaced(&self.observed).filter(|tool| tool.fit.explains()) {
            self.found.push(tool.fit);
            self.open.retain(|&joint| Some(joint) != tool.joint_before);
        }
        // A latency and faults of encoders explain the same readings: the latency is taken only if it explains distinctly more,
        // since one latency replaces faults of all encoders.
        let late = |observed: &ObservedRun<'_>, open: &[usize]| {
            let encoders = encoder::faults(observed, open);
            let late = transport::late(observed, open);
            (late.filter(|late| late.gain_with_others(observed) > encoders.gain + DISTINCT), encoders)
        };
        let (mut found, mut encoders) = late(&self.observed, &self.open);
        // Before the search for lost readings: with a latency, readings repeat a while after the robot was at rest, not while
        // it is, and would count as lost.
        self.observed.late = found.as_ref().map(|late| (late.window, late.steps));
        if let Some(Dropped { fit, is_held, would_show }) = transport::dropped(&self.observed, &self.open) {
            self.found.push(fit);
            // Only samples that would show a loss: in the others a lost reading looks like one that is late by a step.
            self.observed.is_used =
                is_held.iter().zip(&would_show).map(|(is_held, shows)| *shows && !is_held).collect();
            // Again without the lost readings, which repeat the one before and so look late.
            found = transport::late(&self.observed, &self.open);
            self.observed.is_used = is_held.into_iter().map(|is_held| !is_held).collect();
            encoders = encoder::faults(&self.observed, &self.open);
            found = found.filter(|late| late.gain_with_others(&self.observed) > encoders.gain + DISTINCT);
            self.observed.late = found.as_ref().map(|late| (late.window, late.steps));
        }
        match found {
            Some(late) => {
                // Encoders that are off as well: what the latency does not explain of them.
                self.observed = late.taken_out(&self.observed);
                self.encoders(encoder::faults(&self.observed, &late.others));
                self.found.push(late.fit);
            }
            None => self.encoders(encoders),
        }
    }

    /// Takes the faults of encoders, and reports deviations that several faults explain, or none.
    fn encoders(&mut self, encoders: EncoderFaults) {
        let observed = &self.observed;
        for (joint, hypotheses) in encoders.hidden {
            let kinds: Vec<String> = hypotheses.iter().map(|fit| fit.fault.words()).collect();
            self.unexplained
                .push(format!("several faults are possible within the noise: {}", kinds.join("; or ")));
            self.open.retain(|&other| other != joint);
        }
        for fit in encoders.found {
            // The drive of such a joint counts the other way round, or moves another joint: its reported effort is not that of
            // the joint, and would appear as a fault of the actuator.
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
            format!("joint {name}: no known fault explains the difference between encoder and link poses")
        }));
    }

    /// The reported efforts against those that the motion needs.
    fn efforts(&mut self, run: DiagnosedRun<'_>, first_contact: Option<usize>) -> Result<(), DynamicsError> {
        match run.controller {
            ControllerKind::Kinematic => {
                self.not_followed();
                return Ok(());
            }
            // There is no setpoint, and no drive reports an effort.
            ControllerKind::Absent | ControllerKind::Passive => return Ok(()),
            _ => {}
        }
        let mut residuals = residuals(&self.observed, run.dynamics, &run.actuators)?;
        if let Some(contact) = first_contact {
            residuals.retain(|residual| residual.sample < contact);
        }
        let (mut off, mut alone, mut unknown) = (Vec::new(), Vec::new(), Vec::new());
        for &joint in &self.open {
            let Some((window, fault)) = self.of_joint(&residuals, joint) else { continue };
            off.push((joint, window));
            match fault {
                Some(fault) => alone.push(fault),
                None => unknown.push((joint, window)),
            }
        }
        let load = payload::fault(&self.observed, run.description, &off, &residuals)?;
        let with_others = self.load_and_others(run.description, &off, &residuals)?;
        let score = |fits: &[FaultFit]| fits.iter().map(FaultFit::score).sum::<f64>();
        let with_load = match load.filter(|load| load.fit.explains()) {
            // A small fault beside the load changes little of what the load explains.
            Some(load) if with_others.is_empty() || load.fit.score() <= score(&with_others) => vec![load.fit],
            _ => with_others,
        };
        // One payload explains most joints with a residual, unless each has a better cause of its own: fewer causes first.
        let is_load = !with_load.is_empty() && (alone.len() < off.len() || score(&with_load) < score(&alone));
        if !is_load {
            let sentence = |(joint, window)| self.unexplained_effort(joint, window);
            let is_open = |(_, window): &(usize, OffWindow)| !self.begins_with_a_stop(window.samples);
            let unexplained: Vec<String> = unknown.into_iter().filter(is_open).map(sentence).collect();
            self.unexplained.extend(unexplained);
        }
        let found = if is_load { with_load } else { alone };
        // A fault that was found shows that efforts could be compared.
        if found.is_empty() {
            let blind = self.blind_joints(&residuals);
            self.unexplained.extend(blind);
        }
        self.found.extend(found);
        Ok(())
    }

    /// The actuators that deliver another share than the commanded effort, where the motion has not shown it.
    fn delivered_shares(&mut self) {
        for joint in self.observed.independent_joints() {
            let name = self.observed.name(joint);
            if self.found.iter().all(|fit| !fit.fault.joints.contains(&name)) {
                self.found.extend(actuator::delivered_share(&self.observed, joint));
            }
        }
    }

    /// Whether a joint has run into the end of its range by the beginning of a window: the others feel the impact, and what it exerts
    /// is not reported.
    fn begins_with_a_stop(&self, window: Window) -> bool {
        /// The step of the impact, and that before it.
        const IMPACT: usize = 2;
        let mut joints = 0..self.observed.robot.dof();
        joints.any(|joint| (1..=window.first + IMPACT).contains(&self.observed.samples_before_limit(joint)))
    }

    /// That a joint lacks effort, or has too much, and no hypothesis says why.
    fn unexplained_effort(&self, joint: usize, window: OffWindow) -> String {
        let (from_s, _) = self.observed.times(window.samples);
        format!(
            "joint {}: from {} on, the motion needs another effort than the one that is reported, and no single fault explains \
             the difference: there may be several at this joint",
            self.observed.name(joint),
            quantity(from_s, "s")
        )
    }

    /// That a loop with late readings vibrates so much that efforts show little, if it does: its latency is then not all that
    /// may be wrong.
    fn blind_joints(&self, residuals: &[Residual]) -> Option<String> {
        self.observed.late?;
        let blind = self.open.iter().filter(|&&joint| is_blind(residuals, joint));
        let names: Vec<String> = blind.map(|&joint| self.observed.name(joint)).collect();
        (!names.is_empty()).then(|| {
            format!(
                "the readings arrive late and the arm vibrates: the efforts of {} change too fast to be compared with those that \
                 the motion needs, so that faults of actuators, friction and payload are not excluded",
                names.join(", ")
            )
        })
    }

    /// When the residual of a joint is off, and the fault of this joint alone that explains it.
    fn of_joint(&self, residuals: &[Residual], joint: usize) -> Option<(OffWindow, Option<FaultFit>)> {
        let of = |held: HeldSamples| self.off_window(residuals, joint, held);
        // Stuck first: a brake holds the joint, and exactly those samples are the evidence. For every other fault they are not,
        // since dry friction may exert any torque in them.
        // A joint whose actuator is known to lack effort need not be held by anything else.
        let delivered = actuator::delivered_share(&self.observed, joint);
        let stuck = of(HeldSamples::Counts)
            .filter(|_| delivered.is_none())
            .and_then(|window| stuck::fault(&self.observed, joint, window.samples));
        let window = of(if stuck.is_some() { HeldSamples::Counts } else { HeldSamples::LeftOut })?;
        let fault = stuck.or_else(|| actuator::fault(&self.observed, joint, residuals, window));
        // What the actuator lacks by its two efforts is known: the friction that may fit the motion as well is a guess.
        let is_guess = |fit: &FaultFit| fit.fault.kind == FaultKind::AddedFriction;
        Some((window, if fault.as_ref().is_some_and(is_guess) { delivered.or(fault) } else { fault }))
    }

    /// A payload that explains most joints with a residual, and faults of the others beside it, whose residuals are judged
    /// without the load; empty if there is none, or if one of the others has no explanation.
    fn load_and_others(
        &self,
        description: &RobotDescription,
        off: &[(usize, OffWindow)],
        residuals: &[Residual],
    ) -> Result<Vec<FaultFit>, DynamicsError> {
        let Some((load, others)) = payload::beside_others(&self.observed, description, off, residuals)?
        else {
            return Ok(Vec::new());
        };
        let rest = load.taken_out(&self.observed, residuals)?;
        let faults: Option<Vec<FaultFit>> =
            others.into_iter().map(|joint| self.of_joint(&rest, joint)?.1).collect();
        Ok(faults.map_or_else(Vec::new, |faults| [vec![load.fit], faults].concat()))
    }

    /// Joints that are not at their setpoints although the controller places the robot there.
    fn not_followed(&mut self) {
        for &joint in &self.open {
            let behind = stuck::behind_setpoint(&self.observed, joint);
            self.found.extend(behind.and_then(|window| stuck::fault(&self.observed, joint, window)));
        }
    }

    /// When the residual of a joint is above the truncation error of a step, until the joint reaches a limit, whose stop exerts
    /// an unknown torque.
    fn off_window(&self, residuals: &[Residual], joint: usize, held: HeldSamples) -> Option<OffWindow> {
        let before_limit = self.observed.samples_before_limit(joint);
        let usable = residuals.partition_point(|residual| residual.sample < before_limit);
        let residuals = &residuals[..usable];
        OffWindow::above_threshold(residuals, self.observed.samples(), joint, held)
    }
}
