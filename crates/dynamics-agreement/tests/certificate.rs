//! Certificates of the difference of torque: attained by a motion, never exceeded by any.

#![expect(clippy::print_stdout, reason = "measured values, for --nocapture")]

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

use congruent_description::{RobotQ, load_robot};
use congruent_dynamics::{BodyTree, JointMotionState, JointResistance};
use congruent_dynamics_agreement::{
    CoveredMotion, DynamicsModel, Inertial, NamedModel, TorqueBracket, TorqueCertificate, TorqueCertificates,
    certify,
};
use congruent_kinematics::Uniform;
use nalgebra::Vector3;

/// Rounding of a torque and of a bound, relative to the difference, and a thousandth of it to the torques themselves.
const ROUNDING: f64 = 1e-9;
/// Random motions that must stay below each bound.
const MOTIONS: usize = 20_000;

fn load(name: &str) -> DynamicsModel {
    let path = corpus::workspace().join("robots").join(name);
    DynamicsModel::new(&load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot)
}

fn parameters<'a>(model: &'a mut DynamicsModel, link: &str) -> &'a mut Inertial {
    let link = model.frames().find_link(link).expect("a link");
    model.inertials[link].as_mut().expect("an inertial")
}

fn certified(candidate: &DynamicsModel, reference: &DynamicsModel) -> TorqueCertificates {
    let description = |name, model| NamedModel { name, model, places: None };
    certify(&description("changed", candidate), &description("original", reference), 1).expect("one chain")
}

/// A motion of all joints.
struct Motion {
    q: RobotQ,
    qd: Vec<f64>,
    qdd: Vec<f64>,
}

fn torque(tree: &BodyTree, motion: &Motion) -> Vec<f64> {
    let mut tau = vec![0.0; tree.dof()];
    let motion = JointMotionState { q: &motion.q, qd: &motion.qd, qdd: &motion.qdd };
    tree.inverse_into(&motion, &mut tree.buffer(), &mut tau).expect("the robot's own motion");
    tau
}

/// The four parts of a torque.
fn parts(model: &DynamicsModel, motion: &Motion) -> [Vec<f64>; 4] {
    let zeros = vec![0.0; motion.qd.len()];
    let of = |tree: &BodyTree, qd: &[f64], qdd: &[f64]| {
        torque(tree, &Motion { q: motion.q.clone(), qd: qd.to_vec(), qdd: qdd.to_vec() })
    };
    let armature = |of: &JointResistance| JointResistance { damping: 0.0, friction: 0.0, ..*of };
    let armatures = model.resistances.iter().map(armature).collect();
    let whole = model.tree();
    let weightless = whole.clone().with_gravity(Vector3::zeros());
    let bare = weightless.clone().with_resistances(armatures).expect("one for each joint");
    [
        of(&whole, &zeros, &zeros),
        of(&bare, &zeros, &motion.qdd),
        of(&bare, &motion.qd, &zeros),
        of(&whole, &motion.qd, &motion.qdd),
    ]
}

