//! `congruent manipulability`: how well the tool moves in each direction.

use congruent_description::{JointValues, LinkIndex, ReportedChain, RobotDescription, RobotQ};
use congruent_input::{Diagnostic, Finding};
use congruent_kinematics::{
    Arm, Dexterity, KinematicsError, Manipulability, Pose, UrdfTree, VelocityEllipsoid,
};
use nalgebra::{Matrix2x3, Vector3};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    arm_joints::joint_names,
    codes,
    plot::{AXES, Curve, PLANES, PlaneView, PlaneViews, PlotError, views},
    stream::Stream,
};

/// The answer of `congruent manipulability`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ManipulabilityReport")]
pub struct ManipulabilityReport<Results> {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The arm's independent joints, base to tip.
    pub joints: Vec<String>,
    /// The length that counts as one radian: of the tool in `whole`, and of the joints in `sliding`.
    pub metres_per_rad: f64,
    /// Sliding joints of an arm that has turning joints too: everywhere their velocities count in
    /// `metres_per_rad`, so that no measure depends on the unit of length.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sliding: Vec<String>,
    /// One entry for each configuration.
    pub results: Results,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Dexterity at one configuration.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ConfigurationDexterity {
    /// The configuration, rad or m.
    pub q: JointValues,
    /// Position of the tool, in the base.
    pub tcp_in_base_m: [f64; 3],
    /// Velocity of the tool centre point, m per rad of joint motion; per m if no joint turns.
    pub linear: ReportedEllipsoid,
    /// Angular velocity, rad per rad of joint motion.
    pub angular: ReportedEllipsoid,
    /// Dexterity of linear and angular velocity together, lengths in units of `metres_per_rad`.
    pub whole: ReportedDexterity,
}

/// An ellipsoid with its dexterity measures.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedEllipsoid {
    /// Directions in the base, the longest first.
    pub axes: [[f64; 3]; 3],
    /// Lengths of the semi-axes, the longest first.
    pub semi_axes: [f64; 3],
    /// Dexterity measures of the ellipsoid.
    #[serde(flatten)]
    pub dexterity: ReportedDexterity,
}

/// Dexterity measures from singular values.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedDexterity {
    /// Directions that the arm can span at all.
    pub directions: usize,
    /// Product of the singular values.
    pub yoshikawa: f64,
    /// Largest over smallest singular value; none if the arm is singular.
    pub condition: Option<f64>,
    /// The smallest singular value.
    pub distance_to_singularity: f64,
}

impl From<&Dexterity> for ReportedDexterity {
    fn from(found: &Dexterity) -> Self {
        Self {
            directions: found.singular_values.len(),
            yoshikawa: found.yoshikawa,
            condition: found.condition.is_finite().then_some(found.condition),
            distance_to_singularity: found.distance_to_singularity,
        }
    }
}

impl From<&VelocityEllipsoid> for ReportedEllipsoid {
    fn from(found: &VelocityEllipsoid) -> Self {
        Self {
            axes: [0, 1, 2].map(|axis| found.axes_in_base.column(axis).into_owned().into()),
            semi_axes: found.semi_axes,
            dexterity: (&found.dexterity).into(),
        }
    }
}

/// Dexterity that is computed while it is written.
pub type DexterityStream<'a> = Stream<'a, ConfigurationDexterity>;

/// Manipulability at configurations of the robot, each computed on demand; `metres_per_rad` is
/// [`Arm::metres_per_rad`] if it is left out.
///
/// # Errors
/// The robot has no arm.
pub fn manipulability<'a>(
    description: &RobotDescription,
    configurations: impl Iterator<Item = RobotQ> + 'a,
    metres_per_rad: Option<f64>,
) -> Result<ManipulabilityReport<DexterityStream<'a>>, Diagnostic> {
    let refused = |error: KinematicsError| Diagnostic::error(codes::manipulability::ROBOT, error.to_string());
    let mut arm = Arm::from_description(description).map_err(refused)?;
    let metres_per_rad = metres_per_rad.unwrap_or(arm.metres_per_rad());
    let joints = joint_names(description, &arm);
    let slides = arm.joints().iter().zip(&joints).filter(|(joint, _)| arm.turns_and_slides() && !joint.turns);
    let sliding = slides.map(|(_, name)| name.clone()).collect();
    let names = joints.clone();
    let mut at = move |q_robot: RobotQ| {
        let q = arm.from_robot(&q_robot);
        let Manipulability { linear, angular, whole } = arm.manipulability(&q, metres_per_rad)?;
        Ok(ConfigurationDexterity {
            q: JointValues::new(&names, &q),
            tcp_in_base_m: arm.base_from_tcp(&q)?.translation.into(),
            linear: (&linear).into(),
            angular: (&angular).into(),
            whole: (&whole).into(),
        })
    };
    Ok(ManipulabilityReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        metres_per_rad,
        sliding,
        joints,
        results: Stream::begin(configurations.map(move |q| at(q).map_err(refused)))?,
        warnings: description.warnings.iter().map(Finding::from).collect(),
    })
}

