//! Recordings written by runs and read back: their content, scalars to the last bit, and the answers about files
//! that are cut off, corrupt or not recordings.

#![expect(clippy::unwrap_used, reason = "a test stops if a value is missing")]

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent_input::{FileAccess, RosPackages};
use congruent_monitors::{Recorder, RecordingError, Sample};
use congruent_recording::{
    EntitySummary, InspectError, RecordingSummary, RerunFormat, RerunRecorder, ScalarSummary, inspect,
};
use congruent_results::{
    Options, Recording as _, execute,
    report::{AfterRun, RunReport},
};
use congruent_twin::{Run, RunSetup};

/// A folder that goes away with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("congruent-recording-{test}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// A UR5e over a table, checked for agreement and clearance.
fn scenario(folder: &Folder, robot: &str) -> RunSetup {
    let text = format!(
        r#"
        schema_version = 1
        name = "short"
        robot = "{}/robots/{robot}"
        seed = 7
        [simulation]
        step_s = 0.001
        duration_s = 0.255
        [start]
        joints_deg = {{ shoulder_lift_joint = -90.0, elbow_joint = 90.0, wrist_2_joint = -90.0 }}
        [controller]
        kind = "kinematic"
        [[motion]]
        move_joints_deg = {{ shoulder_pan_joint = 20.0 }}
        duration_s = 0.21
        [[obstacle]]
        name = "table"
        box_m = [0.8, 1.1, 0.04]
        xyz_m = [0.56, 0.04, -0.02]
        [[check]]
        kind = "agreement"
        position_m = 1e-9
        orientation_rad = 1e-9
        [[check]]
        kind = "clearance"
        minimum_m = 0.001
        [expect]
        verdict = "pass"
        "#,
        repository().display()
    );
    load(folder, &text)
}

fn load(folder: &Folder, text: &str) -> RunSetup {
    let path = folder.file("scenario.toml");
    fs::write(&path, text).unwrap();
    let access = FileAccess::new(RosPackages::default(), &[repository()]).unwrap();
    RunSetup::load_with(&path, &[], &access).unwrap()
}

/// Runs a scenario; returns its report and the path of its recording.
fn recorded(folder: &Folder, out: &str, scenario: &RunSetup) -> (RunReport, PathBuf) {
    let options = Options { out: folder.file(out), recordings: vec![&RerunFormat], interrupt: None };
    let (report, results) = execute(scenario, &options, |_| ()).unwrap();
    (report, results.file("recording.rrd"))
}

#[track_caller]
fn entity<'a>(summary: &'a RecordingSummary, path: &str) -> &'a EntitySummary {
    let found = summary.entities.iter().find(|entity| entity.path == path);
    found.unwrap_or_else(|| panic!("no {path} among {:?}", summary.entities))
}

#[track_caller]
fn scalar<'a>(summary: &'a RecordingSummary, path: &str) -> &'a ScalarSummary {
    summary.scalars.iter().find(|scalar| scalar.path == path).unwrap()
}

/// Samples every 10 ms from 0 to 0.25 s, and the last at 0.255 s.
const ROWS: u64 = 27;

#[test]
fn a_run_is_read_back() {
    let folder = Folder::new("read_back");
    let (report, path) = recorded(&folder, "out", &scenario(&folder, "ur5e"));
    let summary = inspect(&path).unwrap();
    assert!(summary.complete && summary.has_layout && summary.problems.is_empty(), "{:?}", summary.problems);
    assert_eq!(summary.application_id, "congruent short");
    assert_eq!(summary.verdict.as_deref(), Some("as_expected"));
    assert_eq!(summary.report, Some(serde_json::to_value(&report).unwrap()));
    assert_eq!(summary.properties["congruent/trajectory_sha256"], report.trajectory_sha256.as_str());
    assert_eq!(summary.properties["congruent/seed"], 7);

    let names: Vec<_> = summary.timelines.iter().map(|timeline| timeline.name.as_str()).collect();
    assert_eq!(names, ["sim_time", "step"], "no wall clock");
    assert_eq!((summary.timelines[0].first, summary.timelines[0].last), (0, 255_000_000));
    assert_eq!(summary.timelines[1].last, 255);

    let forearm = entity(&summary, "/world/twin/forearm_link");
    assert!(forearm.components.iter().any(|name| name == "Transform3D:quaternion"), "{forearm:?}");
    for path in
        ["/world/model/forearm_link", "/world/obstacle/table", "/status/pass/agreement", "/log", "/summary"]
    {
        entity(&summary, path);
    }
    for path in ["/agreement/position/tool0", "/agreement/orientation/tool0", "/joint/position/elbow_joint"] {
        assert_eq!(scalar(&summary, path).count, ROWS, "{path}");
    }
    assert_eq!(scalar(&summary, "/agreement/position/tolerance").max, Some(1e-9));
    assert_eq!(scalar(&summary, "/clearance/limit").min, Some(0.001));
    assert_eq!(scalar(&summary, "/clearance/minimum").count, ROWS);
}

