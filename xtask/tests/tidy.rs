//! Keeps the architecture's absences and its map true.

mod support;

use std::fs;

use support::{ARROWS, all_sources, code_lines, crate_names, program_sources, read, root};

/// Crates that stand in one place of the sources only.
const PLACES: &[(&str, &str)] = &[
    ("rapier3d_f64", "crates/simulation/src"),
    ("parry3d_f64", "crates/proximity/src/hulls/"),
    ("mcap::", "crates/logs/src"),
    ("rusqlite", "crates/logs/src/db3/"),
    ("ruzstd::", "crates/logs/src/mcap/"),
    ("re_chunk::", "crates/recording/src"),
    ("re_log_encoding::", "crates/recording/src"),
    ("re_log_types::", "crates/recording/src"),
    ("re_protos::", "crates/recording/src"),
    ("re_sdk_types::", "crates/recording/src"),
    ("pyo3", "crates/python/src"),
];

/// Words that `kinematics` and `dynamics` do without: no I/O, no clock, no printing.
const NOT_IN_MATHEMATICS: &[&str] =
    &["std::fs", "std::io", "std::env", "std::time", "println!", "eprintln!", "rand::"];

/// Functions of the standard library whose last bit depends on the processor; the crate `libm` has the same on every one.
const NOT_THE_SAME_EVERYWHERE: &[&str] = &[
    "sin", "cos", "sin_cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp_m1",
    "exp2", "ln", "ln_1p", "log2", "log10", "powf", "cbrt", "hypot",
];
/// nalgebra's method of this name, which is compiled with the program.
const OF_A_ROTATION: (&str, &str) = ("crates/proximity/src/bodies/moving_body.rs", "powf");

/// Length of the map for each crate that it names, so that a new crate has room for its section.
const MAP_LINES_PER_CRATE: usize = 9;

/// Longest file before its tests.
const MOST_LINES: usize = 400;
/// Most lines of code of a crate: blank lines, comments and tests do not count.
const MOST_LINES_OF_CRATE: usize = 8_000;
/// Most modules that a `lib.rs` declares, so that the list is read without scrolling.
const MOST_MODULES: usize = 30;

#[test]
fn the_map_names_every_crate() {
    let map = read(&root().join("ARCHITECTURE.md"));
    let heading = |line: &str| Some(line.strip_prefix("### `crates/")?.trim_end_matches('`').to_owned());
    let mut mapped: Vec<String> = map.lines().filter_map(heading).collect();
    mapped.sort();
    assert_eq!(mapped, crate_names());
    assert!(map.lines().count() < MAP_LINES_PER_CRATE * mapped.len(), "ARCHITECTURE.md is a map, not a book");
}

#[test]
fn arrows_go_one_way() {
    for name in crate_names() {
        let (_, allowed) =
            ARROWS.iter().find(|(from, _)| *from == name).expect("a new crate needs its arrows");
        for to in crates_below(&name) {
            assert!(allowed.contains(&to.as_str()), "{name} -> {to} is no arrow of the architecture");
        }
    }
}

/// The crates of the workspace that a crate depends on.
fn crates_below(name: &str) -> Vec<String> {
    let manifest = read(&root().join("crates").join(name).join("Cargo.toml"));
    let dependencies = manifest.split("[dev-dependencies]").next().unwrap_or_default();
    let lines = dependencies.lines().filter_map(|line| line.strip_prefix("congruent-"));
    lines.map(|line| line.split(['.', ' ', '=']).next().unwrap_or_default().to_owned()).collect()
}

/// The fuzz targets are a workspace of their own, which no gate builds: without this, their lock has the crates of some earlier
/// day, and `cargo fuzz` changes it or, offline, stops.
#[test]
fn the_lock_of_the_fuzz_targets_has_every_crate() {
    let lock = read(&root().join("fuzz/Cargo.lock"));
    let is_library = |name: &String| !["cli", "python"].contains(&name.as_str());
    for name in crate_names().into_iter().filter(is_library) {
        let package = if name == "congruent" { name.clone() } else { format!("congruent-{name}") };
        let entry =
            lock.split("[[package]]").find(|entry| entry.contains(&format!("name = \"{package}\"\n")));
        let entry =
            entry.unwrap_or_else(|| panic!("fuzz/Cargo.lock lacks {package}: run `cargo metadata` in fuzz/"));
        for to in crates_below(&name) {
            let is_listed = entry.contains(&format!("\"congruent-{to}\""));
            assert!(
                is_listed,
                "fuzz/Cargo.lock: {package} lacks congruent-{to}: run `cargo metadata` in fuzz/"
            );
        }
    }
}

#[test]
fn engines_stay_in_their_places() {
    for (name, text) in all_sources().iter().filter(|(name, _)| name.contains("/src/")) {
        for (engine, place) in PLACES {
            let named =
                text.lines().any(|line| line.contains(engine) && !line.trim_start().starts_with("//"));
            assert!(!named || name.starts_with(place), "{name} names {engine}; only {place} may");
        }
    }
}

#[test]
fn mathematics_is_pure() {
    let is_pure = |name: &str| {
        ["crates/kinematics/src", "crates/dynamics/src"].iter().any(|place| name.starts_with(place))
    };
    for (name, text) in all_sources().iter().filter(|(name, _)| is_pure(name)) {
        for word in NOT_IN_MATHEMATICS {
            assert!(!text.contains(word), "{name} has {word}");
        }
    }
}

