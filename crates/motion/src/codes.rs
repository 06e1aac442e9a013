//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    scenario {
        UNKNOWN_JOINT = "CGR-SCENARIO-010", "scenario::unknown_joint",
            "The robot has no moving joint of this name. The help has the most similar name and the known ones.";
        MIMIC_JOINT = "CGR-SCENARIO-011", "scenario::mimic_joint",
            "The joint mimics another joint and has no actuator of its own. Name the mimicked joint.";
        JOINT_UNIT = "CGR-SCENARIO-013", "scenario::joint_unit",
            "A value is in metres for a revolute joint, or in degrees or radians for a prismatic one. The help names the keys that fit the joint.";
        JOINT_TWICE = "CGR-SCENARIO-014", "scenario::joint_twice",
            "A joint is given twice. Only one of the two values could apply. Keep one.";
        LIMIT_TWICE = "CGR-SCENARIO-016", "scenario::limit_twice",
            "A limit of a joint is given twice. Only one of the two could apply. Keep one.";
        NOTHING_MOVES = "CGR-SCENARIO-030", "scenario::nothing_moves",
            "A motion in the least time ends at its start position, so nothing moves. Give `duration_s`, or remove the motion.";
        TARGET_LIMIT = "CGR-SCENARIO-031", "scenario::target_limit",
            "The target of a motion is outside the limits of a joint. Change the target, or the limits in the URDF if they are wrong.";
        OUT_OF_REACH = "CGR-SCENARIO-033", "scenario::out_of_reach",
            "No joint positions bring the tool to the target. The target is that of the tool centre point in the world. The message has the smallest error that was reached.";
        MOVE_TCP = "CGR-SCENARIO-034", "scenario::move_tcp",
            "The chain cannot move its tool to a target, as a chain with fewer than six joints cannot to most poses, or one whose joints follow others. Give the target as joint positions (kind = \"joint\"), or its position alone.";
        OVER_LIMIT = "CGR-SCENARIO-035", "scenario::over_limit",
            "A motion exceeds the velocity or acceleration limit of a joint. The help names the shortest duration within the limits; or the motion is slowed down by this.\n    [limits]\n    over_limit = \"slow\"";
        NO_VELOCITY_LIMIT = "CGR-SCENARIO-036", "scenario::no_velocity_limit",
            "A motion in the least time needs velocity limits, and a joint has none. Give `duration_s`, or a velocity under [limits].";
        SLOWED = "CGR-SCENARIO-037", "scenario::slowed",
            "A motion takes longer than requested, because a joint would otherwise exceed its limit. Give the longer duration to be rid of the warning.";
        PATH = "CGR-SCENARIO-039", "scenario::path",
            "The tool cannot follow a path. The message names the point and what stops the arm there: out of reach, at a joint limit or at a singularity. Move that point, or begin the path in another configuration.";
        PATH_POINTS = "CGR-SCENARIO-040", "scenario::path_points",
            "A path has no points, or two successive points are equal. Remove the repeated point, or give `at_s` to wait there.";
        PATH_TIMES = "CGR-SCENARIO-041", "scenario::path_times",
            "The times of a path do not increase, do not match its points, or are given twice. Give one time for each point, each later than the one before, or only `duration_s`.";
        PATH_SPEED = "CGR-SCENARIO-042", "scenario::path_speed",
            "The speed, acceleration, profile or blend radius of a path does not fit the path.";
        PATH_REACH = "CGR-SCENARIO-043", "scenario::path_reach",
            "A path leaves the reach of the arm. Move the path nearer to the arm, or start in another configuration; the help names joints that are at a limit.";
        PATH_SINGULAR = "CGR-SCENARIO-044", "scenario::path_singular",
            "A path passes a singularity, where a joint would have to jump. Move the path, or start in another configuration of the arm.";
        PATH_LIMIT = "CGR-SCENARIO-045", "scenario::path_limit",
            "A joint would leave its range between two points of a path. A smooth path may overshoot its points. Add a point where it does, or change the times.";
        ARC = "CGR-SCENARIO-046", "scenario::arc",
            "The points of an arc lie on a straight line, or `via` has a rotation, which only `to` may have.";
        ARC_SPEED = "CGR-SCENARIO-047", "scenario::arc_speed",
            "An arc is followed more slowly than requested, because of the limit of the centripetal acceleration.";
        ORIENTATION = "CGR-SCENARIO-048", "scenario::orientation",
            "The orientations along a path are incomplete: either every point has one, or none. Give each point `rpy_deg` or `quaternion_wxyz`, or leave it out at all points, and the orientation of the start is kept.";
        AFTER_SERVO = "CGR-SCENARIO-049", "scenario::after_servo",
            "A motion after a servo is planned when the servo ends; this kind of motion cannot be planned then.";
        PLAYBACK = "CGR-SCENARIO-050", "scenario::playback",
            "The file of a playback is not a table of joint positions over time.";
        PLAYBACK_START = "CGR-SCENARIO-051", "scenario::playback_start",
            "The first row of the table differs from the position of the robot when the playback begins. The joints would have to jump. Start the robot at the first row, or move the joints there before the playback.";
        PLAYBACK_JUMP = "CGR-SCENARIO-052", "scenario::playback_jump",
            "A joint jumps between two rows of the table. Give the row more time, or write this.\n    [limits]\n    over_limit = \"slow\"";
        PLAYBACK_RANGE = "CGR-SCENARIO-053", "scenario::playback_range",
            "A row of the table is outside the range of a joint. Correct the row; the message has its line and the range.";
    }
}
