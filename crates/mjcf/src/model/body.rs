//! Bodies, and what a file says about their mass.

use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};

use super::written::{MjName, MjNotation, MjPlace, MjWritten};

/// A body: what moves with its joints.
#[derive(Debug, Clone, PartialEq)]
pub struct MjBody {
    /// Name; `body 2 of forearm` if the file has none. The first body is `world`.
    pub name: MjName,
    /// Index of the parent; `None` for the world.
    pub parent: Option<usize>,
    /// Pose in the parent when each joint is at its `ref`, frames included, m.
    pub parent_from_body: Isometry3<f64>,
    /// `pos` as it is written, m, in the innermost frame.
    pub pos: MjWritten<Vector3<f64>>,
    /// Orientation as it is written, in the innermost frame; its place has the key `quat`, `euler`, ...
    pub orientation: MjWritten<UnitQuaternion<f64>>,
    /// How its values are written; `body_from_frame` is in the parent.
    pub notation: MjNotation,
    /// The innermost `<frame>` around it in [`MjModel::frames`](super::MjModel).
    pub frame: Option<usize>,
    /// Its joints in [`MjModel::joints`](super::MjModel), which act in this order.
    pub joints: Range<usize>,
    /// Its geoms in [`MjModel::geoms`](super::MjModel).
    pub geoms: Range<usize>,
    /// Its sites in [`MjModel::sites`](super::MjModel).
    pub sites: Range<usize>,
    /// The `<inertial>`; without one, mass and inertia follow from the geoms.
    pub inertial: Option<MjInertial>,
    /// The compiler's settings on mass and inertia.
    pub inertia_rules: MjInertiaRules,
    /// Share of its weight that a force carries.
    pub gravcomp: MjWritten<f64>,
    /// Whether its pose comes from outside of the simulation.
    pub is_mocap: bool,
    /// The opening of its tag.
    pub place: MjPlace,
}

/// A `<frame>`: what is in it is placed in it.
#[derive(Debug, Clone, PartialEq)]
pub struct MjFrame {
    /// The next `<frame>` around it in [`MjModel::frames`](super::MjModel).
    pub outer: Option<usize>,
    /// `pos` as it is written, m.
    pub pos: MjWritten<Vector3<f64>>,
    /// Orientation as it is written.
    pub orientation: MjWritten<UnitQuaternion<f64>>,
    /// How its values are written; `body_from_frame` is the pose of what is around it, in which they are written.
    pub notation: MjNotation,
}

/// Mass and inertia that a file states.
#[derive(Debug, Clone, PartialEq)]
pub struct MjInertial {
    /// Mass, kg.
    pub mass: MjWritten<f64>,
    /// Centre of mass as it is written, m, in the innermost frame.
    pub pos: MjWritten<Vector3<f64>>,
    /// Orientation of the inertial frame as it is written.
    pub orientation: MjWritten<UnitQuaternion<f64>>,
    /// Inertial frame in the body, frames included, m; its origin is the centre of mass.
    pub body_from_inertial: Isometry3<f64>,
    /// Inertia about the centre of mass in the inertial frame, kg m^2; its place has the key `diaginertia` or `fullinertia`.
    pub inertia: MjWritten<Matrix3<f64>>,
    /// How its values are written.
    pub notation: MjNotation,
    /// The opening of its tag.
    pub place: MjPlace,
}

/// When masses follow from geoms: `inertiafromgeom`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MjInference {
    /// `false`: a body without `<inertial>` has no mass.
    Never,
    /// `auto`: for a body without `<inertial>`.
    WithoutInertial,
    /// `true`: always, if the body has geoms that count.
    Always,
}

/// The compiler's settings on mass and inertia, which an attached model has of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MjInertiaRules {
    /// When masses follow from geoms.
    pub inference: MjInference,
    /// First and last group of the geoms that count.
    pub groups: [i32; 2],
    /// `boundmass`: the least mass, kg.
    pub least_mass_kg: f64,
    /// `boundinertia`: the least principal moment, kg m^2.
    pub least_moment_kg_m2: f64,
    /// `balanceinertia`: moments that no body has are replaced by their mean.
    pub is_balanced: bool,
}
