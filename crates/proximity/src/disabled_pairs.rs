//! `congruent clearance --write-srdf`: pairs of links to exclude from collision checking, with the reasons that MoveIt's setup
//! assistant writes into an SRDF (Coleman, Sucan, Chitta, Correll, "Reducing the Barrier to Entry of Complex Robotic
//! Software", 2014, and its `compute_default_collisions`): adjacent, touching in the default position, touching in nearly
//! all sampled configurations, or in none.

use std::collections::BTreeSet;

use congruent_description::{Joint, Link, LinkIndex, Robot, RobotDescription, RobotQ};
use congruent_input::Finding;
use congruent_kinematics::{KinematicsError, Pose, Sampling, UrdfTree, random_configurations, range};
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{distances::DistanceError, hulls::Hulls};

/// Most pairs of links with collision shapes. Kind: memory; a pair takes about 0.3 kB with its names in the answer.
const MOST_PAIRS: usize = 2_500_000;

/// Share of the samples from which a pair counts as always touching, as in MoveIt.
pub const ALWAYS_SHARE: f64 = 0.95;

/// Why a pair can be excluded from collision checking; the names are MoveIt's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
pub enum DisableReason {
    /// One joint connects the two, or joints and links without a shape do.
    Adjacent,
    /// They touch in the default position: all joints at 0, or at the middle of a range without 0.
    Default,
    /// They touch in at least [`ALWAYS_SHARE`] of the sampled configurations.
    Always,
    /// They touch in none of the sampled configurations, nor in a local search from the nearest one for a smaller distance.
    /// For links on one body that is certain; otherwise it is a result of sampling, not a proof.
    Never,
}

/// A pair that the suggestion disables.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SuggestedPair {
    /// Names of the two links, in the robot's order.
    pub pair: [String; 2],
    /// Why the pair can be excluded.
    pub reason: DisableReason,
    /// Whether the two cannot move against each other, so that the reason is certain.
    pub is_rigid: bool,
    /// The smallest distance that was found; `None` for pairs that were not sampled.
    pub least_m: Option<f64>,
}

/// The pairs that the robot's SRDF disables, compared with the suggestion.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DeclaredPairs {
    /// Number of pairs that the SRDF disables.
    pub pairs: usize,
    /// How many of these are suggested as well.
    pub suggested: usize,
    /// Pairs that the SRDF disables although they touch in some samples, but not in nearly all: collisions that are not
    /// detected.
    pub hidden: Vec<[String; 2]>,
    /// Number of pairs that the SRDF names although one of the two links has no collision shape.
    pub without_shape: usize,
}

/// The answer of `congruent clearance --write-srdf`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DisabledPairs {
    /// Name of the robot, as the SRDF must have it.
    pub robot: String,
    /// Path of the URDF.
    pub urdf: String,
    /// Number of sampled configurations.
    pub samples: usize,
    /// Seed of the random configurations.
    pub seed: u64,
    /// Number of links with collision shapes.
    pub links: usize,
    /// Number of pairs of such links.
    pub pairs: usize,
    /// Pairs that may be disabled, in the robot's order of links.
    pub suggested: Vec<SuggestedPair>,
    /// The pairs of the robot's SRDF compared with the suggestion; `None` if the robot has no SRDF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub declared: Option<DeclaredPairs>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

impl DisabledPairs {
    /// Number of suggested pairs with this reason.
    pub fn count(&self, reason: DisableReason) -> usize {
        self.suggested.iter().filter(|pair| pair.reason == reason).count()
    }

    /// The pair that came nearest of those that never touched in a sample and can move against each other.
    pub fn nearest_never(&self) -> Option<&SuggestedPair> {
        let never = |pair: &&SuggestedPair| pair.reason == DisableReason::Never && !pair.is_rigid;
        let least = |pair: &SuggestedPair| pair.least_m.unwrap_or(f64::INFINITY);
        self.suggested.iter().filter(never).min_by(|a, b| least(a).total_cmp(&least(b)))
    }
}

/// A pair with the samples that decide on it.
struct SampledPair {
    pair: [LinkIndex; 2],
    reason: Option<DisableReason>,
    is_rigid: bool,
    touching: usize,
    apart: usize,
    least_m: f64,
    /// The configuration of that distance.
    nearest: Option<RobotQ>,
}

