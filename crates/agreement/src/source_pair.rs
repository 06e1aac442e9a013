//! The pairs of sources of link poses that are compared.

use schemars::JsonSchema;
use serde::Serialize;

/// Two sources of link poses: the model (the Denavit-Hartenberg table), the URDF, its screws (POE, product of
/// exponentials), and the simulation (the physics).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SourcePair {
    /// The table and the URDF chain.
    ModelUrdf,
    /// The screws of the URDF and the URDF chain.
    PoeUrdf,
    /// The table and the physics.
    ModelSimulation,
    /// The URDF chain and the physics.
    UrdfSimulation,
    /// The URDF chain and that of another description of the robot.
    UrdfOther,
    /// The table of another description of the robot and its own URDF chain.
    OtherModelUrdf,
}

impl SourcePair {
    /// Whether both sources are files of this comparison, whose digits count: physics and screws are computed.
    pub fn is_written(self) -> bool {
        matches!(self, Self::ModelUrdf | Self::UrdfOther | Self::OtherModelUrdf)
    }

    /// The pair in words.
    pub fn title(self) -> &'static str {
        match self {
            Self::ModelUrdf => "DH table against URDF chain",
            Self::PoeUrdf => "screws (POE) against URDF chain",
            Self::ModelSimulation => "DH table against physics",
            Self::UrdfSimulation => "URDF chain against physics",
            Self::UrdfOther => "URDF chain against other URDF",
            Self::OtherModelUrdf => "other DH table against its URDF chain",
        }
    }
}