/// A recorder that keeps the errors and joint positions of the recorded samples.
struct RecorderWithCounts {
    recorder: RerunRecorder,
    tip: usize,
    errors_m: Vec<f64>,
    q: Vec<f64>,
    tip_from_tcp: nalgebra::Isometry3<f64>,
    /// Values of one joint and of the TCP, by path.
    others: Vec<(&'static str, f64)>,
}

impl Recorder for RecorderWithCounts {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if sample.step.is_multiple_of(10) || sample.step == 255 {
            self.errors_m.push(sample.errors[self.tip].position_m);
            self.q = sample.joints.state().q.to_vec();
            let (joints, elbow) = (&sample.joints, 2);
            let setpoint = joints.setpoint.unwrap();
            self.others = vec![
                ("/joint/velocity/elbow_joint", joints.state().qd[elbow]),
                ("/joint/effort/elbow_joint", joints.state().effort[elbow]),
                ("/joint/reference_position/elbow_joint", setpoint.q[elbow]),
                ("/joint/reference_velocity/elbow_joint", setpoint.qd[elbow]),
                ("/joint/measured_position/elbow_joint", joints.measured.q[elbow]),
                ("/tcp/twin/x_m", (sample.twin[self.tip] * self.tip_from_tcp).translation.x),
            ];
        }
        self.recorder.record(sample)
    }
}

/// Rows every 10 ms have the worst value of all steps since the row before: their largest is that of the report.
#[test]
fn what_checks_measure_is_recorded() {
    let folder = Folder::new("measures");
    let text = format!(
        r#"
        schema_version = 1
        name = "measures"
        robot = "{}/robots/ur5e"
        controller = {{ kind = "computed_torque", stiffness = 400.0, damping = 40.0 }}
        start = {{ joints_deg = {{ shoulder_lift_joint = -90.0, elbow_joint = 90.0, wrist_2_joint = -90.0 }} }}
        motion = [{{ move_joints_deg = {{ shoulder_pan_joint = 20.0, elbow_joint = 70.0 }}, duration_s = 0.5 }}]
        check = [
            {{ kind = "agreement" }},
            {{ kind = "twist" }},
            {{ kind = "dynamics" }},
            {{ kind = "power" }},
            {{ kind = "tracking", path_deg = 1.0, path_tcp_mm = 5.0 }},
            {{ kind = "limits" }},
            {{ kind = "invariants" }},
        ]
        "#,
        repository().display()
    );
    let (report, path) = recorded(&folder, "out", &load(&folder, &text));
    let summary = inspect(&path).unwrap();
    let mut compared = 0;
    for (index, check) in report.checks.iter().enumerate() {
        for measure in check.measures.iter().filter(|measure| measure.worst.is_some()) {
            let unit = measure.unit.symbol().replace('/', "_");
            let quantity = format!("{}{}{unit}", measure.quantity, if unit.is_empty() { "" } else { "_" });
            let path = format!("/check/{}_{}/{quantity}", index + 1, check.check);
            let found = scalar(&summary, &path);
            assert_eq!(found.max, measure.worst.as_ref().map(|worst| worst.value), "{path}");
            assert!(found.count >= 50, "{path}: {}", found.count);
            compared += 1;
        }
    }
    assert!(compared >= 12, "{compared}: {:#?}", report.checks);
}

