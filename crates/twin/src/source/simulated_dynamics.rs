//! Joint torques and accelerations by physics, for comparisons that do not know the engine.

use congruent_description::{Robot, RobotQ};
use congruent_dynamics::{DrivenState, JointDynamics, JointDynamicsError};
use congruent_input::display::quantity;
use congruent_simulation::{Setpoint, SimulationError, Torque, World, WorldSettings};
use nalgebra::DMatrix;

use super::friction_at_rest::{coupled_inverse, hold};

/// The physics twin of a robot as a source of dynamics: it is stepped once from each state, with several lengths of
/// step, and the accelerations are extrapolated to a step of no length.
///
/// Limits of position and effort are left out: a state outside of them has dynamics as well.
pub struct SimulatedDynamics {
    coupled: Stepped,
    independent: Stepped,
}

/// Longest step. Kind: balance of truncation after extrapolation, about 1e-11 of the acceleration, with rounding in the shortest
/// step, about as much.
const LONGEST_STEP_S: f64 = 1e-4;
/// Part `x` of the speed that damping may take in the longest step, since the engine damps implicitly. The error after
/// extrapolation is the product of all shares, `x^5 / 1024`, of the damping torque; rounding grows as steps become shorter.
const DAMPED_SHARE: f64 = 0.02;
/// Speed that dry friction may take in the longest step, rad/s and m/s: a joint that it stops within the step shows less than the
/// full friction. The sampled states have a speed of at least 0.2.
const BRAKED_SPEED: f64 = 0.02;

impl std::fmt::Debug for SimulatedDynamics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SimulatedDynamics").finish_non_exhaustive()
    }
}

impl SimulatedDynamics {
    /// Worlds with this robot and nothing else.
    ///
    /// # Errors
    /// [`SimulationError`] if the robot cannot be simulated.
    pub fn new(robot: &Robot) -> Result<Self, SimulationError> {
        Self::with_part_of_step(robot, 1.0)
    }

    /// The same with steps that are a part of those: an answer that changes with them is one of the steps, not of the robot.
    ///
    /// # Errors
    /// As [`SimulatedDynamics::new`].
    pub fn with_part_of_step(robot: &Robot, part: f64) -> Result<Self, SimulationError> {
        // Without limits: stops and clipped efforts would be part of the measured acceleration.
        let unlimited = robot.with_joints(|joint| joint.limit = None);
        // Comparisons need the torques of each coordinate; couplings would mix those of followers into their masters.
        let independent = unlimited.with_joints(|joint| joint.mimic = None);
        Ok(Self { coupled: Stepped::new(&unlimited, part)?, independent: Stepped::new(&independent, part)? })
    }
}

impl JointDynamics for SimulatedDynamics {
    fn gravity_into(&mut self, q: &RobotQ, tau: &mut [f64]) -> Result<(), JointDynamicsError> {
        let world = self.independent.placed(q)?;
        tau.copy_from_slice(world.gravity_torque().as_slice());
        Ok(())
    }

    fn mass_matrix_into(&mut self, q: &RobotQ, matrix: &mut DMatrix<f64>) -> Result<(), JointDynamicsError> {
        matrix.copy_from(&self.independent.placed(q)?.mass_matrix());
        Ok(())
    }

    fn independent_forward_into(
        &mut self,
        state: &DrivenState<'_>,
        qdd: &mut [f64],
    ) -> Result<(), JointDynamicsError> {
        self.independent.accelerations_into(state, qdd)
    }

    fn forward_into(&mut self, state: &DrivenState<'_>, qdd: &mut [f64]) -> Result<(), JointDynamicsError> {
        self.coupled.accelerations_into(state, qdd)
    }
}

/// The steps of the worlds, as parts of the longest.
const SHARES: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];

/// A joint is taken for one that dry friction may stop within the step if the friction of all joints together could take a
/// larger share of its speed, or if its speed changes by a larger share. No unit; kind: choice below 1: the engine balances
/// the joints one after the other, and while it does so each may feel the friction of the others alone.
const MOST_CHANGED: f64 = 0.5;
/// The factor by which a step becomes shorter then, and how often it may. Kind: rounding of differences of speeds up to
/// 2 rad/s, which in steps of 1e-5 of the usual ones is 1e-7 of the accelerations.
const SHORTER: f64 = 0.1;
const MOST_SHORTENED: usize = 5;

