//! Robots as texts, checked without files and with the URDF's own chain in place of the physics.

use std::{fs, path::Path, sync::Arc};

use congruent_agreement::{
    compare::{Agreement, CheckOptions, CheckReport, check, diagnose},
    diagnosis::Cause,
    report::{Fault, ReportedCause, ReportedDiagnosis},
};
use congruent_description::{RequestedTolerance, RobotDescription, Tolerance, parse_robot};
use congruent_input::SourceFile;
use congruent_kinematics::UrdfTree;

/// The text of a robot file and of its URDF.
#[derive(Clone)]
pub(crate) struct Texts {
    pub(crate) name: String,
    pub(crate) robot_file: String,
    pub(crate) urdf: String,
}

/// The lines of a robot file without the sections of its dynamics, of which the advice here is not.
fn geometry(lines: &[&str]) -> String {
    let mut is_kept = true;
    let kept = lines.iter().filter(|line| {
        if line.starts_with('[') {
            is_kept = !line.starts_with("[dynamics]") && !line.starts_with("[[inertial]]");
        }
        is_kept
    });
    kept.copied().collect::<Vec<&str>>().join("\n") + "\n"
}

/// The robots of `robots/`.
pub(crate) fn all() -> Vec<Texts> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let mut folders: Vec<_> = fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path()).collect();
    folders.sort();
    let texts = |folder: &std::path::PathBuf| {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let robot_file = fs::read_to_string(folder.join("robot.toml")).unwrap();
        let urdf = fs::read_to_string(folder.join(format!("{name}.urdf"))).unwrap();
        // Nothing is opened, so there is no SRDF.
        let without_srdf: Vec<&str> = robot_file.lines().filter(|line| !line.starts_with("srdf")).collect();
        Texts { name, robot_file: geometry(&without_srdf), urdf }
    };
    folders.iter().map(texts).collect()
}

impl Texts {
    pub(crate) fn named(name: &str) -> Self {
        all().into_iter().find(|texts| texts.name == name).unwrap()
    }

    /// The report under a tolerance that nobody has declared, in m and rad alike.
    #[track_caller]
    pub(crate) fn check(&self, tolerance: f64) -> CheckReport {
        let description = self.described(tolerance);
        let mut physics = UrdfTree::new(&description.robot);
        check(&description, Ok(&mut physics), &CheckOptions::default()).unwrap()
    }

    /// The report under a tolerance that the robot file declares.
    #[track_caller]
    pub(crate) fn check_declared(&self, tolerance: f64) -> CheckReport {
        let described = self.described(tolerance);
        let declared_tolerance = RequestedTolerance::both(described.tolerance);
        let description = RobotDescription { declared_tolerance, ..described };
        let mut physics = UrdfTree::new(&description.robot);
        check(&description, Ok(&mut physics), &CheckOptions::default()).unwrap()
    }

    /// The diagnosis of the table alone, without certificates.
    #[track_caller]
    pub(crate) fn diagnose(&self, tolerance: f64) -> Vec<ReportedDiagnosis> {
        let description = self.described(tolerance);
        let mut physics = UrdfTree::new(&description.robot);
        diagnose(&description, &mut physics, CheckOptions::default().seed).unwrap()
    }

    #[track_caller]
    fn described(&self, tolerance: f64) -> RobotDescription {
        let source = |name: &str, text: &str| {
            Arc::new(SourceFile { path: name.into(), text: text.to_owned(), is_foreign: false })
        };
        let urdf = source(&format!("{}.urdf", self.name), &self.urdf);
        let mut description = parse_robot(Some(&source("robot.toml", &self.robot_file)), &urdf)
            .unwrap_or_else(|findings| panic!("{findings:?}\n{}", self.robot_file));
        description.tolerance = Tolerance { position_m: tolerance, orientation_rad: tolerance };
        description
    }

    /// With the lines of a cause in place of those of the file.
    pub(crate) fn corrected(&self, cause: &ReportedCause) -> Self {
        let parts = if cause.parts.is_empty() { vec![&cause.fault] } else { cause.parts.iter().collect() };
        let mut changes: Vec<_> = parts.iter().flat_map(|fault: &&Fault| &fault.changes).collect();
        changes.sort_by_key(|change| change.from_line);
        assert!(changes.windows(2).all(|pair| pair[0].to_line < pair[1].from_line), "{changes:?}");
        let mut lines: Vec<&str> = self.robot_file.lines().collect();
        for change in changes.iter().rev() {
            lines.splice(change.from_line - 1..change.to_line, [change.text.as_str()]);
        }
        Self { robot_file: lines.join("\n") + "\n", ..self.clone() }
    }
}

/// Whether a robot file can say the correction, in lines of its own or in those of another fault.
pub(crate) fn is_written(fault: &Fault) -> bool {
    // The lines of a joint's origin are of the URDF.
    (!fault.changes.is_empty() && fault.cause != Cause::JointOrigin)
        || fault.suggestion.starts_with("the lines of the other causes")
}

/// Whether the table agrees with the URDF.
pub(crate) fn agrees(report: &CheckReport) -> bool {
    report.verdict == Agreement::Agree
}
