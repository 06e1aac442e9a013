//! Measurements as JSON: an array of objects in the shape in which `congruent fk` answers.

use std::{collections::BTreeMap, ops::Range};

use congruent_description::{Diagnostic, Robot, line_column, units::Unit};
use serde::Deserialize;
use serde_json::value::RawValue;

use super::{MeasuredRow, from_quaternion_wxyz, from_rpy_rad, missing_joints};
use crate::batch::configuration;

/// One measurement as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    q: BTreeMap<String, f64>,
    translation_m: Option<Vec<f64>>,
    translation_mm: Option<Vec<f64>>,
    quaternion_wxyz: Option<[f64; 4]>,
    rpy_deg: Option<[f64; 3]>,
    rpy_rad: Option<[f64; 3]>,
}

/// Parses a whole file.
pub(super) fn parse(
    text: &str,
    robot: &Robot,
    needed: &[usize],
) -> Result<Vec<MeasuredRow>, Vec<Diagnostic>> {
    let entries: Vec<&RawValue> =
        serde_json::from_str(text).map_err(|error| vec![malformed(text, 0, &error)])?;
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    for (index, entry) in entries.iter().enumerate() {
        // The entry borrows from the text, so the difference of the addresses is its place.
        let start = entry.get().as_ptr().addr() - text.as_ptr().addr();
        let span = start..start + entry.get().len();
        match serde_json::from_str::<Written>(entry.get()) {
            Ok(written) => match row(&written, robot, needed) {
                Ok(row) => rows.push(MeasuredRow { line: line_column(text, start).0, ..row }),
                Err(fault) => faults.push(at_index(fault, index).at(first_line(text, span))),
            },
            Err(error) => faults.push(at_index(malformed(text, start, &error), index)),
        }
    }
    if faults.is_empty() { Ok(rows) } else { Err(faults) }
}

fn row(written: &Written, robot: &Robot, needed: &[usize]) -> Result<MeasuredRow, Diagnostic> {
    let q = configuration(&written.q, robot)?;
    let given =
        |coordinate: usize| written.q.contains_key(&robot.joint(robot.movable_joints()[coordinate]).name);
    if let Some(missing) = missing_joints(robot, needed, given) {
        return Err(Diagnostic::error("measurements::missing_joint", format!("no position for {missing}"))
            .with_help("every joint of the chain needs its position in \"q\", in rad or m"));
    }
    let translation = match (&written.translation_m, &written.translation_mm) {
        (Some(_), Some(_)) => {
            return Err(Diagnostic::error(
                "measurements::repeated",
                "translation_m and translation_mm are both given",
            ));
        }
        (Some(metres), None) => metres.clone(),
        (None, Some(millimetres)) => millimetres.iter().map(|&figure| Unit::Length.convert(figure)).collect(),
        (None, None) => Vec::new(),
    };
    if ![0, 2, 3].contains(&translation.len()) {
        let message = format!("a translation of {} figures", translation.len());
        return Err(Diagnostic::error("measurements::translation", message)
            .with_help("give x, y, z, or x, y for a planar measurement"));
    }
    let mut tip_in_base_m = [None; 3];
    for (coordinate, figure) in tip_in_base_m.iter_mut().zip(&translation) {
        *coordinate = Some(*figure);
    }
    let base_from_tip = match (written.quaternion_wxyz, written.rpy_deg, written.rpy_rad) {
        (None, None, None) => None,
        (Some(wxyz), None, None) => {
            let refused = |message| Diagnostic::error("measurements::orientation", message);
            Some(from_quaternion_wxyz(wxyz).map_err(refused)?)
        }
        (None, Some(degrees), None) => Some(from_rpy_rad(degrees.map(|figure| Unit::Angle.convert(figure)))),
        (None, None, Some(radians)) => Some(from_rpy_rad(radians)),
        _ => return Err(Diagnostic::error("measurements::orientation", "the orientation is given twice")),
    };
    if translation.is_empty() && base_from_tip.is_none() {
        return Err(Diagnostic::error("measurements::nothing_measured", "nothing was measured here")
            .with_help("add \"translation_m\": [x, y, z], and \"quaternion_wxyz\" where the orientation was measured"));
    }
    Ok(MeasuredRow { line: 0, q, tip_in_base_m, base_from_tip })
}

/// Only the first line of an entry is shown.
fn first_line(text: &str, span: Range<usize>) -> Range<usize> {
    let length = text[span.clone()].find('\n').unwrap_or(span.len());
    span.start..span.start + length
}

fn malformed(text: &str, start: usize, error: &serde_json::Error) -> Diagnostic {
    let lines = text[start..].split_inclusive('\n');
    let before: usize = lines.take(error.line().saturating_sub(1)).map(str::len).sum();
    let offset = (start + before + error.column().saturating_sub(1)).min(text.len());
    Diagnostic::error("measurements::json", error.to_string())
        .with_help(r#"expected [{"q": {"joint": 0.1}, "translation_m": [0.5, 0, 0.3], "quaternion_wxyz": [1, 0, 0, 0]}]"#)
        .at(offset..offset)
}

fn at_index(mut fault: Diagnostic, index: usize) -> Diagnostic {
    fault.message = format!("measurement {}: {}", index + 1, fault.message);
    fault
}
