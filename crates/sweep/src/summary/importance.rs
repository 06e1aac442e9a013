//! Which varied value decides a quantity: the share of its variance that follows from that value alone.

use congruent_results::report::KeyImportance;
use congruent_scenario::CaseSampling;

/// Groups of cases that are left out in turn, for the uncertainty. Kind: choice.
const GROUPS: usize = 20;
/// Most intervals of a value. Kind: choice; more show finer curves and need more cases.
const MOST_INTERVALS: usize = 24;
/// Fewest cases of an interval. Kind: choice.
const FEWEST_IN_INTERVAL: usize = 8;
/// Fewest cases from which shares are computed.
const FEWEST: usize = 2 * GROUPS;
/// Standard deviations on both sides of 95 % of a normal distribution.
const SIGMAS_95: f64 = 1.96;

/// Sums of the quantity over some cases.
#[derive(Debug, Clone, Copy, Default)]
struct GroupSums {
    count: f64,
    sum: f64,
    squares: f64,
}

impl GroupSums {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        self.sum += value;
        self.squares += value * value;
    }

    fn plus(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            sum: self.sum + other.sum,
            squares: self.squares + other.squares,
        }
    }

    fn minus(self, other: Self) -> Self {
        Self {
            count: self.count - other.count,
            sum: self.sum - other.sum,
            squares: self.squares - other.squares,
        }
    }

    /// Sum of the squared distances from the mean.
    fn about_mean(self) -> f64 {
        if self.count > 0.0 { (self.squares - self.sum * self.sum / self.count).max(0.0) } else { 0.0 }
    }
}

/// The importance of a key for a quantity, from the values of both in all cases; `None` if there are too few cases, or one of the
/// two does not vary.
///
/// Cases are sorted by the value of the key and cut into intervals of equal count; what varies between the means of the intervals
/// follows from the value. The part of it that chance alone gives is subtracted, except for Sobol points, which are spread so evenly
/// within the intervals that it is near nothing. The uncertainty is that of estimates without each
/// of some groups of cases.
///
/// Source: Plischke, Borgonovo & Smith, *Global sensitivity measures from given data*, European Journal of Operational Research 226
/// (2013), for the intervals; Efron & Tibshirani, *An Introduction to the Bootstrap* (1993), eq. 11.5, for the groups.
///
/// # Panics
/// If the two have different lengths.
pub fn importance(
    key: &str,
    values: &[f64],
    quantity: &[f64],
    sampling: CaseSampling,
) -> Option<KeyImportance> {
    assert_eq!(values.len(), quantity.len(), "one quantity for each value");
    let mut order: Vec<usize> =
        (0..values.len()).filter(|&at| values[at].is_finite() && quantity[at].is_finite()).collect();
    if order.len() < FEWEST {
        return None;
    }
    // About the mean, so that squares of large values have digits left.
    let mean = mean(order.iter().map(|&at| quantity[at]));
    // A stable sort: cases with one value stay in their order, which is that of their numbers.
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let intervals = intervals(&order, values);
    let mut sums = vec![[GroupSums::default(); GROUPS]; intervals.len()];
    for (sums, interval) in sums.iter_mut().zip(&intervals) {
        interval.iter().for_each(|&at| sums[at % GROUPS].add(quantity[at] - mean));
    }
    let share_without = |group: Option<usize>| share(&sums, group, sampling);
    let share = share_without(None)?;
    let without: Vec<f64> = (0..GROUPS).filter_map(|group| share_without(Some(group))).collect();
    let middle = self::mean(without.iter().copied());
    #[expect(clippy::cast_precision_loss, reason = "a few groups")]
    let groups = without.len() as f64;
    let spread: f64 = without.iter().map(|each| (each - middle).powi(2)).sum();
    let deviation = ((groups - 1.0) / groups * spread).sqrt();
    Some(KeyImportance {
        key: key.to_owned(),
        share,
        interval: [share - SIGMAS_95 * deviation, share + SIGMAS_95 * deviation],
        rank_correlation: rank_correlation(&order, values, quantity),
    })
}

