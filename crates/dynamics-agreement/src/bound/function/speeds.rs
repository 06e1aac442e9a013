//! Bounds of a quadratic form of the joints' speeds over a box.
//!
//! A speed whose square has a positive coefficient is best at an end of its interval; of a negative square the chord
//! over the interval is larger by at most the coefficient times the square of half its width.

/// An interval of one speed, as shares of its limit: `(-1.0, 1.0)` is the whole range.
pub(in crate::bound) type SpeedInterval = (f64, f64);

/// The number of independent entries of a symmetric matrix, and so of products of two speeds.
pub(in crate::bound) fn entries(speeds: usize) -> usize {
    speeds * (speeds + 1) / 2
}

/// Index of row `j` of the upper triangle by rows, such that entry `(j, k)` with `k >= j` is at `row + k`.
#[inline]
pub(in crate::bound) fn row(speeds: usize, j: usize) -> usize {
    j * speeds - j * (j + 1) / 2
}

/// A symmetric form `sum a_jk x_j x_k` over `j <= k`, by rows.
#[derive(Clone, Copy)]
pub(in crate::bound) struct Form<'a> {
    pub(in crate::bound) coefficients: &'a [f64],
    pub(in crate::bound) speeds: usize,
}

/// Bounds of a form over a box, or of a convex combination of such forms.
#[derive(Debug, Clone, Copy)]
pub(in crate::bound) struct FormRange {
    pub(in crate::bound) least: f64,
    pub(in crate::bound) most: f64,
    /// What negative and positive squares may add to these.
    pub(in crate::bound) below: f64,
    pub(in crate::bound) above: f64,
}

/// Most speeds of a form. Kind: speed; its corners double with each.
pub(in crate::bound) const MAX_SPEEDS: usize = 10;

/// The speeds of a form, followed by zeros.
pub(in crate::bound) type Speeds = [f64; MAX_SPEEDS];

