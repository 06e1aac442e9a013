//! What a robot is: URDF, SRDF, `robot.toml` and meshes, read into a validated [`Robot`] or refused with
//! diagnostics that say what is wrong, at which place, and what to do.
//!
//! Parsers take text and give a value or diagnostics; only `files/` opens files.

mod catch_panic;
mod chain;
mod codes;
mod configuration_file;
mod description;
mod diagnostic;
pub mod display;
mod edits;
mod elementary;
mod files;
mod lint;
mod load;
mod mesh;
mod model;
mod robot_file;
mod srdf;
pub mod units;
mod urdf;
mod visible;
mod written;
mod xml;

pub use catch_panic::catch_panic;
pub use chain::{ChainEnd, ChainEnds, ReportedChain};
pub use codes::Code;
pub use configuration_file::{
    Configurations, JointState, JointStateList, JsonList, RobotQList, configuration, configurations_schema,
    outside_limits, outside_limits_warning, read_configurations, read_states, unique_names,
};
pub use description::{NamedFiles, Places, RobotDescription, TABLE_DROPPED};
pub use diagnostic::{
    Diagnostic, Diagnostics, Finding, FindingPlace, Kind, LineCounter, Occurrence, Severity, SourceFile, Use,
    known_names, line_column, nearest,
};
pub use edits::{ChangedLines, TextEdit, changed_lines, edited};
pub use elementary::Elementary;
pub use files::{FileAccess, InputFile, RosPackages, is_standard_input, read_text};
pub use lint::{
    FileKind, FileToLint, IgnoredFinding, Ignores, SafeFix, declared_encoding, examine_srdf, robot_name,
    safe_fixes, safe_robot_file_fixes, still_mimics, undefined_materials, unit_slips, unknown_references,
    zero_limits,
};
pub use load::{load_opened_robot, load_robot, load_robot_with, parse_robot};
pub use mesh::{HullPoints, read_mesh};
pub use model::{
    ArmQ, ChainQ, DhConvention, DhRow, DhRowKind, DhTable, Geometry, Inertia, Joint, JointIndex, JointKind,
    JointLimit, JointParts, JointValues, Link, LinkIndex, Mesh, Mimic, Robot, RobotError, RobotQ, Shape,
    Tolerance, ToleranceScale, principal_moments,
};
pub use robot_file::{
    ConstantKey, ConstantPart, DeclaredDynamics, DeclaredInertial, InertialFrame, InertialPlaces,
    InertialPoint, RobotFilePlaces, RowKey, ValuePlace, dh_section, relative_path, robot_file_schema,
    robot_file_text, robot_file_values, toml_key, toml_string,
};
pub use urdf::{UrdfPlaces, parse_urdf, urdf_text};
pub use visible::{hidden_character, is_hidden, visible, visible_lines};
pub use written::{
    array::fixed_array,
    name::serde_name,
    number::{Slack, fitted_number},
    rpy::fitted_rpy_fixed_xyz_rad,
    toml_text,
    transform::{WrittenTransform, fitted_transform},
};
