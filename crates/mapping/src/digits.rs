//! Whether the digits that two descriptions are written with explain how they differ.
//!
//! Half of the last place of each written number is a small motion of what its joint carries. If parts of these motions, each at
//! most a whole one, sum up to the difference of all axes and frames at zero, the two may be one robot that is written twice.
//!
//! Of a number that both files write, the coarser alone counts as rounded: two files that round a value to the same place write
//! the same number, and a last digit that differs is a difference.

use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::FRAC_PI_2,
};

use congruent_description::{
    Joint, JointIndex, JointKind, JointRounding, LinkIndex, MappedJoint, Robot, SmallMotion, Tolerance,
};
use congruent_kinematics::{PoseError, ScrewTree, Twist, least_squares::BoundedLeastSquares};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::{
    compared_robot::{ComparedRobot, RoundedJoint, rows},
    find::FoundMapping,
    matched::MatchedRobots,
};

/// The most that a value may be off, in half places: the margin is that of a value that is rounded from the middle of two. Kind:
/// rounding.
pub(crate) const MOST: f64 = 1.0 + 1e-4;
/// Directions and half places that differ by less are the same. Relative; kind: rounding of the typed numbers themselves.
const SAME: f64 = 1e-3;
/// How far a fitted zero or frame may move, rad or m: it takes part in the fit, since nobody has written it. Kind: choice, far more
/// than what digits leave open.
const FITTED: f64 = 1e-2;
/// A smaller share of what the written digits allow is no difference: frames of one link that lie elsewhere in two files turn and
/// shift roundings a little, and so does the norm of a rounded quaternion. Kind: choice; worst seen 0.036 (`piper`).
const NO_PART: f64 = 5e-2;
/// Damping of the solver, relative to the largest effect. Kind: solver.
const DAMPING: f64 = 1e-14;
/// An axis moves no link while its joint is at zero.
const AT_ZERO: f64 = 0.0;
/// Elsewhere, a link is carried by the motion of the axis, less the same motion turned by the joint.
const BY_AXES: f64 = 2.0;
/// Most values that are varied together, and most joints and links that they move; of larger robots digits explain nothing. Kind:
/// limit of the time, a second.
const MOST_VALUES: usize = 1000;
const MOST_MOVED: usize = 200;

/// What the digits allow, if they explain all that differs.
struct DigitsExplanation {
    /// The largest difference of a link at zero, to first order.
    at_links: PoseError,
    /// The parts of all motions that are taken: those of the robot, then those of the other.
    parts: Vec<f64>,
}

