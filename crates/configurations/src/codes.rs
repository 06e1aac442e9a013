//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    configurations {
        JSON = "CGR-TABLE-001", "configurations::json",
            "The file is not a list of configurations: one on each line (JSON Lines), or a JSON array of at most 100,000.\n    {\"q\": {\"elbow_joint\": 0.1}}\n    {\"q\": {\"elbow_joint\": 0.2}}";
        TABLE = "CGR-TABLE-028", "configurations::table",
            "The file is no table of configurations. Its header names joints, each with its unit; the tables that a run writes are read, too.\n    shoulder_pan_joint_deg,elbow_joint_deg\n    30,90";
        NONE = "CGR-TABLE-002", "configurations::none",
            "The list of configurations is empty. One configuration with all joints at 0 is:\n    [{\"q\": {}}]";
        UNKNOWN_JOINT = "CGR-TABLE-003", "configurations::unknown_joint",
            "A configuration names a joint that the robot does not have or that does not move. The help has the most similar name and the known ones.\n    wrong: {\"q\": {\"elbow\": 0.1}}\n    right: {\"q\": {\"elbow_joint\": 0.1}}";
        MIMIC = "CGR-TABLE-004", "configurations::mimic",
            "A mimic joint is given at a position that contradicts the position of the joint it mimics. Leave mimic joints out: their positions follow from the mimicked joints.\n    wrong: {\"panda_finger_joint1\": 0.02, \"panda_finger_joint2\": 0.0}\n    right: {\"panda_finger_joint1\": 0.02}";
        OUTSIDE_LIMITS = "CGR-TABLE-005", "configurations::outside_limits",
            "A configuration is outside the joint limits. The result is computed, but the robot cannot reach this pose. Write angles in radians, within the limits of the joint.\n    wrong: {\"q\": {\"elbow_joint\": 90}}\n    right: {\"q\": {\"elbow_joint\": 1.5708}}";
    }
}
