//! What is written to the terminal, or to the program behind a pipe: [`print`] alone writes, the others make what it
//! writes.

mod json_output;
pub(crate) mod layout;
pub(crate) mod print;
pub(crate) mod progress;
mod status_colour;
pub(crate) mod table;
pub(crate) mod text;
