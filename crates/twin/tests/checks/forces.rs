//! `dynamics` and `power`.

use congruent_description::{CarriedBody, Inertia};
use congruent_monitors::{RunPayload, verdict::Status};
use congruent_scenario::{
    Check, DynamicsCheck, EffortCheck, FaultSettings, ObstacleSettings, OverLimit, PowerCheck,
    ScaledTorqueFault,
};
use congruent_twin::RunSetup;
use nalgebra::{Isometry3, Matrix3};

use crate::support::{
    arm, controlled, fails, measure, notes, passes, result, result_with_physics_of, scenario, servo, setup,
    worst,
};

fn dynamics() -> Check {
    Check::Dynamics(DynamicsCheck::default())
}

fn power() -> Check {
    Check::Power(PowerCheck::default())
}

/// The arm takes 3 kg with its finger from 0.3 s to 0.6 s.
fn loaded(check: Check) -> RunSetup {
    let mut setup = setup(scenario(servo(), check), &arm(&[]));
    let link = setup.description.robot.find_link("finger").expect("the arm has a finger");
    let link_from_inertial = Isometry3::translation(0.05, 0.0, 0.0);
    let inertia = Inertia { mass_kg: 3.0, link_from_inertial, tensor_kg_m2: Matrix3::identity() * 0.002 };
    let carried = CarriedBody { link, inertia };
    setup.payloads = vec![RunPayload { name: "part".to_owned(), carried, from_s: 0.3, until_s: 0.6 }];
    setup
}

/// Without actuators a light last link whips at many times its velocity limit, where the error of a step is not bounded, and joints hit
/// their stops: neither is a fault.
#[test]
fn an_arm_that_falls_moves_as_its_robot_would() {
    let light = [
        ("<mass value=\"2\"/>", "<mass value=\"0.05\"/>"),
        ("ixx=\"0.005\" iyy=\"0.04\" izz=\"0.04\"", "ixx=\"1e-5\" iyy=\"1e-5\" izz=\"1e-5\""),
        ("<mass value=\"0.2\"/>", "<mass value=\"0.01\"/>"),
        ("<mass value=\"0.2\"/>", "<mass value=\"0.01\"/>"),
    ];
    let mut scenario = scenario(controlled("passive", 0.0, 0.0), dynamics());
    scenario.simulation.duration_s = Some(3.0);
    scenario.motion.clear();
    let fallen = result(&setup(scenario, &arm(&light)));
    assert_ne!(fallen.status, Status::Fail, "{fallen:#?}");
    notes(&fallen, "a joint faster than its velocity limit");
    notes(&fallen, "a joint at its stop");
}

#[test]
fn the_physics_moves_as_its_robot_would() {
    for controller in [servo(), controlled("pd", 3000.0, 150.0)] {
        let dynamics = result(&setup(scenario(controller.clone(), dynamics()), &arm(&[])));
        passes(&dynamics);
        let power = result(&setup(scenario(controller, power()), &arm(&[])));
        passes(&power);
    }
}

/// First-order scheme: a quarter of the step, a quarter of the difference.
#[test]
fn the_differences_are_of_first_order_in_the_step() {
    /// Kind: truncation, the second order of the ratio at 1 ms; worst seen 0.05.
    const RATIO: f64 = 0.15;
    for (check, quantity) in [(dynamics(), "acceleration_error"), (power(), "energy_error")] {
        let [coarse, fine] = [1e-3, 0.25e-3].map(|step_s| {
            let mut scenario = scenario(servo(), check.clone());
            scenario.simulation.step_s = step_s;
            // Without dry friction, which acts by jumps.
            let result = result(&setup(scenario, &arm(&[("friction=\"0.5\"", "friction=\"0\"")])));
            worst(&result, quantity)
        });
        assert!((coarse / fine - 4.0).abs() < 4.0 * RATIO, "{quantity}: {coarse:e} and {fine:e}");
    }
}

#[test]
fn a_joint_that_resists_more_than_declared_is_named() {
    let declared = setup(scenario(servo(), dynamics()), &arm(&[]));
    let stiff = arm(&[("friction=\"0.5\"", "friction=\"3\"")]);
    fails(&result_with_physics_of(&stiff, &declared), "acceleration_error", "elbow");
    let damped = arm(&[("damping=\"0.5\"", "damping=\"3\"")]);
    fails(&result_with_physics_of(&damped, &declared), "acceleration_error", "shoulder");
    let declared = setup(scenario(servo(), power()), &arm(&[]));
    fails(&result_with_physics_of(&damped, &declared), "energy_error", "all joints");
}

#[test]
fn an_undeclared_mass_is_seen() {
    let heavy = arm(&[("mass value=\"2\"", "mass value=\"2.5\"")]);
    for (check, quantity) in [(dynamics(), "acceleration_error"), (power(), "energy_error")] {
        let result = result_with_physics_of(&heavy, &setup(scenario(servo(), check), &arm(&[])));
        assert_eq!(result.status, Status::Fail, "{result:#?}");
        assert!(measure(&result, quantity).first_violation.is_some());
    }
}

#[test]
fn a_declared_payload_is_part_of_the_robot_while_it_is_carried() {
    for check in [dynamics(), power()] {
        passes(&result(&loaded(check)));
    }
    // The same physics, and a check that does not know of it.
    let loaded_setup = loaded(dynamics());
    let source = congruent_twin::source::SimulationSource::new(&loaded_setup).unwrap();
    let unaware = setup(scenario(servo(), dynamics()), &arm(&[]));
    let outcome = crate::support::outcome(&unaware, Some(Box::new(source)));
    let violation = measure(&outcome.checks[0], "acceleration_error").first_violation.clone().unwrap();
    assert!(
        (violation.time_s - 0.301).abs() < 1e-9,
        "the first step with the payload ends there: {violation:?}"
    );
}

