//! Elementary functions with the same result on every machine, to the last bit.
//!
//! The standard library calls those of the operating system, which choose their instructions, and with them the last
//! bit, by the processor. These are compiled with the program.

/// Elementary functions of a real number. Angles are in radians.
pub trait Elementary {
    /// The sine.
    fn sine(self) -> f64;
    /// The cosine.
    fn cosine(self) -> f64;
    /// Sine and cosine.
    fn sine_cosine(self) -> (f64, f64);
    /// The angle in -pi/2..=pi/2 with this sine.
    fn arcsine(self) -> f64;
    /// The angle in -pi..=pi of the point with this ordinate and the abscissa `x`.
    fn arctangent_over(self, x: f64) -> f64;
    /// The square root of the sum of the squares.
    fn hypotenuse_with(self, other: f64) -> f64;
    /// The exponential less 1.
    fn exponential_less_one(self) -> f64;
    /// The natural logarithm.
    fn logarithm(self) -> f64;
    /// The natural logarithm of the number and 1.
    fn logarithm_of_one_more(self) -> f64;
    /// The decimal logarithm.
    fn decimal_logarithm(self) -> f64;
    /// The number to a power.
    fn to_power(self, power: f64) -> f64;
    /// The cube root.
    fn cube_root(self) -> f64;
}

impl Elementary for f64 {
    #[inline]
    fn sine(self) -> f64 {
        libm::sin(self)
    }

    #[inline]
    fn cosine(self) -> f64 {
        libm::cos(self)
    }

    #[inline]
    fn sine_cosine(self) -> (f64, f64) {
        libm::sincos(self)
    }

    #[inline]
    fn arcsine(self) -> f64 {
        libm::asin(self)
    }

    #[inline]
    fn arctangent_over(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }

    #[inline]
    fn hypotenuse_with(self, other: f64) -> f64 {
        libm::hypot(self, other)
    }

    #[inline]
    fn exponential_less_one(self) -> f64 {
        libm::expm1(self)
    }

    #[inline]
    fn logarithm(self) -> f64 {
        libm::log(self)
    }

    #[inline]
    fn logarithm_of_one_more(self) -> f64 {
        libm::log1p(self)
    }

    #[inline]
    fn decimal_logarithm(self) -> f64 {
        libm::log10(self)
    }

    #[inline]
    fn to_power(self, power: f64) -> f64 {
        libm::pow(self, power)
    }

    #[inline]
    fn cube_root(self) -> f64 {
        libm::cbrt(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kind: rounding. Both are within an ulp or two of the truth.
    #[test]
    fn they_are_those_of_the_standard_library_but_for_the_last_bits() {
        for step in 1..400 {
            let x = 0.013 * f64::from(step) - 2.6;
            let (sine, cosine) = x.sine_cosine();
            let positive = x.abs() + 1e-9;
            let pairs = [
                (sine, x.sin()),
                (cosine, x.cos()),
                (x.sine(), x.sin()),
                (x.cosine(), x.cos()),
                (x.sin().arcsine(), x.sin().asin()),
                (x.arctangent_over(0.7), x.atan2(0.7)),
                (x.hypotenuse_with(0.3), x.hypot(0.3)),
                (x.exponential_less_one(), x.exp_m1()),
                (positive.logarithm(), positive.ln()),
                (positive.logarithm_of_one_more(), positive.ln_1p()),
                (positive.decimal_logarithm(), positive.log10()),
                (positive.to_power(1.3), positive.powf(1.3)),
                (x.cube_root(), x.cbrt()),
            ];
            for (at, (ours, theirs)) in pairs.into_iter().enumerate() {
                assert!((ours - theirs).abs() <= 4.0 * f64::EPSILON * theirs.abs(), "{at} at {x}");
            }
        }
    }
}
