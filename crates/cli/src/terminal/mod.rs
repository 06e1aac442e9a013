//! What is written to the terminal, or to the program behind a pipe: [`print`] alone writes, the others make what it
//! writes.

mod json_output;
pub(crate) mod print;
pub(crate) mod progress;
mod width;

pub(crate) use congruent::text::layout;
pub(crate) use width::columns;
