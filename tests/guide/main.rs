//! The README and the guide in `docs/`: every command in them is run in a copy of the project's robots and scenarios, and
//! prints what is shown. `GUIDE=update cargo test --release -p congruent-cli --test guide` writes what is printed into the
//! pages instead, in the lines that are shown; the change is then read in the diff.

#![cfg(unix)] // the commands are lines of a shell
#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod alignment;
mod causes;
mod figures;
mod inline;
mod page;
mod sandbox;

use std::{fs, thread};

use page::Page;
use sandbox::Sandbox;

/// Runs every block of a page; what differs, or the page as it should be.
fn play(page: &Page) -> Result<String, String> {
    let sandbox = Sandbox::new();
    let (mut faults, mut changed) = (Vec::new(), page.text.clone());
    for block in &page.blocks {
        match block {
            page::Block::File { path, text } => sandbox.write(path, text),
            page::Block::Commands { line, exit, commands } => {
                for (at, command) in commands.iter().enumerate() {
                    let expected = if at + 1 == commands.len() { *exit } else { 0 };
                    let answer = sandbox.run(&command.text);
                    let place = format!("{}:{}: $ {}", page.name, line, command.text);
                    if answer.code != expected {
                        faults.push(format!("{place}\nexit code {}: {}", answer.code, answer.printed));
                    } else if let Err(fault) = alignment::compare(&command.shown, &answer.printed) {
                        let old = [command.written.as_str(), &command.shown.concat()].concat();
                        let new = alignment::updated(&command.shown, &answer.printed);
                        changed = changed.replacen(&old, &(command.written.clone() + &new), 1);
                        faults.push(format!("{place}\n{fault}"));
                    }
                }
            }
        }
    }
    faults.extend(figures::compare(&sandbox, is_update()));
    if faults.is_empty() || is_update() { Ok(changed) } else { Err(faults.join("\n\n")) }
}

fn is_update() -> bool {
    std::env::var("GUIDE").is_ok_and(|value| value == "update")
}

#[test]
fn every_command_prints_what_is_shown() {
    let pages = page::pages();
    let played: Vec<Result<String, String>> = thread::scope(|scope| {
        let running: Vec<_> = pages.iter().map(|page| scope.spawn(|| play(page))).collect();
        running.into_iter().map(|page| page.join().unwrap()).collect()
    });
    let commands: usize = pages.iter().map(Page::count).sum();
    assert!(commands > 100, "{commands} commands were found");
    let mut faults = Vec::new();
    for (page, played) in pages.iter().zip(played) {
        match played {
            Ok(text) if text != page.text => fs::write(&page.path, text).unwrap(),
            Ok(_) => {}
            Err(fault) => faults.push(fault),
        }
    }
    assert!(faults.is_empty(), "{}\nGUIDE=update writes what is printed", faults.join("\n\n"));
}
