//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    scenario {
        UNCERTAINTY = "CGR-SCENARIO-097", "scenario::uncertainty",
            "[uncertainty] has nothing that varies, or a number of cases below 1 or above 100,000; or it cannot be combined with another part: `passing` of a check needs [uncertainty], and a sampling other than a grid; [source] and [expect] verdict = \"fail\" exclude it; `case` is the number of a case, from 0.\n    wrong: passing = 0.99 without [uncertainty]\n    right: passing = 0.99, [uncertainty] with cases = 300, and [[uncertainty.vary]]";
        FEW_CASES = "CGR-SCENARIO-098", "scenario::few_cases",
            "The number of cases cannot show what a check asks for, even if no case fails: the answer can only be that there are not enough. Without a failure, 29 cases show 90 % with confidence 95 %, 59 show 95 %, and 299 show 99 %.\n    wrong: cases = 100 and passing = 0.99\n    right: cases = 300 and passing = 0.99";
        SEED = "CGR-SCENARIO-003", "scenario::seed",
            "The seed is greater than the largest integer of TOML. Give a smaller seed.\n    wrong: --set seed=9223372036854775808\n    right: --set seed=7";
        ROBOT = "CGR-SCENARIO-004", "scenario::robot",
            "The robot of the scenario cannot be used; the findings about the robot are listed with this one. Correct these first.\n    wrong: robot = \"w.urdf\" with <mass value=\"-8\"/>\n    right: robot = \"robots/ur5e\"";
        TWO_UNITS = "CGR-SCENARIO-007", "scenario::two_units",
            "Two keys of `[sensors]` give one value of a joint. The two may contradict each other. Remove one of them.\n    wrong: resolution_deg = 0.01 and resolution_rad = 0.0002\n    right: resolution_deg = 0.01";
        UNKNOWN_LINK = "CGR-SCENARIO-012", "scenario::unknown_link",
            "No link of the robot has this name or matches this pattern. The help has the known names.\n    wrong: links = [\"forearm\"]\n    right: links = [\"forearm_link\"]";
        JOINT_LEFT_OUT = "CGR-SCENARIO-015", "scenario::joint_left_out",
            "A list must name every joint, but a joint is missing. Add the joint, or `others = ...` for all joints that are not named.\n    wrong: stiffness = { elbow_joint = 2000.0 }\n    right: stiffness = { elbow_joint = 2000.0, others = 1000.0 }";
        LOGGED_JOINTS = "CGR-SCENARIO-092", "scenario::logged_joints",
            "The joints of the log are not those of the robot, or more than one topic has them. Name the topics under [[source.joints]], with `prefix`, `suffix` or `names` where names differ; the help has what the log has.\n    wrong: [source] alone, for a log with /joint_states and /joint_commands\n    right: [[source.joints]] and topic = \"/joint_states\"";
        LOGGED_UNIT = "CGR-SCENARIO-093", "scenario::logged_unit",
            "The recorded positions lie beyond the limits of the joints unless they are degrees. Messages of ROS are in radians, and some drivers write degrees. Say which unit it is.\n    wrong: [[source.joints]] without `position`\n    right: position = \"deg\"";
        LOGGED_TOPIC = "CGR-SCENARIO-094", "scenario::logged_topic",
            "The log has no topic of this name and content. `congruent describe LOG` lists its topics.\n    wrong: topic = \"/joint_state\"\n    right: topic = \"/joint_states\"";
        LOGGED_FRAMES = "CGR-SCENARIO-095", "scenario::logged_frames",
            "It is not known between which frames of the robot a pose of the log is. Give `frame` and `child` as the log has them, and `from_link` and `link`, the links of the robot that carry them.\n    wrong: [[source.pose]] for a tracker whose frame is \"world\"\n    right: from_link = \"base_link\", link_from_frame = { xyz_m = [1.2, 0.1, 0.0] }";
        LOGGED_NOTHING = "CGR-SCENARIO-096", "scenario::logged_nothing",
            "No instant of the log has a position of every joint that is taken from it. Topics that never overlap in time, and joints that are always NaN, leave nothing to judge. `congruent describe LOG --robot ROBOT` shows which.\n    wrong: joints of two topics that were recorded one after the other\n    right: [[source.joints]] for the topic that has them all";
        SAMPLING = "CGR-SCENARIO-022", "scenario::sampling",
            "A period or a delay is not a whole number of steps. Change the value or `step_s`.\n    wrong: rate_hz = 700.0\n    right: rate_hz = 500.0";
        OUTPUT = "CGR-SCENARIO-023", "scenario::output",
            "The period of a trajectory file does not fit the run, or a period is given without a file. A row can be written only at a step. Give a period that is a multiple of `step_s`, or add trajectory = \"csv\", \"parquet\" or \"mcap\".\n    wrong: trajectory_period_s = 0.0015\n    right: trajectory_period_s = 0.002";
        START_LIMIT = "CGR-SCENARIO-024", "scenario::start_limit",
            "The start position of a joint is outside its limits. Change [start], or the limits in the URDF if they are wrong.\n    wrong: joints_deg = { elbow_joint = 200.0 }\n    right: joints_deg = { elbow_joint = 90.0 }";
        START_DEFAULT = "CGR-SCENARIO-025", "scenario::start_default",
            "The start position of a joint is not given, and the default 0 is outside its limits, so the joint starts at its limit. Give its position under [start].\n    wrong: no position of panda_joint4 under [start]\n    right: joints_deg = { panda_joint4 = -90.0 }";
        CONTROLLER_KEY = "CGR-SCENARIO-027", "scenario::controller_key",
            "The controller has no such parameter. It would have no effect. The help lists the controllers that have it.\n    wrong: integral = 10.0 with kind = \"gravity_compensation\"\n    right: kind = \"pid\"";
        SENSORS = "CGR-SCENARIO-028", "scenario::sensors",
            "Two parameters of the sensors exclude each other. A velocity that is differentiated gets its noise from the positions. Remove `velocity` or the velocity noise.\n    wrong: velocity = \"differentiated\" and velocity_noise_rad_s = 0.01\n    right: velocity = \"differentiated\"";
        TORQUE_FILE = "CGR-SCENARIO-054", "scenario::torque_file",
            "The file of torques is not a table of joint torques over time. Give a table with the column `time_s` and columns named by joints; the message has the line.\n    wrong: the header t,elbow\n    right: the header time_s,elbow_joint";
        OBSTACLE_NAME = "CGR-SCENARIO-055", "scenario::obstacle_name",
            "An obstacle has no name. Reports and checks refer to an obstacle by its name. Give it one.\n    wrong: name = \"\"\n    right: name = \"table\"";
        OBSTACLE_TWICE = "CGR-SCENARIO-056", "scenario::obstacle_twice",
            "Two obstacles share a name. Reports and checks could not distinguish them. Rename one.\n    wrong: name = \"table\" in two [[obstacle]]\n    right: name = \"wall\" in the second";
        OBSTACLE_IS_LINK = "CGR-SCENARIO-057", "scenario::obstacle_is_link",
            "An obstacle has the name of a link of the robot. A pair of names in a check of distances would be ambiguous. Rename the obstacle.\n    wrong: name = \"forearm_link\"\n    right: name = \"table\"";
        OBSTACLE_SHAPE = "CGR-SCENARIO-058", "scenario::obstacle_shape",
            "An obstacle must have exactly one shape. Give one of `box_m`, `sphere_radius_m`, `cylinder`, `mesh`.\n    wrong: box_m = [1.1, 1.2, 0.04] and sphere_radius_m = 0.1\n    right: box_m = [1.1, 1.2, 0.04]";
        OBSTACLE_SIZE = "CGR-SCENARIO-059", "scenario::obstacle_size",
            "A size or a coordinate of an obstacle exceeds 100,000 m. Give lengths in metres, or coordinates in millimetres under `xyz_mm`.\n    wrong: xyz_m = [350000.0, 40.0, -20.0]\n    right: xyz_mm = [350.0, 40.0, -20.0]";
        OBSTACLE_PATH = "CGR-SCENARIO-060", "scenario::obstacle_path",
            "The path of an obstacle cannot be followed. Give times that increase, and a position at each.\n    wrong: path = [{ at_s = 5.0, ... }, { at_s = 0.0, ... }]\n    right: path = [{ at_s = 0.0, ... }, { at_s = 5.0, ... }]";
        OBSTACLE_JUMPS = "CGR-SCENARIO-090", "scenario::obstacle_jumps",
            "An obstacle moves farther than its size in a step, so it may pass through a link between two samples without a contact or a small distance. Give a shorter `step_s`, or more time between the poses of its path.\n    wrong: { at_s = 0.001, xyz_m = [1.2, 1.1, 0.25] }\n    right: { at_s = 5.0, xyz_m = [1.2, 1.1, 0.25] }";
        OBSTACLE_OVERLAP = "CGR-SCENARIO-061", "scenario::obstacle_overlap",
            "An obstacle overlaps the robot at the start; the contact forces would throw them apart. Move the obstacle or change [start]. Meshes are replaced by their convex hulls, which are larger. The controller \"kinematic\" moves the robot without forces.\n    wrong: xyz_m = [0.35, 0.04, 0.1]\n    right: xyz_m = [0.35, 0.04, -0.02]";
        ZONE_NAME = "CGR-SCENARIO-062", "scenario::zone_name",
            "A zone has no name. Reports refer to a zone by its name. Give it one.\n    wrong: name = \"\"\n    right: name = \"operator\"";
        ZONE_TWICE = "CGR-SCENARIO-063", "scenario::zone_twice",
            "Two zones share a name. Reports could not distinguish them. Rename one.\n    wrong: name = \"operator\" in two [[zone]]\n    right: name = \"door\" in the second";
        ZONE_IS_LINK = "CGR-SCENARIO-064", "scenario::zone_is_link",
            "A zone has the name of a link of the robot. Reports could not distinguish them. Rename the zone.\n    wrong: name = \"tool0\"\n    right: name = \"operator\"";
        ZONE_SHAPE = "CGR-SCENARIO-065", "scenario::zone_shape",
            "A zone must have exactly one shape. Give one of `box_m`, `sphere_radius_m`, `cylinder`.\n    wrong: box_m = [2.0, 0.6, 2.0] and sphere_radius_m = 0.3\n    right: box_m = [2.0, 0.6, 2.0]";
        ZONE_SIZE = "CGR-SCENARIO-066", "scenario::zone_size",
            "A size or a coordinate of a zone exceeds 100,000 m. Give lengths in metres, or coordinates in millimetres under `xyz_mm`.\n    wrong: xyz_m = [0.0, 190000.0, 1000.0]\n    right: xyz_mm = [0.0, 1900.0, 1000.0]";
        ZONE_LINKS = "CGR-SCENARIO-067", "scenario::zone_links",
            "A zone applies to no link, or to links without a shape. Then no link is forbidden to enter it. Give links = [\"*\"] for all moving links, or names of links that have a shape.\n    wrong: links = []\n    right: links = [\"*\"]";
        ZONE_UNCHECKED = "CGR-SCENARIO-068", "scenario::zone_unchecked",
            "No check covers the zones, so they have no effect. Add a check of zones; the help has its `kind`.\n    wrong: a [[zone]] without a [[check]]\n    right: [[check]] and kind = \"zone\"";
        NO_ZONE = "CGR-SCENARIO-069", "scenario::no_zone",
            "A check of zones is given, but the scenario has no zone. Add a [[zone]] with a name, links, a shape and a position.\n    wrong: [[check]] and kind = \"zone\" without a [[zone]]\n    right: [[zone]] and name = \"operator\", too";
        GRASP = "CGR-SCENARIO-070", "scenario::grasp",
            "A grasp does not name an obstacle or a link, or its times or its mass do not fit. Name an obstacle, a link that is beside it at `from_s`, and a mass above 0.\n    wrong: body = \"box\"\n    right: body = \"part\"";
        GRASP_INERTIA = "CGR-SCENARIO-071", "scenario::grasp_inertia",
            "The inertia of a grasped body is missing, or no rigid body can have it. Give `inertia_kg_m2`: each of the three moments must be at most the sum of the other two.\n    wrong: inertia_kg_m2 = [0.01, 0.001, 0.001]\n    right: inertia_kg_m2 = [0.0016, 0.0016, 0.0016]";
        PAYLOAD = "CGR-SCENARIO-072", "scenario::payload",
            "The mass or inertia of a payload is impossible for a rigid body, or the payload has no name. Give it a name, a mass above 0 and an inertia that a body can have.\n    wrong: name = \"\"\n    right: name = \"part\"";
        PAYLOAD_TWICE = "CGR-SCENARIO-073", "scenario::payload_twice",
            "Two payloads share a name. Reports could not distinguish them. Rename one.\n    wrong: name = \"part\" in two [[payload]]\n    right: name = \"gripper\" in the second";
        FAULT_VALUE = "CGR-SCENARIO-075", "scenario::fault_value",
            "A fault has no value, more than one value, or a value outside its range. Give one value within its range.\n    wrong: kind = \"encoder_offset\" without a value\n    right: value_deg = 1.0";
        FAULT_TIME = "CGR-SCENARIO-076", "scenario::fault_time",
            "A fault begins outside of the run. A fault must begin before the end of the run, and end after it began and within the run. Give `at_s` before `until_s`, and both within the run.\n    wrong: at_s = 5.0\n    right: at_s = 0.5";
        FAULT_NO_EFFECT = "CGR-SCENARIO-077", "scenario::fault_no_effect",
            "A fault has no effect in this run. The message says why, the help what to change. A run with it would look as if no check could detect the fault.\n    wrong: kind = \"lost_torque\" with the controller \"kinematic\"\n    right: the controller \"pd\"";
        FAULTS_EXCLUDE = "CGR-SCENARIO-078", "scenario::faults_exclude",
            "Two faults of a joint cannot act at the same time. Let one end (`until_s`) before the other begins (`at_s`), or remove one of them.\n    wrong: two faults \"stuck_joint\" of elbow_joint, both with at_s = 0.5\n    right: until_s = 0.3 for the one";
        LONG_RUN = "CGR-SCENARIO-087", "scenario::long_run",
            "The physics of this many joints takes minutes or more: the time of a step grows with the cube of the number of joints. Give a longer `step_s` or a shorter `duration_s`, or use a robot with fewer moving joints.\n    wrong: step_s = 0.0001\n    right: step_s = 0.001";
        UNWATCHED = "CGR-SCENARIO-088", "scenario::unwatched",
            "No check measures the distance to an obstacle or its contacts, so a run in which the arm passes through the obstacle would pass. Add a [[check]] with kind = \"clearance\" or \"contact\".\n    wrong: an [[obstacle]] without such a check\n    right: [[check]], kind = \"clearance\" and minimum_mm = 5.0";
    }
}
