//! Arguments that several commands share.

use std::{
    collections::BTreeMap,
    ffi::OsString,
    path::{Path, PathBuf},
};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use congruent::{
    description::{
        Configurations, Followers, JointState, JointStateList, LiveInput, LiveState, LiveStates, Robot,
        RobotDescription, RobotQList, configuration, load_robot_with, outside_limits, outside_limits_warning,
        read_configurations, read_configurations_from, read_states, read_states_from,
    },
    input::{
        Capability, Diagnostic, FileAccess, RosPackages, TextLines, is_standard_input, units::WrittenUnit,
    },
};
use schemars::JsonSchema;
use serde::de::{DeserializeOwned, IntoDeserializer, value::Error};

use crate::{codes, failure::Failure, terminal::print::Printer};

/// Refuses arguments with control characters or separators of lines: paths and names go into every output.
pub(crate) fn shown_arguments(arguments: &[OsString]) -> Result<(), Failure> {
    let is_refused = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}');
    let arguments = arguments.iter().map(|argument| argument.to_string_lossy().into_owned());
    match arguments.skip(1).find(|argument| argument.contains(is_refused)) {
        None => Ok(()),
        Some(argument) => Err(Diagnostic::error(
            codes::cli::HIDDEN_CHARACTER,
            format!("the argument \"{argument}\" has a control character or a line break"),
        )
        .with_help("type the argument again without it; rename a file that has one in its name")
        .into()),
    }
}

/// A robot on the command line.
#[derive(Debug, clap::Args)]
pub(crate) struct RobotArgument {
    /// A folder with robot.toml, a robot file, a bare .urdf, or - for a URDF on standard input.
    pub(crate) robot: PathBuf,
    #[command(flatten)]
    access: AccessArguments,
}

/// Which files may be opened that other files name.
#[derive(Debug, clap::Args)]
pub(crate) struct AccessArguments {
    /// Open only files of the project, for files of strangers: the project is the nearest folder at or above the given file with
    /// package.xml or .git, or else the folder above its own, or the current folder if that is higher. Without it the URDF, SRDF,
    /// meshes and tables that a file names are opened wherever they are.
    #[arg(long)]
    fence: bool,
    /// Count this folder as part of the project: with --fence its files are opened, and lines of them are quoted. May be given
    /// several times.
    #[arg(long, value_name = "DIR")]
    allow: Vec<PathBuf>,
    /// The folder of a package of `package://`. May be given several times.
    #[arg(long, value_name = "NAME=DIR")]
    package: Vec<String>,
    /// With --fence, look for packages in `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH` all the same.
    #[arg(long)]
    ros_packages: bool,
}

impl AccessArguments {
    /// Behind a fence the environment is read only with `--ros-packages`.
    pub(crate) fn access(&self) -> Result<FileAccess, Diagnostic> {
        let is_searched = self.ros_packages || !self.fence;
        let ros = if is_searched { RosPackages::from_environment() } else { RosPackages::default() };
        let access = FileAccess::new(ros, &self.allow)?.with_packages(&self.package)?;
        Ok(if self.fence { access.fenced() } else { access })
    }
}

impl RobotArgument {
    /// Loads the robot and prints nothing.
    fn read(&self) -> Result<RobotDescription, Failure> {
        Ok(load_robot_with(&self.robot, &self.access()?)?)
    }

    /// Which files it may name.
    pub(crate) fn access(&self) -> Result<FileAccess, Diagnostic> {
        self.access.access()
    }

    /// Loads it for a use, which is refused before anything is printed, and prints its warnings.
    pub(crate) fn load_for(
        &self,
        needed: Capability,
        printer: &Printer,
    ) -> Result<RobotDescription, Failure> {
        let description = self.read()?;
        description.check_capability(needed)?;
        printer.warnings(None, &description.warnings);
        printer.detail(|| read_from(&description));
        Ok(description)
    }
}

/// What was read, for --verbose.
fn read_from(description: &RobotDescription) -> String {
    let robot = &description.robot;
    let files: Vec<String> = files_of(description).iter().map(|path| path.display().to_string()).collect();
    let (links, dof) = (robot.links().len(), robot.dof());
    let [base, tip] = [description.base, description.tip].map(|link| robot.link(link).name.as_str());
    format!(
        "{}: {links} links, {dof} joints that move, chain {base} to {tip}; read from {}",
        description.name,
        files.join(", ")
    )
}

