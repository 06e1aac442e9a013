//! The longest sum of vectors of which each is taken with a factor from -1 to 1: from above by directions that cover the
//! sphere, from below by a sum that is attained.

use nalgebra::Vector3;

/// Cells along the edge of a face of the cube.
const CELLS: u32 = 24;

/// A sum that is attained.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AttainedSum {
    /// -1 or 1 for each vector.
    pub(crate) signs: Vec<f64>,
    /// Its length.
    pub(crate) length: f64,
}

/// Directions that cover half of the sphere: each direction or its opposite is near one of them.
#[derive(Debug, Clone)]
pub(crate) struct CoveringDirections(Vec<Vector3<f64>>);

impl CoveringDirections {
    /// The centres of the cells of three faces of a cube.
    pub(crate) fn new() -> Self {
        let centre = |cell: u32| (2.0 * f64::from(cell) + 1.0) / f64::from(CELLS) - 1.0;
        let mut directions = Vec::new();
        for axis in 0..3 {
            for row in 0..CELLS {
                for column in 0..CELLS {
                    let mut direction = Vector3::zeros();
                    direction[axis] = 1.0;
                    direction[(axis + 1) % 3] = centre(row);
                    direction[(axis + 2) % 3] = centre(column);
                    directions.push(direction.normalize());
                }
            }
        }
        Self(directions)
    }

    /// No sum is longer.
    ///
    /// The longest sum `v` has the length of its projection on a direction near it over the cosine of the angle between, and no
    /// projection of a sum on `u` is more than `sum |u . g|`. Two points of a face that are `h` apart are, projected on the
    /// sphere, no more than `h` apart, so the cosine is at least `1 - h^2 / 2`; within a cell `h` is half of its diagonal.
    pub(crate) fn longest_at_most(&self, vectors: &[Vector3<f64>]) -> f64 {
        let half_diagonal_squared = 2.0 / f64::from(CELLS * CELLS);
        let projected = |u: &Vector3<f64>| vectors.iter().map(|vector| u.dot(vector).abs()).sum::<f64>();
        let largest = self.0.iter().map(projected).fold(0.0, f64::max);
        let all: f64 = vectors.iter().map(Vector3::norm).sum();
        (largest / (1.0 - half_diagonal_squared / 2.0)).min(all)
    }
}

/// A long sum: from a few directions the signs that make the projection largest, then along that sum, until it grows no more.
pub(crate) fn long_sum(vectors: &[Vector3<f64>]) -> AttainedSum {
    /// Axes, edges and corners of half of a cube.
    const STARTS: [[f64; 3]; 13] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 0.0, 1.0],
        [1.0, 0.0, -1.0],
        [0.0, 1.0, 1.0],
        [0.0, 1.0, -1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, -1.0],
    ];
    /// Each step changes a sign and lengthens the sum, so that it ends; some five steps are usual.
    const MOST_STEPS: usize = 50;
    let along = |direction: Vector3<f64>| {
        let sign = |vector: &Vector3<f64>| if vector.dot(&direction) < 0.0 { -1.0 } else { 1.0 };
        vectors.iter().fold(Vector3::zeros(), |sum, vector| sum + vector * sign(vector))
    };
    let from = |start: [f64; 3]| {
        let mut sum = along(Vector3::from(start));
        for _ in 0..MOST_STEPS {
            let next = along(sum);
            if next.norm() <= sum.norm() {
                break;
            }
            sum = next;
        }
        sum
    };
    let best = STARTS.into_iter().map(from).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let best = best.unwrap_or_else(Vector3::zeros);
    let sign = |vector: &Vector3<f64>| if vector.dot(&best) < 0.0 { -1.0 } else { 1.0 };
    AttainedSum { signs: vectors.iter().map(sign).collect(), length: best.norm() }
}

#[cfg(test)]
mod tests {
    use congruent_kinematics::Uniform;

    use super::*;

    /// Length of the sum of vectors, each with the sign that its bit says.
    fn signed_sum(vectors: &[Vector3<f64>], signs: usize) -> f64 {
        let signed = |(at, vector): (usize, &Vector3<f64>)| {
            if signs >> at & 1 == 0 { *vector } else { -vector }
        };
        vectors.iter().enumerate().map(signed).sum::<Vector3<f64>>().norm()
    }

    /// All sums of a few vectors are enumerated: the longest is between both ends, and the bound is tight.
    #[test]
    fn the_longest_of_all_sums_is_between() {
        let directions = CoveringDirections::new();
        let mut random = Uniform::seeded(3);
        for count in 1..10_usize {
            for flat in [1.0, 0.0] {
                let mut vector = || Vector3::from_fn(|_, _| random.between(-1.0, 1.0));
                let mut vectors: Vec<Vector3<f64>> = (0..count).map(|_| vector()).collect();
                for vector in &mut vectors {
                    vector.z *= flat;
                }
                let longest = (0..1 << count).map(|signs| signed_sum(&vectors, signs)).fold(0.0, f64::max);
                let (above, below) = (directions.longest_at_most(&vectors), long_sum(&vectors).length);
                assert!(longest <= above && above <= longest * 1.002, "{longest} {above}");
                assert!(below <= longest * (1.0 + 1e-12) && below > 0.97 * longest, "{longest} {below}");
            }
        }
    }
}
