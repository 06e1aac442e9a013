//! Directions and zeros of the joints of one chain in terms of another: the search over what brings the axes of both
//! together.
//!
//! Joint after joint from the base, the axis of the next one says how far this one must be turned or shifted; where two
//! directions of an axis are possible, both are followed.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::axis::{Axis, shift_towards, turn_of_vectors, turn_towards};

/// An axis that is farther off than this is not that of the same joint. Kind: choice, far beyond what calibrations and
/// mistakes of a digit change.
const OTHER_ANGLE_RAD: f64 = 0.35;
/// The same for the distance, as a share of the reach.
const OTHER_DISTANCE: f64 = 0.2;
/// Most solutions that are followed to their end; wrists with axes at right angles have a few.
const MOST_SOLUTIONS: usize = 256;
/// Axes agree exactly, up to the digits of pi, below this share of the reach. Kind: choice.
const EXACT: f64 = 1e-7;
/// What an offset near a quarter turn may hide of a fault, as a share of the reach. Kind: choice, some centimetres.
const FAULT: f64 = 0.02;
/// The same of an offset that would need another range than both files write, which is a fault of the origin then. Kind: choice, some
/// degrees.
const OF_RANGES: f64 = 0.1;
/// Cosine of the tilt of an upright base. Kind: choice, a degree.
const UPRIGHT: f64 = 0.9998;
/// A base at the first axes is another one than the fitted, if all axes are farther off than this multiple. Kind: choice; a fault in the
/// middle of a chain is twice as far off as if the base had half of it.
const MOST_OF_FITTED: f64 = 5.0;
/// Offsets of less are the rounding of calculation.
const ROUNDING: f64 = 1e-9;

/// Two chains of the same kinds of joints, each in the frame of its root, at zero.
#[derive(Debug, Clone)]
pub(crate) struct ChainPair {
    pub(crate) a: Vec<Axis>,
    pub(crate) b: Vec<Axis>,
    /// Poses of the two tips at zero, if their frames are the same.
    pub(crate) tips: Option<[Isometry3<f64>; 2]>,
    /// Pose of B's root in A's, if it is known.
    pub(crate) a_from_b: Option<Isometry3<f64>>,
    /// Variables that are known already, from a chain with the same joints.
    pub(crate) known: Vec<Option<JointVariable>>,
    /// The ranges of the joints of A and B, where both state one.
    pub(crate) ranges: Vec<Option<[(f64, f64); 2]>>,
    /// Reach of A, m: the lever with which angles count.
    pub(crate) reach_m: f64,
}

/// The variable of a joint of B: `q_b = q_a + offset`, or `-q_a + offset` if it is flipped.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct JointVariable {
    pub(crate) is_flipped: bool,
    pub(crate) offset: f64,
}

/// A solution to bring the axes together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChainSolution {
    pub(crate) variables: Vec<JointVariable>,
    /// Pose of B's root in A's.
    pub(crate) a_from_b: Isometry3<f64>,
    /// The largest angle between two axes, rad.
    pub(crate) angle_rad: f64,
    /// The largest distance of two axes, or of the tips, m.
    pub(crate) distance_m: f64,
}

impl ChainSolution {
    /// Both as a distance.
    pub(crate) fn off_m(&self, reach_m: f64) -> f64 {
        self.distance_m + reach_m * self.angle_rad
    }

    pub(crate) fn flips(&self) -> usize {
        self.variables.iter().filter(|of| of.is_flipped).count()
    }

    /// Number and sum of the offsets.
    fn offsets(&self) -> (usize, f64) {
        let offsets = self.variables.iter().map(|of| of.offset.abs()).filter(|&offset| offset > ROUNDING);
        (offsets.clone().count(), offsets.sum())
    }
}

