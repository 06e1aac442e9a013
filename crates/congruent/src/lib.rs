//! Is a robot's analytical model the same robot as its URDF? With the difference, its cause and a certificate.
//!
//! This is the crate that programs use: each module is one crate of the workspace, and [`prelude`] has what
//! most programs need.

pub use congruent_agreement as agreement;
pub use congruent_analysis as analysis;
pub use congruent_calibration as calibration;
pub use congruent_configurations as configurations;
pub use congruent_description as description;
pub use congruent_dynamics as dynamics;
pub use congruent_dynamics_agreement as dynamics_agreement;
pub use congruent_fault_diagnosis as fault_diagnosis;
pub use congruent_identification as identification;
pub use congruent_input as input;
pub use congruent_kinematics as kinematics;
pub use congruent_lint as lint_rules;
pub use congruent_logs as logs;
pub use congruent_mapping as mapping;
pub use congruent_meshes as meshes;
pub use congruent_mjcf as mjcf;
pub use congruent_monitors as monitors;
pub use congruent_motion as motion;
pub use congruent_page as page;
pub use congruent_proximity as proximity;
#[cfg(feature = "recording")]
pub use congruent_recording as recording;
pub use congruent_replay as replay;
pub use congruent_replay::identify;
pub use congruent_results as results;
pub use congruent_scenario as scenario;
pub use congruent_simulation as simulation;
pub use congruent_starter as starter;
pub use congruent_sweep as sweep;
pub use congruent_tables as tables;
pub use congruent_tolerances as tolerances;
pub use congruent_twin as twin;
pub use congruent_writers as writers;
pub use nalgebra;

mod check;
pub mod codes;
#[cfg(feature = "recording")]
mod joint_sweep;
mod run_comparison;
mod run_scenario;
pub mod schema;
pub mod text;
pub mod watch;
mod with_physics;

pub use check::{
    ChangedMass, ChangedRobots, ChangedTorque, DeclaredSource, Headline, LeftOutInChain, LoadedKind, NamedBy,
    OtherDescription, ReportedJoint, ReportedMapping, RevisionChange, RobotCheck, WrittenFix,
    cannot_be_checked, check, check_against, check_suite, checked_robot, load_robot_file_set,
    measured_headline, measured_suite, other_description, robots_of_changed, unusable_inertials,
};
pub use congruent_lint_report::{
    LintFinding, LintFix, LintReport, LintSummary, LintVerdict, lint, lint_among,
};
#[cfg(feature = "recording")]
pub use joint_sweep::{JointSweep, SweepError, SweptJoint, joint_sweep};
pub use run_comparison::{NotComparable, RunComparison, compare_runs};
pub use run_scenario::{PreparedScenario, RunStage, run_scenario};
pub use with_physics::{forward, joint_dynamics};

/// What most programs need.
pub mod prelude {
    pub use congruent_agreement::compare::{Agreement, CheckOptions};
    pub use congruent_analysis::forward::Source;
    pub use congruent_description::{Robot, RobotDescription, load_robot};
    pub use congruent_input::{Diagnostic, Findings, Override};
    pub use congruent_kinematics::{Arm, DhChain, LinkPoses, Pose, PoseError, SerialChain, UrdfTree};
    pub use congruent_monitors::verdict::Verdict;
    #[cfg(feature = "recording")]
    pub use congruent_recording::RerunFormat;
    pub use congruent_results::{Options, execute, report::RunReport};
    pub use congruent_scenario::Scenario;
    pub use congruent_twin::{Run, RunSetup};

    pub use crate::{RobotCheck, check, check_against, forward};
}
