//! `congruent jacobian`: the velocity of a link by the velocities of the joints.

use congruent_description::{Finding, JointState, LinkIndex, ReportedChain, RobotDescription, RobotQ};
use congruent_kinematics::{Jacobian, KinematicsError, UrdfTree};
use nalgebra::Matrix3xX;
use schemars::JsonSchema;
use serde::Serialize;

pub use congruent_kinematics::JacobianKind;

/// A Jacobian as programs read it: named blocks, since half the field stacks linear first and half
/// angular first. Columns are in the order of the report's joints.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JacobianBlocks {
    /// Three rows: m/s for each rad/s or m/s.
    pub linear: [Vec<f64>; 3],
    /// Three rows: rad/s for each rad/s or m/s.
    pub angular: [Vec<f64>; 3],
}

impl From<&Jacobian> for JacobianBlocks {
    fn from(jacobian: &Jacobian) -> Self {
        Self { linear: rows(&jacobian.linear()), angular: rows(&jacobian.angular()) }
    }
}

fn rows(block: &Matrix3xX<f64>) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|row| block.row(row).iter().copied().collect())
}

/// The Jacobian at one configuration.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JacobianResult {
    /// The Jacobian itself.
    #[serde(flatten)]
    pub jacobian: JacobianBlocks,
    /// Its time derivative at the given joint velocities, each entry per s; absent unless it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivative: Option<JacobianBlocks>,
}

/// The answer of `congruent jacobian`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JacobianReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Movable joints, in the order of columns; mimic joints have columns of their own.
    pub joints: Vec<String>,
    /// The link that moves.
    pub link: String,
    /// Its frame and point.
    pub kind: JacobianKind,
    /// One entry for each configuration, in input order.
    pub results: Vec<JacobianResult>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Jacobians of one link at each configuration, from the URDF chain.
///
/// # Errors
/// [`KinematicsError::JointCount`] for a configuration of another length.
pub fn jacobians(
    description: &RobotDescription,
    link: LinkIndex,
    kind: JacobianKind,
    configurations: &[RobotQ],
) -> Result<JacobianReport, KinematicsError> {
    let tree = UrdfTree::new(&description.robot);
    let at = |q: &RobotQ| {
        let jacobian = tree.jacobian(q, link, kind)?;
        Ok(JacobianResult { jacobian: JacobianBlocks::from(&jacobian), derivative: None })
    };
    let results = configurations.iter().map(at).collect::<Result<_, KinematicsError>>()?;
    Ok(report(description, link, kind, results))
}

/// Jacobians of one link and their time derivatives, from the URDF chain.
///
/// # Errors
/// [`KinematicsError::JointCount`] for positions or velocities of another length.
pub fn jacobians_in_motion(
    description: &RobotDescription,
    link: LinkIndex,
    kind: JacobianKind,
    states: &[JointState],
) -> Result<JacobianReport, KinematicsError> {
    let tree = UrdfTree::new(&description.robot);
    let at = |JointState { q, qd, .. }: &JointState| {
        let jacobian = tree.jacobian(q, link, kind)?;
        let derivative = Some(JacobianBlocks::from(&jacobian.rate(qd)?));
        Ok(JacobianResult { jacobian: JacobianBlocks::from(&jacobian), derivative })
    };
    let results = states.iter().map(at).collect::<Result<_, KinematicsError>>()?;
    Ok(report(description, link, kind, results))
}

fn report(
    description: &RobotDescription,
    link: LinkIndex,
    kind: JacobianKind,
    results: Vec<JacobianResult>,
) -> JacobianReport {
    let robot = &description.robot;
    JacobianReport {
        chain: description.reported_chain(),
        robot: robot.name().to_owned(),
        joints: robot.movable_joint_names().map(str::to_owned).collect(),
        link: robot.link(link).name.clone(),
        kind,
        results,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    }
}
