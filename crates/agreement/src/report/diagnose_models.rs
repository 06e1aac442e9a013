//! The agreement ladder for a description: the model against its URDF and against the physics, the
//! latter identified as a black box. What is found is told in names, lines and figures of the robot file.

use congruent_description::{JointIndex, RobotDescription, RobotFilePlaces, RobotQ, UrdfPlaces};
use congruent_kinematics::ScrewChain;

use super::{
    content::ReportedDiagnosis,
    names::{ModelNames, PairTitle},
    tell::reported_diagnosis,
};
use crate::diagnosis::{Candidate, Constant, Criterion, ModelPair, ReferenceModel, diagnose};

const MODEL_URDF: PairTitle = PairTitle { name: "model_urdf", title: "DH table against URDF chain" };
const MODEL_SIMULATION: PairTitle =
    PairTitle { name: "model_simulation", title: "DH table against physics, identified" };
const URDF_SIMULATION: PairTitle =
    PairTitle { name: "urdf_simulation", title: "URDF chain against physics, identified" };

/// Climbs the ladder wherever two models of the chain from base to tip differ.
///
/// `configurations` are those of the whole robot at which residuals are measured, `physics` the
/// chain that the physics shows when it is identified.
pub fn diagnose_models(
    description: &RobotDescription,
    physics: &ScrewChain,
    configurations: &[RobotQ],
) -> Vec<ReportedDiagnosis> {
    let robot = &description.robot;
    let Some((urdf, chain)) = ReferenceModel::from_urdf(robot, description.base, description.tip) else {
        return Vec::new();
    };
    let moving: Vec<JointIndex> =
        chain.iter().copied().filter(|&joint| robot.joint(joint).kind.is_movable()).collect();
    let coordinates: Vec<usize> = moving.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
    let places = description.dh.as_ref().and_then(|_| RobotFilePlaces::read(&description.path));
    let physics = ReferenceModel::from_screws(physics);
    let criterion = Criterion {
        tolerance: description.tolerance,
        configurations: configurations.iter().map(|q| q.of_chain(&coordinates)).collect(),
    };
    let names =
        ModelNames { description, moving, chain, places, urdf: UrdfPlaces::read(&description.urdf_path) };
    let cases = if let Some(candidate) = candidate(&names) {
        let against_physics = ModelPair { candidate: candidate.clone(), reference: physics };
        vec![(MODEL_URDF, ModelPair { candidate, reference: urdf }), (MODEL_SIMULATION, against_physics)]
    } else {
        let candidate = Candidate::from_screws(&urdf.screws());
        vec![(URDF_SIMULATION, ModelPair { candidate, reference: physics })]
    };
    let ladder = |(title, models): &(PairTitle, ModelPair)| {
        reported_diagnosis(*title, models, &diagnose(models, &criterion), &names)
    };
    cases.iter().map(ladder).collect()
}

/// The table, with the roll, pitch and yaw of its declared transforms as they are written.
fn candidate(names: &ModelNames<'_>) -> Option<Candidate> {
    use congruent_description::ConstantKey::{BaseFromDh0, DhnFromTip};
    let candidate = Candidate::from_table(names.description.dh.as_ref()?, &names.moving)?;
    let written = |constant: Constant, key| Constant {
        written_rpy_rad: names.places.as_ref().and_then(|places| places.rpy_rad(key)),
        ..constant
    };
    Some(Candidate {
        base: written(candidate.base, BaseFromDh0),
        tool: written(candidate.tool, DhnFromTip),
        ..candidate
    })
}
