//! `congruent dynamics`: torques and accelerations of a robot at given states.

use congruent_configurations::{JointState, JointStateList};
use congruent_description::{DrivenCoordinates, Followers, ReportedChain, Robot, RobotDescription};
use congruent_dynamics::{DrivenState, JointDynamics, JointDynamicsError, JointMotionState, SpatialInertia};
use congruent_input::{Diagnostic, Finding, SiUnit};
use nalgebra::{DMatrix, Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{codes, stream::Stream};

/// A source of joint torques and accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DynamicsSource {
    /// The equations of motion.
    Model,
    /// The physics engine, from its accelerations.
    Simulation,
}

/// A point mass at the tool centre point, or at an offset from it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct PointPayload {
    /// Mass of the payload, kg.
    pub mass_kg: f64,
    /// Position in the frame of the TCP (of the tip if no TCP is declared), m.
    pub position_m: [f64; 3],
}

/// Options of `congruent dynamics`: source, friction and payload.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DynamicsOptions {
    /// What computes the dynamics.
    pub source: DynamicsSource,
    /// Whether the damping and dry friction of the description count.
    pub friction: bool,
    /// A mass that the tool carries.
    pub payload: Option<PointPayload>,
    /// How joints that follow others count.
    pub followers: Followers,
}

/// The dynamics at one state. Torques are in N m, those of prismatic joints in N.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DynamicsResult {
    /// Torques that hold the robot still.
    pub gravity_n_m: Vec<f64>,
    /// Torques for a unit acceleration of each joint: rows and columns in the order of `joints`.
    pub mass_matrix: Vec<Vec<f64>>,
    /// Torques of the speeds without acceleration, gravity among them.
    pub bias_n_m: Vec<f64>,
    /// Torques of the motion `q`, `v`, `a`.
    pub inverse_dynamics_n_m: Vec<f64>,
    /// Accelerations under `tau`, in rad/s^2 and m/s^2.
    pub forward_dynamics: Vec<f64>,
}

/// The answer of `congruent dynamics`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "DynamicsReport")]
pub struct JointDynamicsReport<Results> {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, on which a payload hangs.
    pub chain: ReportedChain,
    /// The driven joints, in the order of vectors: the torque of a joint that follows another by `<mimic>` acts on that one,
    /// and is counted there. With `--free-followers` all moving joints, each as if it were driven.
    pub joints: Vec<String>,
    /// Unit of each joint's position: `rad` or `m`.
    #[schemars(with = "Vec<String>")]
    pub units: Vec<SiUnit>,
    /// The source of the torques and accelerations.
    pub source: DynamicsSource,
    /// Whether damping and dry friction of the description take part in `inverse_dynamics_n_m` and
    /// `forward_dynamics`.
    pub friction: bool,
    /// The mass that the tool carries.
    pub payload: Option<PointPayload>,
    /// One entry for each state, in input order.
    pub results: Results,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Dynamics that are computed while they are written.
pub type DynamicsStream<'a> = Stream<'a, DynamicsResult>;

impl DynamicsResult {
    /// The dynamics at a state.
    ///
    /// # Errors
    /// [`JointDynamicsError`] if the source refuses the state.
    pub fn at(
        state: &JointState,
        by: &mut dyn JointDynamics,
        coordinates: &DrivenCoordinates,
    ) -> Result<Self, JointDynamicsError> {
        let JointState { q, qd, qdd, tau } = state;
        let n = qd.len();
        let zeros = vec![0.0; n];
        let [mut gravity, mut inverse, mut bias, mut forward] = std::array::from_fn(|_| vec![0.0; n]);
        let mut matrix = DMatrix::zeros(n, n);
        // Accelerations first: they refuse a joint without inertia, before a large mass matrix is computed in vain.
        let driven = DrivenState { q, qd, tau };
        if coordinates.driven().len() == n {
            by.independent_forward_into(&driven, &mut forward)?;
        } else {
            by.forward_into(&driven, &mut forward)?;
        }
        by.gravity_into(q, &mut gravity)?;
        by.mass_matrix_into(q, &mut matrix)?;
        // Bias by the same source, rather than by subtraction, which would lose digits.
        by.inverse_into(&JointMotionState { q, qd, qdd: &zeros }, &mut bias)?;
        by.inverse_into(&JointMotionState { q, qd, qdd }, &mut inverse)?;
        // G' M G, rows first; of the rows of followers the multiples are added to those of their masters.
        let rows: Vec<Vec<f64>> =
            matrix.column_iter().map(|column| coordinates.folded(column.as_slice())).collect();
        let of_driven = |row: usize| rows.iter().map(|column| column[row]).collect::<Vec<f64>>();
        Ok(Self {
            gravity_n_m: coordinates.folded(&gravity),
            mass_matrix: (0..coordinates.driven().len())
                .map(|row| coordinates.folded(&of_driven(row)))
                .collect(),
            bias_n_m: coordinates.folded(&bias),
            inverse_dynamics_n_m: coordinates.folded(&inverse),
            forward_dynamics: coordinates.of_driven(&forward),
        })
    }