/// Finds the pairs to exclude from collision checking. Pairs that the robot's SRDF disables are not adopted.
///
/// # Errors
/// [`DistanceError`] if a collision mesh has no extent, or a joint's range no sensible width.
pub fn suggest_disabled(
    description: &RobotDescription,
    sampling: Sampling,
) -> Result<DisabledPairs, DistanceError> {
    let robot = &description.robot;
    // Before the hulls are built, which takes longest.
    within_reason(robot)?;
    let hulls = |link: &Link| Hulls::new(&format!("link \"{}\"", link.name), &link.collisions);
    let mut shapes = Shapes {
        hulls: robot.links().iter().map(hulls).collect::<Result<_, _>>()?,
        tree: UrdfTree::new(robot),
        by_tree: vec![Pose::identity(); robot.links().len()],
        root_from_links: vec![Isometry3::identity(); robot.links().len()],
    };
    let mut candidates = shapes.candidates(robot)?;
    // Structure first, then the default position, then samples: each stage decides without the cost of the next one, and
    // this is MoveIt's order, so that a pair gets the same reason as there.
    let adjacent = adjacent(robot, |link| !shapes.hulls[link.get()].is_empty());
    for candidate in &mut candidates {
        candidate.reason = adjacent.contains(&candidate.pair).then_some(DisableReason::Adjacent);
    }
    shapes.move_to(&default_position(robot))?;
    for candidate in candidates.iter_mut().filter(|candidate| candidate.reason.is_none()) {
        // Whether they touch is all that is asked, so that bounding balls decide on most pairs of a large robot.
        let touches = shapes.distance_below_m(candidate.pair, f64::MIN_POSITIVE) <= 0.0;
        // Two links on one body keep their distance: the default position decides for all configurations.
        candidate.reason = match (touches, candidate.is_rigid) {
            (true, true) => Some(DisableReason::Always),
            (true, false) => Some(DisableReason::Default),
            (false, true) => Some(DisableReason::Never),
            (false, false) => None,
        };
    }
    // All configurations are drawn at once, so that a seed means the same samples however early pairs are decided.
    sample(&mut shapes, &mut candidates, &random_configurations(robot, sampling.seed, sampling.samples))?;
    // "Never" hides a collision if it is wrong, so each such pair is searched locally before it is suggested.
    for candidate in &mut candidates {
        if candidate.reason == Some(DisableReason::Never) && !candidate.is_rigid {
            shapes.approach(robot, candidate)?;
        }
    }
    let links = shapes.hulls.iter().filter(|hulls| !hulls.is_empty()).count();
    Ok(report(description, sampling, links, &candidates))
}

/// The links with their shapes at one configuration.
struct Shapes {
    hulls: Vec<Hulls>,
    tree: UrdfTree,
    by_tree: Vec<Pose>,
    root_from_links: Vec<Isometry3<f64>>,
}

impl Shapes {
    /// All pairs of links with shapes; none of a robot that cannot move, which needs no collision checking.
    fn candidates(&self, robot: &Robot) -> Result<Vec<SampledPair>, DistanceError> {
        let can_move = robot.dof() > 0;
        let solid: Vec<LinkIndex> =
            robot.link_indices().filter(|link| can_move && !self.hulls[link.get()].is_empty()).collect();
        let count = solid.len() * solid.len().saturating_sub(1) / 2;
        if count > MOST_PAIRS {
            return Err(DistanceError::Pairs { links: solid.len(), pairs: count, most: MOST_PAIRS });
        }
        let pairs =
            solid.iter().enumerate().flat_map(|(at, &a)| solid[at + 1..].iter().map(move |&b| [a, b]));
        let candidate = |pair: [LinkIndex; 2]| SampledPair {
            pair,
            reason: None,
            is_rigid: robot.body(pair[0]) == robot.body(pair[1]),
            touching: 0,
            apart: 0,
            least_m: f64::INFINITY,
            nearest: None,
        };
        Ok(pairs.map(candidate).collect())
    }

    fn move_to(&mut self, q: &RobotQ) -> Result<(), KinematicsError> {
        self.tree.root_from_links_into(q, &mut self.by_tree)?;
        for (pose, by_tree) in self.root_from_links.iter_mut().zip(&self.by_tree) {
            *pose = by_tree.to_isometry();
        }
        Ok(())
    }