#[test]
fn scalars_are_exact() {
    let folder = Folder::new("exact");
    let path = folder.file("recording.rrd");
    let scenario = scenario(&folder, "ur5e");
    let mut checks = scenario.checks();
    let mut run = Run::new(&scenario).unwrap();
    let sources = run.model().sources().to_vec();
    let names = run.names().clone();
    let recorder = RerunRecorder::create(&path, &scenario, &names, &sources).unwrap();
    let tip = scenario.description.tip.get();
    let mut counted = RecorderWithCounts {
        recorder,
        tip,
        tip_from_tcp: scenario.description.tip_from_tcp.unwrap(),
        errors_m: Vec::new(),
        q: Vec::new(),
        others: Vec::new(),
    };
    let (outcome, result) = run.finish(&mut checks, &mut counted, |_| ());
    result.unwrap();
    Box::new(counted.recorder)
        .finish(&RunReport::new(&scenario, &sources, outcome, AfterRun::default(), None))
        .unwrap();

    let summary = inspect(&path).unwrap();
    let error = scalar(&summary, "/agreement/position/tool0");
    assert_eq!(error.count, counted.errors_m.len() as u64);
    let bits = |value: f64| Some(value.to_bits());
    assert_eq!(error.last.map(f64::to_bits), bits(counted.errors_m[counted.errors_m.len() - 1]));
    assert_eq!(error.max.map(f64::to_bits), bits(counted.errors_m.iter().copied().fold(0.0, f64::max)));
    for (joint, q) in names.joints.iter().zip(&counted.q) {
        let recorded = scalar(&summary, &format!("/joint/position/{joint}"));
        assert_eq!(recorded.last.map(f64::to_bits), bits(*q), "{joint}");
    }
    for (path, value) in &counted.others {
        assert_eq!(scalar(&summary, path).last.map(f64::to_bits), bits(*value), "{path}");
    }
    assert_eq!(counted.others.len(), 6);
}

#[test]
fn a_disagreement_is_shown() {
    let folder = Folder::new("disagreement");
    let (report, path) = recorded(&folder, "out", &scenario(&folder, "ur5e/tool_5mm_off.toml"));
    assert_eq!(report.exit_code, 1);
    let summary = inspect(&path).unwrap();
    assert_eq!(summary.verdict.as_deref(), Some("not_as_expected"));
    let error = scalar(&summary, "/agreement/position/tool0");
    assert!((error.max.unwrap() - 0.005).abs() < 1e-9, "{error:?}");
    assert!(entity(&summary, "/world/error").rows > ROWS, "one arrow at every instant");
    assert!(entity(&summary, "/world/error/worst").rows > ROWS);
}

#[test]
fn equal_runs_give_equal_bytes() {
    let folder = Folder::new("bytes");
    let (_, first) = recorded(&folder, "first", &scenario(&folder, "ur5e"));
    let (_, second) = recorded(&folder, "second", &scenario(&folder, "ur5e"));
    assert!(fs::read(first).unwrap() == fs::read(second).unwrap());
}

#[test]
fn a_cut_file_is_read_as_far_as_it_goes() {
    let folder = Folder::new("cut");
    let (_, path) = recorded(&folder, "out", &scenario(&folder, "ur5e"));
    let whole = fs::read(path).unwrap();
    let cut = folder.file("cut.rrd");
    let mut entities = 0;
    for percent in [3, 20, 60, 99] {
        fs::write(&cut, &whole[..whole.len() * percent / 100]).unwrap();
        let summary = inspect(&cut).unwrap();
        assert!(!summary.complete, "{percent} %");
        assert!(summary.problems[0].contains("cut off"), "{:?}", summary.problems);
        assert!(summary.entities.len() >= entities, "{percent} %");
        entities = summary.entities.len();
    }
    assert!(entities > 60, "{entities}");
}

