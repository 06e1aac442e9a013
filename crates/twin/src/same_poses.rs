//! Whether a robot has moved.

use nalgebra::Isometry3;

/// Whether these are the same poses, to the last bit.
pub(crate) fn are_same(a: &[Isometry3<f64>], b: &[Isometry3<f64>]) -> bool {
    let numbers = |pose: &Isometry3<f64>| {
        let ([x, y, z], [i, j, k, w]): ([f64; 3], [f64; 4]) =
            (pose.translation.vector.into(), pose.rotation.coords.into());
        [x, y, z, i, j, k, w].map(f64::to_bits)
    };
    a.iter().zip(b).all(|(a, b)| numbers(a) == numbers(b))
}
