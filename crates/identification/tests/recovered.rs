//! Parameters that a recording was made with are found again: the efforts come from the inverse dynamics of a robot that differs from
//! its description.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

use std::path::Path;

use congruent_description::{Robot, RobotDescription, RobotQ, load_robot};
use congruent_dynamics::{BodyTree, JointMotionState, JointResistance, SpatialInertia};
use congruent_identification::{
    Collector, EffortKind, FreeGroup, FreeUnknowns, Instants, JointUnknown, PayloadPlace, RecordedEquations,
    RecordedRow, SampledParts, Smoothing, identify, recognise,
};
use congruent_kinematics::Pose;
use nalgebra::{Matrix3, Vector3};

fn robot(name: &str) -> RobotDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    load_robot(&path).unwrap()
}

/// Two incommensurable sines a joint; followers follow.
fn motion(time_s: f64, robot: &Robot) -> (RobotQ, Vec<f64>, Vec<f64>) {
    let dof = robot.dof();
    let mut state = (vec![0.0; dof], vec![0.0; dof], vec![0.0; dof]);
    for joint in 0..dof {
        let at = f64::from(u32::try_from(joint).unwrap());
        for (amplitude, rate) in [(0.4, 1.1 + 0.23 * at), (0.15, 2.9 - 0.19 * at)] {
            let (sine, cosine) = (rate * time_s + at).sin_cos();
            state.0[joint] += amplitude * sine;
            state.1[joint] += amplitude * rate * cosine;
            state.2[joint] -= amplitude * rate * rate * sine;
        }
    }
    let mut q = RobotQ::from(state.0);
    robot.apply_mimic(&mut q);
    robot.apply_mimic_to_speeds(&mut state.1);
    robot.apply_mimic_to_speeds(&mut state.2);
    (q, state.1, state.2)
}

fn free(groups: &[FreeGroup]) -> FreeUnknowns {
    FreeUnknowns { groups: groups.to_vec(), payload: None }
}

/// Noise of both signs that no generator of the crate makes.
fn noise(at: usize) -> f64 {
    let x = (f64::from(u32::try_from(at % 1_000_003).unwrap()) * 12.9898).sin() * 43_758.545_3;
    2.0 * (x - x.floor()) - 1.0
}

/// How a recording is made.
struct Recorder {
    period_s: f64,
    rows: usize,
    /// Steps of the encoders, rad or m.
    step: f64,
    /// Efforts are those of so long before, s.
    delay_s: f64,
    /// Noise of the efforts, N m or N, at most.
    noise: f64,
}

const GOOD: Recorder = Recorder { period_s: 0.004, rows: 10_000, step: 0.0, delay_s: 0.0, noise: 0.05 };

/// The equations of a recording of 40 s, of which the efforts are those of `real`, changed by `effort`.
fn recorded(
    robot: &Robot,
    description: &BodyTree,
    real: &BodyTree,
    effort: impl Fn(usize, f64, f64) -> f64,
) -> RecordedEquations {
    recorded_by(&GOOD, robot, description, real, effort)
}

fn recorded_by(
    recorder: &Recorder,
    robot: &Robot,
    description: &BodyTree,
    real: &BodyTree,
    effort: impl Fn(usize, f64, f64) -> f64,
) -> RecordedEquations {
    let dof = real.dof();
    let (rows, period_s) = (recorder.rows, recorder.period_s);
    let times = (0..rows).map(|at| f64::from(u32::try_from(at).unwrap()) * period_s);
    let positions: Vec<(f64, RobotQ)> = times.map(|time_s| (time_s, motion(time_s, robot).0)).collect();
    let (mut tau, mut gravity, mut buffer) = (vec![0.0; dof], vec![0.0; dof], real.buffer());
    let mut efforts: Vec<Vec<f64>> = Vec::new();
    let encoder = |q: f64| if recorder.step > 0.0 { (q / recorder.step).round() * recorder.step } else { q };
    for (at, (time_s, _)) in positions.iter().enumerate() {
        let (q, qd, qdd) = motion(time_s - recorder.delay_s, robot);
        let q = &q;
        real.inverse_into(&JointMotionState { q, qd: &qd, qdd: &qdd }, &mut buffer, &mut tau).unwrap();
        real.gravity_into(q, &mut buffer, &mut gravity).unwrap();
        // The motor of a joint moves its followers, too.
        for joint in 0..dof {
            let (driver, ratio) = real.driver(joint);
            let driver = real.driven_joints()[driver];
            if driver != joint {
                tau[driver] += ratio * tau[joint];
            }
        }
        let effort: Vec<f64> = (0..dof)
            .map(|joint| effort(joint, tau[joint], gravity[joint]) + recorder.noise * noise(at * dof + joint))
            .collect();
        efforts.push(effort);
    }
    let positions: Vec<(f64, RobotQ)> =
        positions.into_iter().map(|(time_s, q)| (time_s, q.iter().map(|q| encoder(*q)).collect())).collect();
    let row = |at: usize| RecordedRow { time_s: positions[at].0, q: &positions[at].1, effort: &efforts[at] };
    let mut parts = SampledParts::new(0.0, 40.0);
    (0..rows).for_each(|at| parts.push(row(at)));
    let survey = parts.survey().unwrap();
    let instants = Instants::Moving(survey.moving_speeds());
    let mut collector = Collector::new(description, survey.smoothing, instants, 0.0, 40.0);
    (0..rows).for_each(|at| collector.push(row(at)).unwrap());
    collector.finish()
}