impl ChainPair {
    /// The solutions that bring the axes nearest together, the simplest first: fewest flips, fewest offsets, smallest offsets.
    /// Empty if the axes are those of other chains.
    pub(crate) fn solutions(&self) -> Vec<ChainSolution> {
        let mut solutions = Vec::new();
        for start in self.starts() {
            self.follow(&start, start, &mut Vec::new(), &mut solutions);
        }
        let off_m = |solution: &ChainSolution| solution.off_m(self.reach_m);
        // Each with how far off it is at least: a round offset may only move a fault to where the files have it.
        let rounded = solutions.into_iter().map(|solution| {
            let polished = self.polished(solution);
            let least_m = off_m(&polished);
            let rounded = self.with_one_fault(self.with_round_offsets(polished));
            // Again, since one fault alone may have kept some of them from a round value.
            let rounded = self.with_round_offsets(rounded);
            (least_m.min(off_m(&rounded)), rounded)
        });
        let rounded: Vec<(f64, ChainSolution)> = rounded.collect();
        let best_m = rounded.iter().map(|(least_m, _)| *least_m).fold(f64::INFINITY, f64::min);
        let limit_m = 2.0 * best_m + 1e-9 * self.reach_m;
        let mut solutions: Vec<ChainSolution> = Vec::new();
        for (_, solution) in rounded.into_iter().filter(|(least_m, _)| *least_m <= limit_m) {
            if !solutions.iter().any(|known| is_same(known, &solution)) {
                solutions.push(solution);
            }
        }
        let cost = |solution: &ChainSolution| {
            let (count, sum) = solution.offsets();
            // A base is upright in both files.
            let is_tilted =
                self.a_from_b.is_none() && (solution.a_from_b.rotation * Vector3::z()).z < UPRIGHT;
            (is_tilted, solution.flips(), count, sum)
        };
        solutions.sort_by(|a, b| cost(a).partial_cmp(&cost(b)).unwrap_or(std::cmp::Ordering::Equal));
        solutions
    }

    /// Known variables with the base that brings the first axes together: a fault behind them is then at one joint, where a base
    /// that is fitted to all axes would have a part of it. Where all axes are parallel, `tips` show the height. `None` if the axes are
    /// those of other chains.
    pub(crate) fn with_base_at_first_axes(&self, tips: Option<[Isometry3<f64>; 2]>) -> Option<ChainSolution> {
        let fitted = self.solutions().into_iter().next()?;
        let off = |solution: &ChainSolution| solution.off_m(self.reach_m);
        let starts = Self { tips, ..self.clone() }.starts();
        let at_first = starts.into_iter().filter_map(|start| self.judged(&start, &fitted.variables));
        let nearest = at_first.min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.filter(|nearest| off(nearest) <= MOST_OF_FITTED * off(&fitted)).or(Some(fitted))
    }

    /// Where the root of B may be in A before any joint: as known, or with the first axes on each other.
    fn starts(&self) -> Vec<Isometry3<f64>> {
        if let Some(a_from_b) = self.a_from_b {
            return vec![a_from_b];
        }
        let (Some(a), Some(b)) = (self.a.first(), self.b.first()) else { return Vec::new() };
        let mut starts = Vec::new();
        for sign in [1.0, -1.0] {
            let turn = turn_between(&(b.direction * sign), &a.direction);
            let onto = Isometry3::from_parts(Translation3::from(a.through - turn * b.through), turn);
            let known = self.known.first().copied().flatten().unwrap_or_default();
            let bent = b.motion(known.offset);
            // The turn about the first axis and the shift along it are those of the base.
            for turned in self.turns(0, a, &(onto * bent)) {
                let turned = Axis { slides: false, ..*a }.motion(turned) * onto;
                starts.push(self.shifted_base(a, turned, &bent));
            }
        }
        starts
    }

