//! A scenario as plain data: read from a file or made in code, changed key by key, and written back.
//! `setup/` checks it against its robot.

mod bodies;
mod checks;
mod data;
mod faults;
mod folder;
mod joints;
mod motions;
mod number;
mod output;
mod place;
mod pose;
mod reading;
mod robot;
mod spaces;
mod text;

pub use bodies::{GraspSettings, PathPoseSettings};
pub(crate) use checks::UnitKeys;
pub use checks::{
    AgreementCheck, Check, CheckKind, ClearanceCheck, ContactCheck, CycleTimeCheck, DynamicsCheck, GoalCheck,
    InvariantsCheck, LimitsCheck, OnViolation, PowerCheck, TrackingCheck, TwistCheck, ZoneCheck,
};
pub use data::{Expectation, SCHEMA_VERSION, Scenario, SimulationSettings};
pub(crate) use faults::FaultTime;
pub use faults::{
    AddedFrictionFault, DroppedSamplesFault, EncoderDriftFault, EncoderOffsetFault, FaultKind, FaultSettings,
    JointFault, LatencyFault, ScaledTorqueFault, ShiftedToolFault, SwappedJointsFault, WrongPayloadFault,
};
pub(crate) use folder::ScenarioFolder;
pub use joints::StartSettings;
pub use motions::{
    ArcMotion, ArcSettings, Between, JointMotion, JointPathMotion, LimitSettings, LineMotion, MotionSettings,
    OverLimit, PlaybackMotion, Profile, Progress, ServoMethod, ServoMotion, TcpMotion, TcpPathMotion,
    ToolOrientation,
};
pub(crate) use number::Range;
pub use output::{OutputSettings, TrajectoryFormat};
pub use place::FilePlace;
pub(crate) use place::mark;
pub use pose::PoseSettings;
pub use reading::{Override, ScenarioFile, scenario_name};
pub(crate) use robot::{CONTROLLER_KINDS, ControllerKind, OTHERS};
pub use robot::{
    ControllerSettings, JointNumbers, JointSettings, PayloadInertia, PayloadSettings, SensorSettings,
    VelocitySensor,
};
pub use spaces::{CylinderSettings, ObstacleSettings, ZoneSettings};
