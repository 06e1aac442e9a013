//! Scenarios that a command makes as the text of a file, without the sections that have their defaults.

use serde::Serialize;

use super::{
    Check, ControllerSettings, MotionSettings, ObstacleSettings, OutputSettings, Scenario, SourceSettings,
    StartSettings,
};

/// What of a scenario a log needs: the rest has its defaults.
#[derive(Serialize)]
struct WrittenSource<'a> {
    schema_version: u32,
    name: &'a str,
    robot: &'a str,
    source: Option<&'a SourceSettings>,
    check: &'a [Check],
}

/// What of a scenario a motion needs.
#[derive(Serialize)]
struct WrittenMotion<'a> {
    schema_version: u32,
    name: &'a str,
    robot: &'a str,
    start: &'a StartSettings,
    controller: &'a ControllerSettings,
    motion: &'a [MotionSettings],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    obstacle: &'a [ObstacleSettings],
    check: &'a [Check],
    output: &'a OutputSettings,
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

    /// Name, robot, start, controller, motions, obstacles, checks and output as the text of a file; the rest is as by default.
    ///
    /// # Panics
    /// Never: plain data is TOML.
    pub fn motion_to_toml(&self) -> String {
        let Self { schema_version, name, robot, start, controller, motion, obstacle, check, output, .. } =
            self;
        let (schema_version, robot) = (*schema_version, robot.as_str());
        let written =
            WrittenMotion { schema_version, name, robot, start, controller, motion, obstacle, check, output };
        toml::to_string(&written).expect("a scenario is TOML")
    }
}
