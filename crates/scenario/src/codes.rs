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
            "A value has the wrong type. The message names the key, the expected type and the type found. A number has no quotes, a text has them.\n    wrong: [motion]\n    right: [[motion]]";
        NUMBER = "CGR-SCENARIO-006", "scenario::number",
            "A value is not finite, or is outside its permitted range. Correct it; the message has the range.\n    wrong: velocity_deg_s = { elbow_joint = -90.0 }\n    right: velocity_deg_s = { elbow_joint = 90.0 }";
        NO_KIND = "CGR-SCENARIO-008", "scenario::no_kind",
            "The key `kind` of a section is missing. It decides which other keys the section has. The help has the known kinds. Add it.\n    wrong: [controller] with stiffness = 2000.0 alone\n    right: kind = \"gravity_compensation\", too";
        UNKNOWN_KIND = "CGR-SCENARIO-009", "scenario::unknown_kind",
            "The `kind` of a section is unknown. The help has the known kinds.\n    wrong: kind = \"gravity\"\n    right: kind = \"gravity_compensation\"";
        NO_CONTROLLER = "CGR-SCENARIO-026", "scenario::no_controller",
            "The scenario has no controller. Without one nothing drives the joints. Add a [controller] section; the help lists the kinds.\n    wrong: no [controller]\n    right: [controller] and kind = \"gravity_compensation\"";
        SOURCE = "CGR-SCENARIO-091", "scenario::source",
            "The scenario takes the joint states of a log, and has a section that only a simulation needs. The log says how the joints moved: remove the section, or [source].\n    wrong: [source] and [controller]\n    right: [source] and log = \"monday.mcap\"";
        UNKNOWN_MOTION = "CGR-SCENARIO-029", "scenario::unknown_motion",
            "A motion has no target, or its target is unknown. The help lists the keys, one of which each motion needs.\n    wrong: [[motion]] with duration_s = 1.0 alone\n    right: move_joints_deg = { elbow_joint = 80.0 }, too";
        TARGET_POSITION = "CGR-SCENARIO-032", "scenario::target_position",
            "The target pose of the tool lacks a position. Give the position of the tool centre point in the world; for a pure rotation, its present position.\n    wrong: move_tcp = { rpy_deg = [180, 0, 0] }\n    right: move_tcp = { xyz_m = [0.5, -0.1, 0.3], rpy_deg = [180, 0, 0] }";
        NO_LIMIT = "CGR-SCENARIO-079", "scenario::no_limit",
            "A check has no limit, so it could never fail. Give at least one limit; the help names the keys.\n    wrong: kind = \"clearance\" alone\n    right: kind = \"clearance\" and minimum_mm = 20.0";
        EXPECT = "CGR-SCENARIO-082", "scenario::expect",
            "The scenario expects a failure of a check that it does not have, or lists checks while it expects the verdict pass. Name kinds of the checks that the scenario has, and verdict = \"fail\".\n    wrong: checks = [\"zone\"] without a [[check]] of zones\n    right: checks = [\"agreement\"]";
    }
}
