//! The codes of the messages of this crate, with what `congruent explain` says about them.

use congruent::input::Code;

/// The codes of all messages: those of the library and of this crate.
pub(crate) fn all_codes() -> Vec<&'static Code> {
    [congruent::codes::all_codes(), ALL.to_vec()].concat()
}

congruent::input::codes! {
    cli {
        AT = "CGR-COMMAND-001", "cli::at",
            "--at is not of the form JOINT=VALUE, or a joint is given twice.\n    --at elbow_joint=90deg";
        HIDDEN_CHARACTER = "CGR-COMMAND-002", "cli::hidden_character",
            "An argument has a control character or a line break. Terminals do not show it, and it would be copied into the outputs. Type the argument again.";
        NOISE = "CGR-COMMAND-003", "cli::noise",
            "--noise gives only one of the two noises of a measurement, that of a coordinate and that of an orientation, and both are measured. Give both or neither.\n    --noise 0.1mm,0.05deg";
        VALUE = "CGR-COMMAND-005", "cli::value",
            "The option takes a positive number, and another value was given. The message names the option and the value.";
        VELOCITIES = "CGR-COMMAND-006", "cli::velocities",
            "The result needs joint velocities, which are read from a file of configurations (key `v`), and no such file was given.";
        FORMAT = "CGR-COMMAND-007", "cli::format",
            "SARIF output is available from `lint` only.";
        RENAMED = "CGR-COMMAND-073", "cli::renamed",
            "A command or an option has another name now. The old name works in this version and not in the next. The message has the new one.";
    }
    lint {
        CODE = "CGR-COMMAND-008", "lint::code",
            "The word after `explain` is no code of a finding and no cause of `check`. The help names the most similar one.";
    }
    run {
        OUTPUT = "CGR-COMMAND-011", "run::output",
            "A result cannot be written to its file. For example its folder is in use by another run, or may not be written. Give another folder or file.";
        SAME_OUTPUT = "CGR-COMMAND-012", "run::same_output",
            "Two scenarios would write their results to the same folder, and one would overwrite the results of the other. Give the scenarios different names.";
        VIEW = "CGR-COMMAND-013", "run::view",
            "--view shows one run, but several scenarios are given. Give one scenario, or leave --view out.";
    }
    output {
        REFUSED = "CGR-COMMAND-014", "output::refused",
            "The path of an output is a file that the command reads, or an existing file of another kind. It is not overwritten. Choose another name, or remove the file.";
        UNWRITABLE = "CGR-COMMAND-015", "output::unwritable",
            "A file cannot be written. Choose a file in a folder that exists and can be written.";
        NAME = "CGR-COMMAND-016", "output::name",
            "The name of an output file has the wrong extension. The name of a robot file must end in .toml.";
        URDF = "CGR-COMMAND-017", "output::urdf",
            "The URDF came from standard input, so the written file could not refer to it by a path. Give the URDF as a file.";
    }
    clearance {
        SHAPE = "CGR-COMMAND-019", "clearance::shape",
            "Distances cannot be computed for a shape of the robot, such as a mesh without a volume. The message names the link and the shape. Correct the shape, or leave the link out: --ignore LINK,*.";
    }
    check {
        PLOT = "CGR-COMMAND-025", "check::plot",
            "--plot shows errors at configurations, but no configurations are given. Give --configurations FILE.";
        TABLE = "CGR-COMMAND-070", "check::table",
            "--table lists errors at configurations, but no configurations are given. Give --configurations FILE.";
    }
    compare {
        NOT_COMPARABLE = "CGR-COMMAND-029", "compare::not_comparable",
            "The two inputs are of different kinds and cannot be compared. Compare two reports, two trajectories, two recordings, or two folders of results.";
    }
    convert {
        TO = "CGR-COMMAND-072", "convert::to",
            "No model to write is named, or --to names two models or two files. --out FILE.urdf and --out FILE.xml name the model by the ending of the file. A table is written in one convention, which must be chosen, since the same values are another robot in the other.\n    congruent convert arm.urdf --to dh --to arm.toml";
    }
    derive {
        BASE_PARAMETERS = "CGR-COMMAND-037", "derive::base_parameters",
            "The base inertial parameters cannot be computed. The message names the joint or value that stops it. Correct it in the URDF, or choose another chain with --base and --tip.";
        NO_JOINT = "CGR-COMMAND-038", "derive::no_joint",
            "No joint moves, so joint torques identify no inertial parameter. Give a URDF in which a joint moves.";
    }
    faults {
        MARKDOWN = "CGR-COMMAND-043", "faults::markdown",
            "The file lacks the two marker lines between which the table of faults is written. The help has the two lines. They keep the rest of the file as it is.";
    }
    ik {
        ROBOT = "CGR-COMMAND-046", "ik::robot",
            "Inverse kinematics cannot be computed: the chain has no moving joint, or the file of targets is none. Choose a chain with --base and --tip; give a table of targets, or one target with --xyz and --rpy.";
    }
    inspect {
        CHECK = "CGR-COMMAND-047", "inspect::check",
            "The recording cannot be checked against the scenario: it has another robot or other checks, or lacks the joint positions. Give the scenario of the run, or one that differs from it in limits alone.";
        CSV = "CGR-COMMAND-048", "inspect::csv",
            "--csv writes one recording, but several are given. Give one recording.";
        RECORDING = "CGR-COMMAND-049", "inspect::recording",
            "The file is not a recording, or it is damaged. Recordings end in .rrd and are written by `congruent run`.";
    }
    man {
        OUT = "CGR-COMMAND-053", "man::out",
            "The folder for the manual pages cannot be created. Choose another folder with --out.";
    }
    new {
        OUTSIDE = "CGR-COMMAND-057", "new::outside",
            "A new file would lie outside the project of the files that it names, and could not open them. Move the file into the project, or allow the other folder with --allow in each call.";
        PROJECT = "CGR-COMMAND-058", "new::project",
            "A robot file in that folder would belong to another project, and with --fence files that the URDF names could no longer be opened. Choose a folder in the project of the URDF.";
        URDF = "CGR-COMMAND-062", "new::urdf",
            "The URDF of a new robot file must be a file; standard input has no path. Give the URDF as a file.";
    }
    schema {
        DOCUMENT = "CGR-COMMAND-063", "schema::document",
            "No schema has this name. The help has the most similar name and the known ones.";
    }
    sensitivity {
        ROBOT = "CGR-COMMAND-064", "sensitivity::robot",
            "The sensitivities of the chain cannot be computed, as of a chain without a moving joint. Choose another chain with --base and --tip.";
    }
    view {
        INPUT = "CGR-COMMAND-065", "view::input",
            "The file is not a recording, a robot or a scenario. Give a file that ends in .rrd, .urdf or .toml, or the folder of a robot.";
        RECORDING = "CGR-COMMAND-066", "view::recording",
            "The file is not a recording, or it is damaged. The viewer would open an empty window. `congruent inspect` says what is damaged.";
        ROBOT = "CGR-COMMAND-067", "view::robot",
            "The robot cannot be drawn. The message names the link or shape that stops it. Correct that shape in the URDF.";
    }
    workspace {
        ROBOT = "CGR-COMMAND-068", "workspace::robot",
            "The workspace of the chain cannot be computed, as of a chain without a moving joint. Choose another chain with --base and --tip.";
    }
}

#[cfg(test)]
mod tests;
