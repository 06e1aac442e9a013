//! The algebra of the algorithms' loops: vectors as wide as the machine's, and what one body needs of them.

pub(crate) mod columns;
pub(crate) mod lanes;
pub(crate) mod rigid;
pub(crate) mod rooted;
