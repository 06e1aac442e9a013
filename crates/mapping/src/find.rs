//! Which joints of two descriptions are the same, and in which variables: names first, then the order along the chain, with
//! the axes as proof.

use std::collections::{BTreeMap, BTreeSet};

use congruent_description::{JointIndex, LinkIndex, MappedJoint, Robot, RobotDescription};
use congruent_kinematics::{PoseError, ScrewTree};
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    axis::Axis,
    bodies::by_bodies,
    names::{JointPairs, is_alike, with_one_link, with_one_name, with_similar_names},
    variables::{ChainPair, ChainSolution, JointVariable},
};

/// How the joints of two descriptions were found to be the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MatchedBy {
    /// The robot file declares it.
    Declared,
    /// By the names that they have in both.
    Names,
    /// By names that differ in a prefix, a suffix, capitals or the word "joint".
    SimilarNames,
    /// By the names of the links that they carry: those of joints are exchanged.
    Links,
    /// By their order along the chain.
    Order,
}

/// The joints of another description in the variables of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundMapping {
    /// The joints of the other description, in the order of the robot.
    pub joints: Vec<MappedJoint>,
    /// How they were found.
    pub matched_by: MatchedBy,
    /// Moving joints without a partner: of the robot, and of the other description.
    pub unmatched: [Vec<JointIndex>; 2],
    /// Pose of the root of the other description in that of the robot, at which the axes agree.
    pub root_from_other_root: Isometry3<f64>,
    /// Whether the base is fitted to the axes, as declared or because it is turned about the first of them: the frames that are fixed to
    /// it are no evidence then.
    pub has_fitted_base: bool,
    /// Joints of the other description that carry the same link from the same link, with another axis: one of the two files is wrong.
    pub misplaced: BTreeSet<JointIndex>,
    /// The largest angle between two axes that should be the same, rad.
    pub angle_rad: f64,
    /// The largest distance of two axes that should be the same, m.
    pub distance_m: f64,
    /// Other choices of direction and zero with which the axes agree as well.
    pub equivalent: Vec<Vec<MappedJoint>>,
}

/// Variables by joint of the robot.
type KnownVariables = BTreeMap<JointIndex, JointVariable>;

/// What the branches beside the main one add to a mapping.
struct BranchesSolved {
    off: PoseError,
    misplaced: BTreeSet<JointIndex>,
}

/// What is known of two robots beside their files.
pub(crate) struct Both<'a> {
    pub(crate) a: &'a RobotDescription,
    pub(crate) b: &'a RobotDescription,
    pub(crate) screws: [ScrewTree; 2],
    reach_m: f64,
}

/// The joints of `b` in the variables of `a`; `None` if the two have no chain in common. The axes are near each other then,
/// which does not mean that they agree: the rest is a difference of the two.
pub fn find(a: &RobotDescription, b: &RobotDescription) -> Option<FoundMapping> {
    let both = Both::new(a, b);
    let named = [
        (MatchedBy::Names, with_one_name(&a.robot, &b.robot)),
        (MatchedBy::SimilarNames, with_similar_names(&a.robot, &b.robot)),
    ];
    // A joint that the other file fixes has a partner that does not move.
    let is_fixed_there = |joint: &JointIndex| {
        let there = b.robot.find_joint(&a.robot.joint(*joint).name);
        there.is_some_and(|there| !b.robot.joint(there).kind.is_movable())
    };
    let covers = |pairs: &JointPairs| {
        let is_paired = |joint: &JointIndex| pairs.iter().any(|[of_a, _]| of_a == joint);
        let chain = a.moving_chain();
        chain.iter().any(is_paired) && chain.iter().all(|joint| is_paired(joint) || is_fixed_there(joint))
    };
    let mut found =
        named.into_iter().filter(|(_, pairs)| covers(pairs)).filter_map(|(by, pairs)| both.solved(by, pairs));
    found.next().or_else(|| {
        let ordered = both
            .by_order()
            .into_iter()
            .filter_map(|chain| both.solved_with(MatchedBy::Order, &chain, both.with_others(&chain)));
        ordered.min_by(|one, other| both.cost(one).total_cmp(&both.cost(other)))
    })
}

/// The joints of `b` in the variables of `a` by the links that they carry, if the names of joints are exchanged between them: both
/// have the same moving joints by name, and the axes are those of the links.
pub fn find_exchanged(a: &RobotDescription, b: &RobotDescription) -> Option<FoundMapping> {
    /// Share of what the axes of the names are apart. Kind: choice; another difference of the two is in both readings.
    const EXPLAINS: f64 = 0.3;
    let by_link = with_one_link(&a.robot, &b.robot);
    let is_exchanged = |pair: &[JointIndex; 2]| a.robot.joint(pair[0]).name != b.robot.joint(pair[1]).name;
    if by_link.len() < a.robot.movable_joints().len() || !by_link.iter().any(is_exchanged) {
        return None;
    }
    let both = Both::new(a, b);
    let found = both.solved(MatchedBy::Links, by_link)?;
    let by_name = both.solved(MatchedBy::Names, with_one_name(&a.robot, &b.robot));
    let is_nearer = |by_name: FoundMapping| both.cost(&found) < EXPLAINS * both.cost(&by_name);
    by_name.is_none_or(is_nearer).then_some(found)
}

