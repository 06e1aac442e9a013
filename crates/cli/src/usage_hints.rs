//! What to write instead of arguments that people guess: lists without commas, and options that have another name here.

use std::ffi::OsString;

use clap::{
    Command, Error,
    builder::StyledStr,
    error::{ContextKind, ContextValue},
};

use crate::quantity::QuantityArgument;

/// Options of other programs, the option that a command must have to answer the guess, and what to write.
const GUESSED: [(&[&str], &str, &str); 3] = [
    (
        &["--joint", "--joints", "--q", "--angles", "--positions"],
        "at",
        "--at JOINT=POSITION, once for each joint: --at elbow_joint=90deg",
    ),
    (&["--pose", "--position", "--pos", "--target"], "xyz", "--xyz 0.4,0.1,0.3 and --rpy 180deg,0,90deg"),
    (&["--orientation", "--euler"], "rpy", "--rpy 180deg,0,90deg"),
];

/// What explains a code, which people look for at the command that has printed it.
const EXPLAIN: &str = "a code is explained by `congruent explain CODE`";

/// The error about an unexpected argument with what to write instead, if that is known.
pub(crate) fn with_hint(mut error: Error, words: &[OsString], command: &Command) -> Error {
    // The first value of a list is refused before the rest is unexpected, if a robot is missing until then.
    let refused = error.get(ContextKind::InvalidValue).or(error.get(ContextKind::InvalidArg));
    let Some(ContextValue::String(unexpected)) = refused else { return error };
    let words: Vec<&str> = words.iter().filter_map(|word| word.to_str()).collect();
    let explained = (unexpected == "--explain").then(|| EXPLAIN.to_owned());
    let hint = explained
        .or_else(|| list_without_commas(&words, unexpected))
        .or_else(|| guessed(&words, unexpected, command));
    if let Some(hint) = hint {
        // What clap finds similar by its letters, as --quiet for --q, is not what was meant.
        if error.remove(ContextKind::SuggestedArg).is_some() {
            let used = words.iter().find_map(|word| command.find_subcommand(word));
            let usage = used
                .map(|used| format!("Usage: {} {} [OPTIONS] <ROBOT>", command.get_name(), used.get_name()));
            let usage = usage.map(|usage| ContextValue::StyledStr(StyledStr::from(usage)));
            usage.map(|usage| error.insert(ContextKind::Usage, usage));
        }
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(hint)]));
    }
    error
}

/// The list that was meant by several words with a number each, of which one is unexpected: `--xyz 0.4 0.1 0.3`.
fn list_without_commas(words: &[&str], unexpected: &str) -> Option<String> {
    let is_number = |word: &&str| QuantityArgument::parse(word.trim_matches(',')).is_ok();
    let (start, option) = words.iter().enumerate().find(|(at, word)| {
        let numbers = words[at + 1..].iter().take_while(|word| is_number(word));
        word.starts_with("--") && numbers.count() > 1
    })?;
    let numbers: Vec<&str> = words[start + 1..]
        .iter()
        .take_while(|word| is_number(word))
        .map(|word| word.trim_matches(','))
        .collect();
    // Of a negative number it names the sign and the first digit, as an option of one letter.
    let is_meant = numbers.iter().any(|number| number.starts_with(unexpected.trim_matches(',')));
    is_meant.then(|| format!("separate the values with commas and no spaces: {option} {}", numbers.join(",")))
}

/// The option that another program calls otherwise.
fn guessed(words: &[&str], unexpected: &str, command: &Command) -> Option<String> {
    let command = words.iter().find_map(|word| command.find_subcommand(word))?;
    let has = |name: &str| command.get_arguments().any(|argument| argument.get_long() == Some(name));
    let (.., write) =
        GUESSED.iter().find(|(guesses, option, _)| guesses.contains(&unexpected) && has(option))?;
    Some(format!("write {write}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::all_commands;

    #[track_caller]
    fn check(line: &str, expected: Option<&str>) {
        let words: Vec<OsString> = line.split(' ').map(OsString::from).collect();
        let mut command = all_commands();
        let error = command.try_get_matches_from_mut(words.clone()).unwrap_err();
        let text = with_hint(error, &words, &command).render().to_string();
        match expected {
            Some(expected) => assert!(text.contains(expected), "{line}: {text}"),
            None => assert!(!text.contains("commas") && !text.contains("write"), "{line}: {text}"),
        }
    }

    #[test]
    fn a_list_without_commas_is_answered_with_the_list() {
        check("congruent ik arm --xyz 0.4 0.1 0.3", Some("spaces: --xyz 0.4,0.1,0.3\n"));
        check("congruent ik arm --xyz 0.4, -0.1, 0.3", Some("spaces: --xyz 0.4,-0.1,0.3\n"));
        check("congruent ik --xyz 0.4 0.1 0.3 arm", Some("spaces: --xyz 0.4,0.1,0.3\n"));
        check("congruent ik arm --xyz 0.4,0.1,0.3 --rpy 180deg 0 0", Some("spaces: --rpy 180deg,0,0\n"));
        check("congruent fk arm 1", None);
    }

    #[test]
    fn an_option_of_another_program_is_answered_with_that_of_this_one() {
        check("congruent fk arm --joints 1,2", Some("write --at JOINT=POSITION"));
        check("congruent jacobian arm --q 1,2", Some("write --at JOINT=POSITION"));
        check("congruent ik arm --pose 1,2", Some("write --xyz 0.4,0.1,0.3"));
        check("congruent lint arm --joints 1,2", None);
        check(
            "congruent check --explain CGR-URDF-001",
            Some("tip: a code is explained by `congruent explain CODE`"),
        );
        check("congruent fk arm --q joint_1=10", Some("tip: write --at JOINT=POSITION"));
        check("congruent fk arm --q joint_1=10", Some("Usage: congruent fk [OPTIONS] <ROBOT>"));
    }

    #[test]
    fn both_ways_to_give_a_target_are_in_the_usage() {
        for line in ["congruent ik arm", "congruent ik arm --rpy 0,0,0"] {
            let mut command = all_commands();
            let error = command.try_get_matches_from_mut(line.split(' ')).unwrap_err();
            let text = error.render().to_string();
            assert!(text.contains("congruent ik <ROBOT> --xyz <X,Y,Z> [--rpy <ROLL,PITCH,YAW>]"), "{text}");
            assert!(text.contains("congruent ik <ROBOT> --targets <FILE>"), "{text}");
        }
    }
}
