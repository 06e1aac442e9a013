//! What several tests need: the command, folders and files to call it on, and numbers to compare with.

pub(crate) mod changed_robot;
pub(crate) mod command;
pub(crate) mod corpus;
pub(crate) mod golden;
pub(crate) mod live;
pub(crate) mod measurements;
pub(crate) mod published_table;
pub(crate) mod scenario_files;
pub(crate) mod scratch_folder;
pub(crate) mod special_inputs;
pub(crate) mod suggested_changes;
