//! Cubic splines of joint positions: acceleration is continuous. Source: Biagiotti & Melchiorri, *Trajectory Planning for
//! Automatic Machines and Robots* (2008), sec. 4.4.

use congruent_description::RobotQ;

/// How a spline begins and ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplineEnds {
    /// At rest and without acceleration. For this the spline gets a knot in the middle of its first and of its last
    /// interval.
    Rest,
    /// With the slope of the parabola through the first, or the last, three points.
    Parabola,
    /// No spline: straight lines from knot to knot.
    Straight,
}

/// Joint positions over an increasing parameter: time, or the share of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct JointSpline {
    knots: Vec<f64>,
    dof: usize,
    /// Positions, a row for each knot.
    q: Vec<f64>,
    /// Second derivatives by the parameter, a row for each knot.
    second: Vec<f64>,
}

/// Positions and their derivatives by the parameter, as a spline writes them.
pub(crate) struct SplineValues<'a> {
    pub(crate) q: &'a mut [f64],
    pub(crate) first: &'a mut [f64],
    pub(crate) second: &'a mut [f64],
}

impl JointSpline {
    /// The spline through these positions at these values of the parameter, at least two.
    ///
    /// # Panics
    /// If there are less than two, or not as many positions as knots.
    pub fn new(knots: &[f64], points: &[RobotQ], ends: SplineEnds) -> Self {
        assert!(knots.len() >= 2 && knots.len() == points.len(), "a position for each of two knots or more");
        let dof = points[0].len();
        let knots = match ends {
            SplineEnds::Rest => with_free_knots(knots),
            SplineEnds::Parabola | SplineEnds::Straight => knots.to_vec(),
        };
        let mut spline =
            Self { q: vec![0.0; knots.len() * dof], second: vec![0.0; knots.len() * dof], knots, dof };
        for joint in 0..dof {
            let given: Vec<f64> = points.iter().map(|point| point[joint]).collect();
            let (q, second) = match ends {
                SplineEnds::Rest => resting(&spline.knots, &given),
                SplineEnds::Parabola => {
                    let slopes = parabola_slopes(&spline.knots, &given);
                    let second = second_derivatives(&spline.knots, &given, slopes);
                    (given, second)
                }
                SplineEnds::Straight => {
                    let second = vec![0.0; given.len()];
                    (given, second)
                }
            };
            for (knot, (q, second)) in q.into_iter().zip(second).enumerate() {
                spline.q[knot * dof + joint] = q;
                spline.second[knot * dof + joint] = second;
            }
        }
        spline
    }

    /// Splines one after another, each beginning at the end of the one before; velocity may jump there.
    ///
    /// # Panics
    /// If there is none.
    #[must_use]
    pub fn joined(parts: Vec<Self>) -> Self {
        let mut parts = parts.into_iter();
        let mut whole = parts.next().expect("at least one spline");
        // The knot between is there twice; no value of the parameter is in the interval without length.
        for part in parts {
            whole.knots.extend(part.knots);
            whole.q.extend(part.q);
            whole.second.extend(part.second);
        }
        whole
    }

    /// Values of the parameter at the knots, in increasing order.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Positions and derivatives at a value of the parameter, which is taken to the nearest end outside.
    pub(crate) fn at(&self, parameter: f64, values: SplineValues<'_>) {
        let SplineValues { q, first, second } = values;
        let (interval, h) = self.interval(parameter);
        let end = self.knots[interval + 1];
        let a = ((end - parameter) / h).clamp(0.0, 1.0);
        let b = 1.0 - a;
        let rows = |values: &'_ [f64], joint: usize| {
            (values[interval * self.dof + joint], values[(interval + 1) * self.dof + joint])
        };
        // The cubic by positions q and second derivatives m at both ends, with a + b = 1:
        // q = a q0 + b q1 + ((a^3 - a) m0 + (b^3 - b) m1) h^2 / 6, and its derivatives.
        for joint in 0..self.dof {
            let ((q0, q1), (m0, m1)) = (rows(&self.q, joint), rows(&self.second, joint));
            q[joint] = a * q0 + b * q1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0;
            first[joint] = (q1 - q0) / h + ((1.0 - 3.0 * a * a) * m0 + (3.0 * b * b - 1.0) * m1) * h / 6.0;
            second[joint] = a * m0 + b * m1;
        }
    }

    /// Largest magnitude of the third derivative of a joint: constant on each interval.
    pub(crate) fn largest_third(&self, joint: usize) -> f64 {
        let row = |knot: usize| self.second[knot * self.dof + joint];
        let third = |knot: usize| (row(knot + 1) - row(knot)) / (self.knots[knot + 1] - self.knots[knot]);
        (0..self.knots.len() - 1).map(|knot| third(knot).abs()).fold(0.0, f64::max)
    }

    /// The interval of a value of the parameter, and its length.
    fn interval(&self, parameter: f64) -> (usize, f64) {
        let after = self.knots.partition_point(|&knot| knot <= parameter);
        // Outside the knots the first or the last interval counts; a double knot of `joined` has no length and is
        // never found.
        let interval = after.clamp(1, self.knots.len() - 1) - 1;
        (interval, self.knots[interval + 1] - self.knots[interval])
    }
}