fn real_terms(dof: usize) -> Vec<JointResistance> {
    (0..dof)
        .map(|joint| {
            let at = f64::from(u32::try_from(joint).unwrap());
            JointResistance { damping: 0.5 + 0.1 * at, friction: 1.0 - 0.1 * at, armature: 0.2 - 0.02 * at }
        })
        .collect()
}

#[test]
fn friction_and_armature_are_found_within_four_standard_errors() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot);
    let terms = real_terms(6);
    let real = description.clone().with_resistances(terms.clone()).unwrap();
    let equations = recorded(&ur5e.robot, &description, &real, |_, tau, _| tau);
    let recognised = recognise(&equations);
    assert_eq!(recognised.kind, EffortKind::Torque, "{recognised:?}");
    let unknowns = free(&[FreeGroup::Friction, FreeGroup::Armature]);
    let found = identify(&equations, &unknowns).unwrap();
    assert!(found.is_better && found.indistinct.is_empty());
    for (joint, expected) in found.joints.iter().zip(&terms) {
        for (term, value) in &joint.terms {
            let expected = match term {
                JointUnknown::Viscous => expected.damping,
                JointUnknown::Coulomb => expected.friction,
                JointUnknown::Armature => expected.armature,
                JointUnknown::Offset => 0.0,
            };
            let error = (value.value - expected).abs();
            assert!(error < 4.0 * value.standard_error, "{}: {term:?} {value:?} {expected}", joint.joint);
            assert!(value.standard_error < 0.02, "{}: {term:?} {value:?}", joint.joint);
        }
        // Noise of 0.05 N m, uniform, averaged by the window.
        assert!(joint.held_out.after < 0.05 && joint.held_out.before > 0.3, "{:?}", joint.held_out);
    }
}

#[test]
fn a_payload_is_found_with_its_mass_and_center() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot).with_resistances(real_terms(6)).unwrap();
    let (mass_kg, center) = (1.8, Vector3::new(0.03, -0.02, 0.09));
    let payload = SpatialInertia {
        mass_kg,
        first_moment_kg_m: Vector3::zeros(),
        tensor_kg_m2: Matrix3::from_diagonal(&Vector3::new(0.004, 0.005, 0.003)),
    };
    let payload = payload.transformed_by(&Pose::from_parts(Matrix3::identity(), center));
    let mut inertias: Vec<SpatialInertia> = (0..6).map(|joint| description.inertia_in_link(joint)).collect();
    inertias[5] += payload;
    let real = description.clone().with_inertias_in_links(&inertias).unwrap();
    let equations = recorded(&ur5e.robot, &description, &real, |_, tau, _| tau);
    let place = PayloadPlace { joint: 5, link_from_payload: Pose::identity() };
    let unknowns = FreeUnknowns { payload: Some(place), ..free(&[FreeGroup::Payload]) };
    let found = identify(&equations, &unknowns).unwrap();
    let body = found.payload.expect("it is free");
    assert!(found.is_better);
    let found_center = body.inertia.first_moment_kg_m / body.inertia.mass_kg;
    assert!((body.inertia.mass_kg - mass_kg).abs() < 4.0 * body.mass_error_kg, "{body:?}");
    assert!(body.mass_error_kg < 0.01, "{body:?}");
    for axis in 0..3 {
        let error = (found_center[axis] - center[axis]).abs();
        assert!(error < 4.0 * body.center_error_m[axis] && body.center_error_m[axis] < 0.002, "{body:?}");
    }
}

