//! MJCF (MuJoCo XML) as plain, resolved data, each value with its place.
//!
//! A file is read as MuJoCo 4.0 reads it: included files, settings of the compiler, classes of defaults, frames, replicas and
//! attached models are resolved, angles are in radians, and what MuJoCo refuses is refused with file, line and help. Whoever
//! makes a robot of a model decides what it needs; nothing here knows robots.
//!
//! Left out, because no pose, inertia or effort depends on it: rendering, sensors, contact parameters, `<custom>`. Parts that
//! do matter and are not read are reported: scaled frames, flexible bodies, plugins.

pub mod codes;
mod defaults;
mod document;
mod grammar;
mod inertia;
mod model;
mod read;
mod rounding;
mod settings;

use std::sync::Arc;

use congruent_input::{Diagnostic, Diagnostics, SourceFile};

pub use inertia::{MeshMass, MjMassProperties, mesh_mass, moving_body_without_mass};
pub use model::{
    MjActuator, MjBody, MjContactExclusion, MjEffort, MjEquality, MjEqualityKind, MjFrame, MjGeom,
    MjGeomMass, MjInertiaRules, MjInertial, MjInference, MjJoint, MjJointKind, MjKeyframe, MjMesh,
    MjMeshInertia, MjModel, MjName, MjNotation, MjPlace, MjShape, MjSite, MjTarget, MjTendon, MjWritten,
};
pub use rounding::{MjBodyRounding, MjInertialRounding, MjJointRounding, MjValueRounding};

/// Opens a file that a model names, by its path relative to the folder of the main file.
pub type ReadFile<'a> = dyn FnMut(&str) -> Result<Arc<SourceFile>, Diagnostic> + 'a;

/// Reads a model; `None` if `diagnostics` has an error. Every diagnostic names its file.
///
/// `include` opens the files that the model includes or attaches. It should refuse files that are too large: the number of
/// files, elements and copies is bounded here, the size of a file is not.
///
/// # Examples
/// ```
/// use std::sync::Arc;
/// use congruent_input::{Diagnostics, SourceFile};
/// let text = r#"<mujoco><worldbody><body name="arm" euler="0 0 90">
///   <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.1 0.1"/><joint name="hinge" range="-90 90"/>
/// </body></worldbody></mujoco>"#;
/// let main = SourceFile { path: "arm.xml".into(), text: text.to_owned(), is_foreign: false };
/// let mut diagnostics = Diagnostics::default();
/// let model = congruent_mjcf::parse(&Arc::new(main), &mut |_| unreachable!(), &mut diagnostics).unwrap();
/// let range = model.joints[0].range.as_ref().unwrap();
/// assert_eq!(range.value, [-90_f64.to_radians(), 90_f64.to_radians()]);
/// assert_eq!(range.place.as_ref().unwrap().text(), "-90 90");
/// ```
pub fn parse(
    main: &Arc<SourceFile>,
    include: &mut ReadFile<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<MjModel> {
    let mut found = Diagnostics::default();
    let model = read::model(main, include, &mut found);
    let is_refused = found.has_error();
    diagnostics.extend(found.into_vec());
    model.filter(|_| !is_refused)
}
