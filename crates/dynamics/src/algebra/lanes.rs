//! Vectors of three for several samples side by side, entry by entry, for the batch of inverse dynamics.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use std::ops::{Add, Sub};

use nalgebra::{Matrix3, Vector3};

/// Samples side by side: two vectors of AVX2, enough to hide the latency of a sum.
pub(crate) const LANES: usize = 8;

/// One number of each sample.
pub(crate) type Lanes = [f64; LANES];

/// A vector of each sample: its entries x, y, z.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LaneVector(pub(crate) [Lanes; 3]);

#[inline(always)]
pub(crate) fn lanes(each: impl Fn(usize) -> f64) -> Lanes {
    let mut all = [0.0; LANES];
    for (lane, number) in all.iter_mut().enumerate() {
        *number = each(lane);
    }
    all
}

impl LaneVector {
    pub(crate) const ZERO: Self = Self([[0.0; LANES]; 3]);

    /// The same for all samples.
    #[inline(always)]
    pub(crate) fn splat(v: &Vector3<f64>) -> Self {
        Self([[v.x; LANES], [v.y; LANES], [v.z; LANES]])
    }

    #[inline(always)]
    fn each(entry: impl Fn(usize, usize) -> f64) -> Self {
        Self([lanes(|lane| entry(0, lane)), lanes(|lane| entry(1, lane)), lanes(|lane| entry(2, lane))])
    }

    #[inline(always)]
    pub(crate) fn times(&self, factor: f64) -> Self {
        Self::each(|entry, lane| self.0[entry][lane] * factor)
    }

    #[inline(always)]
    pub(crate) fn cross(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Self::each(|entry, lane| {
            // In cyclic order one formula serves all three entries.
            let (next, last) = ((entry + 1) % 3, (entry + 2) % 3);
            a[next][lane] * b[last][lane] - a[last][lane] * b[next][lane]
        })
    }

    /// Multiplied from the left by one matrix for all samples.
    #[inline(always)]
    pub(crate) fn turned_by(&self, matrix: &Matrix3<f64>) -> Self {
        let v = &self.0;
        Self::each(|row, lane| {
            matrix[(row, 0)] * v[0][lane] + matrix[(row, 1)] * v[1][lane] + matrix[(row, 2)] * v[2][lane]
        })
    }

    /// Multiplied from the left by the transpose of one matrix for all samples.
    #[inline(always)]
    pub(crate) fn turned_back_by(&self, matrix: &Matrix3<f64>) -> Self {
        let v = &self.0;
        Self::each(|row, lane| {
            matrix[(0, row)] * v[0][lane] + matrix[(1, row)] * v[1][lane] + matrix[(2, row)] * v[2][lane]
        })
    }

    /// Turned about z by the angles with these sines and cosines.
    #[inline(always)]
    pub(crate) fn turned_about_z(&self, sin: &Lanes, cos: &Lanes) -> Self {
        let [x, y, z] = &self.0;
        Self([
            lanes(|lane| x[lane] * cos[lane] - y[lane] * sin[lane]),
            lanes(|lane| y[lane] * cos[lane] + x[lane] * sin[lane]),
            *z,
        ])
    }

    /// Turned back about z.
    #[inline(always)]
    pub(crate) fn turned_back_about_z(&self, sin: &Lanes, cos: &Lanes) -> Self {
        let [x, y, z] = &self.0;
        Self([
            lanes(|lane| x[lane] * cos[lane] + y[lane] * sin[lane]),
            lanes(|lane| y[lane] * cos[lane] - x[lane] * sin[lane]),
            *z,
        ])
    }

    #[inline(always)]
    pub(crate) fn plus_z(&self, z: &Lanes) -> Self {
        let [x, y, before] = self.0;
        Self([x, y, lanes(|lane| before[lane] + z[lane])])
    }
}

impl Add for LaneVector {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::each(|entry, lane| self.0[entry][lane] + other.0[entry][lane])
    }
}

impl Sub for LaneVector {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::each(|entry, lane| self.0[entry][lane] - other.0[entry][lane])
    }
}
