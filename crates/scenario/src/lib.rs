//! A scenario as plain data: read from a file or made in code, changed key by key, and written back.
//! It knows no robot: crate `twin` checks it against one, in its `RunSetup`.

mod bodies;
mod checks;
pub mod codes;
mod data;
mod faults;
mod folder;
mod joints;
mod motions;
mod number;
pub mod numbers;
mod output;
mod place;
mod pose;
mod reading;
mod relative;
mod robot;
mod run_fault;
mod source;
mod source_text;
mod spaces;
mod text;
mod uncertainty;

pub use bodies::{GraspSettings, PathPoseSettings};
pub use checks::{
    AgreementCheck, Check, CheckKind, ClearanceCheck, ContactCheck, CycleTimeCheck, DynamicsCheck,
    EffortCheck, GoalCheck, InvariantsCheck, LimitsCheck, OnViolation, PoseCheck, PowerCheck, RecordingCheck,
    SamePointCheck, StepCheck, TrackingCheck, TwistCheck, UnitKeys, VelocityCheck, ZoneCheck,
};
pub use data::{Expectation, SCHEMA_VERSION, Scenario, SimulationSettings};
pub use faults::{
    AddedFrictionFault, DroppedSamplesFault, EncoderDriftFault, EncoderOffsetFault, FaultKind, FaultSettings,
    FaultTime, JointFault, LatencyFault, ScaledTorqueFault, ShiftedToolFault, SwappedJointsFault,
    WrongPayloadFault,
};
pub use folder::ScenarioFolder;
pub use joints::StartSettings;
pub use motions::{
    ArcMotion, ArcSettings, Between, JointMotion, JointPathMotion, LimitSettings, LineMotion, MotionSettings,
    OverLimit, PlaybackMotion, Profile, Progress, ServoMethod, ServoMotion, TcpMotion, TcpPathMotion,
    ToolOrientation,
};
pub use number::Range;
pub use output::{OutputSettings, TrajectoryFormat};
pub use place::{FilePlace, mark};
pub use pose::PoseSettings;
pub use reading::{ScenarioFile, robot_overrides, scenario_name, written_numbers};
pub use robot::{
    CONTROLLER_KINDS, ControllerKind, ControllerSettings, JointNumbers, JointSettings, OTHERS,
    PayloadInertia, PayloadSettings, SensorSettings, VelocitySensor,
};
pub use run_fault::{FaultQuantity, RunFault};
pub use source::{
    AngleUnit, JointRole, LogClock, LoggedEffort, LoggedJointSettings, LoggedPoseSettings, PoseOrigin,
    SourceSettings,
};
pub use spaces::{CylinderSettings, ObstacleSettings, ZoneSettings};
pub use uncertainty::{
    CaseSampling, NormalSettings, UncertaintySettings, VariedKeys, VarySettings, least_cases,
    usual_confidence,
};