    /// The distance of a pair, m, if it is less than `most_m`, which is returned otherwise.
    fn distance_below_m(&self, [a, b]: [LinkIndex; 2], most_m: f64) -> f64 {
        let [root_from_a, root_from_b] = [a, b].map(|link| self.root_from_links[link.get()]);
        let [of_a, of_b] = [a, b].map(|link| &self.hulls[link.get()]);
        // Bounding balls first: for most pairs of a large robot they decide without a transform of the hulls.
        let centres = (root_from_a.translation.vector - root_from_b.translation.vector).norm();
        if centres - of_a.radius_m() - of_b.radius_m() > most_m {
            return most_m;
        }
        of_a.distance_below_m(of_b, &root_from_a.inv_mul(&root_from_b), most_m)
    }
}

impl Shapes {
    /// Coordinate search for a smaller distance from the nearest sample, within the joint limits: uniform samples seldom have
    /// joints at the ends of their ranges, where fingers close. A pair that touches there has no reason to be disabled.
    fn approach(&mut self, robot: &Robot, candidate: &mut SampledPair) -> Result<(), KinematicsError> {
        /// Shares of a joint's range, each tried twice, since one joint's step opens room for another's.
        const STEPS: [f64; 12] = [0.5, 0.5, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05, 0.02, 0.02, 0.005, 0.005];
        let Some(mut q) = candidate.nearest.take() else { return Ok(()) };
        let of_joints = |step: f64| (0..robot.dof()).flat_map(move |at| [(at, step), (at, -step)]);
        for (coordinate, share) in STEPS.into_iter().flat_map(of_joints) {
            // Both directions at each step length, long steps first: short ones alone stop in the nearest hollow.
            let tried = moved(robot, &q, coordinate, share);
            self.move_to(&tried)?;
            let distance_m = self.distance_below_m(candidate.pair, candidate.least_m);
            // Touching in a reachable configuration: the pair has to be checked, so it gets no reason at all.
            if distance_m <= 0.0 {
                candidate.reason = None;
                return Ok(());
            }
            if distance_m < candidate.least_m {
                (candidate.least_m, q) = (distance_m, tried);
            }
        }
        Ok(())
    }
}

/// A configuration with one joint moved by a share of its range, within its limits; mimic joints follow their masters.
fn moved(robot: &Robot, q: &RobotQ, coordinate: usize, share: f64) -> RobotQ {
    let (lower, upper) = range(robot.joint(robot.movable_joints()[coordinate]));
    let mut moved = q.clone();
    moved[coordinate] = (q[coordinate] + share * (upper - lower)).clamp(lower, upper);
    robot.apply_mimic(&mut moved);
    moved
}

/// Measures the pairs without a reason at each configuration, until each is known to touch at times or the samples end.
fn sample(
    shapes: &mut Shapes,
    candidates: &mut [SampledPair],
    configurations: &[RobotQ],
) -> Result<(), KinematicsError> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a count is one")]
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 samples")]
    // 1e-9: a product that rounding has put just below a whole number is that number.
    let most_apart = ((1.0 - ALWAYS_SHARE) * configurations.len() as f64 + 1e-9).floor() as usize;
    // Open while "never" or "always" is still possible: one touch refutes the first, too many gaps the second.
    let is_open = |candidate: &SampledPair| {
        candidate.reason.is_none() && (candidate.touching == 0 || candidate.apart <= most_apart)
    };
    for q in configurations {
        if !candidates.iter().any(is_open) {
            return Ok(());
        }
        shapes.move_to(q)?;
        for candidate in candidates.iter_mut().filter(|candidate| is_open(candidate)) {
            // Only a distance below the smallest so far matters. The bound is positive even after a touch at 0: at a bound
            // of 0 every later sample would count as touching.
            let distance_m =
                shapes.distance_below_m(candidate.pair, candidate.least_m.max(f64::MIN_POSITIVE));
            if distance_m < candidate.least_m {
                candidate.least_m = distance_m;
                candidate.nearest = Some(q.clone());
            }
            if distance_m <= 0.0 {
                candidate.touching += 1;
            } else {
                candidate.apart += 1;
            }
        }
    }
    for candidate in candidates.iter_mut().filter(|candidate| is_open(candidate)) {
        // Open to the end means never touched, or too few gaps to refute "always".
        let never = candidate.touching == 0;
        candidate.reason = Some(if never { DisableReason::Never } else { DisableReason::Always });
    }
    Ok(())
}

