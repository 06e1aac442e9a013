//! The faults of a run while it goes on: they change the physics when they begin and end, and each reading.

use congruent_description::RobotQ;
use congruent_simulation::{DriveConnection, MeasuredState, Setpoint, SimulationError, World};
use nalgebra::Isometry3;

use super::{
    drives::{self, Replaced},
    encoders::{Reading, Wire, falsify},
    planned::{FaultAction, PlannedFault},
    tool,
    transport::{Delay, ReadingLoss},
};
use crate::{random_streams::fault_stream, setup::RunSetup};

/// The faults of a run with their state; a clone is a snapshot.
#[derive(Debug, Clone)]
pub(crate) struct InjectedFaults<'a> {
    faults: &'a [PlannedFault],
    states: Vec<FaultState>,
    step: u64,
    step_s: f64,
    /// By which drive the reading of each joint comes; `None` for its own.
    wires: Vec<Option<Wire>>,
    /// Where stuck joints stand, for a controller that places the robot.
    held: Vec<Option<f64>>,
    /// The true state, what encoders give of it, what sensors make of that, and what arrives.
    truth: Reading,
    encoders: Reading,
    arrived: Reading,
    placed: (RobotQ, Vec<f64>),
}

/// The state of one fault.
#[derive(Debug, Clone)]
struct FaultState {
    is_active: bool,
    replaced: Replaced,
    delay: Option<Delay>,
    loss: Option<ReadingLoss>,
}

impl<'a> InjectedFaults<'a> {
    /// The faults at the first sample, which is of the world as it is.
    ///
    /// # Errors
    /// [`SimulationError`] if the physics refuses a fault.
    pub(crate) fn new(setup: &'a RunSetup, world: &mut World) -> Result<Self, SimulationError> {
        let dof = world.q().len();
        let faults = setup.faults.as_slice();
        let mut truth = Reading::new(dof);
        read_truth(world, &mut truth);
        let state = |(index, fault): (usize, &PlannedFault)| FaultState {
            is_active: false,
            replaced: Replaced::default(),
            delay: match fault.action {
                FaultAction::Latency { steps } => Some(Delay::new(steps, dof)),
                _ => None,
            },
            loss: match fault.action {
                FaultAction::DroppedSamples { share } => {
                    Some(ReadingLoss::new(share, setup.scenario.seed, fault_stream(index)))
                }
                _ => None,
            },
        };
        let mut injected = Self {
            faults,
            states: faults.iter().enumerate().map(state).collect(),
            step: 0,
            step_s: setup.clock.step_s,
            wires: vec![None; dof],
            held: vec![None; dof],
            encoders: truth.clone(),
            arrived: truth.clone(),
            truth,
            placed: (RobotQ::zeros(dof), vec![0.0; dof]),
        };
        // A fault from 0 s on is in the first sample already.
        injected.advance(0, world)?;
        Ok(injected)
    }

    /// The sample with this number: faults begin and end, and the encoders read the world. What sensors make of
    /// [`InjectedFaults::encoders`] is sent to the controller by [`InjectedFaults::send`].
    ///
    /// # Errors
    /// As [`InjectedFaults::new`].
    pub(crate) fn advance(&mut self, step: u64, world: &mut World) -> Result<(), SimulationError> {
        self.step = step;
        read_truth(world, &mut self.truth);
        if self.faults.is_empty() {
            self.encoders.copy_from(&self.truth);
            return Ok(());
        }
        self.begin_and_end(world)?;
        self.read_encoders();
        Ok(())
    }

