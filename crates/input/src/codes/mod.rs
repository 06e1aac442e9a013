//! The codes of all findings: a number that never changes, a name, and an explanation.
//!
//! One table for the whole workspace, so that no number is given twice; `tests/codes.rs` of crate `description` compares it
//! with the sources. A number that is no longer used is never given again, since ignore lists and other programs refer to it.

mod commands;
mod files;
mod robot_file;
mod scenario;
mod scenario_checks;
mod tables;
mod urdf;

use std::fmt;

/// The codes of one kind of file: number, name, explanation.
struct Area {
    /// The middle of `CGR-URDF-017`.
    word: &'static str,
    codes: &'static [(u16, &'static str, &'static str)],
}

const AREAS: [&[Area]; 7] = [
    files::AREAS,
    urdf::AREAS,
    robot_file::AREAS,
    scenario::AREAS,
    scenario_checks::AREAS,
    tables::AREAS,
    commands::AREAS,
];

/// The stable number and name of a kind of finding.
///
/// # Examples
/// ```
/// use congruent_input::Code;
/// let code = Code::find("urdf::massless").unwrap();
/// assert_eq!(code.to_string(), "CGR-URDF-028");
/// assert_eq!(Code::find("cgr-urdf-028"), Some(code));
/// assert_eq!(Code::nearest("urdf::masless"), Some(code));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Code {
    area: &'static str,
    number: u16,
    /// The name, `area::fault`, that diagnostics have.
    pub name: &'static str,
    /// What is wrong, why it matters and what to do, perhaps with an example below it.
    pub about: &'static str,
}

/// The number in the form `CGR-URDF-017`.
impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CGR-{}-{:03}", self.area, self.number)
    }
}

impl Code {
    /// Every code, by area and number.
    pub fn all() -> impl Iterator<Item = Self> {
        AREAS.into_iter().flatten().flat_map(|area| {
            area.codes.iter().map(|&(number, name, about)| Self { area: area.word, number, name, about })
        })
    }

    /// The code with this name (`urdf::axis`) or number (`CGR-URDF-018`); upper and lower case are equal.
    pub fn find(word: &str) -> Option<Self> {
        Self::all()
            .find(|code| code.name.eq_ignore_ascii_case(word) || code.to_string().eq_ignore_ascii_case(word))
    }

    /// The code most similar to a word that is not a code.
    pub fn nearest(word: &str) -> Option<Self> {
        let numbers: Vec<String> = Self::all().map(|code| code.to_string()).collect();
        let known = Self::all().map(|code| code.name).chain(numbers.iter().map(String::as_str));
        let likeness = |name: &str| strsim::jaro_winkler(&name.to_lowercase(), &word.to_lowercase());
        let nearest = known.max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
        nearest.and_then(Self::find)
    }
}