    /// The base, shifted so that the next axis is at its height, or the first turning axis in its place.
    fn shifted_base(&self, first: &Axis, a_from_b: Isometry3<f64>, bent: &Isometry3<f64>) -> Isometry3<f64> {
        let moved = a_from_b * bent;
        let shift = if first.slides {
            let turning = self.a.iter().zip(&self.b).find(|(a, _)| !a.slides);
            turning.map(|(a, b)| a.through - b.moved(&moved).through)
        } else {
            let lines = self.a.iter().zip(&self.b).skip(1);
            let mut shifts = lines
                .filter_map(|(a, b)| shift_towards(&first.direction, &first.through, &b.moved(&moved), a));
            shifts.next().or_else(|| self.height_of_tips(first, &moved)).map(|shift| first.direction * shift)
        };
        Translation3::from(shift.unwrap_or_else(Vector3::zeros)) * a_from_b
    }

    /// How far B must be shifted along parallel axes for the tips to be at one height, joints where they are known to be.
    fn height_of_tips(&self, first: &Axis, moved: &Isometry3<f64>) -> Option<f64> {
        let [a, b] = self.tips?;
        let bent = self
            .b
            .iter()
            .zip(&self.known)
            .skip(1)
            .map(|(axis, known)| axis.motion(known.unwrap_or_default().offset));
        let there = bent.fold(*moved, |moved, bent| moved * bent) * b;
        Some(first.direction.dot(&(a.translation.vector - there.translation.vector)))
    }

    /// Follows all solutions from the joint behind the known variables on.
    fn follow(
        &self,
        a_from_b: &Isometry3<f64>,
        moved: Isometry3<f64>,
        variables: &mut Vec<JointVariable>,
        solutions: &mut Vec<ChainSolution>,
    ) {
        if solutions.len() >= MOST_SOLUTIONS {
            return;
        }
        let at = variables.len();
        let Some(axis) = self.a.get(at) else {
            solutions.extend(self.judged(a_from_b, variables));
            return;
        };
        let there = self.b[at].moved(&moved);
        let is_flipped =
            self.known[at].map_or(there.direction.dot(&axis.direction) < 0.0, |known| known.is_flipped);
        let directed = if is_flipped { Axis { direction: -there.direction, ..there } } else { there };
        let (angle_rad, distance_m) = directed.difference(axis);
        if angle_rad > OTHER_ANGLE_RAD || distance_m > OTHER_DISTANCE * self.reach_m {
            return;
        }
        for offset in self.offsets(at, &there, &moved) {
            variables.push(JointVariable { is_flipped, offset });
            self.follow(a_from_b, moved * self.b[at].motion(offset), variables, solutions);
            variables.pop();
        }
    }

    /// The positions of joint `at` of B, whose axis is `there` in A, that bring the next axis to its place.
    fn offsets(&self, at: usize, there: &Axis, moved: &Isometry3<f64>) -> Vec<f64> {
        if let Some(known) = self.known[at] {
            return vec![known.offset];
        }
        // What the first joint turns is the base, if that is free.
        if at == 0 && self.a_from_b.is_none() {
            return vec![0.0];
        }
        if there.slides { vec![self.shift(at, there, moved)] } else { self.turns(at, there, moved) }
    }

    /// The turns of joint `at` about its axis: one for each direction of the next axis that says something.
    fn turns(&self, at: usize, axis: &Axis, moved: &Isometry3<f64>) -> Vec<f64> {
        for (a, b) in self.a.iter().zip(&self.b).skip(at + 1) {
            let there = b.moved(moved);
            let turn = |sign: f64| {
                turn_towards(axis, &Axis { direction: there.direction * sign, ..there }, a, self.reach_m)
            };
            let (Some(one), Some(other)) = (turn(1.0), turn(-1.0)) else { continue };
            let is_one = (one - other).abs() < ROUNDING;
            return if is_one { vec![one] } else { vec![one, other] };
        }
        vec![self.turn_of_tip(axis, moved).unwrap_or(0.0)]
    }

    fn turn_of_tip(&self, axis: &Axis, moved: &Isometry3<f64>) -> Option<f64> {
        let [a, b] = self.tips?;
        let there = moved * b;
        let mut pairs = vec![(there.translation.vector - axis.through, a.translation.vector - axis.through)];
        for unit in [Vector3::x(), Vector3::y(), Vector3::z()] {
            pairs.push((there.rotation * unit * self.reach_m, a.rotation * unit * self.reach_m));
        }
        turn_of_vectors(&axis.direction, &pairs)
    }

