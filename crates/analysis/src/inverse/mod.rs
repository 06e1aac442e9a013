//! `congruent ik`: joint positions that bring the tool to given poses.

mod not_reached;
mod table;
mod targets;
mod written_target;

use congruent_description::{ArmQ, JointValues, ReportedChain, RobotDescription};
use congruent_input::Finding;
use congruent_kinematics::{Arm, IkResult, IkSolver, IkTarget, KinematicsError};
use schemars::JsonSchema;
use serde::Serialize;

use self::not_reached::Reach;
use crate::arm_joints::joint_names;

pub use self::{
    not_reached::NotReached,
    targets::{InverseTarget, InverseTargets, LiveTargets, read_targets, read_targets_from},
};
pub use congruent_kinematics::{IkMethod, IkOptions, TargetPart};

/// The answer of `congruent ik`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct InverseReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The arm's independent joints, base to tip.
    pub joints: Vec<String>,
    /// The method of the solver.
    pub method: IkMethod,
    /// One entry for each target, in input order.
    pub results: Vec<InverseSolution>,
    /// Warnings about the input, among them starts outside the limits.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// The result for one target.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct InverseSolution {
    /// The target, in link `base`.
    #[serde(skip)]
    pub target: IkTarget,
    /// Whether the residuals are within tolerance.
    pub converged: bool,
    /// The best positions that were found, rad or m, always within the limits.
    pub q: JointValues,
    /// Distance from the target.
    pub residual_position_m: f64,
    /// Angle from the target; 0 for a target without orientation.
    pub residual_orientation_rad: f64,
    /// Steps that were taken.
    pub iterations: usize,
    /// Joints at a limit.
    pub limits_held: Vec<String>,
    /// Why the target is not reached, if that is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_reached: Option<NotReached>,
}

/// Solves all targets for the robot's arm, the URDF chain from `base` to `tip` with its tool.
///
/// # Errors
/// [`KinematicsError::NoJoint`] if the robot has no arm.
pub fn inverse(
    description: &RobotDescription,
    InverseTargets { targets, warnings }: &InverseTargets,
    options: &IkOptions,
) -> Result<InverseReport, KinematicsError> {
    let arm = Arm::from_description(description)?;
    let joints = joint_names(description, &arm);
    let middle = arm.middle();
    let mut solver = IkSolver::new(arm);
    let reach = Reach::new(description);
    let mut results = Vec::with_capacity(targets.len());
    for target in targets {
        let start = joints.iter().zip(&middle);
        let start: ArmQ = start.map(|(joint, middle)| *target.start.get(joint).unwrap_or(middle)).collect();
        let result = solver.solve(&target.target, &start, options, || true)?;
        let mut solved = solution(target.target, &result, &joints);
        if !solved.converged {
            solved.not_reached = reach.beyond(&target.target);
            if solved.not_reached.is_none() && target.target.part == TargetPart::Pose {
                let position = IkTarget { part: TargetPart::Position, ..target.target };
                let is_reached = solver.solve(&position, &start, options, || true)?.converged;
                solved.not_reached = is_reached.then_some(NotReached::Orientation);
            }
        }
        results.push(solved);
    }
    Ok(InverseReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        joints,
        method: options.method,
        results,
        warnings: description.warnings.iter().chain(warnings).map(Finding::from).collect(),
    })
}

fn solution(target: IkTarget, result: &IkResult<'_>, joints: &[String]) -> InverseSolution {
    InverseSolution {
        target,
        converged: result.converged,
        q: JointValues::new(joints, result.q),
        residual_position_m: result.residual_position_m,
        residual_orientation_rad: result.residual_orientation_rad,
        iterations: result.iterations,
        limits_held: result.limits_held.iter().map(|&joint| joints[joint].clone()).collect(),
        not_reached: None,
    }
}
