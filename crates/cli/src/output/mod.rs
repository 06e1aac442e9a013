//! Files that commands write: the file itself and its folder, the page of `--html`, the plot of `--plot`.

pub(crate) mod file;
pub(crate) mod folders;
pub(crate) mod page;
pub(crate) mod plot;