impl<'a> Both<'a> {
    pub(crate) fn new(a: &'a RobotDescription, b: &'a RobotDescription) -> Self {
        let reach_m = a.tolerance_scale().reach_m().unwrap_or(1.0);
        Self { a, b, screws: [&a.robot, &b.robot].map(ScrewTree::new), reach_m }
    }
}

impl Both<'_> {
    /// The rest of a mapping, as a distance; joints without a partner count.
    fn cost(&self, found: &FoundMapping) -> f64 {
        let left_out: f64 = found.unmatched.iter().flatten().map(|_| 1e-3).sum();
        found.distance_m + self.reach_m * (found.angle_rad + left_out)
    }

    /// The joints of both chains in order; if one is longer, at its beginning and at its end.
    fn by_order(&self) -> Vec<JointPairs> {
        let chain = |of: &RobotDescription| -> Vec<JointIndex> {
            let driven = |joint: &JointIndex| of.robot.joint(*joint).mimic.is_none();
            of.moving_chain().into_iter().filter(driven).collect()
        };
        let (a, b) = (chain(self.a), chain(self.b));
        let count = a.len().min(b.len());
        let mut solutions = BTreeSet::new();
        solutions.insert((0, 0));
        solutions.insert((a.len() - count, b.len() - count));
        let pairs = |(from_a, from_b): (usize, usize)| -> JointPairs {
            (0..count).map(|at| [a[from_a + at], b[from_b + at]]).collect()
        };
        let robots = [&self.a.robot, &self.b.robot];
        let is_possible =
            |pairs: &JointPairs| !pairs.is_empty() && pairs.iter().all(|pair| is_alike(robots, *pair));
        solutions.into_iter().map(pairs).filter(is_possible).collect()
    }

    /// The joints of the chain with those beside it that have one name, such as fingers.
    fn with_others(&self, chain: &JointPairs) -> JointPairs {
        let mut pairs = chain.clone();
        let (a, b) = (&self.a.robot, &self.b.robot);
        for namesakes in [with_one_name(a, b), with_similar_names(a, b)] {
            for pair in namesakes {
                if pairs.iter().all(|known| known[0] != pair[0] && known[1] != pair[1]) {
                    pairs.push(pair);
                }
            }
        }
        // One that is left on each side may be the same one; its axis shows.
        let robots = [&self.a.robot, &self.b.robot];
        if let [[of_a], [of_b]] = self.unmatched(&pairs).each_ref().map(Vec::as_slice)
            && is_alike(robots, [*of_a, *of_b])
        {
            pairs.push([*of_a, *of_b]);
        }
        pairs.sort();
        pairs
    }

    /// The variables of pairs that are certain.
    fn solved(&self, matched_by: MatchedBy, pairs: JointPairs) -> Option<FoundMapping> {
        self.solved_with(matched_by, &pairs.clone(), pairs)
    }

    /// The variables of these pairs: first of `certain` ones on the chain to the tip and beyond, then on all other branches.
    fn solved_with(
        &self,
        matched_by: MatchedBy,
        certain: &JointPairs,
        mut pairs: JointPairs,
    ) -> Option<FoundMapping> {
        let branches = self.branches(&pairs);
        let main = self.main_branch(certain, &self.branches(certain));
        let solutions = self.solutions_of_chain(&main)?;
        let solutions = by_bodies(solutions, [self.a, self.b], &self.screws, &main, self.reach_m);
        let is_first =
            |(_, branch): &(LinkIndex, JointPairs)| branch.is_empty() || branch.first() == main.first();
        let first = solutions.first()?;
        let turned = self
            .chain_pair(&main, None, None)
            .with_turned_base(first)
            .filter(|_| branches.iter().all(is_first));
        let solution = turned.as_ref().unwrap_or(first);
        let of_main = |solution: &ChainSolution| -> KnownVariables {
            main.iter().map(|pair| pair[0]).zip(solution.variables.iter().copied()).collect()
        };
        let mut solved = of_main(solution);
        let BranchesSolved { off: of_branches, misplaced } =
            self.solve_branches(&branches, &solution.a_from_b, &mut solved, &mut pairs);
        let angle_rad = solution.angle_rad.max(of_branches.orientation_rad);
        let distance_m = solution.distance_m.max(of_branches.position_m);
        let mapped = |known: &KnownVariables| -> Vec<MappedJoint> {
            let of = |pair: &[JointIndex; 2]| Some(self.mapped(*pair, *known.get(&pair[0])?));
            pairs.iter().filter_map(of).collect()
        };
        Some(FoundMapping {
            joints: mapped(&solved),
            matched_by,
            unmatched: self.unmatched(&pairs),
            root_from_other_root: solution.a_from_b,
            has_fitted_base: turned.is_some(),
            misplaced,
            angle_rad,
            distance_m,
            equivalent: solutions.iter().skip(1).map(|other| mapped(&of_main(other))).collect(),
        })
    }

    /// Adds the variables of the joints of all branches to those of the main one, and drops the pairs that are not the same joint. Returns
    /// the largest distance and angle of axes, and joints of the other that are misplaced.
    fn solve_branches(
        &self,
        branches: &[(LinkIndex, JointPairs)],
        a_from_b: &Isometry3<f64>,
        solved: &mut KnownVariables,
        pairs: &mut JointPairs,
    ) -> BranchesSolved {
        let mut off = PoseError::default();
        let mut misplaced = BTreeSet::new();
        for (end, branch) in branches {
            let known: Vec<_> = branch.iter().map(|pair| solved.get(&pair[0]).copied()).collect();
            if known.iter().all(Option::is_some) {
                continue;
            }
            let tips = self.tips_of(*end, &self.a.robot.link(*end).name);
            let with_tips =
                ChainPair { known: known.clone(), ..self.chain_pair(branch, Some(*a_from_b), tips) };
            let chain = ChainPair { known, ..self.chain_pair(branch, Some(*a_from_b), None) };
            let solutions = [with_tips.solutions(), chain.solutions()]
                .into_iter()
                .find(|solutions| !solutions.is_empty());
            let solutions = by_bodies(
                solutions.unwrap_or_default(),
                [self.a, self.b],
                &self.screws,
                branch,
                self.reach_m,
            );
            let Some(found) = solutions.into_iter().next() else {
                // Joints of the same name whose axes are others are the same joints only if they carry the same link from the same
                // link: then one of the two files is wrong.
                let is_misplaced =
                    |pair: &&[JointIndex; 2]| self.has_same_links(**pair) && !solved.contains_key(&pair[0]);
                let found: JointPairs = branch.iter().filter(is_misplaced).copied().collect();
                solved.extend(found.iter().map(|pair| (pair[0], JointVariable::default())));
                misplaced.extend(found.iter().map(|pair| pair[1]));
                pairs.retain(|pair| solved.contains_key(&pair[0]) || !branch.contains(pair));
                continue;
            };
            off = off.larger(PoseError { position_m: found.distance_m, orientation_rad: found.angle_rad });
            for (pair, variable) in branch.iter().zip(found.variables) {
                solved.entry(pair[0]).or_insert(variable);
            }
        }
        BranchesSolved { off, misplaced }
    }

    /// Whether two joints carry a link of one name from a link of one name.
    fn has_same_links(&self, [of_a, of_b]: [JointIndex; 2]) -> bool {
        let (a, b) = (&self.a.robot, &self.b.robot);
        let names = |robot: &Robot, joint: JointIndex| {
            let joint = robot.joint(joint);
            [joint.parent, joint.child].map(|link| robot.link(link).name.clone())
        };
        names(a, of_a) == names(b, of_b)
    }

    /// The matched joints to the tip, with those of one branch beyond it: their axes show where the last joint has its zero.
    fn main_branch(&self, pairs: &JointPairs, branches: &[(LinkIndex, JointPairs)]) -> JointPairs {
        let chain = self.a.moving_chain();
        let to_tip: JointPairs = pairs.iter().filter(|pair| chain.contains(&pair[0])).copied().collect();
        let beyond = branches.iter().map(|(_, branch)| branch).filter(|branch| branch.starts_with(&to_tip));
        beyond.max_by_key(|branch| branch.len()).cloned().unwrap_or(to_tip)
    }

    /// The solutions of the chain from base to tip: with the same frames at both ends if these explain it, else with another tool,
    /// else with another base as well.
    fn solutions_of_chain(&self, pairs: &JointPairs) -> Option<Vec<ChainSolution>> {
        /// Axes that are nearer than this share of the reach are the same up to what a calibration changes.
        const NEAR: f64 = 1e-4;
        /// The same where frames at the tip, which show the zero of the last joint, agree as well: of files with four decimals.
        const NEAR_WITH_TIPS: f64 = 1e-3;
        /// Kind: choice; a fault is smaller, a base elsewhere farther.
        const SAME_BASE: f64 = 0.05;
        let tips = [self.shared_tips(), Some(self.both_tips())];
        let bases = self.shared_roots().into_iter().map(Some).chain([None]);
        let attempts = bases.flat_map(|base| {
            tips.into_iter().flatten().map(Some).chain([None]).map(move |tips| (base, tips))
        });
        let off = |solutions: &Vec<ChainSolution>| {
            solutions.first().map_or(f64::INFINITY, |solution| solution.off_m(self.reach_m))
        };
        let mut best: Option<Vec<ChainSolution>> = None;
        for (base, tips) in attempts {
            let solutions = self.chain_pair(pairs, base, tips).solutions();
            let is_fault = best.as_ref().is_some_and(|best| off(best) <= SAME_BASE * self.reach_m);
            let near = if tips.is_some() { NEAR_WITH_TIPS } else { NEAR };
            if off(&solutions) < near * self.reach_m && !(base.is_none() && is_fault) {
                return Some(solutions);
            }
            // Another base or tool must explain much to be believed, and more than a fault of some centimetres, which it would
            // hide.
            let explains = |best: &Vec<ChainSolution>| {
                off(&solutions) < 0.3 * off(best) && off(best) > SAME_BASE * self.reach_m
            };
            if best.as_ref().is_none_or(explains) && !solutions.is_empty() {
                best = Some(solutions);
            }
        }
        best
    }

    pub(crate) fn chain_pair(
        &self,
        pairs: &JointPairs,
        a_from_b: Option<Isometry3<f64>>,
        tips: Option<[Isometry3<f64>; 2]>,
    ) -> ChainPair {
        let axes = |of: usize| -> Vec<Axis> {
            let screws = pairs.iter().filter_map(|pair| self.screws[of].screw(pair[of]));
            screws.map(Axis::from_screw).collect()
        };
        let (a, b) = (axes(0), axes(1));
        let range = |[of_a, of_b]: &[JointIndex; 2]| {
            Some([self.a.robot.joint(*of_a).position_range()?, self.b.robot.joint(*of_b).position_range()?])
        };
        let ranges = pairs.iter().map(range).collect();
        ChainPair { known: vec![None; a.len()], a, b, tips, a_from_b, ranges, reach_m: self.reach_m }
    }

    /// For each end of the tree, its matched joints from the root.
    fn branches(&self, pairs: &JointPairs) -> Vec<(LinkIndex, JointPairs)> {
        let robot = &self.a.robot;
        let ends = robot.link_indices().filter(|&link| robot.joints().iter().all(|of| of.parent != link));
        let branch = |end: LinkIndex| -> (LinkIndex, JointPairs) {
            let joints = robot.chain(robot.root(), end).unwrap_or_default();
            let pair = |joint: &JointIndex| pairs.iter().find(|pair| pair[0] == *joint).copied();
            (end, joints.iter().filter_map(pair).collect())
        };
        ends.map(branch).collect()
    }

    pub(crate) fn unmatched(&self, pairs: &JointPairs) -> [Vec<JointIndex>; 2] {
        let without = |of: usize, robot: &Robot| {
            let is_free = |joint: &JointIndex| pairs.iter().all(|pair| pair[of] != *joint);
            robot.movable_joints().iter().copied().filter(is_free).collect()
        };
        [without(0, &self.a.robot), without(1, &self.b.robot)]
    }

    /// A joint of the other description in this variable.
    pub(crate) fn in_variable(&self, pair: [JointIndex; 2], variable: JointVariable) -> MappedJoint {
        MappedJoint {
            joint: pair[1],
            name: self.a.robot.joint(pair[0]).name.clone(),
            is_flipped: variable.is_flipped,
            offset: variable.offset,
        }
    }

    /// A joint of the other description, with the whole turns that bring its limits nearest to those here.
    fn mapped(&self, pair: [JointIndex; 2], variable: JointVariable) -> MappedJoint {
        let (a, b) = (self.a.robot.joint(pair[0]), self.b.robot.joint(pair[1]));
        let mapped = |offset: f64| self.in_variable(pair, JointVariable { offset, ..variable });
        let turn = std::f64::consts::TAU;
        if !b.kind.is_angular() || variable.offset == 0.0 {
            return mapped(variable.offset);
        }
        let offset = variable.offset - turn * (variable.offset / turn).round();
        let candidates = [offset, offset - turn, offset + turn].map(mapped);
        // Degrees of the common range, so that rounding does not choose a turn.
        let overlap = |candidate: &MappedJoint| -> f64 {
            let (Some((lower, upper)), Some(range)) = (a.position_range(), b.position_range()) else {
                return 0.0;
            };
            let ends = [range.0, range.1].map(|end| candidate.there(end));
            (upper.min(ends[0].max(ends[1])) - lower.max(ends[0].min(ends[1]))).to_degrees().floor()
        };
        let most = candidates.iter().map(&overlap).fold(f64::NEG_INFINITY, f64::max);
        candidates.into_iter().find(|candidate| overlap(candidate) >= most).expect("one has the most")
    }
}
