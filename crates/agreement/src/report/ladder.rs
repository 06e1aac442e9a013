//! The agreement ladder for a description: the model against its URDF and against the physics, the
//! latter probed as a black box. What is found is told in names, lines and figures of the robot file.

use congruent_description::{JointIndex, RobotDescription, RobotFilePlaces, UrdfPlaces};
use congruent_kinematics::ScrewChain;

use super::ladder_report::{self, Ladder};
use crate::diagnosis::{Case, Constant, Question, Reference, Suspect, diagnose};

/// Which two models a ladder stands between.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Title {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
}

const MODEL_URDF: Title = Title { name: "model_urdf", title: "DH table against URDF chain" };
const MODEL_SIMULATION: Title = Title { name: "model_simulation", title: "DH table against physics, probed" };
const URDF_SIMULATION: Title = Title { name: "urdf_simulation", title: "URDF chain against physics, probed" };

/// What names and places the numbers of a case have.
pub(crate) struct Names<'a> {
    pub(crate) description: &'a RobotDescription,
    /// Moving joints of the chain, base to tip: what a case numbers.
    pub(crate) moving: Vec<JointIndex>,
    /// All joints of the chain.
    pub(crate) chain: Vec<JointIndex>,
    pub(crate) places: Option<&'a RobotFilePlaces>,
    pub(crate) urdf: Option<&'a UrdfPlaces>,
}

/// Climbs the ladder wherever two models of the chain from base to tip differ.
///
/// `configurations` are those of the whole robot at which residuals are measured, `physics` the
/// chain that the physics shows when it is probed.
pub fn climb(
    description: &RobotDescription,
    physics: &ScrewChain,
    configurations: &[Vec<f64>],
) -> Vec<Ladder> {
    let robot = &description.robot;
    let Some((urdf, chain)) = Reference::from_urdf(robot, description.base, description.tip) else {
        return Vec::new();
    };
    let moving: Vec<JointIndex> =
        chain.iter().copied().filter(|&joint| robot.joint(joint).kind.is_movable()).collect();
    let coordinates: Vec<usize> = moving.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
    let places = description.places.robot_file.as_deref();
    let physics = Reference::from_screws(physics);
    let of_chain = |q: &Vec<f64>| coordinates.iter().map(|&coordinate| q[coordinate]).collect();
    let question = Question {
        position_m: description.tolerance.position_m,
        orientation_rad: description.tolerance.orientation_rad,
        configurations: configurations.iter().map(of_chain).collect(),
    };
    let names = Names { description, moving, chain, places, urdf: description.places.urdf.as_ref() };
    let cases = if let Some(suspect) = suspect(&names) {
        let against_physics = Case { suspect: suspect.clone(), reference: physics };
        vec![(MODEL_URDF, Case { suspect, reference: urdf }), (MODEL_SIMULATION, against_physics)]
    } else {
        let suspect = Suspect::from_screws(&urdf.screws());
        vec![(URDF_SIMULATION, Case { suspect, reference: physics })]
    };
    let ladder = |(title, case): &(Title, Case)| {
        ladder_report::ladder(*title, case, &diagnose(case, &question), &names)
    };
    cases.iter().map(ladder).collect()
}

/// The table, with the roll, pitch and yaw of its declared transforms as they are written.
fn suspect(names: &Names<'_>) -> Option<Suspect> {
    use congruent_description::ConstantKey::{BaseFromDh0, DhnFromTip};
    let suspect = Suspect::from_table(names.description.dh.as_ref()?, &names.moving)?;
    let written = |constant: Constant, key| Constant {
        written_rpy_rad: names.places.and_then(|places| places.rpy_rad(key)),
        ..constant
    };
    Some(Suspect {
        base: written(suspect.base, BaseFromDh0),
        tool: written(suspect.tool, DhnFromTip),
        ..suspect
    })
}
