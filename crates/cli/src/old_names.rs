//! Names of commands and options in earlier versions: they work in this version, with a hint.

use std::ffi::{OsStr, OsString};

/// A call in today's names.
pub(crate) struct Renamed {
    /// All words, the name of the program first.
    pub(crate) words: Vec<OsString>,
    /// What is called how today; empty if the call has no old name.
    pub(crate) hints: Vec<String>,
}

impl Renamed {
    /// The call in today's names.
    pub(crate) fn from_words(words: &[OsString]) -> Self {
        let mut call = Self { words: words.to_vec(), hints: Vec::new() };
        let Some(at) = position_of_command(words) else { return call };
        match words[at].to_str() {
            Some("derive") => call.derive(at),
            Some("acm") => call.disabled_pairs(at),
            Some("faults") => {
                call.replace(at..=at, &["run", "--faults"], "`faults` is now `run --faults`");
            }
            Some("convert") => {
                call.rename(&["--output"], "--to");
            }
            Some("new") if words.get(at + 1).is_some_and(|word| word == "scenario") => {
                call.rename(&["--out"], "--to");
            }
            Some("calibrate") => call.noise(),
            _ => {}
        }
        call
    }

    fn derive(&mut self, at: usize) {
        if self.words.iter().any(|word| word == "--base-parameters") {
            return self.replace(
                at..=at,
                &["dynamics"],
                "`derive --base-parameters` is now `dynamics --base-parameters`",
            );
        }
        let hint = "`derive` is now `convert --to dh`";
        self.replace(at..=at, &["convert", "--from", "urdf"], hint);
        // The first hint has it already.
        let hints = self.hints.len();
        let names_model = self.rename(&["--convention"], "--to");
        self.rename(&["--out", "--output"], "--to");
        if !names_model && !asks_for_help(&self.words) {
            self.words.extend(["--to", "dh"].map(OsString::from));
        }
        self.hints.truncate(hints);
    }

    fn disabled_pairs(&mut self, at: usize) {
        let end = at + usize::from(self.words.get(at + 1).is_some_and(|word| word == "suggest"));
        self.replace(at..=end, &["clearance"], "`acm suggest` is now `clearance --write-srdf FILE`");
        let hints = self.hints.len();
        if !self.rename(&["--out"], "--write-srdf") && !asks_for_help(&self.words) {
            self.words.extend(["--write-srdf", "-"].map(OsString::from));
        }
        self.hints.truncate(hints);
    }

    /// `--noise-mm 0.1 --noise-deg 0.05` as `--noise 0.1mm,0.05deg`.
    fn noise(&mut self) {
        let parts = [("--noise-mm", "mm"), ("--noise-deg", "deg")].map(|(option, unit)| {
            let value = self.take_value(option)?;
            Some(format!("{}{unit}", value.to_string_lossy()))
        });
        let noise = parts.into_iter().flatten().collect::<Vec<_>>().join(",");
        if !noise.is_empty() {
            self.hints.push("`--noise-mm` and `--noise-deg` are now `--noise 0.1mm,0.05deg`".to_owned());
            self.words.push(OsString::from(format!("--noise={noise}")));
        }
    }

    fn replace(&mut self, range: std::ops::RangeInclusive<usize>, new: &[&str], hint: &str) {
        self.words.splice(range, new.iter().map(OsString::from));
        self.hints.push(hint.to_owned());
    }

    /// Renames options, with their values behind a space or a `=`; whether there was one.
    fn rename(&mut self, old: &[&str], new: &str) -> bool {
        let mut found = false;
        for word in &mut self.words {
            for old in old {
                let Some(renamed) = renamed(word, old, new) else { continue };
                *word = renamed;
                found = true;
                self.hints.push(format!("`{old}` is now `{new}`"));
            }
        }
        found
    }