fn certificates(all: &TorqueCertificates) -> [(&'static str, &TorqueCertificate); 4] {
    [
        ("gravity", &all.gravity),
        ("inertia", &all.inertia),
        ("velocity", &all.velocity),
        ("together", &all.together),
    ]
}

/// Speeds and accelerations mostly at their limits, where torques are large.
fn random_motion(random: &mut Uniform, covered: &[CoveredMotion]) -> Motion {
    let mut part = |of: &dyn Fn(&CoveredMotion) -> f64| -> Vec<f64> {
        let share = |random: &mut Uniform| (2.0 * random.between(-1.0, 1.0)).clamp(-1.0, 1.0);
        covered.iter().map(|covered| share(random) * of(covered)).collect()
    };
    let (qd, qdd) = (part(&|covered| covered.speed), part(&|covered| covered.acceleration));
    let q = covered.iter().map(|covered| random.between(covered.lower, covered.upper)).collect();
    Motion { q, qd, qdd }
}

fn check_attained(
    what: &str,
    part: usize,
    [candidate, reference]: [&DynamicsModel; 2],
    bracket: &TorqueBracket,
) {
    assert!(bracket.certified_n_m >= bracket.attained_n_m, "{what}: {bracket:?}");
    let motion = Motion { q: bracket.q.clone().into(), qd: bracket.qd.clone(), qdd: bracket.qdd.clone() };
    let joint = candidate.frames().find_joint(&bracket.joint).expect("a joint");
    let [found, expected] = [candidate, reference].map(|model| parts(model, &motion)[part][joint]);
    let error = ((found - expected).abs() - bracket.attained_n_m).abs();
    let size = ROUNDING * (bracket.attained_n_m + 1e-3 * (1.0 + found.abs() + expected.abs()));
    assert!(error <= size, "{what}: {} instead of {bracket:?}", found - expected);
}

fn check_sampled(what: &str, [candidate, reference]: [&DynamicsModel; 2], all: &TorqueCertificates) {
    let mut random = Uniform::seeded(7);
    let names: Vec<&str> = all.covered.iter().map(|covered| covered.joint.as_str()).collect();
    for _ in 0..MOTIONS / names.len() {
        let motion = random_motion(&mut random, &all.covered);
        let [found, expected] = [candidate, reference].map(|model| parts(model, &motion));
        for (part, (name, certificate)) in certificates(all).into_iter().enumerate() {
            for (joint, joint_name) in names.iter().enumerate() {
                let (a, b) = (found[part][joint], expected[part][joint]);
                let bracket = certificate.by_joint.iter().find(|bracket| bracket.joint == *joint_name);
                let bound = bracket.map_or(0.0, |bracket| bracket.certified_n_m);
                let slack = ROUNDING * (bound + 1e-3 * (1.0 + a.abs() + b.abs()));
                assert!(
                    (a - b).abs() <= bound + slack,
                    "{what}: {name} of {joint_name}: {} {bracket:?}",
                    a - b
                );
            }
        }
    }
}

fn check(what: &str, candidate: &DynamicsModel, reference: &DynamicsModel) -> TorqueCertificates {
    let all = certified(candidate, reference);
    for (part, (name, certificate)) in certificates(&all).into_iter().enumerate() {
        for bracket in &certificate.by_joint {
            check_attained(&format!("{what} {name}"), part, [candidate, reference], bracket);
            println!(
                "{what} {name} {}: {:.4} to {:.4}, ratio {:.3}, {} boxes",
                bracket.joint,
                bracket.attained_n_m,
                bracket.certified_n_m,
                bracket.certified_n_m / bracket.attained_n_m,
                bracket.boxes
            );
        }
    }
    check_sampled(what, [candidate, reference], &all);
    all
}

#[test]
fn no_motion_exceeds_what_is_certified() {
    for (robot, link) in [
        ("ur5e", "upper_arm_link"),
        ("ur5e", "forearm_link"),
        ("ur5e", "wrist_2_link"),
        ("ur5e", "wrist_3_link"),
        ("panda", "panda_link4"),
        ("panda", "panda_hand"),
    ] {
        let reference = load(robot);
        let mut candidate = reference.clone();
        let changed = parameters(&mut candidate, link);
        changed.mass_kg *= 1.2;
        changed.com_m.y += 0.02;
        changed.tensor_kg_m2 *= 1.3;
        let all = check(&format!("{robot} {link}"), &candidate, &reference);
        assert!(all.velocity.worst.is_some() && all.together.worst.is_some());
    }
}

#[test]
fn damping_friction_armature_and_gravity_are_in_it() {
    let reference = load("ur5e");
    let mut candidate = reference.clone();
    let elbow = candidate.frames().find_joint("elbow_joint").expect("a joint");
    candidate.resistances[elbow] = JointResistance { damping: 0.5, friction: 2.0, armature: 0.3 };
    let all = check("joint terms", &candidate, &reference);
    let [together] = &all.together.by_joint[..] else { panic!("{:?}", all.together) };
    let speed = all.covered[elbow].speed;
    let expected = 0.5 * speed + 2.0 + 0.3 * 10.0;
    assert!((together.attained_n_m - expected).abs() < 1e-9, "{together:?}, {expected} expected");
    assert!((together.certified_n_m - expected).abs() < 1e-9, "{together:?}, {expected} expected");
    // Friction against damping: the most is one of the two.
    candidate.resistances[elbow].damping = -0.5;
    candidate.accelerations.fill(Some(0.0));
    let all = check("friction against damping", &candidate, &reference);
    let [together] = &all.together.by_joint[..] else { panic!("{:?}", all.together) };
    assert!((together.certified_n_m - 2.0).abs() < 1e-9, "{together:?}");
    candidate = reference.clone();
    candidate.gravity_m_s2 = [0.0, -9.81, 0.0].into();
    let all = check("gravity", &candidate, &reference);
    assert!(all.inertia.worst.is_none() && all.velocity.worst.is_none());
    assert_eq!(all.together.by_joint.len(), all.gravity.by_joint.len());
    // With a fault of a link beside it.
    parameters(&mut candidate, "forearm_link").mass_kg *= 1.1;
    check("gravity and a link", &candidate, &reference);
}

#[test]
fn speeds_and_accelerations_are_those_that_are_stated() {
    let reference = load("ur5e");
    let mut candidate = reference.clone();
    candidate.limits[1].as_mut().expect("a limit").velocity = Some(180.0);
    candidate.limits[2].as_mut().expect("a limit").velocity = Some(0.0);
    candidate.accelerations[3] = Some(25.0);
    let mut other = reference.clone();
    other.limits[2].as_mut().expect("a limit").velocity = None;
    let all = certified(&candidate, &other);
    assert!((all.covered[1].speed - std::f64::consts::PI).abs() < 1e-9 && all.covered[1].speed_is_stated);
    assert!((all.covered[2].speed - 2.0).abs() < 1e-9 && !all.covered[2].speed_is_stated);
    let declared = all.covered.iter().map(|covered| covered.acceleration_is_declared);
    assert!((all.covered[3].acceleration - 25.0).abs() < 1e-9);
    assert_eq!(declared.collect::<Vec<bool>>(), [false, false, false, true, false, false]);
    assert!((all.covered[0].acceleration - 10.0).abs() < 1e-9);
    assert!(all.together.worst.is_none());
}

#[test]
fn fingers_that_follow_each_other_are_one_joint() {
    let reference = load("panda");
    let mut candidate = reference.clone();
    parameters(&mut candidate, "panda_rightfinger").mass_kg *= 2.0;
    let all = certified(&candidate, &reference);
    let [driven, follower] = ["panda_finger_joint1", "panda_finger_joint2"]
        .map(|joint| candidate.frames().find_joint(joint).expect("a joint"));
    for (part, (name, certificate)) in certificates(&all).into_iter().enumerate() {
        for bracket in &certificate.by_joint {
            assert_ne!(bracket.joint, "panda_finger_joint2", "{name}: it is not driven");
            let pairs = [&bracket.q, &bracket.qd, &bracket.qdd].map(|of| (of[driven] - of[follower]).abs());
            assert!(pairs.iter().all(|apart| *apart < 1e-12), "{name}: {bracket:?}");
            // The drive of the fingers feels both.
            let at = Motion { q: bracket.q.clone().into(), qd: bracket.qd.clone(), qdd: bracket.qdd.clone() };
            let joint = candidate.frames().find_joint(&bracket.joint).expect("a joint");
            let [found, expected] = [&candidate, &reference].map(|model| {
                let tau = &parts(model, &at)[part];
                tau[joint] + if joint == driven { tau[follower] } else { 0.0 }
            });
            let error = ((found - expected).abs() - bracket.attained_n_m).abs();
            assert!(
                error <= ROUNDING * (1.0 + bracket.attained_n_m),
                "{name}: {} {bracket:?}",
                found - expected
            );
            assert!(
                bracket.attained_n_m > 0.0 && bracket.certified_n_m >= bracket.attained_n_m,
                "{bracket:?}"
            );
        }
        assert!(certificate.by_joint.iter().any(|bracket| bracket.joint == "panda_finger_joint1"), "{name}");
    }
    check_followed([&candidate, &reference], &all, (driven, follower));
}

/// Random motions in which the second finger follows the first stay below every bound.
fn check_followed(
    [candidate, reference]: [&DynamicsModel; 2],
    all: &TorqueCertificates,
    (driven, follower): (usize, usize),
) {
    let mut random = Uniform::seeded(11);
    for _ in 0..MOTIONS / 10 {
        let mut motion = random_motion(&mut random, &all.covered);
        motion.q[follower] = motion.q[driven];
        motion.qd[follower] = motion.qd[driven];
        motion.qdd[follower] = motion.qdd[driven];
        let [found, expected] = [candidate, reference].map(|model| parts(model, &motion));
        for (part, (name, certificate)) in certificates(all).into_iter().enumerate() {
            for bracket in &certificate.by_joint {
                let joint = candidate.frames().find_joint(&bracket.joint).expect("a joint");
                let at = |tau: &[f64]| tau[joint] + if joint == driven { tau[follower] } else { 0.0 };
                let difference = at(&found[part]) - at(&expected[part]);
                let slack = ROUNDING * (1.0 + bracket.certified_n_m);
                assert!(
                    difference.abs() <= bracket.certified_n_m + slack,
                    "{name}: {difference} {bracket:?}"
                );
            }
        }
    }
}
