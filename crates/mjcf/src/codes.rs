//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    mjcf {
        ROOT = "CGR-MJCF-001", "mjcf::root" unreadable,
            "The root element is not <mujoco>, so the file is not an MJCF. MuJoCo reads a URDF, too, but here each format has its own reader. Give an MJCF here, and a URDF to the command itself.\n    wrong: <model name=\"hand\" file=\"hand.urdf\"/>\n    right: <model name=\"hand\" file=\"hand.xml\"/>";
        INCLUDE = "CGR-MJCF-002", "mjcf::include",
            "An <include> names no file, has children, names a file that is included already, or a file without elements. MuJoCo includes each file at most once. Name each file once.\n    wrong: <include/>\n    right: <include file=\"ur5e.xml\"/>";
        UNKNOWN_ELEMENT = "CGR-MJCF-003", "mjcf::unknown_element",
            "MJCF has no element of this name at this place, so MuJoCo refuses the file. The help has the most similar name and the known ones. Correct the name.\n    wrong: <hinge name=\"elbow_joint\"/>\n    right: <joint name=\"elbow_joint\" type=\"hinge\"/>";
        UNKNOWN_ATTRIBUTE = "CGR-MJCF-004", "mjcf::unknown_attribute",
            "The element has no attribute of this name, so MuJoCo refuses the file. The help has the most similar name and the known ones.\n    wrong: <body poss=\"0 0 1\">\n    right: <body pos=\"0 0 1\">";
        REPEATED_ELEMENT = "CGR-MJCF-005", "mjcf::repeated_element",
            "An element is given twice where MJCF allows only one, as two <inertial> in a body. Keep one.\n    wrong: <inertial mass=\"3.7\" .../> <inertial mass=\"3.8\" .../>\n    right: <inertial mass=\"3.7\" .../>";
        MISSING_ATTRIBUTE = "CGR-MJCF-006", "mjcf::missing_attribute",
            "A required attribute is missing. The message names it and its element. Add the attribute.\n    wrong: <inertial mass=\"3.761\" .../>\n    right: <inertial mass=\"3.761\" pos=\"0 0 -0.025\" .../>";
        NUMBER = "CGR-MJCF-007", "mjcf::number",
            "A value is not a finite number, or has too few or too many numbers. Numbers are separated by spaces; decimal commas and units are not allowed.\n    wrong: pos=\"0 0.4\"\n    right: pos=\"0 0.4 0\"";
        KEYWORD = "CGR-MJCF-008", "mjcf::keyword",
            "The attribute takes one of several words; this value is none of them. The help lists the known words.\n    wrong: type=\"revolute\"\n    right: type=\"hinge\"";
        PLACEMENT = "CGR-MJCF-009", "mjcf::placement",
            "An element or attribute is at a place where MuJoCo refuses it: a joint or an inertial in <worldbody> or directly in <replicate>, or an attribute of <worldbody>. Put it into a <body>.\n    wrong: <worldbody><joint name=\"pan\"/></worldbody>\n    right: <worldbody><body><joint name=\"pan\"/>...</body></worldbody>";
        NAME = "CGR-MJCF-010", "mjcf::name",
            "Two elements of one kind share a name, so a reference to it has two meanings, or a name has an invisible character. Rename one of them. A body is called world already: the world itself.\n    wrong: two <body name=\"forearm_link\">\n    right: <body name=\"forearm_link\"> and <body name=\"wrist_1_link\">";
        UNKNOWN_NAME = "CGR-MJCF-011", "mjcf::unknown_name",
            "An element refers to a joint, body, mesh or other element that the file does not have. The help has the most similar name and the known ones.\n    wrong: <motor joint=\"elbow\"/>\n    right: <motor joint=\"elbow_joint\"/>";
        CLASS = "CGR-MJCF-012", "mjcf::class",
            "A class of defaults is not declared, is declared twice, or has no name; or the class at the top of a second <default> section has another name than main. Declare the class once in <default>, with a name.\n    wrong: <joint class=\"ur5\" .../>\n    right: <joint class=\"ur5e\" .../>";
        ORIENTATION = "CGR-MJCF-013", "mjcf::orientation",
            "An orientation is given by two attributes, or by a quaternion, an axis or a direction of length 0. Keep exactly one of quat, axisangle, euler, xyaxes and zaxis.\n    wrong: quat=\"1 0 0 0\" euler=\"0 90 0\"\n    right: euler=\"0 90 0\"";
        COMPILER = "CGR-MJCF-014", "mjcf::compiler",
            "A setting of <compiler> cannot be used: global coordinates were removed from MuJoCo, or `eulerseq` is not three of the letters x y z X Y Z. Convert global coordinates with MuJoCo 2.3.3, and write three letters in `eulerseq`.\n    wrong: eulerseq=\"rpy\"\n    right: eulerseq=\"xyz\"";
        JOINT = "CGR-MJCF-015", "mjcf::joint",
            "MuJoCo refuses this combination of joints: a free joint beside other joints or in a body that is no child of the world, more than six degrees of freedom in a body, or a ball joint followed by a rotation. Or an armature is negative, with which a joint may have no inertia. Keep the joints that the body has in reality, a ball joint as the last.\n    wrong: <freejoint/> <joint name=\"pan\" .../>\n    right: <joint name=\"pan\" .../>";
        AXIS = "CGR-MJCF-016", "mjcf::axis",
            "The axis of a joint has the length 0, so it has no direction. Write a direction; its length does not matter.\n    axis=\"0 0 1\"";
        RANGE = "CGR-MJCF-017", "mjcf::range",
            "A range is missing, in the wrong order, or lacks `limited` while autolimits is off. As a warning: MuJoCo ignores a range whose lower end is not below its upper end, so the joint has no limits. Write the lower end first.\n    wrong: range=\"3.14 -3.14\"\n    right: range=\"-3.14 3.14\"";
        INERTIAL = "CGR-MJCF-018", "mjcf::inertial",
            "No rigid body has this inertia, or it is given twice: a moment exceeds the sum of the other two, is not positive, or `fullinertia` is beside `diaginertia` or an orientation. MuJoCo refuses it. Write the moments of the part, in kg m^2.\n    wrong: diaginertia=\"0.3 0.0103 0.0067\"\n    right: diaginertia=\"0.0103 0.0103 0.0067\"";
        MASSLESS = "CGR-MJCF-019", "mjcf::massless",
            "A body moves, but neither it nor a body that is fixed to it has mass and inertia, so MuJoCo refuses the file. Give it an <inertial> with mass and inertia, or a geom with a density.\n    wrong: <inertial mass=\"0\" .../>\n    right: <inertial mass=\"2.846\" .../>";
        GEOM = "CGR-MJCF-020", "mjcf::geom",
            "A geom has a size that is not positive, a negative mass or density, no mesh, or `fromto` with a type or with points that do not allow it. Give sizes above 0, and a mesh to a geom of the type mesh.\n    wrong: <geom type=\"sphere\" size=\"-0.05\"/>\n    right: <geom type=\"sphere\" size=\"0.05\"/>";
        ACTUATOR = "CGR-MJCF-021", "mjcf::actuator",
            "An actuator has no transmission target, an invalid range, or lacks `ctrllimited` or `forcelimited` while autolimits is off. Name the joint, and write the lower end of a range first.\n    wrong: <motor name=\"m1\"/>\n    right: <motor name=\"m1\" joint=\"elbow_joint\"/>";
        EQUALITY = "CGR-MJCF-022", "mjcf::equality",
            "An equality lacks one of its ends, has the same end twice, or couples joints that have no scalar position. Name two different ends that have a position.\n    wrong: <joint joint1=\"elbow_joint\" joint2=\"elbow_joint\"/>\n    right: <joint joint1=\"elbow_joint\" joint2=\"wrist_1_joint\"/>";
        LOOP = "CGR-MJCF-023", "mjcf::loop",
            "An equality closes a loop of bodies. The tree of bodies is read without it, so bodies of the loop may be at poses that the constraint forbids. Poses and torques are those of the tree; remove the equality if that is meant, and replace it by a linear <joint> of <equality> if one joint of the loop follows another.\n    wrong: <connect body1=\"forearm_link\" body2=\"world\" anchor=\"0 0 0\"/>\n    right: <joint joint1=\"wrist\" joint2=\"elbow\" polycoef=\"0 -1 0 0 0\"/>";
        KEYFRAME = "CGR-MJCF-024", "mjcf::keyframe",
            "A keyframe has another number of positions than the model. One position for each hinge and slide joint, four for a ball joint, seven for a free joint, in the order of the joints.\n    wrong: qpos=\"0 -1.57\"\n    right: qpos=\"0 -1.57 1.57\"";
        REPLICATE = "CGR-MJCF-025", "mjcf::replicate",
            "A <replicate> makes no copy, or an equality joins what is replicated with what is not, which MuJoCo drops. Give a count of at least 1, and write an equality for each copy.\n    wrong: <replicate count=\"0\">\n    right: <replicate count=\"4\">";
        ATTACH = "CGR-MJCF-026", "mjcf::attach",
            "An <attach> names a model, body or frame that does not exist, or attaches a part of its own model, which is not read here. Write the part out, or attach it from a file of its own.\n    wrong: <attach body=\"hand\" prefix=\"left_\"/>\n    right: <attach model=\"hand\" body=\"hand\" prefix=\"left_\"/>";
        UNSUPPORTED = "CGR-MJCF-027", "mjcf::unsupported",
            "A part of the file is not read: a scaled frame, flexible bodies, plugins, or springs by time constant. The message says which use of the robot it stops. Write that part with other elements, or do without that use.\n    wrong: <joint springdamper=\"0.1 1\" .../>\n    right: <joint stiffness=\"50\" damping=\"5\" .../>";
        TOO_LARGE = "CGR-MJCF-028", "mjcf::too_large",
            "The file describes more parts than the limit, up to which it can be processed in a reasonable time: often the count of a <replicate> is wrong. Or elements are nested deeper than in any robot. Correct the count, or split the file.\n    wrong: <replicate count=\"1000000\">\n    right: <replicate count=\"10\">";
        MESH_INERTIA = "CGR-MJCF-029", "mjcf::mesh_inertia",
            "The inertia of a mesh cannot be computed: it has no triangles, encloses no volume, or its rule of inertia is not supported. Give the body an <inertial>.\n    wrong: a flat <mesh name=\"plate\"/> as the shape of a body without <inertial>\n    right: <inertial mass=\"1.2\" .../>";
    }
}
