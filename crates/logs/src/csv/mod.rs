//! Tables as text: CSV and its relatives. How a text is written is found by its beginning.

mod bounded_rows;
mod dialect;
mod rows;

#[cfg(test)]
pub(crate) use dialect::Dialect;
pub(crate) use rows::open;
