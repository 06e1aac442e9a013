//! Measurements as JSON: an array of objects with the keys of the poses of `congruent fk`.

use std::collections::BTreeMap;

use congruent_configurations::{configuration, unique_names};
use congruent_description::Robot;
use congruent_input::{Diagnostic, Findings, LineCounter, units::Unit};
use congruent_tables::JsonList;
use serde::Deserialize;

use super::{
    checks::{missing_joints, plausible},
    measured_row::{MeasuredRow, WrittenOrientation},
};
use crate::codes;

/// A file of measurements as a list.
const LIST: JsonList = JsonList {
    entry: "measurement",
    code: codes::measurements::JSON,
    help: r#"expected [{"q": {"joint": 0.1}, "translation_m": [0.5, 0, 0.3], "quaternion_wxyz": [1, 0, 0, 0]}]"#,
};

/// One measurement as it is written in the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenMeasurement {
    #[serde(deserialize_with = "unique_names")]
    q: BTreeMap<String, f64>,
    translation_m: Option<Vec<f64>>,
    translation_mm: Option<Vec<f64>>,
    quaternion_wxyz: Option<[f64; 4]>,
    rpy_deg: Option<[f64; 3]>,
    rpy_rad: Option<[f64; 3]>,
    rotation_vector_rad: Option<[f64; 3]>,
}

/// Parses a whole file.
pub(super) fn parse(text: &str, robot: &Robot, needed: &[usize]) -> Result<Vec<MeasuredRow>, Findings> {
    let mut lines = LineCounter::new(text);
    LIST.read(text, |written: WrittenMeasurement, place| {
        Ok(MeasuredRow { line: lines.line_column(place.start).0, ..row(&written, robot, needed)? })
    })
}

/// The orientation, by whichever key gives it.
fn orientation(written: &WrittenMeasurement) -> Result<Option<WrittenOrientation>, Diagnostic> {
    let refused = |message: String| Diagnostic::error(codes::measurements::ORIENTATION, message);
    let degrees = |rpy: [f64; 3]| rpy.map(|value| Unit::Angle.convert(value));
    let quaternion = written.quaternion_wxyz.map(WrittenOrientation::from_quaternion_wxyz);
    let mut given = [
        quaternion.transpose().map_err(refused)?,
        written.rpy_deg.map(|rpy| WrittenOrientation::RpyRad(degrees(rpy))),
        written.rpy_rad.map(WrittenOrientation::RpyRad),
        written.rotation_vector_rad.map(WrittenOrientation::RotationVectorRad),
    ]
    .into_iter()
    .flatten();
    match (given.next(), given.next()) {
        (_, Some(_)) => Err(refused("the orientation is given twice".to_owned())),
        (one, None) => Ok(one),
    }
}

fn row(written: &WrittenMeasurement, robot: &Robot, needed: &[usize]) -> Result<MeasuredRow, Diagnostic> {
    let q = configuration(&written.q, robot)?;
    let given =
        |coordinate: usize| written.q.contains_key(&robot.joint(robot.movable_joints()[coordinate]).name);
    if let Some(missing) = missing_joints(robot, needed, given) {
        let message = format!("no position for {missing}");
        return Err(Diagnostic::error(codes::measurements::MISSING_JOINT, message)
            .with_help("every joint of the chain needs its position in \"q\", in rad or m"));
    }
    let translation = match (&written.translation_m, &written.translation_mm) {
        (Some(_), Some(_)) => {
            let message = "both translation_m and translation_mm are given";
            return Err(Diagnostic::error(codes::measurements::REPEATED, message));
        }
        (Some(metres), None) => metres.clone(),
        (None, Some(millimetres)) => millimetres.iter().map(|&value| Unit::Length.convert(value)).collect(),
        (None, None) => Vec::new(),
    };
    if ![0, 2, 3].contains(&translation.len()) {
        let message = format!("the translation has {} coordinates, expected 3 or 2", translation.len());
        return Err(Diagnostic::error(codes::measurements::TRANSLATION, message)
            .with_help("give x, y, z, or x, y for a planar measurement"));
    }
    for &value in q.iter().chain(&translation) {
        let refused =
            |what| Diagnostic::error(codes::measurements::NUMBER, format!("the value {value} {what}"));
        plausible(value).map_err(refused)?;
    }
    let mut tip_in_base_m = [None; 3];
    for (coordinate, value) in tip_in_base_m.iter_mut().zip(&translation) {
        *coordinate = Some(*value);
    }
    let orientation = orientation(written)?;
    if translation.is_empty() && orientation.is_none() {
        return Err(Diagnostic::error(
            codes::measurements::NOTHING_MEASURED,
            "this measurement has neither a position nor an orientation",
        )
        .with_help(
            "add \"translation_m\": [x, y, z], and \"quaternion_wxyz\" if the orientation was measured",
        ));
    }
    Ok(MeasuredRow { line: 0, q, tip_in_base_m, orientation })
}
