//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    mjcf {
        ROOT = "CGR-MJCF-001", "mjcf::root" unreadable,
            "The root element is not <mujoco>, so the file is not an MJCF. MuJoCo reads a URDF, too, but here each format has its own reader.";
        INCLUDE = "CGR-MJCF-002", "mjcf::include",
            "An <include> names no file, has children, names a file that is included already, or a file without elements. MuJoCo includes each file at most once.";
        UNKNOWN_ELEMENT = "CGR-MJCF-003", "mjcf::unknown_element",
            "MJCF has no element of this name at this place, so MuJoCo refuses the file. The help has the most similar name and the known ones.";
        UNKNOWN_ATTRIBUTE = "CGR-MJCF-004", "mjcf::unknown_attribute",
            "The element has no attribute of this name, so MuJoCo refuses the file. The help has the most similar name and the known ones.\n    <body poss=\"0 0 1\"> instead of <body pos=\"0 0 1\">";
        REPEATED_ELEMENT = "CGR-MJCF-005", "mjcf::repeated_element",
            "An element is given twice where MJCF allows only one, as two <inertial> in a body. Keep one.";
        MISSING_ATTRIBUTE = "CGR-MJCF-006", "mjcf::missing_attribute",
            "A required attribute is missing. The message names it and its element.";
        NUMBER = "CGR-MJCF-007", "mjcf::number",
            "A value is not a finite number, or has too few or too many numbers. Numbers are separated by spaces; decimal commas and units are not allowed.\n    pos=\"0 0.4\" instead of pos=\"0 0.4 0\"";
        KEYWORD = "CGR-MJCF-008", "mjcf::keyword",
            "The attribute takes one of several words; this value is none of them. The help lists the known words.";
        PLACEMENT = "CGR-MJCF-009", "mjcf::placement",
            "An element or attribute is at a place where MuJoCo refuses it: a joint or an inertial in <worldbody> or directly in <replicate>, or an attribute of <worldbody>.";
        NAME = "CGR-MJCF-010", "mjcf::name",
            "Two elements of one kind share a name, so a reference to it has two meanings, or a name has an invisible character. Rename one of them. A body is called world already: the world itself.";
        UNKNOWN_NAME = "CGR-MJCF-011", "mjcf::unknown_name",
            "An element refers to a joint, body, mesh or other element that the file does not have. The help has the most similar name and the known ones.";
        CLASS = "CGR-MJCF-012", "mjcf::class",
            "A class of defaults is not declared, is declared twice, or has no name; or the class at the top of a second <default> section has another name than main.";
        ORIENTATION = "CGR-MJCF-013", "mjcf::orientation",
            "An orientation is given by two attributes, or by a quaternion, an axis or a direction of length 0. Keep exactly one of quat, axisangle, euler, xyaxes and zaxis.";
        COMPILER = "CGR-MJCF-014", "mjcf::compiler",
            "A setting of <compiler> cannot be used: global coordinates were removed from MuJoCo, or `eulerseq` is not three of the letters x y z X Y Z.";
        JOINT = "CGR-MJCF-015", "mjcf::joint",
            "MuJoCo refuses this combination of joints: a free joint beside other joints or in a body that is no child of the world, more than six degrees of freedom in a body, or a ball joint followed by a rotation. Or an armature is negative, with which a joint may have no inertia: torques need it to be 0 or more.";
        AXIS = "CGR-MJCF-016", "mjcf::axis",
            "The axis of a joint has the length 0, so it has no direction. Write a direction; its length does not matter.\n    axis=\"0 0 1\"";
        RANGE = "CGR-MJCF-017", "mjcf::range",
            "A range is missing, in the wrong order, or lacks `limited` while autolimits is off. As a warning: MuJoCo ignores a range whose lower end is not below its upper end, so the joint has no limits.";
        INERTIAL = "CGR-MJCF-018", "mjcf::inertial",
            "No rigid body has this inertia, or it is given twice: a moment exceeds the sum of the other two, is not positive, or `fullinertia` is beside `diaginertia` or an orientation. MuJoCo refuses it.";
        MASSLESS = "CGR-MJCF-019", "mjcf::massless",
            "A body moves, but neither it nor a body that is fixed to it has mass and inertia, so MuJoCo refuses the file. Give it an <inertial> with mass and inertia, or a geom with a density.";
        GEOM = "CGR-MJCF-020", "mjcf::geom",
            "A geom has a size that is not positive, a negative mass or density, no mesh, or `fromto` with a type or with points that do not allow it.";
        ACTUATOR = "CGR-MJCF-021", "mjcf::actuator",
            "An actuator has no transmission target, an invalid range, or lacks `ctrllimited` or `forcelimited` while autolimits is off.";
        EQUALITY = "CGR-MJCF-022", "mjcf::equality",
            "An equality lacks one of its ends, has the same end twice, or couples joints that have no scalar position.";
        LOOP = "CGR-MJCF-023", "mjcf::loop",
            "An equality closes a loop of bodies. The tree of bodies is read without it, so bodies of the loop may be at poses that the constraint forbids. Poses and torques are those of the tree; remove the equality if that is meant, and replace it by a linear <joint> of <equality> if one joint of the loop follows another.";
        KEYFRAME = "CGR-MJCF-024", "mjcf::keyframe",
            "A keyframe has another number of positions than the model. One position for each hinge and slide joint, four for a ball joint, seven for a free joint, in the order of the joints.";
        REPLICATE = "CGR-MJCF-025", "mjcf::replicate",
            "A <replicate> makes no copy, or an equality joins what is replicated with what is not, which MuJoCo drops.";
        ATTACH = "CGR-MJCF-026", "mjcf::attach",
            "An <attach> names a model, body or frame that does not exist, or attaches a part of its own model, which is not read here. Write the part out, or attach it from a file of its own.";
        UNSUPPORTED = "CGR-MJCF-027", "mjcf::unsupported",
            "A part of the file is not read: a scaled frame, flexible bodies, plugins, or springs by time constant. The message says which use of the robot it stops.";
        TOO_LARGE = "CGR-MJCF-028", "mjcf::too_large",
            "The file describes more parts than the limit, up to which it can be processed in a reasonable time: often the count of a <replicate> is wrong. Or elements are nested deeper than in any robot.";
        MESH_INERTIA = "CGR-MJCF-029", "mjcf::mesh_inertia",
            "The inertia of a mesh cannot be computed: it has no triangles, encloses no volume, or its rule of inertia is not supported. Give the body an <inertial>.";
    }
}
