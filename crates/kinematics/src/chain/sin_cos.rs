//! Sine and cosine together, in line and without a branch on the value.
//!
//! A call to a function of another crate costs more than the products of a row (`benches/forward.rs`)
//! and keeps the compiler from overlapping joints. The screws (`screws/tree.rs`) keep to those of
//! `libm`, and so does the physics: a fault here cannot
//! hide in all.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use pulp::{Arch, Simd, WithSimd};

/// Angles whose sines a chain computes together: joints of one arm.
pub(crate) const BLOCK: usize = 8;

/// Up to here the angle's multiple of pi/2 is found exactly: 2^20 pi/2. Beyond, `libm`
/// answers.
const LARGEST_RAD: f64 = 1.6e6;

/// 1.5 * 2^52: adding it rounds to an integer, which is then in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The leading 33 bits of pi/2: products with integers up to 2^20 are exact.
const HALF_PI_HEAD: f64 = 1.570_796_326_734_125_6;
/// pi/2 less its head.
const HALF_PI_TAIL: f64 = 6.077_100_506_506_192e-11;

/// Coefficients of x^3, x^5, ... of the sine on -pi/4..=pi/4.
///
/// Source: Sun Microsystems, *fdlibm* 5.3 (1995), `k_sin.c`; minimax, error below 2^-58.
const SINE: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// Coefficients of x^4, x^6, ... of the cosine on -pi/4..=pi/4.
///
/// Source: Sun Microsystems, *fdlibm* 5.3 (1995), `k_cos.c`; minimax, error below 2^-58.
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sine and cosine of one angle.
#[derive(Debug, Clone, Copy)]
pub struct SinCos {
    /// Sine of the angle.
    pub sin: f64,
    /// Cosine of the angle.
    pub cos: f64,
}

impl SinCos {
    /// Sine and cosine of an angle in radians.
    #[inline(always)]
    pub fn from_angle(angle_rad: f64) -> Self {
        // False for NaN, which `libm` passes on.
        if angle_rad.abs() <= LARGEST_RAD {
            Self::from_moderate_angle(angle_rad)
        } else {
            let (sin, cos) = libm::sincos(angle_rad);
            Self { sin, cos }
        }
    }

    /// Sines and cosines of many angles in radians, in blocks as wide as the machine's vectors.
    ///
    /// # Panics
    /// If there is not one place for each angle.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::SinCos;
    /// let mut pairs = [SinCos::from_angle(0.0); 2];
    /// SinCos::from_angles_into(&[0.0, std::f64::consts::FRAC_PI_2], &mut pairs);
    /// assert_eq!((pairs[0].cos, pairs[1].sin), (1.0, 1.0));
    /// ```
    #[inline]
    pub fn from_angles_into(angles_rad: &[f64], pairs: &mut [Self]) {
        assert_eq!(angles_rad.len(), pairs.len(), "one pair for each angle");
        for (angles_rad, pairs) in angles_rad.chunks(BLOCK).zip(pairs.chunks_mut(BLOCK)) {
            let mut block = [0.0; BLOCK];
            block[..angles_rad.len()].copy_from_slice(angles_rad);
            for (pair, found) in pairs.iter_mut().zip(SinesCosines::from_block(block).iter()) {
                *pair = found;
            }
        }
    }

    /// The angle less the nearest multiple of pi/2, in two parts; then a polynomial each, then
    /// exchanged and signed by the quadrant.
    #[inline(always)]
    fn from_moderate_angle(angle_rad: f64) -> Self {
        // Adding and subtracting ROUNDER rounds without a branch; its low bits are the integer, of which the last two are the
        // quadrant.
        let rounded = angle_rad * std::f64::consts::FRAC_2_PI + ROUNDER;
        let quarters = rounded - ROUNDER;
        let quadrant = rounded.to_bits();
        let (coarse, fine) = (angle_rad - quarters * HALF_PI_HEAD, quarters * HALF_PI_TAIL);
        // Cody-Waite: the product in `coarse` is exact, `x` rounds once, and `lost` is the rounding error, which the polynomials use.
        let x = coarse - fine;
        let lost = (coarse - x) - fine;
        let (sin, cos) = (kernel_sin(x, lost), kernel_cos(x, lost));
        // In odd quadrants sine and cosine are exchanged; the sign of the sine changes in quadrants 2 and 3, that of the cosine
        // in 1 and 2. Masks instead of branches, so that the compiler can use vectors.
        let exchange = (quadrant & 1).wrapping_neg();
        let pick = |even: f64, odd: f64| (even.to_bits() & !exchange) | (odd.to_bits() & exchange);
        Self {
            sin: f64::from_bits(pick(sin, cos) ^ ((quadrant & 2) << 62)),
            cos: f64::from_bits(pick(cos, sin) ^ ((quadrant.wrapping_add(1) & 2) << 62)),
        }
    }
}

/// Sines and cosines of several angles, kept apart: so the compiler computes them in pairs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SinesCosines<const N: usize> {
    pub(crate) sin: [f64; N],
    pub(crate) cos: [f64; N],
}

