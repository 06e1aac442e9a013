//! The help of `congruent`: commands in groups, and examples of each.

use std::fmt::Write;

use clap::{
    Command, Error,
    error::{ContextKind, ContextValue},
};
use congruent::{input::nearest, text::layout::paragraph};

/// The groups of commands, in the order of the help.
const GROUPS: [(&str, &[&str]); 6] = [
    ("Check", &["check", "lint", "describe", "explain"]),
    ("Run", &["run", "sweep", "replay", "watch", "new"]),
    ("Look", &["view", "inspect", "compare"]),
    (
        "Compute",
        &[
            "fk",
            "ik",
            "jacobian",
            "dynamics",
            "clearance",
            "workspace",
            "manipulability",
            "sensitivity",
            "tolerances",
        ],
    ),
    ("Model", &["convert", "calibrate", "identify", "plan"]),
    ("Shell", &["schema", "completions", "man", "help"]),
];

/// Two examples or more of each command, by its name, in the root of the project.
const EXAMPLES: [(&str, &[&str]); 28] = [
    (
        "check",
        &[
            "congruent check robots/ur5e",
            "congruent check robots/rrr_arm --tolerance 1mm,0.1deg --junit check.xml",
            "congruent check robots/ur5e/ur5e.urdf --against robots/ur5e",
        ],
    ),
    ("lint", &["congruent lint robots/ur5e", "congruent lint scenarios/ur5e_pick.toml --strict"]),
    ("explain", &["congruent explain CGR-URDF-018", "congruent explain axis_flipped"]),
    (
        "describe",
        &[
            "congruent describe robots/ur5e",
            "congruent describe robots/ur5e/ur5e.urdf --tip flange",
            "congruent describe docs/examples/log/joints.csv --robot robots/ur5e",
        ],
    ),
    (
        "run",
        &[
            "congruent run scenarios/ur5e_pick.toml",
            "congruent run scenarios/ur5e_pick.toml --set simulation.step_s=0.002 --out fine",
            "congruent run --faults scenarios/ur5e_pick.toml",
        ],
    ),
    (
        "sweep",
        &[
            "congruent sweep run scenarios/ur5e_payload.sweep.toml --out payload --cases 0..8",
            "congruent sweep run scenarios/ur5e_payload.sweep.toml --out parts --shard 1/16",
        ],
    ),
    (
        "replay",
        &[
            "congruent replay robots/ur5e docs/examples/log/joints.csv",
            "congruent replay robots/ur5e docs/examples/log/joints.csv --out monday --junit replay.xml",
        ],
    ),
    (
        "watch",
        &[
            "congruent watch robots/ur5e < docs/examples/log/clean_stream.jsonl",
            "congruent watch robots/ur5e --until-violation --format json < docs/examples/log/clean_stream.jsonl",
        ],
    ),
    (
        "view",
        &[
            "congruent view robots/ur5e --no-viewer",
            "congruent view robots/planar_2r/planar_2r.urdf --no-viewer --out shown",
        ],
    ),
    (
        "inspect",
        &[
            "congruent run scenarios/ur5e_pick.toml -q && congruent inspect out/ur5e_pick",
            "congruent inspect out/ur5e_pick/recording.rrd --csv joints.csv",
        ],
    ),
    (
        "compare",
        &[
            "congruent run scenarios/ur5e_pick.toml -q && congruent compare out/ur5e_pick out/ur5e_pick",
            "congruent compare out/ur5e_pick/report.json out/ur5e_pick/report.json --tolerance 1e-9",
        ],
    ),
    (
        "fk",
        &[
            "congruent fk robots/ur5e --at shoulder_pan_joint=30deg --at elbow_joint=90deg",
            "congruent fk robots/ur5e --source dh --from base_link --to tool0",
        ],
    ),
    (
        "ik",
        &[
            "congruent ik robots/ur5e --xyz 0.4,0.1,0.3 --rpy 180deg,0,0",
            "congruent ik robots/ur5e --xyz 400mm,100mm,300mm --tolerance 1mm,0.1deg",
        ],
    ),
    (
        "jacobian",
        &[
            "congruent jacobian robots/ur5e --at elbow_joint=90deg",
            "congruent jacobian robots/ur5e --link tool0 --kind body",
        ],
    ),
    (
        "dynamics",
        &[
            "congruent dynamics robots/ur5e --at shoulder_lift_joint=-90deg --payload 3kg,0,0,50mm",
            "congruent dynamics robots/ur5e --base-parameters",
        ],
    ),
    (
        "clearance",
        &[
            "congruent clearance robots/ur5e --at elbow_joint=90deg",
            "congruent clearance robots/ur5e --write-srdf ur5e.srdf",
        ],
    ),
    (
        "workspace",
        &[
            "congruent workspace robots/ur5e --plot workspace.svg",
            "congruent workspace robots/ur5e --samples 10000 --format json",
        ],
    ),
    (
        "manipulability",
        &[
            "congruent manipulability robots/ur5e --at elbow_joint=90deg",
            "congruent manipulability robots/planar_2r --at joint_2=90deg --plot ellipse.svg",
        ],
    ),
    (
        "sensitivity",
        &["congruent sensitivity robots/ur5e", "congruent sensitivity robots/ur5e --plot sensitivity.svg"],
    ),
    (
        "tolerances",
        &[
            "congruent tolerances robots/ur5e --a 0.05mm --d 0.05mm --alpha 0.02deg --theta 0.02deg",
            "congruent tolerances robots/ur5e --digits --tolerance 1mm",
            "congruent tolerances robots/ur5e/ur5e.urdf --xyz 0.05mm --rpy 0.02deg --normal 3 --plot error.svg",
        ],
    ),
    (
        "convert",
        &[
            "congruent convert robots/ur5e/ur5e.urdf --to dh",
            "congruent convert robots/ur5e --to modified --to ur5e_modified.toml",
            "congruent convert robots/ur5e --to ur5e_from_table.urdf",
            "congruent convert robots/ur5e --out ur5e.xml",
            "congruent convert ur5e.xml --to urdf",
        ],
    ),
    (
        "calibrate",
        &[
            "congruent calibrate robots/ur5e docs/examples/calibration/ur5e_points.csv",
            "congruent calibrate robots/ur5e docs/examples/calibration/ur5e_points.csv --noise 0.1mm",
            "congruent calibrate robots/ur5e docs/examples/calibration/ur5e_points.csv --out calibrated",
            "congruent calibrate robots/ur5e --same-point docs/examples/calibration/ur5e_hole_1.csv",
        ],
    ),
    (
        "identify",
        &[
            "congruent identify robots/ur5e docs/examples/log/efforts.csv",
            "congruent identify robots/ur5e docs/examples/log/efforts.csv --free friction,armature,payload",
            "congruent identify robots/ur5e docs/examples/log/efforts.csv --out identified.urdf",
        ],
    ),
    (
        "plan",
        &[
            "congruent plan robots/ur5e --out identification",
            "congruent plan robots/ur5e --free payload --duration-s 10 --out ten_seconds",
            "congruent plan robots/ur5e --scenario scenarios/ur5e_pick.toml --out picking",
        ],
    ),
    ("schema", &["congruent schema robot", "congruent schema scenario > scenario.json"]),
    (
        "completions",
        &["congruent completions bash > congruent.bash", "congruent completions zsh > _congruent"],
    ),
    ("man", &["congruent man > congruent.1", "congruent man --out man1"]),
    (
        "new",
        &[
            "congruent new robot robots/rrr_arm/rrr_arm.urdf --out my_arm",
            "congruent new scenario robots/ur5e --to first.toml",
        ],
    ),
];

