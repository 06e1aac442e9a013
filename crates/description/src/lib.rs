//! What a robot is: URDF, SRDF, `robot.toml` and meshes, read into a validated [`Robot`] or refused with
//! diagnostics that say what is wrong, at which place, and what to do.
//!
//! Parsers take text and give a value or diagnostics; only `file.rs` opens files.

mod configuration_file;
mod description;
mod diagnostic;
mod diagnostics;
pub mod display;
mod file;
mod finding;
mod load;
mod mesh;
mod model;
mod packages;
mod robot_file;
mod srdf;
pub mod units;
mod urdf;
mod written;
mod xml;

pub use configuration_file::{
    JointState, JsonList, configuration, configurations_schema, read_configurations, read_states,
};
pub use description::{Places, RobotDescription};
pub use diagnostic::{Diagnostic, Severity, SourceFile, known_names, line_column, nearest};
pub use diagnostics::Diagnostics;
pub use file::read_text;
pub use finding::Finding;
pub use load::{load_robot, parse_robot};
pub use model::{
    ArmQ, ChainQ, DhConvention, DhRow, DhRowKind, DhTable, Geometry, Inertia, Joint, JointIndex, JointKind,
    JointLimit, JointParts, JointValues, Link, LinkIndex, Mesh, Mimic, Robot, RobotError, RobotQ, Shape,
    Tolerance,
};
pub use robot_file::{
    ChangedLines, ConstantKey, ConstantPart, RobotFilePlaces, RowKey, TextEdit, ValuePlace, dh_section,
    robot_file_schema,
};
pub use urdf::{UrdfPlaces, parse_urdf, urdf_text};
pub use written::{
    array::fixed_array,
    name::serde_name,
    number::{Slack, fitted_number},
    toml_text,
    transform::{WrittenTransform, fitted_transform},
};