    /// Removes an option; its value.
    fn take_value(&mut self, option: &str) -> Option<OsString> {
        let at = self.words.iter().position(|word| renamed(word, option, option).is_some())?;
        let word = self.words.remove(at);
        let behind =
            word.to_str().and_then(|word| word.split_once('=')).map(|(_, value)| OsString::from(value));
        behind.or_else(|| (at < self.words.len()).then(|| self.words.remove(at)))
    }
}

/// Puts `check` before a robot that is given without a command: `congruent ROBOT`.
pub(crate) fn with_command(mut words: Vec<OsString>, is_command: impl Fn(&str) -> bool) -> Vec<OsString> {
    let at = position_of_command(&words);
    let is_robot =
        |word: &OsStr| !word.to_str().is_some_and(&is_command) && std::path::Path::new(word).exists();
    if let Some(at) = at.filter(|&at| is_robot(&words[at])) {
        words.insert(at, OsString::from("check"));
    }
    words
}

fn asks_for_help(words: &[OsString]) -> bool {
    words.iter().any(|word| word == "--help" || word == "-h")
}

/// `--new=value` for `--old=value`, and `--new` for `--old`.
fn renamed(word: &OsStr, old: &str, new: &str) -> Option<OsString> {
    if word == old {
        return Some(OsString::from(new));
    }
    let value = word.to_str()?.strip_prefix(old)?.strip_prefix('=')?;
    Some(OsString::from(format!("{new}={value}")))
}

/// Where the command is: the first word that is no option of all commands.
fn position_of_command(words: &[OsString]) -> Option<usize> {
    let mut at = 1;
    while let Some(word) = words.get(at) {
        match word.to_str() {
            Some("--format" | "--color") => at += 2,
            Some(option) if option.starts_with('-') && option.len() > 1 => at += 1,
            _ => return Some(at),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(old: &str, new: &str) {
        let words: Vec<OsString> = old.split(' ').map(OsString::from).collect();
        let Renamed { words, hints } = Renamed::from_words(&words);
        assert_eq!(words.join(OsStr::new(" ")), OsStr::new(new));
        assert_eq!(hints.is_empty(), old == new, "{hints:?}");
    }

    #[test]
    fn calls_in_old_names_are_calls_in_new_ones() {
        check("c derive a.urdf", "c convert --from urdf a.urdf --to dh");
        check("c derive a.urdf --convention standard", "c convert --from urdf a.urdf --to standard");
        check(
            "c -q --format json derive a.urdf --convention=modified --out=a.toml --force",
            "c -q --format json convert --from urdf a.urdf --to=modified --to=a.toml --force",
        );
        check("c derive a --base-parameters", "c dynamics a --base-parameters");
        check("c acm suggest ur5e --samples 100", "c clearance ur5e --samples 100 --write-srdf -");
        check("c acm suggest ur5e --out a.srdf", "c clearance ur5e --write-srdf a.srdf");
        check("c faults a.toml b.toml", "c run --faults a.toml b.toml");
        check("c new scenario r --out s.toml", "c new scenario r --to s.toml");
        check(
            "c calibrate r m.csv --noise-deg=0.05 --noise-mm 0.1 -v",
            "c calibrate r m.csv -v --noise=0.1mm,0.05deg",
        );
    }

    #[test]
    fn other_calls_stay_as_they_are() {
        for call in [
            "c convert r --to poe --out p.txt",
            "c new robot a.urdf --out arm",
            "c run faults --out o",
            "c check derive",
            "c -v",
            "c",
        ] {
            check(call, call);
        }
    }

    #[test]
    fn a_robot_alone_is_checked() {
        let words = |text: &str| text.split(' ').map(OsString::from).collect::<Vec<_>>();
        let is_command = |word: &str| word == "src";
        assert_eq!(with_command(words("c -q Cargo.toml"), is_command), words("c -q check Cargo.toml"));
        // A command that is a folder here, and what does not exist.
        assert_eq!(with_command(words("c src"), is_command), words("c src"));
        assert_eq!(with_command(words("c chek a"), is_command), words("c chek a"));
    }
}
