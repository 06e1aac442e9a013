//! Unit mistakes, planted in real robots: how many are found, and that no robot as it is published gets a warning.
//!
//! Each class is planted in a whole file, and in the first, the middle and the last element that it can be planted in. A
//! mistake counts as found if a finding of its class names the element; a value that is zero, or that means nothing (a
//! placeholder, the mass of a marker), is not planted.

#![cfg(unix)] // the files of a robot are linked into another folder
#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]
#![allow(clippy::print_stderr, reason = "the figures of the benchmark")]

#[path = "../../../../tests/support/corpus.rs"]
mod corpus;
mod plant;

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use congruent_description::load_robot_with;
use congruent_input::{Diagnostic, FileAccess, Findings, RosPackages};
use congruent_lint::unit_mistakes;

use plant::{CLASSES, Class, Planted, planted};

/// Classes of which fewer are found, with the least share in percent: a whole file in rpm is as a fast robot, and an effort limit in N mm
/// needs masses or other joints, and no placeholder.
const HARDER: [(&str, usize); 2] = [("joint velocity, rpm", 45), ("effort, N mm", 60)];
/// The least share of all other planted mistakes that must be found.
const LEAST_REPORTED: f64 = 0.95;

/// Names a folder of other robots, to measure on some that no bound was set on.
const UNSEEN: &str = "CONGRUENT_UNSEEN";

fn is_unseen() -> bool {
    std::env::var_os(UNSEEN).is_some()
}

/// Every URDF of the workspace and of the corpus that is published somewhere, or those of another folder.
fn robots(corpus: &Path) -> Vec<PathBuf> {
    let of_corpus = ["robots", "pairs", "logs"].map(|folder| corpus.join(folder)).into_iter();
    let mut open: Vec<PathBuf> = match std::env::var_os(UNSEEN) {
        Some(folder) => vec![folder.into()],
        None => of_corpus.chain([corpus::workspace().join("robots")]).collect(),
    };
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "urdf") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The findings about units of a file: of its text, and of its values compared with each other.
fn unit_warnings(path: &Path, access: &FileAccess) -> Option<Vec<Diagnostic>> {
    let description = load_robot_with(path, access).ok()?;
    let mut found = unit_mistakes(&description);
    found.extend(description.warnings);
    found.retain(|found| is_unit_warning(found.code.name));
    Some(found)
}

fn is_unit_warning(code: &str) -> bool {
    const OF_READING: [&str; 4] =
        ["urdf::degrees", "urdf::millimetres", "urdf::inertia_size", "urdf::center_of_mass"];
    code.starts_with("units::") || OF_READING.contains(&code)
}

fn access(corpus: &Path) -> FileAccess {
    let allowed = [corpus.to_owned(), corpus::workspace()];
    FileAccess::new(RosPackages::default(), &allowed).unwrap()
}

#[test]
fn no_published_robot_is_reported() {
    let Some(corpus) = corpus::corpus() else { return };
    let access = access(&corpus);
    let (mut judged, mut alarms) = (0, Vec::new());
    for path in robots(&corpus) {
        let Some(found) = unit_warnings(&path, &access) else { continue };
        judged += 1;
        alarms.extend(found.iter().map(|found| format!("{}: {}: {found}", path.display(), found.code.name)));
    }
    eprintln!("{judged} robots, {} false alarms", alarms.len());
    assert!(judged >= 25 || is_unseen(), "only {judged} robots were checked");
    assert!(alarms.is_empty(), "{}", alarms.join("\n"));
}

/// Whether a mistake is found: by a finding of its class about the element.
fn is_reported(found: &[Diagnostic], class: &Class, planted: &Planted) -> bool {
    let names = |found: &Diagnostic| {
        let Some(name) = &planted.element else { return true };
        let quoted = format!("\"{name}\"");
        let listed = found.kind.occurrences.iter().map(|each| &each.message);
        listed.chain([&found.message]).any(|message| message.contains(&quoted))
    };
    found.iter().any(|found| class.codes.contains(&found.code.name) && names(found))
}

