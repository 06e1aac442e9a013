//! Two descriptions of one robot against each other.

use congruent_dynamics::DynamicsError;
use nalgebra::Matrix3;

use super::{
    compare_long::compare_long,
    content::{DynamicsPremise, DynamicsReport, DynamicsVerdict, Sides, TorqueCertificates},
    link_by_link::{is_simpler, link_by_link},
    places::Files,
    told::{NamedSide, Told},
};
use crate::{
    bound,
    compare::{hidden, invariants::invariants, limits},
    diagnosis::{Expected, FaultySide, Setting},
    side::{Inertial, JointTerm, Side},
    thresholds::{INVARIANT_STATES, MOST_JOINTS, Precision, STATES},
    torque::{
        compressed::{Compressed, torques},
        states::random_states,
    },
};

/// Why two descriptions cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// A joint of one is missing in the other: they are not the same chain.
    #[error("joint \"{joint}\" is in one of the two descriptions only")]
    Joint {
        /// The joint.
        joint: String,
    },
    /// Nothing moves.
    #[error("no joint moves: there is no joint torque to compare")]
    NoJoint,
    /// The comparison would take too long.
    #[error(
        "{joints} joints move, and what joint torques tell is compared for at most {MOST_JOINTS}: it takes a time that grows with their cube"
    )]
    TooManyJoints {
        /// How many.
        joints: usize,
    },
    /// A parameter is no number, or so large that torques overflow.
    #[error(
        "{what} = {value:e} is not finite, or beyond what torques can be computed with ({LARGEST_NUMBER:e})"
    )]
    NotFinite {
        /// Which one, of which link or joint.
        what: String,
        /// Its value, SI units.
        value: f64,
    },
    /// The source of accelerations failed.
    #[error("the source of accelerations: {message}")]
    Source {
        /// What it said.
        message: String,
    },
    /// A vector is another robot's.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
}

/// Compares two descriptions of the same chain at seeded random states.
///
/// Links and joints are matched by name; frames of equal name must be equal, which is the question of the kinematic
/// comparison before this one.
///
/// Of more than 60 joints no cause is searched: the report has the difference of torques and the parameters that differ.
///
/// # Errors
/// [`CompareError`] if a joint is missing in one of them, or if parameters are not finite.
///
/// # Examples
/// A mass that is given in grams:
/// ```
/// use congruent_description::parse_urdf;
/// use congruent_dynamics_agreement::{DynamicsCause, NamedSide, Side, compare};
/// let rod = |mass: &str| {
///     let text = format!(r#"<robot name="rod"><link name="base"/>
///     <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="{mass}"/>
///       <inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
///     <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
///     </robot>"#);
///     Side::new(&parse_urdf(&text).unwrap())
/// };
/// let (wrong, right) = (rod("2000"), rod("2"));
/// let description = |name, side| NamedSide { name, side, places: None };
/// let report = compare(&description("wrong", &wrong), &description("right", &right), 1)?;
/// assert_eq!(report.explanations[0].cause, DynamicsCause::MassUnit);
/// assert_eq!(report.explanations[0].sentence(), "rod: the mass is given in another unit (g)");
/// # Ok::<(), congruent_dynamics_agreement::CompareError>(())
/// ```
pub fn compare(
    candidate: &NamedSide<'_>,
    reference: &NamedSide<'_>,
    seed: u64,
) -> Result<DynamicsReport, CompareError> {
    let joints = comparable(candidate.side, reference.side)?;
    let seen_as_candidate = in_geometry_of(candidate.side, reference.side, &joints);
    let states = random_states(&candidate.side.frames, seed, STATES);
    let expected = torques(&seen_as_candidate, &states)?;
    if joints.len() > MOST_JOINTS {
        let of_states = (states.as_slice(), expected.as_slice());
        return Ok(compare_long((candidate, reference), (&seen_as_candidate, &joints), of_states)?);
    }
    let torque = Compressed::new(candidate.side, &states, &expected)?;
    let setting = Setting {
        candidate: candidate.side,
        reference: Some(reference.side),
        faulty: FaultySide::Candidate,
        precision: Precision::EXACT,
        pairs: false,
    };
    let files = Files { found: candidate.places, expected: reference.places };
    let expected = Expected { states: &states, torques: &expected };
    let sides = (reference.side, &seen_as_candidate);
    let mut told = told(&setting, files, sides, (&torque, expected))?;
    // What names a parameter that both files have alike is no explanation.
    told.explanations.retain(|explanation| !explanation.contradicted);
    let mut differences = hidden::differences(candidate.side, reference.side);
    files.place(&mut differences);
    // Where all torques are the same, every difference is one that they do not tell.
    let not_told = if told.same { f64::INFINITY } else { Precision::EXACT.of_torque };
    let mut hidden_differences = hidden::without_effect(candidate.side, reference.side, &torque, not_told);
    files.place(&mut hidden_differences);
    let mut limits = limits::differences(candidate.side, reference.side, &joints);
    files.place_limits(&mut limits);
    let verdict = if told.same && differences.is_empty() { DynamicsVerdict::Same } else { told.verdict() };
    let tree = seen_as_candidate.tree().without_resistances();
    Ok(DynamicsReport {
        sides: Sides {
            candidate: candidate.name.to_owned(),
            reference: reference.name.to_owned(),
            faulty: setting.faulty,
        },
        verdict,
        difference_relative: torque.relative_difference(),
        premise: DynamicsPremise {
            fit_relative: torque.outside / torque.torques,
            held_out_relative: None,
            states: states.len(),
        },
        seen: Some(torque.seen),
        invariants: Some(invariants([candidate.side, reference.side], &tree, &states[..INVARIANT_STATES])?),
        links: told.links,
        differences,
        hidden_differences,
        explanations: told.explanations,
        indistinguishable: told.indistinguishable,
        limits,
        certificates: None,
    })
}

