//! The benchmark: every cause planted at every link, several links, joints and gravity, in both directions.

#![expect(clippy::print_stdout, reason = "measured values, for --nocapture")]

#[path = "../../../../tests/support/corpus.rs"]
mod corpus;

use congruent_description::load_robot;
use nalgebra::{DVector, Vector3};

use super::{
    cause,
    cause_names::DynamicsCause,
    diagnose::{Diagnosed, DiagnosisInput, ExplanationGroup, ReferenceTorques, diagnose_in_stages},
    free::FreeParameters,
    hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide},
};
use crate::{
    model::{DynamicsModel, Inertial, JointTerm},
    thresholds::{Precision, STATES},
    torque::{
        reduced_difference::{ReducedTorqueDifference, torques},
        states::{SampledState, random_states},
    },
};

/// A planted fault: the wrong model, with the cause and place of the fault.
struct Planted {
    cause: DynamicsCause,
    detail: String,
    place: DynamicsPlace,
    model: DynamicsModel,
}

fn planted(original: &DynamicsModel) -> Vec<Planted> {
    let mistakes = cause::mistakes(&original.frames, FaultySide::Reference);
    let mut hypotheses = cause::all_links_hypotheses(original, &mistakes);
    hypotheses.extend(cause::two_link_hypotheses(original, FaultySide::Reference));
    hypotheses.extend(cause::joint_and_gravity_hypotheses(original, FaultySide::Reference));
    for link in 0..original.inertials.len() {
        if original.frames.links[link].body.is_some() {
            hypotheses.extend(cause::link_hypotheses(original, None, FaultySide::Reference, &mistakes, link));
        }
    }
    hypotheses.iter().filter_map(|hypothesis| plant(original, hypothesis)).collect()
}

/// The model with the fault of a hypothesis; free parameters get values that no mistake without free parameters has.
fn plant(original: &DynamicsModel, hypothesis: &DynamicsHypothesis) -> Option<Planted> {
    let mut model = original.clone();
    match &hypothesis.change {
        Change::Links(links) => {
            for (link, parameters) in links {
                model.inertials[*link] = Some(*parameters);
            }
        }
        Change::FreeLink { link, free } | Change::FreeLinkFrom { link, free, .. } => {
            let parameters = model.inertials[*link]?;
            model.inertials[*link] = Some(shifted(&parameters, *free));
        }
        Change::FreeScale(scale) => {
            let links = model.inertials.iter_mut().flatten();
            links.for_each(|parameters| *parameters = scale.scaled(parameters, 1.137));
        }
        Change::Joints(joints) => model.resistances.clone_from(joints),
        Change::FreeJoints { term, groups } => {
            for (at, group) in groups.iter().enumerate() {
                for &joint in group {
                    let by = 0.037 * (1.0 + 0.3 * f64::from(u32::try_from(at).ok()?));
                    let value = term.value_in(&model.resistances[joint]) + by;
                    JointTerm::set(*term, &mut model.resistances[joint], value);
                }
            }
        }
        Change::Gravity(gravity) => model.gravity_m_s2 = *gravity,
        Change::FreeGravity(along) if along.len() == 1 => model.gravity_m_s2 *= 1.013,
        Change::FreeGravity(_) => {
            let turn = congruent_kinematics::rotation_exp(&Vector3::new(0.05, 0.02, 0.0));
            model.gravity_m_s2 = turn * model.gravity_m_s2;
        }
    }
    let (cause, detail) = (hypothesis.cause, hypothesis.detail.clone());
    Some(Planted { cause, detail, place: hypothesis.place.clone(), model })
}

fn shifted(parameters: &Inertial, free: FreeParameters) -> Inertial {
    let size = parameters.tensor_kg_m2.trace();
    let lengths = Vector3::new(0.013, -0.021, 0.008);
    let entries = [0.31, 0.02, -0.03, 0.23, 0.05, 0.17].map(|share| share * size);
    let x: Vec<f64> = match free {
        FreeParameters::Mass => vec![-0.3 * parameters.mass_kg],
        FreeParameters::Density => vec![0.2],
        FreeParameters::InertiaScale => vec![0.5],
        FreeParameters::ComEntry(axis) => vec![lengths[axis]],
        FreeParameters::Com => lengths.as_slice().to_vec(),
        FreeParameters::InertiaEntry(row, column) => {
            vec![if row == column { 0.1 * size } else { 0.03 * size }]
        }
        FreeParameters::Products => entries[1..4].to_vec(),
        FreeParameters::Inertia => entries.to_vec(),
        FreeParameters::Inertial => {
            let mass = 0.4 * parameters.mass_kg;
            let moved = Inertial { mass_kg: mass, com_m: parameters.com_m + lengths, ..*parameters };
            let numbers: Vec<f64> = moved.ten_numbers().iter().copied().collect();
            numbers
        }
        FreeParameters::Payload => vec![0.15, 0.02, -0.01, 0.06],
        FreeParameters::Rotation(_) => vec![0.3, -0.2, 0.4],
    };
    free.parameters(parameters, &x)
}

