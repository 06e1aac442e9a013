//! The README and the guide in `docs/`: every command in them is run in a copy of the project's robots and scenarios, and
//! prints what is shown. `GUIDE=update cargo test --release -p congruent-cli --test guide` writes what is printed into the
//! pages instead, in the lines that are shown; the change is then read in the diff.

#![cfg(unix)] // the commands are lines of a shell
#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod alignment;
mod causes;
mod examples;
mod figures;
mod inline;
mod page;
mod reference;
mod sandbox;

use std::{fs, thread};

use page::{Block, Command, Page};
use sandbox::Sandbox;

/// Runs every block of a page; what differs, or the page as it should be.
fn play(page: &Page) -> Result<String, String> {
    let sandbox = Sandbox::new();
    let (mut faults, mut changed) = (Vec::new(), page.text.clone());
    for block in &page.blocks {
        match block {
            Block::File { path, text } => sandbox.write(path, text),
            Block::Commands { line, exit, commands } => {
                let last = commands.len().saturating_sub(1);
                let played = commands.iter().enumerate().filter_map(|(at, command)| {
                    let exit = if at == last { *exit } else { 0 };
                    let (fault, update) = differs(command, exit, &sandbox)?;
                    Some((format!("{}:{line}: $ {}{fault}", page.name, command.text), update))
                });
                for (fault, [old, new]) in played {
                    changed = changed.replacen(&old, &new, 1);
                    faults.push(fault);
                }
            }
        }
    }
    for (plot, picture) in figures::differing(&sandbox) {
        if is_update() {
            fs::copy(&plot, &picture).unwrap();
        }
        faults.push(format!("{} is not what the command draws", picture.display()));
    }
    if faults.is_empty() || is_update() { Ok(changed) } else { Err(faults.join("\n\n")) }
}

/// Runs a command: what is other than its page shows, with the text of the page as it is and as it should be.
fn differs(command: &Command, exit: i32, sandbox: &Sandbox) -> Option<(String, [String; 2])> {
    let answer = sandbox.run(&command.text);
    let old = [command.written.as_str(), &command.shown.concat()].concat();
    if answer.code != exit {
        return Some((format!("exit code {}: {}", answer.code, answer.printed), [old.clone(), old]));
    }
    let fault = alignment::compare(&command.shown, &answer.printed).err()?;
    let new = command.written.clone() + &alignment::updated(&command.shown, &answer.printed);
    Some((fault, [old, new]))
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