#[test]
fn other_masses_of_links_explain_the_efforts_and_can_exist() {
    let panda = robot("panda");
    let description = BodyTree::new(&panda.robot);
    let dof = description.dof();
    let inertias: Vec<SpatialInertia> = (0..dof)
        .map(|joint| {
            let factor = 1.0 + 0.3 * (-1.0_f64).powi(i32::try_from(joint).unwrap());
            let scaled = description.inertia_in_link(joint).parameters().map(|parameter| parameter * factor);
            SpatialInertia::from_parameters(scaled)
        })
        .collect();
    let real = description.clone().with_inertias_in_links(&inertias).unwrap();
    let equations = recorded(&panda.robot, &description, &real, |_, tau, _| tau);
    let unknowns = free(&[FreeGroup::Links]);
    let found = identify(&equations, &unknowns).unwrap();
    assert!(found.is_better);
    for joint in &found.joints {
        let held_out = joint.held_out;
        assert!(held_out.after < 0.05 && held_out.after < 0.2 * held_out.before.max(0.25), "{held_out:?}");
    }
    let [known, all] = found.known_combinations;
    assert!(known > 20 && known < all, "{known} of {all}");
    for body in &found.bodies {
        let inertia = body.inertia.to_link().expect("it has a mass");
        let moments = inertia.tensor_kg_m2.symmetric_eigenvalues();
        assert!(moments.min() > -1e-9 && 2.0 * moments.max() < moments.sum() + 1e-9, "{moments}");
    }
}

#[test]
fn currents_and_torques_without_gravity_are_recognised() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot);
    let real = description.clone().with_resistances(real_terms(6)).unwrap();
    let constants = [11.0, 12.0, 9.0, 8.0, 8.5, 7.5];
    let currents =
        recognise(&recorded(&ur5e.robot, &description, &real, |joint, tau, _| tau / constants[joint]));
    assert_eq!(currents.kind, EffortKind::Current, "{currents:?}");
    for (joint, constant) in [(1, 12.0), (2, 9.0)] {
        let (factor, error) = currents.factors[joint].expect("gravity acts on it");
        assert!((factor - constant).abs() < 0.02 * constant && error < 0.02 * constant, "{currents:?}");
    }
    let relative = recorded(&ur5e.robot, &description, &real, |_, tau, gravity| tau - gravity);
    assert_eq!(recognise(&relative).kind, EffortKind::TorqueWithoutGravity);
    let found = identify(&relative.with_gravity_added(), &free(&[FreeGroup::Friction, FreeGroup::Armature]));
    assert!(found.unwrap().is_better);
    let none = recorded(&ur5e.robot, &description, &real, |_, _, _| 0.0);
    // Noise alone: nothing of the robot is in it.
    assert_eq!(recognise(&none).kind, EffortKind::Unknown);
}

/// The hobby servo's encoder: accelerations are noise unless the window averages it, and an armature would vanish.
#[test]
fn a_coarse_encoder_does_not_take_the_armature_away() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot);
    let terms = real_terms(6);
    let real = description.clone().with_resistances(terms.clone()).unwrap();
    let coarse = Recorder { period_s: 0.01, rows: 4000, step: std::f64::consts::TAU / 4096.0, ..GOOD };
    let equations = recorded_by(&coarse, &ur5e.robot, &description, &real, |_, tau, _| tau);
    let found = identify(&equations, &free(&[FreeGroup::Friction, FreeGroup::Armature])).unwrap();
    assert!(found.is_better);
    for (joint, expected) in found.joints.iter().zip(&terms) {
        let armature = joint.terms.iter().find(|(term, _)| *term == JointUnknown::Armature).unwrap().1;
        assert!((armature.value - expected.armature).abs() < 0.25 * expected.armature, "{armature:?}");
    }
}

