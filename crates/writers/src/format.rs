//! The formats of whole robots.

/// A format of whole robots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotFormat {
    /// URDF, as ROS reads it.
    Urdf,
    /// MJCF, the XML of MuJoCo.
    Mjcf,
}

impl RobotFormat {
    /// Its name, as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urdf => "URDF",
            Self::Mjcf => "MJCF",
        }
    }
}