#[test]
fn a_corrupt_file_never_panics() {
    let folder = Folder::new("corrupt");
    let (_, path) = recorded(&folder, "out", &scenario(&folder, "ur5e"));
    let whole = fs::read(path).unwrap();
    let corrupt = folder.file("corrupt.rrd");
    let mut random = 7_u64;
    let mut next = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(random >> 33).unwrap()
    };
    for _ in 0..CORRUPT_FILES {
        let mut bytes = whole.clone();
        for _ in 0..8 {
            let place = next() % bytes.len();
            bytes[place] = next().to_le_bytes()[0];
        }
        fs::write(&corrupt, &bytes).unwrap();
        let _ = inspect(&corrupt);
    }
}

/// Enough to change every kind of message; three thousand were tried once.
const CORRUPT_FILES: usize = 40;

#[test]
fn other_files_are_refused() {
    let folder = Folder::new("refused");
    let file = folder.file("a.rrd");
    let refused = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        inspect(&file).unwrap_err()
    };
    assert!(matches!(refused(b""), InspectError::Empty { .. }));
    assert!(matches!(refused(b"RRF2"), InspectError::NotARecording { .. }));
    assert!(matches!(refused(b"<?xml version=\"1.0\"?><robot/>"), InspectError::NotARecording { .. }));
    assert!(matches!(refused(&[0xff; 4096]), InspectError::NotARecording { .. }));
    let header_only = b"RRF2\x00\x24\x03\x00\x01\x02\x00\x00";
    assert!(matches!(refused(header_only), InspectError::NoRecording { .. }));
    assert!(matches!(inspect(&folder.0), Err(InspectError::NotAFile { .. })));
    assert!(matches!(inspect(&folder.file("missing.rrd")), Err(InspectError::Read { .. })));
}

#[test]
fn names_are_never_parsed_as_paths() {
    let folder = Folder::new("odd_names");
    let urdf = r#"<robot name="odd_names">
        <link name="a/b"/>
        <link name="../x">
            <inertial>
                <mass value="1"/>
                <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>
            </inertial>
            <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
        </link>
        <link name="&lt;z&gt; $origin|"/>
        <joint name="j/1" type="continuous">
            <parent link="a/b"/><child link="../x"/><axis xyz="0 0 1"/>
        </joint>
        <joint name="fixed" type="fixed"><parent link="../x"/><child link="&lt;z&gt; $origin|"/></joint>
    </robot>"#;
    fs::write(folder.file("odd_names.urdf"), urdf).unwrap();
    let text = r#"
        schema_version = 1
        name = "../<odd_names>"
        robot = "odd_names.urdf"
        [simulation]
        step_s = 0.001
        duration_s = 0.02
        [controller]
        kind = "passive"
        [[check]]
        kind = "agreement"
        position_m = 1e-9
        orientation_rad = 1e-9
        [expect]
        verdict = "pass"
    "#;
    let (_, path) = recorded(&folder, "out", &load(&folder, text));
    let summary = inspect(&path).unwrap();
    assert!(summary.problems.is_empty(), "{:?}", summary.problems);
    assert_eq!(summary.application_id, "congruent ____odd_names_");
    for path in [r"/world/twin/a\/b", r"/world/model/..\/x", r"/joint/position/j\/1"] {
        entity(&summary, path);
    }
    let links = summary.entities.iter().filter(|entity| entity.path.starts_with("/world/twin/"));
    assert_eq!(links.count(), 3);
}

#[test]
fn a_file_that_cannot_be_written_is_an_error() {
    let folder = Folder::new("unwritable");
    let scenario = scenario(&folder, "ur5e");
    let run = Run::new(&scenario).unwrap();
    let (names, sources) = (run.names(), run.model().sources());
    let path = folder.file("no/such/folder.rrd");
    let error = RerunRecorder::create(&path, &scenario, names, sources).unwrap_err();
    assert!(error.to_string().contains("cannot write"), "{error}");
    // A full disk refuses the first bytes, which are flushed before the run starts.
    let full = Path::new("/dev/full");
    if full.exists() {
        let error = RerunRecorder::create(full, &scenario, names, sources).unwrap_err();
        assert!(error.to_string().contains("space"), "{error}");
    }
}
