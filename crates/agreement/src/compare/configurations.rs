//! The configurations of a check: those of every robot, then those that were requested.

use congruent_description::{RobotQ, RobotQList};

/// Requested configurations at which causes are judged, at most. Kind: choice.
const MOST_DIAGNOSED: usize = 1000;

/// The configurations of a check; requested ones may be many, and are not copied.
pub(super) struct CheckConfigurations<'a> {
    pub(super) sampled: Vec<RobotQ>,
    pub(super) requested: &'a RobotQList,
}

impl CheckConfigurations<'_> {
    pub(super) fn len(&self) -> usize {
        self.sampled.len() + self.requested.len()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = RobotQ> + '_ {
        self.sampled.iter().cloned().chain(self.requested.iter())
    }

    /// The configuration with this index in [`CheckConfigurations::iter`].
    pub(super) fn at(&self, index: usize) -> RobotQ {
        let sampled = self.sampled.get(index).cloned();
        let requested = || self.requested.get(index - self.sampled.len());
        sampled.or_else(requested).expect("the index of a configuration")
    }

    /// Those at which causes are judged: of requested ones the worst, and so few that the time to find a cause does not
    /// grow with their number.
    pub(super) fn diagnosed(&self, worst: impl Iterator<Item = usize>) -> Vec<RobotQ> {
        let step = self.requested.len().div_ceil(MOST_DIAGNOSED).max(1);
        // Every so many-th, and the worst ones in addition: a fault that shows at few configurations is not missed.
        let evenly = (self.sampled.len()..self.len()).step_by(step);
        let requested = evenly.chain(worst).map(|index| self.at(index));
        self.sampled.iter().cloned().chain(requested).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_are_judged_at_few_of_many_and_at_the_worst() {
        let mut requested = RobotQList::new(1);
        (0..2500).for_each(|index| requested.push(&[f64::from(index)]));
        let all = CheckConfigurations { sampled: vec![[-1.0].into()], requested: &requested };
        assert_eq!((all.len(), all.iter().nth(2500)), (2501, Some([2499.0].into())));
        let diagnosed = all.diagnosed([2500].into_iter());
        assert_eq!(diagnosed[..3], [[-1.0].into(), [0.0].into(), [3.0].into()]);
        assert_eq!((diagnosed.len(), diagnosed.last()), (1 + 834 + 1, Some(&[2499.0].into())));
    }
}
