//! An axis of a picture: the range of numbers, or places of words.

/// Values along an axis, from its first to its last.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PictureAxis {
    low: f64,
    high: f64,
    /// The words, if the values are none of numbers: the place of each is its index.
    words: Vec<String>,
}

impl PictureAxis {
    /// The axis of values as they are written.
    pub(super) fn of_written<'a>(values: impl Iterator<Item = &'a str> + Clone) -> Self {
        let numbers: Option<Vec<f64>> = values.clone().map(|value| value.parse().ok()).collect();
        if let Some(numbers) = numbers {
            return Self::of_numbers(numbers.into_iter());
        }
        let mut words: Vec<String> = values.map(str::to_owned).collect();
        words.sort();
        words.dedup();
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 words")]
        let high = words.len().saturating_sub(1) as f64;
        Self { low: 0.0, high, words }
    }

    pub(super) fn of_numbers(numbers: impl Iterator<Item = f64>) -> Self {
        let (low, high) = numbers
            .filter(|number| number.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
                (low.min(number), high.max(number))
            });
        if low > high {
            Self { low: 0.0, high: 0.0, words: Vec::new() }
        } else {
            Self { low, high, words: Vec::new() }
        }
    }

    /// Where a written value is, from 0 to 1.
    pub(super) fn share_of_written(&self, value: &str) -> Option<f64> {
        if self.words.is_empty() {
            return value.parse().ok().map(|number| self.share(number));
        }
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 words")]
        let place = self.words.iter().position(|word| word == value).map(|place| self.share(place as f64));
        place
    }

    /// Where a number is, from 0 to 1; in the middle if all are the same.
    pub(super) fn share(&self, number: f64) -> f64 {
        if self.high > self.low { (number - self.low) / (self.high - self.low) } else { 0.5 }
    }

    /// The values at both ends.
    pub(super) fn ends(&self) -> [String; 2] {
        match (self.words.first(), self.words.last()) {
            (Some(first), Some(last)) => [first.clone(), last.clone()],
            _ => [self.low, self.high].map(congruent_input::display::number),
        }
    }
}
