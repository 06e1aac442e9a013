//! JSON schemas of the files that are read and of the documents that are written: for editors that complete and
//! check while one types, and for programs in other languages.

use congruent_analysis::{
    base_parameters::BaseParameterReport,
    conversion::ConversionReport,
    description_summary::{DescriptionSummary, JointOrders},
    dynamics::{DynamicsStream, JointDynamicsReport},
    forward::{ForwardReport, PoseStream},
    inverse::InverseReport,
    jacobians::{JacobianReport, JacobianStream},
    manipulability::{DexterityStream, ManipulabilityReport},
    sensitivity::SensitivityReport,
    workspace::WorkspaceReport,
};
use congruent_calibration::{MeasuredCheck, report::CalibrationReport, same_point::SamePointReport};
use congruent_configurations::configurations_schema;
use congruent_description::robot_file_schema;
use congruent_identification::report::IdentificationReport;
use congruent_logs::LogSurvey;
use congruent_proximity::{DisabledPairs, DistanceReport};
use congruent_results::report::{FaultTable, RunReport};
use congruent_scenario::Scenario;
use congruent_sweep::{plan::sweep_plan_schema, store::SweepProgress, summary::SweepSummary};
use congruent_tolerances::ToleranceReport;
use schemars::{
    JsonSchema, Schema,
    generate::SchemaSettings,
    schema_for,
    transform::{RecursiveTransform, Transform},
};
use serde_json::Value;

use crate::{
    LintReport,
    check::RobotCheck,
    run_comparison::RunComparison,
    starter::{NewRobot, NewScenario},
    watch::WatchLine,
};

#[cfg(feature = "recording")]
use congruent_recording::RecordingSummary;

/// A kind of file or document that has a schema.
#[derive(Debug, Clone, Copy)]
pub struct Document {
    /// Its name: `robot`, `scenario`, `report`, or the command that prints it.
    pub name: &'static str,
    /// One line about the document, as `congruent schema` lists it.
    pub about: &'static str,
    make: fn() -> Schema,
}

