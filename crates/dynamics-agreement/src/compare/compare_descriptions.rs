//! Compares two descriptions of one robot from end to end: torques, cause, hidden differences, limits.

use congruent_dynamics::DynamicsError;
use nalgebra::Matrix3;

use super::{
    compare_long::compare_long,
    link_by_link::{complexity, is_simpler, joint_terms_alone, link_by_link},
    named_diagnosis::{NamedDiagnosis, NamedModel},
    statements::{StatedReference, with_fitted_bodies},
};
use crate::{
    bound,
    diagnosis::{DiagnosisInput, ReferenceTorques},
    differences::{ParameterDifference, hidden, invariants::invariants, limits},
    model::{DynamicsModel, Inertial, JointTerm},
    report::{
        content::{
            ComparedModels, DynamicsExplanation, DynamicsPremise, DynamicsReport, DynamicsVerdict,
            TorqueCertificates,
        },
        places::ModelFiles,
    },
    thresholds::{COMPLEXITY_OF_PAIRS, INVARIANT_STATES, MOST_JOINTS, Precision, STATES},
    torque::{
        reduced_difference::{ReducedTorqueDifference, torques},
        states::random_states,
    },
};

/// Why two descriptions cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// Only one of the descriptions has this joint: they are not the same chain.
    #[error("only one of the two descriptions has joint \"{joint}\"")]
    Joint {
        /// Name of the joint that only one of them has.
        joint: String,
    },
    /// No joint moves, so there is no joint torque to compare.
    #[error("no joint moves: there is no joint torque to compare")]
    NoJoint,
    /// The comparison would take too long.
    #[error(
        "{joints} joints move, and inertial parameters are compared for at most {MOST_JOINTS}: the time grows with the cube of the number"
    )]
    TooManyJoints {
        /// Number of moving joints.
        joints: usize,
    },
    /// A parameter is not finite, or so large that torques overflow.
    #[error(
        "{what} = {value:e} is not finite or too large for torques to be computed (limit {LARGEST_NUMBER:e})"
    )]
    NotFinite {
        /// The parameter, with its link or joint.
        what: String,
        /// Its value, SI units.
        value: f64,
    },
    /// The source of accelerations failed.
    #[error("the source of accelerations failed: {message}")]
    Source {
        /// The error that it reported.
        message: String,
    },
    /// A vector has the length of another robot.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
}

