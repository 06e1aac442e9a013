//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    write {
        VELOCITY = "CGR-WRITE-001", "write::velocity",
            "MJCF has no limits of speed, so those of the joints are not written. Keep them in robot.toml.\n    [limits]\n    elbow = { velocity_rad_s = 3.1 }";
        EFFORT = "CGR-WRITE-002", "write::effort",
            "A joint has an effort of 0, with which no actuator of MuJoCo can be limited. The joint is written without an actuator.";
        RANGE = "CGR-WRITE-003", "write::range",
            "The range of a joint cannot be written as it is: MJCF has no range of one position and none with one infinite end, URDF has no sliding joint without a range. The message says what is written.";
        MASSLESS = "CGR-WRITE-004", "write::massless",
            "MuJoCo refuses a body that moves without mass or without inertia. The link is written with 1e-12 kg or 1e-12 kg m^2, which changes no force that can be measured. Give it its real inertia before you simulate it.";
        INERTIA = "CGR-WRITE-005", "write::inertia",
            "No rigid body has this inertia: it is not positive, or its largest principal moment exceeds the sum of the other two. MuJoCo refuses it for each body alone, also where links that are fixed to each other are possible together. The nearest possible inertia is written.";
        MESH = "CGR-WRITE-006", "write::mesh",
            "A mesh cannot be named in the new file, so its shape is left out: MuJoCo reads STL and OBJ and no COLLADA, at most 200,000 triangles of an STL, and a URDF has no meshes within its own text. Convert the mesh file first.";
        NAME = "CGR-WRITE-007", "write::name",
            "A name cannot be kept. MJCF has no fixed joints, so these have no names; `world` is the name of the world alone; and a massless link between two joints becomes two joints of one body. Poses are the same.";
        EXCLUDED = "CGR-WRITE-008", "write::excluded",
            "A URDF cannot exclude pairs of links from contacts. Write them into an SRDF, or keep the robot file that names one.\n    congruent clearance ROBOT --write-srdf FILE";
        COLOR = "CGR-WRITE-009", "write::color",
            "A collision shape of a URDF has no colour, so that of the source is not written.";
        DECLARED = "CGR-WRITE-010", "write::declared",
            "The robot file declares more than a URDF or an MJCF can hold: a table, a tool centre point, accelerations. This stays in the robot file.";
        ROS_LIMIT = "CGR-WRITE-011", "write::ros_limit",
            "A limit of a joint has no largest speed or effort, because the source has none. Congruent reads such a URDF; urdfdom, the reader of ROS, refuses it. Write the values of the data sheet.\n    <limit lower=\"-1\" upper=\"1\" effort=\"40\" velocity=\"2\"/>";
        ARMATURE = "CGR-WRITE-014", "write::armature",
            "A URDF cannot state the armature of a joint, the inertia of its motor behind the gear, so forces of the new file are those without it. Keep it in the [[inertial]] entry of robot.toml, or in the scenario of a run.\n    [joints]\n    armature = { elbow = 0.1 }";
        RATES = "CGR-WRITE-015", "write::rates",
            "MJCF has no limits of acceleration, deceleration and jerk, so those of the joints are not written. Keep them in robot.toml.\n    [limits]\n    acceleration_rad_s2 = { elbow = 10 }";
        ELLIPSOID = "CGR-WRITE-016", "write::ellipsoid",
            "A URDF has boxes, cylinders, spheres and meshes, but no ellipsoids, so the shape is left out, and nothing collides in its place. Write the robot as MJCF, which has them, or add a mesh of the same form.";
        READ_BACK = "CGR-WRITE-012", "write::read_back",
            "The written text was read again, and the robot in it is not the same, so nothing is written. A mesh that is found from the old folder and not from the new one is a usual reason. Otherwise this is a fault of Congruent: please report it with the file.";
        MASS = "CGR-WRITE-013", "write::mass",
            "A mass cannot be written: the link `world` of an MJCF has none, and no body has a negative one.";
    }
}