impl<const N: usize> SinesCosines<N> {
    /// Of angles in radians.
    #[inline(always)]
    pub(crate) fn from_angles(angles_rad: [f64; N]) -> Self {
        // One test for the block: a branch for each angle would keep the compiler from vectors.
        if angles_rad.iter().all(|angle_rad| angle_rad.abs() <= LARGEST_RAD) {
            Self::map_angles(angles_rad, SinCos::from_moderate_angle)
        } else {
            Self::map_angles(angles_rad, SinCos::from_angle)
        }
    }

    #[inline(always)]
    fn map_angles(angles_rad: [f64; N], each: impl Fn(f64) -> SinCos) -> Self {
        let (mut sin, mut cos) = ([0.0; N], [0.0; N]);
        for ((sin, cos), angle_rad) in sin.iter_mut().zip(&mut cos).zip(angles_rad) {
            let one = each(angle_rad);
            (*sin, *cos) = (one.sin, one.cos);
        }
        Self { sin, cos }
    }

    /// The pairs, in the order of the angles.
    #[inline(always)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = SinCos> {
        self.sin.iter().zip(&self.cos).map(|(&sin, &cos)| SinCos { sin, cos })
    }
}

impl SinesCosines<BLOCK> {
    /// Of a block of angles in radians, in the widest vectors that the machine has.
    #[inline]
    pub(crate) fn from_block(angles_rad: [f64; BLOCK]) -> Self {
        Arch::new().dispatch(AngleBlock(angles_rad))
    }
}

struct AngleBlock([f64; BLOCK]);

impl WithSimd for AngleBlock {
    type Output = SinesCosines<BLOCK>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        SinesCosines::from_angles(self.0)
    }
}

/// Sine of `x + lost`, `|x| <= pi/4`.
#[inline(always)]
fn kernel_sin(x: f64, lost: f64) -> f64 {
    let [s1, s2, s3, s4, s5, s6] = SINE;
    let xx = x * x;
    let cube = xx * x;
    let tail = s2 + xx * (s3 + xx * (s4 + xx * (s5 + xx * s6)));
    // In fdlibm's order, smallest terms first: the last bits depend on it.
    x - ((xx * (0.5 * lost - cube * tail) - lost) - cube * s1)
}

/// Cosine of `x + lost`, `|x| <= pi/4`.
#[inline(always)]
fn kernel_cos(x: f64, lost: f64) -> f64 {
    let [c1, c2, c3, c4, c5, c6] = COSINE;
    let xx = x * x;
    let tail = xx * (c1 + xx * (c2 + xx * (c3 + xx * (c4 + xx * (c5 + xx * c6)))));
    let half = 0.5 * xx;
    let coarse = 1.0 - half;
    // (1 - coarse) - half is the rounding error of `coarse`, which is added back.
    coarse + (((1.0 - coarse) - half) + (xx * tail - x * lost))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_4, PI};

    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding: both sides are within one unit in the last place, so they differ by one at most,
    /// 2^-53 = 1.11e-16 below 1; worst seen 1.11e-16.
    const ROUNDING: f64 = 1.2e-16;

    #[track_caller]
    fn assert_right(angle_rad: f64) {
        let SinCos { sin, cos } = SinCos::from_angle(angle_rad);
        assert!(support::within((sin - angle_rad.sin()).abs(), ROUNDING), "sine of {angle_rad}");
        assert!(support::within((cos - angle_rad.cos()).abs(), ROUNDING), "cosine of {angle_rad}");
    }

    #[test]
    fn every_quadrant_and_both_sides_of_its_ends() {
        for eighths in -24..=24 {
            let end = f64::from(eighths) * FRAC_PI_4;
            for angle_rad in [end.next_down(), end, end.next_up(), end + 0.1] {
                assert_right(angle_rad);
            }
        }
    }

    #[test]
    fn large_angles_and_the_change_to_the_standard_library() {
        for angle_rad in [1e3, 1e5, LARGEST_RAD, LARGEST_RAD.next_up(), 1e9, 1e300] {
            assert_right(angle_rad);
            assert_right(-angle_rad);
        }
    }

    #[test]
    fn tiny_angles_and_zeros_are_exact() {
        for angle_rad in [0.0, -0.0, f64::MIN_POSITIVE, -1e-300, 1e-20] {
            let SinCos { sin, cos } = SinCos::from_angle(angle_rad);
            assert_eq!((sin.to_bits(), cos.to_bits()), (angle_rad.to_bits(), 1.0_f64.to_bits()));
        }
    }

    #[test]
    fn no_number_in_no_number_out() {
        for angle_rad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let SinCos { sin, cos } = SinCos::from_angle(angle_rad);
            assert!(sin.is_nan() && cos.is_nan());
        }
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn they_are_those_of_the_standard_library(near in -2.0 * PI..2.0 * PI, far in -LARGEST_RAD..LARGEST_RAD) {
            for angle_rad in [near, far] {
                let SinCos { sin, cos } = SinCos::from_angle(angle_rad);
                prop_assert!(support::within((sin - angle_rad.sin()).abs(), ROUNDING));
                prop_assert!(support::within((cos - angle_rad.cos()).abs(), ROUNDING));
            }
            for angles_rad in [[near, far, -near], [near, far * 1e9, -near]] {
                for (several, angle_rad) in SinesCosines::from_angles(angles_rad).iter().zip(angles_rad) {
                    let one = SinCos::from_angle(angle_rad);
                    prop_assert_eq!((several.sin, several.cos), (one.sin, one.cos));
                }
            }
        }
    }
}
