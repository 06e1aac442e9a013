//! An upper bound of a function of joint positions over a box, by branch and bound.
//!
//! On an arc of half width below a quarter turn, `(1, cos, sin)` is a rational quadratic Bezier curve with positive
//! weights. A function that is affine in them is an average of its control values, so a convex function of it is largest
//! at one of these. Boxes are halved where the control polygon bends most.
//!
//! Source: Farin, *Curves and Surfaces for CAGD* (2002), rational curves; Garloff, *Convergent bounds for the range of
//! multivariate polynomials* (1985).

use congruent_kinematics::best_first::{halves, least_upper_bound};

use super::{
    speeds::SpeedInterval,
    trigonometric::{Trigonometric, Variable, along_into},
};

/// Widest arc with one control point between its ends, in rad. Kind: choice; at 1.6 rad the point lies at 1.44 times the radius.
const WIDEST_ARC_RAD: f64 = 1.6;
/// Rounding of the control values, relative to the largest. No unit; kind: rounding of some thousand products.
const ROUNDING: f64 = 1e-13;

/// The conditions that end a search, whichever is met first.
#[derive(Debug, Clone, Copy)]
pub(in crate::bound) struct SearchLimits {
    /// The bound need not be lower than this.
    pub(in crate::bound) below: f64,
    /// Most boxes that are divided.
    pub(in crate::bound) boxes: usize,
    /// Most control values that are computed.
    pub(in crate::bound) control_values: usize,
}

/// An upper bound, and the number of boxes that were divided for it.
#[derive(Debug, Clone, Copy)]
pub(in crate::bound) struct UpperBound {
    pub(in crate::bound) value: f64,
    pub(in crate::bound) boxes: usize,
}

struct Region {
    ranges: Vec<(f64, f64)>,
    /// Intervals of the speeds, as shares of their limits.
    speeds: Vec<SpeedInterval>,
    upper: f64,
    halved: Halved,
}

/// The dimension along which a box is halved next.
#[derive(Debug, Clone, Copy)]
enum Halved {
    /// The range of a variable.
    Position(usize),
    /// The interval of a speed.
    Speed(usize),
}

/// An upper bound of the measure of a function over the whole range of its variables.
pub(in crate::bound) fn upper_bound(function: &Trigonometric, stop: SearchLimits) -> UpperBound {
    let ranges: Vec<(f64, f64)> =
        function.variables.iter().map(|variable| (variable.lower, variable.upper)).collect();
    let speeds = vec![(-1.0, 1.0); function.measure.speeds()];
    let mut work = Work::default();
    let mut boxes = 0;
    // A constant cannot be divided; its only box is its value.
    let divides = !function.variables.is_empty() || function.measure.speeds() > 0;
    let whole = region(function, (ranges, speeds), &mut work);
    let upper = |region: &Region| region.upper;
    let value = least_upper_bound(whole, upper, |worst| {
        // Stopping early is safe: the bound that is returned holds for whatever boxes are open, it is only wider.
        let done = worst.upper <= stop.below || boxes >= stop.boxes || work.computed >= stop.control_values;
        if done || !divides {
            return None;
        }
        boxes += 1;
        let parts = worst.halves()?.into_iter().map(|half| {
            let part = region(function, half, &mut work);
            // A half lies in the whole, so its bound is at most that of the whole, even if its own control values round higher.
            Region { upper: part.upper.min(worst.upper), ..part }
        });
        Some(parts.collect())
    });
    // The slack of left-out coefficients is added once: it holds at every position.
    UpperBound { value: value + function.slack, boxes }
}

/// Ranges of the variables, intervals of the speeds.
type Ranges = (Vec<(f64, f64)>, Vec<SpeedInterval>);

impl Region {
    /// Both halves; `None` if no floating-point number lies between the ends.
    fn halves(&self) -> Option<Vec<Ranges>> {
        let halved = |ranges: &[(f64, f64)], at: usize| {
            let halves = halves(*ranges.get(at)?)?;
            Some(halves.map(|half| {
                let mut ranges = ranges.to_vec();
                ranges[at] = half;
                ranges
            }))
        };
        match self.halved {
            Halved::Position(at) => {
                let [first, second] = halved(&self.ranges, at)?;
                Some(vec![(first, self.speeds.clone()), (second, self.speeds.clone())])
            }
            Halved::Speed(at) => {
                let [first, second] = halved(&self.speeds, at)?;
                // Reversing all speeds gives the same products, so of a symmetric box one half is enough.
                let is_even = self.speeds.iter().all(|(lower, upper)| (lower + upper).abs() <= 0.0);
                let halves = if is_even { vec![second] } else { vec![first, second] };
                Some(halves.into_iter().map(|speeds| (self.ranges.clone(), speeds)).collect())
            }
        }
    }
}