/// The original with both faults of two, the second one at a link.
fn with_both(a: &Planted, b: &Planted) -> DynamicsModel {
    let mut model = a.model.clone();
    if let DynamicsPlace::Links(links) = &b.place {
        model.inertials[links[0]] = b.model.inertials[links[0]];
    }
    model
}

/// Whether a fault is distinguishable: if all links of a file lack a parameter, the zeros are no evidence.
fn is_distinguishable(planted: &Planted, faulty: FaultySide) -> bool {
    let loses_numbers = matches!(
        planted.cause,
        DynamicsCause::ComMissing
            | DynamicsCause::ProductsMissing
            | DynamicsCause::InertiaMissing
            | DynamicsCause::InertialLeftOut
            | DynamicsCause::InertiaPlaceholder
            | DynamicsCause::RpyMissing
    ) || planted.detail == "row_major_upper";
    faulty == FaultySide::Reference || planted.place != DynamicsPlace::AllLinks || !loses_numbers
}

/// Whether another cause is a name of the same change of the file.
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

fn names(planted: &Planted, grouped: &ExplanationGroup, faulty: FaultySide) -> bool {
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

fn diagnosed(
    (candidate, faulty): (&DynamicsModel, FaultySide),
    states: &[SampledState],
    expected: &[Vec<f64>],
) -> Diagnosed {
    let torque = ReducedTorqueDifference::new(candidate, states, expected).expect("the robot's own states");
    let setting = DiagnosisInput {
        candidate,
        reference: None,
        faulty,
        precision: Precision::EXACT,
        pairs: true,
        unstated: &[],
        known: None,
    };
    let expected = ReferenceTorques { states, torques: expected };
    diagnose_in_stages(&setting, &torque, expected).expect("the robot's own states")
}

/// The parts of the first explanation, its complexity, and whether it is physically impossible.
type FirstNamed = (Vec<(DynamicsCause, DynamicsPlace)>, f64, bool);

fn first_named(explanations: &[ExplanationGroup]) -> Option<FirstNamed> {
    let named = &explanations.first()?.named;
    let parts = named.parts.iter();
    let parts = parts.map(|part| (part.hypothesis.cause, part.hypothesis.place.clone())).collect();
    Some((parts, named.complexity, named.law_broken.is_some()))
}

/// Whether a fault changes joint torques.
fn changes_torques(original: &DynamicsModel, planted: &Planted) -> bool {
    let states = random_states(&original.frames, 1, STATES);
    let torque = torques(&planted.model, &states).expect("the robot's own states");
    let torque = ReducedTorqueDifference::new(original, &states, &torque).expect("the robot's own states");
    libm::hypot(torque.difference.norm(), torque.outside) > Precision::EXACT.same * torque.torques
}

fn count_outcome(original: &DynamicsModel, planted: &Planted, faulty: FaultySide, counts: &mut Counts) {
    let (candidate, reference) = match faulty {
        FaultySide::Candidate => (&planted.model, original),
        FaultySide::Reference => (original, &planted.model),
    };
    let states = random_states(&candidate.frames, 1, STATES);
    let torque = torques(reference, &states).expect("the robot's own states");
    let Diagnosed { same, explanations, .. } = diagnosed((candidate, faulty), &states, &torque);
    let torque = ReducedTorqueDifference::new(candidate, &states, &torque).expect("the robot's own states");
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
    let original = DynamicsModel::new(&robot);
    let faults = planted(&original);
    let count = |&faulty: &FaultySide| {
        let mut counts = Counts::default();
        for planted in faults.iter().filter(|planted| is_distinguishable(planted, faulty)) {
            count_outcome(&original, planted, faulty, &mut counts);
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
fn two_at_once(original: &DynamicsModel, faults: &[Planted]) -> Vec<[usize; 2]> {
    let body = |at: usize| match &faults[at].place {
        DynamicsPlace::Links(links) if links.len() == 1 => original.frames.links[links[0]].body,
        _ => None,
    };
    let at_links: Vec<usize> = (0..faults.len()).filter(|at| body(*at).is_some()).collect();
    let mut random = congruent_kinematics::Uniform::seeded(1);
    let count = f64::from(u32::try_from(at_links.len()).expect("some hundred"));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the count")]
    let mut one = || at_links[random.between(0.0, count).floor().min(count - 1.0) as usize];
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
        let original = DynamicsModel::new(&robot);
        let mut faults = planted(&original);
        // A fault that torque does not show does not hide the other one.
        faults.retain(|planted| {
            is_distinguishable(planted, FaultySide::Candidate) && changes_torques(&original, planted)
        });
        let mut counts = [0; 4];
        for pair in two_at_once(&original, &faults) {
            let [a, b] = pair.map(|at| &faults[at]);
            let model = with_both(a, b);
            let states = random_states(&model.frames, 1, STATES);
            let torque = torques(&original, &states).expect("the robot's own states");
            let faulty = FaultySide::Candidate;
            let explanations = diagnosed((&model, faulty), &states, &torque).explanations;
            let names_one =
                |grouped: &ExplanationGroup| names(a, grouped, faulty) || names(b, grouped, faulty);
            let names_both =
                |grouped: &ExplanationGroup| names(a, grouped, faulty) && names(b, grouped, faulty);
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
