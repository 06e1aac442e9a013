//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    lint {
        KIND = "CGR-FILE-016", "lint::kind" unreadable,
            "The file is not of a kind that can be linted. These kinds are URDF, SRDF, robot file, scenario, and tables of configurations, targets or measurements; the content decides the kind. Give a file of one of these kinds.\n    wrong: congruent lint results/report.json\n    right: congruent lint robots/ur5e";
        IGNORE = "CGR-ROBOT-025", "lint::ignore",
            "An entry of [[lint.ignore]] is wrong: its code is unknown, it gives no reason, or it would ignore an error. Name a code of a warning, and give a reason.\n    wrong: code = \"CGR-URDF-999\"\n    right: code = \"CGR-URDF-034\"";
        IGNORED_NOTHING = "CGR-ROBOT-026", "lint::ignored_nothing",
            "An entry of [[lint.ignore]] ignores nothing, because no finding matches it. Remove it, so that it does not hide a finding later.\n    wrong: code = \"CGR-URDF-024\" in [[lint.ignore]]\n    right: no such entry";
    }
    xml {
        ENCODING = "CGR-XML-007", "xml::encoding",
            "The encoding that the file declares is not the encoding it has. Readers that follow the declaration refuse the file, or read other names. Save the file as UTF-8 and declare that.\n    <?xml version=\"1.0\" encoding=\"UTF-8\"?>";
    }
    srdf {
        PAIR = "CGR-SRDF-002", "srdf::pair",
            "<disable_collisions> or <enable_collisions> lacks link1 or link2, or names the same link twice, so it has no effect. Give two different links.\n    <disable_collisions link1=\"base_link\" link2=\"shoulder_link\"/>";
        ROOT = "CGR-SRDF-003", "srdf::root",
            "The root element of an SRDF must be <robot>, and the file must not be a URDF. Give the SRDF, which begins like this.\n    <robot name=\"my_arm\">";
        UNKNOWN_JOINT = "CGR-SRDF-004", "srdf::unknown_joint",
            "The SRDF names a joint that the robot does not have. Often the joint was renamed, or has the prefix of another robot. Write the name that the URDF has.\n    wrong: <joint name=\"joint4\" value=\"-1.57\"/>\n    right: <joint name=\"panda_joint4\" value=\"-1.57\"/>";
        UNKNOWN_GROUP = "CGR-SRDF-005", "srdf::unknown_group",
            "The SRDF names a group that it does not define. Often the group was renamed. Write the name of a <group> of the file.\n    wrong: <group_state name=\"home\" group=\"manipulator\">\n    right: <group_state name=\"home\" group=\"arm\">";
        MISSING_NAME = "CGR-SRDF-006", "srdf::missing_name",
            "An element of the SRDF lacks the name of its link, joint or group. Without it the element has no effect. Add the name.\n    wrong: <joint value=\"-1.57\"/>\n    right: <joint name=\"panda_joint4\" value=\"-1.57\"/>";
        ROBOT_NAME = "CGR-SRDF-007", "srdf::robot_name",
            "The SRDF and the URDF have different robot names. Motion planners refuse to load the two together. Give the SRDF the name of the URDF.\n    wrong: <robot name=\"panda_arm\">\n    right: <robot name=\"panda\">";
        TWICE = "CGR-SRDF-008", "srdf::twice",
            "Two groups, or two states of one group, have the same name. Motion planners silently use one of the two. Rename or remove one.\n    wrong: <group_state name=\"home\" group=\"arm\"> a second time\n    right: <group_state name=\"ready\" group=\"arm\">";
        EMPTY_GROUP = "CGR-SRDF-009", "srdf::empty_group",
            "A group has no joints, links, chains or groups, so nothing can be planned for it. Add what belongs to it, or remove the group.\n    wrong: <group name=\"arm\"/>\n    right: <group name=\"arm\"><joint name=\"panda_joint1\"/></group>";
        VALUE = "CGR-SRDF-010", "srdf::value",
            "The position of a joint in a named state is missing or is not a number (in rad or m). Write a number.\n    <joint name=\"elbow_joint\" value=\"1.57\"/>";
        BEYOND_LIMIT = "CGR-SRDF-011", "srdf::beyond_limit",
            "A named state puts a joint beyond its limits in the URDF. Motion planners refuse it as a goal. Often the position is in degrees. Write the position in rad or m.\n    wrong: <joint name=\"panda_joint4\" value=\"-90\"/>\n    right: <joint name=\"panda_joint4\" value=\"-1.57\"/>";
        UNKNOWN_ELEMENT = "CGR-SRDF-012", "srdf::unknown_element",
            "An element is misspelt, so readers ignore it. Correct its name.\n    wrong: <disable_collision link1=... link2=.../>\n    right: <disable_collisions link1=... link2=.../>";
        VIRTUAL_JOINT = "CGR-SRDF-013", "srdf::virtual_joint",
            "The type of a virtual joint is unknown; it must be fixed, planar or floating.\n    wrong: type=\"revolute\"\n    right: type=\"fixed\"";
    }
    urdf {
        ZERO_INERTIA = "CGR-URDF-029", "urdf::zero_inertia",
            "A link has a mass but an inertia of zero, which would be a point mass: any torque would give it an infinite acceleration. Give the inertia of the body in kg m^2.\n    wrong: <inertia ixx=\"0\" iyy=\"0\" izz=\"0\" .../>\n    right: <inertia ixx=\"0.0102675\" iyy=\"0.0102675\" izz=\"0.00666\" .../>";
        ZERO_LIMIT = "CGR-URDF-030", "urdf::zero_limit",
            "The velocity limit of a movable joint is 0, or its effort limit is 0 while other joints have one. Congruent reads 0 as \"not given\"; other programs read it as \"cannot move\". If the effort limits of all joints are 0, nothing is reported: that is a common way to write \"unknown\". Write the value of the data sheet.\n    wrong: velocity=\"0\"\n    right: velocity=\"3.141592653589793\"";
        STILL_MIMIC = "CGR-URDF-031", "urdf::still_mimic",
            "A joint mimics another with the multiplier 0, so it never moves. The default multiplier is 1. Correct the multiplier, or make the joint fixed.\n    wrong: <mimic joint=\"panda_finger_joint1\" multiplier=\"0\"/>\n    right: <mimic joint=\"panda_finger_joint1\"/>";
        MATERIAL = "CGR-URDF-032", "urdf::material",
            "A material has no colour and no texture anywhere in the file, so the viewer chooses the colour of the shape. Give it a colour, or remove the reference. No result depends on it.\n    wrong: <material name=\"steel\"/>\n    right: <material name=\"steel\"><color rgba=\"0.7 0.7 0.7 1\"/></material>";
        UNKNOWN_REFERENCE = "CGR-URDF-033", "urdf::unknown_reference",
            "A <transmission>, <ros2_control> or <gazebo> element names a joint or a link that the robot does not have. Often it was renamed. Write the name that the link or joint has.\n    wrong: <gazebo reference=\"wrist_3\">\n    right: <gazebo reference=\"wrist_3_link\">";
        COARSE_TURN = "CGR-URDF-034", "urdf::coarse_turn",
            "A roll, pitch or yaw has the first digits of a quarter turn and no more: 1.57 is off by 0.8 mrad, which moves what is 1 m away by 0.8 mm. The digits then allow such a difference everywhere, so that a real one of this size is not seen. Write all digits.\n    <origin xyz=\"0 0 0.1\" rpy=\"1.5707963267948966 0 0\"/>";
    }
    units {
        ORIGIN = "CGR-UNIT-004", "units::origin",
            "The origin of a joint is far from the shapes of its parent link, or far longer than all other joint origins together. Lengths of a URDF are in metres. Correct the decimal point or the unit.\n    wrong: <origin xyz=\"-4.25 0 0\"/>\n    right: <origin xyz=\"-0.425 0 0\"/>";
        TRAVEL = "CGR-UNIT-005", "units::travel",
            "The range of a prismatic joint is far larger than the robot or than the two links of the joint. The range is in metres, not in millimetres. Divide values in millimetres by 1000.\n    wrong: <limit lower=\"0\" upper=\"40\" .../>\n    right: <limit lower=\"0\" upper=\"0.04\" .../>";
        SLIDE_SPEED = "CGR-UNIT-006", "units::slide_speed",
            "The velocity limit of a prismatic joint is implausibly high. It is in m/s, not in mm/s. Divide values in mm/s by 1000.\n    wrong: velocity=\"200\"\n    right: velocity=\"0.2\"";
        SPEED = "CGR-UNIT-007", "units::speed",
            "The velocity limit of a revolute joint is implausibly high: in itself, for the parts that the joint carries, or for the power of its motor. It is in rad/s, not in deg/s.\n    wrong: velocity=\"180\"\n    right: velocity=\"3.14\"";
        EFFORT = "CGR-UNIT-015", "units::effort",
            "The effort limit of a turning joint, times its velocity limit, is a power that no motor of the robot's mass has. It is in N m, not in N mm.\n    wrong: effort=\"150000\"\n    right: effort=\"150\"";
        DAMPING = "CGR-UNIT-016", "units::damping",
            "The damping of a joint takes many times its effort limit at its velocity limit, so the joint could never reach that speed. It is in N m s/rad, not in N mm s/rad. Divide values in N mm s/rad by 1000.\n    wrong: <dynamics damping=\"3000\"/>\n    right: <dynamics damping=\"3\"/>";
        FRICTION = "CGR-UNIT-017", "units::friction",
            "The dry friction of a joint is larger than its effort limit, so its motor could never move it. It is in N m (N for a prismatic joint), not in N mm.\n    wrong: friction=\"2400\"\n    right: friction=\"2.4\"";
        MASS = "CGR-UNIT-008", "units::mass",
            "The mass of a link, divided by the volume of its shapes, gives a density higher than that of any material or lower than that of any foam; or a link that another one carries is more than ten times as heavy as all others together. Masses are in kg, not in grams; or the shapes are in a wrong unit. Divide values in grams by 1000.\n    wrong: <mass value=\"8058\"/>\n    right: <mass value=\"8.058\"/>";
        INERTIA = "CGR-UNIT-009", "units::inertia",
            "The radius of gyration that follows from mass and inertia does not fit the shapes of the link, or any material. Inertias are in kg m^2, masses in kg. Divide values in kg mm^2 by 1e6.\n    wrong: <inertia ixx=\"133886\" izz=\"15107\" .../>\n    right: <inertia ixx=\"0.133886\" izz=\"0.015107\" .../>";
        SMALL_MESH = "CGR-UNIT-010", "units::small_mesh",
            "A mesh is smaller than 3 mm, or tiny compared with the other meshes of the robot. Often a mesh in metres has the scale for millimetres. Remove the scale from a mesh in metres.\n    wrong: <mesh filename=\"wrist3.stl\" scale=\"0.001 0.001 0.001\"/>\n    right: <mesh filename=\"wrist3.stl\"/>";
        LARGE_SHAPE = "CGR-UNIT-011", "units::large_shape",
            "A shape is many times larger than the other shapes of the robot. Sizes are in metres. Divide values in millimetres by 1000.\n    wrong: <cylinder radius=\"58\" length=\"152\"/>\n    right: <cylinder radius=\"0.058\" length=\"0.152\"/>";
    }
}
