//! Logs in MCAP. A file is read record by record, one chunk in memory; the summary at its end is used where it is there, and
//! never needed.

mod channels;
mod chunk;
mod framing;
mod reader;
mod records;
mod summary;
#[cfg(test)]
pub(crate) mod write;

pub(crate) use framing::is_mcap;
pub(crate) use reader::McapReader;
