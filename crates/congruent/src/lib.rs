//! Is a robot's analytical model the same robot as its URDF? With the difference, its cause and a certificate.
//!
//! This is the crate that programs use: each module is one crate of the workspace, and [`prelude`] has what
//! most programs need.

pub use congruent_agreement as agreement;
pub use congruent_analysis as analysis;
pub use congruent_calibration as calibration;
pub use congruent_description as description;
pub use congruent_dynamics as dynamics;
pub use congruent_dynamics_agreement as dynamics_agreement;
pub use congruent_kinematics as kinematics;
pub use congruent_page as page;
#[cfg(feature = "recording")]
pub use congruent_recording as recording;
pub use congruent_simulation as simulation;
pub use congruent_twin as twin;
pub use nalgebra;

mod check;
#[cfg(feature = "recording")]
mod joint_sweep;
mod lint;
mod run_comparison;
pub mod schema;
pub mod starter;
mod with_physics;

pub use check::{
    DeclaredSource, OtherDescription, RobotCheck, check, check_against, check_suite, checked_robot,
};
#[cfg(feature = "recording")]
pub use joint_sweep::{JointSweep, SweepError, SweptJoint, joint_sweep};
pub use lint::{LintFinding, LintFix, LintReport, LintVerdict, lint, lint_among};
pub use run_comparison::{NotComparable, RunComparison, compare_runs};
pub use with_physics::{forward, joint_dynamics};

/// What is wrong with an input, one finding in each line, without the lines of the file.
pub fn listed(found: &[description::Diagnostic]) -> String {
    found.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// What most programs need.
pub mod prelude {
    pub use congruent_agreement::compare::{Agreement, CheckOptions};
    pub use congruent_analysis::forward::Source;
    pub use congruent_description::{Diagnostic, Robot, RobotDescription, load_robot};
    pub use congruent_kinematics::{Arm, DhChain, LinkPoses, Pose, PoseError, SerialChain, UrdfTree};
    #[cfg(feature = "recording")]
    pub use congruent_recording::RerunFormat;
    pub use congruent_twin::{
        Options, Run, RunSetup, execute,
        report::RunReport,
        scenario::{Override, Scenario},
        verdict::Verdict,
    };

    pub use crate::{RobotCheck, check, check_against, forward, listed};
}
