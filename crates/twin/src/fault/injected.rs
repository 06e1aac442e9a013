//! The faults of a run while it goes on: they change the physics when they begin and end, and each reading.

use congruent_description::RobotQ;
use congruent_simulation::{DriveConnection, MeasuredState, Setpoint, SimulationError, World};
use nalgebra::Isometry3;

use super::{
    drives::{self, Replaced},
    encoders::{Reading, Wire, falsify},
    planned::{FaultAction, PlannedFault},
    tool,
    transport::{Delay, Loss},
};
use crate::setup::RunSetup;

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
    /// The true state, what encoders give of it, and what arrives.
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
    loss: Option<Loss>,
}

impl<'a> InjectedFaults<'a> {
    /// The faults before the first sample, which is of the world as it is.
    ///
    /// # Errors
    /// [`SimulationError`] if the physics refuses a fault.
    pub(crate) fn new(setup: &'a RunSetup, world: &mut World) -> Result<Self, SimulationError> {
        let dof = world.q().len();
        let faults = setup.faults.as_slice();
        let mut truth = Reading::new(dof);
        read_truth(world, &mut truth);
        let state = |(stream, fault): (u64, &PlannedFault)| FaultState {
            is_active: false,
            replaced: Replaced::default(),
            delay: match fault.action {
                FaultAction::Latency { steps } => Some(Delay::new(steps, &truth)),
                _ => None,
            },
            loss: match fault.action {
                FaultAction::DroppedSamples { share } => Some(Loss::new(share, setup.scenario.seed, stream)),
                _ => None,
            },
        };
        let mut injected = Self {
            faults,
            states: (0..).zip(faults).map(state).collect(),
            step: 0,
            step_s: setup.clock.step_s,
            wires: vec![None; dof],
            held: vec![None; dof],
            encoders: truth.clone(),
            arrived: truth.clone(),
            truth,
            placed: (RobotQ::zeros(dof), vec![0.0; dof]),
        };
        injected.advance(0, world)?;
        Ok(injected)
    }

    /// The sample with this number: faults begin and end, and the state of the world is read.
    ///
    /// # Errors
    /// As [`InjectedFaults::new`].
    pub(crate) fn advance(&mut self, step: u64, world: &mut World) -> Result<(), SimulationError> {
        self.step = step;
        read_truth(world, &mut self.truth);
        if self.faults.is_empty() {
            self.arrived.copy_from(&self.truth);
            return Ok(());
        }
        self.begin_and_end(world)?;
        self.read();
        Ok(())
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
            for (joint, wire) in Wire::of(&fault.action, world.q()) {
                self.wires[joint] = now.then_some(wire);
                let own = DriveConnection { commanded_as: wire.drive, is_reversed: false };
                let connected = DriveConnection { commanded_as: joint, is_reversed: wire.is_reversed() };
                world.set_connection(wire.drive, if now { connected } else { own });
            }
            if let FaultAction::StuckJoint { joint } = fault.action {
                self.held[joint] = now.then_some(world.q()[joint]);
            }
        }
        if has_changed {
            let active = self.faults.iter().zip(&self.states).filter(|(_, state)| state.is_active);
            let loads: Vec<_> = active.filter_map(|(fault, _)| drives::load(&fault.action)).collect();
            world.set_carried_unknown(&loads);
        }
        Ok(())
    }

    fn read(&mut self) {
        self.encoders.copy_from(&self.truth);
        for (joint, wire) in self.wires.iter().enumerate() {
            if let Some(wire) = wire {
                wire.read(joint, &self.truth, &mut self.encoders);
            }
        }
        let mut is_lost = false;
        for (fault, state) in self.faults.iter().zip(&mut self.states) {
            if state.is_active {
                #[expect(clippy::cast_precision_loss, reason = "steps of a run are far below 2^52")]
                let since_s = (self.step - fault.from_step) as f64 * self.step_s;
                falsify(&fault.action, since_s, &mut self.encoders);
                is_lost |= state.loss.as_mut().is_some_and(Loss::is_lost);
            }
        }
        let mut late = None;
        for state in &mut self.states {
            if let Some(delay) = &mut state.delay {
                delay.take(&self.encoders);
                late = if state.is_active { Some(&*delay) } else { late };
            }
        }
        if !is_lost {
            self.arrived.copy_from(late.map_or(&self.encoders, Delay::late));
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

    /// Where a controller that places the robot at a setpoint places it.
    pub(crate) fn placed<'s>(&'s mut self, setpoint: Setpoint<'s>) -> Setpoint<'s> {
        let is_usual = self.wires.iter().all(Option::is_none) && self.held.iter().all(Option::is_none);
        if is_usual {
            return setpoint;
        }
        let (q, qd) = &mut self.placed;
        q.copy_from_slice(setpoint.q);
        qd.copy_from_slice(setpoint.qd);
        for (joint, wire) in self.wires.iter().enumerate() {
            if let Some(wire) = wire {
                (q[wire.drive], qd[wire.drive]) = wire.driven(setpoint.q[joint], setpoint.qd[joint]);
            }
        }
        for (joint, held) in self.held.iter().enumerate() {
            if let Some(held) = held {
                (q[joint], qd[joint]) = (*held, 0.0);
            }
        }
        // A robot that is placed has no use for accelerations.
        Setpoint { q, qd, qdd: setpoint.qdd }
    }

    /// Moves the links of a tool that stands elsewhere.
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