/// Memory that is used for every region, and how much has been computed.
#[derive(Debug, Default)]
struct Work {
    array: Vec<f64>,
    next: Vec<f64>,
    /// A cheap bound of each control value.
    rough: Vec<f64>,
    computed: usize,
}

fn region(function: &Trigonometric, (ranges, speeds): Ranges, work: &mut Work) -> Region {
    let mut sizes = function.sizes();
    let Work { array, next, rough, computed } = work;
    // Coefficients become control values one variable after the other, as a tensor product of curves does. The last
    // variable first: its inner loop is the shortest, and the array has the fewest entries yet.
    array.clone_from(&function.coefficients);
    for (at, (variable, &(lower, upper))) in function.variables.iter().zip(&ranges).enumerate().rev() {
        let points = control_points(variable, lower, upper);
        along_into(array, &mut sizes, at, &points, next);
        std::mem::swap(array, next);
    }
    // The effort is counted by control values, not by boxes: their number grows exponentially with the variables.
    *computed += array.len();
    let (mut largest, mut loose, mut place) = (0.0, None, 0);
    let values = |at: usize| &array[at * function.values..][..function.values];
    rough.clear();
    rough.extend(
        array.chunks_exact(function.values).map(|values| function.measure.roughly_above(values, &speeds)),
    );
    // The control value with the largest rough bound is evaluated first: it rejects most of the others.
    let first = (0..rough.len()).max_by(|a, b| rough[*a].total_cmp(&rough[*b]));
    for at in first.into_iter().chain(0..rough.len()) {
        // The exact bound visits up to 2^speeds corners of the box of speeds; the rough one is a sum, and rejects
        // most control values.
        if rough[at] <= largest {
            continue;
        }
        let above = function.measure.above(values(at), &speeds);
        if above.value > largest {
            (largest, loose, place) = (above.value, above.loose, at);
        }
    }
    // A variable along which the control values are straight is exact already: halving it would gain nothing.
    let bend = |at: usize| largest_bend(array, &sizes, place, at);
    let width = |at: usize| ranges[at].1 - ranges[at].0;
    let bends = (0..function.variables.len())
        .map(|at| (at, bend(at)))
        // Of equal bends the wider range, so that boxes stay compact.
        .max_by(|a, b| a.1.total_cmp(&b.1).then(width(a.0).total_cmp(&width(b.0))));
    let halved = match (bends, loose) {
        (None, Some((speed, _))) => Halved::Speed(speed),
        // Both are in units of torque: what the bound is loose by if the position, or if the speed, is not
        // divided.
        (Some((_, bend)), Some((speed, by))) if by > bend => Halved::Speed(speed),
        (Some((at, _)), _) => Halved::Position(at),
        (None, None) => Halved::Position(0),
    };
    // Outward, so that rounding of the control values never lowers a bound.
    Region { ranges, speeds, upper: largest * (1.0 + ROUNDING), halved }
}

/// Points whose hull contains the curve over a range, as rows of features.
fn control_points(variable: &Variable, lower: f64, upper: f64) -> Vec<Vec<f64>> {
    if !variable.turns {
        let [first, last] = [lower, upper].map(|q| variable.features(q));
        if variable.degree == 1 {
            return vec![first, last];
        }
        // The blossom of x^2 at the two ends, which is the middle Bezier point of a parabola.
        let between = vec![1.0, f64::midpoint(first[1], last[1]), first[1] * last[1]];
        return vec![first, between, last];
    }
    let width = upper - lower;
    // The middle control point lies at 1 / cos(half) of the circle: beyond two arcs a figure around the whole
    // circle is tighter, and always valid.
    if width > 2.0 * WIDEST_ARC_RAD {
        return around_the_circle(variable.degree);
    }
    let arcs = if width > WIDEST_ARC_RAD { 2_u32 } else { 1 };
    let half = width / f64::from(arcs) / 2.0;
    let mut points = vec![variable.features(lower)];
    for arc in 0..arcs {
        let middle = lower + half * f64::from(2 * arc + 1);
        let [first, last] = [middle - half, middle + half].map(|q| [1.0, libm::cos(q), libm::sin(q)]);
        // Middle control point of the arc with its weight cos(half) first (Farin 2002): the intersection of the
        // end tangents, in homogeneous form.
        let between = [libm::cos(half), libm::cos(middle), libm::sin(middle)];
        if variable.degree == 1 {
            // Where two arcs meet, the point lies between the control points beside it: it is not needed.
            points.push(between.map(|value| value / libm::cos(half)).to_vec());
            continue;
        }
        // The square of a quadratic curve with points P has degree four and the points P0 P0, P0 P1, (P0 P2 + 2
        // P1 P1) / 3, P1 P2, P2 P2; weights multiply along, since they are the first component.
        let [ends, twice] = [product(&first, &last), product(&between, &between)];
        let mixed = std::array::from_fn(|at| ends[at] / 3.0 + twice[at] * 2.0 / 3.0);
        points.extend([product(&first, &between), mixed, product(&between, &last)].map(normalised));
        points.push(normalised(product(&last, &last)));
    }
    if variable.degree == 1 {
        points.push(variable.features(upper));
    }
    points
}

