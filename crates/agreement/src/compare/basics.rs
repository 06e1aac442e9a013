//! The checks before any use, on the tool center point: where it is at zero, which way each joint
//! moves it, and whether the transforms are rigid motions at all.

use congruent_description::{LinkIndex, RobotDescription, RobotQ};
use congruent_kinematics::{
    DhChain, KinematicsError, Pose, ReportedPose, UrdfTree, axis_steps, larger, rotation_log,
};
use serde::Serialize;

/// Below this a shift is rounding and has no direction. Kind: rounding, of arms that reach some metres.
const NO_SHIFT_M: f64 = 1e-12;

/// What a person tries first with a new robot, in the axes of link `base`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Basics {
    /// The link in whose axes all is told.
    pub base: String,
    /// The link that carries the TCP, or is it where no `[tcp]` is declared.
    pub tip: String,
    /// Where the TCP is at zero.
    pub zero: BySource<ReportedPose>,
    /// Each joint moved alone from zero; joints that mimic it follow.
    pub joints: Vec<JointMotion>,
    /// The largest Frobenius norm of `R^T R - I` of the TCP at all configurations of the check.
    pub orthonormality_error: f64,
    /// The largest distance of `det R` from 1.
    pub determinant_error: f64,
    /// The largest shift that `T T^-1` leaves.
    pub round_trip_m: f64,
    /// The largest turn that `T T^-1` leaves.
    pub round_trip_rad: f64,
}

/// The same by the robot's table and by its URDF.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BySource<T> {
    /// By the table; `None` where the robot file has none.
    pub model: Option<T>,
    /// By the URDF chain.
    pub urdf: T,
}

/// One joint moved alone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointMotion {
    /// The joint.
    pub joint: String,
    /// How far it moved, in `unit`.
    pub by: f64,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// What the TCP did.
    pub motion: BySource<TcpMotion>,
}

/// What the TCP did, in the axes of link `base`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TcpMotion {
    /// From where it was to where it is.
    pub shift_m: [f64; 3],
    /// The shift as a direction of length 1; `None` where nothing shifted.
    pub direction: Option<[f64; 3]>,
    /// Axis times angle of the turn.
    pub turn_rad: [f64; 3],
}

impl TcpMotion {
    fn between(before: &Pose, after: &Pose) -> Self {
        let shift = after.translation - before.translation;
        Self {
            shift_m: shift.into(),
            direction: shift.try_normalize(NO_SHIFT_M).map(Into::into),
            turn_rad: rotation_log(&(after.rotation * before.rotation.transpose())).into(),
        }
    }
}

/// The TCP by both sources, for one configuration after another.
struct Sources {
    table: Option<DhChain>,
    tree: UrdfTree,
    base: LinkIndex,
    tip: LinkIndex,
    tip_from_tcp: Pose,
}

impl Sources {
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
    /// `table`, where there is one, and `URDF`, each with what it says.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &T)> {
        self.model.iter().map(|model| ("table", model)).chain([("URDF", &self.urdf)])
    }
}

/// The checks before any use; errors of the transforms are the worst over `configurations`.
///
/// # Errors
/// [`KinematicsError`] when a configuration is none of the robot.
pub(crate) fn basics(
    description: &RobotDescription,
    configurations: &[RobotQ],
) -> Result<Basics, KinematicsError> {
    let robot = &description.robot;
    let sources = Sources::new(description);
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
        basics.joints.push(JointMotion {
            joint: joint.name.clone(),
            by: step.by,
            unit: joint.kind.unit(),
            motion: BySource {
                model: by_table.map(|(before, after)| TcpMotion::between(before, after)),
                urdf: TcpMotion::between(&at_zero.urdf, &moved.urdf),
            },
        });
    }
    for q in configurations {
        sources.base_from_tcp(q)?.named().for_each(|(_, base_from_tcp)| basics.observe(base_from_tcp));
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
