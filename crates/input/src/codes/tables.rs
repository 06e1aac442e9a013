//! Findings about files of configurations, measurements and targets.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "TABLE",
    codes: &[
        (
            1,
            "configurations::json",
            "The file is not a list of configurations: one on each line (JSON Lines), or a JSON array of at most 100,000.\n    {\"q\": {\"elbow_joint\": 0.1}}\n    {\"q\": {\"elbow_joint\": 0.2}}",
        ),
        (
            2,
            "configurations::none",
            "The list of configurations is empty. One configuration with all joints at 0 is:\n    [{\"q\": {}}]",
        ),
        (
            3,
            "configurations::unknown_joint",
            "A configuration names a joint that the robot does not have or that does not move. The help has the most similar name and the known ones.",
        ),
        (
            4,
            "configurations::mimic",
            "A mimic joint is given at a position that contradicts the position of the joint it mimics. Leave mimic joints out: their positions follow from the mimicked joints.",
        ),
        (
            5,
            "configurations::outside_limits",
            "A configuration is outside the joint limits. The result is computed, but the robot cannot reach this pose.",
        ),
        (
            6,
            "targets::json",
            "The file is not a JSON array of targets.\n    [{\"translation_m\": [0.4, 0.1, 0.3]}]",
        ),
        (
            7,
            "targets::quaternion_norm",
            "The norm of the quaternion of a target is not 1, so a digit is wrong or missing. It is not silently normalised. Write it with more digits; the order is w, x, y, z.",
        ),
        (
            8,
            "targets::start",
            "The start of the search is outside the joint limits. The search begins at the nearest position within the limits.",
        ),
        (
            9,
            "targets::translation",
            "A target is farther away than any robot reaches. The coordinates of `translation_m` are in metres.",
        ),
        (
            11,
            "measurements::json",
            "The file is not a JSON array of measurements. An entry has the joints and what was measured.\n    [{\"q\": {\"elbow_joint\": 0.1}, \"translation_m\": [0.5, 0, 0.3]}]",
        ),
        (12, "measurements::none", "The file has no measurement, so there is nothing to fit."),
        (
            13,
            "measurements::nothing_measured",
            "No column gives a measured position or orientation. Then there is nothing to compare with the model. Add the measured position, and the orientation if it was measured.",
        ),
        (
            14,
            "measurements::unknown_column",
            "A column is neither a joint nor a measured quantity. Often the columns are separated by semicolons or tabs. Separate them with commas, and write decimals with a point.",
        ),
        (
            15,
            "measurements::repeated_column",
            "Two columns give the same quantity. The two may contradict each other. Remove one.",
        ),
        (
            16,
            "measurements::repeated",
            "A measurement gives the same quantity by two keys. The two may contradict each other. Keep one of the keys.",
        ),
        (
            17,
            "measurements::missing_joint",
            "A joint of the chain has no column, so its position is unknown. Each joint of the chain needs its position in each measurement. Add the column.",
        ),
        (
            18,
            "measurements::unit",
            "The name of a column lacks a unit, or has a unit that does not fit its joint.\n    elbow_joint_deg",
        ),
        (
            19,
            "measurements::cells",
            "A line has another number of cells than the header, so a value is missing or added, and the values after it would be read as other quantities.",
        ),
        (
            20,
            "measurements::empty_cell",
            "A cell of a joint is empty. A missing position is not taken as 0. Write the position, or remove the line.",
        ),
        (
            21,
            "measurements::number",
            "A cell is not a finite number. Write decimals with a point. NaN and words for missing values are not numbers.",
        ),
        (
            22,
            "measurements::translation",
            "A measured position does not have two or three coordinates, or a coordinate is not a distance. Give x, y and z, or x and y for a planar measurement.",
        ),
        (
            23,
            "measurements::orientation",
            "A measured orientation is incomplete, is given twice, or is not a rotation. Give a quaternion of norm 1, or roll, pitch and yaw, not both.",
        ),
        (
            24,
            "measurements::outside_limits",
            "The joint positions of a measurement are outside the joint limits. Often the unit is wrong: the ending of a column's name is its unit.",
        ),
        (
            25,
            "units::measured_point",
            "A measured point is farther from the other points than the robot can reach. Often its unit is wrong.",
        ),
        (26, "units::target", "A target is far beyond the reach of the robot. Often its unit is wrong."),
        (
            27,
            "table::parquet",
            "The file is named `.parquet`, but is not a Parquet table. The message has the reason. A file of a run that was killed has no end and cannot be read.",
        ),
    ],
}];