/// Compares two descriptions of the same chain at seeded random states.
///
/// Links and joints are matched by name; frames of equal name must be equal, which is the question of the kinematic
/// comparison before this one.
///
/// What the reference does not state is not compared: the masses of a moving body without any (which may be any masses, also in
/// the torques of others), and damping and dry friction of a joint without an entry for them, if the candidate has such entries
/// at most joints.
///
/// For more than 60 joints no cause is searched: the report has the difference of torques and the parameters that differ.
///
/// # Errors
/// [`CompareError`] if a joint is missing in one of them, or if parameters are not finite.
///
/// # Examples
/// A mass that is given in grams:
/// ```
/// use congruent_description::parse_urdf;
/// use congruent_dynamics_agreement::{DynamicsCause, NamedModel, DynamicsModel, compare};
/// let rod = |mass: &str| {
///     let text = format!(r#"<robot name="rod"><link name="base"/>
///     <link name="rod"><inertial><origin xyz="0.5 0 0"/><mass value="{mass}"/>
///       <inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
///     <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
///     </robot>"#);
///     DynamicsModel::new(&parse_urdf(&text).unwrap())
/// };
/// let (wrong, right) = (rod("2000"), rod("2"));
/// let description = |name, model| NamedModel { name, model, places: None };
/// let report = compare(&description("wrong", &wrong), &description("right", &right), 1)?;
/// assert_eq!(report.explanations[0].cause, DynamicsCause::MassUnit);
/// assert_eq!(report.explanations[0].sentence(), "rod: the mass is given in another unit (g)");
/// # Ok::<(), congruent_dynamics_agreement::CompareError>(())
/// ```
pub fn compare(
    candidate: &NamedModel<'_>,
    reference: &NamedModel<'_>,
    seed: u64,
) -> Result<DynamicsReport, CompareError> {
    let joints = comparable(candidate.model, reference.model)?;
    let stated = StatedReference::new(candidate, reference, &joints);
    let reference = &NamedModel { model: &stated.model, ..*reference };
    let reference_in_candidate = in_geometry_of(candidate.model, reference.model, &joints);
    let states = random_states(&candidate.model.frames, seed, STATES);
    // Both torques are computed with one geometry, so that only masses, joint terms and gravity can differ.
    let torques = torques(&reference_in_candidate, &states)?;
    let expected = ReferenceTorques { states: &states, torques: &torques };
    if joints.len() > MOST_JOINTS {
        let report = compare_long(candidate, reference, &reference_in_candidate, &joints, expected)?;
        return Ok(DynamicsReport { not_stated: stated.not_stated, ..report });
    }
    let torque_with_all = ReducedTorqueDifference::new(candidate.model, &states, &torques)?;
    // Masses that the reference does not state may be any: what they can add to the torques is no difference.
    let torque = torque_with_all.without_bodies(&candidate.model.frames, &stated.unstated);
    let setting = DiagnosisInput::of_files([candidate.model, reference.model], &stated.unstated);
    let files = ModelFiles { found: candidate.places, expected: reference.places };
    let mut diagnosis = diagnose_with_fallbacks(&setting, files, &reference_in_candidate, &torque, expected)?;
    // With both files at hand an explanation that changes a parameter which is equal in both is refuted.
    diagnosis.explanations.retain(|explanation| !explanation.contradicted);
    let mut differences = hidden::differences(candidate.model, reference.model);
    files.place(&mut differences);
    // If all torques agree, every parameter that differs is hidden, however large its effect would be alone: several
    // differences may cancel.
    let resolution = if diagnosis.same { f64::INFINITY } else { Precision::EXACT.of_torque };
    let mut hidden_differences =
        hidden::without_effect(candidate.model, reference.model, &torque_with_all, resolution);
    files.place(&mut hidden_differences);
    let mut limits = limits::differences(candidate.model, reference.model, &joints);
    files.place_limits(&mut limits);
    let verdict = verdict(&diagnosis, &stated, &differences);
    let fitted = with_fitted_bodies(&reference_in_candidate, &stated.unstated, &torque_with_all);
    let tree = fitted.tree().without_resistances();
    Ok(DynamicsReport {
        sides: ComparedModels {
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
        seen: Some(torque.identifiable),
        invariants: Some(invariants([candidate.model, reference.model], &tree, &states[..INVARIANT_STATES])?),
        links: diagnosis.links,
        differences,
        hidden_differences,
        explanations: diagnosis.explanations,
        indistinguishable: diagnosis.indistinguishable,
        not_stated: stated.not_stated,
        armature_stated_by: None,
        limits,
        certificates: None,
    })
}

/// Equal torques with differing parameters are `SameTorques`: hidden differences are reported, but do not decide.
fn verdict(
    diagnosis: &NamedDiagnosis,
    stated: &StatedReference,
    differences: &[ParameterDifference],
) -> DynamicsVerdict {
    match (diagnosis.same, differences.is_empty()) {
        (true, _) if !stated.has_mass => DynamicsVerdict::NotCompared,
        (true, true) => DynamicsVerdict::Same,
        _ => diagnosis.verdict(),
    }
}

/// The diagnosis of the torque difference; if no single fault explains it, of each link by itself, or of pairs of faults,
/// or of the joint terms apart from the links, whichever is simplest.
fn diagnose_with_fallbacks(
    setting: &DiagnosisInput<'_>,
    files: ModelFiles<'_>,
    reference_in_candidate: &DynamicsModel,
    torque: &ReducedTorqueDifference,
    expected: ReferenceTorques<'_>,
) -> Result<NamedDiagnosis, CompareError> {
    let mut diagnosis = NamedDiagnosis::new(setting, files, torque, expected)?;
    // An explanation without a free parameter is accepted as it is: fitting cannot have produced it.
    if diagnosis
        .explanations
        .first()
        .map_or(!diagnosis.same, |first| first.contradicted || first.numbers > 0.0)
    {
        let by_link = link_by_link(setting, files, reference_in_candidate, torque, expected.states)?;
        // Values that only their combinations determine may be split between links in another manner: then every link
        // differs, although few faults change torques. Torques do not depend on the split.
        if by_link.is_empty() || complexity(&by_link) > COMPLEXITY_OF_PAIRS {
            diagnosis =
                NamedDiagnosis::new(&DiagnosisInput { pairs: true, ..*setting }, files, torque, expected)?;
        }
        if !by_link.is_empty() && is_simpler(&by_link, &diagnosis.explanations) {
            diagnosis.explanations = by_link;
            diagnosis.indistinguishable.clear();
        }
        let apart = joint_terms_apart(setting, files, reference_in_candidate, expected)?;
        if !apart.is_empty() && is_simpler(&apart, &diagnosis.explanations) {
            diagnosis.explanations = apart;
            diagnosis.indistinguishable.clear();
        }
    }
    Ok(diagnosis)
}

/// The joint terms by themselves, and what differs beside them, diagnosed with the right terms: values of links that only
/// their combinations determine may be split in another manner, which has no effect on torques and is then no part of the
/// explanation. Empty if no term differs, or if the rest has no explanation.
fn joint_terms_apart(
    setting: &DiagnosisInput<'_>,
    files: ModelFiles<'_>,
    reference_in_candidate: &DynamicsModel,
    expected: ReferenceTorques<'_>,
) -> Result<Vec<DynamicsExplanation>, CompareError> {
    let model = setting.candidate;
    let right = DynamicsModel { resistances: reference_in_candidate.resistances.clone(), ..model.clone() };
    if right.resistances == model.resistances {
        return Ok(Vec::new());
    }
    let Some(terms) = joint_terms_alone(setting, files, &right, expected.states)? else {
        return Ok(Vec::new());
    };
    let rest = setting.torque_difference(&right, expected)?;
    let setting = DiagnosisInput { candidate: &right, ..*setting };
    let rest = diagnose_with_fallbacks(&setting, files, reference_in_candidate, &rest, expected)?;
    let is_explained = rest.same || !rest.explanations.is_empty();
    let all = std::iter::once(terms).chain(rest.explanations);
    Ok(if is_explained { all.collect() } else { Vec::new() })
}

/// Brackets the largest torque differences between two descriptions of the same chain; takes seconds for a long arm.
///
/// # Errors
/// As [`compare`], or [`CompareError::TooManyJoints`].
pub fn certify(
    candidate: &NamedModel<'_>,
    reference: &NamedModel<'_>,
    seed: u64,
) -> Result<TorqueCertificates, CompareError> {
    let joints = comparable(candidate.model, reference.model)?;
    check_count(joints.len())?;
    let stated = StatedReference::new(candidate, reference, &joints);
    let mut reference = in_geometry_of(candidate.model, &stated.model, &joints);
    if !stated.unstated.is_empty() {
        let states = random_states(&candidate.model.frames, seed, STATES);
        let torque = ReducedTorqueDifference::new(candidate.model, &states, &torques(&reference, &states)?)?;
        reference = with_fitted_bodies(&reference, &stated.unstated, &torque);
    }
    let certified = bound::certify(candidate.model, &reference, seed)?;
    Ok(TorqueCertificates {
        gravity: certified.gravity,
        inertia: certified.inertia,
        velocity: certified.velocity,
        together: certified.together,
        covered: certified.covered,
    })
}

/// For each joint of the candidate the index of the reference's joint with that name; refuses robots whose torques cannot
/// be computed.
fn comparable(candidate: &DynamicsModel, reference: &DynamicsModel) -> Result<Vec<usize>, CompareError> {
    let joints = matched(candidate, reference)?;
    if joints.is_empty() {
        return Err(CompareError::NoJoint);
    }
    [candidate, reference].into_iter().try_for_each(check_numbers)?;
    Ok(joints)
}

/// Refuses a robot without moving joints, or with too many for a comparison of inertial parameters.
pub(super) fn check_count(joints: usize) -> Result<(), CompareError> {
    match joints {
        0 => Err(CompareError::NoJoint),
        1..=MOST_JOINTS => Ok(()),
        _ => Err(CompareError::TooManyJoints { joints }),
    }
}

fn matched(candidate: &DynamicsModel, reference: &DynamicsModel) -> Result<Vec<usize>, CompareError> {
    let missing = |joint: &str| CompareError::Joint { joint: joint.to_owned() };
    for joint in &reference.frames.joints {
        // Both directions: a joint that only the reference has would otherwise be ignored.
        candidate.frames.find_joint(&joint.name).ok_or_else(|| missing(&joint.name))?;
    }
    let place = |name: &str| reference.frames.find_joint(name).ok_or_else(|| missing(name));
    candidate.frames.joints.iter().map(|joint| place(&joint.name)).collect()
}

/// Larger parameters overflow in squares of torques. SI units; kind: range of floating-point numbers.
const LARGEST_NUMBER: f64 = 1e60;

/// Refuses the first parameter that torques cannot be computed with.
pub(super) fn check_numbers(model: &DynamicsModel) -> Result<(), CompareError> {
    let joints = model.resistances.iter().enumerate().flat_map(|(joint, of)| {
        let name = model.frames.joint_name(joint);
        JointTerm::ALL.map(|term| (format!("joint \"{name}\": {}", term.name()), term.value_in(of)))
    });
    let links = model.inertials.iter().enumerate().filter_map(|(link, of)| Some((link, of.as_ref()?)));
    let inertials = links.flat_map(|(link, of)| {
        let name = model.frames.link_name(link);
        let all = [
            ("mass", of.mass_kg),
            ("centre of mass", of.com_m.amax()),
            ("inertia", of.tensor_kg_m2.amax()),
            ("mass times the square of its distance from the link's origin", of.shift().amax()),
        ];
        all.map(|(what, value)| (format!("link \"{name}\": {what}"), value))
    });
    let gravity = std::iter::once(("gravity".to_owned(), model.gravity_m_s2.amax()));
    let mut all = joints.chain(inertials).chain(gravity);
    match all.find(|(_, value)| value.is_nan() || value.abs() >= LARGEST_NUMBER) {
        Some((what, value)) => Err(CompareError::NotFinite { what, value }),
        None => Ok(()),
    }
}

/// The parameters of a reference expressed in a candidate's geometry: one inertial for each body, at the link that its joint
/// carries.
fn in_geometry_of(candidate: &DynamicsModel, reference: &DynamicsModel, joints: &[usize]) -> DynamicsModel {
    let bodies = reference.bodies();
    let mut expressed = candidate.clone();
    expressed.inertials.fill(None);
    for (joint, &other) in joints.iter().enumerate() {
        let link = candidate.frames.joints[joint].link;
        let link_from_body = candidate.frames.links[link].body_from_link.inverse();
        // The body of the reference is given in the frame of its joint; links with another name or frame do not
        // matter for it.
        let in_link = bodies[other].transformed_by(&link_from_body);
        expressed.inertials[link] = Some(Inertial::from_origin(&in_link, Matrix3::identity()));
        expressed.resistances[joint] = reference.resistances[other];
        expressed.limits[joint] = reference.limits[other];
        expressed.accelerations[joint] = reference.accelerations[other];
    }
    expressed.gravity_m_s2 = reference.gravity_m_s2;
    expressed
}