#[test]
fn what_is_played_back_has_no_forces_and_is_skipped() {
    for check in [dynamics(), power()] {
        let result = result(&setup(scenario(controlled("kinematic", 0.0, 0.0), check), &arm(&[])));
        assert_eq!((result.status, result.samples), (Status::Skipped, 0), "{result:#?}");
        notes(&result, "1200 of 1200 samples not evaluated: no forces known");
    }
}

#[test]
fn samples_with_contact_are_left_out_and_counted() {
    for check in [dynamics(), power()] {
        let mut scenario = scenario(servo(), check);
        // The finger comes down on it half way.
        scenario.obstacle = vec![ObstacleSettings {
            name: "block".to_owned(),
            box_m: Some([2.0, 2.0, 0.1]),
            xyz_m: Some([0.5, 0.0, -0.55]),
            ..ObstacleSettings::default()
        }];
        let result = result(&setup(scenario, &arm(&[])));
        passes(&result);
        notes(&result, "samples not evaluated: contact, or a joint at its stop");
        assert!((100..1200).contains(&result.samples), "{result:#?}");
    }
}

/// The finger comes onto a block at the beginning of its motion. By how much the block is below it, so that some samples are free,
/// depends on how early the physics looks for contact.
#[test]
fn few_samples_are_no_result() {
    for check in [dynamics(), power()] {
        let over = |gap_mm: u32| {
            let mut scenario = scenario(servo(), check.clone());
            scenario.obstacle = vec![ObstacleSettings {
                name: "block".to_owned(),
                box_m: Some([2.0, 2.0, 0.1]),
                xyz_m: Some([0.5, 0.0, 0.2 - 1e-3 * f64::from(gap_mm)]),
                ..ObstacleSettings::default()
            }];
            result(&setup(scenario, &arm(&[])))
        };
        let result = (0..100).step_by(2).map(over).find(|result| result.samples > 0).expect("it is free");
        assert!(result.samples < 120, "{result:#?}");
        assert_eq!(result.status, Status::Inconclusive, "{result:#?}");
        notes(&result, "of 1200 samples evaluated, fewer than one in 10");
    }
}

/// The elbow is held against 9.8 N m by friction of up to 60 N m while the shoulder falls.
#[test]
fn dry_friction_that_holds_is_any_torque_up_to_its_largest() {
    // A shoulder that may fall at 6 rad/s: faster joints are not evaluated.
    let sticky = |largest: f64| {
        arm(&[
            ("friction=\"0.5\"", &format!("friction=\"{largest}\"")),
            ("effort=\"300\" velocity=\"3\"", "effort=\"300\" velocity=\"9\""),
        ])
    };
    let check = scenario(controlled("passive", 0.0, 0.0), dynamics());
    let declared = setup(check, &sticky(60.0));
    let result = result(&declared);
    passes(&result);
    assert!(result.samples > 1000, "{result:#?}");
    assert!(result.notes.iter().all(|note| !note.contains("friction")), "{result:#?}");
    // At rest as well, what holds is held against what can: 60 N m hold where 1 N m is declared.
    let weak = setup(scenario(controlled("passive", 0.0, 0.0), dynamics()), &sticky(1.0));
    fails(&result_with_physics_of(&sticky(60.0), &weak), "acceleration_error", "elbow");
}

fn effort() -> Check {
    Check::Effort(EffortCheck::default())
}

/// Feedback hides it from `tracking`, and the equations of motion hold with what is delivered.
#[test]
fn an_actuator_that_delivers_another_share_of_its_torque_is_named() {
    let scaled = |check: Check, share: f64| {
        let mut scenario = scenario(controlled("computed_torque", 400.0, 40.0), check);
        scenario.fault = vec![FaultSettings::ScaledTorque(ScaledTorqueFault {
            joint: "elbow".to_owned(),
            share,
            at_s: 0.3,
            until_s: None,
        })];
        result(&setup(scenario, &arm(&[])))
    };
    for share in [0.8, 1.3] {
        let result = scaled(effort(), share);
        fails(&result, "effort_error", "elbow");
        // Of the joint's own effort, whatever its size.
        let error = (worst(&result, "effort_error") - (share - 1.0).abs()).abs();
        assert!(error < 1e-9, "{result:#?}");
        passes(&scaled(dynamics(), share));
    }
    passes(&scaled(effort(), 0.97));
}

#[test]
fn a_drive_delivers_what_it_is_commanded_to_within_its_limits() {
    for arm in [arm(&[]), arm(&[("effort=\"300\"", "effort=\"45\""), ("velocity=\"3\"", "velocity=\"0.5\"")])]
    {
        for controller in
            [servo(), controlled("pd", 3000.0, 150.0), controlled("computed_torque", 400.0, 40.0)]
        {
            let mut scenario = scenario(controller, effort());
            scenario.limits.over_limit = OverLimit::Warn;
            let result = result(&setup(scenario, &arm));
            passes(&result);
            assert_eq!((result.samples, worst(&result, "effort_error").to_bits()), (1200, 0), "{result:#?}");
        }
    }
    let played = result(&setup(scenario(controlled("kinematic", 0.0, 0.0), effort()), &arm(&[])));
    assert_eq!((played.status, played.samples), (Status::Skipped, 0), "{played:#?}");
}