/// Efforts that are late look like viscous friction, and noise of their derivative hides that they are late.
#[test]
fn late_and_noisy_efforts_are_known_to_be_late() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot);
    let terms = real_terms(6);
    let real = description.clone().with_resistances(terms.clone()).unwrap();
    for delay_s in [0.002, 0.02] {
        let late = Recorder { period_s: 0.01, rows: 4000, delay_s, noise: 0.5, ..GOOD };
        let equations = recorded_by(&late, &ur5e.robot, &description, &real, |_, tau, _| tau);
        let found = identify(&equations, &free(&[FreeGroup::Friction, FreeGroup::Armature])).unwrap();
        let (found_s, error_s) = found.delay_s.unwrap();
        assert!((found_s - delay_s).abs() < 4.0 * error_s && error_s < 0.003, "{found_s} {error_s}");
        for (joint, expected) in found.joints.iter().zip(&terms) {
            let viscous = joint.terms.iter().find(|(term, _)| *term == JointUnknown::Viscous).unwrap().1;
            let off = (viscous.value - expected.damping).abs();
            assert!(off < 4.0 * viscous.standard_error, "{viscous:?} {expected:?}");
        }
    }
}

/// An arm of half the masses has torques, not currents, and not torques without gravity.
#[test]
fn other_masses_feign_no_other_kind() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot);
    let half = (0..6).map(|joint| {
        SpatialInertia::from_parameters(description.inertia_in_link(joint).parameters().map(|of| 0.5 * of))
    });
    let real = description.clone().with_inertias_in_links(&half.collect::<Vec<_>>()).unwrap();
    let equations = recorded(&ur5e.robot, &description, &real, |_, tau, _| tau);
    assert_eq!(recognise(&equations).kind, EffortKind::Torque);
}

/// A description that is right is not bettered by what it does not say: a constant effort and a delay.
#[test]
fn nothing_is_better_than_a_description_that_is_right() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot).with_resistances(real_terms(6)).unwrap();
    let late = Recorder { delay_s: 0.005, ..GOOD };
    let equations = recorded_by(&late, &ur5e.robot, &description, &description, |_, tau, _| tau + 0.7);
    let found = identify(&equations, &free(&[FreeGroup::Friction, FreeGroup::Armature])).unwrap();
    assert!(!found.is_better);
    let (found_s, error_s) = found.delay_s.unwrap();
    assert!((found_s - 0.005).abs() < 4.0 * error_s, "{found_s} {error_s}");
}

/// At rest gravity acts alone: masses and centres show, friction does not.
#[test]
fn still_poses_show_the_mass_of_a_payload() {
    let ur5e = robot("ur5e");
    let description = BodyTree::new(&ur5e.robot);
    let (mass_kg, center) = (1.8, Vector3::new(0.03, -0.02, 0.09));
    let mut inertias: Vec<SpatialInertia> = (0..6).map(|joint| description.inertia_in_link(joint)).collect();
    inertias[5] += SpatialInertia::point_mass(mass_kg, center);
    let real = description.clone().with_inertias_in_links(&inertias).unwrap();
    let smoothing = Smoothing { half_window_s: 0.05 };
    let still = Instants::Still(vec![0.005; 6]);
    let mut collector = Collector::new(&description, smoothing, still, 0.0, 40.0);
    let (mut tau, mut buffer) = (vec![0.0; 6], real.buffer());
    for pose in 0..20_u32 {
        let (q, _, _) = motion(f64::from(pose) * 1.7, &ur5e.robot);
        collector.break_here();
        for row in 0..250_u32 {
            let time_s = f64::from(pose) * 2.0 + f64::from(row) * 0.004;
            real.gravity_into(&q, &mut buffer, &mut tau).unwrap();
            let at = usize::try_from(pose * 250 + row).unwrap();
            let effort: Vec<f64> =
                tau.iter().enumerate().map(|(joint, tau)| tau + 0.05 * noise(at * 6 + joint)).collect();
            collector.push(RecordedRow { time_s, q: &q, effort: &effort }).unwrap();
        }
    }
    let place = PayloadPlace { joint: 5, link_from_payload: Pose::identity() };
    let unknowns = FreeUnknowns { payload: Some(place), ..free(&[FreeGroup::Payload]) };
    let found = identify(&collector.finish(), &unknowns).unwrap();
    let body = found.payload.unwrap();
    let found_center = body.inertia.first_moment_kg_m / body.inertia.mass_kg;
    assert!((body.inertia.mass_kg - mass_kg).abs() < 0.02, "{body:?}");
    assert!((found_center - center).norm() < 0.005, "{found_center}");
}