impl Form<'_> {
    /// Coefficient of `x_j x_k`: twice the entry of the symmetric matrix, or the entry itself for a square.
    fn coefficient(&self, j: usize, k: usize) -> f64 {
        let (j, k) = (j.min(k), j.max(k));
        self.coefficients[row(self.speeds, j) + k]
    }

    /// Coefficient of the square of speed `j`.
    pub(in crate::bound) fn square(&self, j: usize) -> f64 {
        self.coefficient(j, j)
    }

    /// The value of the form at these speeds.
    pub(in crate::bound) fn at(&self, x: &[f64]) -> f64 {
        let row = |j: usize| (j..self.speeds).map(|k| self.coefficient(j, k) * x[k]).sum::<f64>() * x[j];
        (0..self.speeds).map(row).sum()
    }

    /// The derivative by one speed without its own square.
    fn slope(&self, j: usize, x: &[f64]) -> f64 {
        (0..self.speeds).filter(|k| *k != j).map(|k| self.coefficient(j, k) * x[k]).sum()
    }

    /// Visits the corners of a box with the value of the form, in Gray's order: one speed changes at a time. The form is even,
    /// so half of the corners suffice for a symmetric box.
    fn each_corner(&self, intervals: &[SpeedInterval], mut visit: impl FnMut(f64, &[f64])) {
        let mut x = [0.0; MAX_SPEEDS];
        let mut slopes = [0.0; MAX_SPEEDS];
        // Full rows of fixed length, without squares: the compiler turns the sums below into vector instructions.
        let mut rows = [[0.0; MAX_SPEEDS]; MAX_SPEEDS];
        for (j, row) in rows.iter_mut().enumerate().take(self.speeds) {
            for (k, entry) in row.iter_mut().enumerate().take(self.speeds).filter(|(k, _)| *k != j) {
                *entry = self.coefficient(j, k);
            }
        }
        x.iter_mut().zip(intervals).for_each(|(x, interval)| *x = interval.0);
        for (j, slope) in slopes.iter_mut().enumerate().take(self.speeds) {
            *slope = self.slope(j, &x);
        }
        let mut value = self.at(&x);
        visit(value, &x[..self.speeds]);
        // x and -x give the same value, so with a symmetric box the last speed can stay at its lower end.
        let free = self.speeds - usize::from(self.speeds > 0 && intervals.iter().all(is_symmetric));
        for step in 1..1_usize << free {
            // In Gray's order step k changes the bit of its lowest one: each corner costs one row instead of all.
            let j = step.trailing_zeros() as usize;
            let (lower, upper) = intervals[j];
            let (before, after) = if x[j] > lower { (upper, lower) } else { (lower, upper) };
            let by = after - before;
            // f(x + by e_j) - f(x): the mixed products change by the slope, the own square by the difference of
            // the squares.
            value += by * slopes[j] + self.square(j) * (after * after - before * before);
            x[j] = after;
            slopes.iter_mut().zip(&rows[j]).for_each(|(slope, row)| *slope += row * by);
            visit(value, &x[..self.speeds]);
        }
    }

    /// Bounds of the form over a box: its corners, and how far concave squares may exceed them.
    pub(in crate::bound) fn range(&self, intervals: &[SpeedInterval]) -> FormRange {
        let mut range = FormRange { least: f64::INFINITY, most: f64::NEG_INFINITY, below: 0.0, above: 0.0 };
        self.each_corner(intervals, |value, _| {
            range.least = range.least.min(value);
            range.most = range.most.max(value);
        });
        for (j, interval) in intervals.iter().enumerate() {
            // A positive square is convex, so its largest value is at a corner already; a negative one may exceed
            // the corners by the gap of its chord.
            let gap = gap(interval) * self.square(j);
            range.above += (-gap).max(0.0);
            range.below += gap.max(0.0);
        }
        range
    }

    /// Upper bounds of the form and of its negative over a box, each product bounded by itself: wider, but cheap.
    #[inline]
    pub(in crate::bound) fn rough_range(&self, intervals: &[SpeedInterval]) -> [f64; 2] {
        let mut products = 0.0;
        let (mut up, mut down) = (0.0, 0.0);
        for (j, interval) in intervals.iter().enumerate() {
            let row = &self.coefficients[row(self.speeds, j)..][j..self.speeds];
            products += row[1..].iter().map(|value| value.abs()).sum::<f64>();
            // A positive coefficient adds at most itself, since a square is at most 1; a negative one adds its
            // value at the smaller end, and what its square may exceed the chord by.
            let rest = (gap(interval) - interval.0.abs().min(interval.1.abs()).powi(2)).max(0.0);
            up += row[0].max(-row[0] * rest);
            down += (-row[0]).max(row[0] * rest);
        }
        [up + products, down + products]
    }

    /// The largest value of the form and of its negative that a coordinate search from the best corners finds, each with its
    /// speeds. One that cannot exceed its entry of `least` is that of a corner.
    pub(in crate::bound) fn largest_above(&self, least: [f64; 2]) -> [(f64, Speeds); 2] {
        let mut best = [(0.0, [0.0; MAX_SPEEDS]); 2];
        self.each_corner(&[(-1.0, 1.0); MAX_SPEEDS][..self.speeds], |value, corner| {
            let [up, down] = &mut best;
            if value > up.0 {
                up.0 = value;
                up.1[..corner.len()].copy_from_slice(corner);
            } else if -value > down.0 {
                down.0 = -value;
                down.1[..corner.len()].copy_from_slice(corner);
            }
        });
        // A corner is the maximum if all squares are positive; otherwise a speed inside its interval may be better, by at
        // most the squares that are negative.
        let beyond_corners =
            |sign: f64| (0..self.speeds).map(|j| (-sign * self.square(j)).max(0.0)).sum::<f64>();
        let [up, down] = best;
        [(1.0, up, least[0]), (-1.0, down, least[1])].map(|(sign, (value, speeds), least)| {
            if value + beyond_corners(sign) <= least {
                (value, speeds)
            } else {
                self.local_maximum(sign, value, speeds)
            }
        })
    }

    /// Coordinate search for a larger value of `sign` times the form: each speed in turn is set to its exact optimum.
    fn local_maximum(&self, sign: f64, mut best: f64, mut x: Speeds) -> (f64, Speeds) {
        for _ in 0..ROUNDS {
            let before = best;
            for j in 0..self.speeds {
                let (slope, square) = (sign * self.slope(j, &x), sign * self.square(j));
                // Along one speed the form is a parabola: its vertex is at -slope / (2 square), a maximum only if
                // it opens downwards.
                let top = if square < 0.0 { (-slope / (2.0 * square)).clamp(-1.0, 1.0) } else { 1.0 };
                let gain = |to: f64| (to - x[j]) * slope + square * (to * to - x[j] * x[j]);
                let to = [-1.0, 1.0, top].into_iter().max_by(|a, b| gain(*a).total_cmp(&gain(*b)));
                if let Some(to) = to.filter(|to| gain(*to) > 0.0) {
                    x[j] = to;
                    // Evaluated anew instead of adding the gain: gains of twenty rounds would add up their
                    // rounding.
                    best = sign * self.at(&x);
                }
            }
            if best <= before {
                break;
            }
        }
        (best, x)
    }
}

