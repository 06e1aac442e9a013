//! Reference case 15: the twelve Euler-angle sets, each to and from a rotation, singular positions
//! reported.

#[path = "support/mod.rs"]
mod support;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use congruent_kinematics::{DeterminedAngles, EulerAngles, EulerSet, Pose, rotation_exp};
use nalgebra::{Matrix3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use support::within;

/// Rounding of two products of rotations and of the angles' sines; worst seen 8.4e-16.
const ROUNDING_RAD: f64 = 4e-15;
/// What [`DeterminedAngles::Sum`] and [`DeterminedAngles::Difference`] leave out at most: the distance from the singular
/// position, 64 eps, on top of rounding; worst seen 1.2e-14.
const SINGULAR_RAD: f64 = 2e-14;

fn turned(axis: char, angle_rad: f64) -> UnitQuaternion<f64> {
    let axis = Vector3::ith("xyz".find(axis).expect("an axis"), 1.0);
    UnitQuaternion::from_axis_angle(&Unit::new_unchecked(axis), angle_rad)
}

/// The rotation by nalgebra's quaternions.
fn by_quaternions(set: EulerSet, angles_rad: [f64; 3]) -> Matrix3<f64> {
    let turns = set.name().chars().zip(angles_rad).map(|(axis, angle_rad)| turned(axis, angle_rad));
    turns.fold(UnitQuaternion::identity(), |before, turn| before * turn).to_rotation_matrix().into_inner()
}

fn apart_rad(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    let pose = |rotation: &Matrix3<f64>| Pose::from_parts(*rotation, Vector3::zeros());
    pose(a).angle_rad(&pose(b))
}

/// Both solutions give the rotation, and every angle is in its range.
#[track_caller]
fn assert_solutions(set: EulerSet, rotation: &Matrix3<f64>, bound_rad: f64) -> EulerAngles {
    let found = set.angles(rotation);
    for angles_rad in [found.angles_rad, found.other_rad] {
        let off_rad = apart_rad(&set.rotation(angles_rad), rotation);
        assert!(within(off_rad, bound_rad), "{set}: {off_rad:e} rad by {found:?}");
        assert!(angles_rad.iter().all(|angle_rad| angle_rad.abs() <= PI), "{set}: {found:?}");
    }
    let ([_, middle, _], [_, other, _]) = (found.angles_rad, found.other_rad);
    if set.is_proper() {
        assert!(middle >= 0.0 && other <= 0.0, "{set}: {found:?}");
    } else {
        assert!(middle.abs() <= FRAC_PI_2 && other.abs() >= FRAC_PI_2, "{set}: {found:?}");
    }
    found
}

/// The two middle angles at which only the sum or only the difference counts, in this order.
fn singular_rad(set: EulerSet) -> [f64; 2] {
    if set.is_proper() {
        return [0.0, PI];
    }
    let is_even = ["xyz", "yzx", "zxy"].contains(&set.name());
    if is_even { [FRAC_PI_2, -FRAC_PI_2] } else { [-FRAC_PI_2, FRAC_PI_2] }
}

/// The angle between -pi and pi that is the same turn.
fn wrapped(angle_rad: f64) -> f64 {
    angle_rad - TAU * (angle_rad / TAU).round()
}

/// By sympy 1.14 with 40 digits, printed with 16: `Quaternion.from_axis_angle((2, -1, 3), 13/10)`, then
/// `to_euler` with the axes in upper case.
#[test]
fn case_15_all_twelve_sets_against_sympy() {
    let rotation = rotation_exp(&(Vector3::new(2.0, -1.0, 3.0).normalize() * 1.3));
    #[rustfmt::skip]
    let printed = [
        ("xyz", [0.738_365_117_861_790_4, 0.056_437_271_729_176_76, 1.072_937_703_444_241]),
        ("xzy", [0.841_775_406_558_511_2, 1.070_016_229_531_898, 0.117_760_304_080_290_1]),
        ("yxz", [0.076_243_972_102_852_18, 0.736_917_052_863_034_9, 1.124_228_754_055_79]),
        ("yzx", [-0.875_463_636_052_684_6, 0.731_413_466_290_458, 1.126_599_720_698_693]),
        ("zxy", [1.221_184_356_849_675, 0.366_209_630_721_870_7, -0.658_630_027_901_994_5]),
        ("zyx", [0.950_846_738_778_882_2, -0.608_272_703_102_886_3, 0.451_530_418_505_056]),
        ("xyx", [2.278_512_243_441_574, 1.073_802_879_405_208, -1.506_581_518_941_504]),
        ("xzx", [0.707_715_916_646_677_1, 1.073_802_879_405_208, 0.064_214_807_853_392_76]),
        ("yxy", [-1.183_238_539_656_893, 1.245_256_463_793_815, 0.782_348_906_837_765_1]),
        ("yzy", [0.387_557_787_138_003_6, 1.245_256_463_793_815, -0.788_447_419_957_131_5]),
        ("zxz", [0.083_742_148_043_012_44, 0.740_112_882_388_958_9, 1.011_037_366_044_625]),
        ("zyz", [-1.487_054_178_751_884, 0.740_112_882_388_958_9, 2.581_833_692_839_521]),
    ];
    for (name, printed) in printed {
        let set: EulerSet = name.parse().unwrap();
        let found = assert_solutions(set, &rotation, ROUNDING_RAD);
        assert_eq!(found.determined, DeterminedAngles::Both);
        for (found, printed) in found.angles_rad.into_iter().zip(printed) {
            assert!(within((found - printed).abs(), ROUNDING_RAD), "{set}: {found} for {printed}");
        }
    }
}

#[test]
fn case_15_singular_positions_are_reported_and_the_first_angle_is_zero() {
    let (first, last) = (0.8, -2.1);
    for set in EulerSet::ALL {
        for (middle, determined) in
            singular_rad(set).into_iter().zip([DeterminedAngles::Sum, DeterminedAngles::Difference])
        {
            let found = assert_solutions(set, &set.rotation([first, middle, last]), SINGULAR_RAD);
            assert_eq!(found.determined, determined, "{set} at {middle}");
            assert!(within(found.from_singular_rad, ROUNDING_RAD));
            let counts = if determined == DeterminedAngles::Sum { first + last } else { last - first };
            assert_eq!(found.angles_rad[0].to_bits(), 0.0_f64.to_bits());
            assert!(within(wrapped(found.angles_rad[1] - middle).abs(), ROUNDING_RAD));
            assert!(within(wrapped(found.angles_rad[2] - counts).abs(), ROUNDING_RAD), "{set}: {found:?}");
        }
    }
}

#[test]
fn case_15_the_rotation_that_turns_nothing_has_no_angles() {
    for set in EulerSet::ALL {
        let found = set.angles(&Matrix3::identity());
        assert_eq!(found.angles_rad.map(f64::to_bits), [0.0_f64; 3].map(f64::to_bits), "{set}");
        let determined = if set.is_proper() { DeterminedAngles::Sum } else { DeterminedAngles::Both };
        assert_eq!(found.determined, determined);
    }
}

#[test]
fn names_are_read_in_either_case() {
    for set in EulerSet::ALL {
        assert_eq!(set.to_string().parse(), Ok(set));
        assert_eq!(set.name().to_uppercase().parse(), Ok(set));
    }
    for name in ["", "xyy", "xyzx", "rpy", "\u{e9}"] {
        assert!(name.parse::<EulerSet>().is_err(), "{name}");
    }
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn case_15_to_a_rotation_and_back(rotation in support::isometry()) {
        let rotation = rotation.rotation.to_rotation_matrix().into_inner();
        for set in EulerSet::ALL {
            assert_solutions(set, &rotation, ROUNDING_RAD);
        }
    }

    #[test]
    fn case_15_angles_come_back(first in -3.1..3.1, share in 0.01_f64..0.99, last in -3.1..3.1) {
        for set in EulerSet::ALL {
            let [sum, difference] = singular_rad(set);
            let angles_rad = [first, sum + (difference - sum) * share, last];
            let rotation = set.rotation(angles_rad);
            prop_assert!(within(apart_rad(&rotation, &by_quaternions(set, angles_rad)), ROUNDING_RAD));
            let found = set.angles(&rotation);
            prop_assert_eq!(found.determined, DeterminedAngles::Both);
            let from_singular_rad = PI * share.min(1.0 - share);
            prop_assert!(within((found.from_singular_rad - from_singular_rad).abs(), ROUNDING_RAD));
            for (found, angle_rad) in found.angles_rad.into_iter().zip(angles_rad) {
                // An error of the rotation comes back divided by the sine of the distance.
                prop_assert!(within((found - angle_rad).abs() * from_singular_rad.sin(), ROUNDING_RAD));
            }
        }
    }

    #[test]
    fn case_15_near_singular_positions_no_digit_is_lost(
        first in -3.1..3.1, exponent in -17.0..-1.0, last in -3.1..3.1, beyond in any::<bool>(),
    ) {
        for set in EulerSet::ALL {
            for singular in singular_rad(set) {
                let step = 10_f64.powf(exponent) * if beyond { 1.0 } else { -1.0 };
                let rotation = set.rotation([first, singular + step, last]);
                let bound_rad = match set.angles(&rotation).determined {
                    DeterminedAngles::Both => ROUNDING_RAD,
                    DeterminedAngles::Sum | DeterminedAngles::Difference => SINGULAR_RAD,
                };
                let found = assert_solutions(set, &rotation, bound_rad);
                prop_assert!(within((found.from_singular_rad - step.abs()).abs(), ROUNDING_RAD));
            }
        }
    }

    #[test]
    fn turns_about_fixed_axes_are_the_reversed_set(angles_rad in proptest::array::uniform3(-PI..PI)) {
        for set in EulerSet::ALL {
            // About the fixed axes of the set: each turn is to the left of the one before.
            let turns = set.name().chars().zip(angles_rad).map(|(axis, angle_rad)| turned(axis, angle_rad));
            let fixed = turns.fold(UnitQuaternion::identity(), |before, turn| turn * before);
            let [first, middle, last] = angles_rad;
            let found = set.reversed().rotation([last, middle, first]);
            prop_assert!(within(apart_rad(&found, fixed.to_rotation_matrix().matrix()), ROUNDING_RAD));
            prop_assert_eq!(set.reversed().reversed(), set);
        }
    }
}
