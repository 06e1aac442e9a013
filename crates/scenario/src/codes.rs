//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    scenario {
        ROBOT_GIVEN = "CGR-SCENARIO-089", "scenario::robot_given" unreadable,
            "The file or folder is a robot, and the command takes a scenario.\n    congruent new scenario robots/ur5e --to first.toml";
        VERSION = "CGR-SCENARIO-001", "scenario::version",
            "This program cannot read the format version of the scenario. Set it to 1, the only version.\n    schema_version = 1";
        NAME = "CGR-SCENARIO-002", "scenario::name",
            "The name of the scenario is empty. The results are written to a folder of this name. Give it one.\n    name = \"pick\"";
        TYPE = "CGR-SCENARIO-005", "scenario::type",
            "A value has the wrong type. The message names the key, the expected type and the type found. A number has no quotes, a text has them.";
        NUMBER = "CGR-SCENARIO-006", "scenario::number",
            "A value is not finite, or is outside its permitted range.";
        NO_KIND = "CGR-SCENARIO-008", "scenario::no_kind",
            "The key `kind` of a section is missing. It decides which other keys the section has. The help has the known kinds.";
        UNKNOWN_KIND = "CGR-SCENARIO-009", "scenario::unknown_kind",
            "The `kind` of a section is unknown. The help has the known kinds.";
        NO_CONTROLLER = "CGR-SCENARIO-026", "scenario::no_controller",
            "The scenario has no controller. Without one nothing drives the joints. Add a [controller] section; the help lists the kinds.";
        UNKNOWN_MOTION = "CGR-SCENARIO-029", "scenario::unknown_motion",
            "A motion has no target, or its target is unknown. The help lists the keys, one of which each motion needs.";
        TARGET_POSITION = "CGR-SCENARIO-032", "scenario::target_position",
            "The target pose of the tool lacks a position. Give the position of the tool centre point in the world; for a pure rotation, its present position.";
        NO_LIMIT = "CGR-SCENARIO-079", "scenario::no_limit",
            "A check has no limit, so it could never fail. Give at least one limit; the help names the keys.";
        EXPECT = "CGR-SCENARIO-082", "scenario::expect",
            "The scenario expects a failure of a check that it does not have, or lists checks while it expects the verdict pass.";
    }
    cli {
        SET = "CGR-COMMAND-004", "cli::set",
            "--set is not of the form KEY=VALUE with a key of the scenario.\n    --set controller.stiffness=500";
    }
}
