//! Offsets and base of a solution brought nearest to the axes of the robot, all together: the search finds them one after the
//! other, which is exact only as long as no later offset moves what an earlier one was found by.

use congruent_kinematics::least_squares::{Damping, NormalEquations};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::variables::{ChainPair, ChainSolution, JointVariable};

/// Steps at most; the search begins so near that three are enough. Kind: loop bound.
const MOST_STEPS: usize = 10;
/// Step of the differences, rad or m. Kind: truncation of central differences.
const STEP: f64 = 1e-6;
/// Unknowns without effect keep their values. Kind: solver.
const DAMPING: Damping = Damping { relative: 0.0, absolute: 1e-9 };

/// Repetitions with new weights. Kind: loop bound; the weights of a single fault settle in fewer.
const REWEIGHTED: usize = 30;
/// A difference, as a share of the reach, below which it counts no less for being large. Kind: solver.
const SMALL: f64 = 1e-12;
/// Differences of less, as a share of the reach, are those of what agrees in spite of a fault elsewhere. Kind: solver.
const AGREES: f64 = 1e-6;

impl ChainPair {
    /// The solution with the offsets, and the base if it is free, at which the axes are nearest.
    pub(crate) fn polished(&self, solution: ChainSolution) -> ChainSolution {
        let weights = vec![1.0; self.rest(&solution).len()];
        let best = self.nearest(solution, &weights);
        self.judged(&best.a_from_b, &best.variables).unwrap_or(best)
    }

    /// The solution with the smallest sum of differences (not of their squares) while offsets of 0 and of quarter turns stay: one
    /// joint whose origin is off then has all of the difference, and no other zero makes up for a part of it.
    pub(crate) fn with_one_fault(&self, solution: ChainSolution) -> ChainSolution {
        let quarter = std::f64::consts::FRAC_PI_2;
        let is_round = |of: &JointVariable| (of.offset / quarter).fract() == 0.0;
        let held = solution.variables.iter().zip(&self.known);
        let known = held.map(|(of, known)| known.or_else(|| is_round(of).then_some(*of))).collect();
        let held = Self { known, ..self.clone() };
        let sum = |solution: &ChainSolution| held.rest(solution).iter().map(|part| part.abs()).sum::<f64>();
        let mut best = solution;
        for _ in 0..REWEIGHTED {
            let small = SMALL * self.reach_m;
            let weights: Vec<f64> =
                held.rest(&best).iter().map(|part| (part.abs() + small).sqrt().recip()).collect();
            let next = held.nearest(best.clone(), &weights);
            if sum(&next) >= sum(&best) {
                break;
            }
            best = next;
        }
        // Large weights beside small ones end short of the last digits: these are of what agrees alone.
        let agrees = |part: &f64| f64::from(u8::from(part.abs() < AGREES * self.reach_m));
        let weights: Vec<f64> = held.rest(&best).iter().map(agrees).collect();
        let refined = held.nearest(best.clone(), &weights);
        if sum(&refined) <= sum(&best) * (1.0 + AGREES) {
            best = refined;
        }
        self.judged(&best.a_from_b, &best.variables).unwrap_or(best)
    }

    /// The solution at which the weighted differences are smallest by their squares.
    fn nearest(&self, solution: ChainSolution, weights: &[f64]) -> ChainSolution {
        let rest_of = |solution: &ChainSolution| -> Vec<f64> {
            self.rest(solution).iter().zip(weights).map(|(part, weight)| part * weight).collect()
        };
        let unknowns = self.unknowns();
        let mut best = solution;
        for _ in 0..MOST_STEPS {
            let rest = rest_of(&best);
            let columns: Vec<Vec<f64>> = unknowns
                .iter()
                .map(|&unknown| {
                    let [up, down] = [STEP, -STEP].map(|by| rest_of(&moved(&best, unknown, by)));
                    up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * STEP)).collect()
                })
                .collect();
            let step = NormalEquations::from_columns(&columns, &rest).damped_step(DAMPING);
            let Some(step) = step else { break };
            let stepped = unknowns
                .iter()
                .zip(step.iter())
                .fold(best.clone(), |solution, (&unknown, &by)| moved(&solution, unknown, by));
            let (before, after) = (norm(&rest), norm(&rest_of(&stepped)));
            if after >= before {
                break;
            }
            best = stepped;
        }
        best
    }

    fn unknowns(&self) -> Vec<Unknown> {
        let is_free = self.a_from_b.is_none();
        let offsets = (0..self.a.len()).filter(|&at| self.known[at].is_none() && !(is_free && at == 0));
        // Without a tool that says it, the zero of the last joint is a choice, and stays.
        let last = self.a.len().saturating_sub(1);
        let offsets = offsets.filter(|&at| self.tips.is_some() || at != last || self.a[at].slides);
        let base = (0..6).filter(|_| is_free).map(Unknown::Base);
        offsets.map(Unknown::Offset).chain(base).collect()
    }

    /// The rest: for each axis its difference in direction, as a length, and in place; for the tips likewise.
    fn rest(&self, solution: &ChainSolution) -> Vec<f64> {
        let mut rest = Vec::new();
        let mut moved = solution.a_from_b;
        for ((a, b), variable) in self.a.iter().zip(&self.b).zip(&solution.variables) {
            let there = b.moved(&moved);
            let direction = if variable.is_flipped { -there.direction } else { there.direction };
            rest.extend((a.direction.cross(&direction) * self.reach_m).iter());
            if !a.slides {
                let between = there.through - a.through;
                rest.extend((between - a.direction * a.direction.dot(&between)).iter());
            }
            moved *= b.motion(variable.offset);
        }
        if let Some([a, b]) = self.tips {
            let off = a.inverse() * moved * b;
            rest.extend(off.translation.vector.iter());
            rest.extend((off.rotation.scaled_axis() * self.reach_m).iter());
        }
        rest
    }
}

/// A number that is fitted.
#[derive(Debug, Clone, Copy)]
enum Unknown {
    /// The offset of a joint.
    Offset(usize),
    /// A component of a small motion of the base: shift, then turn.
    Base(usize),
}

fn moved(solution: &ChainSolution, unknown: Unknown, by: f64) -> ChainSolution {
    let mut moved = solution.clone();
    match unknown {
        Unknown::Offset(at) => {
            let JointVariable { offset, .. } = &mut moved.variables[at];
            *offset += by;
        }
        Unknown::Base(component) if component < 3 => {
            moved.a_from_b = Translation3::from(Vector3::ith(component, by)) * solution.a_from_b;
        }
        Unknown::Base(component) => {
            let turn = UnitQuaternion::from_scaled_axis(Vector3::ith(component - 3, by));
            moved.a_from_b = Isometry3::from_parts(Translation3::identity(), turn) * solution.a_from_b;
        }
    }
    moved
}

fn norm(rest: &[f64]) -> f64 {
    rest.iter().map(|part| part * part).sum::<f64>().sqrt()
}
