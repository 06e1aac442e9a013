//! Findings about a robot file, its chain and its tolerances.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "ROBOT",
    codes: &[
        (1, "robot_file::urdf", "The robot file does not name its URDF.\n    urdf = \"robot.urdf\""),
        (
            2,
            "robot_file::package",
            "A folder under `packages` does not exist. Meshes named by package://NAME/... are looked for there. Correct the path of the folder.",
        ),
        (
            3,
            "robot_file::unknown_link",
            "`base` or `tip` names a link that the robot does not have. The help has the most similar name and the known ones.",
        ),
        (
            4,
            "robot_file::unknown_joint",
            "A row, an [[inertial]] entry or a limit names a joint that the robot does not have, that does not move, or that is not between base and tip. Correct the name; the help has the known ones.",
        ),
        (
            5,
            "robot_file::chain",
            "The tip is not a descendant of the base, so no chain of joints connects them. Name a base from which joints lead down to the tip.",
        ),
        (
            6,
            "robot_file::convention",
            "The table lacks its convention. The same values describe another robot in the other convention, so there is no default.\n    convention = \"standard\"",
        ),
        (
            7,
            "robot_file::missing_figure",
            "A row of the table lacks a, alpha or d. A missing value is not taken as 0, because it may have been forgotten. If it is 0, write 0.\n    d_mm = 0",
        ),
        (
            8,
            "robot_file::missing_row",
            "The table has no row for a joint that moves the tip. Without it the table describes another robot. The message names the missing joints.",
        ),
        (
            9,
            "robot_file::joint_twice",
            "Two rows, or two [[inertial]] entries, name the same joint. Only one of the two could apply. Remove one.",
        ),
        (10, "robot_file::sign", "The sign of a row must be 1 or -1."),
        (
            11,
            "robot_file::row_kind",
            "A row is revolute but its joint in the URDF is prismatic, or the reverse. Such a table cannot describe this joint. Correct the kind of the row, or the name of its joint.",
        ),
        (
            12,
            "robot_file::row_order",
            "The rows are in another order than the joints of the chain. The transforms are multiplied in the order of the rows. Put the rows into the order of the joints from base to tip.",
        ),
        (
            13,
            "robot_file::inertia",
            "An entry of [inertia] repairs nothing, because its link is unknown, has no inertia, or needs no repair. As a warning: what a repair has changed.",
        ),
        (
            14,
            "robot_file::inertial",
            "An entry of [[inertial]] lacks a value, has a value that no rigid body can have, or names a frame that does not belong to its joint.",
        ),
        (
            15,
            "robot_file::limits",
            "An entry of [limits] has the wrong unit for its joint, is given twice, or is not positive.",
        ),
        (
            16,
            "robot_file::tolerance",
            "A tolerance must be greater than 0. With a tolerance of 0, rounding alone would be a disagreement.",
        ),
        (
            17,
            "robot_file::tcp_name",
            "A link of the URDF is called `tcp`, as the declared tool centre point usually is. The declared one is called `declared_tcp`.",
        ),
        (
            18,
            "tolerance::meaningless",
            "A tolerance exceeds the reach of the arm, or half a turn, so that every pose would agree. Often the minus sign of an exponent is missing. Give far less than a tenth of the reach.",
        ),
        (
            19,
            "tolerance::wide",
            "A tolerance exceeds a tenth of the reach of the arm, or of half a turn. Then real faults agree. Give at most a tenth, unless such a wide tolerance is intended.",
        ),
        (
            20,
            "chain::broken",
            "The tip is not a descendant of the base, so no chain of joints connects them. Name a base from which joints lead down to the tip.",
        ),
        (
            21,
            "chain::unknown_link",
            "--base or --tip names a link that the robot does not have. The help has the most similar name and the known ones.",
        ),
        (
            22,
            "chain::several_tips",
            "No file names the tip of the chain, and several chains are about equally long. Name the tip in a robot file.\n    tip = \"tool0\"",
        ),
        (
            23,
            "chain::table_dropped",
            "The table describes another chain than the requested one, so it is not used. Leave --base and --tip out to use the table.",
        ),
        (24, "simulation::robot", "The physics of this robot cannot be built; the message has the reason."),
        (
            25,
            "lint::ignore",
            "An entry of [[lint.ignore]] is wrong: its code is unknown, it gives no reason, or it would ignore an error.",
        ),
        (
            26,
            "lint::ignored_nothing",
            "An entry of [[lint.ignore]] ignores nothing, because no finding matches it. Remove it, so that it does not hide a finding later.",
        ),
    ],
}];