impl MatchedRobots<'_> {
    /// The largest difference of a link at zero that the digits allow, to first order, if they explain all that differs; `None`
    /// if they do not, or if programs have written both files with all digits.
    pub fn explained_by_digits(&self) -> Option<PoseError> {
        Some(self.digits_explanation()?.at_links)
    }

    /// What the digits leave open of a link, to first order, whether they explain what differs or not; what is fitted is no part of it.
    pub fn open_by_digits(&self) -> PoseError {
        let (sides, roundings) = (self.sides(), self.roundings());
        let motions = roundings.iter().flatten().flat_map(|of| of.rounding.motions().map(is_written));
        let written = DVector::from_vec(motions.collect());
        if written.is_empty() || written.len() > MOST_VALUES {
            return PoseError::default();
        }
        sides[0].largest_at_links(&effects(&sides, &roundings, BY_AXES), &written)
    }

    /// By how much fitted zeros of the other robot must be turned or shifted for the digits to explain the rest, rad or m, by joint;
    /// `None` if they do not explain it.
    pub fn zeros_by_digits(&self) -> Option<BTreeMap<&str, f64>> {
        let DigitsExplanation { parts, .. } = self.digits_explanation()?;
        let [own, other] = self.roundings();
        let of_own: usize = own.iter().map(|of| of.rounding.values()).sum();
        let mut zeros = BTreeMap::new();
        let mut at = of_own;
        for RoundedJoint { joint, rounding } in &other {
            // The zero of a joint is the last motion of its origin.
            let zero = rounding.origin.last().filter(|last| is_written(last) == 0.0);
            if zero.is_some() {
                zeros.insert(joint.name.as_str(), parts[at + rounding.origin.len() - 1] * FITTED);
            }
            at += rounding.values();
        }
        Some(zeros)
    }

    fn digits_explanation(&self) -> Option<DigitsExplanation> {
        let sides = self.sides();
        let roundings = self.roundings();
        let values: usize = roundings.iter().flatten().map(|of| of.rounding.values()).sum();
        let moved = sides[0].joints.len() + sides[0].links.len();
        if values == 0 || values > MOST_VALUES || moved > MOST_MOVED {
            return None;
        }
        let effects = effects(&sides, &roundings, AT_ZERO);
        let difference = self.difference(&sides);
        let same = Tolerance::default().position_m;
        let allowed = row_sums(&effects, &DVector::repeat(values, 1.0));
        // Terms of second order are not known of values that are known to half a place.
        let second_order = allowed.amax() * allowed.amax();
        let is_beyond = |(off, allowed): (&f64, &f64)| off.abs() > MOST * allowed + second_order + same;
        if difference.iter().zip(allowed.iter()).any(is_beyond) {
            return None;
        }
        let from = DVector::zeros(values);
        let scale = effects.column_iter().map(|of| of.norm_squared()).fold(0.0, f64::max);
        let problem = BoundedLeastSquares { effects: &effects, rest: &difference, from: &from, most: MOST };
        let parts = problem.nearest(DAMPING * scale);
        let used = row_sums(&effects, &parts).amax();
        let rest = &difference + &effects * &parts;
        let is_written = roundings.iter().flatten().flat_map(|of| of.rounding.motions().map(is_written));
        let is_written = DVector::from_iterator(values, is_written);
        let written = row_sums(&effects, &is_written);
        let is_explained =
            |(rest, written): (&f64, &f64)| rest.abs() <= same + used * used + NO_PART * written;
        // Of what is fitted the part that the fit takes, and not all that it might have.
        let most = parts.zip_map(&is_written, |part: f64, is_written| is_written.max(part.abs()));
        rest.iter().zip(written.iter()).all(is_explained).then(|| DigitsExplanation {
            at_links: sides[0].largest_at_links(&self::effects(&sides, &roundings, BY_AXES), &most),
            parts: parts.iter().copied().collect(),
        })
    }

    /// The two robots with the joints and links that are compared, in one order.
    fn sides(&self) -> [ComparedRobot<'_>; 2] {
        let of = |joint: &Joint| {
            let there = self.other.find_joint(&self.namesake(joint)?.name)?;
            joint.kind.is_movable().then_some([self.robot.parent_joint(joint.child)?, there])
        };
        let joints: Vec<[JointIndex; 2]> = self.robot.joints().iter().filter_map(of).collect();
        let links = self.robot.link_indices().filter_map(|link| Some([link, self.link_there(link)?]));
        let links: Vec<[LinkIndex; 2]> = links.collect();
        [(0, self.robot), (1, self.other)].map(|(side, robot)| ComparedRobot {
            robot,
            screws: ScrewTree::new(robot),
            joints: joints.iter().map(|pair| pair[side]).collect(),
            links: links.iter().map(|pair| pair[side]).collect(),
        })
    }

    /// The joints of both whose numbers count as rounded, with what that moves.
    fn roundings(&self) -> [Vec<RoundedJoint<'_>>; 2] {
        let partner_of = |joint: &Joint| self.other.parent_joint(self.same_joint(joint)?.child);
        let partners: Vec<Option<JointIndex>> = self.robot.joints().iter().map(partner_of).collect();
        let mut own = vec![None; self.other.links().len()];
        for (joint, partner) in self.robot.joints().iter().zip(&partners) {
            if let Some(partner) = partner {
                own[self.other.joint(*partner).child.get()] = Some(&joint.rounding);
            }
        }
        let here = self.robot.joints().iter().zip(&partners).map(|(joint, partner)| {
            let there = partner.map(|partner| &self.other.joint(partner).rounding);
            RoundedJoint { joint, rounding: coarser(&joint.rounding, there) }
        });
        let there = self.other.joints().iter().map(|joint| {
            let rounding = coarser(&joint.rounding, own[joint.child.get()]);
            RoundedJoint { joint, rounding }
        });
        [here.collect(), there.collect()]
    }

    /// The screws of the joints and the poses of the links at zero, those of the robot less those of the other.
    fn difference(&self, [here, there]: &[ComparedRobot<'_>; 2]) -> DVector<f64> {
        let joints = here.joints.iter().zip(&there.joints).map(|(own, other)| {
            let [own, other] = [here.screw(*own), there.screw(*other)];
            Twist { angular: own.angular - other.angular, linear: own.linear - other.linear }
        });
        let links =
            here.links.iter().map(|link| Twist::log(&(self.own(*link) * self.there(*link).inverse())));
        rows(joints.chain(links))
    }
}

