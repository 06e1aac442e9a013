//! The blocks of a page that do something: files that are shown and commands that are run.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// A page of the guide, or the README.
pub(crate) struct Page {
    pub(crate) path: PathBuf,
    /// Its path from the root of the project.
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) blocks: Vec<Block>,
}

/// A block of code that does something.
pub(crate) enum Block {
    /// A file, whose name is behind the language: `toml file=arm/robot.toml`.
    File { path: String, text: String },
    /// Commands, `sh` or `console`; the last one ends with this exit code: `console exit=1`.
    Commands { line: usize, exit: i32, commands: Vec<Command> },
}

/// One command and the lines of what it prints that are shown; without any the text is not compared.
pub(crate) struct Command {
    /// As it is written, with `$ ` and line ends.
    pub(crate) written: String,
    /// As the shell gets it.
    pub(crate) text: String,
    pub(crate) shown: Vec<String>,
}

impl Page {
    pub(crate) fn new(path: &Path, root: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let name = path.strip_prefix(root).unwrap().to_str().unwrap().to_owned();
        Self { path: path.to_owned(), name, blocks: blocks(&text), text }
    }

    /// The number of commands.
    pub(crate) fn count(&self) -> usize {
        let count = |block: &Block| match block {
            Block::Commands { commands, .. } => commands.len(),
            Block::File { .. } => 0,
        };
        self.blocks.iter().map(count).sum()
    }
}

/// The README and every page under `docs/`, by name.
pub(crate) fn pages() -> Vec<Page> {
    let root = root();
    let mut paths = vec![root.join("README.md")];
    let mut folders = vec![root.join("docs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                paths.push(path);
            }
        }
    }
    paths.sort();
    paths.iter().map(|path| Page::new(path, &root)).collect()
}

/// The root of the workspace; tests run in the folder of their package.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut lines = text.split_inclusive('\n').enumerate();
    while let Some((number, line)) = lines.next() {
        let Some(info) = line.strip_prefix("```").map(str::trim) else { continue };
        let body: Vec<&str> =
            lines.by_ref().map(|(_, line)| line).take_while(|line| !line.starts_with("```")).collect();
        let option = |name: &str| info.split_whitespace().find_map(|word| word.strip_prefix(name));
        let language = info.split_whitespace().next().unwrap_or_default();
        if let Some(path) = option("file=") {
            blocks.push(Block::File { path: path.to_owned(), text: body.concat() });
        } else if language == "console" || language == "sh" {
            let exit = option("exit=").map_or(0, |code| code.parse().unwrap());
            blocks.push(Block::Commands { line: number + 1, exit, commands: commands(language, &body) });
        }
    }
    blocks
}

/// In `console` a command begins with `$ `; in `sh` every line is one. A line that ends with `\` goes on in the next.
fn commands(language: &str, body: &[&str]) -> Vec<Command> {
    let mut commands: Vec<Command> = Vec::new();
    let mut goes_on = false;
    for line in body {
        let text = match line.strip_prefix("$ ") {
            Some(text) if language == "console" && !goes_on => text,
            None if language == "console" && !goes_on => {
                let command = commands.last_mut().expect("a console block begins with a command");
                command.shown.push((*line).to_owned());
                continue;
            }
            _ => line,
        };
        if goes_on {
            let command = commands.last_mut().expect("it went on");
            command.written.push_str(line);
            command.text.push_str(text);
        } else if !text.trim().is_empty() {
            let text = text.to_owned();
            commands.push(Command { written: (*line).to_owned(), text, shown: Vec::new() });
        }
        goes_on = line.trim_end().ends_with('\\');
    }
    commands
}