/// The diagnosis, with pairs of faults or link by link where one fault alone is no explanation.
fn told(
    setting: &Setting<'_>,
    files: Files<'_>,
    sides: (&Side, &Side),
    (torque, expected): (&Compressed, Expected<'_>),
) -> Result<Told, CompareError> {
    let mut told = Told::new(setting, files, torque, expected)?;
    // A slip without a free number is taken at its word.
    if told.explanations.first().map_or(!told.same, |first| first.contradicted || first.numbers > 0.0) {
        let by_link = link_by_link(setting, files, sides, (torque, expected.states))?;
        if by_link.is_empty() {
            told = Told::new(&Setting { pairs: true, ..*setting }, files, torque, expected)?;
        } else if is_simpler(&by_link, &told.explanations) {
            told.explanations = by_link;
            told.indistinguishable.clear();
        }
    }
    Ok(told)
}

/// Brackets the largest differences of torque between two descriptions of the same chain: seconds for a long arm.
///
/// # Errors
/// As [`compare`], or [`CompareError::TooManyJoints`].
pub fn certify(
    candidate: &NamedSide<'_>,
    reference: &NamedSide<'_>,
    seed: u64,
) -> Result<TorqueCertificates, CompareError> {
    let joints = comparable(candidate.side, reference.side)?;
    check_count(joints.len())?;
    let reference = in_geometry_of(candidate.side, reference.side, &joints);
    let certified = bound::certify(candidate.side, &reference, seed)?;
    Ok(TorqueCertificates {
        gravity: certified.gravity,
        inertia: certified.inertia,
        velocity: certified.velocity,
        together: certified.together,
        covered: certified.covered,
    })
}

/// For each joint of the candidate the reference's of that name, if torques can be computed at all.
fn comparable(candidate: &Side, reference: &Side) -> Result<Vec<usize>, CompareError> {
    let joints = matched(candidate, reference)?;
    if joints.is_empty() {
        return Err(CompareError::NoJoint);
    }
    [candidate, reference].into_iter().try_for_each(check_numbers)?;
    Ok(joints)
}

/// Refuses a robot on which nothing moves, or too much.
pub(super) fn check_count(joints: usize) -> Result<(), CompareError> {
    match joints {
        0 => Err(CompareError::NoJoint),
        1..=MOST_JOINTS => Ok(()),
        _ => Err(CompareError::TooManyJoints { joints }),
    }
}

fn matched(candidate: &Side, reference: &Side) -> Result<Vec<usize>, CompareError> {
    let missing = |joint: &str| CompareError::Joint { joint: joint.to_owned() };
    for joint in &reference.frames.joints {
        candidate.frames.find_joint(&joint.name).ok_or_else(|| missing(&joint.name))?;
    }
    let place = |name: &str| reference.frames.find_joint(name).ok_or_else(|| missing(name));
    candidate.frames.joints.iter().map(|joint| place(&joint.name)).collect()
}

/// Larger parameters overflow in squares of torques. Kind: range of numbers.
const LARGEST_NUMBER: f64 = 1e60;

/// Refuses the first parameter that torques cannot be computed with.
pub(super) fn check_numbers(side: &Side) -> Result<(), CompareError> {
    let joints = side.resistances.iter().enumerate().flat_map(|(joint, of)| {
        let name = side.frames.joint_name(joint);
        JointTerm::ALL.map(|term| (format!("joint \"{name}\": {}", term.name()), term.of(of)))
    });
    let links = side.inertials.iter().enumerate().filter_map(|(link, of)| Some((link, of.as_ref()?)));
    let inertials = links.flat_map(|(link, of)| {
        let name = side.frames.link_name(link);
        let all = [
            ("mass", of.mass_kg),
            ("centre of mass", of.com_m.amax()),
            ("inertia", of.tensor_kg_m2.amax()),
            ("mass times the square of its distance", of.shift().amax()),
        ];
        all.map(|(what, value)| (format!("link \"{name}\": {what}"), value))
    });
    let gravity = std::iter::once(("gravity".to_owned(), side.gravity_m_s2.amax()));
    let mut all = joints.chain(inertials).chain(gravity);
    match all.find(|(_, value)| value.is_nan() || value.abs() >= LARGEST_NUMBER) {
        Some((what, value)) => Err(CompareError::NotFinite { what, value }),
        None => Ok(()),
    }
}

/// The parameters of a reference in a candidate's geometry: one inertial for each body, at the link that its joint carries.
fn in_geometry_of(candidate: &Side, reference: &Side, joints: &[usize]) -> Side {
    let bodies = reference.bodies();
    let mut seen = candidate.clone();
    seen.inertials.fill(None);
    for (joint, &other) in joints.iter().enumerate() {
        let link = candidate.frames.joints[joint].link;
        let link_from_body = candidate.frames.links[link].body_from_link.inverse();
        let in_link = bodies[other].transformed_by(&link_from_body);
        seen.inertials[link] = Some(Inertial::from_origin(&in_link, Matrix3::identity()));
        seen.resistances[joint] = reference.resistances[other];
        seen.limits[joint] = reference.limits[other];
        seen.accelerations[joint] = reference.accelerations[other];
    }
    seen.gravity_m_s2 = reference.gravity_m_s2;
    seen
}
