//! A scenario as plain data: read from a file or made in code, changed key by key, and written back.
//! `setup/` checks it against its robot.

mod checks;
mod data;
mod joints;
mod motions;
mod number;
mod place;
mod pose;
mod profile;
mod reading;
mod spaces;
mod text;

pub use checks::{
    AgreementCheck, Check, CheckKind, ClearanceCheck, ContactCheck, CycleTimeCheck, DynamicsCheck, GoalCheck,
    InvariantsCheck, LimitsCheck, OnViolation, PowerCheck, TrackingCheck, TwistCheck, ZoneCheck,
};
pub use data::{ControllerSettings, Expectation, SCHEMA_VERSION, Scenario, SimulationSettings};
pub use joints::StartSettings;
pub use motions::{JointMotion, MotionSettings, ServoMethod, ServoMotion, TcpMotion};
pub(crate) use number::Range;
pub use place::FilePlace;
pub(crate) use place::mark;
pub use pose::PoseSettings;
pub use profile::{Profile, Progress};
pub use reading::{Override, ScenarioFile};
pub use spaces::{CylinderSettings, ObstacleSettings, ZoneSettings};
