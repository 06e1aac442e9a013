//! `congruent dynamics --base-parameters`: the combinations of inertial parameters that are identifiable from joint torques.

use congruent_description::{DrivenCoordinates, Followers, JointIndex, RobotDescription, RobotQ};
use congruent_dynamics::{BodyTree, DynamicsError, InertialParameter, JointMotionState};
use congruent_input::Finding;
use congruent_kinematics::{Uniform, range};
use schemars::JsonSchema;
use serde::Serialize;

/// An inertial parameter of a body: the links that move as one with the link of its joint.
///
/// Parameters are those of the frame of that link: `ixx` to `izz` about its origin, `mx`, `my`, `mz` mass times centre of
/// mass, `m` mass.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct NamedParameter {
    /// The joint that carries the body.
    pub joint: String,
    /// The link of that joint.
    pub link: String,
    /// `ixx`, `ixy`, `ixz`, `iyy`, `iyz`, `izz`, `mx`, `my`, `mz` or `m`.
    pub parameter: &'static str,
}

/// A parameter that is added to a base parameter.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct GroupedParameter {
    /// The parameter that is added.
    #[serde(flatten)]
    pub of: NamedParameter,
    /// Its factor in the sum.
    pub coefficient: f64,
}

/// A sum of parameters that are identifiable only together.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedBaseParameter {
    /// The parameter that the sum is named by; its factor is 1.
    #[serde(flatten)]
    pub of: NamedParameter,
    /// The parameters that are added to it, with their factors.
    pub grouped: Vec<GroupedParameter>,
    /// Value of the sum by the description.
    pub value: f64,
    /// Unit of the value: `kg m^2`, `kg m` or `kg`.
    pub unit: &'static str,
}

/// The answer of `congruent dynamics --base-parameters`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BaseParameterReport {
    /// Path of the URDF.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// The driven joints, whose torques are meant: the torque of a joint that follows another by `<mimic>` acts on that one.
    /// With `--free-followers` all moving joints, each as if it were driven.
    pub joints: Vec<String>,
    /// Number of inertial parameters of all bodies: ten each.
    pub of: usize,
    /// The identifiable sums, from the base to the tip.
    pub base_parameters: Vec<ReportedBaseParameter>,
    /// Parameters without an effect on any torque.
    pub not_seen: Vec<NamedParameter>,
    /// Seed of the random motions at which the torques are computed.
    pub seed: u64,
    /// Warnings about the description.
    pub warnings: Vec<Finding>,
}

/// Random motions that excite every joint. Kind: choice; 20 give the rank of every arm that was tried.
const MOTIONS: usize = 40;
/// Speeds and accelerations of both signs, as large as gravity in effect. Unit: per second; kind: choice.
const FASTEST: f64 = 3.0;

/// The base parameters of a robot by the axes of its joints.
///
/// # Errors
/// [`DynamicsError`] if a motion is another robot's.
///
/// # Examples
/// For a body on one hinge that is not vertical, three of ten parameters are identifiable:
/// ```
/// use congruent_analysis::base_parameters::base_parameters;
/// use congruent_description::{Followers, parse_robot};
/// use congruent_input::SourceFile;
/// let urdf = r#"<robot name="rod"><link name="base"/><link name="rod"/>
///   <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"#;
/// let source = SourceFile { path: "rod.urdf".into(), text: urdf.into(), is_foreign: false };
/// let description = parse_robot(None, &source.into()).unwrap();
/// let report = base_parameters(&description, Followers::Folded, 0)?;
/// let names: Vec<&str> = report.base_parameters.iter().map(|group| group.of.parameter).collect();
/// assert_eq!((names, report.of), (vec!["iyy", "mx", "mz"], 10));
/// # Ok::<(), congruent_dynamics::DynamicsError>(())
/// ```
pub fn base_parameters(
    description: &RobotDescription,
    followers: Followers,
    seed: u64,
) -> Result<BaseParameterReport, DynamicsError> {
    let robot = &description.robot;
    let tree = BodyTree::new(robot).without_resistances();
    let (tree, follow) = match followers {
        Followers::Folded => (tree, true),
        Followers::Free => (tree.with_independent_mimics(), false),
    };
    let mut random = Uniform::seeded(seed);
    // All rates are drawn before the positions: the order of the draws fixes the motions of a seed.
    let mut rates =
        |count: usize| -> Vec<f64> { (0..count).map(|_| random.between(-FASTEST, FASTEST)).collect() };
    let mut moving: Vec<(Vec<f64>, Vec<f64>)> =
        (0..MOTIONS).map(|_| (rates(robot.dof()), rates(robot.dof()))).collect();
    let mut place = || -> RobotQ {
        let draw = |&joint: &JointIndex| {
            let (lower, upper) = range(robot.joint(joint));
            random.between(lower, upper)
        };
        robot.movable_joints().iter().map(draw).collect()
    };
    let mut places: Vec<RobotQ> = (0..MOTIONS).map(|_| place()).collect();
    if follow {
        for (q, (qd, qdd)) in places.iter_mut().zip(&mut moving) {
            robot.apply_mimic(q);
            robot.apply_mimic_to_speeds(qd);
            robot.apply_mimic_to_speeds(qdd);
        }
    }
    let motions: Vec<JointMotionState<'_>> =
        places.iter().zip(&moving).map(|(q, (qd, qdd))| JointMotionState { q, qd, qdd }).collect();
    let found = tree.base_parameters(&motions)?;
    let named = |parameter: &InertialParameter| {
        let joint = robot.joint(robot.movable_joints()[parameter.joint]);
        NamedParameter {
            joint: joint.name.clone(),
            link: robot.link(joint.child).name.clone(),
            parameter: parameter.name(),
        }
    };
    let groups = found.groups.iter().map(|group| ReportedBaseParameter {
        of: named(&group.parameter),
        grouped: group
            .grouped
            .iter()
            .map(|(parameter, coefficient)| GroupedParameter {
                of: named(parameter),
                coefficient: *coefficient,
            })
            .collect(),
        value: group.value,
        unit: unit(group.parameter.name()),
    });
    Ok(BaseParameterReport {
        file: description.urdf_path.display().to_string(),
        robot: description.name.clone(),
        joints: DrivenCoordinates::new(robot, followers).joint_names(robot),
        of: congruent_dynamics::PARAMETERS * robot.dof(),
        base_parameters: groups.collect(),
        not_seen: found.without_effect.iter().map(named).collect(),
        seed,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}

fn unit(parameter: &str) -> &'static str {
    match parameter {
        "m" => "kg",
        "mx" | "my" | "mz" => "kg m",
        _ => "kg m^2",
    }
}
