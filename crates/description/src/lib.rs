//! What a robot is: URDF, SRDF, `robot.toml` and meshes, read into a validated [`Robot`] or
//! refused with diagnostics that say what, where and what now.
//!
//! Parsers take text and give a value or diagnostics; only `file.rs` opens files.

mod configuration_file;
mod diagnostic;
pub mod display;
mod file;
mod finding;
mod findings;
mod fixed_array;
mod load;
mod mesh;
mod model;
mod packages;
mod robot_file;
mod srdf;
pub mod toml_text;
pub mod units;
mod urdf;
mod written_figure;
mod written_transform;
mod xml;

pub use configuration_file::{JointState, JsonList, configuration, read_configurations, read_states};
pub use diagnostic::{Diagnostic, Severity, SourceFile, known_names, line_column, nearest};
pub use file::read_text;
pub use finding::Finding;
pub use findings::Findings;
pub use fixed_array::fixed_array;
pub use load::load_robot;
pub use model::{
    ArmQ, ChainQ, DhConvention, DhRow, DhRowKind, DhTable, Geometry, Inertia, Joint, JointIndex, JointKind,
    JointLimit, JointParts, JointValues, Link, LinkIndex, Mesh, Mimic, Robot, RobotDescription, RobotError,
    RobotQ, Shape, Tolerance,
};
pub use robot_file::{ConstantKey, ConstantPart, FigurePlace, RobotFilePlaces, RowKey, dh_section};
pub use urdf::{UrdfPlaces, parse_urdf, urdf_text};
pub use written_figure::fitted_number;
pub use written_transform::{WrittenTransform, fitted_transform};
