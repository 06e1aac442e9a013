//! Rows of both conventions against their factors, and back from their transform.

use proptest::prelude::*;

use super::{modified::ModifiedDh, standard::StandardDh};
use crate::{
    chain::{axes::Axes, sin_cos::SinCos},
    spatial::pose::Pose,
    support::{self, screw_x, screw_z, within},
};

/// Rounding of entries up to 3, one operation each way; worst seen 8.0e-16.
const ROUNDING: f64 = 4e-15;

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn the_printed_matrix_is_the_product_of_its_factors([a_m, alpha_rad, d_m, theta_rad] in support::dh_figures()) {
        let (about_x, about_z) = (screw_x(alpha_rad, a_m), screw_z(theta_rad, d_m));
        let (alpha, theta) = (SinCos::from_angle(alpha_rad), SinCos::from_angle(theta_rad));
        let start = || Axes::from_pose(&Pose::identity());
        let standard = StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform();
        let modified = ModifiedDh { a_m, alpha_rad, d_m, theta_rad }.transform();
        for (printed, product, stepped) in [
            (standard, about_z * about_x, start().about_z(theta, d_m).about_x(alpha, a_m)),
            (modified, about_x * about_z, start().about_x(alpha, a_m).about_z(theta, d_m)),
        ] {
            for other in [Pose::from(product), stepped.pose()] {
                prop_assert!(within((printed.rotation - other.rotation).norm(), ROUNDING));
                prop_assert!(within(printed.distance_m(&other), ROUNDING));
            }
        }
    }

    #[test]
    fn a_transform_gives_its_row_back(figures in support::dh_figures()) {
        let [a_m, alpha_rad, d_m, theta_rad] = figures;
        let standard = StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform();
        let standard = StandardDh::from_transform(&standard).unwrap();
        let modified = ModifiedDh { a_m, alpha_rad, d_m, theta_rad }.transform();
        let modified = ModifiedDh::from_transform(&modified).unwrap();
        for found in [
            [standard.a_m, standard.alpha_rad, standard.d_m, standard.theta_rad],
            [modified.a_m, modified.alpha_rad, modified.d_m, modified.theta_rad],
        ] {
            for (found, given) in found.into_iter().zip(figures) {
                prop_assert!(within((found - given).abs(), ROUNDING));
            }
        }
    }
}
