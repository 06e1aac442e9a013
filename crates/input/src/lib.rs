//! What every reader of files uses: diagnostics that say what is wrong, at which place, and what to do; units,
//! values as they are typed, and the files that may be opened.
//!
//! Parsers take text and give a value or diagnostics; only `files/` opens files.

mod catch_panic;
mod code;
pub mod codes;
mod diagnostic;
pub mod display;
mod edits;
mod files;
mod nearest;
mod quantity;
pub mod units;
mod visible;
mod written;
pub mod xml;

pub use catch_panic::catch_panic;
pub use code::Code;
pub use diagnostic::{
    Capability, Diagnostic, Diagnostics, Finding, FindingPlace, Findings, Grouping, LineCounter, Occurrence,
    Severity, SourceFile, line_column,
};
pub use edits::{ChangedLines, PastedLines, TextEdit, changed_lines, edited, line_end, lines_in_words};
pub use files::{
    FileAccess, InputFile, Packages, Resolved, RevisionFiles, RevisionName, RosPackages, TextKind, TextLines,
    TomlKind, absence, direct_path, folder_of, head_of, is_standard_input, not_found, open_regular,
    portable_path, portable_text, read_text, relative_path, unreadable,
};
pub use nearest::{known_names, nearest};
pub use quantity::{Quantity, SiUnit};
pub use visible::{hidden_character, is_hidden, visible, visible_lines};
pub use written::{
    array::fixed_array,
    digits::{TypedNumber, half_places, half_places_of_point, half_places_of_values},
    distinct_overrides::distinct_places,
    name::serde_name,
    number::{self, Slack, fitted_number},
    numbers_at::NumberAt,
    overrides::Override,
    rotation_from_rpy_fixed_xyz,
    rpy::{axes_of_rpy_fixed_xyz, fitted_rpy_fixed_xyz_rad},
    rpy_fixed_xyz_rad, serde_in_words,
    toml_literal::{toml_key, toml_string},
    toml_text,
    transform::{WrittenTransform, fitted_transform},
    typing_error::TypingError,
    wrong_unit::{WrongUnit, unit_hint},
};
