//! Findings about arguments of commands, and about what they write.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "COMMAND",
    codes: &[
        (
            1,
            "cli::at",
            "--at is not of the form JOINT=VALUE, or a joint is given twice.\n    --at elbow_joint=90deg",
        ),
        (
            2,
            "cli::hidden_character",
            "An argument has a control character or a line break. Terminals do not show it, and it would be copied into the outputs. Type the argument again.",
        ),
        (
            3,
            "cli::noise",
            "Only one of the two noises of a measurement (--noise-mm and --noise-deg) is given. Give both or neither.",
        ),
        (
            4,
            "cli::set",
            "--set is not of the form KEY=VALUE with a key of the scenario.\n    --set controller.stiffness=500",
        ),
        (
            5,
            "cli::value",
            "The option takes a positive number, and another value was given. The message names the option and the value.",
        ),
        (
            6,
            "cli::velocities",
            "The result needs joint velocities, which are read from a file of configurations (key `v`), and no such file was given.",
        ),
        (7, "cli::format", "SARIF output is available from `lint` only."),
        (
            8,
            "lint::code",
            "The word after --explain is no code of a finding. The help names the most similar code.",
        ),
        (10, "run::cannot_run", "The scenario cannot be run; the message has the reason."),
        (
            11,
            "run::output",
            "A result cannot be written to its file. For example its folder is in use by another run, or may not be written. Give another folder or file.",
        ),
        (
            12,
            "run::same_output",
            "Two scenarios would write their results to the same folder, and one would overwrite the results of the other. Give the scenarios different names.",
        ),
        (
            13,
            "run::view",
            "--view shows one run, but several scenarios are given. Give one scenario, or leave --view out.",
        ),
        (
            14,
            "output::refused",
            "The path of an output is a file that the command reads, or an existing file of another kind. It is not overwritten. Choose another name, or remove the file.",
        ),
        (
            15,
            "output::unwritable",
            "A file cannot be written. Choose a file in a folder that exists and can be written.",
        ),
        (
            16,
            "output::name",
            "The name of an output file has the wrong extension. The name of a robot file must end in .toml.",
        ),
        (
            17,
            "output::urdf",
            "The URDF came from standard input, so the written file could not refer to it by a path. Give the URDF as a file.",
        ),
        (
            18,
            "acm::shape",
            "Distances cannot be computed for a shape of the robot; the message has the reason.",
        ),
        (
            19,
            "clearance::shape",
            "Distances cannot be computed for a shape of the robot; the message has the reason.",
        ),
        (
            20,
            "calibrate::robot",
            "No joint moves the tip relative to the base, so there is nothing to calibrate. Choose base and tip so that a joint between them moves.",
        ),
        (
            21,
            "calibrate::no_table",
            "Corrections of table entries were requested, but the robot has no Denavit-Hartenberg table. Free zero-offsets, axes, base or tool instead.",
        ),
        (
            22,
            "calibrate::nothing_free",
            "No correction is free, so there is nothing to fit. Free a group or a single correction with --free; the help lists the groups.",
        ),
        (
            23,
            "calibrate::unknown_correction",
            "--free names neither a group of corrections nor a single correction. The help has the most similar name and the known ones.",
        ),
        (
            24,
            "calibrate::next",
            "More configurations were requested than there are candidates to choose from. Ask for fewer; the help names the number of candidates.",
        ),
        (
            25,
            "check::plot",
            "--plot shows errors at configurations, but no configurations are given. Give --configurations FILE.",
        ),
        (26, "check::robot", "The robot cannot be checked; the message has the reason."),
        (
            27,
            "check::declared_dynamics",
            "The declared dynamics cannot be compared; the message has the reason.",
        ),
        (
            28,
            "check::simulated_dynamics",
            "The dynamics of the physics cannot be identified; the message has the reason.",
        ),
        (
            29,
            "compare::not_comparable",
            "The two inputs are of different kinds and cannot be compared. Compare two reports, two trajectories, two recordings, or two folders of results.",
        ),
        (
            30,
            "convert::kind",
            "A joint is revolute in one model and prismatic in the other. A URDF joint needs limits, and an angle limit cannot become a length limit, or the reverse.",
        ),
        (
            31,
            "convert::no_dh",
            "The robot has no Denavit-Hartenberg table, or its table describes another chain. Leave --base and --tip out, so that the chain is that of the table, or convert the chain of the URDF with --from urdf.",
        ),
        (
            32,
            "convert::no_table",
            "No Denavit-Hartenberg table can describe this chain; the message has the reason. Choose another chain with --base and --tip.",
        ),
        (33, "convert::tree", "The converted model is not a valid robot; the message has the reason."),
        (
            34,
            "convert::unproved",
            "The converted model differs from its source by more than the limit, so it is not written. A coarser --accuracy, such as 1e-9, treats nearly parallel axes as parallel, and reports the error.",
        ),
        (
            35,
            "convert::far_normal",
            "Two joint axes are nearly parallel, so their common normal is far away and a value of the table becomes very large.",
        ),
        (
            36,
            "convert::rounded_axes",
            "Two joint axes are so nearly parallel, or so nearly intersecting, that they are treated as parallel or intersecting.",
        ),
        (
            37,
            "derive::base_parameters",
            "The base inertial parameters cannot be computed; the message has the reason.",
        ),
        (
            38,
            "derive::no_joint",
            "No joint moves, so joint torques identify no inertial parameter. Give a URDF in which a joint moves.",
        ),
        (
            39,
            "dynamics::at_rest",
            "The accelerations leave out the dry friction of joints at rest, which may hold these joints in the real robot.",
        ),
        (
            40,
            "dynamics::overflow",
            "A mass, inertia, speed or torque is so large that the computed torques exceed the range of 64-bit numbers. The message names the largest value; often its exponent is wrong.",
        ),
        (
            41,
            "dynamics::payload",
            "The mass of a payload is 0 or negative. Leave the payload out to compute without one.",
        ),
        (
            42,
            "dynamics::source",
            "This source cannot give the dynamics of the robot; the message has the reason.",
        ),
        (
            43,
            "faults::markdown",
            "The file lacks the two marker lines between which the table of faults is written. The help has the two lines. They keep the rest of the file as it is.",
        ),
        (44, "fk::frame", "No frame has this name. The help has the most similar name and the known ones."),
        (45, "fk::source", "This source cannot give the poses of the robot; the message has the reason."),
        (46, "ik::robot", "Inverse kinematics cannot be computed for the chain; the message has the reason."),
        (
            47,
            "inspect::check",
            "The recording cannot be checked against the scenario; the message has the reason.",
        ),
        (48, "inspect::csv", "--csv writes one recording, but several are given. Give one recording."),
        (
            49,
            "inspect::recording",
            "The file is not a recording, or it is damaged. Recordings end in .rrd and are written by `congruent run`.",
        ),
        (50, "jacobian::configuration", "The Jacobian cannot be computed at a configuration."),
        (
            51,
            "jacobian::link",
            "No link has this name. The help has the most similar name and the known ones.",
        ),
        (
            52,
            "jacobian::no_tcp",
            "The robot declares no tool centre point. Declare it under [tcp] in robot.toml, or name a link.",
        ),
        (
            53,
            "man::out",
            "The folder for the manual pages cannot be created. Choose another folder with --out.",
        ),
        (
            54,
            "manipulability::robot",
            "The manipulability of the chain cannot be computed; the message has the reason.",
        ),
        (
            55,
            "new::agreement",
            "The analytical model and the physics disagree at the same configuration, so no scenario could pass. Run `congruent check`, which says why, and correct the robot first.",
        ),
        (
            56,
            "new::no_joint",
            "No joint moves, so there is nothing to run. Choose base and tip in the robot file so that a joint between them moves.",
        ),
        (
            57,
            "new::outside",
            "A new file would lie outside the project of the files that it names, and could not open them. Move the file into the project, or allow the other folder with --allow in each call.",
        ),
        (
            58,
            "new::project",
            "A robot file in that folder would become the top of a new project, and files above it could no longer be opened.",
        ),
        (59, "new::run", "The new scenario does not run; the message has the reason."),
        (
            60,
            "new::scenario",
            "`new scenario` cannot write the file: every motion that it tried fails a check, the robot came from standard input, or the name under --out does not end in .toml.",
        ),
        (61, "new::shape", "No check of distances can be written, or the check ignores some pairs."),
        (
            62,
            "new::urdf",
            "The URDF of a new robot file must be a file; standard input has no path. Give the URDF as a file.",
        ),
        (
            63,
            "schema::document",
            "No schema has this name. The help has the most similar name and the known ones.",
        ),
        (
            64,
            "sensitivity::robot",
            "The sensitivities of the chain cannot be computed; the message has the reason.",
        ),
        (
            65,
            "view::input",
            "The file is not a recording, a robot or a scenario. Give a file that ends in .rrd, .urdf or .toml, or the folder of a robot.",
        ),
        (
            66,
            "view::recording",
            "The file is not a recording, or it is damaged. The viewer would open an empty window. `congruent inspect` says what is damaged.",
        ),
        (67, "view::robot", "The robot cannot be shown; the message has the reason."),
        (
            68,
            "workspace::robot",
            "The workspace of the chain cannot be computed; the message has the reason.",
        ),
        (
            69,
            "check::other_dynamics",
            "The dynamics of the two descriptions cannot be compared; the message has the reason.",
        ),
        (
            70,
            "check::table",
            "--table lists errors at configurations, but no configurations are given. Give --configurations FILE.",
        ),
    ],
}];