/// The engine's constraints yield within some time, whatever the step is: below the speed that dry friction takes in this
/// time it is proportional to the speed. Unit: s; kind: measured, 8e-8 for links of 5e-6 and 3e-5 kg m^2.
const YIELD_S: f64 = 1e-7;

/// A joint is so slow that the physics does not show its full dry friction.
#[derive(Debug, thiserror::Error)]
#[error(
    "joint \"{joint}\" moves at {speed}, so slowly that dry friction stops it within any step of the physics, and its \
     acceleration is not known: give a larger speed, or 0"
)]
struct StoppedByFriction {
    joint: String,
    speed: String,
}

/// One robot in a world for each length of step.
struct Stepped {
    step_s: f64,
    /// Worlds with the usual steps, then those with shorter ones, made when a state needs them.
    worlds: [Vec<World>; MOST_SHORTENED + 1],
    robot: Robot,
    /// Dry friction of each joint.
    frictions: Vec<f64>,
}

/// Accelerations of each joint by the dry friction of all joints together, and by its own.
#[derive(Default)]
struct Braking {
    by_all: Vec<f64>,
    by_own: Vec<f64>,
}

impl Stepped {
    fn new(robot: &Robot, part: f64) -> Result<Self, SimulationError> {
        let step_s = part * undamped_step_s(robot)?;
        let frictions = robot.movable_joints().iter().map(|&joint| robot.joint(joint).friction).collect();
        let mut all = [const { Vec::new() }; MOST_SHORTENED + 1];
        all[0] = worlds(robot, step_s)?;
        Ok(Self { worlds: all, step_s, robot: robot.clone(), frictions })
    }

    /// A world with the robot at rest.
    fn placed(&mut self, q: &RobotQ) -> Result<&World, JointDynamicsError> {
        let at_rest = vec![0.0; q.len()];
        self.worlds[0][0].set_state(q, &at_rest).map_err(JointDynamicsError::source)?;
        Ok(&self.worlds[0][0])
    }

    /// The accelerations at a state, by steps in which dry friction stops no joint.
    fn accelerations_into(
        &mut self,
        state: &DrivenState<'_>,
        qdd: &mut [f64],
    ) -> Result<(), JointDynamicsError> {
        let Braking { by_all, by_own } = self.braking(state.q)?;
        let yielding: Vec<f64> = by_own.iter().map(|braking| MOST_CHANGED * braking * YIELD_S).collect();
        if let Some(joint) = self.first_stopped(&yielding, state.qd) {
            return Err(self.stopped(joint, state.qd));
        }
        let at_rest: Vec<usize> = (0..state.qd.len())
            .filter(|&joint| self.frictions[joint] > 0.0 && state.qd[joint] == 0.0)
            .collect();
        let frictions = self.frictions.clone();
        let mut stopped = None;
        for shortened in 0..=MOST_SHORTENED {
            let step_s = self.step_s * (0..shortened).map(|_| SHORTER).product::<f64>();
            let mut changes: Vec<f64> = by_all.iter().map(|braking| braking * step_s).collect();
            if self.first_stopped(&changes, state.qd).is_none() {
                let worlds = self.worlds_of(shortened, step_s).map_err(JointDynamicsError::source)?;
                // Steps would show how the engine's friction creeps; `hold` below adds that of joints at rest.
                release(worlds, &at_rest, &frictions).map_err(JointDynamicsError::source)?;
                changes =
                    extrapolated_into(worlds, step_s, state, qdd).map_err(JointDynamicsError::source)?;
            }
            stopped = self.first_stopped(&changes, state.qd);
            if stopped.is_none() {
                break;
            }
        }
        if let Some(joint) = stopped {
            return Err(self.stopped(joint, state.qd));
        }
        if !at_rest.is_empty() {
            let mass_matrix = self.placed(state.q)?.mass_matrix();
            // A singular matrix: the step itself has reported the joint without inertia.
            if let Some(inverse) = coupled_inverse(&self.robot, &mass_matrix) {
                hold(qdd, &at_rest, &self.frictions, &inverse);
            }
        }
        Ok(())
    }

