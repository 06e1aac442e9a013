//! A random order of the numbers below a count: the place of any of them, without a list of all.

/// Rounds of the network; four make it a good order.
///
/// Source: Luby & Rackoff, *How to construct pseudorandom permutations from pseudorandom functions*, SIAM Journal on Computing 17
/// (1988).
const ROUNDS: u64 = 4;

/// The place of `number` in an order of the numbers below `count`, another for each seed.
///
/// A Feistel network permutes the numbers of an even number of bits; one that is not below `count` is permuted again, which ends,
/// since the network goes round in cycles.
///
/// Source: Black & Rogaway, *Ciphers with arbitrary finite domains* (2002), cycle walking.
///
/// # Panics
/// If `number` is not below `count`.
pub(crate) fn permuted(number: u64, count: u64, seed: u64) -> u64 {
    assert!(number < count, "{number} is not below {count}");
    let half_bits = (u64::BITS - (count - 1).leading_zeros()).div_ceil(2).max(1);
    let mut place = number;
    loop {
        place = network(place, half_bits, seed);
        if place < count {
            return place;
        }
    }
}

fn network(number: u64, half_bits: u32, seed: u64) -> u64 {
    let mask = (1_u64 << half_bits) - 1;
    let (mut left, mut right) = (number >> half_bits, number & mask);
    for round in 0..ROUNDS {
        (left, right) = (right, left ^ (mixed(right ^ seed.rotate_left(17) ^ (round << 58)) & mask));
    }
    left << half_bits | right
}

/// A number whose bits all depend on all bits of another.
///
/// Source: Steele, Lea & Flood, *Fast splittable pseudorandom number generators* (2014), the finalizer of `SplitMix64`.
pub(crate) fn mixed(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_a_place_of_its_own() {
        for count in [1, 2, 3, 7, 64, 100, 1000, 4097] {
            let mut seen = vec![false; usize::try_from(count).unwrap()];
            for number in 0..count {
                let place = usize::try_from(permuted(number, count, 42)).unwrap();
                assert!(!std::mem::replace(&mut seen[place], true), "{place} of {count} twice");
            }
        }
    }

    #[test]
    fn seeds_give_other_orders() {
        let order = |seed| (0..50).map(move |number| permuted(number, 50, seed)).collect::<Vec<_>>();
        assert_ne!(order(1), order(2));
        assert_ne!(order(1), (0..50).collect::<Vec<_>>());
    }
}
