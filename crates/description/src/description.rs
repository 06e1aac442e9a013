//! Everything that a robot file declares, loaded and checked: what every command starts from.

use std::{collections::BTreeSet, path::PathBuf};

use nalgebra::Isometry3;

use crate::{dh_table::DhTable, diagnostic::Diagnostic, link::LinkIndex, robot::Robot};

/// How far two poses may be apart and still count as the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Distance of the origins.
    pub position_m: f64,
    /// Angle between the orientations.
    pub orientation_rad: f64,
}

impl Default for Tolerance {
    /// What files allow that write pi/2 with ten digits: a nanometre and a nanoradian.
    fn default() -> Self {
        Self { position_m: 1e-9, orientation_rad: 1e-9 }
    }
}

/// A robot with its analytical model, as a robot file (or a bare URDF) declares them.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotDescription {
    /// The robot file, or the URDF where there is no robot file.
    pub path: PathBuf,
    /// The name that the robot file gives, or the URDF's.
    pub name: String,
    /// The URDF.
    pub urdf_path: PathBuf,
    /// Links and joints.
    pub robot: Robot,
    /// The link that the model's base frame is declared in.
    pub base: LinkIndex,
    /// The link that the model's last frame is declared in; it hangs below the body of `base`.
    pub tip: LinkIndex,
    /// The Denavit-Hartenberg table; `None` for a bare URDF.
    pub dh: Option<DhTable>,
    /// Pose of the tool centre point in link `tip`; `None` where no tool is declared.
    pub tip_from_tcp: Option<Isometry3<f64>>,
    /// When model and twin count as the same.
    pub tolerance: Tolerance,
    /// Link pairs that an SRDF excludes from clearance, the smaller index first.
    pub disabled_collisions: BTreeSet<(LinkIndex, LinkIndex)>,
    /// What is suspicious but does not stop the work.
    pub warnings: Vec<Diagnostic>,
}