/// Pairs that are connected by one joint, or by joints and links without a shape. Every two links around such links
/// count, as in MoveIt.
fn adjacent(robot: &Robot, is_solid: impl Fn(LinkIndex) -> bool) -> BTreeSet<[LinkIndex; 2]> {
    let mut adjacent = BTreeSet::new();
    // The solid links around each group of connected links without a shape, by the group's link nearest to the root.
    // Parents come before children in `link_indices`, so a link finds the group of its parent complete.
    let mut groups: Vec<Option<LinkIndex>> = vec![None; robot.links().len()];
    let mut around: Vec<BTreeSet<LinkIndex>> = vec![BTreeSet::new(); robot.links().len()];
    for link in robot.link_indices() {
        let parent = robot.parent_joint(link).map(|joint| robot.joint(joint).parent);
        if !is_solid(link) {
            let group = parent.and_then(|parent| groups[parent.get()]).unwrap_or(link);
            groups[link.get()] = Some(group);
            // The solid parent counts as around the group: it is connected to what hangs below the shapeless links.
            around[group.get()].extend(parent.filter(|&parent| is_solid(parent)));
        } else if let Some(parent) = parent {
            match groups[parent.get()] {
                Some(group) => around[group.get()].insert(link),
                None => adjacent.insert([parent, link]),
            };
        }
    }
    for group in &around {
        for &a in group {
            // Sets are ordered, so the pair has the lower index first, as candidates have.
            adjacent.extend(group.range(a..).skip(1).map(|&b| [a, b]));
        }
    }
    adjacent
}

/// Refuses joints whose range is so wide that sampled poses are far outside any workspace.
fn within_reason(robot: &Robot) -> Result<(), DistanceError> {
    /// Largest width of a joint's range, rad or m. Kind: choice; `DistanceError::Range` names it.
    const WIDEST: f64 = 1e6;
    let width = |joint: &Joint| joint.position_range().map_or(0.0, |(lower, upper)| upper - lower);
    // Continuous joints have no range and pass.
    match robot.joints().iter().find(|joint| width(joint) > WIDEST) {
        Some(joint) => Err(DistanceError::Range { joint: joint.name.clone(), width: width(joint) }),
        None => Ok(()),
    }
}

/// All joints at 0, or at the middle of the range for a joint whose range excludes 0.
fn default_position(robot: &Robot) -> RobotQ {
    let position = |joint: &Joint| match joint.position_range() {
        Some((lower, upper)) if !(lower..=upper).contains(&0.0) => f64::midpoint(lower, upper),
        _ => 0.0,
    };
    let mut q: RobotQ = robot.movable_joints().iter().map(|&joint| position(robot.joint(joint))).collect();
    // After all masters have their positions: the order of joints does not say who follows whom.
    robot.apply_mimic(&mut q);
    q
}

fn report(
    description: &RobotDescription,
    sampling: Sampling,
    links: usize,
    candidates: &[SampledPair],
) -> DisabledPairs {
    let robot = &description.robot;
    let names = |pair: [LinkIndex; 2]| pair.map(|link| robot.link(link).name.clone());
    let suggested = candidates.iter().filter_map(|candidate| {
        Some(SuggestedPair {
            pair: names(candidate.pair),
            reason: candidate.reason?,
            is_rigid: candidate.is_rigid,
            // Infinite for pairs that structure decides: JSON has no infinity.
            least_m: Some(candidate.least_m).filter(|least_m| least_m.is_finite()),
        })
    });
    DisabledPairs {
        robot: description.name.clone(),
        urdf: description.urdf_path.display().to_string(),
        samples: sampling.samples,
        seed: sampling.seed,
        links,
        pairs: candidates.len(),
        suggested: suggested.collect(),
        declared: declared(description, candidates),
        warnings: description.warnings.iter().map(Finding::from).collect(),
    }
}

