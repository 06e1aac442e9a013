//! The codes of the messages of this crate, with what `congruent explain` says about them, and the list of all codes of the library.

use congruent_input::Code;

congruent_input::codes! {
    simulation {
        ROBOT = "CGR-ROBOT-024", "simulation::robot",
            "The physics of this robot cannot be built. The message names the link, joint or shape that stops it. Correct that value in the URDF; kinematics do not need it, and `check` compares poses without the physics.\n    congruent lint robots/ur5e";
    }
    check {
        ROBOT = "CGR-COMMAND-026", "check::robot",
            "The robot cannot be checked. The message names the joint or value that stops it, such as a chain without a moving joint. Correct it, or choose another chain with --base and --tip.\n    congruent check robots/ur5e --base base_link --tip tool0";
        DECLARED_MAPPING = "CGR-COMMAND-079", "check::declared_mapping",
            "[mapping] of the robot file does not fit the other description: it names a joint there that does not move or does not exist, pairs a joint that turns with one that slides, means one joint twice, or has a joint in left_out that neither file has.\n    [mapping]\n    left_out = [\"finger_joint\"]\n    [mapping.joints]\n    elbow = \"A3\"";
        DECLARED_DYNAMICS = "CGR-COMMAND-027", "check::declared_dynamics",
            "The masses and inertias that the robot file declares cannot be compared with those of the URDF. The message names the entry that stops it. Correct the [[inertial]] entry of that joint, or remove all of them to compare poses alone.\n    wrong: a [dynamics] section with source = \"UR5e\" alone\n    right: gravity_m_s2 = [0, 0, -9.81] in that section";
        SIMULATED_DYNAMICS = "CGR-COMMAND-028", "check::simulated_dynamics",
            "The inertial parameters of the physics cannot be identified from its torques. The message names what stops it, such as a joint that does not move or a torque that is not finite. Correct the mass or the limit that it names.\n    wrong: <dynamics damping=\"1000\"/>\n    right: <dynamics damping=\"0.1\"/>";
        OTHER_DYNAMICS = "CGR-COMMAND-069", "check::other_dynamics",
            "The dynamics of the two descriptions cannot be compared, as of two in which no joint moves. The message has the reason. Let a joint move, or choose another chain with --base and --tip; poses are compared without it.\n    wrong: <joint name=\"elbow_joint\" type=\"fixed\">\n    right: <joint name=\"elbow_joint\" type=\"revolute\">";
        MAPPING = "CGR-COMMAND-074", "check::mapping",
            "Joints have another name, direction or zero in the other description, or move in one of the two alone, and the robot file does not declare it. What is compared is compared in the variables of the first. The help has the lines to declare it.\n    [mapping.joints]\n    elbow = { joint = \"A3\", sign = -1, offset_deg = 90 }";
        NO_SECOND_SOURCE = "CGR-COMMAND-071", "check::no_second_source",
            "Geometry or dynamics is stated by one description alone, so the check says nothing about whether it is right: the physics is built from the same file. A [dh] table or [[inertial]] entries in robot.toml, or a second file, give something to compare it with.\n    congruent check arm.urdf --against other.urdf";
    }
    run {
        CANNOT_RUN = "CGR-COMMAND-010", "run::cannot_run",
            "The scenario cannot be run: its robot cannot be simulated, or a motion cannot be planned. The message names the value; correct it there. `congruent check ROBOT` shows what the robot lacks.\n    congruent check robots/ur5e";
    }
    watch {
        EMPTY = "CGR-COMMAND-094", "watch::empty",
            "The stream ended before its first message, so that there is nothing to judge. Look at what writes it: each message is one line.\n    {\"time_s\": 1.25, \"q\": {\"elbow_joint\": 0.4}}";
        SOURCE = "CGR-COMMAND-095", "watch::source",
            "The scenario of a stream has no [source], so that it is one of a simulation. Add [source] with any `log`, which the stream replaces, and remove [controller] and [[motion]].\n    [source]\n    log = \"stream\"";
    }
    python {
        ARRAY = "CGR-PYTHON-001", "python::array",
            "An array that Python code gives has a wrong shape, or a value that is not a finite number. Positions are (joints,) for one configuration and (n, joints) for many, in the order of `robot.joints`, or a dictionary by the names of joints.\n    robot.fk({\"elbow_joint\": 0.1})";
        TARGET = "CGR-PYTHON-002", "python::target",
            "A target of inverse kinematics is no pose, or the frame cannot be moved. A pose is a homogeneous matrix with an orthonormal rotation and a position in m; a position alone has three numbers.\n    robot.ik([0.4, 0.1, 0.3])";
        XACRO = "CGR-PYTHON-003", "python::xacro",
            "A xacro file cannot be expanded. The message is that of xacro, or says that it is not installed.\n    pip install xacro";
        ENGINE = "CGR-PYTHON-004", "python::engine",
            "What an engine has loaded cannot be compared: it is not installed, it has no such robot, or it computes something else than what was read from it. The message has the numbers.\n    pip install mujoco\n    congruent.check(\"arm.urdf\", engine=congruent.engines.mujoco(model))";
        POSES = "CGR-PYTHON-005", "python::poses",
            "A function gives no poses that can be compared: it raises an exception, or returns something else than a homogeneous matrix, or its joints do not turn or shift about fixed axes. The message has q and the value.\n    congruent.check(\"arm.urdf\", poses=lambda q: my_fk(q), joints=[\"joint_1\", \"joint_2\"])";
        SPATIAL = "CGR-PYTHON-006", "python::spatial",
            "A matrix is no rotation or no transform, a set of Euler angles or a convention is not known, or a transform is no row of a table. The message has the deviation.\n    congruent.spatial.dh_row_from_transform(transform, \"modified\")";
    }
    dynamics {
        OVERFLOW = "CGR-COMMAND-040", "dynamics::overflow",
            "A mass, inertia, speed or torque is so large that the computed torques exceed the range of 64-bit numbers. The message names the largest value; often its exponent is wrong. Correct that value.\n    wrong: <inertia ixx=\"1e308\" .../>\n    right: <inertia ixx=\"0.134\" .../>";
    }
}

/// The codes of all messages of the library, those of the crates of the workspace among them.
pub fn all_codes() -> Vec<&'static Code> {
    let mut codes = congruent_lint_report::codes::known_codes();
    codes.extend(congruent_logs::codes::ALL);
    codes.extend(congruent_replay::codes::ALL);
    codes.extend(congruent_sweep::codes::ALL);
    codes.extend(congruent_starter::codes::ALL);
    codes.extend(congruent_tolerances::codes::ALL);
    codes.extend(ALL);
    codes
}