    fn stopped(&self, joint: usize, qd: &[f64]) -> JointDynamicsError {
        let stopped = self.robot.joint(self.robot.movable_joints()[joint]);
        let speed = quantity(qd[joint], &format!("{}/s", stopped.kind.unit()));
        JointDynamicsError::source(StoppedByFriction { joint: stopped.name.clone(), speed })
    }

    /// The worlds whose longest step is this one.
    fn worlds_of(&mut self, shortened: usize, step_s: f64) -> Result<&mut [World], SimulationError> {
        if self.worlds[shortened].is_empty() {
            self.worlds[shortened] = worlds(&self.robot, step_s)?;
        }
        Ok(&mut self.worlds[shortened])
    }

    /// The largest accelerations that dry friction can give to each joint; none without friction.
    fn braking(&mut self, q: &RobotQ) -> Result<Braking, JointDynamicsError> {
        if self.frictions.iter().all(|friction| *friction == 0.0) {
            return Ok(Braking::default());
        }
        let Some(inverse) = self.placed(q)?.mass_matrix().try_inverse() else {
            return Ok(Braking::default());
        };
        let by = |joint: usize, other: usize| inverse[(joint, other)].abs() * self.frictions[other];
        let joints = 0..self.frictions.len();
        Ok(Braking {
            by_all: joints.clone().map(|joint| joints.clone().map(|other| by(joint, other)).sum()).collect(),
            by_own: joints.map(|joint| by(joint, joint)).collect(),
        })
    }

    /// The first joint with dry friction whose speed changes too much. At rest friction holds a joint, or does not; neither
    /// depends on the step.
    fn first_stopped(&self, changes: &[f64], qd: &[f64]) -> Option<usize> {
        let joints = changes.iter().zip(qd).zip(&self.frictions);
        joints
            .enumerate()
            .find(|(_, ((change, qd), friction))| {
                **friction > 0.0 && **qd != 0.0 && change.abs() > MOST_CHANGED * qd.abs()
            })
            .map(|(joint, _)| joint)
    }
}

/// Gives every joint its dry friction except those at rest.
fn release(worlds: &mut [World], at_rest: &[usize], frictions: &[f64]) -> Result<(), SimulationError> {
    for world in worlds {
        for (joint, &friction) in frictions.iter().enumerate().filter(|(_, friction)| **friction > 0.0) {
            world.set_dry_friction(joint, if at_rest.contains(&joint) { 0.0 } else { friction })?;
        }
    }
    Ok(())
}

/// The polynomial in the length of the step, at a length of zero. Returns the changes of speeds in the longest step.
fn extrapolated_into(
    worlds: &mut [World],
    longest_s: f64,
    state: &DrivenState<'_>,
    qdd: &mut [f64],
) -> Result<Vec<f64>, SimulationError> {
    let (mut torques, still) = (Torque(state.tau.to_vec()), vec![0.0; state.qd.len()]);
    let mut found = [const { Vec::new() }; SHARES.len()];
    for ((world, found), share) in worlds.iter_mut().zip(&mut found).zip(SHARES) {
        // Each world from the same state: the answer must not depend on the states before.
        world.set_state(state.q, state.qd)?;
        world.step(&mut torques, &Setpoint { q: state.q, qd: state.qd, qdd: &still })?;
        let step_s = longest_s * share;
        found.extend(world.qd().iter().zip(state.qd).map(|(after, before)| (after - before) / step_s));
    }
    for (joint, qdd) in qdd.iter_mut().enumerate() {
        *qdd = at_zero(std::array::from_fn(|world| found[world][joint]));
    }
    Ok(found[0].iter().map(|acceleration| acceleration * longest_s).collect())
}

