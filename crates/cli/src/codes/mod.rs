//! The codes of the messages of this crate, with what `congruent explain` says about them.

use congruent::input::Code;

/// The codes of all messages: those of the library and of this crate.
pub(crate) fn all_codes() -> Vec<&'static Code> {
    [congruent::codes::all_codes(), ALL.to_vec()].concat()
}

congruent::input::codes! {
    cli {
        AT = "CGR-COMMAND-001", "cli::at",
            "--at is not of the form JOINT=VALUE, its value has no unit, or a joint is given twice.\n    --at elbow_joint=90deg";
        HIDDEN_CHARACTER = "CGR-COMMAND-002", "cli::hidden_character",
            "An argument has a control character or a line break. Terminals do not show it, and it would be copied into the outputs. Type the argument again.\n    wrong: --tip $'tool0\\r'\n    right: --tip tool0";
        NOISE = "CGR-COMMAND-003", "cli::noise",
            "--noise gives only one of the two noises of a measurement, that of a coordinate and that of an orientation, and both are measured. Give both or neither.\n    --noise 0.1mm,0.05deg";
        VALUE = "CGR-COMMAND-005", "cli::value",
            "The option takes a positive number, and another value was given. The message names the option and the value. Give a number above 0.\n    wrong: --threshold 0\n    right: --threshold 1e-3";
        VELOCITIES = "CGR-COMMAND-006", "cli::velocities",
            "The result needs joint velocities, which are read from a file of configurations (key `v`), and no such file was given. Give a file of configurations with `v` on each line.\n    wrong: congruent jacobian robots/ur5e --derivative\n    right: congruent jacobian robots/ur5e --derivative --configurations q.jsonl";
        FORMAT = "CGR-COMMAND-007", "cli::format",
            "SARIF output is available from `lint` only.\n    wrong: congruent check robots/ur5e --format sarif\n    right: congruent lint robots/ur5e --format sarif";
        RENAMED = "CGR-COMMAND-073", "cli::renamed",
            "A command or an option has another name now. The old name works in this version and not in the next. The message has the new one. Write the new one.\n    wrong: congruent faults scenarios/ur5e_pick.toml\n    right: congruent run --faults scenarios/ur5e_pick.toml";
    }
    lint {
        CODE = "CGR-COMMAND-008", "lint::code",
            "The word after `explain` is no code of a finding and no cause of `check`. The help names the most similar one.\n    wrong: congruent explain urdf::axes\n    right: congruent explain urdf::axis";
    }
    run {
        OUTPUT = "CGR-COMMAND-011", "run::output",
            "A result cannot be written to its file. For example its folder is in use by another run, or may not be written. Give another folder or file.\n    wrong: congruent run scenarios/ur5e_pick.toml --out /proc/results\n    right: congruent run scenarios/ur5e_pick.toml --out results";
        SAME_OUTPUT = "CGR-COMMAND-012", "run::same_output",
            "Two scenarios would write their results to the same folder, and one would overwrite the results of the other. Give the scenarios different names.\n    wrong: name = \"pick\"\n    right: name = \"place\"";
        VIEW = "CGR-COMMAND-013", "run::view",
            "--view shows one run, but several scenarios are given. Give one scenario, or leave --view out.\n    wrong: congruent run pick.toml place.toml --view\n    right: congruent run pick.toml --view";
        LOG = "CGR-COMMAND-086", "run::log",
            "The file is no log. `replay` takes an MCAP, a folder that rosbag2 wrote, a table in CSV or Parquet, or a dataset of LeRobot. Other logs are converted first, as bags of ROS 1 by `rosbags-convert`.\n    congruent replay robots/ur5e monday.mcap";
    }
    output {
        REFUSED = "CGR-COMMAND-014", "output::refused",
            "The path of an output is a file that the command reads, or an existing file of another kind. It is not overwritten. Choose another name, or remove the file.\n    wrong: congruent check robots/ur5e --junit robots/ur5e/robot.toml\n    right: congruent check robots/ur5e --junit ur5e.xml";
        UNWRITABLE = "CGR-COMMAND-015", "output::unwritable",
            "A file cannot be written. Choose a file in a folder that exists and can be written.\n    wrong: congruent convert robots/ur5e --to mjcf --out missing/ur5e.xml\n    right: congruent convert robots/ur5e --to mjcf --out ur5e.xml";
        NAME = "CGR-COMMAND-016", "output::name",
            "The name of an output file has the wrong extension. The name of a robot file must end in .toml.\n    wrong: congruent convert robots/ur5e --to dh --to ur5e.txt\n    right: congruent convert robots/ur5e --to dh --to ur5e.toml";
        URDF = "CGR-COMMAND-017", "output::urdf",
            "The URDF came from standard input, so the written file could not refer to it by a path. Give the URDF as a file.\n    wrong: congruent convert - --to dh --to arm.toml < arm.urdf\n    right: congruent convert arm.urdf --to dh --to arm.toml";
    }
    clearance {
        SHAPE = "CGR-COMMAND-019", "clearance::shape",
            "Distances cannot be computed for a shape of the robot, such as a mesh without a volume. The message names the link and the shape. Correct the shape, or leave the link out: --ignore LINK,*.\n    wrong: <mesh filename=\"plate.stl\"/> that is flat\n    right: <box size=\"0.2 0.2 0.002\"/>";
    }
    check {
        PLOT = "CGR-COMMAND-025", "check::plot",
            "--plot shows errors at configurations, but no configurations are given. Give --configurations FILE.\n    wrong: congruent check robots/ur5e --plot errors.svg\n    right: congruent check robots/ur5e --plot errors.svg --configurations q.jsonl";
        TABLE = "CGR-COMMAND-070", "check::table",
            "--table lists errors at configurations, but no configurations are given. Give --configurations FILE.\n    wrong: congruent check robots/ur5e --table\n    right: congruent check robots/ur5e --table --configurations q.jsonl";
    }
    compare {
        NOT_COMPARABLE = "CGR-COMMAND-029", "compare::not_comparable",
            "The two inputs are of different kinds and cannot be compared. Compare two reports, two trajectories, two recordings, or two folders of results.\n    wrong: congruent compare results/pick/report.json robot.toml\n    right: congruent compare results/pick/report.json results/place/report.json";
    }
    convert {
        TO = "CGR-COMMAND-072", "convert::to",
            "No model to write is named, or --to names two models or two files. --out FILE.urdf and --out FILE.xml name the model by the ending of the file. A table is written in one convention, which must be chosen, since the same values are another robot in the other.\n    congruent convert arm.urdf --to dh --to arm.toml";
    }
    describe {
        OPTION = "CGR-COMMAND-080", "describe::option",
            "An option of `describe` fits none of the inputs: --orders is for robots, --robot for logs, --rate-hz for tables. Leave the option out, or give the input for it.\n    wrong: congruent describe monday.mcap --rate-hz 125\n    right: congruent describe monday.csv --rate-hz 125";
    }
    derive {
        BASE_PARAMETERS = "CGR-COMMAND-037", "derive::base_parameters",
            "The base inertial parameters cannot be computed. The message names the joint or value that stops it. Correct it in the URDF, or choose another chain with --base and --tip.\n    congruent dynamics robots/ur5e --base-parameters --base base_link --tip tool0";
        NO_JOINT = "CGR-COMMAND-038", "derive::no_joint",
            "No joint moves, so joint torques identify no inertial parameter. Give a URDF in which a joint moves.\n    wrong: <joint name=\"turn\" type=\"fixed\">\n    right: <joint name=\"turn\" type=\"continuous\">";
    }
    faults {
        MARKDOWN = "CGR-COMMAND-043", "faults::markdown",
            "The file lacks the two marker lines between which the table of faults is written. The help has the two lines. They keep the rest of the file as it is.\n    wrong: congruent run --faults ur5e_pick.toml --markdown README.md\n    right: congruent run --faults ur5e_pick.toml --markdown faults.md";
    }
    ik {
        ROBOT = "CGR-COMMAND-046", "ik::robot",
            "Inverse kinematics cannot be computed: the chain has no moving joint, or the file of targets is none. Choose a chain with --base and --tip; give a table of targets, or one target with --xyz and --rpy.\n    wrong: congruent ik robots/ur5e --targets robots/ur5e/robot.toml\n    right: congruent ik robots/ur5e --targets targets.csv";
    }
    inspect {
        CHECK = "CGR-COMMAND-047", "inspect::check",
            "The recording cannot be checked against the scenario: it has another robot or other checks, or lacks the joint positions. Give the scenario of the run, or one that differs from it in limits alone.\n    wrong: congruent inspect pick.rrd --check place.toml\n    right: congruent inspect pick.rrd --check pick.toml";
        CSV = "CGR-COMMAND-048", "inspect::csv",
            "--csv writes one recording, but several are given. Give one recording.\n    wrong: congruent inspect pick.rrd place.rrd --csv pick.csv\n    right: congruent inspect pick.rrd --csv pick.csv";
        RECORDING = "CGR-COMMAND-049", "inspect::recording",
            "The file is not a recording, or it is damaged. Recordings end in .rrd and are written by `congruent run`.\n    wrong: congruent inspect results/pick/report.json\n    right: congruent inspect results/pick/recording.rrd";
    }
    man {
        OUT = "CGR-COMMAND-053", "man::out",
            "The folder for the manual pages cannot be created. Choose another folder with --out.\n    wrong: congruent man --out robots/ur5e/robot.toml\n    right: congruent man --out man";
    }
    new {
        OUTSIDE = "CGR-COMMAND-057", "new::outside",
            "A new file would lie outside the project of the files that it names, and could not open them. Move the file into the project, or allow the other folder with --allow in each call.\n    wrong: congruent new robot arm/arm.urdf --out robots/arm --fence\n    right: congruent new robot arm/arm.urdf --out arm --fence";
        PROJECT = "CGR-COMMAND-058", "new::project",
            "A robot file in that folder would belong to another project, and with --fence files that the URDF names could no longer be opened. Choose a folder in the project of the URDF.\n    wrong: congruent new robot arm/arm.urdf --out robots/arm --fence\n    right: congruent new robot arm/arm.urdf --out arm --fence";
        URDF = "CGR-COMMAND-062", "new::urdf",
            "The URDF of a new robot file must be a file; standard input has no path. Give the URDF as a file.\n    wrong: congruent new robot - --out arm < arm.urdf\n    right: congruent new robot arm.urdf --out arm";
    }
    schema {
        DOCUMENT = "CGR-COMMAND-063", "schema::document",
            "No schema has this name. The help has the most similar name and the known ones.\n    wrong: congruent schema scenarios\n    right: congruent schema scenario";
    }
    sensitivity {
        ROBOT = "CGR-COMMAND-064", "sensitivity::robot",
            "The sensitivities of the chain cannot be computed, as of a chain without a moving joint. Choose another chain with --base and --tip.\n    wrong: congruent sensitivity robots/ur5e --tip base\n    right: congruent sensitivity robots/ur5e --tip tool0";
    }
    view {
        INPUT = "CGR-COMMAND-065", "view::input",
            "The file is not a recording, a robot or a scenario. Give a file that ends in .rrd, .urdf or .toml, or the folder of a robot.\n    wrong: congruent view results/pick/report.json\n    right: congruent view results/pick/recording.rrd";
        RECORDING = "CGR-COMMAND-066", "view::recording",
            "The file is not a recording, or it is damaged. The viewer would open an empty window. `congruent inspect` says what is damaged.\n    wrong: congruent view report.rrd\n    right: congruent view recording.rrd";
        ROBOT = "CGR-COMMAND-067", "view::robot",
            "The robot cannot be drawn. The message names the link or shape that stops it. Correct that shape in the URDF.\n    congruent lint robots/ur5e";
    }
    workspace {
        ROBOT = "CGR-COMMAND-068", "workspace::robot",
            "The workspace of the chain cannot be computed, as of a chain without a moving joint. Choose another chain with --base and --tip.\n    wrong: congruent workspace robots/ur5e --tip base\n    right: congruent workspace robots/ur5e --tip tool0";
    }
    watch {
        JOINTS = "CGR-COMMAND-096", "watch::joints",
            "A robot of Universal Robots has six joints, and the chain from base to tip of the robot file has another number of moving joints. RTDE gives positions without names: they are those of this chain, in its order. Give a robot file whose base and tip are those of the arm.\n    congruent watch robots/ur5e --rtde 192.168.1.10";
    }
}

#[cfg(test)]
mod tests;
