//! The examples in the help of each command: they run in the root of the project.

use crate::sandbox::Sandbox;

/// The lines below `Examples:`.
fn examples(help: &str) -> Vec<String> {
    let below = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    below.map(|line| line.trim().to_owned()).take_while(|line| !line.is_empty()).collect()
}

#[test]
fn the_examples_of_every_command_run() {
    let (mut count, mut faults) = (0, Vec::new());
    for command in Sandbox::new().commands() {
        // Those of one command are read one after another.
        let sandbox = Sandbox::new();
        let examples = examples(&sandbox.run(&format!("congruent {command} --help")).printed);
        assert!(examples.len() >= 2, "{command}: {examples:?}");
        for example in examples {
            count += 1;
            let answer = sandbox.run(&example);
            // A scenario without a fault detects nothing, and points do not explain everything: these are answers.
            if ![0, 1].contains(&answer.code) {
                faults.push(format!("$ {example}: exit code {}: {}", answer.code, answer.printed));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 40, "{count} examples were found");
}
