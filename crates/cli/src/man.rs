//! `congruent man`: manual pages.

use std::{fs, path::PathBuf};

use clap_mangen::Man;
use congruent::input::Diagnostic;
use serde::Serialize;

use crate::{codes, failure::Failure, output::file::replace, terminal::print::Printer};

/// Manual pages: that of `congruent` on standard output, or one for each command in a folder.
///
/// To read one: `congruent man | man -l -`. To install all: `congruent man --out ~/.local/share/man/man1`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Write a page for each command to this folder, `congruent.1`, `congruent-run.1` and so on; pages that are there are
    /// replaced.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// A page, by its name.
struct Page {
    name: String,
    text: Vec<u8>,
}

/// The answer as JSON.
#[derive(Serialize)]
struct Pages {
    /// The files that were written.
    files: Vec<PathBuf>,
    /// The page of `congruent`, if there is no folder.
    page: Option<String>,
}

pub(crate) fn run(
    arguments: &Arguments,
    mut command: clap::Command,
    printer: &Printer,
) -> Result<u8, Failure> {
    command.build();
    let Some(folder) = &arguments.out else {
        let page = String::from_utf8_lossy(&page(&command)?.text).into_owned();
        let pages = Pages { files: Vec::new(), page: Some(page) };
        printer.verbatim(&pages, |pages| pages.page.clone().unwrap_or_default())?;
        return Ok(0);
    };
    fs::create_dir_all(folder).map_err(|error| {
        Diagnostic::error(codes::man::OUT, format!("cannot create the folder {}: {error}", folder.display()))
            .with_help("choose another folder with --out")
    })?;
    let mut files = Vec::new();
    for Page { name, text } in pages(&command)? {
        let file = folder.join(format!("{name}.1"));
        replace("--out", &file, &text, &[])?;
        files.push(file);
    }
    printer.result(&Pages { files, page: None }, |pages| {
        format!("{} pages in {}\n", pages.files.len(), folder.display())
    })?;
    Ok(0)
}

/// The pages of a command and of those below it.
fn pages(command: &clap::Command) -> Result<Vec<Page>, Failure> {
    let mut all = vec![page(command)?];
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        all.extend(pages(below)?);
    }
    Ok(all)
}

fn page(command: &clap::Command) -> Result<Page, Failure> {
    let mut text = Vec::new();
    // A built command knows its whole name: `congruent-new-robot`.
    let name = command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned();
    let command = command.clone().name(name.clone());
    Man::new(command).render(&mut text).map_err(|error| Failure::Machine(error.to_string()))?;
    Ok(Page { name, text })
}
