//! First checks of a robot, on the tool centre point (TCP): its pose at zero, its motion with each joint, and
//! whether the transforms are rigid motions.

use congruent_description::{LinkIndex, RobotDescription, RobotQ};
use congruent_kinematics::{
    DhChain, KinematicsError, Pose, ReportedPose, UrdfTree, axis_steps, larger, rotation_log,
};
use schemars::JsonSchema;
use serde::Serialize;

/// A shorter displacement has no direction. Kind: rounding, for arms with a reach of some metres.
const NO_DISPLACEMENT_M: f64 = 1e-12;

/// The first checks of a robot, in the axes of link `base`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Basics {
    /// The link whose axes are used.
    pub base: String,
    /// The link with the TCP, at its origin if no `[tcp]` is declared.
    pub tip: String,
    /// Pose of the TCP at zero.
    pub zero: BySource<ReportedPose>,
    /// The motion of each joint alone from zero; joints that mimic it follow.
    pub joints: Vec<SingleJointMotion>,
    /// The largest Frobenius norm of `R^T R - I` of the TCP at all configurations of the check.
    pub orthonormality_error: f64,
    /// The largest distance of `det R` from 1.
    pub determinant_error: f64,
    /// The largest translation of `T T^-1`, m.
    pub round_trip_m: f64,
    /// The largest rotation angle of `T T^-1`, rad.
    pub round_trip_rad: f64,
}

/// A value by the robot's table and by its URDF.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BySource<T> {
    /// By the table; `None` if the robot file has no table.
    pub model: Option<T>,
    /// By the URDF chain.
    pub urdf: T,
}

/// The unit of a joint's coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CoordinateUnit {
    /// Radians, of a joint that turns.
    Rad,
    /// Metres, of a prismatic joint.
    M,
}

/// The motion of the TCP by one joint alone.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SingleJointMotion {
    /// Name of the joint that moves.
    pub joint: String,
    /// The change of its coordinate, in `unit`.
    pub by: f64,
    /// Unit of `by`: `rad` or `m`.
    pub unit: CoordinateUnit,
    /// The motion of the TCP.
    pub motion: BySource<TcpDisplacement>,
}

/// A motion of the TCP, in the axes of link `base`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct TcpDisplacement {
    /// Displacement from the old position to the new one.
    pub shift_m: [f64; 3],
    /// Direction of the displacement, of length 1; `None` if there is none.
    pub direction: Option<[f64; 3]>,
    /// The rotation, axis times angle.
    pub turn_rad: [f64; 3],
}

impl TcpDisplacement {
    fn between(before: &Pose, after: &Pose) -> Self {
        let shift = after.translation - before.translation;
        Self {
            shift_m: shift.into(),
            direction: shift.try_normalize(NO_DISPLACEMENT_M).map(Into::into),
            turn_rad: rotation_log(&(after.rotation * before.rotation.transpose())).into(),
        }
    }
}

/// Pose of the TCP by both sources at one configuration after another.
struct TcpSources {
    table: Option<DhChain>,
    tree: UrdfTree,
    base: LinkIndex,
    tip: LinkIndex,
    tip_from_tcp: Pose,
}

impl TcpSources {
    fn new(description: &RobotDescription) -> Self {
        let robot = &description.robot;
        Self {
            table: description.dh.as_ref().map(|table| DhChain::new(table, robot)),
            tree: UrdfTree::new(robot),
            base: description.base,
            tip: description.tip,
            tip_from_tcp: description.tip_from_tcp.map_or(Pose::identity(), Pose::from),
        }
    }

    fn base_from_tcp(&self, q: &RobotQ) -> Result<BySource<Pose>, KinematicsError> {
        let base_from_root = self.tree.root_from_link(q, self.base)?.inverse();
        let urdf = base_from_root * self.tree.root_from_link(q, self.tip)? * self.tip_from_tcp;
        let by_table = |table: &DhChain| table.base_from_tcp(q, &self.tip_from_tcp);
        Ok(BySource { model: self.table.as_ref().map(by_table).transpose()?, urdf })
    }
}

impl<T> BySource<T> {
    /// `table`, if there is one, and `URDF`, each with its value.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &T)> {
        self.model.iter().map(|model| ("table", model)).chain([("URDF", &self.urdf)])
    }
}

/// The first checks; errors of the transforms are the worst over `configurations`.
///
/// # Errors
/// [`KinematicsError`] if a configuration has the wrong number of joints.
pub(crate) fn basics(
    description: &RobotDescription,
    configurations: impl Iterator<Item = RobotQ>,
) -> Result<Basics, KinematicsError> {
    let robot = &description.robot;
    let sources = TcpSources::new(description);
    let mut zero = RobotQ::zeros(robot.dof());
    robot.apply_mimic(&mut zero);
    let at_zero = sources.base_from_tcp(&zero)?;
    let mut basics = Basics {
        base: robot.link(description.base).name.clone(),
        tip: robot.link(description.tip).name.clone(),
        zero: BySource {
            model: at_zero.model.as_ref().map(ReportedPose::from),
            urdf: ReportedPose::from(&at_zero.urdf),
        },
        joints: Vec::new(),
        orthonormality_error: 0.0,
        determinant_error: 0.0,
        round_trip_m: 0.0,
        round_trip_rad: 0.0,
    };
    for step in axis_steps(robot) {
        let moved = sources.base_from_tcp(&step.q)?;
        let by_table = at_zero.model.as_ref().zip(moved.model.as_ref());
        let joint = robot.joint(step.joint);
        basics.joints.push(SingleJointMotion {
            joint: joint.name.clone(),
            by: step.by,
            unit: if joint.kind.is_angular() { CoordinateUnit::Rad } else { CoordinateUnit::M },
            motion: BySource {
                model: by_table.map(|(before, after)| TcpDisplacement::between(before, after)),
                urdf: TcpDisplacement::between(&at_zero.urdf, &moved.urdf),
            },
        });
    }
    for q in configurations {
        sources.base_from_tcp(&q)?.named().for_each(|(_, base_from_tcp)| basics.observe(base_from_tcp));
    }
    Ok(basics)
}

impl Basics {
    fn observe(&mut self, base_from_tcp: &Pose) {
        let round_trip = *base_from_tcp * base_from_tcp.inverse();
        let worst = |so_far: &mut f64, error: f64| *so_far = larger(*so_far, error);
        worst(&mut self.orthonormality_error, base_from_tcp.orthonormality_error());
        worst(&mut self.determinant_error, (base_from_tcp.determinant() - 1.0).abs());
        worst(&mut self.round_trip_m, round_trip.distance_m(&Pose::identity()));
        worst(&mut self.round_trip_rad, round_trip.angle_rad(&Pose::identity()));
    }
}
