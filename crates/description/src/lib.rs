//! What a robot is: URDF, SRDF, `robot.toml` and meshes, read into a validated [`Robot`] or
//! refused with diagnostics that say what, where and what now.
//!
//! Parsers take text and give a value or diagnostics; only `file.rs` opens files.

mod description;
mod dh_table;
mod diagnostic;
mod file;
mod findings;
mod fixed_array;
mod geometry;
mod inertia;
mod joint;
mod link;
mod load;
mod mesh;
mod packages;
mod robot;
mod robot_file;
mod srdf;
pub mod toml_text;
mod tree;
pub mod units;
mod urdf;
mod written_figure;
mod written_transform;
mod xml;

pub use description::{RobotDescription, Tolerance};
pub use dh_table::{DhConvention, DhRow, DhRowKind, DhTable};
pub use diagnostic::{Diagnostic, Severity, SourceFile, known_names, line_column, nearest};
pub use file::read_text;
pub use findings::Findings;
pub use fixed_array::fixed_array;
pub use geometry::{Geometry, Mesh, Shape};
pub use inertia::Inertia;
pub use joint::{Joint, JointIndex, JointKind, JointLimit, Mimic};
pub use link::{Link, LinkIndex};
pub use load::load_robot;
pub use robot::{JointParts, Robot, RobotError};
pub use robot_file::{ConstantKey, ConstantPart, FigurePlace, RobotFilePlaces, RowKey, dh_section};
pub use urdf::{UrdfPlaces, parse_urdf, urdf_text};
pub use written_figure::fitted_number;
pub use written_transform::{WrittenTransform, fitted_transform};
