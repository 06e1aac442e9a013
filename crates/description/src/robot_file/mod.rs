//! The robot file `robot.toml`: which URDF, which chain, which analytical model.

mod check;
mod dh_text;
mod digits;
mod edits;
mod inertials;
mod limits;
mod mapping;
mod other_names;
mod places;
mod poe;
mod range;
mod rows;
mod unit_mistakes;
mod written;
mod written_lint;

pub(crate) use check::{check, joint_for_link};
pub use dh_text::dh_text;
pub use digits::TableDigits;
pub(crate) use digits::{halves_at, typed_transform, typed_vector};
pub use inertials::{
    DeclaredInertial, DynamicsTable, InertialDigits, InertialFrame, InertialPlaces, InertialPoint,
};
pub use mapping::{DeclaredMapping, DeclaredReference, DeclaredVariable};
pub use places::{ConstantKey, ConstantPart, RobotFilePlaces, RowKey, ValuePlace};
pub(crate) use poe::{
    ScrewFrame, WrittenPoe, WrittenScrew, WrittenTwist, base_from_twist, screw_twist, space_twist,
};
pub(crate) use written::{WrittenDh, WrittenRow};
pub use written::{WrittenRobot, robot_file_schema};
pub use written_lint::{WrittenIgnore, WrittenLint};

use congruent_input::{
    Diagnostic, Diagnostics,
    codes::toml::{INVALID, MISSING_KEY},
    toml_text::parse_toml,
};

/// Size limit of a robot file, bytes.
pub const ROBOT_FILE_BYTES: u64 = 1 << 20;

/// The name that a robot file has in a robot's folder.
pub const ROBOT_FILE: &str = "robot.toml";

/// Parses a robot file; of a row without `kind` and of a tolerance that is a number the help has what the reader of TOML does
/// not know.
pub(crate) fn parse(text: &str, diagnostics: &mut Diagnostics) -> Option<WrittenRobot> {
    let mut found = Diagnostics::default();
    let written = parse_toml(text, &mut found);
    let with_kinds = |fault: Diagnostic| {
        let is_kind = fault.code == MISSING_KEY && fault.message.contains("\"kind\"");
        if is_kind {
            return fault.with_help("kind = \"revolute\" or kind = \"prismatic\"");
        }
        if fault.code == MISSING_KEY && fault.message.contains("\"frame\"") {
            return fault.with_help(
                "frame = \"space\" if the twists are in the base, frame = \"body\" if they are in the tip",
            );
        }
        if fault.code == MISSING_KEY && fault.message.contains("\"home\"") {
            return fault.with_help("home is the pose of the tip in the base at zero: home = { xyz_m = [0, 0, 0], rpy_deg = [0, 0, 0] }");
        }
        let key = fault.span.as_ref().and_then(|span| key_before(text.get(..span.start)?));
        if fault.code == INVALID && key == Some("tolerance") {
            return fault.with_help("tolerance = { position_mm = 0.5, orientation_deg = 0.1 }");
        }
        fault
    };
    diagnostics.extend(found.map(with_kinds).into_vec());
    written
}

/// The key of the value that follows a text: `tolerance` of `tolerance = `.
fn key_before(text: &str) -> Option<&str> {
    let key = text.rsplit('\n').next()?.trim_end().strip_suffix('=')?.trim();
    Some(key.rsplit(' ').next().unwrap_or(key))
}