/// The knots with one more in the middle of the first and of the last interval; of two, at thirds.
fn with_free_knots(knots: &[f64]) -> Vec<f64> {
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    // In one interval both midpoints would be the same knot.
    if knots.len() == 2 {
        let third = (last - first) / 3.0;
        return vec![first, first + third, last - third, last];
    }
    let mut all = knots.to_vec();
    all.insert(1, f64::midpoint(knots[0], knots[1]));
    let before_last = all.len() - 1;
    all.insert(before_last, f64::midpoint(knots[knots.len() - 2], last));
    all
}

/// Positions at all knots, and second derivatives, so that slope and second derivative are zero at both ends: both are
/// linear in the positions at the two free knots.
fn resting(knots: &[f64], given: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let last = knots.len() - 1;
    let with = |inner: &[f64], first: f64, second: f64| {
        let mut y = vec![given[0], first];
        y.extend_from_slice(inner);
        y.extend([second, given[given.len() - 1]]);
        y
    };
    let inner = &given[1..given.len() - 1];
    let nothing = vec![0.0; inner.len()];
    // With slopes of zero built in; the second derivatives at the ends are then affine in the two free positions:
    // base + x1 of_first + x2 of_last.
    let solve = |y: &[f64]| second_derivatives(knots, y, [0.0; 2]);
    let base = solve(&with(inner, given[0], given[given.len() - 1]));
    let mut unit = with(&nothing, 1.0, 0.0);
    (unit[0], unit[last]) = (0.0, 0.0);
    let of_first = solve(&unit);
    (unit[1], unit[last - 1]) = (0.0, 1.0);
    let of_last = solve(&unit);
    // Cramer's rule for both second derivatives to be zero.
    let determinant = of_first[0] * of_last[last] - of_last[0] * of_first[last];
    let first = (of_last[0] * base[last] - base[0] * of_last[last]) / determinant;
    let second = (base[0] * of_first[last] - of_first[0] * base[last]) / determinant;
    let y = with(inner, given[0] + first, given[given.len() - 1] + second);
    let mut derivatives = solve(&y);
    // Zero up to rounding; exactly zero, so that the arm starts without acceleration.
    (derivatives[0], derivatives[last]) = (0.0, 0.0);
    (y, derivatives)
}

/// Slopes at the ends of the parabolas through three points; of two points, of the line.
fn parabola_slopes(knots: &[f64], y: &[f64]) -> [f64; 2] {
    let slope = |a: usize, b: usize| (y[b] - y[a]) / (knots[b] - knots[a]);
    let last = y.len() - 1;
    if last == 1 {
        return [slope(0, 1); 2];
    }
    let at_end = |end: usize, near: usize, far: usize| {
        // Newton's divided differences: the slope of the parabola at the end.
        let bend = (slope(near, far) - slope(end, near)) / (knots[far] - knots[end]);
        slope(end, near) - bend * (knots[near] - knots[end])
    };
    [at_end(0, 1, 2), at_end(last, last - 1, last - 2)]
}