    /// What the encoders give, before noise and resolution.
    pub(crate) fn encoders(&self) -> MeasuredState<'_> {
        MeasuredState { q: &self.encoders.q, qd: &self.encoders.qd }
    }

    /// Sends a reading of the encoders to the controller: it arrives now, late, or not at all. The efforts that the drives
    /// report go the same way.
    pub(crate) fn send(&mut self, reading: &MeasuredState<'_>) {
        self.encoders.q.copy_from_slice(reading.q);
        self.encoders.qd.copy_from_slice(reading.qd);
        let (mut late, mut is_lost) = (None, false);
        for state in &mut self.states {
            if let Some(delay) = &mut state.delay {
                delay.take(&self.encoders);
                late = if state.is_active { Some(&*delay) } else { late };
            }
            is_lost |= state.is_active && state.loss.as_mut().is_some_and(ReadingLoss::is_lost);
        }
        // Before the first reading there is none that could take its place.
        if !is_lost || self.step == 0 {
            self.arrived.copy_from(late.map_or(&self.encoders, Delay::late));
        }
    }

    fn begin_and_end(&mut self, world: &mut World) -> Result<(), SimulationError> {
        let mut has_changed = false;
        for (fault, state) in self.faults.iter().zip(&mut self.states) {
            let now = fault.is_active_at(self.step);
            if std::mem::replace(&mut state.is_active, now) == now {
                continue;
            }
            has_changed = true;
            if now {
                state.replaced = drives::begin(&fault.action, world)?;
            } else {
                drives::end(&fault.action, state.replaced, world)?;
            }
            for (joint, wire) in Wire::for_fault(&fault.action, world.q()) {
                self.wires[joint] = now.then_some(wire);
                // The controller of `joint` reads `drive`, so the drive has to get the commands of `joint`: encoders
                // alone exchanged would make the loop unstable at once.
                let own = DriveConnection { commanded_as: wire.drive, is_reversed: false };
                let connected = DriveConnection { commanded_as: joint, is_reversed: wire.is_reversed() };
                world.set_connection(wire.drive, if now { connected } else { own });
            }
            if let FaultAction::StuckJoint { joint } = fault.action {
                self.held[joint] = now.then_some(world.q()[joint]);
            }
        }
        // All loads anew, since `set_carried_unknown` replaces them; and only at a change, since inertias are then
        // summed again.
        if has_changed {
            let active = self.faults.iter().zip(&self.states).filter(|(_, state)| state.is_active);
            let loads: Vec<_> = active.filter_map(|(fault, _)| drives::load(&fault.action)).collect();
            world.set_carried_unknown(&loads);
        }
        Ok(())
    }

    fn read_encoders(&mut self) {
        self.encoders.copy_from(&self.truth);
        for (joint, wire) in self.wires.iter().enumerate() {
            // From the truth, not from `encoders`: of two exchanged joints the first would otherwise be read twice.
            if let Some(wire) = wire {
                wire.read(joint, &self.truth, &mut self.encoders);
            }
        }
        // Offsets after the wires: they belong to the reading of a joint, whichever drive it comes from.
        for (fault, state) in self.faults.iter().zip(&self.states) {
            if state.is_active {
                #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
                let since_s = (self.step - fault.from_step) as f64 * self.step_s;
                falsify(&fault.action, since_s, &mut self.encoders);
            }
        }
    }

    /// The state that arrives at the controller.
    pub(crate) fn measured(&self) -> MeasuredState<'_> {
        MeasuredState { q: &self.arrived.q, qd: &self.arrived.qd }
    }

    /// The efforts that the drives report.
    pub(crate) fn reported_effort(&self) -> &[f64] {
        &self.arrived.effort
    }

    /// Where a controller that places the robot at a setpoint places it; see [`InjectedFaults::place`].
    pub(crate) fn placed<'s>(&'s self, setpoint: Setpoint<'s>) -> Setpoint<'s> {
        if self.places_as_asked() {
            return setpoint;
        }
        let (q, qd) = &self.placed;
        // A robot that is placed has no use for accelerations.
        Setpoint { q, qd, qdd: setpoint.qdd }
    }

    /// Computes where a controller that places the robot at a setpoint places it.
    pub(crate) fn place(&mut self, setpoint: &Setpoint<'_>) {
        if self.places_as_asked() {
            return;
        }
        let (q, qd) = &mut self.placed;
        q.copy_from_slice(setpoint.q);
        qd.copy_from_slice(setpoint.qd);
        for (joint, wire) in self.wires.iter().enumerate() {
            if let Some(wire) = wire {
                (q[wire.drive], qd[wire.drive]) = wire.driven(setpoint.q[joint], setpoint.qd[joint]);
            }
        }
        // Last: a stuck joint stays wherever a wire would send it.
        for (joint, held) in self.held.iter().enumerate() {
            if let Some(held) = held {
                (q[joint], qd[joint]) = (*held, 0.0);
            }
        }
    }

    fn places_as_asked(&self) -> bool {
        self.wires.iter().all(Option::is_none) && self.held.iter().all(Option::is_none)
    }

    /// Moves the links of a tool at another pose.
    pub(crate) fn move_tool(&self, root_from_links: &mut [Isometry3<f64>]) {
        for (fault, state) in self.faults.iter().zip(&self.states) {
            if state.is_active {
                tool::shift(&fault.action, root_from_links);
            }
        }
    }
}