/// The sorted cases, cut into intervals of nearly equal count; cases with one value are not cut apart.
fn intervals<'a>(order: &'a [usize], values: &[f64]) -> Vec<&'a [usize]> {
    let wanted = (order.len() / FEWEST_IN_INTERVAL).clamp(2, MOST_INTERVALS);
    let least = order.len().div_ceil(wanted);
    let (mut cut, mut first) = (Vec::new(), 0);
    for end in 1..=order.len() {
        let is_new_value = end == order.len() || values[order[end]] > values[order[end - 1]];
        let is_full = end - first >= least || is_few_values(order, values, wanted);
        if is_new_value && (is_full || end == order.len()) {
            cut.push(&order[first..end]);
            first = end;
        }
    }
    cut
}

/// Whether there are no more values than intervals, as of a list or a grid: then each is an interval.
fn is_few_values(order: &[usize], values: &[f64], intervals: usize) -> bool {
    let changes = order.windows(2).filter(|pair| values[pair[1]] > values[pair[0]]);
    changes.take(intervals).count() < intervals
}

/// The share of the variance between intervals, without the cases of one group.
fn share(intervals: &[[GroupSums; GROUPS]], without: Option<usize>, sampling: CaseSampling) -> Option<f64> {
    let of_interval = |groups: &[GroupSums; GROUPS]| {
        let all = groups.iter().fold(GroupSums::default(), |sum, group| sum.plus(*group));
        without.map_or(all, |group| all.minus(groups[group]))
    };
    let sums: Vec<GroupSums> = intervals.iter().map(of_interval).filter(|sum| sum.count > 0.0).collect();
    let all = sums.iter().fold(GroupSums::default(), |sum, each| sum.plus(*each));
    #[expect(clippy::cast_precision_loss, reason = "a few intervals")]
    let freedom = all.count - sums.len() as f64;
    let (within, total) = (sums.iter().map(|sum| sum.about_mean()).sum::<f64>(), all.about_mean());
    let is_varying = sums.len() > 1 && freedom > 0.0 && total > 1e-24 * all.squares.max(f64::MIN_POSITIVE);
    let chance = if sampling == CaseSampling::Sobol { 1.0 } else { (all.count - 1.0) / freedom };
    is_varying.then(|| 1.0 - within / total * chance)
}

/// Correlation of the ranks of value and quantity. Source: Spearman (1904); cases with one value share their mean rank.
fn rank_correlation(order: &[usize], values: &[f64], quantity: &[f64]) -> f64 {
    let mut by_quantity = order.to_vec();
    by_quantity.sort_by(|&a, &b| quantity[a].total_cmp(&quantity[b]));
    let (of_value, of_quantity) = (ranks(order, values), ranks(&by_quantity, quantity));
    let pairs = || order.iter().map(|&at| (of_value[at], of_quantity[at]));
    let (mean_value, mean_quantity) = (mean(pairs().map(|pair| pair.0)), mean(pairs().map(|pair| pair.1)));
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
        pairs().map(|(value, quantity)| of(value - mean_value, quantity - mean_quantity)).sum()
    };
    let scale = (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt();
    if scale > 0.0 { sum(&|a, b| a * b) / scale } else { 0.0 }
}

