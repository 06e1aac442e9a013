//! Checks that are evaluated again on a recording: what the run said follows from the series, and a series or a report that was
//! changed afterwards is found, with check, time and value.

#![expect(clippy::unwrap_used, reason = "a test stops if a value is missing")]

use std::path::{Path, PathBuf};

use congruent_input::{Override, Quantity};
use congruent_monitors::verdict::Status;
use congruent_recording::{Basis, Recheck, RecordingSummary, RerunFormat, recheck, scalars, scalars_csv};
use congruent_results::{Options, comparison::Scalars, execute};
use congruent_twin::RunSetup;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// A scenario of the repository, its setup, and what its recording holds.
struct Bench {
    scenario: PathBuf,
    overrides: Vec<Override>,
    summary: RecordingSummary,
    scalars: Scalars,
    _folder: tempfile::TempDir,
}

impl Bench {
    fn of(scenario: &str, overrides: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let overrides: Vec<Override> = overrides.iter().map(|text| text.parse().unwrap()).collect();
        let scenario = repository().join("scenarios").join(scenario);
        let setup = RunSetup::load(&scenario, &overrides).unwrap();
        let options =
            Options { out: folder.path().to_owned(), recordings: vec![&RerunFormat], interrupt: None };
        let (_, results) = execute(&setup, &options, |_| ()).unwrap();
        let (summary, scalars) = scalars(&results.file("recording.rrd")).unwrap();
        Self { scenario, overrides, summary, scalars, _folder: folder }
    }

    fn setup(&self, more: &[&str]) -> RunSetup {
        let more = more.iter().map(|text| text.parse().unwrap());
        let overrides: Vec<Override> = self.overrides.iter().cloned().chain(more).collect();
        RunSetup::load(&self.scenario, &overrides).unwrap()
    }

    fn recheck(&self) -> Recheck {
        recheck(&self.summary, &self.scalars, &self.setup(&[])).unwrap()
    }
}

#[track_caller]
fn agrees(found: &Recheck) {
    assert!(found.disagreements.is_empty(), "{:#?}", found.disagreements);
    assert!(found.same_verdict && found.same_limits);
    for check in &found.checks {
        assert_eq!(check.status.word(), check.recorded_status, "{}", check.check);
        assert_ne!(check.basis, Basis::Report, "{} is not evaluated", check.check);
    }
}

#[test]
fn a_run_with_every_kind_of_value_follows_from_its_recording() {
    let bench = Bench::of("ur5e_pick.toml", &[]);
    let found = bench.recheck();
    agrees(&found);
    assert_eq!(found.exit_code(), 0);
    assert!(found.gap_s > 0.009 && found.step_s < 0.0011, "{} {}", found.gap_s, found.step_s);
}

#[test]
fn a_stop_and_a_tool_at_another_pose_follow_from_their_recordings() {
    for scenario in ["ur5e_into_zone.toml", "faults/shifted_tool.toml"] {
        let found = Bench::of(scenario, &[]).recheck();
        assert!(
            found.disagreements.is_empty() && found.same_verdict,
            "{scenario}: {:#?}",
            found.disagreements
        );
        assert!(found.checks.iter().any(|check| check.status == Status::Fail), "{scenario}");
    }
}

#[test]
fn a_joint_that_was_moved_afterwards_is_found() {
    let mut bench = Bench::of("ur5e_pick.toml", &[]);
    let elbow = bench.scalars.get_mut("/joint/position/elbow_joint").unwrap();
    let (time_s, value) = &mut elbow[100];
    *value = 10.0; // far beyond its range and its setpoint
    let time_s = *time_s;
    let found = bench.recheck();
    assert_eq!(found.exit_code(), 1);
    for kind in ["limits", "tracking"] {
        let of_kind = found.disagreements.iter().find(|found| found.check.word() == kind);
        let at_s = of_kind.unwrap_or_else(|| panic!("{kind}: {:#?}", found.disagreements)).time_s.unwrap();
        assert!((at_s - time_s).abs() < 1e-9, "{kind} at {at_s} s");
    }
}

#[test]
fn a_link_error_and_a_worst_value_that_were_changed_are_found() {
    let bench = Bench::of("ur5e_pick.toml", &[]);
    for path in ["/agreement/position/tool0", "/check/1_agreement/position_m"] {
        let mut scalars = bench.scalars.clone();
        let (time_s, value) = &mut scalars.get_mut(path).unwrap()[50];
        *value = 0.25;
        let time_s = *time_s;
        let found = recheck(&bench.summary, &scalars, &bench.setup(&[])).unwrap();
        let first = &found.disagreements[0];
        assert_eq!(
            (first.check.word(), first.quantity.map(Quantity::name)),
            ("agreement", Some("position")),
            "{path}"
        );
        assert!((first.value.unwrap() - 0.25).abs() < 1e-12 && (first.time_s.unwrap() - time_s).abs() < 1e-9);
        assert_eq!(found.exit_code(), 1, "{path}");
    }
}