/// A folder with links to what is in the folder of a robot, where its URDF can be another.
fn beside(robot: &Path) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(robot.parent().unwrap()).unwrap().flatten() {
        std::os::unix::fs::symlink(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    folder
}

#[test]
fn planted_mistakes_are_reported() {
    let Some(corpus) = corpus::corpus() else { return };
    let access = access(&corpus);
    let mut counts: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    let mut missed = Vec::new();
    for robot in robots(&corpus) {
        let Ok(description) = load_robot_with(&robot, &access) else { continue };
        let has_meshes = description.warnings.iter().all(|warning| !warning.code.name.starts_with("mesh::"));
        let text = fs::read_to_string(&robot).unwrap();
        let folder = beside(&robot);
        let path = folder.path().join("planted.urdf");
        // The scale of a mesh that is not there means nothing.
        for class in CLASSES.iter().filter(|class| has_meshes || !class.name.starts_with("mesh")) {
            for planted in planted(class, &text) {
                fs::write(&path, &planted.text).unwrap();
                // A refused file counts as found.
                let reported =
                    unit_warnings(&path, &access).is_none_or(|found| is_reported(&found, class, &planted));
                let count = counts.entry(class.name).or_default();
                count[0] += usize::from(reported);
                count[1] += 1;
                if !reported {
                    let what = planted.element.as_deref().unwrap_or("the whole file");
                    missed.push(format!("{}: {} of {what}", robot.display(), class.name));
                }
            }
        }
    }
    let sum = |counts: &mut dyn Iterator<Item = &[usize; 2]>| {
        counts.fold([0, 0], |sum, each| [sum[0] + each[0], sum[1] + each[1]])
    };
    // What a file in another unit often cannot show has a share of its own.
    let of_class = |class: &str| counts.iter().find(|(name, _)| **name == class);
    for (class, least) in HARDER {
        let [reported, all] = sum(&mut of_class(class).into_iter().map(|(_, count)| count));
        assert!(reported * 100 >= least * all, "{class}: {reported} of {all} are found");
    }
    let is_harder = |class: &str| HARDER.iter().any(|(harder, _)| *harder == class);
    let [reported, all] =
        sum(&mut counts.iter().filter(|(class, _)| !is_harder(class)).map(|(_, count)| count));
    for (class, [reported, all]) in &counts {
        eprintln!("{class:24} {reported:4} of {all:4}");
    }
    eprintln!("{reported} of {all}; missed:\n{}", missed.join("\n"));
    assert!(all > 1000 || is_unseen(), "only {all} mistakes were planted");
    #[expect(clippy::cast_precision_loss, reason = "some thousand")]
    let share = reported as f64 / all as f64;
    assert!(share >= LEAST_REPORTED, "{reported} of {all} are found");
}

/// What a robot file may have instead of what it has: a pattern, and what takes its place.
const IN_ROBOT_FILES: &[(&str, &str)] = &[
    ("$", "\n[tcp]\nxyz_m = [0, 0, 150]\n"),
    ("$", "\n[tcp]\nxyz_m = [0, 0, 15]\n"),
    ("$", "\n[tcp]\nxyz_m = [0, 20, 0]\n"),
    ("$", "\n[tcp]\nrpy_rad = [0, 90, 0]\n"),
    ("$", "\n[tcp]\nrpy_rad = [0, 0, 45]\n"),
    ("$", "\n[tcp]\nrpy_deg = [0, 1.5708, 0]\n"),
    ("a_m = (-?)0\\.([0-9]*[1-9])", "a_m = ${1}${2}00"),
    ("d_m = (-?)0\\.([0-9]*[1-9])", "d_m = ${1}${2}00"),
    ("alpha_deg = (-?)90(\\.0)?", "alpha_rad = ${1}90"),
    ("alpha_deg = (-?)90(\\.0)?", "alpha_deg = ${1}1.5708"),
    ("theta_deg = (-?)90(\\.0)?", "theta_rad = ${1}90"),
];

#[test]
fn mistakes_in_robot_files_are_reported() {
    let folder = corpus::workspace().join("robots");
    let allowed = [corpus::workspace()];
    let access = FileAccess::new(RosPackages::default(), &allowed).unwrap();
    let (mut planted, mut missed) = (0, Vec::new());
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let robot_file = entry.path().join("robot.toml");
        let Ok(text) = fs::read_to_string(&robot_file) else { continue };
        let is_reported = |text: &str| {
            let folder = beside(&robot_file);
            let path = folder.path().join("planted.toml");
            fs::write(&path, text).unwrap();
            let found =
                load_robot_with(&path, &access).map_or_else(Findings::into_vec, |robot| robot.warnings);
            let is_of_units = |found: &&Diagnostic| {
                ["robot_file::length", "robot_file::degrees", "robot_file::radians"]
                    .contains(&found.code.name)
            };
            found.iter().any(|found| is_of_units(&found))
        };
        assert!(!is_reported(&text), "{}", robot_file.display());
        for (pattern, replacement) in IN_ROBOT_FILES {
            let pattern = regex_lite::Regex::new(pattern).unwrap();
            let changed = pattern.replace(&text, *replacement);
            if changed == text || (replacement.contains("[tcp]") && text.contains("[tcp]")) {
                continue;
            }
            planted += 1;
            if !is_reported(&changed) {
                missed.push(format!("{}: {replacement}", robot_file.display()));
            }
        }
    }
    eprintln!("{} of {planted} in robot files are found", planted - missed.len());
    assert!(planted > 30, "only {planted} mistakes were planted");
    assert!(missed.len() * 20 <= planted, "{missed:#?}");
}
