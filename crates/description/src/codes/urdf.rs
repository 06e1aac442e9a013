//! Findings about a URDF, and values that are probably in another unit.

use super::Area;

pub(super) const AREAS: &[Area] = &[
    Area {
        word: "URDF",
        codes: &[
            (
                1,
                "urdf::root",
                "The root element is not <robot>, so the file is no URDF. SDF, MuJoCo and COLLADA files are named as what they are.",
            ),
            (
                2,
                "urdf::xacro",
                "The file is xacro that has not been expanded. It is never expanded here, since xacro runs code.\n    xacro robot.urdf.xacro > robot.urdf",
            ),
            (3, "urdf::structure", "The file is no valid URDF; the message has the reason."),
            (4, "urdf::too_many_links", "The robot has more links than can be handled in a reasonable time."),
            (
                5,
                "urdf::tree",
                "Links and joints do not form one tree: a link is missing, has two parents or is its own ancestor, there are several roots, or two links or joints share a name.",
            ),
            (6, "urdf::missing_element", "An element that has no default is missing."),
            (
                7,
                "urdf::repeated_element",
                "An element is given twice where one is allowed. Readers differ in which of the two they take.",
            ),
            (
                8,
                "urdf::unknown_element",
                "An element has a name that is a letter or two away from a known one. It would be ignored without a word; elements of vendors, whose names are not like known ones, are ignored.\n    <limits lower=\"-1\" upper=\"1\"/> instead of <limit .../>",
            ),
            (9, "urdf::missing_attribute", "An attribute that has no default is missing."),
            (
                10,
                "urdf::unknown_attribute",
                "An attribute has a name that is a letter or two away from a known one. It would be ignored without a word.",
            ),
            (11, "urdf::unknown_type", "The type of a joint is none that URDF knows."),
            (
                12,
                "urdf::number",
                "A value is no finite number, or has too few or too many numbers. Decimal commas and units beside numbers are no numbers.\n    xyz=\"0 0.4\" instead of xyz=\"0 0.4 0\"",
            ),
            (13, "urdf::empty_name", "A link, a joint or a reference to one has an empty name."),
            (
                14,
                "urdf::hidden_character",
                "A name has a character that is not shown, such as a control character or a mark of writing direction.",
            ),
            (15, "urdf::robot_name", "The robot has no name. Reports then have none to show."),
            (
                16,
                "urdf::name",
                "A name is legal XML and troublesome elsewhere: it is very long, or holds `../`. It is escaped wherever it is written.",
            ),
            (
                17,
                "urdf::joint_type",
                "Joints of the types floating, planar and spherical are not supported. Several joints with one degree of freedom in a row, with links without extent between them, make the same motion.",
            ),
            (
                18,
                "urdf::axis",
                "The axis of a joint is zero, or its length is not 1. A length other than 1 is normalised here, while some readers take it as a factor of the motion.\n    <axis xyz=\"0 0 2\"/> instead of <axis xyz=\"0 0 1\"/>",
            ),
            (
                19,
                "urdf::limit",
                "The limits of a joint are missing, negative, in the wrong order, lock it, or are ignored. A limit without `lower` or `upper` has 0 there by the specification, which locks many joints by mistake.",
            ),
            (20, "urdf::dynamics", "Damping or friction of a joint is negative, which would add energy."),
            (
                21,
                "urdf::quaternion",
                "A rotation is given as `quat_xyzw`, which only version 1.1 of URDF knows, or its quaternion is zero. Other readers ignore it and lose the rotation.\n    <robot name=\"r\" version=\"1.1\">",
            ),
            (22, "urdf::geometry", "A shape is missing, unknown, or has a size that is not positive."),
            (23, "urdf::scale", "The scale of a mesh has a zero, which flattens it to nothing."),
            (24, "urdf::mass", "A mass is negative."),
            (
                25,
                "urdf::inertia",
                "No rigid body has this inertia: it is not positive definite, or its largest principal moment is above the sum of the others. Physics would be unstable. A robot file can take the nearest possible inertia.\n    [inertia]\n    LINK = \"repair\"",
            ),
            (
                26,
                "urdf::inertia_size",
                "The inertia is that of a body many times larger than any part of a robot: it is probably in kg mm^2.",
            ),
            (
                27,
                "urdf::center_of_mass",
                "The centre of mass is far outside of everything that belongs to the link, so the mass would hang on a long lever.",
            ),
            (
                28,
                "urdf::massless",
                "A link moves and has no mass, nor has anything that is fixed to it, so its motion under forces is not defined. Poses and distances are. Give it an <inertial>, or make its joint fixed.",
            ),
            (
                29,
                "urdf::zero_inertia",
                "A link has a mass and an inertia of zero, so that it would be a point. Any torque about it would turn it at any speed.",
            ),
            (
                30,
                "urdf::zero_limit",
                "The velocity limit of a joint that moves is 0, or its effort limit is 0 while other joints have one. Here 0 counts as not given; to other programs it is a joint that cannot move. An effort of 0 for all joints is how many files say that it is not known, and is not told.",
            ),
            (
                31,
                "urdf::still_mimic",
                "A joint mimics another with a multiplier of 0, so that it never moves. Left out, the multiplier is 1.",
            ),
            (
                32,
                "urdf::material",
                "A material is named that the file gives neither a colour nor a texture, so that the shape is drawn in a colour of the program's own.",
            ),
            (
                33,
                "urdf::unknown_reference",
                "A <transmission>, <ros2_control> or <gazebo> names a joint or a link that the robot does not have. Often it was renamed.",
            ),
        ],
    },
    Area {
        word: "UNIT",
        codes: &[
            (
                1,
                "urdf::degrees",
                "Angles of a URDF are in radians, and these are of a size that only degrees have.\n    rpy=\"0 90 0\" instead of rpy=\"0 1.5708 0\"",
            ),
            (
                2,
                "urdf::millimetres",
                "Lengths of a URDF are in metres, and this one is of a size that only millimetres have.",
            ),
            (
                3,
                "robot_file::degrees",
                "An angle under a key that ends in `_rad` is of a size that only degrees have. The key for degrees ends in `_deg`.",
            ),
            (
                4,
                "units::origin",
                "The origin of a joint is far from everything else that the robot has: from the shapes of the link that carries it, or against all other origins. Lengths of a URDF are in metres.",
            ),
            (
                5,
                "units::travel",
                "A sliding joint travels farther than the robot, or the two links that slide, are large. Its range is in metres, not in millimetres.",
            ),
            (
                6,
                "units::slide_speed",
                "A sliding joint is faster than any joint. Its velocity is in m/s, not in mm/s.",
            ),
            (
                7,
                "units::speed",
                "A turning joint is faster than any joint, than what it carries can be, or than its torque allows. Its velocity is in rad/s, not in deg/s.\n    velocity=\"180\" instead of velocity=\"3.14\"",
            ),
            (
                8,
                "units::mass",
                "The mass in the box around the shapes is denser than any material, or lighter than any foam. Masses are in kg, not in grams; or the shapes are in another unit.",
            ),
            (
                9,
                "units::inertia",
                "The radius of gyration that mass and inertia imply does not belong to the shapes of the link, or to any material. Inertias are in kg m^2, masses in kg.",
            ),
            (
                10,
                "units::small_mesh",
                "A mesh is as small as dust, or tiny against the robot's other meshes. Often a mesh in metres has got a scale for millimetres.",
            ),
            (
                11,
                "units::large_shape",
                "A shape is many times larger than the robot's others. Sizes are in metres.",
            ),
            (
                12,
                "robot_file::length",
                "A length under a key that ends in `_m` is longer than the whole robot. The key for millimetres ends in `_mm`.",
            ),
            (
                13,
                "robot_file::fast",
                "An acceleration under a key that ends in `_rad_s2` is of a size that only degrees have. The key for degrees ends in `_deg_s2`.",
            ),
            (
                14,
                "robot_file::radians",
                "An angle under a key that ends in `_deg` is quarter turns in radians, as 1.5708. The key for radians ends in `_rad`.",
            ),
        ],
    },
];
