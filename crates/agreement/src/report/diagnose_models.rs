//! The diagnosis of a robot description: the table against the URDF and against the physics, which is
//! identified as a black box.

use std::f64::consts::TAU;

use congruent_description::{ChainQ, JointIndex, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{PoseError, ScrewChain};

use super::{
    content::{ReportedDiagnosis, ReportedDifference},
    describe::{difference, reported_diagnosis},
    names::ModelNames,
};
use crate::{
    diagnosis::{CandidateModel, Criterion, ModelPair, ReferenceModel, diagnose, differences},
    source_pair::SourcePair,
};

/// The diagnosis of each pair of models of the chain from base to tip.
///
/// `configurations` are configurations of the whole robot at which residuals are measured, `physics` is the chain
/// that was identified from the physics, `None` if there is no physics to compare.
pub fn diagnose_models(
    description: &RobotDescription,
    physics: Option<&ScrewChain>,
    configurations: &[RobotQ],
) -> Vec<ReportedDiagnosis> {
    let Some(ChainModels { names, pairs, criterion }) =
        ChainModels::new(description, physics, configurations)
    else {
        return Vec::new();
    };
    let mut diagnoses: Vec<ReportedDiagnosis> = Vec::new();
    for (pair, models) in &pairs {
        let criterion = Criterion { digits: names.digits(models, &criterion), ..criterion.clone() };
        // What is known of the physics are its screws, without the digits that its URDF is typed with.
        let of_urdf = diagnoses.first().filter(|_| !criterion.digits.values.is_empty());
        diagnoses.push(match of_urdf {
            Some(of_urdf) if is_same_reference(&pairs, &criterion) => {
                ReportedDiagnosis { name: *pair, title: pair.title(), ..of_urdf.clone() }
            }
            _ => reported_diagnosis(*pair, models, &criterion, diagnose(models, &criterion), &names),
        });
    }
    diagnoses
}

/// Whether URDF and physics, the references of the pairs, are the same within the tolerance.
fn is_same_reference(pairs: &[(SourcePair, ModelPair)], criterion: &Criterion) -> bool {
    let [(_, ModelPair { reference: urdf, .. }), (_, ModelPair { reference, .. })] = pairs else {
        return false;
    };
    let candidate = CandidateModel::from_screws(&urdf.screws());
    ModelPair { candidate, reference: reference.clone() }.is_within_tolerance(criterion)
}

/// What the digits of table and URDF say about the difference of the two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DigitsOfTable {
    /// The largest difference that half of the last place of each value allows, to first order.
    pub(crate) allowed: PoseError,
    /// Whether values within half of the last place of the typed ones make table and URDF the same.
    pub(crate) explain_all: bool,
}

/// Whether table and URDF are the same within the digits that they are typed with; `None` without a table.
pub(crate) fn digits_of_table(
    description: &RobotDescription,
    configurations: &[RobotQ],
) -> Option<DigitsOfTable> {
    let ChainModels { names, pairs, criterion } = ChainModels::new(description, None, configurations)?;
    let (_, models) = pairs.first().filter(|(pair, _)| *pair == SourcePair::ModelUrdf)?;
    let digits = names.digits(models, &criterion);
    Some(DigitsOfTable {
        allowed: digits.allowed,
        explain_all: digits.explain(models, &criterion.configurations),
    })
}

/// The models of a chain, in pairs, and what counts as agreement of a pair.
struct ChainModels<'a> {
    names: ModelNames<'a>,
    pairs: Vec<(SourcePair, ModelPair)>,
    criterion: Criterion,
}

impl<'a> ChainModels<'a> {
    /// `None` if no table can describe the chain.
    fn new(
        description: &'a RobotDescription,
        physics: Option<&ScrewChain>,
        configurations: &[RobotQ],
    ) -> Option<Self> {
        let robot = &description.robot;
        let (urdf, chain) = ReferenceModel::from_urdf(robot, description.base, description.tip)?;
        let moving: Vec<JointIndex> =
            chain.iter().copied().filter(|&joint| robot.joint(joint).kind.is_movable()).collect();
        let coordinates: Vec<usize> = moving.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
        let places = description.places.robot_file.as_deref();
        let physics = physics.map(ReferenceModel::from_screws);
        let configurations =
            configurations.iter().map(|q| within_a_turn(robot, &moving, q.chain_positions(&coordinates)));
        let criterion = Criterion {
            tolerance: description.tolerance,
            configurations: configurations.collect(),
            ..Criterion::default()
        };
        let names = ModelNames { description, moving, chain, places, urdf: description.places.urdf.as_ref() };
        let mut pairs = Vec::new();
        if let Some(candidate) = names.candidate() {
            let against_physics =
                physics.map(|reference| ModelPair { candidate: candidate.clone(), reference });
            pairs.push((SourcePair::ModelUrdf, ModelPair { candidate, reference: urdf }));
            pairs.extend(against_physics.map(|models| (SourcePair::ModelSimulation, models)));
        // Without a table the URDF takes its place: the physics is then the model that counts as correct.
        } else if let Some(reference) = physics {
            let candidate = CandidateModel::from_screws(&urdf.screws());
            pairs.push((SourcePair::UrdfSimulation, ModelPair { candidate, reference }));
        }
        Some(Self { names, pairs, criterion })
    }
}

/// The screws and distances in which the URDF chain from base to tip differs from one that was identified.
pub(crate) fn screw_differences(
    description: &RobotDescription,
    identified: &ScrewChain,
) -> Vec<ReportedDifference> {
    let robot = &description.robot;
    let Some((urdf, chain)) = ReferenceModel::from_urdf(robot, description.base, description.tip) else {
        return Vec::new();
    };
    let moving = chain.iter().copied().filter(|&joint| robot.joint(joint).kind.is_movable()).collect();
    let names = ModelNames { description, moving, chain, places: None, urdf: None };
    let candidate = CandidateModel::from_screws(&urdf.screws());
    let models = ModelPair { candidate, reference: ReferenceModel::from_screws(identified) };
    differences(&models).iter().map(|each| difference(each, &names)).collect()
}

/// The same configuration with angles beyond a turn brought within one: there the rounding of an identified screw,
/// which grows with the angle, stays far below the tolerance.
fn within_a_turn(robot: &Robot, moving: &[JointIndex], mut q: ChainQ) -> ChainQ {
    for (&joint, position) in moving.iter().zip(q.iter_mut()) {
        if robot.joint(joint).kind.is_angular() {
            *position %= TAU;
        }
    }
    q
}
