//! Findings about a URDF, and values that are probably in another unit.

use super::Area;

pub(super) const AREAS: &[Area] = &[
    Area {
        word: "URDF",
        codes: &[
            (
                1,
                "urdf::root",
                "The root element is not <robot>, so the file is not a URDF. The message says if it is an SDF, MuJoCo or COLLADA file.",
            ),
            (
                2,
                "urdf::xacro",
                "The file is a xacro file that has not been expanded. It is never expanded here, because xacro executes code.\n    xacro robot.urdf.xacro > robot.urdf",
            ),
            (3, "urdf::structure", "The file is not a valid URDF; the message has the reason."),
            (
                4,
                "urdf::too_many_links",
                "The robot has more links than the limit, up to which it can be processed in a reasonable time.",
            ),
            (
                5,
                "urdf::tree",
                "Links and joints do not form one tree: a link is missing, has two parents or is its own ancestor, there are several roots, or two links or two joints share a name.",
            ),
            (
                6,
                "urdf::missing_element",
                "A required element is missing. The message names it and the element that lacks it.",
            ),
            (
                7,
                "urdf::repeated_element",
                "An element is given twice where only one is allowed. Readers differ in which of the two they use. Keep one.",
            ),
            (
                8,
                "urdf::unknown_element",
                "The name of an element differs by a letter or two from a known one, and would be silently ignored. Elements of vendors, whose names are not similar to known ones, are ignored.\n    <limits lower=\"-1\" upper=\"1\"/> instead of <limit .../>",
            ),
            (
                9,
                "urdf::missing_attribute",
                "A required attribute is missing. The message names it and its element.",
            ),
            (
                10,
                "urdf::unknown_attribute",
                "The name of an attribute differs by a letter or two from a known one, and would be silently ignored.",
            ),
            (11, "urdf::unknown_type", "URDF has no joint type of this name. The help has the known types."),
            (
                12,
                "urdf::number",
                "A value is not a finite number, or has too few or too many numbers. Decimal commas and appended units are not allowed.\n    xyz=\"0 0.4\" instead of xyz=\"0 0.4 0\"",
            ),
            (
                13,
                "urdf::empty_name",
                "A link, a joint or a reference to one has an empty name. Two such parts could not be distinguished. Give it a name.",
            ),
            (
                14,
                "urdf::hidden_character",
                "A name has an invisible character, such as a control character or a mark of writing direction. Names are copied into every output. Type the name again.",
            ),
            (
                15,
                "urdf::robot_name",
                "The robot has no name, so reports cannot name it. Give it one.\n    <robot name=\"my_arm\">",
            ),
            (
                16,
                "urdf::name",
                "A name is valid XML but causes trouble elsewhere, because it is very long or contains `../`. It is escaped in every output. Use short names of letters, digits and underscores.",
            ),
            (
                17,
                "urdf::joint_type",
                "Joints of the types floating, planar and spherical are not supported. Replace such a joint by several joints with one degree of freedom, with massless links between them.",
            ),
            (
                18,
                "urdf::axis",
                "The axis of a joint is zero, or its length is not 1. An axis of another length is normalised here, but some readers multiply the motion by its length.\n    <axis xyz=\"0 0 2\"/> instead of <axis xyz=\"0 0 1\"/>",
            ),
            (
                19,
                "urdf::limit",
                "The limits of a joint are missing, negative, in the wrong order, lock the joint, or are ignored. By the specification a limit without `lower` or `upper` has the value 0 there, which often locks a joint by mistake.",
            ),
            (
                20,
                "urdf::dynamics",
                "The damping or friction of a joint is negative, which would add energy. Write both as values of at least 0.",
            ),
            (
                21,
                "urdf::quaternion",
                "A rotation is given as `quat_xyzw`, which only URDF 1.1 and later supports, or its quaternion is zero. Other readers ignore it and lose the rotation.\n    <robot name=\"r\" version=\"1.1\">",
            ),
            (
                22,
                "urdf::geometry",
                "A shape is missing, unknown, or has a size that is not positive. Give each <geometry> exactly one shape with sizes above 0.\n    <geometry><box size=\"0.1 0.1 0.2\"/></geometry>",
            ),
            (
                23,
                "urdf::scale",
                "The scale of a mesh has a zero, which flattens the mesh to no volume. Use 1 for a direction that is not scaled.\n    scale=\"1 1 1\"",
            ),
            (
                24,
                "urdf::mass",
                "A mass is negative. No body has one, and forces would accelerate it in the opposite direction. Use a mass of at least 0.",
            ),
            (
                25,
                "urdf::inertia",
                "No rigid body has this inertia: it is not positive definite, or its largest principal moment exceeds the sum of the other two. The simulation would be unstable. A robot file can use the nearest possible inertia.\n    [inertia]\n    LINK = \"repair\"",
            ),
            (
                26,
                "urdf::inertia_size",
                "The inertia belongs to a body many times larger than any part of a robot. Probably it is in kg mm^2 instead of kg m^2.",
            ),
            (
                27,
                "urdf::center_of_mass",
                "The centre of mass is far from the shapes and joints of its link. Probably its origin is in millimetres instead of metres.",
            ),
            (
                28,
                "urdf::massless",
                "A link moves, but neither it nor a link fixed to it has a mass, so forces give it no defined motion. Poses and distances are not affected. Give it an <inertial>, or make its joint fixed.",
            ),
            (
                29,
                "urdf::zero_inertia",
                "A link has a mass but an inertia of zero, which would be a point mass: any torque would give it an infinite acceleration. Give the inertia of the body in kg m^2.",
            ),
            (
                30,
                "urdf::zero_limit",
                "The velocity limit of a movable joint is 0, or its effort limit is 0 while other joints have one. Congruent reads 0 as \"not given\"; other programs read it as \"cannot move\". If the effort limits of all joints are 0, nothing is reported: that is a common way to write \"unknown\".",
            ),
            (
                31,
                "urdf::still_mimic",
                "A joint mimics another with the multiplier 0, so it never moves. The default multiplier is 1. Correct the multiplier, or make the joint fixed.",
            ),
            (
                32,
                "urdf::material",
                "A material has no colour and no texture anywhere in the file, so the viewer chooses the colour of the shape. Give it a colour, or remove the reference. No result depends on it.",
            ),
            (
                33,
                "urdf::unknown_reference",
                "A <transmission>, <ros2_control> or <gazebo> element names a joint or a link that the robot does not have. Often it was renamed.",
            ),
        ],
    },
    Area {
        word: "UNIT",
        codes: &[
            (
                1,
                "urdf::degrees",
                "An angle is larger than is plausible in radians, the unit of a URDF. Probably it is in degrees.\n    rpy=\"0 90 0\" instead of rpy=\"0 1.5708 0\"",
            ),
            (
                2,
                "urdf::millimetres",
                "A length is larger than is plausible in metres, the unit of a URDF. Probably it is in millimetres.",
            ),
            (
                3,
                "robot_file::degrees",
                "An angle under a key that ends in `_rad` is larger than is plausible in radians. Probably it is in degrees, whose key ends in `_deg`.",
            ),
            (
                4,
                "units::origin",
                "The origin of a joint is far from the shapes of its parent link, or far longer than all other joint origins together. Lengths of a URDF are in metres.",
            ),
            (
                5,
                "units::travel",
                "The range of a prismatic joint is far larger than the robot or than the two links of the joint. The range is in metres, not in millimetres.",
            ),
            (
                6,
                "units::slide_speed",
                "The velocity limit of a prismatic joint is implausibly high. It is in m/s, not in mm/s.",
            ),
            (
                7,
                "units::speed",
                "The velocity limit of a revolute joint is implausibly high: in itself, for the parts that the joint carries, or for the power of its motor. It is in rad/s, not in deg/s.\n    velocity=\"180\" instead of velocity=\"3.14\"",
            ),
            (
                8,
                "units::mass",
                "The mass of a link, divided by the volume of its shapes, gives a density higher than that of any material or lower than that of any foam. Masses are in kg, not in grams; or the shapes are in a wrong unit.",
            ),
            (
                9,
                "units::inertia",
                "The radius of gyration that follows from mass and inertia does not fit the shapes of the link, or any material. Inertias are in kg m^2, masses in kg.",
            ),
            (
                10,
                "units::small_mesh",
                "A mesh is smaller than 3 mm, or tiny compared with the other meshes of the robot. Often a mesh in metres has the scale for millimetres.",
            ),
            (
                11,
                "units::large_shape",
                "A shape is many times larger than the other shapes of the robot. Sizes are in metres.",
            ),
            (
                12,
                "robot_file::length",
                "A length is longer than the whole robot. Keys that end in `_m` are in metres, keys that end in `_mm` in millimetres.",
            ),
            (
                13,
                "robot_file::fast",
                "An acceleration under a key that ends in `_rad_s2` is implausibly high in radians. Probably it is in degrees, whose key ends in `_deg_s2`.",
            ),
            (
                14,
                "robot_file::radians",
                "An angle under a key that ends in `_deg` is a multiple of 1.5708, a quarter turn in radians. Probably it is in radians, whose key ends in `_rad`.",
            ),
        ],
    },
];
