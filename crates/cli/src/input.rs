//! Arguments that several commands share.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use congruent::{
    description::{Followers, RobotDescription, codes::urdf::MASSLESS, load_robot_set, load_robot_with},
    input::{Capability, Diagnostic, FileAccess, Findings, Override, RosPackages},
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

/// The seed of random numbers.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "a seed is a whole number from 0 on: --seed 7".to_owned())
}

/// A robot on the command line.
#[derive(Debug, clap::Args)]
pub(crate) struct RobotArgument {
    /// A folder with robot.toml, a robot file, a URDF or an MJCF, or - for a URDF or MJCF on standard input.
    pub(crate) robot: PathBuf,
    #[command(flatten)]
    access: AccessArguments,
}

/// Values in place of those of a robot's files.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct SetArguments {
    /// Replace a value of the robot, for example `dh.row.elbow_joint.d_m=0.4` or `link.forearm_link.mass_kg=3`; the files stay as
    /// they are.
    ///
    /// KEY is a key of robot.toml: keys joined by dots, an entry of a list by its number, from 1, or its joint. Or it is a value of a
    /// link or joint, also of one in a URDF or MJCF: `link.NAME.mass_kg` and `com_m`, `joint.NAME.damping`, `friction`, `armature`,
    /// `xyz_m` and `rpy_deg`; `check` takes keys of robot.toml alone. VALUE is TOML, in the unit of the key. May be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = Override::of_argument)]
    overrides: Vec<Override>,
}

impl SetArguments {
    /// Loads a robot with these values.
    pub(crate) fn load(&self, path: &Path, access: &FileAccess) -> Result<RobotDescription, Findings> {
        load_robot_set(path, &self.of_robot(), access)
    }

    /// The same for what files say, so without values of links and joints.
    pub(crate) fn load_file(&self, path: &Path, access: &FileAccess) -> Result<RobotDescription, Findings> {
        congruent::load_robot_file_set(path, &self.of_robot(), access)
    }

    /// A key that begins as it does in a scenario is the same one.
    fn of_robot(&self) -> Vec<Override> {
        self.overrides.iter().map(|set| set.inside("robot").unwrap_or_else(|| set.clone())).collect()
    }
}

/// Which files may be opened that other files name.
#[derive(Debug, Clone, clap::Args)]
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

/// A robot that arguments name.
pub(crate) trait RobotArguments: clap::Args + std::fmt::Debug {
    /// Loads the robot and prints nothing.
    fn read(&self) -> Result<RobotDescription, Failure>;

    /// Loads it for a use, which is refused before anything is printed, and prints its warnings.
    fn load_for(&self, needed: Capability, printer: &Printer) -> Result<RobotDescription, Failure> {
        let description = self.read()?;
        description.check_capability(needed)?;
        printer.warnings(None, &description.warnings);
        printer.notes(
            (!description.set_values.is_empty()).then(|| description.set_values.join(", ")).as_deref(),
        );
        printer.detail(|| read_from(&description));
        Ok(description)
    }
}

impl RobotArgument {
    /// Which files it may name.
    pub(crate) fn access(&self) -> Result<FileAccess, Diagnostic> {
        self.access.access()
    }
}

impl RobotArguments for RobotArgument {
    fn read(&self) -> Result<RobotDescription, Failure> {
        Ok(load_robot_with(&self.robot, &self.access()?)?)
    }
}

/// A robot with values in place of those of its files.
#[derive(Debug, clap::Args)]
pub(crate) struct SetRobotArgument {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    set: SetArguments,
}

impl RobotArguments for SetRobotArgument {
    fn read(&self) -> Result<RobotDescription, Failure> {
        Ok(self.set.load(&self.robot.robot, &self.robot.access()?)?)
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

    /// Like `of`, and prints the warnings of the robot along the chain, as far as they matter for this use.
    fn choose(
        &self,
        description: RobotDescription,
        needed: Capability,
        printer: &Printer,
    ) -> Result<RobotDescription, Failure> {
        let description = self.of(description)?;
        // That links have no mass is the rule for a robot that is described for its poses alone.
        let is_of_use = |of: &&Diagnostic| needed != Capability::Kinematics || of.code.name != MASSLESS.name;
        let warnings: Vec<Diagnostic> = description.warnings.iter().filter(is_of_use).cloned().collect();
        printer.warnings(None, &warnings);
        printer.detail(|| read_from(&description));
        Ok(description)
    }
}

/// A robot with a chain.
#[derive(Debug, clap::Args)]
pub(crate) struct ArmArguments<R: RobotArguments = RobotArgument> {
    #[command(flatten)]
    pub(crate) robot: R,
    #[command(flatten)]
    pub(crate) chain: ChainArguments,
}

/// The same with values in place of those of its files.
pub(crate) type SetArmArguments = ArmArguments<SetRobotArgument>;

impl<R: RobotArguments> ArmArguments<R> {
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
        self.chain.choose(description, needed, printer)
    }

    /// Like `load`, without the table of the robot file, for commands that do not need it.
    pub(crate) fn load_urdf(&self, printer: &Printer) -> Result<RobotDescription, Failure> {
        let mut description = self.robot.read()?;
        description.dh = None;
        self.chain.choose(description, Capability::Physics, printer)
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
