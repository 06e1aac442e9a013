//! Brackets of the largest differences of torque, as they are reported, and the range of motion that they are about.

use congruent_description::{JointLimit, RobotQ};

use crate::{
    side::Side,
    thresholds::{LARGEST_ACCELERATION, LARGEST_SPEED, SAME_VALUE},
};

/// The bracket of one joint.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct TorqueBracket {
    /// The joint.
    pub joint: String,
    /// The largest difference that was found, N m or N.
    pub attained_n_m: f64,
    /// No difference within the range of motion is larger.
    pub certified_n_m: f64,
    /// The second over the first: 1 if the bound is met; `null` if nothing was found.
    pub ratio: Option<f64>,
    /// Unit of both: `N m`, or `N` for a sliding joint.
    pub unit: String,
    /// Positions where it was found, in the order of the moving joints; rad and m.
    pub q: Vec<f64>,
    /// Speeds there, rad/s and m/s.
    pub qd: Vec<f64>,
    /// Accelerations there, rad/s^2 and m/s^2.
    pub qdd: Vec<f64>,
    /// `certified_n_m` as a part of the joint's effort limit; `null` if there is none.
    pub share_of_effort: Option<f64>,
    /// Boxes of positions and speeds that were divided for the bound.
    pub boxes: usize,
}

/// Brackets of all joints that have a difference.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, schemars::JsonSchema)]
pub struct TorqueCertificate {
    /// The largest of them; `null` if no joint has a difference.
    pub worst: Option<TorqueBracket>,
    /// All joints that have a difference.
    pub by_joint: Vec<TorqueBracket>,
}

/// The motion at which a difference is attained.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AttainedAt {
    pub(super) q: RobotQ,
    pub(super) qd: Vec<f64>,
    pub(super) qdd: Vec<f64>,
}

impl AttainedAt {
    /// Without motion.
    pub(super) fn rest(q: RobotQ) -> Self {
        let zeros = vec![0.0; q.len()];
        Self { q, qd: zeros.clone(), qdd: zeros }
    }
}

impl TorqueBracket {
    pub(super) fn new(
        side: &Side,
        joint: usize,
        [attained, certified]: [f64; 2],
        (at, boxes): (AttainedAt, usize),
    ) -> Self {
        let effort = side.limits[joint].and_then(|limit| limit.effort).filter(|effort| *effort > 0.0);
        let place = &side.frames.joints[joint];
        Self {
            joint: place.name.clone(),
            attained_n_m: attained,
            certified_n_m: certified.max(attained),
            ratio: (attained > 0.0).then(|| certified.max(attained) / attained),
            unit: if place.is_angular { "N m" } else { "N" }.to_owned(),
            q: at.q.to_vec(),
            qd: at.qd,
            qdd: at.qdd,
            share_of_effort: effort.map(|effort| certified / effort),
            boxes,
        }
    }
}

impl TorqueCertificate {
    /// Of joints that have the same difference the one nearest to the base is the worst.
    pub(super) fn of(by_joint: Vec<TorqueBracket>) -> Self {
        let largest = by_joint.iter().map(|bracket| bracket.attained_n_m).fold(0.0, f64::max);
        let is_worst = |bracket: &&TorqueBracket| bracket.attained_n_m >= largest * (1.0 - SAME_VALUE);
        Self { worst: by_joint.iter().find(is_worst).cloned(), by_joint }
    }
}

/// Positions, speeds and accelerations of one joint that a certificate covers.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct CoveredMotion {
    /// The joint.
    pub joint: String,
    /// Smallest position, rad or m: of a joint without limits one turn is covered.
    pub lower: f64,
    /// Largest position, rad or m.
    pub upper: f64,
    /// Largest speed in either direction, rad/s or m/s.
    pub speed: f64,
    /// Whether a description states the speed; else it is 2 rad/s or m/s.
    pub speed_is_stated: bool,
    /// Largest acceleration in either direction, rad/s^2 or m/s^2.
    pub acceleration: f64,
    /// Whether a description declares the acceleration; else it is 10 rad/s^2 or m/s^2.
    pub acceleration_is_declared: bool,
}

/// The range of motion of each joint of a candidate. If both descriptions state a speed it is the smaller one: a limit
/// in degrees is not a speed. The same holds for accelerations. Mimic joints move as their masters make them.
pub(super) fn covered_motions(candidate: &Side, reference: &Side) -> Vec<CoveredMotion> {
    let stated = |limit: &Option<JointLimit>| {
        limit.and_then(|limit| limit.velocity).filter(|speed| speed.is_finite() && *speed > 0.0)
    };
    let covered = |joint: usize| {
        let place = &candidate.frames.joints[joint];
        let speeds = [candidate, reference].map(|side| stated(&side.limits[joint]));
        let speed = speeds.into_iter().flatten().reduce(f64::min);
        let accelerations = [candidate, reference].map(|side| side.accelerations[joint]);
        let acceleration = accelerations.into_iter().flatten().reduce(f64::min);
        CoveredMotion {
            joint: place.name.clone(),
            lower: place.range.0,
            upper: place.range.1,
            speed: speed.unwrap_or(LARGEST_SPEED),
            speed_is_stated: speed.is_some(),
            acceleration: acceleration.unwrap_or(LARGEST_ACCELERATION),
            acceleration_is_declared: acceleration.is_some(),
        }
    };
    let mut all: Vec<CoveredMotion> = (0..candidate.frames.dof()).map(covered).collect();
    for (joint, place) in candidate.frames.joints.iter().enumerate() {
        if let Some((master, ratio, _)) = place.follows {
            let (speed, acceleration) = (all[master].speed, all[master].acceleration);
            all[joint].speed = ratio.abs() * speed;
            all[joint].acceleration = ratio.abs() * acceleration;
        }
    }
    all
}
