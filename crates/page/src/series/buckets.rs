//! Many values over time in bounded memory: each keeps its smallest and its largest value in spans of samples, and the
//! spans grow with the run.

/// Smallest and largest value of a series in one bucket, and which of them came first.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Extremes {
    low: f32,
    high: f32,
    low_first: bool,
}

impl Extremes {
    fn from_value(value: f32) -> Self {
        Self { low: value, high: value, low_first: true }
    }

    fn include(&mut self, value: f32) {
        if value < self.low {
            (self.low, self.low_first) = (value, false);
        } else if value > self.high {
            (self.high, self.low_first) = (value, true);
        } else if !self.low.is_finite() {
            // NaN compares with nothing, so the first number of a bucket arrives here.
            *self = Self::from_value(value);
        }
    }

    /// Extremes of two consecutive buckets.
    fn then(self, next: Self) -> Self {
        // A bucket of NaN has no extremes: the other one is the result.
        if !self.low.is_finite() || !next.low.is_finite() {
            return if self.low.is_finite() { self } else { next };
        }
        let (low_is_here, high_is_here) = (self.low <= next.low, self.high >= next.high);
        Self {
            low: self.low.min(next.low),
            high: self.high.max(next.high),
            low_first: match (low_is_here, high_is_here) {
                (true, true) => self.low_first,
                (false, false) => next.low_first,
                (low_is_here, _) => low_is_here,
            },
        }
    }
}

/// Series that are sampled together. They allocate nothing after [`Buckets::new`].
#[derive(Debug)]
pub(crate) struct Buckets {
    /// Buckets that each series keeps; an even number.
    most: usize,
    /// Samples of a bucket.
    width: u64,
    /// Samples in the open bucket.
    filled: u64,
    open: Vec<Extremes>,
    starts_s: Vec<f32>,
    /// For each series its closed buckets.
    closed: Vec<Vec<Extremes>>,
    end_s: f32,
}

impl Buckets {
    /// Buckets without samples for this number of series; `most`, at least 2, is the number of buckets of each.
    pub(crate) fn new(series: usize, most: usize) -> Self {
        // Even, since buckets are joined in pairs and none may lack its partner.
        let most = most.max(2).next_multiple_of(2);
        Self {
            most,
            width: 1,
            filled: 0,
            open: vec![Extremes::from_value(f32::NAN); series],
            starts_s: Vec::with_capacity(most),
            closed: (0..series).map(|_| Vec::with_capacity(most)).collect(),
            end_s: 0.0,
        }
    }

    /// Takes one value of each series.
    pub(crate) fn push(&mut self, time_s: f64, values: impl Iterator<Item = f64>) {
        let time_s = single(time_s);
        self.end_s = time_s;
        if self.filled == self.width {
            self.close();
        }
        let each = self.open.iter_mut().zip(values);
        if self.filled == 0 {
            self.starts_s.push(time_s);
            each.for_each(|(open, value)| *open = Extremes::from_value(single(value)));
        } else {
            each.for_each(|(open, value)| open.include(single(value)));
        }
        self.filled += 1;
    }

    /// Ends the open bucket, and joins all in pairs if there are too many.
    fn close(&mut self) {
        if self.filled == 0 {
            return;
        }
        self.filled = 0;
        for (closed, open) in self.closed.iter_mut().zip(&self.open) {
            closed.push(*open);
        }
        if self.starts_s.len() < self.most {
            return;
        }
        // Full: neighbours become one bucket in place, and each later bucket holds twice as many samples. Joining
        // costs a constant time for each sample on average, and memory does not grow.
        self.width *= 2;
        let half = self.most / 2;
        for at in 0..half {
            self.starts_s[at] = self.starts_s[2 * at];
            for closed in &mut self.closed {
                closed[at] = closed[2 * at].then(closed[2 * at + 1]);
            }
        }
        self.starts_s.truncate(half);
        self.closed.iter_mut().for_each(|closed| closed.truncate(half));
    }

    /// Ends the last bucket: no sample follows.
    pub(crate) fn finish(&mut self) {
        self.close();
    }

    /// Whether a bucket is more than one sample, and has two values.
    fn is_joined(&self) -> bool {
        self.width > 1
    }

    /// Times of the values of [`Buckets::values`].
    pub(crate) fn times_s(&self) -> Vec<f32> {
        if !self.is_joined() {
            return self.starts_s.clone();
        }
        // The start and the middle of a bucket: the order of its extremes is known, their times are not.
        let ends = self.starts_s.iter().skip(1).copied().chain(std::iter::once(self.end_s));
        self.starts_s.iter().zip(ends).flat_map(|(&start, end)| [start, f32::midpoint(start, end)]).collect()
    }

    /// The values of one series, in order; of a bucket its two extremes, in the order in which they came.
    pub(crate) fn values(&self, series: usize) -> Vec<f32> {
        let closed = &self.closed[series];
        if !self.is_joined() {
            return closed.iter().map(|bucket| bucket.low).collect();
        }
        let ordered = |bucket: &Extremes| {
            if bucket.low_first { [bucket.low, bucket.high] } else { [bucket.high, bucket.low] }
        };
        closed.iter().flat_map(ordered).collect()
    }

    /// Smallest and largest value of one series; `None` if all its values are NaN.
    pub(crate) fn range(&self, series: usize) -> Option<(f32, f32)> {
        let buckets = self.closed[series].iter().filter(|bucket| bucket.low.is_finite());
        buckets.map(|bucket| (bucket.low, bucket.high)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}

/// Plots need no more digits.
#[expect(clippy::cast_possible_truncation, reason = "a plot shows three digits")]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave that is negative at first, with a spike.
    fn wave(sample: u16) -> f64 {
        if sample == 700 { 50.0 } else { -(f64::from(sample) * 0.01).sin() }
    }

    fn filled(samples: u16, most: usize) -> Buckets {
        let mut buckets = Buckets::new(2, most);
        for sample in 0..samples {
            buckets.push(f64::from(sample) * 1e-3, [wave(sample), f64::from(sample)].into_iter());
        }
        buckets.finish();
        buckets
    }

    #[test]
    fn few_samples_are_kept_as_they_are() {
        let buckets = filled(9, 10);
        assert_eq!(buckets.values(1), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(buckets.times_s().len(), 9);
    }

    #[test]
    fn many_samples_keep_their_extremes_in_order_and_their_number_is_bounded() {
        for samples in [10_u16, 11, 999, 1000, 5003] {
            let buckets = filled(samples, 10);
            let (values, times) = (buckets.values(1), buckets.times_s());
            assert!(values.len() <= 20 && values.len() == times.len(), "{samples}: {}", values.len());
            assert!(values.is_sorted() && times.is_sorted(), "{samples}: {values:?} at {times:?}");
            assert_eq!((values[0], *values.last().unwrap()), (0.0, f32::from(samples - 1)), "{samples}");
            let all: Vec<f64> = (0..samples).map(wave).collect();
            let low = all.iter().copied().fold(f64::INFINITY, f64::min);
            let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(buckets.range(0), Some((single(low), single(high))), "{samples}");
        }
    }

    #[test]
    fn what_is_not_a_number_removes_no_number() {
        let mut buckets = Buckets::new(2, 2);
        for value in [f64::NAN, 2.0, f64::NAN, 1.0, f64::NAN] {
            buckets.push(0.0, [value, f64::NAN].into_iter());
        }
        buckets.finish();
        assert_eq!(buckets.range(0), Some((1.0, 2.0)));
        assert_eq!(buckets.range(1), None);
    }
}
