//! The smallest distance of a recording is that of the pairs that the checks judge.

#![expect(clippy::unwrap_used, reason = "a test stops if a value is missing")]

use std::path::Path;

use congruent_description::load_robot;
use congruent_monitors::verdict::Moment;
use congruent_recording::{RerunFormat, inspect};
use congruent_results::{Options, execute};
use congruent_scenario::{
    AgreementCheck, Check, CheckKind, ClearanceCheck, ObstacleSettings, OnViolation, Scenario,
    SimulationSettings, StartSettings,
};
use congruent_twin::RunSetup;

/// Of an arm at rest. Kind: rounding; worst seen 2e-17.
const DISTANCE_M: f64 = 1e-12;

fn clearance(ignore: &[[&str; 2]]) -> Check {
    Check::Clearance(ClearanceCheck {
        minimum_m: Some(0.001),
        minimum_mm: None,
        pairs: Vec::new(),
        ignore: ignore.iter().map(|pair| pair.map(str::to_owned)).collect(),
        passing: None,
        on_violation: OnViolation::default(),
    })
}

/// The smallest recorded distance of a UR5e at rest over a table, and the worst of the report.
fn least(checks: Vec<Check>) -> (f64, Option<Moment>) {
    let folder = tempfile::tempdir().unwrap();
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e");
    let table = ObstacleSettings {
        name: "table".to_owned(),
        box_m: Some([0.8, 1.1, 0.04]),
        xyz_m: Some([0.56, 0.04, -0.02]),
        ..ObstacleSettings::default()
    };
    let start = [("shoulder_lift_joint", -90.0), ("elbow_joint", 90.0), ("wrist_2_joint", -90.0)];
    let scenario = Scenario {
        name: "distances".to_owned(),
        simulation: SimulationSettings { duration_s: Some(0.05), ..SimulationSettings::default() },
        start: StartSettings {
            joints_deg: start.map(|(name, value)| (name.to_owned(), value)).into(),
            ..StartSettings::default()
        },
        obstacle: vec![table],
        check: checks,
        ..Scenario::default()
    };
    let setup = RunSetup::new(scenario, load_robot(&robot).unwrap()).unwrap();
    let options = Options { out: folder.path().to_owned(), recordings: vec![&RerunFormat], interrupt: None };
    let (report, results) = execute(&setup, &options, |_| ()).unwrap();
    let summary = inspect(&results.file("recording.rrd")).unwrap();
    let recorded = summary.scalars.iter().find(|scalar| scalar.path == "/clearance/minimum").unwrap();
    let check = report.checks.into_iter().find(|check| check.check == CheckKind::Clearance);
    (recorded.min.unwrap(), check.map(|mut check| check.measures.swap_remove(0).worst.unwrap()))
}

#[test]
fn the_smallest_distance_is_that_of_the_pairs_that_are_judged() {
    let (all_m, reported) = least(vec![clearance(&[])]);
    let nearest = reported.unwrap();
    assert!((all_m - nearest.value).abs() < DISTANCE_M, "{all_m} {nearest:?}");
    let (a, b) = nearest.subject.split_once("--").unwrap();
    let (judged_m, reported) = least(vec![clearance(&[[a, b]])]);
    assert!((judged_m - reported.unwrap().value).abs() < DISTANCE_M, "{judged_m}");
    assert!(judged_m > all_m + 1e-4, "{judged_m} {all_m}");
    // Without a check of distances, all that is measured.
    let unchecked_m = least(vec![Check::Agreement(AgreementCheck::default())]).0;
    assert!((unchecked_m - all_m).abs() < DISTANCE_M, "{unchecked_m} {all_m}");
}
