//! The diagnosis of a run: tool, transport and encoders by the poses, then actuators and payload by the efforts.

use congruent_dynamics::DynamicsError;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    actuator, encoder,
    fit::Fit,
    observed::Observed,
    payload,
    residual::{OffWindow, Residual, first_contact, residuals},
    store::SampleStore,
    stuck, tool, transport,
};
use crate::{fault::RunFault, proximity::Clearance, setup::RunSetup};

/// What is wrong with the twin, from the samples of the run alone.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct RunDiagnosis {
    /// The faults that explain what the samples show, the one that began first foremost.
    pub faults: Vec<FoundFault>,
    /// What no known fault explains.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unexplained: Vec<String>,
}

/// A fault with how well it explains the samples.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FoundFault {
    /// The fault.
    #[serde(flatten)]
    pub fault: RunFault,
    /// The part of the difference that it leaves: root mean squares of what remains over what there was.
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
    let mut search = Search { observed: &observed, open: observed.independent_joints(), found: Vec::new() };
    search.poses();
    let unexplained = search.unexplained();
    let first_contact = first_contact(&observed, clearance);
    search.efforts(setup, first_contact).ok()?;
    let mut faults = search.found;
    faults.sort_by(|a, b| a.fault.from_s.total_cmp(&b.fault.from_s));
    let found = |fit: Fit| FoundFault { fault: fit.fault, remaining: fit.remaining };
    let diagnosis = RunDiagnosis { faults: faults.into_iter().map(found).collect(), unexplained };
    (!diagnosis.is_empty()).then_some(diagnosis)
}

struct Search<'a> {
    observed: &'a Observed<'a>,
    /// Joints of which nothing is known to be wrong.
    open: Vec<usize>,
    found: Vec<Fit>,
}

impl Search<'_> {
    /// What is measured against what the poses show.
    fn poses(&mut self) {
        if let Some(tool) = tool::displaced(self.observed).filter(|tool| tool.fit.explains()) {
            self.found.push(tool.fit);
            self.open.retain(|&joint| Some(joint) != tool.joint_before);
        }
        let transport = transport::dropped(self.observed, &self.open)
            .filter(Fit::explains)
            .or_else(|| transport::late(self.observed, &self.open).filter(Fit::explains));
        if let Some(fit) = transport {
            // Efforts arrive late, or not at all, as well.
            self.open.clear();
            self.found.push(fit);
            return;
        }
        let fits = encoder::faults(self.observed, &self.open);
        let is_wrong = |joint: usize| encoder::wrong(self.observed, joint).is_some();
        self.found.extend(fits);
        self.open.retain(|&joint| !is_wrong(joint));
    }

    /// Encoders that differ from the poses in a way that nothing explains.
    fn unexplained(&self) -> Vec<String> {
        let is_explained = |joint: &String| {
            self.found.iter().any(|fit| fit.fault.joints.contains(joint) || fit.fault.joints.is_empty())
        };
        let wrong = self.observed.independent_joints().into_iter();
        let wrong = wrong.filter(|&joint| encoder::wrong(self.observed, joint).is_some());
        let names = wrong.map(|joint| self.observed.name(joint)).filter(|name| !is_explained(name));
        names
            .map(|name| {
                format!("joint {name}: the encoder differs from the poses, and no known fault explains how")
            })
            .collect()
    }

    /// The efforts that are reported against those that the motion needs.
    fn efforts(&mut self, setup: &RunSetup, first_contact: Option<usize>) -> Result<(), DynamicsError> {
        let mut residuals = residuals(self.observed, setup.declared_dynamics())?;
        if residuals.is_empty() {
            self.not_followed();
            return Ok(());
        }
        if let Some(contact) = first_contact {
            residuals.retain(|residual| residual.sample < contact);
        }
        let robot = self.observed.robot;
        let masters: Vec<usize> =
            robot.joints().iter().filter_map(|joint| robot.coordinate(joint.mimic?.master)).collect();
        // The effort of a joint that others follow moves those as well.
        self.open.retain(|joint| !masters.contains(joint));
        let off: Vec<(usize, OffWindow)> = self
            .open
            .iter()
            .filter_map(|&joint| Some((joint, self.off_window(&residuals, joint)?)))
            .collect();
        let alone: Vec<Fit> =
            off.iter().filter_map(|&(joint, window)| self.of_actuator(joint, (&residuals, window))).collect();
        let joints: Vec<usize> = off.iter().map(|&(joint, _)| joint).collect();
        let together = off.iter().map(|&(_, window)| window).reduce(OffWindow::with);
        let Some(together) = together else { return Ok(()) };
        let load = payload::fault(self.observed, &setup.description, &joints, (&residuals, together))?;
        let load = load.filter(Fit::explains);
        let score_alone: f64 = alone.iter().map(Fit::score).sum();
        match load {
            // One cause for all joints that are off, unless each has a better one of its own.
            Some(load) if alone.len() < off.len() || load.score() < score_alone => self.found.push(load),
            _ => self.found.extend(alone),
        }
        Ok(())
    }

    fn of_actuator(&self, joint: usize, (residuals, window): (&[Residual], OffWindow)) -> Option<Fit> {
        stuck::fault(self.observed, joint, window.samples)
            .or_else(|| actuator::fault(self.observed, joint, residuals, window))
    }

    /// Joints of a robot that is placed at its setpoints, and are not there.
    fn not_followed(&mut self) {
        for &joint in &self.open {
            let behind = stuck::behind_setpoint(self.observed, joint);
            self.found.extend(behind.and_then(|window| stuck::fault(self.observed, joint, window)));
        }
    }

    /// When the residual of a joint is more than the length of a step makes it, until the joint stops at a limit.
    fn off_window(&self, residuals: &[Residual], joint: usize) -> Option<OffWindow> {
        let before_limit = self.observed.samples_before_limit(joint);
        let usable = residuals.partition_point(|residual| residual.sample < before_limit);
        let residuals = &residuals[..usable];
        OffWindow::of(residuals, self.observed.samples(), joint)
    }
}
