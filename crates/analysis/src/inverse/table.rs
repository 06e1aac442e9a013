//! Targets as a table in CSV: a column for each coordinate with its unit, one target in each row.

use std::{collections::BTreeMap, ops::Range};

use congruent_description::Robot;
use congruent_input::{
    Diagnostic, Findings, known_names, rotation_from_rpy_fixed_xyz,
    units::{Unit, WrittenUnit},
};
use congruent_tables::{Header, Row, WrittenTable, separated_with_commas};

use super::written_target::WrittenTarget;
use crate::codes;

/// What a column gives.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum TargetColumn {
    /// Coordinate x, y or z of the tool in link `base`.
    Position(usize),
    /// Component w, x, y or z of its orientation as a quaternion.
    Quaternion(usize),
    /// Roll, pitch or yaw about the fixed axes of the base.
    Rpy(usize),
    /// Where the search starts in a joint.
    Start(String),
}

/// Gives each row of a table to `add`, with its place.
pub(super) fn read_rows<T>(
    text: &str,
    robot: &Robot,
    mut add: impl FnMut(WrittenTarget, Range<usize>) -> Result<T, Diagnostic>,
) -> Result<Vec<T>, Findings> {
    let empty = || Diagnostic::error(codes::targets::TABLE, "the table is empty").at(0..0);
    let WrittenTable { header, rows } = WrittenTable::read(text, codes::targets::TABLE).ok_or_else(empty)?;
    let columns = columns(&header, robot)?;
    rows.read_each(|row| {
        let written = target(&header, &columns, &row)?;
        add(written, row.span.clone()).map_err(|fault| row.mark(fault))
    })
}

fn target(
    header: &Header,
    columns: &[(TargetColumn, Option<WrittenUnit>)],
    row: &Row,
) -> Result<WrittenTarget, Diagnostic> {
    let (mut translation_m, mut wxyz, mut rpy_rad) = ([0.0; 3], [None; 4], [None; 3]);
    let mut start = BTreeMap::new();
    for (cell, (given, unit)) in columns.iter().enumerate() {
        let to_si = |value: f64| unit.map_or(value, |unit| unit.to_si(value));
        let code = codes::targets::TABLE;
        match given {
            TargetColumn::Position(at) => translation_m[*at] = to_si(header.needed_number(code, row, cell)?),
            TargetColumn::Quaternion(at) => wxyz[*at] = header.number(code, row, cell)?,
            TargetColumn::Rpy(at) => rpy_rad[*at] = header.number(code, row, cell)?.map(to_si),
            TargetColumn::Start(joint) => {
                start.extend(header.number(code, row, cell)?.map(|value| (joint.clone(), to_si(value))));
            }
        }
    }
    let incomplete = || row.fault(codes::targets::TABLE, "the orientation is incomplete");
    let quaternion_wxyz = match (GivenParts::new(wxyz), GivenParts::new(rpy_rad)) {
        (GivenParts::InPart, _) | (_, GivenParts::InPart) => return Err(incomplete()),
        (GivenParts::Whole(wxyz), _) => Some(wxyz),
        (_, GivenParts::Whole(rpy_rad)) => {
            let rotation = rotation_from_rpy_fixed_xyz(rpy_rad);
            Some([rotation.w, rotation.i, rotation.j, rotation.k])
        }
        // Rows may differ in whether they have an orientation.
        (GivenParts::Nothing, GivenParts::Nothing) => None,
    };
    Ok(WrittenTarget { translation_m, quaternion_wxyz, start })
}

/// Which values of a quantity a row gives.
enum GivenParts<const N: usize> {
    Whole([f64; N]),
    InPart,
    Nothing,
}

impl<const N: usize> GivenParts<N> {
    fn new(values: [Option<f64>; N]) -> Self {
        match values.iter().flatten().count() {
            0 => Self::Nothing,
            count if count == N => Self::Whole(values.map(Option::unwrap_or_default)),
            _ => Self::InPart,
        }
    }
}

