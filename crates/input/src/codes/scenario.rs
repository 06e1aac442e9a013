//! Findings about a scenario: the run, its robot, controller and motions.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "SCENARIO",
    codes: &[
        (
            1,
            "scenario::version",
            "This program cannot read the format version of the scenario. Set it to 1, the only version.\n    schema_version = 1",
        ),
        (
            2,
            "scenario::name",
            "The name of the scenario is empty. The results are written to a folder of this name. Give it one.\n    name = \"pick\"",
        ),
        (3, "scenario::seed", "The seed is greater than the largest integer of TOML."),
        (
            4,
            "scenario::robot",
            "The robot of the scenario cannot be used; the findings about the robot are listed with this one.",
        ),
        (
            5,
            "scenario::type",
            "A value has the wrong type. The message names the key, the expected type and the type found. A number has no quotes, a text has them.",
        ),
        (6, "scenario::number", "A value is not finite, or is outside its permitted range."),
        (
            7,
            "scenario::two_units",
            "Two keys of `[sensors]` give one value of a joint. The two may contradict each other. Remove one of them.",
        ),
        (
            8,
            "scenario::no_kind",
            "The key `kind` of a section is missing. It decides which other keys the section has. The help has the known kinds.",
        ),
        (9, "scenario::unknown_kind", "The `kind` of a section is unknown. The help has the known kinds."),
        (
            10,
            "scenario::unknown_joint",
            "The robot has no moving joint of this name. The help has the most similar name and the known ones.",
        ),
        (
            11,
            "scenario::mimic_joint",
            "The joint mimics another joint and has no actuator of its own. Name the mimicked joint.",
        ),
        (
            12,
            "scenario::unknown_link",
            "No link of the robot has this name or matches this pattern. The help has the known names.",
        ),
        (
            13,
            "scenario::joint_unit",
            "A value is in metres for a revolute joint, or in degrees or radians for a prismatic one. The help names the keys that fit the joint.",
        ),
        (
            14,
            "scenario::joint_twice",
            "A joint is given twice. Only one of the two values could apply. Keep one.",
        ),
        (
            15,
            "scenario::joint_left_out",
            "A list must name every joint, but a joint is missing. Add the joint, or `others = ...` for all joints that are not named.",
        ),
        (
            16,
            "scenario::limit_twice",
            "A limit of a joint is given twice. Only one of the two could apply. Keep one.",
        ),
        (
            17,
            "scenario::step",
            "The time step must be greater than 0, and must not exceed the largest step of the physics or the duration.",
        ),
        (
            18,
            "scenario::steps",
            "The run has more steps than the limit of one run. Give a longer `step_s` or a shorter `duration_s`.",
        ),
        (
            19,
            "scenario::duration",
            "The duration of the run is missing, or is not greater than 0. Give `duration_s` under [simulation], or a [[motion]].",
        ),
        (
            20,
            "scenario::duration_rounded",
            "The duration is not a whole number of steps. The run takes the nearest whole number of steps.",
        ),
        (
            21,
            "scenario::cut_short",
            "The run ends before its motions end. The checks do not see the rest of the motions. Remove `duration_s` to run to the end of the motions.",
        ),
        (22, "scenario::sampling", "A period or a delay is not a whole number of steps."),
        (
            23,
            "scenario::output",
            "The period of a trajectory file does not fit the run, or a period is given without a file. A row can be written only at a step. Give a period that is a multiple of `step_s`, or add trajectory = \"csv\" or \"parquet\".",
        ),
        (
            24,
            "scenario::start_limit",
            "The start position of a joint is outside its limits. Change [start], or the limits in the URDF if they are wrong.",
        ),
        (
            25,
            "scenario::start_default",
            "The start position of a joint is not given, and the default 0 is outside its limits, so the joint starts at its limit.",
        ),
        (
            26,
            "scenario::no_controller",
            "The scenario has no controller. Without one nothing drives the joints. Add a [controller] section; the help lists the kinds.",
        ),
        (
            27,
            "scenario::controller_key",
            "The controller has no such parameter. It would have no effect. The help lists the controllers that have it.",
        ),
        (
            28,
            "scenario::sensors",
            "Two parameters of the sensors exclude each other. A velocity that is differentiated gets its noise from the positions. Remove `velocity` or the velocity noise.",
        ),
        (
            29,
            "scenario::unknown_motion",
            "A motion has no target, or its target is unknown. The help lists the keys, one of which each motion needs.",
        ),
        (
            30,
            "scenario::nothing_moves",
            "A motion in the least time ends at its start position, so nothing moves. Give `duration_s`, or remove the motion.",
        ),
        (
            31,
            "scenario::target_limit",
            "The target of a motion is outside the limits of a joint. Change the target, or the limits in the URDF if they are wrong.",
        ),
        (
            32,
            "scenario::target_position",
            "The target pose of the tool lacks a position. Give the position of the tool centre point in the world; for a pure rotation, its present position.",
        ),
        (
            33,
            "scenario::out_of_reach",
            "No joint positions bring the tool to the target. The target is that of the tool centre point in the world. The message has the smallest error that was reached.",
        ),
        (
            34,
            "scenario::move_tcp",
            "The tool of the chain cannot be moved to a target; the message has the reason.",
        ),
        (
            35,
            "scenario::over_limit",
            "A motion exceeds the velocity or acceleration limit of a joint. The help names the shortest duration within the limits; or the motion is slowed down by this.\n    [limits]\n    over_limit = \"slow\"",
        ),
        (
            36,
            "scenario::no_velocity_limit",
            "A motion in the least time needs velocity limits, and a joint has none. Give `duration_s`, or a velocity under [limits].",
        ),
        (
            37,
            "scenario::slowed",
            "A motion takes longer than requested, because a joint would otherwise exceed its limit. Give the longer duration to be rid of the warning.",
        ),
        (
            38,
            "scenario::share",
            "The share of a limit that a check allows is so large that the check would pass a violation of the limit itself. The help names the largest share.",
        ),
        (39, "scenario::path", "A path of the tool cannot be followed; the message has the reason."),
        (
            40,
            "scenario::path_points",
            "A path has no points, or two successive points are equal. Remove the repeated point, or give `at_s` to wait there.",
        ),
        (
            41,
            "scenario::path_times",
            "The times of a path do not increase, do not match its points, or are given twice. Give one time for each point, each later than the one before, or only `duration_s`.",
        ),
        (
            42,
            "scenario::path_speed",
            "The speed, acceleration, profile or blend radius of a path does not fit the path.",
        ),
        (
            43,
            "scenario::path_reach",
            "A path leaves the reach of the arm. Move the path nearer to the arm, or start in another configuration; the help names joints that are at a limit.",
        ),
        (
            44,
            "scenario::path_singular",
            "A path passes a singularity, where a joint would have to jump. Move the path, or start in another configuration of the arm.",
        ),
        (
            45,
            "scenario::path_limit",
            "A joint would leave its range between two points of a path. A smooth path may overshoot its points. Add a point where it does, or change the times.",
        ),
        (
            46,
            "scenario::arc",
            "The points of an arc lie on a straight line, or `via` has a rotation, which only `to` may have.",
        ),
        (
            47,
            "scenario::arc_speed",
            "An arc is followed more slowly than requested, because of the limit of the centripetal acceleration.",
        ),
        (
            48,
            "scenario::orientation",
            "The orientation along a path is incomplete or has an unsupported form; the message has the reason.",
        ),
        (
            49,
            "scenario::after_servo",
            "A motion after a servo is planned when the servo ends; this kind of motion cannot be planned then.",
        ),
        (50, "scenario::playback", "The file of a playback is not a table of joint positions over time."),
        (
            51,
            "scenario::playback_start",
            "The first row of the table differs from the position of the robot when the playback begins. The joints would have to jump. Start the robot at the first row, or move the joints there before the playback.",
        ),
        (
            52,
            "scenario::playback_jump",
            "A joint jumps between two rows of the table. Give the row more time, or write this.\n    [limits]\n    over_limit = \"slow\"",
        ),
        (
            53,
            "scenario::playback_range",
            "A row of the table is outside the range of a joint. Correct the row; the message has its line and the range.",
        ),
        (
            54,
            "scenario::torque_file",
            "The file of torques is not a table of joint torques over time. Give a table with the column `time_s` and columns named by joints; the message has the line.",
        ),
    ],
}];