/// The command with its commands in groups and with examples.
pub(crate) fn with_groups_and_examples(command: Command) -> Command {
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n       congruent [OPTIONS] ROBOT   (the same as congruent check ROBOT)\n\n{}Options:\n{{options}}\n{}",
        groups(&command),
        "\nExamples of a command: congruent check --help\n"
    );
    let command = with_common_options_last(command.help_template(template));
    EXAMPLES.iter().fold(command, |command, (name, lines)| {
        if command.find_subcommand(name).is_none() {
            // Built without recordings.
            return command;
        }
        let text = format!("Examples:\n  {}", lines.join("\n  "));
        command.mut_subcommand(name, |below| below.after_help(text))
    })
}

/// Commands of other programs, and the one of this program that answers the same question.
const GUESSED: [(&[&str], &str); 7] = [
    (&["diff", "test", "validate", "verify", "against"], "check"),
    (&["pose", "poses", "forward", "kinematics", "fkine"], "fk"),
    (&["inverse", "ikine", "solve"], "ik"),
    (&["simulate", "sim", "play"], "run"),
    (&["show", "display", "render", "open"], "view"),
    (&["info", "summary", "print", "tree"], "describe"),
    (&["export", "import", "derive-dh", "to-mjcf", "to-urdf"], "convert"),
];

/// The error about an unknown command with the one command that is most like it: `check` and not `schema` for `chek`; or with the one
/// that other programs call so.
pub(crate) fn with_nearest_command(mut error: Error, command: &Command) -> Error {
    let Some(ContextValue::String(unknown)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    let known = command.get_subcommands().map(Command::get_name);
    let guessed =
        GUESSED.iter().find(|(words, _)| words.contains(&unknown.as_str())).map(|(_, command)| *command);
    if let Some(near) = guessed.or_else(|| nearest(unknown, known)) {
        let near = ContextValue::Strings(vec![near.to_owned()]);
        error.insert(ContextKind::SuggestedSubcommand, near);
    }
    error
}

/// Options that all commands, or all that open files, have.
const COMMON: [&str; 8] =
    ["format", "color", "quiet", "verbose", "fence", "allow", "package", "ros_packages"];

/// The command with the common options in a section of their own, after the options of each command.
fn with_common_options_last(command: Command) -> Command {
    let command = command.mut_args(|argument| {
        let is_common = COMMON.contains(&argument.get_id().as_str());
        if is_common { argument.help_heading("Common options") } else { argument }
    });
    command.mut_subcommands(with_common_options_last)
}

/// The commands with the first sentence of their help.
fn groups(command: &Command) -> String {
    /// Columns of a name, with the spaces around.
    const NAME: usize = 18;
    let mut text = String::new();
    for (group, names) in GROUPS {
        let _ = writeln!(text, "{group}:");
        for name in names {
            let about = match (*name, command.find_subcommand(name)) {
                ("help", _) => "This help, or that of a command".to_owned(),
                (_, Some(found)) => found.get_about().map(ToString::to_string).unwrap_or_default(),
                (_, None) => continue,
            };
            let first = about.lines().next().unwrap_or_default().trim_end_matches('.');
            let _ =
                writeln!(text, "  {name:<width$}{}", paragraph(first, NAME, NAME).trim(), width = NAME - 2);
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;
    use crate::Arguments;

    #[test]
    fn every_command_is_in_one_group_and_has_two_examples() {
        let command = Arguments::command();
        for below in command.get_subcommands() {
            let name = below.get_name();
            let groups = GROUPS.iter().filter(|(_, names)| names.contains(&name)).count();
            assert_eq!(groups, 1, "{name}");
            let examples =
                EXAMPLES.iter().find(|(known, _)| *known == name).map_or(0, |(_, lines)| lines.len());
            assert!(examples >= 2, "{name}: {examples} examples");
        }
    }
}