    /// The shift of joint `at` along its axis that brings the next line, or the tip, to its height.
    fn shift(&self, at: usize, axis: &Axis, moved: &Isometry3<f64>) -> f64 {
        for (next, (a, b)) in self.a.iter().zip(&self.b).enumerate().skip(at + 1) {
            let through = if next == at + 1 { &a.through } else { &self.a[next - 1].through };
            if let Some(shift) = shift_towards(&axis.direction, through, &b.moved(moved), a) {
                return shift;
            }
        }
        self.tips.map_or(0.0, |[a, b]| {
            axis.direction.dot(&(a.translation.vector - (moved * b).translation.vector))
        })
    }

    /// A complete solution, with its residual.
    pub(crate) fn judged(
        &self,
        a_from_b: &Isometry3<f64>,
        variables: &[JointVariable],
    ) -> Option<ChainSolution> {
        let mut solution = ChainSolution {
            variables: variables.to_vec(),
            a_from_b: *a_from_b,
            angle_rad: 0.0,
            distance_m: 0.0,
        };
        let mut moved = *a_from_b;
        for ((a, b), variable) in self.a.iter().zip(&self.b).zip(variables) {
            let there = b.moved(&moved);
            let direction = if variable.is_flipped { -there.direction } else { there.direction };
            let (angle_rad, distance_m) = Axis { direction, ..there }.difference(a);
            solution.angle_rad = solution.angle_rad.max(angle_rad);
            solution.distance_m = solution.distance_m.max(distance_m);
            moved *= b.motion(variable.offset);
        }
        if let Some([a, b]) = self.tips {
            let off = a.inverse() * moved * b;
            solution.angle_rad = solution.angle_rad.max(off.rotation.angle());
            solution.distance_m = solution.distance_m.max(off.translation.vector.norm());
        }
        solution.off_m(self.reach_m).is_finite().then_some(solution)
    }

    /// Offsets that make both ranges of a joint the same, and others near 0 and near quarter turns as these, where nothing speaks
    /// against it: all at once if that is possible, since those of neighbours may make up for each other.
    fn with_round_offsets(&self, mut solution: ChainSolution) -> ChainSolution {
        let round: Vec<Vec<f64>> =
            (0..solution.variables.len()).map(|at| self.round_offsets(at, solution.variables[at])).collect();
        let with = |solution: &ChainSolution, offsets: &[(usize, f64)]| {
            let mut variables = solution.variables.clone();
            for &(at, offset) in offsets {
                variables[at].offset = offset;
            }
            let rounded = self.judged(&solution.a_from_b, &variables)?;
            let moved =
                offsets.iter().filter(|(at, offset)| !is_equal(solution.variables[*at].offset, *offset));
            let is_of_ranges =
                moved.clone().all(|&(at, offset)| self.has_written_range(at, solution.variables[at], offset));
            let slack = if is_of_ranges { OF_RANGES } else { self.slack(solution) };
            let most_m = 1.2 * solution.off_m(self.reach_m) + slack * self.reach_m;
            (rounded.off_m(self.reach_m) <= most_m).then_some(rounded)
        };
        let first = round.iter().enumerate().filter_map(|(at, offsets)| Some((at, *offsets.first()?)));
        if let Some(rounded) = with(&solution, &first.collect::<Vec<_>>()) {
            return rounded;
        }
        for (at, offsets) in round.iter().enumerate() {
            let mut accepted = offsets.iter().filter_map(|&offset| with(&solution, &[(at, offset)]));
            if let Some(rounded) = accepted.next() {
                solution = rounded;
            }
        }
        solution
    }

