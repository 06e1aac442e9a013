//! Sobol points with a scramble: any of them by its index.

/// Primitive polynomials and first direction numbers of the dimensions from the second on; the first is the van der Corput sequence.
/// The highest bit of a polynomial is its degree.
///
/// Source: Joe & Kuo, *Constructing Sobol sequences with better two-dimensional projections*, SIAM Journal on Scientific Computing 30
/// (2008), file `new-joe-kuo-6.21201`.
const DIRECTIONS: [(u32, &[u32]); 39] = [
    (3, &[1]),
    (7, &[1, 3]),
    (11, &[1, 3, 1]),
    (13, &[1, 1, 1]),
    (19, &[1, 1, 3, 3]),
    (25, &[1, 3, 5, 13]),
    (37, &[1, 1, 5, 5, 17]),
    (41, &[1, 1, 5, 5, 5]),
    (47, &[1, 1, 7, 11, 19]),
    (55, &[1, 1, 5, 1, 1]),
    (59, &[1, 1, 1, 3, 11]),
    (61, &[1, 3, 5, 5, 31]),
    (67, &[1, 3, 3, 9, 7, 49]),
    (91, &[1, 1, 1, 15, 21, 21]),
    (97, &[1, 3, 1, 13, 27, 49]),
    (103, &[1, 1, 1, 15, 7, 5]),
    (109, &[1, 3, 1, 15, 13, 25]),
    (115, &[1, 1, 5, 5, 19, 61]),
    (131, &[1, 3, 7, 11, 23, 15, 103]),
    (137, &[1, 3, 7, 13, 13, 15, 69]),
    (143, &[1, 1, 3, 13, 7, 35, 63]),
    (145, &[1, 3, 5, 9, 1, 25, 53]),
    (157, &[1, 3, 1, 13, 9, 35, 107]),
    (167, &[1, 3, 1, 5, 27, 61, 31]),
    (171, &[1, 1, 5, 11, 19, 41, 61]),
    (185, &[1, 3, 5, 3, 3, 13, 69]),
    (191, &[1, 1, 7, 13, 1, 19, 1]),
    (193, &[1, 3, 7, 5, 13, 19, 59]),
    (203, &[1, 1, 3, 9, 25, 29, 41]),
    (211, &[1, 3, 5, 13, 23, 1, 55]),
    (213, &[1, 3, 7, 3, 13, 59, 17]),
    (229, &[1, 3, 1, 3, 5, 53, 69]),
    (239, &[1, 1, 5, 5, 23, 33, 13]),
    (241, &[1, 1, 7, 7, 1, 61, 123]),
    (247, &[1, 1, 7, 9, 13, 61, 49]),
    (253, &[1, 3, 3, 5, 3, 55, 33]),
    (285, &[1, 3, 1, 15, 31, 13, 49, 245]),
    (299, &[1, 3, 5, 15, 31, 59, 63, 97]),
    (301, &[1, 3, 1, 11, 11, 11, 77, 249]),
];

/// Most dimensions that the table has.
pub(crate) const MOST_DIMENSIONS: usize = DIRECTIONS.len() + 1;
/// Bits of a coordinate, and of an index: most points are two to this power.
const BITS: usize = 32;

/// The Sobol sequence of some dimensions: coordinates are whole numbers, of 2^32 shares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Sobol {
    /// Direction numbers of each dimension, one for each bit of the index.
    directions: Vec<[u32; BITS]>,
}

impl Sobol {
    /// # Panics
    /// If there are more dimensions than [`MOST_DIMENSIONS`].
    pub(crate) fn new(dimensions: usize) -> Self {
        Self { directions: (0..dimensions).map(directions).collect() }
    }

    /// Coordinate `dimension` of the point, without a scramble: the bits of the index choose the direction numbers that are added
    /// without carry.
    pub(crate) fn coordinate(&self, index: u32, dimension: usize) -> u32 {
        let directions = self.directions[dimension].iter().enumerate();
        directions.fold(0, |sum, (bit, direction)| if index >> bit & 1 == 1 { sum ^ direction } else { sum })
    }
}

/// The direction numbers of a dimension, each shifted to its bit.
///
/// Source: Bratley & Fox, *Algorithm 659*, ACM Transactions on Mathematical Software 14 (1988), eq. 1 to 3.
fn directions(dimension: usize) -> [u32; BITS] {
    let mut shifted = [0; BITS];
    let Some(before) = dimension.checked_sub(1) else {
        shifted.iter_mut().enumerate().for_each(|(bit, direction)| *direction = 1 << (BITS - 1 - bit));
        return shifted;
    };
    let (polynomial, first) = DIRECTIONS[before];
    let degree = first.len();
    for bit in 0..BITS {
        shifted[bit] = if bit < degree {
            first[bit] << (BITS - 1 - bit)
        } else {
            // The coefficients of the polynomial between its highest and its last one.
            let mut direction = shifted[bit - degree] ^ (shifted[bit - degree] >> degree);
            for term in 1..degree {
                if polynomial >> (degree - term) & 1 == 1 {
                    direction ^= shifted[bit - term];
                }
            }
            direction
        };
    }
    shifted
}

/// A coordinate with a scramble that keeps the even spread of the points, another for each seed.
///
/// Source: Burley, *Practical hash-based Owen scrambling*, Journal of Computer Graphics Techniques 9 (2020), listing 3, after Laine
/// & Karras.
pub(crate) fn scrambled(coordinate: u32, seed: u32) -> u32 {
    let mut x = coordinate.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points 5 and 7 of `scipy.stats.qmc.Sobol(d=40, scramble=False, bits=32)` (`SciPy` 1.17.1), which counts in Gray code.
    #[test]
    fn points_are_those_of_another_program() {
        let sobol = Sobol::new(MOST_DIMENSIONS);
        let share = |index: u32, dimension| {
            f64::from(sobol.coordinate(index ^ (index >> 1), dimension)) / 2_f64.powi(32)
        };
        let fifth: Vec<f64> = (0..8).map(|dimension| share(5, dimension)).collect();
        assert_eq!(fifth, [0.875, 0.875, 0.125, 0.375, 0.875, 0.625, 0.875, 0.375]);
        let seventh: Vec<f64> = (30..40).map(|dimension| share(7, dimension)).collect();
        assert_eq!(seventh, [0.625, 0.875, 0.125, 0.625, 0.875, 0.875, 0.375, 0.125, 0.625, 0.125]);
    }

    /// Each of 2^k equal intervals has one of the first 2^k points, in every dimension, also with a scramble.
    #[test]
    fn intervals_have_one_point_each() {
        let sobol = Sobol::new(MOST_DIMENSIONS);
        for dimension in 0..MOST_DIMENSIONS {
            for seed in [None, Some(1), Some(0xdead_beef)] {
                let mut seen = vec![false; 1024];
                for index in 0..1024 {
                    let coordinate = sobol.coordinate(index, dimension);
                    let coordinate = seed.map_or(coordinate, |seed| scrambled(coordinate, seed));
                    let interval = (coordinate >> 22) as usize;
                    assert!(!std::mem::replace(&mut seen[interval], true), "dimension {dimension}");
                }
            }
        }
    }
}
