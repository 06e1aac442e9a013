//! The scatter of many values by their median, in fixed memory: values far away do not change it.

/// Bins of a factor of 2: 1.09 from one to the next.
const BINS_OF_TWO: f64 = 8.0;
/// Binary logarithm of the smallest value that is distinguished: 1e-12.
const SMALLEST: f64 = -40.0;
const BINS: usize = 480;
/// Values by which the scatter is known: of thirty instants with three components each.
const FEWEST: u64 = 90;
/// The median of the absolute value of a normal distribution, in standard deviations.
const MEDIAN: f64 = 0.6745;

/// Counts of absolute values by their logarithm.
#[derive(Debug, Clone)]
pub(super) struct Scatter {
    counts: Vec<u64>,
    all: u64,
}

impl Default for Scatter {
    fn default() -> Self {
        Self { counts: vec![0; BINS], all: 0 }
    }
}

impl Scatter {
    pub(super) fn take(&mut self, value: f64) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the cast of floats saturates"
        )]
        let bin = ((libm::log2(value.abs()) - SMALLEST) * BINS_OF_TWO) as usize;
        self.counts[bin.min(BINS - 1)] += 1;
        self.all += 1;
    }

    /// The standard deviation of normal values with this median; `None` before there are enough. Rounding is at least the smallest
    /// value.
    pub(super) fn sigma(&self) -> Option<f64> {
        if self.all < FEWEST {
            return None;
        }
        let mut below = 0;
        let median = self.counts.iter().position(|count| {
            below += count;
            2 * below >= self.all
        })?;
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let logarithm = SMALLEST + (median as f64 + 0.5) / BINS_OF_TWO;
        Some(libm::exp2(logarithm) / MEDIAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scatter_is_that_of_most_values() {
        let mut scatter = Scatter::default();
        assert_eq!(scatter.sigma(), None);
        // Evenly between -1 and 1: the median of the absolute value is 0.5.
        (0..1000).for_each(|at| scatter.take(f64::from(at) / 500.0 - 1.0));
        let sigma = scatter.sigma().unwrap();
        assert!((sigma * MEDIAN / 0.5 - 1.0).abs() < 0.1, "{sigma}");
        (0..200).for_each(|_| scatter.take(100.0));
        assert!(scatter.sigma().unwrap() < 1.4 * sigma);
        let mut still = Scatter::default();
        (0..100).for_each(|_| still.take(0.0));
        assert!(still.sigma().unwrap() < 2e-12);
    }
}
