//! The smallest of a quadratic sum, among robots that can exist.

use congruent_dynamics::PARAMETERS;
use congruent_kinematics::least_squares::BalancedCholesky;
use nalgebra::{DMatrix, DVector};

use crate::pseudo_inertia::{Parameters, Triangle, is_body};

/// The sum `x^T H x / 2 - g^T x`, whose unknowns are changes of free parameters.
#[derive(Debug, Clone)]
pub(crate) struct Quadratic {
    pub(crate) information: DMatrix<f64>,
    pub(crate) right_side: DVector<f64>,
}

/// What a solution has to obey.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bounds {
    /// Unknowns that are at least this.
    pub(crate) least: Vec<(usize, f64)>,
    /// Bodies that have to be able to exist: the first of their ten unknowns, and the parameters that these are added to.
    pub(crate) bodies: Vec<(usize, Parameters)>,
    /// For each body one that can exist, where a search begins.
    pub(crate) begin: Vec<Parameters>,
}

/// Steps of the search for bodies. Kind: loop bound; some thirty are needed.
const STEPS: usize = 1000;
/// Ends the search: no unit, part of the sum. Kind: solver.
const NO_BETTER: f64 = 1e-15;
/// Ends the search: no step leads down. No unit; kind: solver.
const MOST_DAMPING: f64 = 1e12;

impl Quadratic {
    fn value(&self, x: &DVector<f64>) -> f64 {
        x.dot(&(&self.information * x)) / 2.0 - self.right_side.dot(x)
    }

    /// The smallest without bounds; `None` if the information is singular.
    fn free(&self) -> Option<DVector<f64>> {
        Some(BalancedCholesky::new(self.information.clone())?.solve(&self.right_side))
    }

    /// The smallest with some unknowns held at values.
    fn with_held(&self, held: &[(usize, f64)]) -> Option<DVector<f64>> {
        let is_free = |at: &usize| held.iter().all(|(of, _)| of != at);
        let free: Vec<usize> = (0..self.right_side.len()).filter(is_free).collect();
        let mut x = DVector::zeros(self.right_side.len());
        for (at, value) in held {
            x[*at] = *value;
        }
        let rest = &self.right_side - &self.information * &x;
        let part = Self {
            information: self.information.select_rows(&free).select_columns(&free),
            right_side: rest.select_rows(&free),
        };
        let solved = part.free()?;
        free.iter().zip(solved.iter()).for_each(|(at, value)| x[*at] = *value);
        Some(x)
    }

    /// The smallest within the bounds; `None` if the information is singular.
    pub(crate) fn smallest(&self, bounds: &Bounds) -> Option<DVector<f64>> {
        let mut held: Vec<(usize, f64)> = Vec::new();
        loop {
            let x = self.with_held(&held)?;
            let x = if can_exist(&x, bounds) { x } else { self.with_bodies(&x, bounds, &held)? };
            // The one that is farthest beyond its bound is held there.
            let beyond = bounds.least.iter().filter(|(at, _)| held.iter().all(|(of, _)| of != at));
            let beyond = beyond.map(|&(at, least)| (at, least, least - x[at]));
            let worst = beyond.filter(|(.., by)| *by > 0.0).max_by(|a, b| a.2.total_cmp(&b.2));
            let Some((at, least, _)) = worst else { return Some(x) };
            held.push((at, least));
        }
    }

    /// The smallest with bodies that can exist, by damped Newton steps in their triangles. Gauss-Newton steps overshoot there: the
    /// numbers of a body without extension are zero.
    fn with_bodies(
        &self,
        from: &DVector<f64>,
        bounds: &Bounds,
        held: &[(usize, f64)],
    ) -> Option<DVector<f64>> {
        let begin =
            bounds.bodies.iter().zip(&bounds.begin).map(|((first, added_to), begin)| {
                Triangle::of(&towards(begin, &body(from, *first, added_to)))
            });
        let begin = begin.collect::<Option<Vec<_>>>()?;
        let mut at = Point { x: from.clone(), triangles: begin };
        at.put_bodies(bounds);
        let mut value = self.value(&at.x);
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let next = self.step(&at, bounds, held, damping).map(|step| at.stepped(&step, bounds));
            let next = next.map(|next| (self.value(&next.x), next)).filter(|(next, _)| *next < value);
            let Some((next_value, next)) = next else {
                damping *= 4.0;
                if damping > MOST_DAMPING {
                    break;
                }
                continue;
            };
            let is_end = value - next_value < NO_BETTER * value.abs();
            (at, value) = (next, next_value);
            damping /= 5.0;
            if is_end {
                break;
            }
        }
        at.keep_from_boundary(bounds);
        Some(at.x)
    }

    /// A damped Newton step; `None` if the damping is too small for one that leads down.
    fn step(&self, at: &Point, bounds: &Bounds, held: &[(usize, f64)], damping: f64) -> Option<DVector<f64>> {
        let jacobian = at.jacobian(bounds, held);
        let downhill = &self.right_side - &self.information * &at.x;
        let mut information = jacobian.transpose() * &self.information * &jacobian;
        let least = information.diagonal().max() * f64::EPSILON;
        for place in 0..information.nrows() {
            information[(place, place)] += damping * information[(place, place)] + least;
        }
        for (first, _) in &bounds.bodies {
            let gradient = -Parameters::from_fn(|at, _| downhill[first + at]);
            let mut block = information.fixed_view_mut::<PARAMETERS, PARAMETERS>(*first, *first);
            block += Triangle::curvature(&gradient);
        }
        Some(BalancedCholesky::new(information)?.solve(&(jacobian.transpose() * downhill)))
    }
}

