//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    load {
        SCENARIO = "CGR-FILE-020", "load::scenario" unreadable,
            "The file is a scenario, and the command takes a robot.\n    congruent run scenarios/first.toml";
        NO_ROBOT_FILE = "CGR-FILE-015", "load::no_robot_file" unreadable,
            "The folder has no robot.toml, so it is not a robot. Give a folder with a robot.toml, a robot file or a .urdf.\n    wrong: congruent check meshes\n    right: congruent check robots/ur5e";
    }
    mjcf {
        TREE = "CGR-MJCF-051", "mjcf::tree",
            "The bodies and joints of an MJCF make no robot, as joints that follow each other in a circle. The message has the reason. Remove what makes the circle.\n    wrong: a <joint> of <equality> from A to B, and one from B to A\n    right: the one from A to B";
        FREE = "CGR-MJCF-052", "mjcf::free",
            "A body moves freely. A robot here is fixed to the world, so the body is fixed at the pose that the file gives it. Remove the joint if the robot is mounted.\n    wrong: <freejoint/>\n    right: no joint in a body that is fixed to the world";
        BALL = "CGR-MJCF-053", "mjcf::ball",
            "A ball joint has no position that is one number. A body on which nothing moves is fixed at its written pose, and forces are refused; with moving joints behind it the robot is refused. Replace it by three hinges in the same body.\n    wrong: <joint name=\"wrist\" type=\"ball\"/>\n    right: <joint name=\"wrist_x\" axis=\"1 0 0\"/> and two more hinges";
        SHAPE = "CGR-MJCF-054", "mjcf::shape",
            "A geom has a shape that is not read: a height field, or a shape that is fitted to a mesh. Distances are refused if it collides. Replace it by a box, cylinder, sphere, capsule or mesh.\n    wrong: <geom type=\"capsule\" mesh=\"plate\"/>\n    right: <geom type=\"mesh\" mesh=\"plate\"/>";
        MESH = "CGR-MJCF-055", "mjcf::mesh",
            "A mesh has neither a file nor vertices that enclose a volume: meshes that MuJoCo builds itself are not read. Name a file.\n    wrong: <mesh name=\"plate\" builtin=\"hemisphere\" params=\"3\"/>\n    right: <mesh name=\"plate\" file=\"plate.stl\"/>";
        COUPLING = "CGR-MJCF-056", "mjcf::coupling",
            "An equality that is no linear coupling of two joints: a polynomial of degree 2 or more, a locked joint, tendons. The joint is read as one that moves by itself, and forces are refused. Write a linear coupling if the real one is nearly linear.\n    wrong: polycoef=\"0 -1 0.2 0 0\"\n    right: polycoef=\"0 -1 0 0 0\"";
        GRAVITY = "CGR-MJCF-057", "mjcf::gravity",
            "MuJoCo would simulate another weight: the file has another gravity, or a body has a gravcomp. Forces are computed with 9.81 m/s^2 downwards and the whole weight. Write the gravity of the earth to compare with MuJoCo.\n    wrong: <option gravity=\"0 0 0\"/>\n    right: <option gravity=\"0 0 -9.81\"/>";
        SPRING = "CGR-MJCF-059", "mjcf::spring",
            "A joint has a spring (`stiffness`), whose torque is left out of forces. Remove the spring, or expect other torques in MuJoCo.\n    wrong: <joint name=\"elbow_joint\" stiffness=\"50\" .../>\n    right: <joint name=\"elbow_joint\" .../>";
        DAMPING = "CGR-MJCF-060", "mjcf::damping",
            "A joint has a damping that grows with a power of the speed. Only the part that is proportional to the speed is read. Write the proportional part alone to compare with MuJoCo.\n    wrong: <joint damping=\"1 0.5\" .../>\n    right: <joint damping=\"1\" .../>";
        MEDIUM = "CGR-MJCF-061", "mjcf::medium",
            "MuJoCo would add the forces of a medium, such as water or air, to each body that moves: they are left out. Write no density and no viscosity of a medium to compare with MuJoCo.\n    wrong: <option density=\"1000\" viscosity=\"0.1\"/>\n    right: <option/>";
    }
    srdf {
        UNKNOWN_LINK = "CGR-SRDF-001", "srdf::unknown_link",
            "The SRDF names a link that the robot does not have; a disabled collision pair with this link has no effect. Often the link was renamed. Write the name that the URDF has.\n    wrong: link1=\"left_finger\"\n    right: link1=\"panda_leftfinger\"";
    }
    urdf {
        ROOT = "CGR-URDF-001", "urdf::root",
            "The root element is not <robot>, so the file is not a URDF. The message says if it is an SDF, MuJoCo or COLLADA file. Give the URDF, or convert the file to one.\n    wrong: <sdf version=\"1.9\">\n    right: <robot name=\"ur5e\">";
        XACRO = "CGR-URDF-002", "urdf::xacro",
            "The file is a xacro file that has not been expanded. It is never expanded here, because xacro executes code.\n    xacro robot.urdf.xacro > robot.urdf";
        STRUCTURE = "CGR-URDF-003", "urdf::structure",
            "The file is XML, but no valid URDF: a link or joint lacks what it needs, or has a value that is impossible. The message names the element and what is wrong with it. Correct that element; `check_urdf` of ROS refuses the same file.\n    check_urdf arm.urdf";
        TOO_MANY_LINKS = "CGR-URDF-004", "urdf::too_many_links",
            "The robot has more links than the limit, up to which it can be processed in a reasonable time. Split the file into the arm and what is around it; `congruent describe` counts the links.\n    congruent describe arm.urdf";
        TREE = "CGR-URDF-005", "urdf::tree",
            "Links and joints do not form one tree: a link is missing, has two parents or is its own ancestor, there are several roots, or two links or two joints share a name. Name each parent and child as its link; only the root has no parent.\n    wrong: <child link=\"forearm\"/>\n    right: <child link=\"forearm_link\"/>";
        MISSING_ELEMENT = "CGR-URDF-006", "urdf::missing_element",
            "A required element is missing. The message names it and the element that lacks it. Add the element.\n    wrong: <joint> without <parent link=\"shoulder_link\"/>\n    right: <parent link=\"shoulder_link\"/>";
        REPEATED_ELEMENT = "CGR-URDF-007", "urdf::repeated_element",
            "An element is given twice where only one is allowed. Readers differ in which of the two they use. Keep one.\n    wrong: <axis xyz=\"0 0 1\"/> <axis xyz=\"0 1 0\"/>\n    right: <axis xyz=\"0 0 1\"/>";
        UNKNOWN_ELEMENT = "CGR-URDF-008", "urdf::unknown_element",
            "The name of an element differs by a letter or two from a known one, and would be silently ignored. Elements of vendors, whose names are not similar to known ones, are ignored.\n    wrong: <limits lower=\"-1\" upper=\"1\"/>\n    right: <limit .../>";
        MISSING_ATTRIBUTE = "CGR-URDF-009", "urdf::missing_attribute",
            "A required attribute is missing. The message names it and its element. Add the attribute.\n    wrong: <mass/>\n    right: <mass value=\"8.058\"/>";
        UNKNOWN_ATTRIBUTE = "CGR-URDF-010", "urdf::unknown_attribute",
            "The name of an attribute differs by a letter or two from a known one, and would be silently ignored. Correct the name.\n    wrong: <limit lower=\"-3.14\" uper=\"3.14\" .../>\n    right: <limit lower=\"-3.14\" upper=\"3.14\" .../>";
        UNKNOWN_TYPE = "CGR-URDF-011", "urdf::unknown_type",
            "URDF has no joint type of this name. The help has the known types.\n    wrong: type=\"hinge\"\n    right: type=\"revolute\"";
        NUMBER = "CGR-URDF-012", "urdf::number",
            "A value is not a finite number, or has too few or too many numbers. Decimal commas and appended units are not allowed.\n    wrong: xyz=\"0 0.4\"\n    right: xyz=\"0 0.4 0\"";
        EMPTY_NAME = "CGR-URDF-013", "urdf::empty_name",
            "A link, a joint or a reference to one has an empty name. Two such parts could not be distinguished. Give it a name.\n    wrong: <link name=\"\"/>\n    right: <link name=\"tool0\"/>";
        HIDDEN_CHARACTER = "CGR-URDF-014", "urdf::hidden_character",
            "A name has an invisible character, such as a control character or a mark of writing direction. Names are copied into every output. Type the name again.\n    wrong: <link name=\"tool0&#8203;\"/>\n    right: <link name=\"tool0\"/>";
        ROBOT_NAME = "CGR-URDF-015", "urdf::robot_name",
            "The robot has no name, so reports cannot name it. Give it one.\n    <robot name=\"my_arm\">";
        NAME = "CGR-URDF-016", "urdf::name",
            "A name is valid XML but causes trouble elsewhere, because it is very long or contains `../`. It is escaped in every output. Use short names of letters, digits and underscores.\n    wrong: <link name=\"../tool0\"/>\n    right: <link name=\"tool0\"/>";
        JOINT_TYPE = "CGR-URDF-017", "urdf::joint_type",
            "Joints of the types floating, planar and spherical are not supported. Replace such a joint by several joints with one degree of freedom, with massless links between them.\n    wrong: type=\"planar\"\n    right: type=\"prismatic\"";
        AXIS = "CGR-URDF-018", "urdf::axis",
            "The axis of a joint is zero, or its length is not 1. An axis of another length is normalised here, but some readers multiply the motion by its length. Write a direction of length 1.\n    wrong: <axis xyz=\"0 0 2\"/>\n    right: <axis xyz=\"0 0 1\"/>";
        LIMIT = "CGR-URDF-019", "urdf::limit",
            "The limits of a joint are missing, negative, in the wrong order, lock the joint, or are ignored. By the specification a limit without `lower` or `upper` has the value 0 there, which often locks a joint by mistake. Give `lower` below `upper`, and `velocity` and `effort` above 0.\n    wrong: <limit lower=\"3.14\" upper=\"-3.14\" .../>\n    right: <limit lower=\"-3.14\" upper=\"3.14\" .../>";
        DYNAMICS = "CGR-URDF-020", "urdf::dynamics",
            "The damping or friction of a joint is negative, which would add energy. Write both as values of at least 0.\n    wrong: <dynamics damping=\"-0.5\"/>\n    right: <dynamics damping=\"0.5\"/>";
        QUATERNION = "CGR-URDF-021", "urdf::quaternion",
            "A rotation is given as `quat_xyzw`, which only URDF 1.1 and later supports, or its quaternion is zero. Other readers ignore it and lose the rotation.\n    <robot name=\"r\" version=\"1.1\">";
        VERSION = "CGR-URDF-035", "urdf::version",
            "A limit of acceleration, deceleration or jerk, which URDF has from version 1.2 on. In an older file no reader takes it. State the version, with which a `<limit>` may also have no effort and no velocity.\n    <robot name=\"r\" version=\"1.2\">";
        GEOMETRY = "CGR-URDF-022", "urdf::geometry",
            "A shape is missing, unknown, or has a size that is not positive. Give each <geometry> exactly one shape with sizes above 0.\n    <geometry><box size=\"0.1 0.1 0.2\"/></geometry>";
        SCALE = "CGR-URDF-023", "urdf::scale",
            "The scale of a mesh has a zero, which flattens the mesh to no volume. Use 1 for a direction that is not scaled.\n    scale=\"1 1 1\"";
        MASS = "CGR-URDF-024", "urdf::mass",
            "A mass is negative. No body has one, and forces would accelerate it in the opposite direction. Use a mass of at least 0.\n    wrong: <mass value=\"-8.058\"/>\n    right: <mass value=\"8.058\"/>";
        INERTIA = "CGR-URDF-025", "urdf::inertia",
            "No rigid body has this inertia: it is not positive definite, or its largest principal moment exceeds the sum of the other two. The simulation would be unstable. A robot file can use the nearest possible inertia.\n    [inertia]\n    LINK = \"repair\"";
        INERTIA_SIZE = "CGR-URDF-026", "urdf::inertia_size",
            "The inertia belongs to a body many times larger than any part of a robot. Probably it is in kg mm^2 instead of kg m^2. Divide such values by 1e6.\n    wrong: <inertia ixx=\"133886\" izz=\"15107\" .../>\n    right: <inertia ixx=\"0.133886\" izz=\"0.015107\" .../>";
        CENTER_OF_MASS = "CGR-URDF-027", "urdf::center_of_mass",
            "The centre of mass is far from the shapes and joints of its link. Probably its origin is in millimetres instead of metres. Divide such values by 1000.\n    wrong: <origin xyz=\"-212.5 0 113.36\" .../>\n    right: <origin xyz=\"-0.2125 0 0.11336\" .../>";
        MASSLESS = "CGR-URDF-028", "urdf::massless",
            "A link moves, but neither it nor a link fixed to it has a mass, so forces give it no defined motion. Poses and distances are not affected. Give it an <inertial>, or make its joint fixed.\n    wrong: <link name=\"wrist_3_link\"/>\n    right: <link name=\"wrist_3_link\"> with <mass value=\"0.365\"/>";
        DEGREES = "CGR-UNIT-001", "urdf::degrees",
            "An angle is larger than is plausible in radians, the unit of a URDF. Probably it is in degrees.\n    wrong: rpy=\"0 90 0\"\n    right: rpy=\"0 1.5708 0\"";
        MILLIMETRES = "CGR-UNIT-002", "urdf::millimetres",
            "A length is larger than is plausible in metres, the unit of a URDF. Probably it is in millimetres. Divide such values by 1000.\n    wrong: <origin xyz=\"-425 0 0\"/>\n    right: <origin xyz=\"-0.425 0 0\"/>";
    }
    robot_file {
        DEGREES = "CGR-UNIT-003", "robot_file::degrees",
            "An angle under a key that ends in `_rad` is larger than is plausible in radians. Probably it is in degrees, whose key ends in `_deg`.\n    wrong: alpha_rad = 90.0\n    right: alpha_deg = 90.0";
        LENGTH = "CGR-UNIT-012", "robot_file::length",
            "A length is longer than the whole robot. Keys that end in `_m` are in metres, keys that end in `_mm` in millimetres.\n    wrong: xyz_m = [0.0, 0.0, 50.0]\n    right: xyz_mm = [0.0, 0.0, 50.0]";
        FAST = "CGR-UNIT-013", "robot_file::fast",
            "An acceleration under a key that ends in `_rad_s2` is implausibly high in radians. Probably it is in degrees, whose key ends in `_deg_s2`.\n    wrong: acceleration_rad_s2 = { elbow_joint = 800.0 }\n    right: acceleration_deg_s2 = { elbow_joint = 800.0 }";
        RADIANS = "CGR-UNIT-014", "robot_file::radians",
            "An angle under a key that ends in `_deg` is a multiple of 1.5708, a quarter turn in radians. Probably it is in radians, whose key ends in `_rad`.\n    wrong: alpha_deg = 1.5708\n    right: alpha_rad = 1.5708";
        URDF = "CGR-ROBOT-001", "robot_file::urdf",
            "The robot file names no URDF or MJCF, and has neither a table ([dh]) nor screws ([poe]) that could be the robot.\n    urdf = \"robot.urdf\"";
        PACKAGE = "CGR-ROBOT-002", "robot_file::package",
            "A folder under `packages` does not exist. Meshes named by package://NAME/... are looked for there. Correct the path of the folder.\n    wrong: packages = { ur_description = \"../ur_descripton\" }\n    right: packages = { ur_description = \"../ur_description\" }";
        UNKNOWN_LINK = "CGR-ROBOT-003", "robot_file::unknown_link",
            "`base` or `tip` names a link that the robot does not have. The help has the most similar name and the known ones.\n    wrong: tip = \"tool\"\n    right: tip = \"tool0\"";
        UNKNOWN_JOINT = "CGR-ROBOT-004", "robot_file::unknown_joint",
            "A row, an [[inertial]] entry or a limit names a joint that the robot does not have, that does not move, or that is not between base and tip. Correct the name; the help has the known ones.\n    wrong: joint = \"elbow\"\n    right: joint = \"elbow_joint\"";
        CHAIN = "CGR-ROBOT-005", "robot_file::chain",
            "The tip is not a descendant of the base, so no chain of joints connects them. Name a base from which joints lead down to the tip.\n    wrong: base = \"tool0\" and tip = \"base_link\"\n    right: base = \"base_link\" and tip = \"tool0\"";
        CONVENTION = "CGR-ROBOT-006", "robot_file::convention",
            "The table lacks its convention. The same values describe another robot in the other convention, so there is no default.\n    convention = \"standard\"";
        MISSING_FIGURE = "CGR-ROBOT-007", "robot_file::missing_figure",
            "A row of the table lacks a, alpha or d. A missing value is not taken as 0, because it may have been forgotten. If it is 0, write 0.\n    d_mm = 0";
        MISSING_ROW = "CGR-ROBOT-008", "robot_file::missing_row",
            "The table has no row for a joint that moves the tip. Without it the table describes another robot. The message names the missing joints. As a warning: the joint follows another one (<mimic>), which moves the tip just as well. Add a row for each.\n    wrong: [[dh.row]] for five of six joints\n    right: [[dh.row]] for wrist_3_joint, too";
        JOINT_TWICE = "CGR-ROBOT-009", "robot_file::joint_twice",
            "Two rows, or two [[inertial]] entries, name the same joint. Only one of the two could apply. Remove one.\n    wrong: joint = \"elbow_joint\" in two rows\n    right: joint = \"wrist_1_joint\" in the second";
        SIGN = "CGR-ROBOT-010", "robot_file::sign",
            "The sign of a row must be 1 or -1.\n    wrong: sign = 2\n    right: sign = 1";
        ROW_KIND = "CGR-ROBOT-011", "robot_file::row_kind",
            "A row is revolute but its joint in the URDF is prismatic, or the reverse. Such a table cannot describe this joint. Correct the kind of the row, or the name of its joint.\n    wrong: kind = \"prismatic\"\n    right: kind = \"revolute\"";
        ROW_ORDER = "CGR-ROBOT-012", "robot_file::row_order",
            "The rows are in another order than the joints of the chain. The transforms are multiplied in the order of the rows. Put the rows into the order of the joints from base to tip.\n    wrong: wrist_2_joint before wrist_1_joint\n    right: wrist_1_joint before wrist_2_joint";
        INERTIA = "CGR-ROBOT-013", "robot_file::inertia",
            "An entry of [inertia] repairs nothing, because its link is unknown, has no inertia, or needs no repair. As a warning: what a repair has changed. Name a link whose inertia no rigid body can have, or remove the entry.\n    wrong: inertia = { forearm = \"repair\" }\n    right: inertia = { forearm_link = \"repair\" }";
        INERTIAL = "CGR-ROBOT-014", "robot_file::inertial",
            "An entry of [[inertial]] lacks a value, has a value that no rigid body can have, or names a frame that does not belong to its joint. Give a mass above 0, `frame` and `about`, and an inertia that a rigid body can have.\n    wrong: mass_kg = -3.761\n    right: mass_kg = 3.761";
        LIMITS = "CGR-ROBOT-015", "robot_file::limits",
            "An entry of [limits] has the wrong unit for its joint, is given twice, or is not positive. Joints that turn have keys in rad or deg, joints that slide in m or mm.\n    wrong: acceleration_m_s2 = { elbow_joint = 20.0 }\n    right: acceleration_rad_s2 = { elbow_joint = 20.0 }";
        MAPPING = "CGR-ROBOT-027", "robot_file::mapping",
            "An offset of [mapping.joints] has the wrong unit for its joint, is given twice, or is no position of a joint. `q_there = sign * q_here + offset`.\n    elbow = { joint = \"joint3\", sign = -1, offset_deg = 90 }";
        TOLERANCE = "CGR-ROBOT-016", "robot_file::tolerance",
            "A tolerance must be greater than 0. With a tolerance of 0, rounding alone would be a disagreement.\n    wrong: position_m = 0.0\n    right: position_m = 1e-12";
        TOLERANCES = "CGR-ROBOT-032", "robot_file::tolerances",
            "A value of [tolerances] is not above 0, or a row names a joint that the robot does not have. A tolerance is a half width: the parameter is within so much of its value, to both sides. Leave out what is exact.\n    wrong: a_mm = -0.05\n    right: a_mm = 0.05";
        OWN_MODEL = "CGR-ROBOT-028", "robot_file::own_model",
            "A robot file without a URDF is a robot by itself: either a table ([dh]) or screws ([poe]). It cannot have both, nor keys that are about links, shapes and masses of a URDF; and a robot file with a URDF cannot have [poe]. Put the second model into a file of its own.\n    congruent check table.toml --against screws.toml";
        RANGE = "CGR-ROBOT-029", "robot_file::range",
            "The range of a joint has the wrong unit, no positions, or is given beside a URDF, which has the ranges of its joints.\n    range_deg = [-170, 170]";
        SCREW = "CGR-ROBOT-030", "robot_file::screw",
            "An entry of [[poe.joint]] is no screw of a joint: its direction is not of length 1, its joint turns and slides at once, or a part is missing. A joint that turns about an axis omega through a point q has v_m = -omega x q.\n    omega = [0, 0, 1]\n    v_m = [0, -0.6, 0]";
        NO_BODIES = "CGR-ROBOT-031", "robot_file::no_bodies",
            "The robot is a table or screws without a URDF: it has joints, but neither masses nor shapes, which forces and distances need. Name a URDF or an MJCF.\n    urdf = \"robot.urdf\"";
        TCP_NAME = "CGR-ROBOT-017", "robot_file::tcp_name",
            "A link of the URDF is called `tcp`, as the declared tool centre point usually is. The declared one is called `declared_tcp`. Rename the link if `tcp` shall mean the declared one.\n    wrong: <link name=\"tcp\"/> beside [tcp]\n    right: <link name=\"tool0\"/> beside [tcp]";
    }
    tolerance {
        MEANINGLESS = "CGR-ROBOT-018", "tolerance::meaningless",
            "A tolerance exceeds the reach of the arm, or half a turn, so that every pose would agree. Often the minus sign of an exponent is missing. Give far less than a tenth of the reach.\n    wrong: position_m = 1e12\n    right: position_m = 1e-12";
        WIDE = "CGR-ROBOT-019", "tolerance::wide",
            "A tolerance exceeds a tenth of the reach of the arm, or of half a turn. Then real faults agree. Give at most a tenth, unless such a wide tolerance is intended.\n    wrong: position_m = 0.3\n    right: position_m = 0.001";
    }
    chain {
        BROKEN = "CGR-ROBOT-020", "chain::broken",
            "The tip is not a descendant of the base, so no chain of joints connects them. Name a base from which joints lead down to the tip.\n    wrong: congruent fk robots/ur5e --base tool0 --tip base_link\n    right: congruent fk robots/ur5e --base base_link --tip tool0";
        UNKNOWN_LINK = "CGR-ROBOT-021", "chain::unknown_link",
            "--base or --tip names a link that the robot does not have. The help has the most similar name and the known ones.\n    wrong: congruent fk robots/ur5e --tip tool\n    right: congruent fk robots/ur5e --tip tool0";
        SEVERAL_TIPS = "CGR-ROBOT-022", "chain::several_tips",
            "No file names the tip of the chain, and several chains are about equally long. Name the tip in a robot file.\n    tip = \"tool0\"";
        TABLE_DROPPED = "CGR-ROBOT-023", "chain::table_dropped",
            "The table describes another chain than the requested one, so it is not used. Leave --base and --tip out to use the table.\n    wrong: congruent check robots/ur5e --tip forearm_link\n    right: congruent check robots/ur5e";
    }
}
