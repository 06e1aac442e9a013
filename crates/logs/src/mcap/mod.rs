//! Logs in MCAP. A file is read record by record, one chunk in memory; the summary at its end is used where it is there, and
//! never needed.

mod catalogue;
mod chunk;
mod framing;
mod messages;
mod reader;
mod summary;
#[cfg(test)]
pub(crate) mod write;

pub(crate) use framing::is_mcap;
pub(crate) use reader::McapReader;