/// Length of the longest semi-axis in the plot as a share of the arm's extent.
const DRAWN_SHARE: f64 = 0.3;
/// Corners of a drawn ellipse.
const CORNERS: u16 = 96;

/// The arm at one configuration with both ellipsoids at its tool, in three planes of the base.
///
/// # Errors
/// [`PlotError`] if the drawing library refuses.
pub fn plot(
    description: &RobotDescription,
    q_robot: &RobotQ,
    result: &ConfigurationDexterity,
) -> Result<String, PlotError> {
    let tcp = Vector3::from(result.tcp_in_base_m);
    let mut skeleton = skeleton(description, q_robot);
    skeleton.push(tcp);
    let extent = skeleton.iter().map(Vector3::norm).fold(0.0, f64::max);
    let view = |axes: &[usize; 2]| {
        let flat = |point: &Vector3<f64>| [point[axes[0]], point[axes[1]]];
        let ellipse = |(series, ellipsoid): (usize, &ReportedEllipsoid)| {
            // A singular arm may have an ellipsoid of length zero, which must not divide.
            let longest = ellipsoid.semi_axes[0].max(f64::MIN_POSITIVE);
            let points = outline(ellipsoid, *axes, DRAWN_SHARE * extent / longest);
            let centre = flat(&tcp);
            let points = points.map(|[x, y]| [centre[0] + x, centre[1] + y]).collect();
            Curve { points, series: Some(series) }
        };
        let mut curves = vec![Curve { points: skeleton.iter().map(flat).collect(), series: None }];
        curves.extend([&result.linear, &result.angular].into_iter().enumerate().map(ellipse));
        PlaneView {
            axes: axes.map(|axis| AXES[axis].to_owned()),
            areas: Vec::new(),
            curves,
            marks: skeleton.iter().map(flat).collect(),
            labels: Vec::new(),
        }
    };
    let legend = [("velocity", &result.linear, "m/s"), ("angular velocity", &result.angular, "rad/s")];
    let legend = legend.map(|(name, ellipsoid, unit)| {
        format!(
            "{name}: longest semi-axis {:.3} {unit}, shortest {:.3}",
            ellipsoid.semi_axes[0], ellipsoid.semi_axes[2]
        )
    });
    let title = format!("{}: velocity ellipsoids of the tool, each to its own scale", description.name);
    views(&PlaneViews {
        title,
        series: legend.to_vec(),
        views: PLANES.each_ref().map(view).to_vec(),
        note: String::new(),
    })
}

/// Outline of an ellipsoid projected onto a plane: with `B` the projected semi-axes, `(B B^T)^(1/2)` times the unit circle.
fn outline(
    ellipsoid: &ReportedEllipsoid,
    axes: [usize; 2],
    scale: f64,
) -> impl Iterator<Item = [f64; 2]> + use<> {
    let seen = Matrix2x3::from_fn(|row, column| {
        ellipsoid.axes[column][axes[row]] * ellipsoid.semi_axes[column] * scale
    });
    // The shadow of an ellipsoid is an ellipse, whose squared semi-axes are the eigenvalues of P P'.
    let eigen = (seen * seen.transpose()).symmetric_eigen();
    (0..=CORNERS).map(move |corner| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS));
        // Rounding may make a zero eigenvalue slightly negative.
        let lengths = eigen.eigenvalues.map(|square| square.max(0.0).sqrt());
        let point = eigen.eigenvectors.column(0) * (lengths.x * cos)
            + eigen.eigenvectors.column(1) * (lengths.y * sin);
        [point.x, point.y]
    })
}

/// Origins of the links from base to tip, in the base.
fn skeleton(description: &RobotDescription, q_robot: &RobotQ) -> Vec<Vector3<f64>> {
    let robot = &description.robot;
    let mut poses = vec![Pose::identity(); robot.links().len()];
    if UrdfTree::new(robot).root_from_links_into(q_robot, &mut poses).is_err() {
        return Vec::new();
    }
    let base_from_root = poses[description.base.get()].inverse();
    let origin = |link: LinkIndex| (base_from_root * poses[link.get()]).translation;
    let joints = robot.chain(description.base, description.tip).unwrap_or_default();
    let mut origins = vec![Vector3::zeros()];
    origins.extend(joints.into_iter().map(|joint| origin(robot.joint(joint).child)));
    origins
}
