//! The benchmark: every cause planted at every link, several links, joints and gravity, in both directions.

#![expect(clippy::print_stdout, reason = "measured values, for --nocapture")]

#[path = "../../../../tests/corpus.rs"]
mod corpus;

use congruent_description::{Elementary as _, load_robot};
use nalgebra::{DVector, Vector3};

use super::{
    cause,
    cause_names::DynamicsCause,
    diagnose::{Diagnosed, Expected, Grouped, Setting, diagnose_in_stages},
    free::Free,
    hypothesis::{Change, FaultySide, Hypothesis, Place},
};
use crate::{
    side::{Inertial, JointTerm, Side},
    thresholds::{Precision, STATES},
    torque::{
        compressed::{Compressed, torques},
        states::{State, random_states},
    },
};

/// A fault: what the wrong side says.
struct Planted {
    cause: DynamicsCause,
    detail: String,
    place: Place,
    side: Side,
}

fn planted(original: &Side) -> Vec<Planted> {
    let slips = cause::slips(&original.frames, FaultySide::Reference);
    let mut hypotheses = cause::of_all_links(original, &slips);
    hypotheses.extend(cause::of_two_links(original, FaultySide::Reference));
    hypotheses.extend(cause::of_joints_and_gravity(original, FaultySide::Reference));
    for link in 0..original.inertials.len() {
        if original.frames.links[link].body.is_some() {
            hypotheses.extend(cause::of_link(original, None, FaultySide::Reference, &slips, link));
        }
    }
    hypotheses.iter().filter_map(|hypothesis| plant(original, hypothesis)).collect()
}

/// What a hypothesis would make of a side; free numbers get values that no slip has.
fn plant(original: &Side, hypothesis: &Hypothesis) -> Option<Planted> {
    let mut side = original.clone();
    match &hypothesis.change {
        Change::Links(links) => {
            for (link, parameters) in links {
                side.inertials[*link] = Some(*parameters);
            }
        }
        Change::FreeLink { link, free } | Change::FreeLinkFrom { link, free, .. } => {
            let parameters = side.inertials[*link]?;
            side.inertials[*link] = Some(shifted(&parameters, *free));
        }
        Change::FreeScale(scale) => {
            let links = side.inertials.iter_mut().flatten();
            links.for_each(|parameters| *parameters = scale.scaled(parameters, 1.137));
        }
        Change::Joints(joints) => side.resistances.clone_from(joints),
        Change::FreeJoints { term, groups } => {
            for (at, group) in groups.iter().enumerate() {
                for &joint in group {
                    let by = 0.037 * (1.0 + 0.3 * f64::from(u32::try_from(at).ok()?));
                    let value = term.of(&side.resistances[joint]) + by;
                    JointTerm::set(*term, &mut side.resistances[joint], value);
                }
            }
        }
        Change::Gravity(gravity) => side.gravity_m_s2 = *gravity,
        Change::FreeGravity(along) if along.len() == 1 => side.gravity_m_s2 *= 1.013,
        Change::FreeGravity(_) => {
            let turn = congruent_kinematics::rotation_exp(&Vector3::new(0.05, 0.02, 0.0));
            side.gravity_m_s2 = turn * side.gravity_m_s2;
        }
    }
    let (cause, detail) = (hypothesis.cause, hypothesis.detail.clone());
    Some(Planted { cause, detail, place: hypothesis.place.clone(), side })
}

fn shifted(parameters: &Inertial, free: Free) -> Inertial {
    let size = parameters.tensor_kg_m2.trace();
    let lengths = Vector3::new(0.013, -0.021, 0.008);
    let entries = [0.31, 0.02, -0.03, 0.23, 0.05, 0.17].map(|share| share * size);
    let x: Vec<f64> = match free {
        Free::Mass => vec![-0.3 * parameters.mass_kg],
        Free::Density => vec![0.2],
        Free::InertiaScale => vec![0.5],
        Free::ComEntry(axis) => vec![lengths[axis]],
        Free::Com => lengths.as_slice().to_vec(),
        Free::InertiaEntry(row, column) => vec![if row == column { 0.1 * size } else { 0.03 * size }],
        Free::Products => entries[1..4].to_vec(),
        Free::Inertia => entries.to_vec(),
        Free::Inertial => {
            let mass = 0.4 * parameters.mass_kg;
            let moved = Inertial { mass_kg: mass, com_m: parameters.com_m + lengths, ..*parameters };
            let numbers: Vec<f64> = moved.ten_numbers().iter().copied().collect();
            numbers
        }
        Free::Payload => vec![0.15, 0.02, -0.01, 0.06],
        Free::Rotation(_) => vec![0.3, -0.2, 0.4],
    };
    free.parameters(parameters, &x)
}