/// The value at zero of the polynomial through values at [`SHARES`] (Neville's scheme: Press et al., Numerical Recipes,
/// 3rd edition, equation 3.2.3).
fn at_zero(mut values: [f64; SHARES.len()]) -> f64 {
    for order in 1..values.len() {
        for at in 0..values.len() - order {
            let [coarse, fine] = [SHARES[at], SHARES[at + order]];
            values[at] = (coarse * values[at + 1] - fine * values[at]) / (coarse - fine);
        }
    }
    values[0]
}

/// A step in which damping and friction take but a small share of a joint's speed, whatever the other joints do.
fn undamped_step_s(robot: &Robot) -> Result<f64, SimulationError> {
    let Some(inverse) = world(robot, LONGEST_STEP_S)?.mass_matrix().try_inverse() else {
        // A singular mass matrix: the step itself reports the joint without inertia.
        return Ok(LONGEST_STEP_S);
    };
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    // A torque t changes the speed of its joint by (M^-1)_ii t h in a step h, so damping takes the share d (M^-1)_ii h of it.
    let steps_s = joints.enumerate().map(|(row, joint)| {
        let lightness = inverse[(row, row)].abs();
        // Without damping or friction the quotient is infinite, and the longest step holds.
        (DAMPED_SHARE / (joint.damping * lightness)).min(BRAKED_SPEED / (joint.friction * lightness))
    });
    Ok(steps_s.fold(LONGEST_STEP_S, f64::min))
}

fn worlds(robot: &Robot, longest_s: f64) -> Result<Vec<World>, SimulationError> {
    SHARES.into_iter().map(|share| world(robot, longest_s * share)).collect()
}

fn world(robot: &Robot, step_s: f64) -> Result<World, SimulationError> {
    World::new(robot, &WorldSettings { step_s, ..WorldSettings::default() })
}

#[cfg(test)]
mod tests {
    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    use super::*;

    /// Two links in a plane, 2 kg and 1 kg, with frictions of 5 and 2 N m.
    const PENDULUM: &str = r#"<robot name="p"><link name="b"/>
      <link name="a"><inertial><origin xyz="0.5 0 0"/><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <link name="c"><inertial><origin xyz="0.3 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="j" type="continuous"><parent link="b"/><child link="a"/><axis xyz="0 0 1"/><dynamics friction="5" damping="1"/></joint>
      <joint name="k" type="continuous"><parent link="a"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
        <dynamics friction="2" damping="1"/></joint></robot>"#;

    #[test]
    fn a_joint_that_friction_holds_has_no_acceleration() {
        /// rad/s^2. Kind: rounding of the extrapolation; worst seen 1e-9.
        const ACCELERATION: f64 = 1e-7;
        let source = SourceFile { path: "p.urdf".into(), text: PENDULUM.to_owned(), is_foreign: false };
        let robot = parse_robot(None, &source.into()).unwrap().robot;
        let mut physics = SimulatedDynamics::new(&robot).unwrap();
        let q = RobotQ::zeros(2);
        let mut found = |tau: [f64; 2]| {
            let mut qdd = [0.0; 2];
            physics.forward_into(&DrivenState { q: &q, qd: &[0.0; 2], tau: &tau }, &mut qdd).unwrap();
            qdd
        };
        let held = found([3.0, 0.0]);
        assert!(held.iter().all(|qdd| *qdd == 0.0), "{held:?}");
        // The inertia about the first axis, with the second joint held: 2 (0.5^2) + 0.01 + 1.3^2 + 0.01.
        let moved = found([10.0, 1.9]);
        assert!((moved[0] - 5.0 / 2.21).abs() < ACCELERATION && moved[1] == 0.0, "{moved:?}");
    }

    #[test]
    fn a_damped_speed_is_extrapolated_to_a_step_of_zero() {
        // Of `1 / (1 + x)`, the speed after an implicit step that takes the share `x` of it.
        let remainder = at_zero(SHARES.map(|share| 1.0 / (1.0 + DAMPED_SHARE * share))) - 1.0;
        assert!(remainder.abs() < 5e-12, "{remainder:e}");
        let polynomial = |share: f64| 3.0 - 2.0 * share + share.powi(4);
        assert!((at_zero(SHARES.map(polynomial)) - 3.0).abs() < 1e-14);
    }
}