/// The files that a robot was read from, which no result may replace.
pub(crate) fn files_of(description: &RobotDescription) -> Vec<PathBuf> {
    description.inputs.iter().map(|input| input.path.clone()).collect()
}

/// The same access with the files of a robot, which a new file about that robot may name wherever it is written.
pub(crate) fn allowing_inputs(access: FileAccess, description: &RobotDescription) -> FileAccess {
    let named =
        [Some(&description.path), Some(&description.urdf_path), description.named_files.srdf.as_ref()];
    named.into_iter().flatten().fold(access, |access, file| access.beside(file))
}

/// Whether a new file names another that commands with a fence open only if it is allowed.
pub(crate) fn needs_to_be_allowed(access: &FileAccess, file: &Path, named: &Path) -> Option<Diagnostic> {
    access.inside_project_of(file).ok()?.check(named).err()?;
    let folder = named.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let message = format!("{} is outside of the project of {}", named.display(), file.display());
    Some(Diagnostic::warning(codes::new::OUTSIDE, message).with_help(format!(
        "add --allow {} to every other command that reads the new file with --fence",
        folder.display()
    )))
}

/// A chain of the robot, if it is not the declared one.
#[derive(Debug, clap::Args)]
pub(crate) struct ChainArguments {
    /// The link that the chain starts from.
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link that the chain ends at; if only --base is given, the end of the longest chain from it.
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
}

impl ChainArguments {
    /// The robot along that chain.
    pub(crate) fn of(&self, description: RobotDescription) -> Result<RobotDescription, Failure> {
        Ok(description.with_chain(self.base.as_deref(), self.tip.as_deref())?)
    }

    /// Like `of`, and prints the warnings of the robot along the chain.
    pub(crate) fn choose(
        &self,
        description: RobotDescription,
        printer: &Printer,
    ) -> Result<RobotDescription, Failure> {
        let description = self.of(description)?;
        printer.warnings(None, &description.warnings);
        printer.detail(|| read_from(&description));
        Ok(description)
    }
}

/// A robot with a chain.
#[derive(Debug, clap::Args)]
pub(crate) struct ArmArguments {
    #[command(flatten)]
    pub(crate) robot: RobotArgument,
    #[command(flatten)]
    pub(crate) chain: ChainArguments,
}

impl ArmArguments {
    /// Loads the robot along its chain and prints its warnings.
    pub(crate) fn load(&self, printer: &Printer) -> Result<RobotDescription, Failure> {
        self.load_for(Capability::Kinematics, printer)
    }

    /// Like `load`, for a use that is checked before anything is printed.
    pub(crate) fn load_for(
        &self,
        needed: Capability,
        printer: &Printer,
    ) -> Result<RobotDescription, Failure> {
        let description = self.robot.read()?;
        description.check_capability(needed)?;
        self.chain.choose(description, printer)
    }

    /// Like `load`, without the table of the robot file, for commands that do not need it.
    pub(crate) fn load_urdf(&self, printer: &Printer) -> Result<RobotDescription, Failure> {
        let mut description = self.robot.read()?;
        description.dh = None;
        self.chain.choose(description, printer)
    }
}

/// How joints that follow others count.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct FollowerArgument {
    /// Count each joint that follows another by <mimic> as if it were driven; by default its torques and velocities are part
    /// of those of the joint that it follows.
    #[arg(long)]
    free_followers: bool,
}

impl FollowerArgument {
    pub(crate) fn followers(&self) -> Followers {
        if self.free_followers { Followers::Free } else { Followers::Folded }
    }
}

/// Configurations on the command line.
#[derive(Debug, clap::Args)]
pub(crate) struct ConfigurationArguments {
    /// A file with one {"q": {"joint": value}} per line (JSON Lines), or a JSON array of at most 100,000 of them, in rad and
    /// m; - is standard input, of which `fk`, `jacobian` and `dynamics` answer each line at once, with --format json by a
    /// document in one line. Joints that are not named are at 0.
    #[arg(long, value_name = "FILE", conflicts_with = "at")]
    configurations: Option<PathBuf>,
    /// One joint's position in rad or m, or with a unit as 90deg, 1.57rad, 0.1m, 100mm; may be given several
    /// times.
    #[arg(long, value_name = "JOINT=VALUE")]
    at: Vec<String>,
}

