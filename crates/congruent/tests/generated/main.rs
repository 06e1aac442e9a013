//! Robots of any shape through the whole: written and read again they are the same, every model that they are converted to
//! agrees with the URDF, and one changed number is found.
//!
//! The robots are those of a seed, the same in each run; `CONGRUENT_SEED` gives others, `PROPTEST_CASES` more.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod robot;

use std::{cell::Cell, path::Path, sync::Arc};

use congruent::{
    agreement::{
        compare::{Agreement, CheckOptions},
        report::{Fault, ReportedCause},
    },
    analysis::conversion::{
        Conversion, ConversionReport, ConversionSource, ConversionTarget, DEFAULT_ACCURACY, RoundedAxes,
    },
    check,
    description::{Robot, RobotDescription, parse_robot, parse_urdf},
    kinematics::{UrdfTree, sample_configurations},
    writers::urdf_text,
};
use congruent_analysis::conversion::convert;
use congruent_input::{Findings, SourceFile, toml_string};
use proptest::{
    prelude::*,
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};

use self::robot::GeneratedRobot;

/// Poses of what was written and read again. Unit: m and rad; kind: rounding of a rotation as roll, pitch and yaw, up to eight
/// joints deep on an arm of some 8 m; 6,000 robots are within it.
const SAME_M_AND_RAD: f64 = 1e-12;

/// Chains that have no table: none moves, or axes are almost parallel, by the digits of files.
const REFUSED: [&str; 2] = ["convert::no_table", "convert::unproved"];

/// Runs a law on robots of the seed.
#[track_caller]
fn for_robots(cases: u32, law: impl Fn(GeneratedRobot, u64) -> Result<(), TestCaseError>) {
    let seed: u64 = std::env::var("CONGRUENT_SEED").map_or(1, |seed| seed.parse().unwrap());
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let cases = std::env::var("PROPTEST_CASES").map_or(cases, |cases| cases.parse().unwrap());
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &bytes));
    let outcome = runner.run(&(robot::robot(), any::<u64>()), |(robot, choice)| law(robot, choice));
    assert!(outcome.is_ok(), "CONGRUENT_SEED={seed}: {}", outcome.unwrap_err());
}

fn source(name: &str, text: &str) -> Arc<SourceFile> {
    Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
}

fn failed(found: &Findings, text: &str) -> TestCaseError {
    TestCaseError::fail(format!("{found}\n{text}"))
}

fn poses_are_same(one: &Robot, other: &Robot) -> Result<(), TestCaseError> {
    let trees = [one, other].map(UrdfTree::new);
    for q in sample_configurations(one, 1, 5) {
        for link in one.link_indices() {
            let [one, other] = trees.each_ref().map(|tree| tree.root_from_link(&q, link).unwrap());
            let [apart_m, turned_rad] = [one.distance_m(&other), one.angle_rad(&other)];
            prop_assert!(apart_m < SAME_M_AND_RAD && turned_rad < SAME_M_AND_RAD, "{apart_m} {turned_rad}");
        }
    }
    Ok(())
}

#[test]
fn what_is_written_is_read_again() {
    for_robots(256, |robot, _| {
        let text = robot.urdf();
        let robot = parse_urdf(&text).map_err(|found| failed(&found, &text))?;
        let written = urdf_text(&robot, Path::new("/"));
        let again = parse_urdf(&written).map_err(|found| failed(&found, &written))?;
        let names = |robot: &Robot| -> Vec<String> {
            let links = robot.links().iter().map(|link| link.name.clone());
            links.chain(robot.joints().iter().map(|joint| joint.name.clone())).collect()
        };
        prop_assert_eq!((robot.name(), names(&robot)), (again.name(), names(&again)));
        for (one, other) in robot.joints().iter().zip(again.joints()) {
            prop_assert_eq!((one.kind, one.limit, one.mimic), (other.kind, other.limit, other.mimic));
        }
        poses_are_same(&robot, &again)
    });
}

fn converted(
    description: &RobotDescription,
    to: ConversionTarget,
) -> Result<Option<ConversionReport>, TestCaseError> {
    let conversion = Conversion {
        from: Some(ConversionSource::Urdf),
        to,
        accuracy: DEFAULT_ACCURACY,
        seed: 1,
        rounded_axes: RoundedAxes::Kept,
    };
    match convert(description, &conversion) {
        Ok(report) => Ok(Some(report)),
        Err(found) if REFUSED.contains(&found.code.name) => Ok(None),
        Err(found) => Err(failed(&found.into(), "")),
    }
}

/// The robot with a table: as in its URDF, or with one value changed.
fn with_table(
    urdf: &str,
    report: &ConversionReport,
    section: &str,
) -> Result<RobotDescription, TestCaseError> {
    let [base, tip] = [&report.base, &report.tip].map(|name| toml_string(name));
    let text = format!("base = {base}\ntip = {tip}\n{section}");
    let (robot_file, urdf_file) = (source("robot.toml", &text), source("robot.urdf", urdf));
    parse_robot(Some(&robot_file), &urdf_file).map_err(|found| failed(&found, &text))
}

