//! Brackets of the largest torque differences as they are reported, and the range of motion that they cover.

use congruent_description::{JointLimit, RobotQ};
use congruent_input::SiUnit;
use congruent_kinematics::UNRANGED_SLIDE_M;

use crate::{
    model::DynamicsModel,
    thresholds::{LARGEST_ACCELERATION, LARGEST_SPEED, SAME_VALUE},
};

/// The bracket of the largest torque difference of one joint: a value that is attained, and a bound that holds.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct TorqueBracket {
    /// Name of the joint.
    pub joint: String,
    /// The largest difference that was found, N m or N.
    pub attained_n_m: f64,
    /// Upper bound of the difference over the whole range of motion, N m or N.
    pub certified_n_m: f64,
    /// `certified_n_m / attained_n_m`: 1 if the bound is attained; `null` if no difference was found.
    pub ratio: Option<f64>,
    /// Unit of both: `N m`, or `N` for a sliding joint.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// Positions where it was found, in the order of the moving joints; rad and m.
    pub q: Vec<f64>,
    /// Speeds at which it was found, rad/s and m/s.
    pub qd: Vec<f64>,
    /// Accelerations at which it was found, rad/s^2 and m/s^2.
    pub qdd: Vec<f64>,
    /// `certified_n_m` over the joint's effort limit; `null` if no limit is stated.
    pub share_of_effort: Option<f64>,
    /// Number of boxes of positions and speeds that were divided for the bound.
    pub boxes: usize,
}

/// Brackets of all joints that have a difference.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, schemars::JsonSchema)]
pub struct TorqueCertificate {
    /// The bracket with the largest attained difference; `null` if no joint has a difference.
    pub worst: Option<TorqueBracket>,
    /// The brackets of all joints that have a difference.
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
    /// Positions without speed and acceleration.
    pub(super) fn rest(q: RobotQ) -> Self {
        let zeros = vec![0.0; q.len()];
        Self { q, qd: zeros.clone(), qdd: zeros }
    }
}

impl TorqueBracket {
    pub(super) fn new(
        model: &DynamicsModel,
        joint: usize,
        [attained, certified]: [f64; 2],
        at: AttainedAt,
        boxes: usize,
    ) -> Self {
        let effort = model.limits[joint].and_then(|limit| limit.effort).filter(|effort| *effort > 0.0);
        let place = &model.frames.joints[joint];
        Self {
            joint: place.name.clone(),
            attained_n_m: attained,
            // The bound and the attained value are computed by different sums, so a closed bracket may cross by
            // rounding; a bound below a value that was attained would be a false claim.
            certified_n_m: certified.max(attained),
            ratio: (attained > 0.0).then(|| certified.max(attained) / attained),
            unit: place.effort_unit(),
            q: at.q.to_vec(),
            qd: at.qd,
            qdd: at.qdd,
            share_of_effort: effort.map(|effort| certified / effort),
            boxes,
        }
    }
}

impl TorqueCertificate {
    /// The certificate of all joints; of joints with the same difference the one nearest to the base is the worst.
    pub(super) fn from_brackets(by_joint: Vec<TorqueBracket>) -> Self {
        let largest = by_joint.iter().map(|bracket| bracket.attained_n_m).fold(0.0, f64::max);
        // Joints may have one difference except for rounding: without the share the reported joint would depend
        // on it.
        let is_worst = |bracket: &&TorqueBracket| bracket.attained_n_m >= largest * (1.0 - SAME_VALUE);
        Self { worst: by_joint.iter().find(is_worst).cloned(), by_joint }
    }
}

/// Positions, speeds and accelerations of one joint that a certificate covers.
#[derive(Debug, Clone, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct CoveredMotion {
    /// Name of the joint.
    pub joint: String,
    /// Smallest position, rad or m; of a joint without limits one turn is covered, or 1 m in both directions.
    pub lower: f64,
    /// Largest position, rad or m.
    pub upper: f64,
    /// How far from zero a joint is covered that slides without a range, m; missing if it has one, or turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub assumed_slide_m: Option<f64>,
    /// Largest speed in either direction, rad/s or m/s.
    pub speed: f64,
    /// Whether a description states the speed; otherwise 2 rad/s or m/s is assumed.
    pub speed_is_stated: bool,
    /// Largest acceleration in either direction, rad/s^2 or m/s^2.
    pub acceleration: f64,
    /// Whether a description declares the acceleration; otherwise 10 rad/s^2 or m/s^2 is assumed.
    pub acceleration_is_declared: bool,
}

/// The range of motion of each joint of a candidate. If both descriptions state a speed, the smaller one counts, and the same
/// holds for accelerations. Mimic joints move in proportion to their masters.
pub(super) fn covered_motions(candidate: &DynamicsModel, reference: &DynamicsModel) -> Vec<CoveredMotion> {
    let stated = |limit: &Option<JointLimit>| {
        limit.and_then(|limit| limit.velocity).filter(|speed| speed.is_finite() && *speed > 0.0)
    };
    let is_unranged = |joint: usize| {
        let has_range = |of: JointLimit| of.lower.is_finite() && of.upper.is_finite();
        !candidate.frames.joints[joint].is_angular && !candidate.limits[joint].is_some_and(has_range)
    };
    let covered = |joint: usize| {
        let place = &candidate.frames.joints[joint];
        let speeds = [candidate, reference].map(|model| stated(&model.limits[joint]));
        // The smaller of the two: a limit written in degrees would give a certificate for speeds that the arm
        // never reaches.
        let speed = speeds.into_iter().flatten().reduce(f64::min);
        let accelerations = [candidate, reference].map(|model| model.accelerations[joint]);
        let acceleration = accelerations.into_iter().flatten().reduce(f64::min);
        CoveredMotion {
            joint: place.name.clone(),
            lower: place.range.0,
            upper: place.range.1,
            assumed_slide_m: is_unranged(joint).then_some(UNRANGED_SLIDE_M),
            speed: speed.unwrap_or(LARGEST_SPEED),
            speed_is_stated: speed.is_some(),
            acceleration: acceleration.unwrap_or(LARGEST_ACCELERATION),
            acceleration_is_declared: acceleration.is_some(),
        }
    };
    let mut all: Vec<CoveredMotion> = (0..candidate.frames.dof()).map(covered).collect();
    // Followers last, since their masters must be known: q = ratio * q_master + offset, so speed and acceleration
    // scale by the ratio alone.
    for (joint, place) in candidate.frames.joints.iter().enumerate() {
        if let Some((master, ratio, _)) = place.follows {
            let (speed, acceleration) = (all[master].speed, all[master].acceleration);
            all[joint].speed = ratio.abs() * speed;
            all[joint].acceleration = ratio.abs() * acceleration;
        }
    }
    all
}
