//! The robot file `robot.toml`: which URDF, which chain, which analytical model.

mod check;
mod dh_text;
mod digits;
mod edits;
mod inertials;
mod limits;
mod mapping;
mod places;
mod rows;
mod unit_mistakes;
mod written;
mod written_lint;

pub(crate) use check::check;
pub use dh_text::dh_text;
pub use digits::TableDigits;
pub use inertials::{DeclaredInertial, DynamicsTable, InertialFrame, InertialPlaces, InertialPoint};
pub use mapping::{DeclaredMapping, DeclaredReference, DeclaredVariable};
pub use places::{ConstantKey, ConstantPart, RobotFilePlaces, RowKey, ValuePlace};
pub use written::{WrittenRobot, robot_file_schema};
pub use written_lint::{WrittenIgnore, WrittenLint};

use congruent_input::{Diagnostic, Diagnostics, codes::toml::MISSING_KEY, toml_text::parse_toml};

/// Size limit of a robot file, bytes.
pub(crate) const ROBOT_FILE_BYTES: u64 = 1 << 20;

/// The name that a robot file has in a robot's folder.
pub(crate) const ROBOT_FILE: &str = "robot.toml";

/// Parses a robot file; of a row without `kind` the help has the two kinds, which the reader of TOML does not know.
pub(crate) fn parse(text: &str, diagnostics: &mut Diagnostics) -> Option<WrittenRobot> {
    let mut found = Diagnostics::default();
    let written = parse_toml(text, &mut found);
    let with_kinds = |fault: Diagnostic| {
        let is_kind = fault.code == MISSING_KEY && fault.message.contains("\"kind\"");
        if is_kind { fault.with_help("kind = \"revolute\" or kind = \"prismatic\"") } else { fault }
    };
    diagnostics.extend(found.map(with_kinds).into_vec());
    written
}
