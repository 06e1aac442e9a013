//! The scenario of a log as the text of a file, without what only a simulation needs.

use serde::Serialize;

use super::{Check, Scenario, SourceSettings};

/// What of a scenario a log needs: the rest has its defaults.
#[derive(Serialize)]
struct WrittenSource<'a> {
    schema_version: u32,
    name: &'a str,
    robot: &'a str,
    source: Option<&'a SourceSettings>,
    check: &'a [Check],
}

impl Scenario {
    /// Name, robot, source and checks as the text of a file; the rest is as by default.
    ///
    /// # Panics
    /// Never: plain data is TOML.
    pub fn source_to_toml(&self) -> String {
        let Self { schema_version, name, robot, source, check, .. } = self;
        let source = source.as_ref();
        let written = WrittenSource { schema_version: *schema_version, name, robot, source, check };
        toml::to_string(&written).expect("a scenario is TOML")
    }
}
