//! The codes of the messages of this crate, with what `congruent explain` says about them.

use congruent_input::Code;

congruent_input::codes! {
    lint {
        NO_ROBOT = "CGR-FILE-017", "lint::no_robot" unreadable,
            "The robot of an SRDF or of a table is not known, so the names in the file are not checked. Give both files in one call, or lint the robot file that names the SRDF.\n    congruent lint robot.toml configurations.json";
    }
    measurements {
        OUTSIDE_LIMITS = "CGR-TABLE-024", "measurements::outside_limits",
            "The joint positions of a measurement are outside the joint limits. Often the unit is wrong: the ending of a column's name is its unit. Correct the unit.\n    wrong: joint_1_rad\n    right: joint_1_deg";
    }
    units {
        MEASURED_POINT = "CGR-TABLE-025", "units::measured_point",
            "A measured point is farther from the other points than the robot can reach. Often its unit is wrong. Correct the unit in the header.\n    wrong: x_m,y_m,z_m with values such as 259.8\n    right: x_mm,y_mm,z_mm";
        TARGET = "CGR-TABLE-026", "units::target",
            "A target is far beyond the reach of the robot. Often its unit is wrong. Write metres.\n    wrong: \"translation_m\": [400, 100, 300]\n    right: \"translation_m\": [0.4, 0.1, 0.3]";
    }
}

/// The codes of the messages that a file can cause: those of this crate and of all crates that read files. A robot file may ignore
/// one of them.
pub fn known_codes() -> Vec<&'static Code> {
    [
        congruent_analysis::codes::ALL,
        congruent_calibration::codes::ALL,
        congruent_configurations::codes::ALL,
        congruent_description::codes::ALL,
        congruent_input::codes::ALL,
        congruent_lint::codes::ALL,
        congruent_meshes::codes::ALL,
        congruent_mjcf::codes::ALL,
        congruent_monitors::codes::ALL,
        congruent_motion::codes::ALL,
        congruent_proximity::codes::ALL,
        congruent_scenario::codes::ALL,
        congruent_tables::codes::ALL,
        congruent_twin::codes::ALL,
        congruent_writers::codes::ALL,
        ALL,
    ]
    .concat()
}