    /// How far off axes may be with rounder offsets than those of a solution, as a share of the reach.
    fn slack(&self, solution: &ChainSolution) -> f64 {
        // Between files that do not agree exactly, an offset of a degree may only make up for a fault.
        let is_exact = solution.off_m(self.reach_m) <= EXACT * self.reach_m;
        if is_exact { 1e-10 } else { FAULT }
    }

    /// Whether both files write the same range of a joint, which is then the same with this offset: another zero would need another range,
    /// and a fault of the origin does not.
    fn has_written_range(&self, at: usize, found: JointVariable, offset: f64) -> bool {
        offset == 0.0 && self.offset_of_ranges(at, JointVariable { offset, ..found }) == Some(0.0)
    }

    /// The offsets near that of a joint that are rounder, the best first; none if it is known.
    fn round_offsets(&self, at: usize, found: JointVariable) -> Vec<f64> {
        /// A calibrated zero is up to a few degrees off, and so is one that makes up for a fault of some centimetres.
        const NEAR_RAD: f64 = 0.087;
        let slides = self.b[at].slides;
        let step = if slides { f64::INFINITY } else { std::f64::consts::FRAC_PI_2 };
        let round = if slides { 0.0 } else { (found.offset / step).round() * step };
        let of_ranges = self.offset_of_ranges(at, found).filter(|_| !slides);
        let candidates = of_ranges.into_iter().chain([round + 0.0]);
        let is_near =
            |candidate: &f64| self.known[at].is_none() && (found.offset - candidate).abs() <= NEAR_RAD;
        candidates.filter(is_near).collect()
    }

    /// The solution with a turned base instead of another zero of the first joint, if both files state the same range of that joint: the
    /// base explains the zero and the range, and another zero would need another range.
    pub(crate) fn with_turned_base(&self, solution: &ChainSolution) -> Option<ChainSolution> {
        let (first, there) = (solution.variables.first()?, self.b.first()?);
        let as_written = JointVariable { offset: 0.0, ..*first };
        let has_same_range = self.offset_of_ranges(0, as_written) == Some(0.0);
        (first.offset.abs() > ROUNDING && has_same_range && !there.slides).then(|| {
            let a_from_b = solution.a_from_b * there.motion(first.offset);
            let mut turned = ChainSolution { a_from_b, ..solution.clone() };
            turned.variables[0] = as_written;
            turned
        })
    }

    /// The offset at which both ends of the ranges of a joint are the same, with the whole turns of one that was found.
    fn offset_of_ranges(&self, at: usize, found: JointVariable) -> Option<f64> {
        /// Ranges are given to a tenth of a degree.
        const SAME_END: f64 = 2e-3;
        let [a, b] = self.ranges[at]?;
        let [lower, upper] = if found.is_flipped { [b.1 + a.0, b.0 + a.1] } else { [b.0 - a.0, b.1 - a.1] };
        let turns = std::f64::consts::TAU * ((found.offset - lower) / std::f64::consts::TAU).round();
        // Equal ranges are those of equal zeros: rounding of their ends is none of the zero.
        let offset = if lower.abs().max(upper.abs()) < SAME_END { 0.0 } else { lower };
        ((lower - upper).abs() < SAME_END).then_some(offset + turns)
    }
}

fn is_equal(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}

/// Whether two solutions are the same except for rounding and whole turns.
fn is_same(a: &ChainSolution, b: &ChainSolution) -> bool {
    let is_near = |(a, b): (&JointVariable, &JointVariable)| {
        let off = a.offset - b.offset;
        a.is_flipped == b.is_flipped && libm::sin(off).abs() < 1e-6 && libm::cos(off) > 0.0
    };
    a.variables.iter().zip(&b.variables).all(is_near)
}

/// The smallest turn that brings one direction to another.
fn turn_between(from: &Vector3<f64>, to: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(from, to).unwrap_or_else(|| {
        // Opposite: half a turn about any direction across.
        let across = if from.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        UnitQuaternion::from_scaled_axis(from.cross(&across).normalize() * std::f64::consts::PI)
    })
}