/// The robot whose zeros of these joints are fitted: no digits bind what nobody has written.
#[must_use]
pub fn with_fitted(robot: &Robot, zeros: &BTreeSet<&str>) -> Robot {
    robot.with_joints(|joint| {
        if joint.kind != JointKind::Fixed && zeros.contains(joint.name.as_str()) {
            let [shift, turn] = along_axis(joint);
            joint.rounding.origin.push(if joint.kind.is_angular() { turn } else { shift });
        }
    })
}

/// A shift along the axis of a joint and a turn about it, as large as what is fitted may be off.
pub(crate) fn along_axis(joint: &Joint) -> [SmallMotion; 2] {
    let along = joint.parent_from_joint.rotation * joint.axis_in_joint.into_inner() * FITTED;
    [SmallMotion::shift(along), SmallMotion::turn(along, &joint.parent_from_joint.translation.vector)]
}

/// The motions of a frame at this point that is chosen and not written: it may lie anywhere near.
pub fn free_frame(at: &Vector3<f64>) -> Vec<SmallMotion> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| axis * FITTED);
    let turns = axes.map(|axis| SmallMotion::turn(axis, at));
    axes.map(SmallMotion::shift).into_iter().chain(turns).collect()
}

/// The robot whose base is fitted: all that it moves may lie elsewhere together, if one joint carries all of it.
#[must_use]
pub fn with_fitted_base(robot: &Robot) -> Robot {
    let is_first = |joint: &Joint| joint.kind != JointKind::Fixed && robot.body(joint.parent) == robot.root();
    let mut first = robot.joints().iter().filter(|joint| is_first(joint));
    let (Some(only), None) = (first.next(), first.next()) else { return robot.clone() };
    robot.with_joints(|joint| {
        if joint.name == only.name {
            joint.rounding.origin.extend(free_frame(&Vector3::zeros()));
        }
    })
}

impl FoundMapping {
    /// The same with the zeros of turning joints to five decimals, as files write angles in radians.
    #[must_use]
    pub fn with_rounded_zeros(&self) -> Self {
        let mut found = self.clone();
        for joint in &mut found.joints {
            joint.offset = (joint.offset * 1e5).round() / 1e5;
        }
        found
    }

