//! Joint states and poses in JSON Lines: a line for each message, in a file or in a stream that comes while it is read.

mod bounded_line;
mod line;
mod reader;
mod stream;

pub(crate) use reader::JsonLinesReader;
pub(crate) use stream::{BadLine, JsonLines, LineEvents};