/// The features of second degree `(weight, cos, sin, cos 2q, sin 2q)` of the product of two curves `(weight, cos, sin)`, by
/// the addition theorems.
fn product(u: &[f64; 3], v: &[f64; 3]) -> [f64; 5] {
    [
        u[0] * v[0],
        f64::midpoint(u[0] * v[1], u[1] * v[0]),
        f64::midpoint(u[0] * v[2], u[2] * v[0]),
        u[1] * v[1] - u[2] * v[2],
        u[1] * v[2] + u[2] * v[1],
    ]
}

fn normalised(point: [f64; 5]) -> Vec<f64> {
    point.iter().map(|value| value / point[0]).collect()
}

/// A square around the circle; of second degree the points where all four waves together are largest.
fn around_the_circle(degree: usize) -> Vec<Vec<f64>> {
    if degree == 1 {
        return [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
            .map(|[cos, sin]| vec![1.0, cos, sin])
            .to_vec();
    }
    let radius = 2.0 * std::f64::consts::SQRT_2;
    let point = |index: usize| {
        let mut point = vec![1.0, 0.0, 0.0, 0.0, 0.0];
        point[1 + index / 2] = if index.is_multiple_of(2) { radius } else { -radius };
        point
    };
    (0..8).map(point).collect()
}

/// The largest second difference of the control values along a dimension, on the line through the largest one.
fn largest_bend(array: &[f64], sizes: &[usize], place: usize, at: usize) -> f64 {
    let (&values, sizes) = sizes.split_last().expect("the values are the last dimension");
    // Index of the first control value on the line through `place` along dimension `at`: the array is row-major,
    // so the entry of this dimension is place / after % size.
    let after: usize = sizes[at + 1..].iter().product();
    let start = place - place / after % sizes[at] * after;
    let point = |entry: usize| array[(start + entry * after) * values..][..values].iter();
    let bends = (1..sizes[at].saturating_sub(1)).flat_map(|entry| {
        let three = point(entry - 1).zip(point(entry)).zip(point(entry + 1));
        three.map(|((a, b), c)| (a - 2.0 * b + c).abs())
    });
    bends.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::{super::measure::ValueMeasure, *};

    #[test]
    fn second_degree_closes_as_well() {
        let function = |q: &[f64]| vec![q[0].cos() * q[0].sin() + q[1] * q[1] * q[0].cos(), q[1]];
        let mut variables = vec![Variable::turning(0, -3.0, 3.0), Variable::sliding(1, -0.4, 0.7)];
        for variable in &mut variables {
            variable.degree = 2;
        }
        let found = Trigonometric::sampled(variables, 2, ValueMeasure::Sum, function);
        let grid = (0..400).flat_map(|a| (0..100).map(move |b| [f64::from(a), f64::from(b)]));
        let values = grid.map(|[a, b]| function(&[-3.0 + 6.0 * a / 399.0, -0.4 + 1.1 * b / 99.0]));
        let largest = values.map(|values| ValueMeasure::Sum.value(&values)).fold(0.0, f64::max);
        let stop = SearchLimits { below: largest * 1.005, boxes: 1000, control_values: 1_000_000 };
        let bound = upper_bound(&found, stop);
        assert!(bound.value >= largest && bound.value < largest * 1.01, "{bound:?} for {largest}");
        assert!(bound.boxes < 200, "{bound:?}");
    }

    #[test]
    fn the_bound_closes_on_the_maximum() {
        let function = |q: &[f64]| vec![q[0].cos() + 0.7 * (q[0] + q[1]).sin()];
        let variables = vec![Variable::turning(0, -0.5, 2.0), Variable::turning(1, -3.0, 0.4)];
        let found = Trigonometric::sampled(variables, 1, ValueMeasure::Sum, function);
        let largest = (0..200)
            .flat_map(|a| (0..200).map(move |b| [f64::from(a), f64::from(b)]))
            .map(|[a, b]| function(&[-0.5 + 2.5 * a / 199.0, -3.0 + 3.4 * b / 199.0])[0].abs())
            .fold(0.0, f64::max);
        let stop = SearchLimits { below: largest * 1.005, boxes: 1000, control_values: 1_000_000 };
        let bound = upper_bound(&found, stop);
        assert!(bound.value >= largest && bound.value < largest * 1.01, "{bound:?} for {largest}");
        assert!(bound.boxes < 200, "{bound:?}");
    }
}