impl ConfigurationArguments {
    /// The configuration vectors: those of the file, or the one of `--at`, or zero. Values outside the limits
    /// are warnings of the description.
    pub(crate) fn read(
        &self,
        description: &mut RobotDescription,
        printer: &Printer,
    ) -> Result<RobotQList, Failure> {
        if let Some(path) = &self.configurations {
            let read = read_configurations(path, &description.robot)?;
            return Ok(with_warning(read, description, printer));
        }
        let robot = &description.robot;
        let mut values = BTreeMap::new();
        for assignment in &self.at {
            let (joint, value) = position(assignment, robot)?;
            if let Some(before) = values.insert(joint, value) {
                let message = format!("--at {assignment}: the joint is given as {before} already");
                return Err(Diagnostic::error(codes::cli::AT, message).into());
            }
        }
        let q = configuration(&values, robot)?;
        let warning = outside_limits_warning(&outside_limits(&values, robot));
        Ok(with_warning(
            Configurations { entries: RobotQList::from(&q), warning, input: None },
            description,
            printer,
        ))
    }

    /// Answers the configurations of a file as one list, and each line of standard input when it comes. `answer` is given a list
    /// and the number of its first entry.
    pub(crate) fn answer(
        &self,
        description: &mut RobotDescription,
        printer: &Printer,
        mut answer: impl FnMut(&RobotDescription, &RobotQList, usize) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let Some(path) = self.live() else {
            let list = self.read(description, printer)?;
            return answer(description, &list, 1);
        };
        let each = |description: &RobotDescription, state: JointState, number| {
            answer(description, &RobotQList::from(&state.q), number)
        };
        let Some(lines) = each_line(path, description, printer, each)? else { return Ok(()) };
        let list = with_warning(read_configurations_from(*lines, &description.robot)?, description, printer);
        answer(description, &list, 1)
    }

    /// The same with velocities, accelerations and torques.
    pub(crate) fn answer_states(
        &self,
        description: &mut RobotDescription,
        printer: &Printer,
        mut answer: impl FnMut(&RobotDescription, &JointStateList, usize) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let Some(path) = self.live() else {
            let list = self.read_states(description, printer)?;
            return answer(description, &list, 1);
        };
        let each = |description: &RobotDescription, state: JointState, number| {
            let mut list = JointStateList::new(state.q.len());
            list.push(&state);
            answer(description, &list, number)
        };
        let Some(lines) = each_line(path, description, printer, each)? else { return Ok(()) };
        let list = with_warning(read_states_from(*lines, &description.robot)?, description, printer);
        answer(description, &list, 1)
    }

    /// The same; at rest and without torques if there is no file.
    pub(crate) fn answer_states_or_rest(
        &self,
        description: &mut RobotDescription,
        printer: &Printer,
        mut answer: impl FnMut(&RobotDescription, &JointStateList, usize) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if self.configurations.is_some() {
            return self.answer_states(description, printer, answer);
        }
        let list = self.at_rest(description, printer)?;
        answer(description, &list, 1)
    }

    /// Standard input, if configurations come from there.
    fn live(&self) -> Option<&Path> {
        self.configurations.as_deref().filter(|path| is_standard_input(path))
    }

    fn at_rest(
        &self,
        description: &mut RobotDescription,
        printer: &Printer,
    ) -> Result<JointStateList, Failure> {
        let zeros = vec![0.0; description.robot.dof()];
        let mut at_rest = JointStateList::new(description.robot.dof());
        for q in self.read(description, printer)?.iter() {
            at_rest.push(&JointState { q, qd: zeros.clone(), qdd: zeros.clone(), tau: zeros.clone() });
        }
        Ok(at_rest)
    }