fn declared(description: &RobotDescription, candidates: &[SampledPair]) -> Option<DeclaredPairs> {
    // Without a file there is nothing to compare with, which differs from a file that disables no pair.
    description.named_files.srdf.as_ref()?;
    let disabled = &description.disabled_collisions;
    let known: Vec<&SampledPair> = candidates
        .iter()
        .filter(|candidate| disabled.contains(&(candidate.pair[0], candidate.pair[1])))
        .collect();
    let hidden = known.iter().filter(|candidate| candidate.reason.is_none());
    let names =
        |candidate: &&SampledPair| candidate.pair.map(|link| description.robot.link(link).name.clone());
    Some(DeclaredPairs {
        pairs: disabled.len(),
        suggested: known.iter().filter(|candidate| candidate.reason.is_some()).count(),
        hidden: hidden.map(names).collect(),
        // Every pair of links with shapes is a candidate, so a pair that is not known lacks a shape.
        without_shape: disabled.len() - known.len(),
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use congruent_description::parse_robot;
    use congruent_input::SourceFile;

    use super::*;

    fn suggested(body: &str) -> Vec<(String, DisableReason)> {
        let text = format!("<robot name='r'>{body}</robot>");
        let source = Arc::new(SourceFile { path: "r.urdf".into(), text, is_foreign: false });
        let description = parse_robot(None, &source).unwrap();
        let pairs = suggest_disabled(&description, Sampling { samples: 400, seed: 0 }).unwrap();
        pairs.suggested.into_iter().map(|each| (each.pair.join("-"), each.reason)).collect()
    }

    fn ball(name: &str, radius_m: f64) -> String {
        format!(
            "<link name='{name}'><collision><geometry><sphere radius='{radius_m}'/></geometry></collision></link>"
        )
    }

    fn joint(kind: &str, parent: &str, child: &str, x_m: f64) -> String {
        format!(
            "<joint name='{child}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
             <origin xyz='{x_m} 0 0'/><axis xyz='0 0 1'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
        )
    }

    #[test]
    fn every_reason_is_found() {
        // Two bars of 1 m, folded at times: the ball at the end of the second meets the base if it is folded.
        let links = [ball("base", 0.1), ball("elbow", 0.1), ball("hand", 0.1), ball("far", 0.1)].concat();
        let joints = [
            joint("revolute", "base", "elbow", 1.0),
            joint("revolute", "elbow", "hand", 1.0),
            joint("revolute", "hand", "far", 5.0),
        ];
        let found = suggested(&(links + &joints.concat()));
        let expected = [
            ("base-elbow", DisableReason::Adjacent),
            ("base-far", DisableReason::Never),
            ("elbow-hand", DisableReason::Adjacent),
            ("elbow-far", DisableReason::Never),
            ("hand-far", DisableReason::Adjacent),
        ];
        assert_eq!(found, expected.map(|(pair, reason)| (pair.to_owned(), reason)));
    }

    #[test]
    fn what_touches_by_default_or_always_is_distinguished() {
        // The big ball reaches the base wherever the joints are, the hand only while the arm is straight.
        let links = [ball("base", 1.9), ball("bar", 0.1), ball("big", 1.5)].concat();
        let joints = [joint("revolute", "base", "bar", 1.0), joint("revolute", "bar", "big", 1.0)];
        let found = suggested(&(links + &joints.concat()));
        assert!(found.contains(&("base-big".to_owned(), DisableReason::Default)), "{found:?}");
        let links = [ball("base", 0.1), ball("bar", 0.1), ball("big", 1.899)].concat();
        // Apart by a millimetre if stretched, which is the default, and together from 3.6 degrees on.
        let folded = joint("revolute", "bar", "big", 1.0).replace("lower='-3'", "lower='0'");
        let found = suggested(&(links + &joint("revolute", "base", "bar", 1.0) + &folded));
        assert!(found.contains(&("base-big".to_owned(), DisableReason::Always)), "{found:?}");
    }

    #[test]
    fn links_without_a_shape_connect_what_is_around_them() {
        let frame = "<link name='frame'/>";
        let links = [ball("a", 0.1), frame.to_owned(), ball("b", 0.1), ball("c", 0.1)].concat();
        let joints = [
            joint("revolute", "a", "frame", 0.5),
            joint("revolute", "frame", "b", 0.5),
            joint("fixed", "frame", "c", 0.5),
        ];
        let found = suggested(&(links + &joints.concat()));
        assert_eq!(found.len(), 3);
        assert!(found.iter().all(|(_, reason)| *reason == DisableReason::Adjacent), "{found:?}");
    }
}