fn columns(header: &Header, robot: &Robot) -> Result<Vec<(TargetColumn, Option<WrittenUnit>)>, Findings> {
    let (mut columns, mut faults): (Vec<_>, Vec<Diagnostic>) = (Vec::new(), Vec::new());
    let mut refused: Vec<(Range<usize>, &str, RefusedColumn)> = Vec::new();
    for (cell, name) in header.names().enumerate() {
        match column(name, robot) {
            Ok(column) if columns.iter().any(|(given, _)| *given == column.0) => {
                let message = format!("column \"{name}\": the same quantity has two columns");
                faults.push(
                    Diagnostic::error(codes::targets::TABLE, message).at(header.row.cells[cell].span.clone()),
                );
            }
            Ok(column) => columns.push(column),
            Err(fault) => refused.push((header.row.cells[cell].span.clone(), name, fault)),
        }
    }
    faults.extend(without_unit(&refused));
    faults.extend(unknown(&refused, robot));
    let count =
        |is_part: fn(&TargetColumn) -> bool| columns.iter().filter(|(given, _)| is_part(given)).count();
    let position = count(|given| matches!(given, TargetColumn::Position(_)));
    let quaternion = count(|given| matches!(given, TargetColumn::Quaternion(_)));
    let rpy = count(|given| matches!(given, TargetColumn::Rpy(_)));
    let help = if position != 3 {
        Some(("a target needs three coordinates", "name columns x_m, y_m, z_m, or x_mm, y_mm, z_mm"))
    } else if ![0, 4].contains(&quaternion) || ![0, 3].contains(&rpy) || (quaternion > 0 && rpy > 0) {
        let help = "give all of qw, qx, qy, qz, or all of roll_deg, pitch_deg, yaw_deg, or none of them";
        Some(("the orientation is incomplete or given twice", help))
    } else {
        None
    };
    if let Some((message, help)) = help.filter(|_| faults.is_empty()) {
        let fault = Diagnostic::error(codes::targets::TABLE, message).with_help(help);
        faults.push(fault.at(header.row.span.clone()));
    }
    if faults.is_empty() { Ok(columns) } else { Err(faults.into()) }
}

/// Why a column is refused.
enum RefusedColumn {
    /// It has no unit, or one that does not fit; one of these keys is meant.
    Unit([String; 2]),
    /// It is neither a coordinate nor a joint.
    Unknown,
}

/// The columns without a unit in one finding: x, y and z without it are one mistake.
fn without_unit(refused: &[(Range<usize>, &str, RefusedColumn)]) -> Option<Diagnostic> {
    let mut names = Vec::new();
    let mut keys = Vec::new();
    for (_, name, fault) in refused {
        if let RefusedColumn::Unit([si, engineering]) = fault {
            names.push(format!("\"{name}\""));
            keys.push(format!("{engineering} or {si}"));
        }
    }
    let (span, ..) = refused.iter().find(|(.., fault)| matches!(fault, RefusedColumn::Unit(_)))?;
    let message = match &names[..] {
        [name] => format!("column {name} has no unit, or one that does not fit"),
        _ => format!("columns {} have no unit, or one that does not fit", names.join(", ")),
    };
    let found = Diagnostic::error(codes::targets::TABLE, message);
    Some(found.with_help(format!("write {}", keys.join(", "))).at(span.clone()))
}

/// The columns that are not known in one finding.
fn unknown(refused: &[(Range<usize>, &str, RefusedColumn)], robot: &Robot) -> Option<Diagnostic> {
    let unknown = refused.iter().filter(|(.., fault)| matches!(fault, RefusedColumn::Unknown));
    let (spans, names): (Vec<_>, Vec<&str>) = unknown.map(|(span, name, _)| (span.clone(), *name)).unzip();
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let message = match &quoted[..] {
        [] => return None,
        [name] => format!("column {name} is neither a coordinate nor a joint of robot \"{}\"", robot.name()),
        _ => format!(
            "columns {} are neither coordinates nor joints of robot \"{}\"",
            quoted.join(", "),
            robot.name()
        ),
    };
    let stem = WrittenUnit::split(names[0]).map_or(names[0], |(stem, _)| stem);
    let joints = robot.movable_joint_names();
    let known = ["x", "y", "z", "roll", "pitch", "yaw", "qw", "qx", "qy", "qz"].into_iter().chain(joints);
    let mut help = known_names(stem, "columns (with units)", known.collect::<Vec<_>>());
    if let Some(commas) = separated_with_commas(names[0]) {
        help = commas;
    }
    if ["rx", "ry", "rz"].contains(&stem) {
        help = format!(
            "rotation vectors are not read: give roll_deg, pitch_deg, yaw_deg, or qw, qx, qy, qz; {help}"
        );
    }
    Some(Diagnostic::error(codes::targets::TABLE, message).with_help(help).at(spans[0].clone()))
}