impl Document {
    /// Every document, files that are read first.
    pub const ALL: &[Self] = &[
        Self::new("robot", "robot file (robot.toml)", robot_file_schema),
        Self::new("scenario", "scenario file", || schema_for!(Scenario)),
        Self::new(
            "configurations",
            "list of --configurations: an array; in JSON Lines, each line is one of its items",
            configurations_schema,
        ),
        Self::new("report", "report.json of a run, printed by `run`", written::<RunReport>),
        Self::new("sweep_plan", "plan of a sweep (*.sweep.toml)", sweep_plan_schema),
        Self::new("sweep", "summary of a sweep, printed by `sweep merge`", written::<SweepSummary>),
        Self::new("sweep_progress", "printed by `sweep status`", written::<SweepProgress>),
        Self::new("watch", "each line of the answer to a stream, printed by `watch`", written::<WatchLine>),
        Self::new(
            "faults",
            "table of faults against checks, printed by `run --faults`",
            written::<FaultTable>,
        ),
        Self::new("check", "report of one robot, printed by `check`", written::<RobotCheck>),
        Self::new(
            "measured_check",
            "comparison with measured poses, printed by `check --measurements`",
            written::<MeasuredCheck>,
        ),
        Self::new("lint", "findings about one file, printed by `lint`", written::<LintReport>),
        Self::new(
            "describe",
            "what a robot's files say, printed by `describe`",
            written::<DescriptionSummary>,
        ),
        Self::new(
            "joint_orders",
            "joints in the orders of programs, printed by `describe --orders`",
            written::<JointOrders>,
        ),
        Self::new("log", "survey of a log, printed by `describe` of a log", written::<LogSurvey>),
        Self::new("fk", "link poses, printed by `fk`", written::<ForwardReport<PoseStream<'static>>>),
        Self::new(
            "jacobian",
            "Jacobians, printed by `jacobian`",
            written::<JacobianReport<JacobianStream<'static>>>,
        ),
        Self::new(
            "dynamics",
            "torques and accelerations, printed by `dynamics`",
            written::<JointDynamicsReport<DynamicsStream<'static>>>,
        ),
        Self::new("ik", "solutions, printed by `ik`", written::<InverseReport>),
        Self::new(
            "manipulability",
            "ellipsoids, printed by `manipulability`",
            written::<ManipulabilityReport<DexterityStream<'static>>>,
        ),
        Self::new("workspace", "reach, printed by `workspace`", written::<WorkspaceReport>),
        Self::new("sensitivity", "sensitivities, printed by `sensitivity`", written::<SensitivityReport>),
        Self::new("tolerances", "errors by tolerances, printed by `tolerances`", written::<ToleranceReport>),
        Self::new("clearance", "distances, printed by `clearance`", written::<DistanceReport>),
        Self::new("acm", "pairs to disable, printed by `clearance --write-srdf`", written::<DisabledPairs>),
        Self::new("calibrate", "corrections, printed by `calibrate`", written::<CalibrationReport>),
        Self::new(
            "same_point",
            "corrections from touched points, printed by `calibrate --same-point`",
            written::<SamePointReport>,
        ),
        Self::new("identify", "parameters, printed by `identify`", written::<IdentificationReport>),
        Self::new("plan", "what a motion shows, printed by `plan`", written::<crate::identify::PlanReport>),
        Self::new(
            "convert",
            "model and proof, printed by `convert` and `derive`",
            written::<ConversionReport>,
        ),
        Self::new(
            "base_parameters",
            "base inertial parameters, printed by `derive --base-parameters`",
            written::<BaseParameterReport>,
        ),
        Self::new(
            "new_robot",
            "report on the robot file that was written, printed by `new robot`",
            written::<NewRobot>,
        ),
        Self::new(
            "new_scenario",
            "report on the scenario that was written, printed by `new scenario`",
            written::<NewScenario>,
        ),
        Self::new("compare", "differences of two runs, printed by `compare`", written::<RunComparison>),
        #[cfg(feature = "recording")]
        Self::new("inspect", "summary of a recording, printed by `inspect`", written::<RecordingSummary>),
        #[cfg(feature = "recording")]
        Self::new(
            "view",
            "joints over their ranges, printed by `view` of a robot",
            written::<crate::JointSweep>,
        ),
    ];

    const fn new(name: &'static str, about: &'static str, make: fn() -> Schema) -> Self {
        Self { name, about, make }
    }

    /// The document of this name.
    ///
    /// # Examples
    /// ```
    /// use congruent::schema::Document;
    /// let schema = Document::find("scenario").unwrap().schema();
    /// assert!(schema.get("properties").unwrap().get("controller").is_some());
    /// ```
    pub fn find(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|document| document.name == name)
    }

    /// Its JSON schema, draft 2020-12.
    pub fn schema(&self) -> Schema {
        let mut schema = (self.make)();
        // A key that may be left out has no value `null` that a file could give.
        let drop_null_default = |schema: &mut Schema| {
            if schema.get("default").is_some_and(Value::is_null) {
                schema.remove("default");
            }
        };
        RecursiveTransform(drop_null_default).transform(&mut schema);
        RecursiveTransform(plain_description).transform(&mut schema);
        schema
    }
}

/// The schema of a document as it is written: keys that are always written are required.
fn written<T: JsonSchema>() -> Schema {
    SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<T>()
}

/// Takes out of a description what only readers of the Rust documentation use: examples and links.
fn plain_description(schema: &mut Schema) {
    let Some(text) = schema.get("description").and_then(Value::as_str) else { return };
    let plain = text.split("\n\n# ").next().unwrap_or_default().replace("[`", "`").replace("`]", "`");
    schema.insert("description".to_owned(), plain.into());
}