    /// The same with each zero that is next to 0 at it, if the digits of both files reach that far, and each that is next to a
    /// quarter turn, if those of its joint do; `None` if there is no such zero.
    #[must_use]
    pub fn with_round_zeros(&self, [robot, other]: [&Robot; 2]) -> Option<Self> {
        let all = [robot, other].map(|robot| robot.joints().iter());
        let all: Vec<&Joint> = all.into_iter().flatten().collect();
        let rounded = |of: &MappedJoint| {
            let there = other.joint(of.joint);
            let slides = there.kind == JointKind::Prismatic;
            let quarters = if slides { 0.0 } else { (of.offset / FRAC_PI_2).round() };
            let own = robot.find_joint(&of.name).map(|index| robot.joint(index));
            let open = |joints: &[&Joint]| {
                let motions = joints.iter().flat_map(|joint| &joint.rounding.origin);
                motions.filter(|motion| is_turn(motion) != slides).map(size).sum::<f64>()
            };
            let open = if quarters == 0.0 { open(&all) } else { open(&[own?, there]) };
            let round = quarters * FRAC_PI_2;
            let off = (of.offset - round).abs();
            (off > 0.0 && off <= open).then_some(round)
        };
        let mut found = self.clone();
        for joint in &mut found.joints {
            joint.offset = rounded(joint).unwrap_or(joint.offset);
        }
        (found != *self).then_some(found)
    }
}

/// What each motion of the roundings of two robots changes, those of the other the other way: a column for each.
fn effects(
    sides: &[ComparedRobot<'_>; 2],
    roundings: &[Vec<RoundedJoint<'_>>; 2],
    of_axes_at_links: f64,
) -> DMatrix<f64> {
    let of = |at: usize| roundings[at].iter().flat_map(move |of| sides[at].columns(of, of_axes_at_links));
    let columns: Vec<DVector<f64>> = of(0).chain(of(1).map(|of| -of)).collect();
    DMatrix::from_columns(&columns)
}

/// For each row the sum of the sizes of all its terms.
fn row_sums(effects: &DMatrix<f64>, parts: &DVector<f64>) -> DVector<f64> {
    effects.abs() * parts.abs()
}

/// The motions of the numbers of a joint that the other file does not write as coarse or coarser; all of them if it does not write
/// this joint by the same numbers.
fn coarser(own: &JointRounding, other: Option<&JointRounding>) -> JointRounding {
    let Some(other) = other.filter(|other| other.form == own.form) else { return own.clone() };
    let keep = |own: &[SmallMotion], other: &[SmallMotion]| -> Vec<SmallMotion> {
        // Angles about other axes are other numbers, of which neither is the rounded other.
        let has_same_angles = has_turns_along(own, other) && has_turns_along(other, own);
        let is_as_coarse = |own: &SmallMotion, there: &SmallMotion| {
            let same = if is_turn(own) && !has_same_angles { 1.0 + SAME } else { 1.0 - SAME };
            is_along(own, there) && size(there) >= size(own) * same
        };
        let kept = own.iter().filter(|own| !other.iter().any(|there| is_as_coarse(own, there)));
        kept.copied().collect()
    };
    JointRounding {
        origin: keep(&own.origin, &other.origin),
        axis: keep(&own.axis, &other.axis),
        ..own.clone()
    }
}

/// Whether each turn of one is about an axis of the other.
fn has_turns_along(one: &[SmallMotion], other: &[SmallMotion]) -> bool {
    let is_there = |turn: &SmallMotion| other.iter().any(|there| is_along(turn, there));
    one.iter().filter(|motion| is_turn(motion)).all(is_there)
}

/// Whether both are shifts, or both turns, along one direction.
fn is_along(one: &SmallMotion, other: &SmallMotion) -> bool {
    let [one_along, other_along] =
        [one, other].map(|of| if is_turn(of) { of.angular_rad } else { of.linear_m });
    let sine = one_along.normalize().cross(&other_along.normalize()).norm();
    is_turn(one) == is_turn(other) && sine < SAME
}

/// 1 for what digits leave open, 0 for what is fitted.
fn is_written(motion: &SmallMotion) -> f64 {
    f64::from(u8::from(size(motion) < 0.5 * FITTED))
}

fn is_turn(motion: &SmallMotion) -> bool {
    motion.angular_rad != Vector3::zeros()
}

/// Size in its own unit, m or rad.
fn size(motion: &SmallMotion) -> f64 {
    if is_turn(motion) { motion.angular_rad.norm() } else { motion.linear_m.norm() }
}
