//! Data that a finished run adds to its recording, all from its report.

pub(crate) mod joint_limits;
pub(crate) mod limit_lines;
pub(crate) mod measures;
pub(crate) mod summary;
pub(crate) mod timeline;
