//! Vectors and matrices of three, padded to the width of the machine's vectors: the algebra of the algorithms' loops.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use std::ops::{Add, AddAssign, Index, Mul, Neg, Sub};

use nalgebra::{Matrix3, Vector3};

/// A vector of three; the fourth entry is padding, finite if the three are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PaddedVector([f64; 4]);

impl PaddedVector {
    pub(crate) const ZERO: Self = Self([0.0; 4]);

    #[inline(always)]
    pub(crate) fn new(x: f64, y: f64, z: f64) -> Self {
        Self([x, y, z, 0.0])
    }

    #[inline(always)]
    fn zip(self, other: Self, each: impl Fn(f64, f64) -> f64) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([each(a, e), each(b, f), each(c, g), each(d, h)])
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> f64 {
        let [x, y, z, _] = self.zip(other, |a, b| a * b).0;
        x + y + z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        let next = |v: Self| Self([v.0[1], v.0[2], v.0[0], v.0[3]]);
        // a x b = next(a next(b) - next(a) b): three shuffles instead of four, with all entries in one vector
        // register.
        next(self.zip(next(other), |a, b| a * b) - next(self).zip(other, |a, b| a * b))
    }

    /// Turned about z by the angle with this sine and cosine.
    #[inline(always)]
    pub(crate) fn turned_about_z(self, sin: f64, cos: f64) -> Self {
        let [x, y, z, _] = self.0;
        Self([x * cos - y * sin, y * cos + x * sin, z, 0.0])
    }

    #[inline(always)]
    pub(crate) fn plus_z(self, z: f64) -> Self {
        let [x, y, before, _] = self.0;
        Self([x, y, before + z, 0.0])
    }
}

impl Index<usize> for PaddedVector {
    type Output = f64;

    #[inline(always)]
    fn index(&self, at: usize) -> &f64 {
        &self.0[at]
    }
}

impl Add for PaddedVector {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl AddAssign for PaddedVector {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for PaddedVector {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Neg for PaddedVector {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Mul<f64> for PaddedVector {
    type Output = Self;

    #[inline(always)]
    fn mul(self, by: f64) -> Self {
        self.zip(Self([by; 4]), |a, b| a * b)
    }
}

impl From<Vector3<f64>> for PaddedVector {
    fn from(v: Vector3<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<PaddedVector> for Vector3<f64> {
    fn from(column: PaddedVector) -> Self {
        Self::new(column[0], column[1], column[2])
    }
}

/// A 3 x 3 matrix by its columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block(pub(crate) [PaddedVector; 3]);

impl Block {
    pub(crate) const ZERO: Self = Self([PaddedVector::ZERO; 3]);

    #[inline(always)]
    pub(crate) fn diagonal(value: f64) -> Self {
        Self([
            PaddedVector::new(value, 0.0, 0.0),
            PaddedVector::new(0.0, value, 0.0),
            PaddedVector::new(0.0, 0.0, value),
        ])
    }

    #[inline(always)]
    fn row(&self, at: usize) -> PaddedVector {
        let [x, y, z] = &self.0;
        PaddedVector::new(x[at], y[at], z[at])
    }

    #[inline(always)]
    pub(crate) fn transposed(&self) -> Self {
        Self([self.row(0), self.row(1), self.row(2)])
    }

    /// The matrix product `self * other`.
    #[inline(always)]
    pub(crate) fn times(&self, other: &Self) -> Self {
        let [x, y, z] = other.0;
        Self([*self * x, *self * y, *self * z])
    }

    /// The matrix in the axes of frame a, given in those of frame b: `R M R'`.
    #[inline(always)]
    pub(crate) fn turned(&self, a_from_b: &Self) -> Self {
        a_from_b.times(self).times(&a_from_b.transposed())
    }

    /// Times the matrix of the cross product: `M [p]`.
    #[inline(always)]
    pub(crate) fn times_cross(&self, p: PaddedVector) -> Self {
        let [x, y, z] = self.0;
        Self([y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]])
    }

    /// The matrix of the cross product by a vector, times this one: `[p] M`.
    #[inline(always)]
    pub(crate) fn crossed_by(&self, p: PaddedVector) -> Self {
        let [x, y, z] = self.0;
        Self([p.cross(x), p.cross(y), p.cross(z)])
    }

    /// The matrix of the cross product by a vector: `[v] w = v x w`.
    #[inline(always)]
    pub(crate) fn cross_matrix(v: PaddedVector) -> Self {
        Self([
            PaddedVector::new(0.0, v[2], -v[1]),
            PaddedVector::new(-v[2], 0.0, v[0]),
            PaddedVector::new(v[1], -v[0], 0.0),
        ])
    }

    /// The matrix minus the outer product `a b'`.
    #[inline(always)]
    pub(crate) fn minus_outer(&self, a: PaddedVector, b: PaddedVector) -> Self {
        let [x, y, z] = self.0;
        Self([x - a * b[0], y - a * b[1], z - a * b[2]])
    }
}

impl Mul<PaddedVector> for Block {
    type Output = PaddedVector;

    #[inline(always)]
    fn mul(self, v: PaddedVector) -> PaddedVector {
        let [x, y, z] = self.0;
        x * v[0] + y * v[1] + z * v[2]
    }
}

impl Add for Block {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a + d, b + e, c + f])
    }
}

impl AddAssign for Block {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Block {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([a - d, b - e, c - f])
    }
}

impl From<Matrix3<f64>> for Block {
    fn from(matrix: Matrix3<f64>) -> Self {
        Self([0, 1, 2].map(|at| PaddedVector::from(matrix.column(at).into_owned())))
    }
}
