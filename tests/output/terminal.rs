//! What belongs to the terminal: colour, what is said beside the answer, completions, manual pages, 80 columns.

use std::{fs, process::Command};

use crate::support::command::{commands_in, congruent, congruent_json, text};

const ESCAPE: char = '\u{1b}';

/// A robot file with a warning, and a wrong one.
fn refused(more: &[&str]) -> String {
    let answer = congruent(&[&["fk", "robots/ur5e", "--at", "elbow=1.2rad"], more].concat());
    assert_eq!(answer.code, 2);
    answer.stderr
}

#[test]
fn colour_is_chosen() {
    assert!(!refused(&[]).contains(ESCAPE), "a pipe has no colour");
    assert!(refused(&["--color", "always"]).contains(ESCAPE));
    assert!(!refused(&["--color", "never"]).contains(ESCAPE));
}

#[test]
fn quiet_is_the_answer_alone_and_verbose_says_more() {
    let [usual, quiet, verbose] =
        [&["fk", "robots/ur5e"][..], &["fk", "robots/ur5e", "-q"], &["-v", "fk", "robots/ur5e"]]
            .map(congruent);
    assert_eq!((&usual.stdout, &usual.stdout), (&quiet.stdout, &verbose.stdout));
    assert!(quiet.stderr.is_empty());
    assert!(
        verbose.stderr.contains("ur5e.urdf") && verbose.stderr.contains("6 joints"),
        "{}",
        verbose.stderr
    );
    let described = congruent(&["describe", "robots/ur5e", "robots/panda", "-q"]);
    assert_eq!(described.stdout.lines().count(), 2, "{}", described.stdout);
    assert!(described.stdout.contains("physics ready"), "{}", described.stdout);
    // A warning is said usually, an error always.
    let outside = ["fk", "robots/ur5e", "--at", "elbow_joint=9rad"];
    assert!(congruent(&outside).stderr.contains("elbow_joint"));
    assert!(congruent(&[&outside[..], &["--quiet"]].concat()).stderr.is_empty());
    assert!(refused(&["-q"]).contains("elbow_joint"), "what is near is said");
    assert!(congruent(&["-v", "fk", "robots/ur5e", "-q"]).stderr.is_empty());
}

#[test]
fn no_progress_is_drawn_in_a_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let answer = congruent(&["run", "scenarios/rrr_arm_wave.toml", "--out", &text(folder.path())]);
    assert_eq!((answer.code, answer.stderr.as_str()), (0, ""));
    assert!(!answer.stdout.contains('\r') && !answer.stdout.contains(ESCAPE));
}

#[test]
fn every_shell_has_completions_of_all_commands() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = congruent(&["completions", shell]);
        assert_eq!(script.code, 0, "{}", script.stderr);
        for word in ["inspect", "--set", "sensitivity", "completions"] {
            let word = if shell == "fish" { word.trim_start_matches('-') } else { word };
            assert!(script.stdout.contains(word), "{shell}: {word}");
        }
        assert_eq!(congruent_json(&["completions", shell]).json()["script"], script.stdout);
    }
    // Values of arguments without an option.
    assert!(congruent(&["completions", "bash"]).stdout.contains("base_parameters"));
    assert_eq!(congruent(&["completions", "cmd"]).code, 2);
}

#[cfg(unix)]
#[test]
fn bash_accepts_its_completions() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("congruent.bash");
    fs::write(&file, congruent(&["completions", "bash"]).stdout).unwrap();
    let Ok(answer) = Command::new("bash").arg("-c").arg(format!(
        "source {}; COMP_WORDS=(congruent insp); COMP_CWORD=1; _congruent congruent insp congruent; echo ${{COMPREPLY[*]}}",
        file.display()
    )).output() else { return };
    assert_eq!(
        String::from_utf8_lossy(&answer.stdout).trim(),
        "inspect",
        "{}",
        String::from_utf8_lossy(&answer.stderr)
    );
}

#[test]
fn there_is_a_manual_page_for_each_command() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("man1");
    let answer = congruent(&["man", "--out", &text(&out)]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let main = fs::read_to_string(out.join("congruent.1")).unwrap();
    assert_eq!(congruent(&["man"]).stdout, main);
    for page in
        ["congruent-run", "congruent-inspect", "congruent-new-robot", "congruent-clearance", "congruent-man"]
    {
        let written = fs::read_to_string(out.join(format!("{page}.1"))).unwrap();
        assert!(written.contains(".SH NAME") && written.contains(&page.replace('-', "\\-")), "{page}");
    }
    let help = congruent(&["--help"]).stdout;
    let named = commands_in(&help);
    for command in &named {
        assert!(out.join(format!("congruent-{command}.1")).is_file(), "{command}");
    }
    assert!(named.len() > 20, "{named:?}");
}

/// What a command prints on a terminal of 80 columns, without its colours; `None` without the program `script`, which makes
/// one.
#[cfg(target_os = "linux")]
fn on_a_terminal(arguments: &str) -> Option<String> {
    let command =
        format!("stty cols 80 rows 24; {} {arguments} --color never", env!("CARGO_BIN_EXE_congruent"));
    let mut script = Command::new("script");
    script.args(["-q", "-e", "-c", &command, "/dev/null"]).current_dir(crate::support::corpus::workspace());
    let answer = script.stdin(std::process::Stdio::null()).output().ok()?;
    let written = String::from_utf8(answer.stdout).unwrap().replace('\r', "");
    // Progress, of a command that takes longer on a busy machine, is erased before the answer.
    let shown = written.split_inclusive('\n').map(|line| line.rsplit("\u{1b}[2K").next().unwrap_or(line));
    Some(shown.collect())
}

/// Lines to paste stay whole, as do snippets of files.
#[cfg(target_os = "linux")]
fn is_verbatim(line: &str) -> bool {
    line.contains(" = ") || line.contains(['│', '╭', '╰', '·']) || !line.trim().contains(' ')
}

#[cfg(target_os = "linux")]
#[test]
fn on_a_terminal_every_command_fits_its_columns() {
    for arguments in [
        "check robots/ur5e",
        "check robots/ur5e/wrong_convention.toml",
        "fk robots/panda",
        "jacobian robots/ur5e --link tool0",
        "dynamics robots/panda",
        "manipulability robots/planar_2r",
        "sensitivity robots/ur5e",
        "tolerances robots/ur5e --a 1mm --alpha 1deg --normal 3",
        "tolerances robots/ur5e/ur5e.urdf --rpy 5deg --tolerance 1mm",
        "clearance robots/panda",
        "workspace robots/planar_2r",
        "describe robots/panda",
        "schema",
        "fk robots/ur5e --at elbow=1.2",
        "run --help",
        "calibrate --help",
    ] {
        let Some(text) = on_a_terminal(arguments) else { return };
        assert!(text.lines().count() > 2, "{arguments}: {text}");
        for line in text.lines().filter(|line| !is_verbatim(line)) {
            assert!(line.chars().count() <= 80, "{arguments}: {} columns: {line}", line.chars().count());
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_table_that_is_too_wide_is_whole_on_a_terminal() {
    let Some(shown) = on_a_terminal("fk robots/panda") else { return };
    let words = |text: &str| {
        let mut words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
        words.sort();
        words.dedup();
        words
    };
    assert_eq!(words(&shown), words(&congruent(&["fk", "robots/panda"]).stdout));
}
