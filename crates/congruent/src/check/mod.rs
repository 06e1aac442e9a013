//! `check`: one file for each pair of sources whose dynamics is compared, and the report of all.

mod against;
mod cause_in_words;
mod change;
mod change_answer;
mod changed_table;
mod checked;
mod declared;
mod dynamics_in_words;
mod headline;
mod judged_by;
mod mapped;
mod mapped_joints;
mod model_frames;
mod narrowed;
mod own_model;
mod own_screws;
mod page;
mod part;
mod physics;
mod poses_of_other;
mod reported_mapping;
mod robot_check;
mod same_chain;
mod suite;
mod table_of_other;
mod titles;
mod with_other;

pub use against::OtherDescription;
pub use change::{ChangedMass, ChangedTorque, RevisionChange};
pub use checked::{check, check_against};
pub use declared::DeclaredSource;
pub use headline::Headline;
pub use page::checked_robot;
pub use reported_mapping::{ReportedJoint, ReportedMapping};
pub use robot_check::{RobotCheck, WrittenFix};
pub use suite::check_suite;
