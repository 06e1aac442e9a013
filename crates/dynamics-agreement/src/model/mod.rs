//! One model of the comparison: inertias, joint terms, gravity and limits of a description.

pub(crate) mod frames;
mod in_other_frames;
pub(crate) mod inertial;
mod joint_terms;
pub(crate) mod one_sided_armature;

use std::sync::Arc;

use congruent_description::{JointLimit, Robot, RobotDescription};
use congruent_dynamics::{BodyTree, GRAVITY_M_S2, JointResistance, SpatialInertia};
use congruent_kinematics::{KinematicsError, Pose};
use nalgebra::{DVector, Matrix3, Vector3};

pub use frames::Frames;
pub use inertial::{BodyLaw, Inertial};
pub(crate) use joint_terms::JointTerm;

/// The dynamics of a robot by one description, with every parameter as it is written.
///
/// Links and moving joints are numbered as in [`congruent_description::Robot`]; mimic joints are independent.
#[derive(Debug, Clone)]
pub struct DynamicsModel {
    pub(crate) frames: Arc<Frames>,
    /// Inertials, one for each link; `None` for links without one.
    pub inertials: Vec<Option<Inertial>>,
    /// Damping, friction and armature, one entry for each moving joint.
    pub resistances: Vec<JointResistance>,
    /// Gravity in the root link, m/s^2.
    pub gravity_m_s2: Vector3<f64>,
    /// Joint limits, one for each moving joint; `None` if none is given.
    pub limits: Vec<Option<JointLimit>>,
    /// Declared largest accelerations, rad/s^2 or m/s^2, one for each moving joint. Certificates assume 10 if none is declared.
    pub accelerations: Vec<Option<f64>>,
    /// Whether a value that it lacks is 0, as in what a program has loaded, and not left open, as in a file.
    pub is_complete: bool,
}

impl DynamicsModel {
    /// The dynamics of a robot, with the frames of its links.
    pub fn new(robot: &Robot) -> Self {
        Self::with_frames(robot, Arc::new(Frames::new(robot)))
    }

    /// The dynamics of a description, with the frames of its Denavit-Hartenberg table if it has one: parameters may have been
    /// given in these frames by mistake.
    ///
    /// # Errors
    /// [`KinematicsError`] if the table is another robot's.
    pub fn from_description(description: &RobotDescription) -> Result<Self, KinematicsError> {
        let robot = &description.robot;
        let mut frames = Frames::new(robot);
        if let Some(table) = &description.dh {
            frames = frames.with_dh_frames(table, robot, description.base)?;
        }
        Ok(Self::with_frames(robot, Arc::new(frames)).with_accelerations(&description.accelerations))
    }

    /// The dynamics of a robot with frames that were computed before, of the same robot.
    pub fn with_frames(robot: &Robot, frames: Arc<Frames>) -> Self {
        let moving = || robot.movable_joints().iter().map(|&joint| robot.joint(joint));
        Self {
            frames,
            inertials: robot.links().iter().map(|link| link.inertia.as_ref().map(Inertial::from)).collect(),
            resistances: moving().map(JointResistance::from).collect(),
            gravity_m_s2: GRAVITY_M_S2.into(),
            limits: moving().map(|joint| joint.limit).collect(),
            accelerations: moving().map(|_| None).collect(),
            is_complete: false,
        }
    }

    /// The same with declared largest accelerations, one for each moving joint.
    #[must_use]
    pub fn with_accelerations(self, accelerations: &[Option<f64>]) -> Self {
        Self { accelerations: accelerations.to_vec(), ..self }
    }

    /// The frames of links and joints.
    pub fn frames(&self) -> &Frames {
        &self.frames
    }

    /// Inertia of each body, in the frame of the link that its joint carries.
    pub fn bodies(&self) -> Vec<SpatialInertia> {
        let mut bodies = vec![SpatialInertia::zero(); self.frames.dof()];
        for (place, inertial) in self.frames.links.iter().zip(&self.inertials) {
            if let (Some(body), Some(inertial)) = (place.body, inertial) {
                bodies[body] += inertial.about_origin().transformed_by(&place.body_from_link);
            }
        }
        bodies
    }

    /// The same dynamics with one inertial for each body, at the link that its joint carries, to be compared with a description
    /// that has no other links. A body whose other links have no inertial keeps its written parameters.
    #[must_use]
    pub fn by_bodies(&self) -> Self {
        let bodies = self.bodies();
        let mut lumped = self.clone();
        lumped.inertials.fill(None);
        for (body, joint) in self.frames.joints.iter().enumerate() {
            let with_parameters: Vec<usize> =
                self.frames.links_of(body).filter(|&link| self.inertials[link].is_some()).collect();
            lumped.inertials[joint.link] = match with_parameters[..] {
                [] => None,
                // Keeps the written axes and digits; a sum over links could only give values about other axes.
                [only] if only == joint.link => self.inertials[only],
                _ => Some(Inertial::from_origin(&bodies[body], Matrix3::identity())),
            };
        }
        lumped
    }

    /// The same with the parameters of some links expressed in other frames, each given by the index of the link and the pose
    /// of the frame in it. Hypotheses then change parameters in that frame; the link's own frame becomes one of the other
    /// frames.
    ///
    /// # Panics
    /// If there is no such link.
    #[must_use]
    pub fn in_frames(&self, link_from_frames: &[(usize, Pose)]) -> Self {
        let mut frames = (*self.frames).clone();
        let mut moved = self.clone();
        let mut own = vec![None; frames.links.len()];
        for (link, link_from_frame) in link_from_frames {
            let frame_from_link = link_from_frame.inverse();
            let place = &mut frames.links[*link];
            place.body_from_link = place.body_from_link * *link_from_frame;
            place.root_from_link = place.root_from_link * *link_from_frame;
            for other in &mut frames.others {
                let there = &mut other.link_from_frame[*link];
                // The other frames keep their poses in space, so their poses in the moved link frame change.
                *there = there.map(|link_from_other| frame_from_link * link_from_other);
            }
            own[*link] = Some(frame_from_link);
            if let Some(parameters) = &mut moved.inertials[*link] {
                parameters.com_m = frame_from_link.rotation * parameters.com_m + frame_from_link.translation;
                parameters.link_from_axes = frame_from_link.rotation * parameters.link_from_axes;
            }
        }
        moved.frames = Arc::new(frames.with_other_frame(frames::LINK_FRAME, own));
        moved
    }

    /// The ten parameters of all bodies, one body after another.
    pub(crate) fn stacked_numbers(&self) -> DVector<f64> {
        let numbers: Vec<f64> = self.bodies().iter().flat_map(SpatialInertia::parameters).collect();
        DVector::from_vec(numbers)
    }

    /// The robot with these parameters, ready for the algorithms of dynamics.
    ///
    /// # Panics
    /// If a list has not one entry for each moving joint.
    pub fn tree(&self) -> BodyTree {
        let tree = self.frames.tree.clone().with_gravity(self.gravity_m_s2);
        let tree = tree.with_inertias_in_links(&self.bodies()).expect("one inertia for each joint");
        tree.with_resistances(self.resistances.clone()).expect("one resistance for each joint")
    }

    /// Mass of all links, and of those that a joint moves, kg.
    pub(crate) fn masses_kg(&self) -> [f64; 2] {
        let mass = |moving: bool| -> f64 {
            let links = self.frames.links.iter().zip(&self.inertials);
            links
                .filter(|(place, _)| place.body.is_some() || !moving)
                .filter_map(|(_, inertial)| Some(inertial.as_ref()?.mass_kg))
                .sum()
        };
        [mass(false), mass(true)]
    }
}