/// Second derivatives at the knots of the cubic spline through `y` with these slopes at its ends.
fn second_derivatives(knots: &[f64], y: &[f64], slopes: [f64; 2]) -> Vec<f64> {
    let last = y.len() - 1;
    let h = |interval: usize| knots[interval + 1] - knots[interval];
    let slope = |interval: usize| (y[interval + 1] - y[interval]) / h(interval);
    let mut second = vec![0.0; y.len()];
    // The tridiagonal system is eliminated downwards and solved upwards.
    let mut above = vec![0.0; y.len()];
    for row in 0..=last {
        // Rows of the clamped cubic spline: the first and the last say the slope, the others that slopes join.
        let (below, diagonal, right, value) = if row == 0 {
            (0.0, 2.0 * h(0), h(0), slope(0) - slopes[0])
        } else if row == last {
            (h(last - 1), 2.0 * h(last - 1), 0.0, slopes[1] - slope(last - 1))
        } else {
            (h(row - 1), 2.0 * (h(row - 1) + h(row)), h(row), slope(row) - slope(row - 1))
        };
        let (above_before, before) = if row == 0 { (0.0, 0.0) } else { (above[row - 1], second[row - 1]) };
        // Diagonally dominant, so elimination needs no pivoting.
        let pivot = diagonal - below * above_before;
        above[row] = right / pivot;
        second[row] = (6.0 * value - below * before) / pivot;
    }
    for row in (0..last).rev() {
        second[row] -= above[row] * second[row + 1];
    }
    second
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a small tridiagonal system; worst seen 2e-14.
    const ROUNDING: f64 = 1e-11;

    fn at(spline: &JointSpline, parameter: f64) -> [f64; 3] {
        let (mut q, mut first, mut second) = ([0.0], [0.0], [0.0]);
        spline.at(parameter, SplineValues { q: &mut q, first: &mut first, second: &mut second });
        [q[0], first[0], second[0]]
    }

    fn points(values: &[f64]) -> Vec<RobotQ> {
        values.iter().map(|&value| RobotQ::from([value])).collect()
    }

    #[test]
    fn a_parabola_is_itself() {
        let knots = [0.0, 0.5, 1.5, 2.0, 3.5];
        let parabola = |x: f64| 1.0 - 2.0 * x + 3.0 * x * x;
        let spline = JointSpline::new(&knots, &points(&knots.map(parabola)), SplineEnds::Parabola);
        for step in 0..=35 {
            let x = f64::from(step) / 10.0;
            let expected = [parabola(x), -2.0 + 6.0 * x, 6.0];
            for (found, expected) in at(&spline, x).into_iter().zip(expected) {
                assert!((found - expected).abs() < ROUNDING, "{found} for {expected} at {x}");
            }
        }
    }

    #[test]
    fn it_rests_at_its_ends_goes_through_its_points_and_nothing_jumps() {
        let (knots, given) = ([0.0, 1.0, 1.5, 3.0], [0.3, -1.0, 2.0, 0.5]);
        for count in [2, 3, 4] {
            let spline = JointSpline::new(&knots[..count], &points(&given[..count]), SplineEnds::Rest);
            for (x, expected) in knots[..count].iter().zip(given) {
                assert!((at(&spline, *x)[0] - expected).abs() < ROUNDING);
            }
            for end in [0.0, knots[count - 1]] {
                let [_, first, second] = at(&spline, end);
                assert!(first.abs() < ROUNDING && second == 0.0, "{first} {second}");
            }
            for &knot in &spline.knots()[1..spline.knots().len() - 1] {
                let [before, after] = [knot - 1e-9, knot + 1e-9].map(|x| at(&spline, x));
                // 2e-9 times slopes of at most 1e3.
                assert!(before.iter().zip(after).all(|(before, after)| (before - after).abs() < 2e-6));
            }
        }
    }

    #[test]
    fn straight_lines_are_straight() {
        let spline = JointSpline::new(&[0.0, 2.0, 3.0], &points(&[1.0, 3.0, 0.0]), SplineEnds::Straight);
        for (x, expected) in [(0.5, [1.5, 1.0, 0.0]), (2.5, [1.5, -3.0, 0.0]), (9.0, [0.0, -3.0, 0.0])] {
            for (found, expected) in at(&spline, x).into_iter().zip(expected) {
                assert!((found - expected).abs() < ROUNDING, "{found} for {expected} at {x}");
            }
        }
    }
}