/// The rank of each case, by its index.
#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 cases")]
fn ranks(sorted: &[usize], values: &[f64]) -> Vec<f64> {
    let mut ranks = vec![0.0; values.len()];
    let mut first = 0;
    while first < sorted.len() {
        let is_same = |&&at: &&usize| values[at].total_cmp(&values[sorted[first]]).is_eq();
        let count = sorted[first..].iter().take_while(is_same).count();
        let rank = first as f64 + (count - 1) as f64 / 2.0;
        sorted[first..first + count].iter().for_each(|&at| ranks[at] = rank);
        first += count;
    }
    ranks
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
    if count > 0.0 { sum / count } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::PointSource;

    /// The Ishigami function, whose indices are known: 0.3139, 0.4424 and 0.
    ///
    /// Source: Saltelli et al., *Global Sensitivity Analysis: The Primer* (2008), section 4.
    #[test]
    fn shares_of_a_known_function() {
        let points = PointSource::new(CaseSampling::LatinHypercube, 5, 8000, vec![1; 3]);
        let inputs: Vec<Vec<f64>> = (0..8000)
            .map(|case| {
                let shares = points.case(case).1;
                shares.iter().map(|share| std::f64::consts::PI * (2.0 * share - 1.0)).collect()
            })
            .collect();
        let quantity: Vec<f64> = inputs
            .iter()
            .map(|x| libm::sin(x[0]) + 7.0 * libm::sin(x[1]).powi(2) + 0.1 * x[2].powi(4) * libm::sin(x[0]))
            .collect();
        for (at, known) in [(0, 0.3139), (1, 0.4424), (2, 0.0)] {
            let values: Vec<f64> = inputs.iter().map(|x| x[at]).collect();
            let found = importance("x", &values, &quantity, CaseSampling::LatinHypercube).unwrap();
            assert!((found.share - known).abs() < 0.02, "{at}: {found:?}");
            let [from, to] = found.interval;
            assert!(from - 0.015 < known && known < to + 0.015, "{at}: {found:?}");
            assert!(to - from < 0.08, "{at}: {found:?}");
        }
    }

    /// A sum of four numbers with shares of 16, 9, 4 and 1 in 30: the mean of several plans is right also for Sobol points.
    #[test]
    fn shares_of_a_sum_for_every_sampling() {
        for sampling in [CaseSampling::Random, CaseSampling::LatinHypercube, CaseSampling::Sobol] {
            let mut sums = [0.0; 4];
            for seed in 0..20 {
                let points = PointSource::new(sampling, seed, 256, vec![1; 4]);
                let inputs: Vec<Vec<f64>> = (0..256).map(|case| points.case(case).1).collect();
                let quantity: Vec<f64> =
                    inputs.iter().map(|x| 4.0 * x[0] + 3.0 * x[1] + 2.0 * x[2] + x[3]).collect();
                for (at, sum) in sums.iter_mut().enumerate() {
                    let values: Vec<f64> = inputs.iter().map(|x| x[at]).collect();
                    *sum += importance("x", &values, &quantity, sampling).unwrap().share / 20.0;
                }
            }
            for (found, known) in sums.into_iter().zip([16.0, 9.0, 4.0, 1.0]) {
                assert!((found - known / 30.0).abs() < 0.03, "{sampling:?}: {sums:?}");
            }
        }
    }

    #[test]
    fn a_value_that_decides_everything_and_one_that_decides_nothing() {
        let points = PointSource::new(CaseSampling::Random, 5, 400, vec![1; 2]);
        let inputs: Vec<Vec<f64>> = (0..400).map(|case| points.case(case).1).collect();
        let column = |at: usize| -> Vec<f64> { inputs.iter().map(|x| x[at]).collect() };
        let quantity: Vec<f64> = column(0).iter().map(|x| -3.0 * x).collect();
        let decides = importance("a", &column(0), &quantity, CaseSampling::Random).unwrap();
        assert!(decides.share > 0.98 && decides.rank_correlation < -0.999, "{decides:?}");
        let other = importance("b", &column(1), &quantity, CaseSampling::Random).unwrap();
        assert!(other.share.abs() < 0.1 && other.interval[0] < 0.0, "{other:?}");
        assert_eq!(importance("c", &vec![1.0; 400], &quantity, CaseSampling::Random), None);
        assert_eq!(importance("d", &column(0), &vec![1.0; 400], CaseSampling::Random), None);
        assert_eq!(importance("e", &column(0)[..10], &quantity[..10], CaseSampling::Random), None);
    }
}
