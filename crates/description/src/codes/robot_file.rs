//! Findings about a robot file, its chain and its tolerances.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "ROBOT",
    codes: &[
        (1, "robot_file::urdf", "The robot file does not name its URDF.\n    urdf = \"robot.urdf\""),
        (2, "robot_file::package", "A folder under `packages` does not exist."),
        (3, "robot_file::unknown_link", "`base` or `tip` names a link that the robot does not have."),
        (
            4,
            "robot_file::unknown_joint",
            "A row, a body or a limit names a joint that the robot does not have, that does not move, or that is not between base and tip.",
        ),
        (
            5,
            "robot_file::chain",
            "The tip does not hang below the base, so that there is no chain of joints between them.",
        ),
        (
            6,
            "robot_file::convention",
            "The table does not say its convention. The same values in the other convention are another robot, so there is no default.\n    convention = \"standard\"",
        ),
        (7, "robot_file::missing_figure", "A row of the table lacks a, alpha or d."),
        (8, "robot_file::missing_row", "The table has no row for a joint that moves the tip."),
        (9, "robot_file::joint_twice", "Two rows, or two bodies, are of the same joint."),
        (10, "robot_file::sign", "The sign of a row is 1 or -1."),
        (11, "robot_file::row_kind", "A row is revolute and its joint in the URDF slides, or the reverse."),
        (
            12,
            "robot_file::row_order",
            "Rows stand in another order than their joints in the chain. The order of the rows is the order of the transforms.",
        ),
        (
            13,
            "robot_file::inertia",
            "An entry of [inertia] repairs nothing: its link is unknown, has no inertia, or has one that needs no repair. It also tells what a repair has changed.",
        ),
        (
            14,
            "robot_file::inertial",
            "An entry of [[inertial]] lacks a value, has one that no body has, or names a frame that its body does not have.",
        ),
        (
            15,
            "robot_file::limits",
            "An entry of [limits] has the wrong unit for its joint, is given twice, or is not positive.",
        ),
        (16, "robot_file::tolerance", "A tolerance is not above 0."),
        (
            17,
            "robot_file::tcp_name",
            "A link of the URDF is called as the declared tool centre point usually is. The declared one gets another name.",
        ),
        (
            18,
            "tolerance::meaningless",
            "A tolerance is above the reach of the arm, or above half a turn: it tells no pose from another. Often the minus of an exponent is missing.",
        ),
        (
            19,
            "tolerance::wide",
            "A tolerance is more than a tenth of the reach of the arm, or of half a turn.",
        ),
        (
            20,
            "chain::broken",
            "The tip does not hang below the base, so that there is no chain of joints between them.",
        ),
        (21, "chain::unknown_link", "--base or --tip names a link that the robot does not have."),
        (
            22,
            "chain::several_tips",
            "No file says where the chain ends, and several ends are as good. Name it in a robot file.\n    tip = \"tool0\"",
        ),
        (
            23,
            "chain::table_dropped",
            "The table is of another chain than the one that was asked for, so it is not used.",
        ),
        (24, "simulation::robot", "The physics cannot be built of this robot; the message has the reason."),
        (
            25,
            "lint::ignore",
            "An entry of [[lint.ignore]] is wrong: its code is unknown, it gives no reason, or what it ignores is an error.",
        ),
        (
            26,
            "lint::ignored_nothing",
            "An entry of [[lint.ignore]] ignores nothing: what it is about does not occur. Remove it, so that it hides nothing later.",
        ),
    ],
}];
