//! Arguments that several commands share.

use std::{collections::BTreeMap, path::PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use schemars::JsonSchema;
use serde::de::{DeserializeOwned, IntoDeserializer, value::Error};

use congruent::description::{
    Diagnostic, JointState, Robot, RobotDescription, RobotQ, RosPackages, Use, configuration,
    load_robot_with, read_configurations, read_states,
};

use crate::{failure::Failure, print::Printer};

/// A robot on the command line.
#[derive(Debug, clap::Args)]
pub(crate) struct RobotArgument {
    /// A folder with robot.toml, a robot file, or a bare .urdf.
    pub(crate) robot: PathBuf,
    #[command(flatten)]
    packages: PackageArguments,
}

/// Where meshes in packages are.
#[derive(Debug, clap::Args)]
pub(crate) struct PackageArguments {
    /// Look for the packages of `package://` in `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH` as well.
    #[arg(long)]
    ros_packages: bool,
}

impl PackageArguments {
    /// The packages of the environment, which is not read if they were not asked for.
    pub(crate) fn ros(&self) -> RosPackages {
        if self.ros_packages { RosPackages::from_environment() } else { RosPackages::default() }
    }
}

impl RobotArgument {
    /// Loads it and prints its warnings.
    pub(crate) fn load(&self, printer: &Printer) -> Result<RobotDescription, Failure> {
        self.load_for(Use::Kinematics, printer)
    }

    /// The same for a use, which is refused before anything is printed.
    pub(crate) fn load_for(&self, needed: Use, printer: &Printer) -> Result<RobotDescription, Failure> {
        let description = load_robot_with(&self.robot, &self.packages.ros())?;
        description.for_use(needed)?;
        printer.warnings(&description.warnings);
        Ok(description)
    }
}

/// A chain of the robot, if it is not the declared one.
#[derive(Debug, clap::Args)]
pub(crate) struct ChainArguments {
    /// The link that the chain starts from.
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link that the chain ends at; with a new base alone, the end of its longest chain.
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
}

impl ChainArguments {
    /// The robot along that chain.
    pub(crate) fn choose(&self, description: RobotDescription) -> Result<RobotDescription, Failure> {
        Ok(description.with_chain(self.base.as_deref(), self.tip.as_deref())?)
    }
}

/// Configurations on the command line.
#[derive(Debug, clap::Args)]
pub(crate) struct ConfigurationArguments {
    /// A JSON array of {"q": {"joint": value}} in rad and m; joints that are not named are at 0.
    #[arg(long, value_name = "FILE", conflicts_with = "at")]
    configurations: Option<PathBuf>,
    /// One joint's position in rad or m; may be given several times.
    #[arg(long, value_name = "JOINT=VALUE")]
    at: Vec<String>,
}

impl ConfigurationArguments {
    /// The configuration vectors: those of the file, or the one of `--at`, or zero.
    pub(crate) fn read(&self, robot: &Robot) -> Result<Vec<RobotQ>, Failure> {
        if let Some(path) = &self.configurations {
            return Ok(read_configurations(path, robot)?);
        }
        let mut values = BTreeMap::new();
        for assignment in &self.at {
            let (joint, value) = parse(assignment)?;
            if let Some(before) = values.insert(joint, value) {
                let message = format!("--at {assignment}: the joint is given as {before} already");
                return Err(Diagnostic::error("cli::at", message).into());
            }
        }
        Ok(vec![configuration(&values, robot)?])
    }

    /// The same with the velocities of the file.
    pub(crate) fn read_states(&self, robot: &Robot) -> Result<Vec<JointState>, Failure> {
        let Some(path) = &self.configurations else {
            let message = "joint velocities are read from a file of configurations, and none is given";
            return Err(Diagnostic::error("cli::velocities", message)
                .with_help(r#"--configurations FILE with [{"q": {"joint": 0.1}, "v": {"joint": 0.2}}]"#)
                .into());
        };
        Ok(read_states(path, robot)?)
    }
}

fn parse(assignment: &str) -> Result<(String, f64), Diagnostic> {
    let value = |(joint, value): (&str, &str)| {
        let value: f64 = value.trim().parse().ok().filter(|value: &f64| value.is_finite())?;
        Some((joint.trim().to_owned(), value))
    };
    assignment.split_once('=').and_then(value).ok_or_else(|| {
        Diagnostic::error("cli::at", format!("--at \"{assignment}\" is not JOINT=VALUE"))
            .with_help("for example --at elbow_joint=1.57, in rad or m")
    })
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