    /// The same with the velocities, accelerations and torques of the file.
    pub(crate) fn read_states(
        &self,
        description: &mut RobotDescription,
        printer: &Printer,
    ) -> Result<JointStateList, Failure> {
        let Some(path) = &self.configurations else {
            let message = "joint velocities are needed, and only a file of configurations can give them: --configurations is missing";
            return Err(Diagnostic::error(codes::cli::VELOCITIES, message)
                .with_help(
                    r#"--configurations FILE with {"q": {"joint": 0.1}, "v": {"joint": 0.2}} on each line"#,
                )
                .into());
        };
        Ok(with_warning(read_states(path, &description.robot)?, description, printer))
    }
}

/// Answers each line of standard input when it comes; what is no list of lines is returned unread.
fn each_line(
    path: &Path,
    description: &mut RobotDescription,
    printer: &Printer,
    mut answer: impl FnMut(&RobotDescription, JointState, usize) -> Result<(), Failure>,
) -> Result<Option<Box<TextLines>>, Failure> {
    let mut lines = match LiveStates::open(path)? {
        LiveInput::Lines(lines) => lines,
        LiveInput::Whole(lines) => return Ok(Some(lines)),
    };
    while let Some(LiveState { number, state, warning }) = lines.next_state(&description.robot)? {
        printer.warnings(None, warning.as_slice());
        // The document of this line has its warning, that of the next has not.
        let before = description.warnings.len();
        description.warnings.extend(warning);
        let answered = answer(description, state, number);
        description.warnings.truncate(before);
        answered?;
    }
    Ok(None)
}

/// The entries; their warning is printed and becomes one of the description, whose warnings are in each report, and their
/// file one of its inputs.
pub(crate) fn with_warning<List>(
    read: Configurations<List>,
    description: &mut RobotDescription,
    printer: &Printer,
) -> List {
    printer.warnings(None, read.warning.as_slice());
    description.warnings.extend(read.warning);
    description.inputs.extend(read.input);
    read.entries
}

/// `JOINT=VALUE` as a name and a position in rad or m.
fn position(assignment: &str, robot: &Robot) -> Result<(String, f64), Diagnostic> {
    let refused = |why: &str| {
        Diagnostic::error(codes::cli::AT, format!("--at \"{assignment}\" {why}")).with_help(
            "for example --at elbow_joint=1.57 or --at elbow_joint=90deg, --at lift=0.1 or --at lift=100mm",
        )
    };
    let (joint, written) = assignment.split_once('=').ok_or_else(|| refused("is not JOINT=VALUE"))?;
    let (joint, written) = (joint.trim(), written.trim());
    let (number, unit) = match WrittenUnit::at_end(written) {
        Some((number, unit)) => (number.trim_end(), Some(unit)),
        None => (written, None),
    };
    let value: f64 = number.parse().map_err(|_| refused("is not JOINT=VALUE"))?;
    let value = unit.map_or(value, |unit| unit.to_si(value));
    if !value.is_finite() {
        return Err(refused("is not a finite number"));
    }
    // An unknown joint is reported with the known ones, by whoever uses the name.
    let coordinate = robot.find_joint(joint).map_or("", |joint| robot.joint(joint).kind.unit());
    if let Some(unit) = unit
        && !coordinate.is_empty()
        && unit.unit.names()[0] != coordinate
    {
        return Err(refused(&format!("is in {}, but the joint's position is in {coordinate}", unit.name())));
    }
    Ok((joint.to_owned(), value))
}

/// Parses an enum of the library by the names that it has in JSON, with its documentation as help.
pub(crate) fn named<T>() -> impl TypedValueParser<Value = T>
where
    T: DeserializeOwned + JsonSchema + Clone + Send + Sync + 'static,
{
    let schema = schemars::schema_for!(T);
    let variants = schema.get("oneOf").and_then(|variants| variants.as_array());
    let values = variants.into_iter().flatten().filter_map(|variant| {
        let name = variant.get("const")?.as_str()?.to_owned();
        let description = variant.get("description").and_then(|text| text.as_str()).unwrap_or_default();
        let first = description.split("\n\n").next().unwrap_or_default().replace('\n', " ");
        Some(PossibleValue::new(name).help(first.trim_end_matches('.').to_owned()))
    });
    PossibleValuesParser::new(values.collect::<Vec<_>>())
        .try_map(|name: String| T::deserialize(IntoDeserializer::<Error>::into_deserializer(name)))
}
