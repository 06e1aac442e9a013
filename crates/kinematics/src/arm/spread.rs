//! Fixed configurations that are spread over the ranges of an arm: for scales and ranks that belong to the arm
//! and not to a draw.

use congruent_description::ArmQ;

/// `count` configurations: position `j` of configuration `k` is at the part `frac(k sqrt(p_j))` of its range, `p_j`
/// the j-th prime, so that no two joints move alike.
///
/// Source: Niederreiter, *Random Number Generation and Quasi-Monte Carlo Methods* (1992), section 3.1: the
/// Kronecker sequence.
pub(super) fn spread(ranges: &[(f64, f64)], count: u32) -> Vec<ArmQ> {
    let primes = primes(ranges.len());
    let configuration = |k: u32| {
        let position = |(&(lower, upper), &prime): (&(f64, f64), &u32)| {
            lower + (upper - lower) * (f64::from(k) * f64::from(prime).sqrt()).fract()
        };
        ranges.iter().zip(&primes).map(position).collect()
    };
    (1..=count).map(configuration).collect()
}

fn primes(count: usize) -> Vec<u32> {
    let mut primes: Vec<u32> = Vec::with_capacity(count);
    // Trial division: arms have few joints, and each prime is used once.
    let mut candidate = 2;
    while primes.len() < count {
        if primes.iter().all(|prime| candidate % prime != 0) {
            primes.push(candidate);
        }
        candidate += 1;
    }
    primes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_primes() {
        assert_eq!(primes(8), [2, 3, 5, 7, 11, 13, 17, 19]);
    }
}
