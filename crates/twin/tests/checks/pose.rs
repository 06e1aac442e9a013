//! `twist` and `invariants`.

use congruent_monitors::verdict::Status;
use congruent_scenario::{
    AgreementCheck, Check, ClearanceCheck, GoalCheck, InvariantsCheck, OnViolation, PoseSettings, Profile,
    TwistCheck,
};
use nalgebra::{Quaternion, UnitQuaternion};

use crate::support::{
    arm, controlled, fails, measure, notes, passes, refused, result, result_distorted, scenario, servo,
    setup, worst,
};

fn twist() -> Check {
    Check::Twist(TwistCheck::default())
}

fn invariants() -> Check {
    Check::Invariants(InvariantsCheck::default())
}

#[test]
fn the_tool_moves_as_the_jacobian_says_by_physics_and_in_playback() {
    for controller in [servo(), controlled("kinematic", 0.0, 0.0)] {
        passes(&result(&setup(scenario(controller, twist()), &arm(&[]))));
    }
}

#[test]
fn a_jump_of_velocity_in_playback_is_no_error() {
    let mut scenario = scenario(controlled("kinematic", 0.0, 0.0), twist());
    if let congruent_scenario::MotionSettings::Joints(motion) = &mut scenario.motion[0] {
        motion.profile = Profile::Linear;
    }
    let mut check = TwistCheck { linear_m_s: Some(1e-3), angular_rad_s: Some(1e-6), ..TwistCheck::default() };
    check.on_violation = congruent_scenario::OnViolation::Continue;
    scenario.check = vec![Check::Twist(check)];
    passes(&result(&setup(scenario, &arm(&[]))));
}

/// An encoder that is 1 mrad off, from 0.4 s on: the direction of the TCP's velocity is 1 mrad off as well.
#[test]
fn an_encoder_that_is_off_is_seen() {
    let setup = setup(scenario(servo(), twist()), &arm(&[]));
    let result = result_distorted(&setup, |said| {
        if said.time_s > 0.4 {
            said.measured_q[0] += 1e-3;
        }
    });
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    let violation = measure(&result, "velocity").first_violation.as_ref().unwrap();
    assert!((0.4..0.42).contains(&violation.time_s), "{violation:#?}");
}

/// Signs of velocities are wrong: twice the velocity is missing.
#[test]
fn a_velocity_with_the_wrong_sign_is_seen() {
    let setup = setup(scenario(servo(), twist()), &arm(&[]));
    let result = result_distorted(&setup, |said| said.measured_qd[1] = -said.measured_qd[1]);
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    // The elbow turns by 0.8 rad in 0.8 s along a quintic: at most by 1.875 rad/s.
    let angular = worst(&result, "angular_velocity");
    assert!((3.5..4.0).contains(&angular), "{angular}");
}

#[test]
fn limits_of_the_twist_are_given_in_one_unit() {
    let check = TwistCheck { angular_rad_s: Some(1.0), angular_deg_s: Some(1.0), ..TwistCheck::default() };
    let found = refused(Check::Twist(check));
    assert_eq!(found, "toml::both_units: angular_rad_s and angular_deg_s are both given");
}

#[test]
fn rotations_are_rotations_and_states_are_numbers() {
    let result = result(&setup(scenario(servo(), invariants()), &arm(&[])));
    passes(&result);
    assert_eq!(result.samples, 1201);
}

#[test]
fn a_rotation_that_is_none_is_named() {
    let setup = setup(scenario(servo(), invariants()), &arm(&[]));
    let stretched = result_distorted(&setup, |said| {
        let turn = said.root_from_links[2].rotation.into_inner();
        said.root_from_links[2].rotation = UnitQuaternion::new_unchecked(turn * 1.000_001);
    });
    assert_eq!(stretched.status, Status::Fail);
    // (1 + e)^2 of the quaternion stretches the matrix: three entries of 4 e in R' R - 1.
    let error = worst(&stretched, "orthonormality_error");
    assert!((error - 4e-6 * 3_f64.sqrt()).abs() < 1e-10, "{error:e}");
    let violation = measure(&stretched, "determinant_error").first_violation.as_ref().unwrap();
    assert_eq!(violation.subject, "fore");
}

#[test]
fn what_is_not_a_number_is_the_worst_of_all() {
    let setup = setup(scenario(servo(), invariants()), &arm(&[]));
    let result = result_distorted(&setup, |said| {
        if said.time_s > 0.1 {
            let nothing = Quaternion::new(f64::NAN, 0.0, 0.0, 0.0);
            said.root_from_links[1].rotation = UnitQuaternion::new_unchecked(nothing);
        }
    });
    assert_eq!(result.status, Status::Fail);
    assert!(worst(&result, "orthonormality_error").is_nan() && worst(&result, "determinant_error").is_nan());
    let velocity = result_distorted(&setup, |said| {
        if said.time_s > 0.1 {
            said.measured_qd[2] = f64::INFINITY;
        }
    });
    fails(&velocity, "not_finite_values", "grip");
}

/// A source without velocities: nothing can be compared, which is never a pass.
#[test]
fn without_velocities_there_is_no_twist() {
    let setup = setup(scenario(servo(), twist()), &arm(&[]));
    let result = result_distorted(&setup, |said| said.measured_qd.clear());
    assert_eq!(result.status, Status::Skipped, "{result:#?}");
    notes(&result, "the source of joint states has no velocities");
}

/// A limit in engineering units is that in SI units, and a check of a distance needs one of both.
#[test]
fn limits_are_given_in_either_unit() {
    let limits = |check: Check| -> Vec<f64> {
        let result = result(&setup(scenario(servo(), check), &arm(&[])));
        result.measures.iter().map(|measure| measure.limit).collect()
    };
    let agreement =
        AgreementCheck { position_mm: Some(0.5), orientation_deg: Some(90.0), ..AgreementCheck::default() };
    assert_eq!(limits(Check::Agreement(agreement)), [0.5e-3, std::f64::consts::FRAC_PI_2]);
    let goal = |position_m, position_mm| {
        Check::Goal(GoalCheck {
            tcp: PoseSettings { xyz_m: Some([9.0, 0.0, 0.0]), ..PoseSettings::default() },
            position_m,
            position_mm,
            orientation_rad: None,
            orientation_deg: None,
            passing: None,
            on_violation: OnViolation::default(),
        })
    };
    assert_eq!(limits(goal(None, Some(2.0))), [0.002]);
    assert_eq!(refused(goal(None, None)), "scenario::no_limit: the check has no `position_m`");
    assert!(refused(goal(Some(1.0), Some(2.0))).starts_with("toml::both_units"));
    let clearance = |minimum_m, minimum_mm| {
        Check::Clearance(ClearanceCheck {
            minimum_m,
            minimum_mm,
            pairs: Vec::new(),
            ignore: Vec::new(),
            passing: None,
            on_violation: OnViolation::default(),
        })
    };
    assert_eq!(refused(clearance(None, None)), "scenario::no_limit: the check has no `minimum_m`");
    assert!(refused(clearance(Some(0.1), Some(2.0))).starts_with("toml::both_units"));
}