const TABLES: [ConversionTarget; 2] = [ConversionTarget::Standard, ConversionTarget::Modified];

#[test]
fn every_model_that_it_is_converted_to_agrees() {
    let [asked, made] = [Cell::new(0), Cell::new(0)];
    for_robots(40, |robot, _| {
        let urdf = robot.urdf();
        let description =
            parse_robot(None, &source("robot.urdf", &urdf)).map_err(|found| failed(&found, &urdf))?;
        for to in TABLES {
            asked.set(asked.get() + 1);
            let Some(report) = converted(&description, to)? else { continue };
            made.set(made.get() + 1);
            let section = report.robot_toml.clone().unwrap();
            let checked = check(&with_table(&urdf, &report, &section)?, &CheckOptions::default()).unwrap();
            prop_assert_eq!(
                checked.geometry.verdict,
                Agreement::Agree,
                "{}\n{:?}",
                section,
                checked.geometry.worst
            );
        }
        for to in [ConversionTarget::Poe, ConversionTarget::Urdf] {
            // The proof of the conversion is a part of it.
            converted(&description, to)?;
        }
        Ok(())
    });
    assert!(2 * made.get() > asked.get(), "{} tables of {}", made.get(), asked.get());
}

/// A value of a row, changed by a little: the section, the row's joint and what was changed.
fn changed(section: &str, choice: u64) -> Option<(String, String, String)> {
    let lines: Vec<&str> = section.lines().collect();
    let first_row = lines.iter().position(|line| line.starts_with("[[dh.row]]"))?;
    let key = |line: &str| line.split_once(" = ").map(|(key, _)| key.trim().to_owned());
    let is_value = |line: &&str| {
        key(line).is_some_and(|key| {
            ["a_m", "d_m", "alpha_rad", "theta_rad", "alpha_deg", "theta_deg"].contains(&key.as_str())
        })
    };
    let values: Vec<usize> = (first_row..lines.len()).filter(|&at| is_value(&lines[at])).collect();
    let at = *values.get(usize::try_from(choice).unwrap_or(0) % values.len().max(1))?;
    let (name, value) = lines[at].split_once(" = ")?;
    let value: f64 = value.split('#').next()?.trim().parse().ok()?;
    let joint = lines[..at].iter().rev().find_map(|line| line.strip_prefix("joint = "))?;
    let joint =
        toml::from_str::<std::collections::BTreeMap<String, String>>(&format!("joint = {joint}")).ok()?;
    let by = match name.rsplit_once('_')?.1 {
        "m" => 0.037,
        "deg" => 6.3,
        _ => 0.11,
    };
    let line = format!("{name} = {:?}", value + by);
    let text = lines[..at].iter().copied().chain([line.as_str()]).chain(lines[at + 1..].iter().copied());
    Some((text.collect::<Vec<_>>().join("\n"), joint["joint"].clone(), format!("{name} + {by}")))
}

fn names_joint(cause: &ReportedCause, joint: &str) -> bool {
    let names =
        |fault: &Fault| fault.joint.as_deref() == Some(joint) || fault.joints.iter().any(|it| it == joint);
    names(&cause.fault) || cause.parts.iter().any(names)
}

#[test]
fn one_changed_number_of_a_table_is_found() {
    let [asked, changes] = [Cell::new(0), Cell::new(0)];
    for_robots(40, |robot, choice| {
        asked.set(asked.get() + 1);
        let urdf = robot.urdf();
        let description =
            parse_robot(None, &source("robot.urdf", &urdf)).map_err(|found| failed(&found, &urdf))?;
        let Some(report) = converted(&description, TABLES[usize::from(choice % 2 == 1)])? else {
            return Ok(());
        };
        let section = report.robot_toml.clone().unwrap();
        let Some((section, joint, what)) = changed(&section, choice / 2) else { return Ok(()) };
        changes.set(changes.get() + 1);
        let checked =
            check(&with_table(&urdf, &report, &section)?, &CheckOptions::default()).unwrap().geometry;
        prop_assert_eq!(checked.verdict, Agreement::Disagree, "{} of {}\n{}", what, joint, section);
        let named = checked.diagnosis.iter().any(|cause| names_joint(cause, &joint));
        let also = checked.indistinguishable.iter().any(|other| names_joint(&other.cause, &joint));
        let explained = checked.diagnosis.first().is_some_and(|cause| cause.within_tolerance);
        let several = explained && !checked.indistinguishable.is_empty();
        let messages: Vec<&str> =
            checked.diagnosis.iter().map(|cause| cause.fault.message.as_str()).collect();
        prop_assert!(
            explained && (named || also || several),
            "{what} of {joint}: {messages:#?}\n{section}\n{urdf}"
        );
        Ok(())
    });
    assert!(2 * changes.get() > asked.get(), "{} changes of {}", changes.get(), asked.get());
}
