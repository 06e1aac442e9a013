//! The robot that an engine has loaded, of the numbers that `congruent.engines` has read from its arrays.

use congruent::{
    codes::{self, check},
    description::{
        Inertia, Joint, JointKind, JointLimit, JointParts, Link, Robot, RobotDescription, RobotError,
        Tolerance,
    },
    input::Diagnostic,
    nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3},
};
use pyo3::prelude::*;

use super::rounding::{rounded_joint, rounded_link};
use crate::{error::refused, robot::PythonRobot};

/// `congruent.engines._loaded.LoadedLink`.
#[derive(FromPyObject)]
struct LoadedLink {
    name: String,
    mass_kg: f64,
    com_m: [f64; 3],
    tensor_kg_m2: [[f64; 3]; 3],
}

/// `congruent.engines._loaded.LoadedJoint`.
#[derive(FromPyObject)]
struct LoadedJoint {
    name: String,
    kind: String,
    parent: String,
    child: String,
    position_m: [f64; 3],
    quaternion_wxyz: [f64; 4],
    axis: [f64; 3],
    range: Option<[f64; 2]>,
    effort: Option<f64>,
    velocity: Option<f64>,
    damping: f64,
    friction: f64,
    armature: f64,
    follows: Option<(String, f64, f64)>,
}

/// `congruent.engines._loaded.LoadedModel`.
#[derive(FromPyObject)]
pub(crate) struct LoadedModel {
    name: String,
    robot: String,
    links: Vec<LoadedLink>,
    joints: Vec<LoadedJoint>,
    forces: Vec<String>,
    couples: bool,
    is_single_precision: bool,
    within: (f64, f64),
}

/// The robot of what an engine has loaded, under the name that messages have for it. ``file`` is the robot that it is compared with,
/// whose couplings of joints it gets if the engine couples none.
#[pyfunction]
#[pyo3(signature = (model, file=None))]
pub(crate) fn loaded_robot(
    py: Python<'_>,
    mut model: LoadedModel,
    file: Option<&Bound<'_, PythonRobot>>,
) -> PyResult<PythonRobot> {
    let name = model.name.clone();
    let file = file.filter(|_| !model.couples).map(|file| &file.get().description().robot);
    let uncoupled = file.map(|robot| model.couple_as_in(robot)).unwrap_or_default();
    let help = "check the model in the engine: its names, masses and inertias";
    let mut described = model.description().map_err(|error| {
        refused(py, Diagnostic::error(codes::python::ENGINE, format!("{name}: {error}")).with_help(help))
    })?;
    described
        .warnings
        .extend(uncoupled.into_iter().map(|message| Diagnostic::warning(check::MAPPING, message)));
    PythonRobot::along(py, described, None, None)
}

impl LoadedModel {
    /// Couples joints as the file does: which joints follow others is no part of what the engine has loaded. Returns the joints that do
    /// not follow there, in words.
    fn couple_as_in(&mut self, file: &Robot) -> Vec<String> {
        let mut uncoupled = Vec::new();
        for joint in file.joints() {
            let Some(mimic) = joint.mimic else { continue };
            let leader = &file.joint(mimic.master).name;
            let is_known = self.joints.iter().any(|of| of.name == *leader);
            let here = self.joints.iter_mut().find(|of| of.name == joint.name && of.follows.is_none());
            if let Some(here) = here.filter(|_| is_known) {
                here.follows = Some((leader.clone(), mimic.multiplier, mimic.offset));
                let name = &joint.name;
                uncoupled.push(format!(
                    "joint \"{name}\" follows \"{leader}\" in the file, and moves by itself in {}",
                    self.name
                ));
            }
        }
        uncoupled
    }

    fn description(self) -> Result<RobotDescription, RobotError> {
        let links = self.links.into_iter().map(LoadedLink::into_link);
        let joints = self.joints.into_iter().map(LoadedJoint::into_parts);
        let (links, joints) = if self.is_single_precision {
            let rounded = |parts: JointParts| JointParts { joint: rounded_joint(parts.joint), ..parts };
            (links.map(rounded_link).collect(), joints.map(rounded).collect())
        } else {
            (links.collect(), joints.collect())
        };
        let robot = Robot::new(self.robot, links, joints)?;
        let (position_m, orientation_rad) = self.within;
        let within = Tolerance { position_m, orientation_rad };
        Ok(RobotDescription::of_loaded(&self.name, robot, self.forces, within))
    }
}

impl LoadedLink {
    fn into_link(self) -> Link {
        let tensor = Matrix3::from_fn(|row, column| self.tensor_kg_m2[row][column]);
        let is_some = self.mass_kg != 0.0 || tensor != Matrix3::zeros();
        let inertia = is_some.then(|| Inertia {
            mass_kg: self.mass_kg,
            link_from_inertial: Isometry3::translation(self.com_m[0], self.com_m[1], self.com_m[2]),
            // Axes of an engine are turned back to those of the link, whose rounding is not symmetric.
            tensor_kg_m2: (tensor + tensor.transpose()) * 0.5,
        });
        Link { name: self.name, inertia, ..Link::default() }
    }
}

impl LoadedJoint {
    fn into_parts(self) -> JointParts {
        let [w, x, y, z] = self.quaternion_wxyz;
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let parent_from_joint = Isometry3::from_parts(Translation3::from(self.position_m), rotation);
        let kind = self.kind();
        let parts = JointParts::new(&self.name, kind, &self.parent, &self.child, parent_from_joint);
        if kind == JointKind::Fixed {
            return parts;
        }
        // A joint without a range has no ends: what it lacks is not limited.
        let [lower, upper] = self.range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let has_limit = self.range.is_some() || kind == JointKind::Continuous;
        let limit = JointLimit {
            lower,
            upper,
            effort: self.effort,
            velocity: self.velocity,
            ..JointLimit::default()
        };
        let joint = Joint {
            axis_in_joint: Unit::new_normalize(Vector3::from(self.axis)),
            limit: has_limit.then_some(limit),
            damping: self.damping,
            friction: self.friction,
            armature: Some(self.armature),
            ..parts.joint
        };
        JointParts { joint, mimic: self.follows, ..parts }
    }

    fn kind(&self) -> JointKind {
        match (&*self.kind, self.range) {
            ("slide", _) => JointKind::Prismatic,
            ("hinge", Some(_)) => JointKind::Revolute,
            ("hinge", None) => JointKind::Continuous,
            _ => JointKind::Fixed,
        }
    }
}