    /// Whether no torque, entry of the mass matrix or acceleration overflows.
    pub fn is_finite(&self) -> bool {
        let vectors = [&self.gravity_n_m, &self.bias_n_m, &self.inverse_dynamics_n_m, &self.forward_dynamics];
        vectors.into_iter().chain(&self.mass_matrix).flatten().all(|value| value.is_finite())
    }
}

/// The robot with the payload, and without damping and friction unless the options include them.
///
/// # Errors
/// A payload without a positive mass.
pub fn robot_with_options(
    description: &RobotDescription,
    options: &DynamicsOptions,
) -> Result<Robot, Diagnostic> {
    let robot = if options.friction {
        description.robot.clone()
    } else {
        description.robot.with_joints(|joint| (joint.damping, joint.friction) = (0.0, 0.0))
    };
    let Some(PointPayload { mass_kg, position_m }) = options.payload else { return Ok(robot) };
    let tcp = Point3::from(Vector3::from(position_m));
    let in_tip = description.tip_from_tcp.map_or(tcp, |tip_from_tcp| tip_from_tcp * tcp);
    let carried = SpatialInertia::point_mass(mass_kg, in_tip.coords);
    let own = robot
        .link(description.tip)
        .inertia
        .as_ref()
        .map_or(SpatialInertia::zero(), SpatialInertia::from_link);
    // NaN is not above zero either; the sum with the link itself may still be impossible.
    let inertia = Some(mass_kg).filter(|mass| *mass > 0.0).and_then(|_| (own + carried).to_link());
    let inertia = inertia.ok_or_else(|| {
        Diagnostic::error(codes::dynamics::PAYLOAD, format!("payload mass must be > 0, but is {mass_kg} kg"))
    })?;
    Ok(robot.with_inertia(description.tip, inertia))
}

/// Dynamics at each state, computed on demand by a source that was built for `robot`: [`robot_with_options`] the description and the
/// options.
///
/// # Errors
/// The source refuses the first state.
pub fn dynamics<'a>(
    description: &RobotDescription,
    robot: &Robot,
    options: &DynamicsOptions,
    mut by: Box<dyn JointDynamics + 'a>,
    states: &'a JointStateList,
) -> Result<JointDynamicsReport<DynamicsStream<'a>>, Diagnostic> {
    let coordinates = DrivenCoordinates::new(robot, options.followers);
    let driven = coordinates.of_driven(robot.movable_joints());
    let at = move |state: JointState| {
        DynamicsResult::at(&state, &mut *by, &coordinates).map_err(|error| refused(&error))
    };
    let results = Stream::begin(states.iter().map(at))?;
    let at_rest = stiction(robot, options, states);
    let joints = || driven.iter().map(|&joint| robot.joint(joint));
    Ok(JointDynamicsReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        joints: joints().map(|joint| joint.name.clone()).collect(),
        units: joints().map(|joint| joint.kind.si_unit()).collect(),
        source: options.source,
        friction: options.friction,
        payload: options.payload,
        results,
        warnings: description.warnings.iter().chain(&at_rest).map(Finding::from).collect(),
    })
}

/// The diagnostic of a source that refuses a state or a robot.
pub fn refused(error: &dyn std::error::Error) -> Diagnostic {
    Diagnostic::error(codes::dynamics::SOURCE, error.to_string())
}

/// A warning if joints are at rest that dry friction may hold, and the source does not model this.
pub fn stiction(robot: &Robot, options: &DynamicsOptions, states: &JointStateList) -> Option<Diagnostic> {
    // The physics engine models stiction; without friction there is nothing to hold.
    if options.source != DynamicsSource::Model || !options.friction {
        return None;
    }
    let joints = || robot.movable_joints().iter().map(|&joint| robot.joint(joint)).enumerate();
    let rests = |row: usize| states.iter().any(|state| state.qd[row] == 0.0);
    let held: Vec<&str> = joints()
        .filter(|(row, joint)| joint.friction > 0.0 && rests(*row))
        .map(|(_, joint)| joint.name.as_str())
        .collect();
    let message = format!(
        "dry friction may hold these joints at rest, which the equations of motion do not model: {}",
        held.join(", ")
    );
    let help =
        "their accelerations are computed without dry friction: give speeds, or use --source simulation";
    (!held.is_empty()).then(|| Diagnostic::warning(codes::dynamics::AT_REST, message).with_help(help))
}
