//! Everything that a robot file declares, loaded and checked: what every command starts from.

use std::{collections::BTreeSet, path::PathBuf, sync::Arc};

use nalgebra::Isometry3;

use crate::{
    diagnostic::{Diagnostic, Use, known_names},
    model::{DhTable, JointIndex, LinkIndex, Robot, Tolerance},
    robot_file::RobotFilePlaces,
    urdf::UrdfPlaces,
};

/// The texts that a description was read from: messages show lines of these, whatever stands in the
/// files by now.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Places {
    /// The robot file with its table; `None` if there is no table, or none of this chain.
    pub robot_file: Option<Arc<RobotFilePlaces>>,
    /// The URDF; `None` if the robot was made without one.
    pub urdf: Option<UrdfPlaces>,
}

/// A robot with its analytical model, as a robot file (or a bare URDF) declares them.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotDescription {
    /// The robot file, or the URDF if there is no robot file.
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
    /// Pose of the tool centre point in link `tip`; `None` if no tool is declared.
    pub tip_from_tcp: Option<Isometry3<f64>>,
    /// How far model and twin may be apart and still count as the same.
    pub tolerance: Tolerance,
    /// Link pairs that an SRDF excludes from clearance, the smaller index first.
    pub disabled_collisions: BTreeSet<(LinkIndex, LinkIndex)>,
    /// What is suspicious, and what stops another use than kinematics.
    pub warnings: Vec<Diagnostic>,
    /// The texts of robot file and URDF.
    pub places: Places,
}

impl RobotDescription {
    /// Whether the robot is fit for a use: whatever asks for more than kinematics asks here first.
    ///
    /// # Errors
    /// The findings that stop this use, as errors.
    pub fn for_use(&self, needed: Use) -> Result<(), Vec<Diagnostic>> {
        let stopping = self.warnings.iter().filter(|found| found.stops == Some(needed));
        let errors: Vec<Diagnostic> =
            stopping.map(|found| found.clone().needed_by(Some(Use::Kinematics))).collect();
        if errors.is_empty() { Ok(()) } else { Err(errors) }
    }

    /// The same robot with another chain; a name that is left out keeps its link, but a new base alone
    /// has the tip of its own longest chain. The table is dropped if the chain is another one.
    ///
    /// # Errors
    /// A link is unknown, or `tip` does not hang below `base`.
    pub fn with_chain(mut self, base: Option<&str>, tip: Option<&str>) -> Result<Self, Diagnostic> {
        let before = (self.base, self.tip);
        if let Some(base) = base {
            self.base = self.link("base", base)?;
            self.tip = self.robot.tip_of_longest_chain(self.base);
        }
        if let Some(tip) = tip {
            self.tip = self.link("tip", tip)?;
        }
        if self.robot.chain(self.base, self.tip).is_none() {
            let name = |link| &self.robot.link(link).name;
            let message =
                format!("tip \"{}\" does not hang below base \"{}\"", name(self.tip), name(self.base));
            return Err(Diagnostic::error("chain::broken", message)
                .with_help("no chain of joints leads from base down to tip"));
        }
        if before != (self.base, self.tip) {
            self.dh = None;
            self.tip_from_tcp = None;
            self.places.robot_file = None;
        }
        Ok(self)
    }

    /// The moving joints from base to tip, mimic joints among them.
    pub fn moving_chain(&self) -> Vec<JointIndex> {
        let joints = self.robot.chain(self.base, self.tip).unwrap_or_default();
        joints.into_iter().filter(|&joint| self.robot.joint(joint).kind.is_movable()).collect()
    }

    /// The entries of the configuration vector of [`RobotDescription::moving_chain`].
    pub fn moving_coordinates(&self) -> Vec<usize> {
        self.moving_chain().into_iter().filter_map(|joint| self.robot.coordinate(joint)).collect()
    }

    fn link(&self, role: &str, name: &str) -> Result<LinkIndex, Diagnostic> {
        self.robot.find_link(name).ok_or_else(|| {
            let links = self.robot.links().iter().map(|link| link.name.as_str());
            Diagnostic::error("chain::unknown_link", format!("{role} \"{name}\": the robot has no such link"))
                .with_help(known_names(name, "links", links))
        })
    }
}
