//! The dynamics that a robot file declares beside the URDF, such as a vendor's table of masses: values only.

use congruent_robot::JointIndex;
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::Deserialize;

/// The frame of the parameters of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InertialFrame {
    /// The frame of the link that the joint carries.
    Link,
    /// A frame of the Denavit-Hartenberg table, from 1: that of the joint's row.
    Dh(usize),
}

/// The point that a tensor is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InertialPoint {
    /// The tensor is about the centre of mass.
    Com,
    /// The tensor is about the origin of the frame of the parameters.
    Frame,
}

/// The declared parameters of the body that a joint carries: its link and all links that are fixed to it.
#[derive(Debug, Clone, PartialEq)]
pub struct DeclaredInertial {
    /// The joint that carries the body.
    pub joint: JointIndex,
    /// The frame of centre of mass and tensor.
    pub frame: InertialFrame,
    /// The reference point of the tensor; its axes are those of `frame`.
    pub about: InertialPoint,
    /// Mass of the body, kg; positive.
    pub mass_kg: f64,
    /// Centre of mass in `frame`, m; `None` if it is not declared.
    pub com_m: Option<Vector3<f64>>,
    /// Rotational inertia about `about`, in the axes of `frame`, kg m^2; `None` if it is not declared.
    pub tensor_kg_m2: Option<Matrix3<f64>>,
    /// Inertia of the motor behind its gear, kg m^2 or kg; `None` if it is not declared.
    pub armature: Option<f64>,
    /// Damping, N m s/rad or N s/m; `None` if it is not declared.
    pub damping: Option<f64>,
    /// Dry friction, N m or N; `None` if it is not declared.
    pub friction: Option<f64>,
}

/// The dynamics that a robot file declares.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicsTable {
    /// The publication that the values are from.
    pub source: Option<String>,
    /// Gravity in the frame of link `base`, m/s^2; `None` if it is not declared.
    pub gravity_in_base_m_s2: Option<Vector3<f64>>,
    /// The bodies, in the order of the file.
    pub inertials: Vec<DeclaredInertial>,
}
