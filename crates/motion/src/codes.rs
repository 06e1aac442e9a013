//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    scenario {
        UNKNOWN_JOINT = "CGR-SCENARIO-010", "scenario::unknown_joint",
            "The robot has no moving joint of this name. The help has the most similar name and the known ones.\n    wrong: move_joints_deg = { elbow = 80.0 }\n    right: move_joints_deg = { elbow_joint = 80.0 }";
        MIMIC_JOINT = "CGR-SCENARIO-011", "scenario::mimic_joint",
            "The joint mimics another joint and has no actuator of its own. Name the mimicked joint.\n    wrong: move_joints_m = { panda_finger_joint2 = 0.03 }\n    right: move_joints_m = { panda_finger_joint1 = 0.03 }";
        JOINT_UNIT = "CGR-SCENARIO-013", "scenario::joint_unit",
            "A value is in metres for a revolute joint, or in degrees or radians for a prismatic one. The help names the keys that fit the joint.\n    wrong: move_joints_m = { elbow_joint = 0.08 }\n    right: move_joints_deg = { elbow_joint = 80.0 }";
        JOINT_TWICE = "CGR-SCENARIO-014", "scenario::joint_twice",
            "A joint is given twice. Only one of the two values could apply. Keep one.\n    wrong: move_joints_deg = { elbow_joint = 80 } and move_joints_rad = { elbow_joint = 1.4 }\n    right: move_joints_deg = { elbow_joint = 80.0 }";
        LIMIT_TWICE = "CGR-SCENARIO-016", "scenario::limit_twice",
            "A limit of a joint is given twice. Only one of the two could apply. Keep one.\n    wrong: velocity_deg_s = { elbow_joint = 90 } and velocity_rad_s = { elbow_joint = 1 }\n    right: velocity_deg_s = { elbow_joint = 90.0 }";
        NOTHING_MOVES = "CGR-SCENARIO-030", "scenario::nothing_moves",
            "A motion in the least time ends at its start position, so nothing moves. Give `duration_s`, or remove the motion.\n    wrong: move_joints_deg = {}\n    right: move_joints_deg = {} and duration_s = 1.0";
        TARGET_LIMIT = "CGR-SCENARIO-031", "scenario::target_limit",
            "The target of a motion is outside the limits of a joint. Change the target, or the limits in the URDF if they are wrong.\n    wrong: move_joints_deg = { elbow_joint = 200.0 }\n    right: move_joints_deg = { elbow_joint = 80.0 }";
        OUT_OF_REACH = "CGR-SCENARIO-033", "scenario::out_of_reach",
            "No joint positions bring the tool to the target. The target is that of the tool centre point in the world. The message has the smallest error that was reached. Give coordinates within the reach: `congruent workspace ROBOT`.\n    wrong: move_tcp = { xyz_m = [5.0, -0.1, 0.3] }\n    right: move_tcp = { xyz_m = [0.5, -0.1, 0.3] }";
        MOVE_TCP = "CGR-SCENARIO-034", "scenario::move_tcp",
            "The chain cannot move its tool to a target, as a chain with fewer than six joints cannot to most poses, or one whose joints follow others. Give the target as joint positions (kind = \"joint\"), or its position alone.\n    wrong: move_tcp = { ... } in a chain from base to tip without a moving joint\n    right: tip = \"tip\" in robot.toml";
        OVER_LIMIT = "CGR-SCENARIO-035", "scenario::over_limit",
            "A motion exceeds the velocity or acceleration limit of a joint. The help names the shortest duration within the limits; or the motion is slowed down by this.\n    [limits]\n    over_limit = \"slow\"";
        NO_VELOCITY_LIMIT = "CGR-SCENARIO-036", "scenario::no_velocity_limit",
            "A motion in the least time needs velocity limits, and a joint has none. Give `duration_s`, or a velocity under [limits].\n    wrong: a motion without duration_s of a joint without velocity=\"3.14\"\n    right: duration_s = 1.0";
        SLOWED = "CGR-SCENARIO-037", "scenario::slowed",
            "A motion takes longer than requested, because a joint would otherwise exceed its limit. Give the longer duration to be rid of the warning.\n    wrong: duration_s = 0.05\n    right: duration_s = 1.0";
        PATH = "CGR-SCENARIO-039", "scenario::path",
            "The tool cannot follow a path. The message names the point and what stops the arm there: out of reach, at a joint limit or at a singularity. Move that point, or begin the path in another configuration.\n    wrong: line_tcp = { xyz_m = [0.0, 0.0, 0.1] }\n    right: line_tcp = { xyz_m = [0.4, -0.2, 0.3] }";
        PATH_POINTS = "CGR-SCENARIO-040", "scenario::path_points",
            "A path has no points, or two successive points are equal. Remove the repeated point, or give `at_s` to wait there.\n    wrong: path_joints_deg = []\n    right: path_joints_deg = [{ elbow_joint = 85.0 }, { elbow_joint = 80.0 }]";
        PATH_TIMES = "CGR-SCENARIO-041", "scenario::path_times",
            "The times of a path do not increase, do not match its points, or are given twice. Give one time for each point, each later than the one before, or only `duration_s`.\n    wrong: at_s = [0.5, 0.2]\n    right: at_s = [0.5, 1.0]";
        PATH_SPEED = "CGR-SCENARIO-042", "scenario::path_speed",
            "The speed, acceleration, profile or blend radius of a path does not fit the path. Give a speed or a duration, and a radius that is shorter than the line.\n    wrong: speed_m_s = 0.2 and duration_s = 1.0\n    right: speed_m_s = 0.2";
        PATH_REACH = "CGR-SCENARIO-043", "scenario::path_reach",
            "A path leaves the reach of the arm. Move the path nearer to the arm, or start in another configuration; the help names joints that are at a limit.\n    wrong: line_tcp = { xyz_m = [1.4, -0.2, 0.3] }\n    right: line_tcp = { xyz_m = [0.4, -0.2, 0.3] }";
        PATH_SINGULAR = "CGR-SCENARIO-044", "scenario::path_singular",
            "A path passes a singularity, where a joint would have to jump. Move the path, or start in another configuration of the arm.\n    wrong: wrist_2_joint = 0.0\n    right: wrist_2_joint = -90.0";
        PATH_LIMIT = "CGR-SCENARIO-045", "scenario::path_limit",
            "A joint would leave its range between two points of a path. A smooth path may overshoot its points. Add a point where it does, or change the times.\n    wrong: { elbow_joint = 179.0 } between two points of 120 degrees\n    right: { elbow_joint = 160.0 }";
        ARC = "CGR-SCENARIO-046", "scenario::arc",
            "The points of an arc lie on a straight line, or `via` has a rotation, which only `to` may have. Give `via` a position beside the line, without a rotation.\n    wrong: via = { xyz_m = [0.45, -0.2, 0.5], rpy_deg = [180, 0, 0] }\n    right: via = { xyz_m = [0.45, -0.2, 0.5] }";
        ARC_SPEED = "CGR-SCENARIO-047", "scenario::arc_speed",
            "An arc is followed more slowly than requested, because of the limit of the centripetal acceleration. Give a lower speed or a larger arc.\n    wrong: speed_m_s = 2.0\n    right: speed_m_s = 0.05";
        ORIENTATION = "CGR-SCENARIO-048", "scenario::orientation",
            "A motion has `orientation = \"free\"`, and its target has a rotation, or it blends into a motion that controls the orientation. Remove one of the two.\n    wrong: orientation = \"free\" and rpy_deg = [180, 0, -90]\n    right: orientation = \"free\"";
        AFTER_SERVO = "CGR-SCENARIO-049", "scenario::after_servo",
            "A motion after a servo is planned when the servo ends; this kind of motion cannot be planned then. Put it before the servo, give `duration_s`, or remove `blend_m`.\n    wrong: play_csv = \"q.csv\" after servo_tcp = { ... }\n    right: move_joints_deg = { elbow_joint = 80.0 }";
        PLAYBACK = "CGR-SCENARIO-050", "scenario::playback",
            "The file of a playback is not a table of joint positions over time. Write the header with `time_s` first, then a column for each joint with its unit.\n    wrong: elbow_joint_deg\n    right: time_s,elbow_joint_deg";
        PLAYBACK_START = "CGR-SCENARIO-051", "scenario::playback_start",
            "The first row of the table differs from the position of the robot when the playback begins. The joints would have to jump. Start the robot at the first row, or move the joints there before the playback.\n    wrong: 0,45\n    right: 0,90";
        PLAYBACK_JUMP = "CGR-SCENARIO-052", "scenario::playback_jump",
            "A joint jumps between two rows of the table. Give the row more time, or write this.\n    [limits]\n    over_limit = \"slow\"";
        PLAYBACK_RANGE = "CGR-SCENARIO-053", "scenario::playback_range",
            "A row of the table is outside the range of a joint. Correct the row; the message has its line and the range.\n    wrong: 1,200\n    right: 1,80";
    }
}
