//! Lines, tables, colours and escapes of text for people: what a report's text is made of, and the last steps before a
//! terminal.

mod columns;
mod escape;
mod status_colour;
mod table;
mod units;

pub use columns::{NARROWEST, fitted};
pub(crate) use escape::with_visible_lines;
pub use escape::{Colours, for_people, visible_path};
pub use status_colour::with_coloured_status;
pub use table::{POSE_COLUMNS, Table, column_width, paragraph, pose_cells, with_one_sign, wrapped};
