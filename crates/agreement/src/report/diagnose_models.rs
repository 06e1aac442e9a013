//! The diagnosis of a robot description: the table against the URDF and against the physics, which is
//! identified as a black box.

use std::f64::consts::TAU;

use congruent_description::{ChainQ, JointIndex, Robot, RobotDescription, RobotQ};
use congruent_kinematics::ScrewChain;

use super::{
    content::{ReportedDiagnosis, ReportedDifference},
    describe::{difference, reported_diagnosis},
    names::ModelNames,
};
use crate::{
    diagnosis::{
        CandidateModel, Criterion, DeclaredTransform, ModelPair, ReferenceModel, diagnose, differences,
    },
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
    let robot = &description.robot;
    let Some((urdf, chain)) = ReferenceModel::from_urdf(robot, description.base, description.tip) else {
        return Vec::new();
    };
    let moving: Vec<JointIndex> =
        chain.iter().copied().filter(|&joint| robot.joint(joint).kind.is_movable()).collect();
    let coordinates: Vec<usize> = moving.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
    let places = description.places.robot_file.as_deref();
    let physics = physics.map(ReferenceModel::from_screws);
    let criterion = Criterion {
        tolerance: description.tolerance,
        configurations: configurations
            .iter()
            .map(|q| within_a_turn(robot, &moving, q.chain_positions(&coordinates)))
            .collect(),
    };
    let names = ModelNames { description, moving, chain, places, urdf: description.places.urdf.as_ref() };
    let mut pairs = Vec::new();
    if let Some(candidate) = candidate(&names) {
        let against_physics = physics.map(|reference| ModelPair { candidate: candidate.clone(), reference });
        pairs.push((SourcePair::ModelUrdf, ModelPair { candidate, reference: urdf }));
        pairs.extend(against_physics.map(|models| (SourcePair::ModelSimulation, models)));
    // Without a table the URDF takes its place: the physics is then the model that counts as correct.
    } else if let Some(reference) = physics {
        let candidate = CandidateModel::from_screws(&urdf.screws());
        pairs.push((SourcePair::UrdfSimulation, ModelPair { candidate, reference }));
    }
    let diagnosis = |(pair, models): &(SourcePair, ModelPair)| {
        reported_diagnosis(*pair, models, &criterion, &diagnose(models, &criterion), &names)
    };
    pairs.iter().map(diagnosis).collect()
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

/// The table with the roll, pitch and yaw of its declared transforms as the file writes them.
fn candidate(names: &ModelNames<'_>) -> Option<CandidateModel> {
    use congruent_description::ConstantKey::{BaseFromDh0, DhnFromTip};
    let candidate = CandidateModel::from_table(names.description.dh.as_ref()?, &names.moving)?;
    let written = |transform: DeclaredTransform, key| DeclaredTransform {
        written_rpy_rad: names.places.and_then(|places| places.rpy_rad(key)),
        ..transform
    };
    Some(CandidateModel {
        base: written(candidate.base, BaseFromDh0),
        tool: written(candidate.tool, DhnFromTip),
        ..candidate
    })
}