#[test]
fn elementary_functions_are_the_same_on_every_machine() {
    let is_of_a_crate = |name: &str| name.starts_with("crates/") && name.contains("/src/");
    let is_of_a_test = |name: &str| ["tests.rs", "_tests/", "/tests/"].iter().any(|part| name.contains(part));
    for (name, text) in all_sources().iter().filter(|(name, _)| is_of_a_crate(name) && !is_of_a_test(name)) {
        let code = text.lines().take_while(|line| *line != "#[cfg(test)]");
        for line in code.filter(|line| !line.trim_start().starts_with("//")) {
            for function in NOT_THE_SAME_EVERYWHERE {
                let is_used =
                    line.contains(&format!(".{function}(")) || line.contains(&format!("f64::{function}"));
                let is_known = OF_A_ROTATION == (name.as_str(), *function);
                assert!(
                    !is_used || is_known,
                    "{name} uses `{function}`, take that of the crate libm: {line}"
                );
            }
        }
    }
}

#[test]
fn files_are_short_and_open_with_their_job() {
    for (name, text) in all_sources() {
        assert!(text.starts_with("//!"), "{name} does not open with //!");
        let lines = text.lines().take_while(|line| *line != "#[cfg(test)]").count();
        assert!(lines <= MOST_LINES, "{name} has {lines} lines before its tests, the limit is {MOST_LINES}");
    }
}

#[test]
fn crates_are_small_enough_to_know() {
    for (name, files) in program_sources() {
        let lines: usize = files.iter().map(|(_, text)| code_lines(text).count()).sum();
        assert!(
            lines <= MOST_LINES_OF_CRATE,
            "crates/{name} has {lines} lines of code, the limit is {MOST_LINES_OF_CRATE}: make a crate of a folder that \
             the others use but that does not use them"
        );
        let lib = files.iter().find(|(file, _)| file.ends_with("src/lib.rs"));
        let is_module = |line: &&str| {
            let line = line.trim_start_matches("pub ").trim_start_matches("pub(crate) ");
            line.starts_with("mod ")
        };
        let modules = lib.map_or(0, |(_, text)| code_lines(text).filter(is_module).count());
        assert!(
            modules <= MOST_MODULES,
            "crates/{name}/src/lib.rs declares {modules} modules, the limit is {MOST_MODULES}: gather files of one \
             subject in a folder"
        );
    }
}

#[test]
fn the_engine_in_reports_is_the_one_of_the_manifest() {
    let manifest = read(&root().join("Cargo.toml"));
    let line = manifest.lines().find(|line| line.starts_with("rapier3d-f64 = ")).expect("rapier is declared");
    let version = line.split('"').nth(1).expect("a version").trim_start_matches('=');
    let source = read(&root().join("crates/simulation/src/lib.rs"));
    assert!(source.contains(&format!("\"rapier3d-f64 {version}\"")), "ENGINE is not {version}");
}

#[test]
fn the_viewer_that_recordings_name_is_the_one_of_the_manifest() {
    let manifest = read(&root().join("Cargo.toml"));
    let line = manifest.lines().find(|line| line.starts_with("re_sdk_types = ")).expect("rerun is declared");
    let version = line.split('"').nth(1).expect("a version").trim_start_matches('=');
    let source = read(&root().join("crates/recording/src/lib.rs"));
    assert!(
        source.contains(&format!("RERUN_VERSION: &str = \"{version}\"")),
        "RERUN_VERSION is not {version}"
    );
}

#[test]
fn ci_runs_the_test_command_of_the_readme() {
    let (readme, ci) = (read(&root().join("README.md")), read(&root().join(".ci/run")));
    let command =
        readme.lines().find(|line| line.starts_with("cargo test")).expect("the README's test command");
    assert!(ci.contains(command), ".ci/run does not call `{command}`");
}

#[test]
fn every_robot_says_where_its_figures_come_from() {
    for entry in fs::read_dir(root().join("robots")).expect("the folder of robots").flatten() {
        for file in ["robot.toml", "SOURCE.md"] {
            assert!(entry.path().join(file).is_file(), "{} has no {file}", entry.path().display());
        }
    }
}

/// Each statement of SECURITY.md names tests, which are somewhere in the workspace.
#[test]
fn statements_on_security_are_tested() {
    let sources: Vec<String> = all_sources().into_iter().map(|(_, text)| text).collect();
    let is_test = |name: &str| {
        let start = format!("fn {name}()");
        sources.iter().any(|text| text.contains(&start))
    };
    let text = read(&root().join("SECURITY.md"));
    let is_statement = |line: &&str| line.starts_with("| ") && !line.ends_with("| Test |");
    let mut statements = text.lines().filter(is_statement).peekable();
    assert!(statements.peek().is_some());
    for statement in statements {
        let (_, column) = statement.trim_end_matches(['|', ' ']).rsplit_once('|').expect("two columns");
        let names: Vec<&str> = column.split('`').skip(1).step_by(2).collect();
        assert!(!names.is_empty(), "no test: {statement}");
        for name in names {
            assert!(is_test(name), "{name} is no test: {statement}");
        }
    }
}