fn column(name: &str, robot: &Robot) -> Result<(TargetColumn, Option<WrittenUnit>), RefusedColumn> {
    if let Some(at) = ["qw", "qx", "qy", "qz"].iter().position(|known| *known == name) {
        return Ok((TargetColumn::Quaternion(at), None));
    }
    let (stem, unit) = WrittenUnit::split(name).map_or((name, None), |(stem, unit)| (stem, Some(unit)));
    let joint =
        robot.find_joint(stem).map(|joint| robot.joint(joint)).filter(|joint| joint.kind.is_movable());
    let place = |names: [&str; 3]| names.iter().position(|known| *known == stem);
    let (given, expected) = if let Some(joint) = joint {
        let expected = if joint.kind.is_angular() { Unit::Angle } else { Unit::Length };
        (TargetColumn::Start(stem.to_owned()), expected)
    } else if let Some(at) = place(["x", "y", "z"]) {
        (TargetColumn::Position(at), Unit::Length)
    } else if let Some(at) = place(["roll", "pitch", "yaw"]) {
        (TargetColumn::Rpy(at), Unit::Angle)
    } else {
        return Err(RefusedColumn::Unknown);
    };
    if unit.is_none_or(|unit| unit.unit != expected) {
        return Err(RefusedColumn::Unit(expected.keys(stem)));
    }
    Ok((given, unit))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use congruent_description::parse_urdf;

    use super::super::{TargetPart, read_targets};

    fn read(text: &str) -> Result<Vec<super::super::InverseTarget>, String> {
        let robot = parse_urdf(
            r#"<robot name="r"><link name="a"/><link name="b"/>
            <joint name="turn" type="continuous"><parent link="a"/><child link="b"/></joint></robot>"#,
        )
        .unwrap();
        let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let read = read_targets(file.path(), &robot).map_err(|faults| {
            faults.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>().join("; ")
        });
        Ok(read?.targets)
    }

    #[test]
    fn rows_are_targets() {
        let targets =
            read("x_mm,y_m,z_m,roll_deg,pitch_deg,yaw_deg,turn_deg\n400,0.1,0.3,0,0,90,45\n1,2,3,,,,\n")
                .unwrap();
        assert_eq!(targets.len(), 2);
        let [first, second] = &targets[..] else { unreachable!() };
        assert_eq!(first.target.base_from_tcp.translation.as_slice(), [0.4, 0.1, 0.3]);
        let wxyz = first.target.base_from_tcp.quaternion_wxyz();
        assert!((2.0 * wxyz[3].atan2(wxyz[0]) - FRAC_PI_2).abs() < 1e-12, "{wxyz:?}");
        assert!((first.start["turn"] - FRAC_PI_2 / 2.0).abs() < 1e-15);
        assert_eq!((second.target.part, second.start.len()), (TargetPart::Position, 0));
    }

    #[test]
    fn what_is_no_target_is_reported() {
        for (text, message) in [
            ("x_m,y_m\n1,2\n", "a target needs three coordinates"),
            ("x,y_m,z_m\n1,2,3\n", "column \"x\" has no unit, or one that does not fit"),
            ("x_m,y_m,z_m,qw,qx\n1,2,3,1,0\n", "the orientation is incomplete or given twice"),
            ("x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n1,2,3,4,,5\n", "line 2: the orientation is incomplete"),
            ("x_m,y_m,z_m,trun_deg\n1,2,3,4\n", "column \"trun_deg\" is neither a coordinate nor a joint"),
            ("x,y,z\n1,2,3\n", "columns \"x\", \"y\", \"z\" have no unit"),
            ("x_m,y_m,z_m,rx,ry,rz\n1,2,3,4,5,6\n", "columns \"rx\", \"ry\", \"rz\" are neither coordinates"),
            ("x_m,y_m,z_m\n1,,3\n", "line 2, column \"y_m\": the cell is empty"),
            ("x_m,y_m,z_m\n1e9,2,3\n", "line 2: translation_m has 1000000000"),
        ] {
            let found = read(text).unwrap_err();
            assert!(found.contains(message), "{text}: {found}");
        }
    }
}
