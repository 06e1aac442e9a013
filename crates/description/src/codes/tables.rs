//! Findings about files of configurations, measurements and targets.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "TABLE",
    codes: &[
        (
            1,
            "configurations::json",
            "The file is no JSON array of configurations.\n    [{\"q\": {\"elbow_joint\": 0.1}}]",
        ),
        (2, "configurations::none", "The list of configurations is empty."),
        (
            3,
            "configurations::unknown_joint",
            "A configuration names a joint that the robot does not have or that does not move.",
        ),
        (4, "configurations::mimic", "A mimic joint is given at another position than its master implies."),
        (
            5,
            "configurations::outside_limits",
            "A configuration is outside of the joint limits. The result is computed all the same, for a pose that the robot cannot take.",
        ),
        (
            6,
            "targets::json",
            "The file is no JSON array of targets.\n    [{\"translation_m\": [0.4, 0.1, 0.3]}]",
        ),
        (
            7,
            "targets::quaternion_norm",
            "The quaternion of a target is not of norm 1, so some digit of it is wrong or missing.",
        ),
        (8, "targets::start", "The start of the search is outside of the joint limits."),
        (9, "targets::translation", "A target is farther away than any robot reaches."),
        (10, "measurements::csv", "The file is no table in CSV."),
        (11, "measurements::json", "The file is no JSON array of measurements."),
        (12, "measurements::none", "The file has no measurement."),
        (
            13,
            "measurements::nothing_measured",
            "No column gives a position or an orientation that was measured.",
        ),
        (14, "measurements::unknown_column", "A column is no joint and no measured quantity."),
        (15, "measurements::repeated_column", "Two columns give the same quantity."),
        (16, "measurements::repeated", "A measurement gives the same quantity under two keys."),
        (
            17,
            "measurements::missing_joint",
            "A joint of the chain has no column, so that its position is unknown.",
        ),
        (
            18,
            "measurements::unit",
            "A column does not say its unit, or has one that its joint does not have.\n    elbow_joint_deg",
        ),
        (19, "measurements::cells", "A line has more or fewer cells than the header."),
        (20, "measurements::empty_cell", "A cell of a joint is empty."),
        (21, "measurements::number", "A cell is no finite number."),
        (
            22,
            "measurements::translation",
            "A measured position has not two or three coordinates, or one that is no distance.",
        ),
        (
            23,
            "measurements::orientation",
            "A measured orientation is incomplete, given twice, or no rotation.",
        ),
        (
            24,
            "measurements::outside_limits",
            "A measurement was made at a position that the joint cannot take.",
        ),
        (25, "units::measured_point", "A measured point is farther from the others than the robot reaches."),
        (26, "units::target", "A target is far beyond the reach of the robot."),
    ],
}];
