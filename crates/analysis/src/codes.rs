//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    targets {
        TABLE = "CGR-TABLE-029", "targets::table",
            "The file is no table of targets. Its header names the coordinates of the tool in link `base`, each with its unit, and perhaps its orientation and where the search starts in a joint.\n    x_mm,y_mm,z_mm,roll_deg,pitch_deg,yaw_deg\n    400,100,300,180,0,0";
        JSON = "CGR-TABLE-006", "targets::json",
            "The file is not a JSON array of targets.\n    [{\"translation_m\": [0.4, 0.1, 0.3]}]";
        QUATERNION_NORM = "CGR-TABLE-007", "targets::quaternion_norm",
            "The norm of the quaternion of a target is not 1, so a digit is wrong or missing. It is not silently normalised. Write it with more digits; the order is w, x, y, z.\n    wrong: \"quaternion_wxyz\": [0.7, 0.7, 0, 0]\n    right: \"quaternion_wxyz\": [0.70710678, 0.70710678, 0, 0]";
        START = "CGR-TABLE-008", "targets::start",
            "The start of the search is outside the joint limits. The search begins at the nearest position within the limits. Write angles in radians, within the limits of the joint.\n    wrong: \"start\": {\"panda_joint4\": 1.5}\n    right: \"start\": {\"panda_joint4\": -1.5}";
        TRANSLATION = "CGR-TABLE-009", "targets::translation",
            "A target is farther away than any robot reaches. The coordinates of `translation_m` are in metres.\n    wrong: \"translation_m\": [4e9, 100, 300]\n    right: \"translation_m\": [0.4, 0.1, 0.3]";
    }
    convert {
        KIND = "CGR-COMMAND-030", "convert::kind",
            "A joint is revolute in one model and prismatic in the other. A URDF joint needs limits, and an angle limit cannot become a length limit, or the reverse. Give the kind that the joint has in both, and a range to one that slides.\n    wrong: kind = \"prismatic\" without a range\n    right: kind = \"prismatic\" and range_mm = [0, 200]";
        NO_DH = "CGR-COMMAND-031", "convert::no_dh",
            "The robot has no Denavit-Hartenberg table, or its table describes another chain. Leave --base and --tip out, so that the chain is that of the table, or convert the chain of the URDF with --from urdf.\n    wrong: congruent convert robots/ur5e/ur5e.urdf --from dh --to poe\n    right: congruent convert robots/ur5e --from dh --to poe";
        NO_TABLE = "CGR-COMMAND-032", "convert::no_table",
            "No Denavit-Hartenberg table can describe this chain, such as one without a moving joint. The message names what the chain has. Choose another chain with --base and --tip, or write screws: --to poe.\n    wrong: congruent convert robots/ur5e --to standard --tip base\n    right: congruent convert robots/ur5e --to standard --tip tool0";
        TREE = "CGR-COMMAND-033", "convert::tree",
            "The converted model is not a valid robot. The message names the link or joint and the value that is impossible. Correct that value in the source, and convert again.\n    congruent lint robots/ur5e";
        UNPROVED = "CGR-COMMAND-034", "convert::unproved",
            "The converted model differs from its source by more than the limit, so it is not written. A coarser --accuracy, such as 1e-9, treats nearly parallel axes as parallel, and reports the error.\n    wrong: congruent convert arm.urdf --to standard --exact\n    right: congruent convert arm.urdf --to standard --accuracy 1e-9";
        FAR_NORMAL = "CGR-COMMAND-035", "convert::far_normal",
            "Two joint axes are nearly parallel, so their common normal is far away and a value of the table becomes very large. Write 0 if the axes are parallel.\n    wrong: rpy=\"0 0.001 0\"\n    right: rpy=\"0 0 0\"";
        ROUNDED_AXES = "CGR-COMMAND-036", "convert::rounded_axes",
            "Two joint axes are so nearly parallel, or so nearly intersecting, that they are treated as parallel or intersecting. Write 0 and quarter turns with all digits, or keep the axes with --exact.\n    wrong: rpy=\"0.000001 0 0\"\n    right: rpy=\"0 0 0\"";
        WHOLE = "CGR-COMMAND-076", "convert::whole",
            "A whole robot is written, so a chain or a table cannot be chosen. A URDF of a chain is written with --base or --tip, one of a table with --from dh.\n    wrong: congruent convert robots/ur5e --to mjcf --tip tool0\n    right: congruent convert robots/ur5e --to mjcf";
    }
    dynamics {
        AT_REST = "CGR-COMMAND-039", "dynamics::at_rest",
            "The accelerations leave out the dry friction of joints at rest, which may hold these joints in the real robot. Give speeds, or compute them by the physics.\n    congruent dynamics robots/ur5e --source simulation";
        PAYLOAD = "CGR-COMMAND-041", "dynamics::payload",
            "The mass of a payload is 0 or negative. Leave the payload out to compute without one.\n    wrong: --payload 0\n    right: --payload 1.5";
        SOURCE = "CGR-COMMAND-042", "dynamics::source",
            "The chosen --source cannot give the torques of the robot: a table without [[inertial]] has no masses, and the physics needs a mass for each moving link. Choose another --source, or add what the message names.\n    wrong: congruent dynamics arm.urdf --source simulation\n    right: congruent dynamics arm.urdf --source model";
    }
    fk {
        FRAME = "CGR-COMMAND-044", "fk::frame",
            "No frame has this name. The help has the most similar name and the known ones.\n    wrong: congruent fk robots/ur5e --from base_link --to tool1\n    right: congruent fk robots/ur5e --from base_link --to tool0";
        SOURCE = "CGR-COMMAND-045", "fk::source",
            "The chosen --source cannot give the poses of the robot: a robot without [dh] has no table, and the physics needs masses. Choose another --source, or add what the message names.\n    wrong: congruent fk robots/ur5e/ur5e.urdf --source dh\n    right: congruent fk robots/ur5e --source dh";
    }
    jacobian {
        CONFIGURATION = "CGR-COMMAND-050", "jacobian::configuration",
            "The Jacobian cannot be computed at a configuration. Correct the values of that configuration.\n    congruent lint robots/ur5e configurations.jsonl";
        LINK = "CGR-COMMAND-051", "jacobian::link",
            "No link has this name. The help has the most similar name and the known ones.\n    wrong: --link tool1\n    right: --link tool0";
        NO_TCP = "CGR-COMMAND-052", "jacobian::no_tcp",
            "The robot declares no tool centre point. Declare it under [tcp] in robot.toml, or name a link.\n    wrong: congruent jacobian robots/ur5e/ur5e.urdf --link tcp\n    right: congruent jacobian robots/ur5e --link tcp";
    }
    manipulability {
        ROBOT = "CGR-COMMAND-054", "manipulability::robot",
            "The manipulability of the chain cannot be computed, as of a chain without a moving joint. Choose a chain with a joint that moves: --base and --tip.\n    wrong: congruent manipulability robots/ur5e --tip base\n    right: congruent manipulability robots/ur5e --tip tool0";
    }
}