/// Most rounds over all speeds. Kind: loop bound; two or three suffice.
const ROUNDS: usize = 20;

fn is_symmetric((lower, upper): &SpeedInterval) -> bool {
    (lower + upper).abs() <= 0.0
}

/// The largest distance between `x^2` and its chord over an interval: the square of half its width.
#[inline]
pub(in crate::bound) fn gap((lower, upper): &SpeedInterval) -> f64 {
    let half = (upper - lower) / 2.0;
    half * half
}

#[cfg(test)]
mod tests {
    use super::*;

    const COEFFICIENTS: [f64; 6] = [-0.7, 1.1, -0.4, 0.3, 0.9, -0.2];

    #[test]
    fn a_box_contains_the_form_and_small_boxes_are_tight() {
        let form = Form { coefficients: &COEFFICIENTS, speeds: 3 };
        for (intervals, slack) in
            [([(-1.0, 1.0); 3], 2.0), ([(0.2, 0.7), (-1.0, -0.4), (0.0, 0.1)], 0.2), ([(0.3, 0.31); 3], 1e-3)]
        {
            let range = form.range(&intervals);
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for index in 0..1000_usize {
                let share = [index % 10, index / 10 % 10, index / 100]
                    .map(|at| f64::from(u8::try_from(at).expect("below 22")) / 9.0);
                let x: [f64; 3] =
                    std::array::from_fn(|j| intervals[j].0 + share[j] * (intervals[j].1 - intervals[j].0));
                least = least.min(form.at(&x));
                most = most.max(form.at(&x));
            }
            assert!(range.most + range.above >= most && range.most + range.above < most + slack, "{range:?}");
            assert!(range.least - range.below <= least && range.least - range.below > least - slack);
        }
    }

    #[test]
    fn the_largest_value_is_found() {
        let form = Form { coefficients: &COEFFICIENTS, speeds: 3 };
        for (sign, (best, x)) in [1.0, -1.0].into_iter().zip(form.largest_above([f64::NEG_INFINITY; 2])) {
            assert!((sign * form.at(&x) - best).abs() < 1e-15);
            for index in 0..9261_usize {
                let x = [index % 21, index / 21 % 21, index / 441]
                    .map(|at| f64::from(u8::try_from(at).expect("below 22")) / 10.0 - 1.0);
                assert!(sign * form.at(&x) <= best + 1e-12, "{x:?} {best}");
            }
        }
    }

    #[test]
    fn only_what_cannot_exceed_the_least_is_left_at_a_corner() {
        let form = Form { coefficients: &COEFFICIENTS, speeds: 3 };
        let exact = form.largest_above([f64::NEG_INFINITY; 2]).map(|(value, _)| value);
        for least in [0.5, 0.99, 1.0, 1.01, 2.0].map(|share| exact.map(|value| share * value)) {
            for ((found, _), (exact, least)) in
                form.largest_above(least).into_iter().zip(exact.into_iter().zip(least))
            {
                assert!(found <= exact && (found >= exact || exact <= least), "{found} {exact} {least}");
            }
        }
    }
}
