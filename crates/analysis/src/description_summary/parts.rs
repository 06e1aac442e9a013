//! Links, joints and meshes of a robot as reports name them.

use std::{collections::BTreeMap, path::Path};

use congruent_description::{Geometry, Joint, JointKind, Link, LinkIndex, Robot, Shape};
use congruent_kinematics::{Pose, ReportedPose};
use schemars::JsonSchema;
use serde::Serialize;

/// One link, with its joint, mass and shapes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LinkSummary {
    /// Name of the link.
    pub name: String,
    /// The joint that carries it; `None` for the root.
    pub joint: Option<String>,
    /// Mass; `None` without an `<inertial>`.
    pub mass_kg: Option<f64>,
    /// Centre of mass in the frame of the link.
    pub com_m: Option<[f64; 3]>,
    /// Kinds of its visual shapes.
    pub visuals: Vec<ShapeSummary>,
    /// Kinds of its collision shapes.
    pub collisions: Vec<ShapeSummary>,
}

/// One shape of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShapeSummary {
    /// A box by its edge lengths.
    Box,
    /// A cylinder by radius and length.
    Cylinder,
    /// A sphere by its radius.
    Sphere,
    /// An ellipsoid by its half axes.
    Ellipsoid,
    /// A mesh: one of `meshes`.
    Mesh,
}

/// One joint, with its links, axis, limits and resistances.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointSummary {
    /// Name of the joint.
    pub name: String,
    /// Type of the joint: revolute, continuous, prismatic or fixed.
    pub kind: JointKind,
    /// The link nearer to the root.
    pub parent: String,
    /// The link that it carries.
    pub child: String,
    /// Unit of its position: `rad`, `m`, or empty for a fixed joint.
    pub unit: &'static str,
    /// The axis in the joint's frame; `None` for a fixed joint.
    pub axis_in_joint: Option<[f64; 3]>,
    /// Pose of the joint in the parent link.
    pub parent_from_joint: ReportedPose,
    /// Smallest position, if it has one.
    pub lower: Option<f64>,
    /// Largest position, if it has one.
    pub upper: Option<f64>,
    /// Largest speed, per second; `None` if none is stated.
    pub velocity: Option<f64>,
    /// Largest force or torque, N or N m; `None` if none is stated.
    pub effort: Option<f64>,
    /// Largest acceleration, per second squared; `null` if none is stated.
    pub acceleration: Option<f64>,
    /// Largest deceleration, per second squared; `null` if none is stated.
    pub deceleration: Option<f64>,
    /// Largest jerk, per second cubed; `null` if none is stated.
    pub jerk: Option<f64>,
    /// Viscous damping, N m s/rad or N s/m.
    pub damping: f64,
    /// Dry friction, N m or N.
    pub friction: f64,
    /// Inertia of motor and gear as the joint feels it, kg m^2 or kg; `null` if the description does not state it.
    pub armature: Option<f64>,
    /// The joint that it follows.
    pub mimic: Option<MimicSummary>,
}

/// `q = multiplier * q_master + offset`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MimicSummary {
    /// The joint that is followed.
    pub master: String,
    /// Ratio of the positions.
    pub multiplier: f64,
    /// Position if the master is at zero.
    pub offset: f64,
}

/// One mesh file, with the links that use it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct MeshSummary {
    /// The file, relative to the folder of the URDF if it is in it.
    pub file: String,
    /// Its triangles; 0 for an empty file, which is no shape.
    pub triangles: usize,
    /// Links that have it as a visual shape.
    pub visual_of: Vec<String>,
    /// Links that have it as a collision shape.
    pub collision_of: Vec<String>,
}

/// A limit above 0; descriptions write 0 for an unknown one.
pub(super) fn stated(limit: Option<f64>) -> Option<f64> {
    limit.filter(|&limit| limit > 0.0)
}

pub(super) fn links(robot: &Robot) -> Vec<LinkSummary> {
    robot.link_indices().map(|index| link(robot, index)).collect()
}

fn link(robot: &Robot, index: LinkIndex) -> LinkSummary {
    let Link { name, inertia, inertia_rounding: _, visuals, collisions } = robot.link(index);
    let shapes = |shapes: &[Shape]| shapes.iter().map(|shape| kind_of(&shape.geometry)).collect();
    LinkSummary {
        name: name.clone(),
        joint: robot.parent_joint(index).map(|joint| robot.joint(joint).name.clone()),
        mass_kg: inertia.map(|inertia| inertia.mass_kg),
        com_m: inertia.map(|inertia| inertia.link_from_inertial.translation.vector.into()),
        visuals: shapes(visuals),
        collisions: shapes(collisions),
    }
}

fn kind_of(geometry: &Geometry) -> ShapeSummary {
    match geometry {
        Geometry::Box { .. } => ShapeSummary::Box,
        Geometry::Cylinder { .. } => ShapeSummary::Cylinder,
        Geometry::Sphere { .. } => ShapeSummary::Sphere,
        Geometry::Ellipsoid { .. } => ShapeSummary::Ellipsoid,
        Geometry::Mesh(_) => ShapeSummary::Mesh,
    }
}

pub(super) fn joints(robot: &Robot) -> Vec<JointSummary> {
    robot.joints().iter().map(|written| joint(robot, written)).collect()
}

fn joint(robot: &Robot, joint: &Joint) -> JointSummary {
    let name = |link| robot.link(link).name.clone();
    let range = joint.position_range();
    let limit = joint.limit.unwrap_or_default();
    JointSummary {
        name: joint.name.clone(),
        kind: joint.kind,
        parent: name(joint.parent),
        child: name(joint.child),
        unit: joint.kind.unit(),
        axis_in_joint: joint.kind.is_movable().then(|| joint.axis_in_joint.into_inner().into()),
        parent_from_joint: (&Pose::from(joint.parent_from_joint)).into(),
        lower: range.map(|(lower, _)| lower),
        upper: range.map(|(_, upper)| upper),
        velocity: stated(limit.velocity),
        effort: stated(limit.effort),
        acceleration: stated(limit.acceleration),
        deceleration: stated(limit.deceleration),
        jerk: stated(limit.jerk),
        damping: joint.damping,
        friction: joint.friction,
        armature: joint.armature.filter(|_| joint.kind.is_movable()),
        mimic: joint.mimic.map(|mimic| MimicSummary {
            master: robot.joint(mimic.master).name.clone(),
            multiplier: mimic.multiplier,
            offset: mimic.offset,
        }),
    }
}

/// Every mesh file once, in the order of their names; `folder` is that of the URDF.
pub(super) fn meshes(robot: &Robot, folder: &Path) -> Vec<MeshSummary> {
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let mut found: BTreeMap<&Path, MeshSummary> = BTreeMap::new();
    for link in robot.links() {
        for (is_visual, shapes) in [(true, &link.visuals), (false, &link.collisions)] {
            for shape in shapes {
                let Geometry::Mesh(mesh) = &shape.geometry else { continue };
                let seen = found.entry(&mesh.path).or_insert_with(|| MeshSummary {
                    file: mesh.path.strip_prefix(&folder).unwrap_or(&mesh.path).display().to_string(),
                    triangles: mesh.triangles.len(),
                    visual_of: Vec::new(),
                    collision_of: Vec::new(),
                });
                let users = if is_visual { &mut seen.visual_of } else { &mut seen.collision_of };
                if users.last() != Some(&link.name) {
                    users.push(link.name.clone());
                }
            }
        }
    }
    found.into_values().collect()
}
