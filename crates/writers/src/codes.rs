//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    write {
        VELOCITY = "CGR-WRITE-001", "write::velocity",
            "MJCF has no limits of speed, so those of the joints are not written. Keep them in robot.toml.\n    [limits]\n    elbow = { velocity_rad_s = 3.1 }";
        EFFORT = "CGR-WRITE-002", "write::effort",
            "A joint has an effort of 0, with which no actuator of MuJoCo can be limited. The joint is written without an actuator. Write the effort of the data sheet.\n    wrong: effort=\"0\"\n    right: effort=\"28\"";
        RANGE = "CGR-WRITE-003", "write::range",
            "The range of a joint cannot be written as it is: MJCF has no range of one position and none with one infinite end, URDF has no sliding joint without a range. The message says what is written. Write the range of the data sheet.\n    wrong: <limit lower=\"0\" upper=\"0\" .../>\n    right: <limit lower=\"-3.14\" upper=\"3.14\" .../>";
        MASSLESS = "CGR-WRITE-004", "write::massless",
            "MuJoCo refuses a body that moves without mass or without inertia. The link is written with 1e-12 kg or 1e-12 kg m^2, which changes no force that can be measured. Give it its real inertia before you simulate it.\n    wrong: <link name=\"wrist_3_link\"/>\n    right: <link name=\"wrist_3_link\"> with <mass value=\"0.365\"/>";
        INERTIA = "CGR-WRITE-005", "write::inertia",
            "No rigid body has this inertia: it is not positive, or its largest principal moment exceeds the sum of the other two. MuJoCo refuses it for each body alone, also where links that are fixed to each other are possible together. The nearest possible inertia is written. Correct it in the source.\n    wrong: <inertia ixx=\"0.0400\" iyy=\"0.0103\" izz=\"0.0067\" .../>\n    right: <inertia ixx=\"0.0103\" iyy=\"0.0103\" izz=\"0.0067\" .../>";
        MESH = "CGR-WRITE-006", "write::mesh",
            "A mesh cannot be named in the new file, so its shape is left out: MuJoCo reads STL and OBJ and no COLLADA, at most 200,000 triangles of an STL, and a URDF has no meshes within its own text. Convert the mesh file first.\n    wrong: <mesh filename=\"wrist3.dae\"/>\n    right: <mesh filename=\"wrist3.stl\"/>";
        NAME = "CGR-WRITE-007", "write::name",
            "A name cannot be kept. MJCF has no fixed joints, so these have no names; `world` is the name of the world alone; and a massless link between two joints becomes two joints of one body. Poses are the same. Give such a link another name if you need it.\n    wrong: <link name=\"world\"/> between two joints\n    right: <link name=\"shoulder_link\"/> between two joints";
        EXCLUDED = "CGR-WRITE-008", "write::excluded",
            "A URDF cannot exclude pairs of links from contacts. Write them into an SRDF, or keep the robot file that names one.\n    congruent clearance ROBOT --write-srdf FILE";
        COLOR = "CGR-WRITE-009", "write::color",
            "A collision shape of a URDF has no colour, so that of the source is not written.";
        DECLARED = "CGR-WRITE-010", "write::declared",
            "The robot file declares more than a URDF or an MJCF can hold: a table, a tool centre point, accelerations. This stays in the robot file. Name the new file there.\n    urdf = \"ur5e.xml\"";
        ROS_LIMIT = "CGR-WRITE-011", "write::ros_limit",
            "A limit of a joint has no largest speed or effort, because the source has none. Congruent reads such a URDF; urdfdom, the reader of ROS, refuses it. Write the values of the data sheet.\n    <limit lower=\"-1\" upper=\"1\" effort=\"40\" velocity=\"2\"/>";
        ARMATURE = "CGR-WRITE-014", "write::armature",
            "A URDF cannot state the armature of a joint, the inertia of its motor behind the gear, so forces of the new file are those without it. Keep it in the [[inertial]] entry of robot.toml, or in the scenario of a run.\n    [joints]\n    armature = { elbow = 0.1 }";
        RATES = "CGR-WRITE-015", "write::rates",
            "MJCF has no limits of acceleration, deceleration and jerk, so those of the joints are not written. Keep them in robot.toml.\n    [limits]\n    acceleration_rad_s2 = { elbow = 10 }";
        ELLIPSOID = "CGR-WRITE-016", "write::ellipsoid",
            "A URDF has boxes, cylinders, spheres and meshes, but no ellipsoids, so the shape is left out, and nothing collides in its place. Write the robot as MJCF, which has them, or add a mesh of the same form.\n    wrong: <geom type=\"ellipsoid\" size=\"0.05 0.05 0.1\"/>\n    right: <geom type=\"capsule\" size=\"0.05 0.05\"/>";
        READ_BACK = "CGR-WRITE-012", "write::read_back",
            "The written text was read again, and the robot in it is not the same, so nothing is written. A mesh that is found from the old folder and not from the new one is a usual reason. Otherwise this is a fault of Congruent: please report it with the file. Write the new file beside its source.\n    congruent convert arm/arm.urdf --to mjcf --out arm/arm.xml";
        MASS = "CGR-WRITE-013", "write::mass",
            "A mass cannot be written: the link `world` of an MJCF has none, and no body has a negative one. Attach the mass to a link behind a fixed joint if it is needed.\n    wrong: <link name=\"world\"> with <mass value=\"4\"/>\n    right: <link name=\"base_link\"> with <mass value=\"4\"/>";
    }
}