/// The original with both faults of two, the second one at a link.
fn with_both(a: &Planted, b: &Planted) -> Side {
    let mut side = a.side.clone();
    if let Place::Links(links) = &b.place {
        side.inertials[links[0]] = b.side.inertials[links[0]];
    }
    side
}

/// What is missing at all links of a file at once has no answer: zeros tell nothing.
fn can_be_told(planted: &Planted, faulty: FaultySide) -> bool {
    let loses_numbers = matches!(
        planted.cause,
        DynamicsCause::ComMissing
            | DynamicsCause::ProductsMissing
            | DynamicsCause::InertiaMissing
            | DynamicsCause::InertialLeftOut
            | DynamicsCause::InertiaPlaceholder
            | DynamicsCause::RpyMissing
    ) || planted.detail == "row_major_upper";
    faulty == FaultySide::Reference || planted.place != Place::AllLinks || !loses_numbers
}

/// Faults whose file says the same under another name.
fn is_name_of(planted: &Planted, cause: DynamicsCause, faulty: FaultySide) -> bool {
    let file = faulty == FaultySide::Candidate;
    cause == planted.cause
        || matches!(
            (planted.cause, cause),
            (DynamicsCause::InertialLeftOut, DynamicsCause::InertialMissing | DynamicsCause::Inertial | DynamicsCause::InertiaMissing) if file
        )
        || matches!(
            (planted.cause, cause),
            (DynamicsCause::RpyMissing, DynamicsCause::PrincipalAxesMissing | DynamicsCause::InertiaRotation) if file
        )
        || matches!(
            (planted.cause, cause),
            (DynamicsCause::DampingMissing | DynamicsCause::JointTermsMissing | DynamicsCause::DampingDefault | DynamicsCause::FrictionAsDamping, DynamicsCause::Damping) if file
        )
        || matches!(
            (planted.cause, cause),
            (DynamicsCause::FrictionMissing | DynamicsCause::JointTermsMissing | DynamicsCause::FrictionAsDamping, DynamicsCause::Friction) if file
        )
        || matches!((planted.cause, cause), (DynamicsCause::DampingDefault, DynamicsCause::DampingMissing) if !file)
}

fn names(planted: &Planted, grouped: &Grouped, faulty: FaultySide) -> bool {
    let also = grouped.also.iter();
    std::iter::once(&grouped.named).chain(also).any(|exact| {
        exact.parts.iter().any(|part| {
            is_name_of(planted, part.hypothesis.cause, faulty) && part.hypothesis.place == planted.place
        })
    })
}

#[derive(Debug, Default)]
struct Counts {
    faults: usize,
    named: usize,
    listed: usize,
    hidden: usize,
    other: usize,
    missed: usize,
}

fn diagnosed((candidate, faulty): (&Side, FaultySide), states: &[State], expected: &[Vec<f64>]) -> Diagnosed {
    let torque = Compressed::new(candidate, states, expected).expect("the robot's own states");
    let setting = Setting { candidate, reference: None, faulty, precision: Precision::EXACT, pairs: true };
    let expected = Expected { states, torques: expected };
    diagnose_in_stages(&setting, &torque, expected).expect("the robot's own states")
}

/// The parts of what is named, its price and whether it is no body.
type FirstNamed = (Vec<(DynamicsCause, Place)>, f64, bool);

fn first_named(explanations: &[Grouped]) -> Option<FirstNamed> {
    let named = &explanations.first()?.named;
    let parts = named.parts.iter();
    let parts = parts.map(|part| (part.hypothesis.cause, part.hypothesis.place.clone())).collect();
    Some((parts, named.price, named.law_broken.is_some()))
}

/// Whether torque shows a fault.
fn is_seen(original: &Side, planted: &Planted) -> bool {
    let states = random_states(&original.frames, 1, STATES);
    let torque = torques(&planted.side, &states).expect("the robot's own states");
    let torque = Compressed::new(original, &states, &torque).expect("the robot's own states");
    torque.difference.norm().hypotenuse_with(torque.outside) > Precision::EXACT.same * torque.torques
}

fn judged(original: &Side, planted: &Planted, faulty: FaultySide, counts: &mut Counts) {
    let (candidate, reference) = match faulty {
        FaultySide::Candidate => (&planted.side, original),
        FaultySide::Reference => (original, &planted.side),
    };
    let states = random_states(&candidate.frames, 1, STATES);
    let torque = torques(reference, &states).expect("the robot's own states");
    let Diagnosed { same, explanations, .. } = diagnosed((candidate, faulty), &states, &torque);
    let torque = Compressed::new(candidate, &states, &torque).expect("the robot's own states");
    counts.faults += 1;
    let first = explanations.first();
    if same {
        counts.hidden += 1;
    } else if first.is_some_and(|grouped| names(planted, grouped, faulty)) {
        counts.named += 1;
    } else if explanations.iter().any(|grouped| names(planted, grouped, faulty)) {
        counts.listed += 1;
    } else {
        let found = first_named(&explanations);
        let relative = DVector::norm(&torque.difference) / torque.torques;
        println!(
            "{faulty:?} {:?} {} {:?}: {found:?} of {}, {relative:.1e}, {:.1e}",
            planted.cause,
            planted.detail,
            planted.place,
            explanations.len(),
            torque.outside / torque.torques,
        );
        if explanations.is_empty() {
            counts.missed += 1;
        } else {
            counts.other += 1;
        }
    }
}

