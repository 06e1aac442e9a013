//! Gives bytes to the readers of the project, by the way a user's file goes: from a path, through every check, to what
//! the command would answer. The fuzz targets and the test of the saved corpus share this file.

use std::{fs, path::Path};

use congruent::{
    analysis::inverse::read_targets,
    calibration::measurements::read_measurements,
    configurations::{read_configurations, read_states},
    description::{RobotDescription, RobotQ, load_robot, parse_robot, read_mesh},
    input::{Capability, FileAccess, Findings, SourceFile},
    kinematics::UrdfTree,
    nalgebra::Vector3,
    recording::{inspect, scalars},
    results::trajectory_file,
    twin::RunSetup,
    writers::urdf_text,
};

/// A kind of file that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Urdf,
    Mjcf,
    RobotToml,
    Srdf,
    Scenario,
    Configurations,
    Targets,
    Measurements,
    Trajectory,
    Parquet,
    Playback,
    Stl,
    Obj,
    Dae,
    Recording,
}

impl Kind {
    /// Every kind with the name of its fuzz target and of its folder of the corpus, and the file that the bytes are
    /// written to.
    #[allow(dead_code, reason = "the fuzz targets name theirs")]
    pub const ALL: [(Self, &str); 15] = [
        (Self::Urdf, "urdf"),
        (Self::Mjcf, "mjcf"),
        (Self::RobotToml, "robot_toml"),
        (Self::Srdf, "srdf"),
        (Self::Scenario, "scenario"),
        (Self::Configurations, "configurations"),
        (Self::Targets, "targets"),
        (Self::Measurements, "measurements"),
        (Self::Trajectory, "trajectory"),
        (Self::Parquet, "parquet"),
        (Self::Playback, "playback"),
        (Self::Stl, "stl"),
        (Self::Obj, "obj"),
        (Self::Dae, "dae"),
        (Self::Recording, "recording"),
    ];

    fn file(self) -> &'static str {
        match self {
            Self::Urdf => "fuzzed.urdf",
            Self::Mjcf => "fuzzed.xml",
            Self::RobotToml => "fuzzed.toml",
            Self::Srdf => "fuzzed.srdf",
            Self::Scenario => "fuzzed_scenario.toml",
            Self::Configurations | Self::Targets => "fuzzed.json",
            Self::Measurements | Self::Trajectory | Self::Playback => "fuzzed.csv",
            Self::Parquet => "fuzzed.parquet",
            Self::Stl => "fuzzed.stl",
            Self::Obj => "fuzzed.obj",
            Self::Dae => "fuzzed.dae",
            Self::Recording => "fuzzed.rrd",
        }
    }
}

/// The robot that files other than a robot's are about: it turns, slides, follows and has shapes.
const ARM: &str = include_str!("arm.urdf");
/// It with a table, tool and SRDF.
const ROBOT: &str = "base = 'base'\ntip = 'tool'\nurdf = 'arm.urdf'\nsrdf = 'fuzzed.srdf'\n";
/// A scenario that plays `fuzzed.csv`.
const PLAYING: &str = "schema_version = 1\nname = 'playing'\nrobot = 'arm.urdf'\n[controller]\nkind = 'kinematic'\n[[motion]]\nplay_csv = 'fuzzed.csv'\n";

/// A folder with what the files under test refer to.
pub struct Readers {
    folder: tempfile::TempDir,
    arm: RobotDescription,
}

impl Readers {
    /// Makes the folder.
    ///
    /// # Panics
    /// It cannot be written.
    pub fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder for temporary files");
        for (name, text) in [("arm.urdf", ARM), ("robot.toml", ROBOT), ("playing.toml", PLAYING)] {
            fs::write(folder.path().join(name), text).expect("the folder can be written");
        }
        let arm = load_robot(&folder.path().join("arm.urdf")).expect("the arm is a robot");
        Self { folder, arm }
    }

    /// Gives the bytes to the reader of a kind of file. It may refuse them, in words.
    ///
    /// # Panics
    /// A reader has a bug.
    pub fn read_everything(&self, kind: Kind, bytes: &[u8]) {
        let path = self.folder.path().join(kind.file());
        fs::write(&path, bytes).expect("the folder can be written");
        match kind {
            Kind::Urdf | Kind::RobotToml => {
                if let Ok(loaded) = as_text(load_robot(&path)) {
                    written_and_read_again(&loaded);
                }
            }
            Kind::Mjcf => {
                if let Ok(loaded) = as_text(load_robot(&path)) {
                    has_poses(&loaded);
                }
            }
            Kind::Srdf => _ = as_text(load_robot(&self.folder.path().join("robot.toml"))),
            Kind::Scenario => _ = as_text(RunSetup::load(&path, &[])),
            Kind::Playback => _ = as_text(RunSetup::load(&self.folder.path().join("playing.toml"), &[])),
            Kind::Configurations => {
                _ = as_text(read_configurations(&path, &self.arm.robot));
                _ = as_text(read_states(&path, &self.arm.robot));
            }
            Kind::Targets => _ = as_text(read_targets(&path, &self.arm.robot)),
            Kind::Measurements => _ = as_text(read_measurements(&path, &self.arm.robot, &[0, 1])),
            Kind::Trajectory | Kind::Parquet => rows(&path),
            Kind::Stl | Kind::Obj | Kind::Dae => self.mesh(kind.file()),
            Kind::Recording => {
                let _ = inspect(&path).map_err(|error| error.to_string());
                let _ = scalars(&path).map_err(|error| error.to_string());
            }
        }
    }

    fn mesh(&self, file: &str) {
        let access = FileAccess::default();
        let read = read_mesh(self.folder.path(), file, Vector3::new(1.0, -0.5, 2.0), &access);
        if let Ok(mesh) = as_text(read.map_err(Findings::from)) {
            let last = mesh.vertices_m.len();
            assert!(mesh.triangles.iter().flatten().all(|&corner| (corner as usize) < last));
            assert!(mesh.vertices_m.iter().all(|vertex| vertex.iter().all(|value| value.is_finite())));
        }
    }
}

/// The findings as text; [`Findings`] panics if a refusal has no reason.
fn as_text<T>(result: Result<T, Findings>) -> Result<T, ()> {
    result.map_err(|found| {
        for diagnostic in &found {
            assert!(!diagnostic.to_string().is_empty());
            let _ = diagnostic.line_column();
        }
    })
}

/// A robot that was accepted has poses.
fn has_poses(loaded: &RobotDescription) {
    for needed in [Capability::Kinematics, Capability::Clearance, Capability::Physics] {
        let _ = loaded.check_capability(needed);
    }
    let robot = &loaded.robot;
    let (tree, zero) = (UrdfTree::new(robot), RobotQ::zeros(robot.dof()));
    for link in robot.link_indices() {
        tree.root_from_link(&zero, link).expect("a robot's configuration");
    }
}

/// It can be written as well, and is the same when it is read again. A URDF cannot express all of an MJCF: a slide without limits.
fn written_and_read_again(loaded: &RobotDescription) {
    has_poses(loaded);
    let robot = &loaded.robot;
    let text = urdf_text(robot, Path::new("/"));
    let source = SourceFile { path: "written.urdf".into(), text, is_foreign: false }.into();
    // Meshes are not found again, which stops distances alone.
    let again = parse_robot(None, &source).expect("what is written is a URDF").robot;
    assert_eq!(again.joints().len(), robot.joints().len());
}

fn rows(path: &Path) {
    let Ok(mut rows) = trajectory_file::open(path) else { return };
    let mut row = Vec::new();
    while let Ok(true) = rows.next_row(&mut row) {}
}