#[test]
fn a_report_that_was_changed_is_found() {
    let bench = Bench::of("ur5e_into_table.toml", &[]);
    agrees(&bench.recheck());
    let mut summary = bench.summary.clone();
    let clearance = &mut summary.run.as_mut().unwrap().checks[1];
    assert_eq!(clearance.check.word(), "clearance", "the checks of the scenario changed");
    clearance.status = Status::Pass;
    for measure in &mut clearance.measures {
        measure.worst.as_mut().unwrap().value = 0.5;
        measure.first_violation = None;
    }
    let found = recheck(&summary, &bench.scalars, &bench.setup(&[])).unwrap();
    let first = &found.disagreements[0];
    assert_eq!((first.check.word(), first.quantity.map(Quantity::name)), ("clearance", Some("distance")));
    assert!(first.value.unwrap() < 0.02 && first.time_s.unwrap() > 1.0);
    assert_eq!(found.exit_code(), 1);
}

#[test]
fn other_limits_give_another_verdict_and_other_checks_none() {
    let bench = Bench::of("ur5e_pick.toml", &[]);
    // 33.8 mm are left.
    let found = recheck(&bench.summary, &bench.scalars, &bench.setup(&["check.2.minimum_m=0.05"])).unwrap();
    assert!(!found.same_limits && !found.same_verdict && found.disagreements.is_empty());
    assert_eq!((found.checks[1].status, found.exit_code()), (Status::Fail, 1));
    // What is known by the report alone has the limits of the scenario, too.
    for (at, limit) in
        [(3, "check.4.relative=1e-9"), (4, "check.5.relative=1e-9"), (5, "check.6.linear_m_s=1e-12")]
    {
        let found = recheck(&bench.summary, &bench.scalars, &bench.setup(&[limit])).unwrap();
        assert!(!found.same_limits, "{limit}");
        assert_eq!((found.checks[at].status, found.exit_code()), (Status::Fail, 1), "{limit}");
    }
    let mut summary = bench.summary.clone();
    summary.run.as_mut().unwrap().links[3].link = "of_another_robot".into();
    let error = recheck(&summary, &bench.scalars, &bench.setup(&[])).unwrap_err();
    assert!(error.to_string().contains("which has other links or joints"), "{error}");
    let mut scalars = bench.scalars.clone();
    let positions = scalars.remove("/joint/position/elbow_joint").unwrap();
    scalars.insert("/joint/position/joint_of_another_robot".to_owned(), positions);
    let error = recheck(&bench.summary, &scalars, &bench.setup(&[])).unwrap_err();
    assert!(error.to_string().contains("which has other links or joints"), "{error}");
    let other = RunSetup::load(&repository().join("scenarios/ur5e_weld.toml"), &[]).unwrap();
    let error = recheck(&bench.summary, &bench.scalars, &other).unwrap_err();
    assert!(error.to_string().contains("another scenario"), "{error}");
}

#[test]
fn what_is_not_in_the_recording_is_said_to_be_taken_from_the_report() {
    let mut bench = Bench::of("ur5e_pick.toml", &[]);
    bench.scalars.retain(|path, _| !path.starts_with("/joint/position/") && !path.starts_with("/check/"));
    let found = bench.recheck();
    assert_eq!(found.instants, 0);
    let by_report: Vec<&str> = found
        .checks
        .iter()
        .filter(|check| check.basis == Basis::Report)
        .map(|check| check.check.word())
        .collect();
    assert!(by_report.contains(&"clearance") && by_report.contains(&"dynamics"), "{by_report:?}");
    assert!(found.disagreements.is_empty(), "{:#?}", found.disagreements);
}

#[test]
fn the_table_has_every_value_at_its_time() {
    let bench = Bench::of("rrr_arm_wave.toml", &[]);
    let table = String::from_utf8(scalars_csv(&bench.summary, &bench.scalars)).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(names[0], "time_s");
    assert!(names[1..].iter().eq(bench.scalars.keys()));
    let mut read = Scalars::new();
    for record in reader.records() {
        let record = record.unwrap();
        let time_s: f64 = record[0].parse().unwrap();
        for (name, cell) in names.iter().zip(&record).skip(1).filter(|(_, cell)| !cell.is_empty()) {
            read.entry(name.clone()).or_default().push((time_s, cell.parse().unwrap()));
        }
    }
    assert_eq!(read, bench.scalars, "no value is lost, moved or made up");
}
