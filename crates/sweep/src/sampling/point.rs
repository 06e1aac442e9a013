//! The point of a case, and its seed.

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

use congruent_scenario::CaseSampling;

use super::{
    permutation::{mixed, permuted},
    sobol::{Sobol, scrambled},
};
/// The largest seed that a scenario takes: TOML has signed numbers.
const SEED_BITS: u64 = i64::MAX.unsigned_abs();

/// Gives each case its point: a share between 0 and 1 for each varied key, without these.
#[derive(Debug, Clone)]
pub(crate) struct PointSource {
    sampling: CaseSampling,
    seed: u64,
    cases: u64,
    /// Number of values of each key on a grid; of each key 1 otherwise.
    steps: Vec<u64>,
    sobol: Sobol,
}

impl PointSource {
    /// `steps` has one entry for each key: its number of values on a grid.
    pub(crate) fn new(sampling: CaseSampling, seed: u64, cases: u64, steps: Vec<u64>) -> Self {
        let dimensions = if sampling == CaseSampling::Sobol { steps.len() } else { 0 };
        Self { sampling, seed, cases, steps, sobol: Sobol::new(dimensions) }
    }

    /// The seed of a case, and its point. One stream of random numbers a case: they depend on the seed of the plan and the number of
    /// the case, and on nothing else.
    pub(crate) fn case(&self, case: u64) -> (u64, Vec<f64>) {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(case);
        let seed = random.next_u64() & SEED_BITS;
        let point = match self.sampling {
            CaseSampling::Grid => self.on_grid(case),
            CaseSampling::Random => self.steps.iter().map(|_| share(random.next_u64())).collect(),
            CaseSampling::LatinHypercube => {
                let of_key = |key: usize, random: &mut ChaCha8Rng| {
                    let place = permuted(case, self.cases, self.key_seed(key));
                    part_of(place, self.cases, share(random.next_u64()))
                };
                (0..self.steps.len()).map(|key| of_key(key, &mut random)).collect()
            }
            CaseSampling::Sobol => (0..self.steps.len()).map(|key| self.sobol_share(case, key)).collect(),
        };
        (seed, point)
    }

    /// The last key changes fastest. On a grid a share says which of the values: 0 the first, 1 the last.
    fn on_grid(&self, case: u64) -> Vec<f64> {
        let mut rest = case;
        let mut point = vec![0.0; self.steps.len()];
        for (share, &steps) in point.iter_mut().zip(&self.steps).rev() {
            #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 values")]
            let at = (rest % steps) as f64 / (steps - 1).max(1) as f64;
            *share = at;
            rest /= steps;
        }
        point
    }

    fn sobol_share(&self, case: u64, key: usize) -> f64 {
        #[expect(clippy::cast_possible_truncation, reason = "a plan has at most 2^32 Sobol points")]
        let coordinate = self.sobol.coordinate(case as u32, key);
        #[expect(clippy::cast_possible_truncation, reason = "half of the bits are as random")]
        let scrambled = scrambled(coordinate, self.key_seed(key) as u32);
        // The middle of the interval that the 32 bits name, so that no share is 0.
        (f64::from(scrambled) + 0.5) / 2_f64.powi(32)
    }

    fn key_seed(&self, key: usize) -> u64 {
        mixed(mixed(self.seed) ^ key as u64)
    }
}

/// 53 random bits as a share, neither 0 nor 1.
#[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
fn share(bits: u64) -> f64 {
    ((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// A share within one of `parts` equal parts.
#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 cases")]
fn part_of(part: u64, parts: u64, within: f64) -> f64 {
    (part as f64 + within) / parts as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_of_a_latin_hypercube_has_one_case() {
        let points = PointSource::new(CaseSampling::LatinHypercube, 3, 50, vec![1, 1]);
        for key in 0..2 {
            let mut parts: Vec<u64> = (0..50)
                .map(|case| {
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 50")]
                    let part = (points.case(case).1[key] * 50.0) as u64;
                    part
                })
                .collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..50).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_grid_has_every_combination() {
        let points = PointSource::new(CaseSampling::Grid, 0, 6, vec![2, 3]);
        let all: Vec<Vec<f64>> = (0..6).map(|case| points.case(case).1).collect();
        assert_eq!(all, [[0.0, 0.0], [0.0, 0.5], [0.0, 1.0], [1.0, 0.0], [1.0, 0.5], [1.0, 1.0]]);
    }

    #[test]
    fn a_case_depends_on_its_number_alone() {
        for sampling in [CaseSampling::Random, CaseSampling::LatinHypercube, CaseSampling::Sobol] {
            let points = PointSource::new(sampling, 11, 1000, vec![1; 5]);
            let later = points.case(999);
            let (seed, point) = points.case(17);
            assert_eq!(points.case(17), (seed, point.clone()));
            assert_ne!(later.0, seed);
            assert!(point.iter().all(|share| *share > 0.0 && *share < 1.0));
        }
    }
}
