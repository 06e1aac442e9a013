//! MJCF to a [`Robot`]: a body is a link, and what a robot cannot express is reported.
//!
//! Crate `mjcf` reads the file. Here
//! 1. `tree` makes links and joints of bodies, `joint` the values of a joint, `site` the frames of sites;
//! 2. `inertia` and `shape` give the links their mass and shapes, with meshes from `mesh`;
//! 3. `coupling` makes followers of equalities, `unmodeled` lists what forces would need and a robot has no place for;
//! 4. `places` finds the values of the robot in the files.
//!
//! The root is the link `world`, body 0 of MuJoCo, so that poses of links are those of MuJoCo's bodies.

mod coupling;
mod inertia;
mod joint;
mod mesh;
mod names;
mod placed;
mod places;
mod rounding;
mod shape;
mod site;
mod tree;
mod unmodeled;

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

use congruent_input::{Capability, Diagnostic, Diagnostics, SourceFile};
use congruent_meshes::FindMesh;
use congruent_mjcf::{MjModel, ReadFile, codes::mjcf::LOOP};
use congruent_robot::{JointKind, LinkIndex, Robot};

pub use self::places::MjcfPlaces;
use self::{
    mesh::ModelMeshes,
    places::{FixedPart, PartsByName},
    tree::RobotParts,
};
use crate::codes;

/// Most links and moving joints; as for a URDF.
const MOST_LINKS: usize = 10_000;
const MOST_MOVING: usize = 2_000;

/// The files beside the main file of a model: those that it includes, and its meshes.
pub(crate) struct MjcfInputs<'a, 'i, 'm> {
    pub(crate) include: &'a mut ReadFile<'i>,
    pub(crate) find_mesh: &'a mut FindMesh<'m>,
}

/// A robot, the pairs of its links whose contacts the model excludes, the smaller index first, and where its values are written.
pub(crate) struct ModelRobot {
    pub(crate) robot: Robot,
    pub(crate) excluded: BTreeSet<(LinkIndex, LinkIndex)>,
    pub(crate) places: MjcfPlaces,
}

/// Whether the root element of a text is `<mujoco>`, as far as its first tag says. What is before it is skipped: a byte order
/// mark, the declaration, comments.
pub fn is_mjcf(text: &str) -> bool {
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    loop {
        let end = match rest {
            _ if rest.starts_with("<!--") => "-->",
            _ if rest.starts_with("<?") => "?>",
            _ => break,
        };
        let Some((_, after)) = rest.split_once(end) else { return false };
        rest = after.trim_start();
    }
    let after = rest.strip_prefix("<mujoco").and_then(|after| after.chars().next());
    after.is_some_and(|next| next.is_whitespace() || next == '>' || next == '/')
}

/// Reads a robot; `None` if `diagnostics` holds an error.
pub(crate) fn parse(
    source: &Arc<SourceFile>,
    inputs: &mut MjcfInputs<'_, '_, '_>,
    diagnostics: &mut Diagnostics,
) -> Option<ModelRobot> {
    let mut found = Diagnostics::default();
    let model = congruent_mjcf::parse(source, inputs.include, &mut found);
    // The reader knows no uses of a robot: a body of a loop is at its pose in the tree, but forces act through the loop.
    let stopping = |found: Diagnostic| {
        if found.code == LOOP { found.needed_by(Some(Capability::Physics)) } else { found }
    };
    diagnostics.extend(found.map(stopping).into_vec());
    let model = Arc::new(model?);
    if let Err(fault) = bounded(&model) {
        diagnostics.push(fault.in_file(source));
        return None;
    }
    let robot = robot(&model, inputs.find_mesh, diagnostics);
    robot.filter(|_| !diagnostics.has_error())
}

/// Refuses a model that is too large to be processed in a reasonable time.
fn bounded(model: &MjModel) -> Result<(), Diagnostic> {
    let counts = [
        ("bodies and sites", model.bodies.len() + model.sites.len(), MOST_LINKS),
        ("joints", model.joints.len(), MOST_MOVING),
    ];
    match counts.into_iter().find(|(_, count, most)| count > most) {
        Some((what, count, most)) => {
            let message = format!("too many {what}: {count}, the limit is {most}");
            Err(Diagnostic::error(congruent_mjcf::codes::mjcf::TOO_LARGE, message).at(0..0))
        }
        None => Ok(()),
    }
}

fn robot(
    model: &Arc<MjModel>,
    find_mesh: &mut FindMesh<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<ModelRobot> {
    let mut parts = RobotParts::from_model(model, diagnostics);
    site::add(model, &mut parts, diagnostics);
    let mut meshes = ModelMeshes::new(model, find_mesh);
    shape::add(model, &mut parts, &mut meshes, diagnostics);
    inertia::add(model, &mut parts, &mut meshes, diagnostics);
    coupling::add(model, &mut parts, diagnostics);
    unmodeled::report(model, &parts, diagnostics);
    let (links_of_bodies, excluded) = (parts.body_links.clone(), &model.exclusions);
    let places = MjcfPlaces::new(Arc::clone(model), parts_by_name(model, &parts));
    let made = Robot::new(robot_name(model), parts.links, parts.joints);
    let robot = diagnostics.keep(made.map_err(|error| {
        let fault = Diagnostic::error(codes::mjcf::TREE, error.to_string()).at(0..0);
        fault.in_file(&model.files[0])
    }))?;
    let link = |body: usize| robot.find_link(&links_of_bodies[body]);
    let pair = |[one, other]: [usize; 2]| Some((link(one)?.min(link(other)?), link(one)?.max(link(other)?)));
    let excluded = excluded.iter().filter_map(|of| pair(of.bodies)).collect();
    Some(ModelRobot { robot, excluded, places })
}

fn parts_by_name(model: &MjModel, parts: &RobotParts) -> PartsByName {
    let by_name = |(index, name): (usize, &String)| (name.clone(), index);
    let joints = parts.joint_positions.iter().enumerate();
    let moving = joints.filter_map(|(index, at)| Some((index, &parts.joints[(*at)?].joint.name)));
    let bodies: BTreeMap<String, usize> = parts.body_links.iter().enumerate().map(by_name).collect();
    // A link of a site has its name, or this prefix if that was taken.
    let site = |link: &str| {
        let is_of = |name: &str| link == name || link.strip_prefix("site:") == Some(name);
        model.sites.iter().position(|site| site.name.is_written && is_of(&site.name.text))
    };
    let part = |link: &str| {
        let body = bodies.get(link).map(|body| FixedPart::Body(*body));
        body.or_else(|| site(link).map(FixedPart::Site))
    };
    let fixed = parts.joints.iter().filter(|of| of.joint.kind == JointKind::Fixed);
    let fixed = fixed.filter_map(|of| Some((of.joint.name.clone(), part(&of.child)?))).collect();
    PartsByName { joints: moving.map(by_name).collect(), fixed, bodies }
}

/// The name of the model, or that of its file.
fn robot_name(model: &MjModel) -> String {
    let file = || model.files[0].path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    if model.name.is_empty() { file().unwrap_or_default() } else { model.name.clone() }
}

#[cfg(test)]
mod tests;
