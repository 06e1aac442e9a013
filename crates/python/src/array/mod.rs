//! Arrays of numpy: what a caller gives as rows of numbers, and results that are computed row by row on all cores.

mod argument;
mod joint_rows;
mod parallel;
mod result;

pub(crate) use argument::{ArrayArgument, refused_array};
pub(crate) use joint_rows::{JointRows, same_rows};
pub(crate) use parallel::{RowBlocks, fill_rows};
pub(crate) use result::{BatchShape, array_of_rows, filled_array};
