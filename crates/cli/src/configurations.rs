//! Configurations on the command line: `--at`, `--configurations`, and lines on standard input that are answered while they
//! come.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use congruent::{
    configurations::{
        Configurations, JointState, JointStateList, LiveInput, LiveState, LiveStates, configuration,
        outside_limits, outside_limits_warning, read_configurations, read_configurations_from, read_states,
        read_states_from,
    },
    description::{Robot, RobotDescription, RobotQList},
    input::{Diagnostic, TextLines, is_standard_input},
};

use crate::{
    codes,
    failure::Failure,
    quantity::{Dimension, QuantityArgument},
    terminal::print::Printer,
};

/// Configurations on the command line.
#[derive(Debug, clap::Args)]
pub(crate) struct ConfigurationArguments {
    /// A table (.csv) with a column for each joint, such as elbow_deg or lift_mm, as a run writes, too; or a file with one
    /// {"q": {"joint": value}} per line (JSON Lines), or a JSON array of at most 100,000 of them, in rad and m; - is standard input, of which `fk`, `jacobian` and `dynamics` answer each line at once, with --format json by a
    /// document in one line. Joints that are not named are at 0.
    #[arg(long, value_name = "FILE", conflicts_with = "at")]
    configurations: Option<PathBuf>,
    /// One joint's position: 90deg or 1.57rad if it turns, 100mm or 0.1 (m) if it slides; may be given several times.
    #[arg(long, value_name = "JOINT=VALUE")]
    at: Vec<String>,
}

impl ConfigurationArguments {
    /// Whether a configuration is given.
    pub(crate) fn is_given(&self) -> bool {
        self.configurations.is_some() || !self.at.is_empty()
    }

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
        let (mut values, mut written) = (BTreeMap::new(), BTreeMap::new());
        for assignment in &self.at {
            let (joint, value) = position(assignment, robot)?;
            values.insert(joint.clone(), value);
            if let Some(before) = written.insert(joint, assignment) {
                let message = format!("--at {assignment}: the joint is given already, by --at {before}");
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
        Diagnostic::error(codes::cli::AT, format!("--at \"{assignment}\": {why}"))
            .with_help("for example --at elbow_joint=90deg or --at elbow_joint=1.57rad, --at lift=100mm")
    };
    // Several in one list, as other options take them.
    let listed: Vec<&str> = assignment.split(',').map(str::trim).collect();
    if listed.len() > 1 && listed.iter().all(|of| of.contains('=')) {
        let each: Vec<String> = listed.iter().map(|of| format!("--at {of}")).collect();
        return Err(refused("it has several joints, and --at takes one")
            .with_help(format!("once for each joint: {}", each.join(" "))));
    }
    let (joint, written) = assignment.split_once('=').ok_or_else(|| refused("it is not JOINT=VALUE"))?;
    let (joint, written) = (joint.trim(), written.trim());
    // An unknown joint is reported with the known ones, by whoever uses the name.
    let value = match robot.find_joint(joint).map_or("", |joint| robot.joint(joint).kind.unit()) {
        "rad" => QuantityArgument::of(written, Dimension::Angle),
        "m" => QuantityArgument::of(written, Dimension::Length),
        _ => QuantityArgument::parse(written).map(|quantity| quantity.value),
    };
    Ok((joint.to_owned(), value.map_err(|why| refused(&why))?))
}