fn bench(name: &str, sides: &[FaultySide]) -> Vec<Counts> {
    let Some(corpus) = corpus::corpus() else { return Vec::new() };
    let path = corpus.join("robots").join(name).join("robot.urdf");
    let robot = load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot;
    let original = Side::new(&robot);
    let faults = planted(&original);
    let count = |&faulty: &FaultySide| {
        let mut counts = Counts::default();
        for planted in faults.iter().filter(|planted| can_be_told(planted, faulty)) {
            judged(&original, planted, faulty, &mut counts);
        }
        println!("{name} {faulty:?}: {counts:?}");
        counts
    };
    sides.iter().map(count).collect()
}

/// Every cause at every link of a small robot: nothing is missed.
#[test]
fn every_cause_is_found_on_a_small_robot() {
    for counts in bench("denso_hsr065", &[FaultySide::Candidate, FaultySide::Reference]) {
        assert_eq!((counts.missed, counts.other), (0, 0), "{counts:?}");
        assert!(counts.faults > 100);
    }
}

#[test]
#[ignore = "a benchmark of thousands of faults: run it after a change of thresholds or causes"]
fn every_cause_is_found_on_many_robots() {
    for name in ["ur5e", "iiwa14", "panda", "so100", "rrr_arm"] {
        for counts in bench(name, &[FaultySide::Candidate, FaultySide::Reference]) {
            assert_eq!(counts.missed, 0, "{name}: {counts:?}");
        }
    }
}

/// Two faults on links of different bodies, in the file.
fn two_at_once(original: &Side, faults: &[Planted]) -> Vec<[usize; 2]> {
    let body = |at: usize| match &faults[at].place {
        Place::Links(links) if links.len() == 1 => original.frames.links[links[0]].body,
        _ => None,
    };
    let at_links: Vec<usize> = (0..faults.len()).filter(|at| body(*at).is_some()).collect();
    let mut random = congruent_kinematics::Uniform::seeded(1);
    let count = f64::from(u32::try_from(at_links.len()).expect("some hundred"));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the count")]
    let mut one = || at_links[random.between((0.0, count)).floor().min(count - 1.0) as usize];
    let pairs = std::iter::repeat_with(|| [one(), one()]);
    pairs.filter(|[a, b]| body(*a) != body(*b)).take(PAIRS).collect()
}

/// Pairs of faults for each robot.
const PAIRS: usize = 150;

#[test]
#[ignore = "a benchmark of hundreds of pairs of faults: run it after a change of thresholds or causes"]
fn two_faults_at_once_are_found() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ["ur5e", "iiwa14", "panda", "so100", "rrr_arm"] {
        let path = corpus.join("robots").join(name).join("robot.urdf");
        let robot = load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot;
        let original = Side::new(&robot);
        let mut faults = planted(&original);
        // A fault that torque does not show leaves the other one.
        faults.retain(|planted| can_be_told(planted, FaultySide::Candidate) && is_seen(&original, planted));
        let mut counts = [0; 4];
        for pair in two_at_once(&original, &faults) {
            let [a, b] = pair.map(|at| &faults[at]);
            let side = with_both(a, b);
            let states = random_states(&side.frames, 1, STATES);
            let torque = torques(&original, &states).expect("the robot's own states");
            let faulty = FaultySide::Candidate;
            let explanations = diagnosed((&side, faulty), &states, &torque).explanations;
            let names_one = |grouped: &Grouped| names(a, grouped, faulty) || names(b, grouped, faulty);
            let names_both = |grouped: &Grouped| names(a, grouped, faulty) && names(b, grouped, faulty);
            let found = match explanations.first() {
                Some(first) if names_both(first) => 0,
                Some(_) if explanations.iter().any(names_both) => 1,
                Some(_) if explanations.iter().any(names_one) => 2,
                _ => 3,
            };
            counts[found] += 1;
            if found > 1 {
                let at = |of: &Planted| (of.cause, of.detail.clone(), of.place.clone());
                println!("{name}: {:?} and {:?}: {:?}", at(a), at(b), first_named(&explanations));
            }
        }
        let [named, listed, one, missed] = counts;
        println!("{name}: both named {named}, listed {listed}, one of them {one}, none {missed}");
        assert!(missed * 30 <= PAIRS, "{name}: {missed}");
    }
}