/// The body nearest to a wanted one, between it and a known one, that can exist with some room: a search from there is short.
fn towards(begin: &Parameters, wanted: &Parameters) -> Parameters {
    const HALVINGS: usize = 40;
    /// Part of the distance to the boundary.
    const ROOM: f64 = 0.9;
    if is_body(wanted) {
        return *wanted;
    }
    let at = |part: f64| begin * (1.0 - part) + wanted * part;
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(inside, outside);
        let limit = if is_body(&at(middle)) { &mut inside } else { &mut outside };
        *limit = middle;
    }
    at(ROOM * inside)
}

/// The part by which bodies of a search stay away from the boundary. No unit; kind: choice, more than what six digits round.
const FROM_BOUNDARY: f64 = 1e-4;

fn body(x: &DVector<f64>, first: usize, added_to: &Parameters) -> Parameters {
    Parameters::from_fn(|at, _| x[first + at]) + added_to
}

fn can_exist(x: &DVector<f64>, bounds: &Bounds) -> bool {
    bounds.bodies.iter().all(|(first, added_to)| is_body(&body(x, *first, added_to)))
}

/// A point of the search: the unknowns, those of bodies by their triangles.
#[derive(Debug, Clone)]
struct Point {
    x: DVector<f64>,
    triangles: Vec<Triangle>,
}

impl Point {
    fn put_bodies(&mut self, bounds: &Bounds) {
        for ((first, added_to), triangle) in bounds.bodies.iter().zip(&self.triangles) {
            self.x.rows_mut(*first, PARAMETERS).copy_from(&(triangle.parameters() - added_to));
        }
    }

    /// Moves bodies that lie on the boundary a little towards those where the search began: one without any extension would be no body
    /// for a simulator, or once its digits are rounded.
    fn keep_from_boundary(&mut self, bounds: &Bounds) {
        for ((first, added_to), begin) in bounds.bodies.iter().zip(&bounds.begin) {
            let found = body(&self.x, *first, added_to);
            let kept = found * (1.0 - FROM_BOUNDARY) + begin * FROM_BOUNDARY;
            self.x.rows_mut(*first, PARAMETERS).copy_from(&(kept - added_to));
        }
    }

    fn jacobian(&self, bounds: &Bounds, held: &[(usize, f64)]) -> DMatrix<f64> {
        let mut jacobian = DMatrix::identity(self.x.len(), self.x.len());
        for (at, _) in held {
            jacobian[(*at, *at)] = 0.0;
        }
        for ((first, _), triangle) in bounds.bodies.iter().zip(&self.triangles) {
            jacobian.fixed_view_mut::<PARAMETERS, PARAMETERS>(*first, *first).copy_from(&triangle.jacobian());
        }
        jacobian
    }

    fn stepped(&self, step: &DVector<f64>, bounds: &Bounds) -> Self {
        let mut next = Self { x: &self.x + step, triangles: self.triangles.clone() };
        for ((first, _), triangle) in bounds.bodies.iter().zip(&mut next.triangles) {
            *triangle = triangle.stepped(step.rows(*first, PARAMETERS).as_slice());
        }
        next.put_bodies(bounds);
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pseudo_inertia::parameters;
    use nalgebra::Matrix4;

    #[test]
    fn an_unknown_stays_at_its_bound_and_the_others_follow() {
        let information = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
        let sum = Quadratic { information, right_side: DVector::from_vec(vec![-1.0, 4.0]) };
        let bounds = Bounds { least: vec![(0, 0.0)], ..Bounds::default() };
        // Without the bound (-2, 3).
        let x = sum.smallest(&bounds).unwrap();
        assert!(x[0].abs() < 1e-12 && (x[1] - 2.0).abs() < 1e-12, "{x}");
    }

    /// The nearest body to parameters that no body has: it lies on the boundary, and the sum is not smaller around it.
    #[test]
    fn bodies_that_cannot_exist_become_the_nearest_that_can() {
        let wanted = parameters(&Matrix4::from_diagonal(&nalgebra::Vector4::new(0.02, -0.01, 0.03, 1.0)));
        let sum = Quadratic {
            information: DMatrix::identity(10, 10),
            right_side: DVector::from_column_slice(wanted.as_slice()),
        };
        let begin = parameters(&Matrix4::from_diagonal(&nalgebra::Vector4::new(0.1, 0.1, 0.1, 1.0)));
        let bounds =
            Bounds { bodies: vec![(0, Parameters::zeros())], begin: vec![begin], ..Bounds::default() };
        let x = sum.smallest(&bounds).unwrap();
        let found = crate::pseudo_inertia::pseudo_inertia(&body(&x, 0, &Parameters::zeros()));
        let least = found.symmetric_eigenvalues().min();
        assert!(least > 0.0 && least < 2e-5, "{least}");
        // The moment about y is 0.02 + 0.03, the others are shared with what was negative: by hand, S = diag(a, 0, c) that makes
        // (c - 0.02)^2 + (a + c - 0.05)^2 + (a - 0.01)^2 smallest: a = 0.01 + 0.02/3, c = 0.02 + 0.02/3.
        assert!(
            (found[(0, 0)] - 0.05 / 3.0).abs() < 1e-4 && (found[(2, 2)] - 0.08 / 3.0).abs() < 1e-4,
            "{found}"
        );
    }
}