fn read_truth(world: &World, truth: &mut Reading) {
    truth.q.copy_from_slice(world.q());
    truth.qd.copy_from_slice(world.qd());
    truth.effort.copy_from_slice(world.asked_torque());
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use congruent_description::load_robot;
    use congruent_simulation::{Gains, Pd, WorldSettings};

    use super::*;
    use congruent_scenario::{
        ControllerKind, ControllerSettings, DroppedSamplesFault, EncoderDriftFault, FaultSettings,
        JointFault, LatencyFault, Scenario,
    };

    fn setup() -> RunSetup {
        let description =
            load_robot(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e")).unwrap();
        let elbow = "elbow_joint".to_owned();
        let drift = EncoderDriftFault {
            joint: elbow,
            rate_deg_per_s: Some(2.0),
            at_s: 0.01,
            ..EncoderDriftFault::default()
        };
        let flipped = JointFault { joint: "wrist_1_joint".to_owned(), at_s: 0.02, until_s: Some(0.07) };
        let mut scenario = Scenario {
            name: "faults".to_owned(),
            seed: 3,
            controller: ControllerSettings {
                kind: ControllerKind::Pd,
                stiffness: 100.0.into(),
                damping: 5.0.into(),
                ..ControllerSettings::default()
            },
            fault: vec![
                FaultSettings::EncoderDrift(drift),
                FaultSettings::FlippedAxis(flipped),
                FaultSettings::Latency(LatencyFault { time_s: 0.002, at_s: 0.03, until_s: None }),
                FaultSettings::DroppedSamples(DroppedSamplesFault { share: 0.4, at_s: 0.0, until_s: None }),
            ],
            ..Scenario::default()
        };
        scenario.simulation.duration_s = Some(0.1);
        RunSetup::new(scenario, description).unwrap()
    }

    /// One sample with exact sensors.
    fn advance(faults: &mut InjectedFaults<'_>, step: u64, world: &mut World) {
        faults.advance(step, world).unwrap();
        let (q, qd) = (faults.encoders().q.clone(), faults.encoders().qd.to_vec());
        faults.send(&MeasuredState { q: &q, qd: &qd });
    }

    /// The measured positions of the following steps.
    fn measured(world: &mut World, faults: &mut InjectedFaults<'_>, steps: u64) -> Vec<Vec<u64>> {
        let target = RobotQ::zeros(6);
        let mut pd = Pd { gains: vec![Gains { stiffness: 100.0, damping: 5.0 }; 6] };
        (0..steps)
            .map(|_| {
                let setpoint = Setpoint { q: &target, qd: &[0.0; 6], qdd: &[0.0; 6] };
                world.step_measured(&mut pd, &setpoint, &faults.measured()).unwrap();
                advance(faults, world.step_count(), world);
                faults.measured().q.iter().map(|q| q.to_bits()).collect()
            })
            .collect()
    }

    #[test]
    fn a_clone_goes_on_as_the_original() {
        let setup = setup();
        let mut world = World::new(&setup.description.robot, &WorldSettings::default()).unwrap();
        let mut faults = InjectedFaults::new(&setup, &mut world).unwrap();
        measured(&mut world, &mut faults, 40);
        let (snapshot, mut cloned) = (world.snapshot(), faults.clone());
        let first = measured(&mut world, &mut faults, 50);
        world.restore(&snapshot);
        assert_eq!(measured(&mut world, &mut cloned, 50), first);
        let repeats = first.windows(2).filter(|pair| pair[0] == pair[1]).count();
        assert!((10..30).contains(&repeats), "{repeats} of 49 readings got lost, with a share of 0.4");
    }

    #[test]
    fn a_flipped_axis_and_its_end() {
        let setup = setup();
        let mut world = World::new(&setup.description.robot, &WorldSettings::default()).unwrap();
        let faults = &setup.faults[1..2];
        let mut injected = InjectedFaults { faults, ..InjectedFaults::new(&setup, &mut world).unwrap() };
        injected.states = vec![injected.states[1].clone()];
        injected.begin_and_end(&mut world).unwrap();
        let at = |world: &mut World, injected: &mut InjectedFaults<'_>, step: u64, q: f64| {
            let mut all = RobotQ::zeros(6);
            all[3] = q;
            world.set_state(&all, &[0.5; 6]).unwrap();
            advance(injected, step, world);
            (injected.measured().q[3], injected.measured().qd[3])
        };
        assert_eq!(at(&mut world, &mut injected, 20, 0.25), (0.25, -0.5));
        assert_eq!(at(&mut world, &mut injected, 30, 0.75), (-0.25, -0.5));
        assert_eq!(at(&mut world, &mut injected, 70, 0.75), (0.75, 0.5));
    }
}
