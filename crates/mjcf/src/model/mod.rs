//! What an MJCF says, resolved: metres, radians and kilograms, poses in the frames of bodies, references as indices.

mod actuator;
mod body;
mod constraint;
mod geom;
mod joint;
mod written;

use std::sync::Arc;

use congruent_input::SourceFile;
use nalgebra::Vector3;

pub use actuator::{MjActuator, MjEffort, MjTarget};
pub use body::{MjBody, MjFrame, MjInertiaRules, MjInertial, MjInference};
pub use constraint::{MjContactExclusion, MjEquality, MjEqualityKind, MjKeyframe, MjTendon};
pub use geom::{MjGeom, MjGeomMass, MjMesh, MjMeshInertia, MjShape, MjSite};
pub use joint::{MjJoint, MjJointKind};
pub use written::{MjName, MjNotation, MjPlace, MjWritten};

/// A model: all that is needed of it to make a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct MjModel {
    /// Name of the model; empty if the file has none.
    pub name: String,
    /// Bodies, each after its parent; the first is the world.
    pub bodies: Vec<MjBody>,
    /// Frames, each after those around it.
    pub frames: Vec<MjFrame>,
    /// Joints, in the order of positions in MuJoCo: by body, then in the order of the file.
    pub joints: Vec<MjJoint>,
    /// Geoms, by body.
    pub geoms: Vec<MjGeom>,
    /// Sites, by body.
    pub sites: Vec<MjSite>,
    /// Meshes that geoms may use.
    pub meshes: Vec<MjMesh>,
    /// Actuators.
    pub actuators: Vec<MjActuator>,
    /// Equality constraints: followers of joints, and loops.
    pub equalities: Vec<MjEquality>,
    /// Tendons.
    pub tendons: Vec<MjTendon>,
    /// Pairs of bodies whose contacts are excluded.
    pub exclusions: Vec<MjContactExclusion>,
    /// Keyframes of the main model.
    pub keyframes: Vec<MjKeyframe>,
    /// Gravity, m/s^2, in the world.
    pub gravity_in_world: MjWritten<Vector3<f64>>,
    /// Density of the medium around the bodies, kg/m^3: 0 without one.
    pub medium_density_kg_m3: MjWritten<f64>,
    /// Viscosity of the medium, Pa s: 0 without one.
    pub medium_viscosity_pa_s: MjWritten<f64>,
    /// `settotalmass`: all masses and inertias are scaled so that their sum is this, kg.
    pub total_mass_kg: Option<MjWritten<f64>>,
    /// The main file, then the others in the order of reading.
    pub files: Vec<Arc<SourceFile>>,
}

impl MjModel {
    /// The joints of a body, in their order.
    pub fn joints_of(&self, body: usize) -> &[MjJoint] {
        &self.joints[self.bodies[body].joints.clone()]
    }

    /// The geoms of a body.
    pub fn geoms_of(&self, body: usize) -> &[MjGeom] {
        &self.geoms[self.bodies[body].geoms.clone()]
    }

    /// Number of positions: one for each hinge and slide joint, four for a ball joint, seven for a free joint.
    pub fn positions(&self) -> usize {
        self.joints.iter().map(|joint| joint.kind.positions()).sum()
    }
}
