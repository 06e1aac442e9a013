//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    new {
        AGREEMENT = "CGR-COMMAND-055", "new::agreement",
            "The analytical model and the physics disagree at the same configuration, so no scenario could pass. Run `congruent check`, which says why, and correct the robot first.\n    wrong: d_m = 0.1633\n    right: d_m = 0.1333";
        NO_JOINT = "CGR-COMMAND-056", "new::no_joint",
            "No joint moves, so there is nothing to run. Choose base and tip in the robot file so that a joint between them moves.\n    wrong: type=\"fixed\" for each joint\n    right: type=\"continuous\" for one that moves";
        RUN = "CGR-COMMAND-059", "new::run",
            "The scenario that `new scenario` has made ends with an error when it is run, and is not written. The message has that error. `congruent check` of the robot shows whether its masses and limits are sound; give the robot those that it lacks.\n    congruent check robots/arm";
        SCENARIO = "CGR-COMMAND-060", "new::scenario",
            "`new scenario` cannot write the file: every motion that it tried fails a check, the robot came from standard input, or the name under --out does not end in .toml.\n    wrong: congruent new scenario robots/ur5e --to first.yaml\n    right: congruent new scenario robots/ur5e --to first.toml";
        SHAPE = "CGR-COMMAND-061", "new::shape",
            "No check of distances can be written, or the check ignores some pairs. Write the pairs that may touch into an SRDF, and name it in robot.toml.\n    congruent clearance robots/arm --write-srdf arm.srdf";
    }
}
