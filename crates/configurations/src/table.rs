//! Configurations as a table in CSV: a column for each joint with its unit, one configuration in each row. Tables that a run
//! has written are read as well.

use std::ops::Range;

use congruent_description::Robot;
use congruent_input::{
    Diagnostic, Findings, known_names,
    units::{Unit, WrittenUnit},
};
use congruent_tables::{
    Header, Row, WrittenTable,
    run_columns::{POSITION, TIME, is_other_quantity},
    separated_with_commas,
};

use crate::{codes, written::WrittenConfiguration};

/// What a column of a joint gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ConfigurationQuantity {
    Position,
    Velocity,
    Effort,
}

struct Column<'a> {
    cell: usize,
    joint: &'a str,
    given: ConfigurationQuantity,
    unit: Option<WrittenUnit>,
}

/// Gives each row of a table to `add`, with what gives its place.
pub(super) fn read_rows(
    text: &str,
    robot: &Robot,
    mut add: impl FnMut(WrittenConfiguration, &mut dyn FnMut() -> Range<usize>) -> Result<(), Diagnostic>,
) -> Result<(), Findings> {
    let empty = || Diagnostic::error(codes::configurations::TABLE, "the table is empty").at(0..0);
    let WrittenTable { header, rows } =
        WrittenTable::read(text, codes::configurations::TABLE).ok_or_else(empty)?;
    let columns = columns(&header, robot)?;
    let read = rows.read_each(|row| {
        let written = configuration(&header, &columns, &row)?;
        add(written, &mut || row.span.clone()).map_err(|fault| row.mark(fault))
    });
    read.map(drop)
}

fn configuration(
    header: &Header,
    columns: &[Column<'_>],
    row: &Row,
) -> Result<WrittenConfiguration, Diagnostic> {
    let mut written = WrittenConfiguration::default();
    for column in columns {
        // Runs leave cells empty of what a robot without actuators does not have.
        let Some(value) = header.number(codes::configurations::TABLE, row, column.cell)? else { continue };
        let value = column.unit.map_or(value, |unit| unit.to_si(value));
        let group = match column.given {
            ConfigurationQuantity::Position => &mut written.q,
            ConfigurationQuantity::Velocity => &mut written.v,
            ConfigurationQuantity::Effort => &mut written.tau,
        };
        group.insert(column.joint.to_owned(), value);
    }
    Ok(written)
}

fn columns<'a>(header: &'a Header, robot: &Robot) -> Result<Vec<Column<'a>>, Findings> {
    let mut faults = Vec::new();
    let mut columns: Vec<Column<'a>> = Vec::new();
    for (cell, name) in header.names().enumerate().filter(|(_, name)| *name != TIME) {
        match column(cell, name, robot) {
            Ok(Some(column)) => {
                let is_second =
                    |before: &Column<'_>| (before.joint, before.given) == (column.joint, column.given);
                if columns.iter().any(is_second) {
                    let message = format!("column \"{name}\": joint \"{}\" has two columns", column.joint);
                    faults.push(Diagnostic::error(codes::configurations::TABLE, message));
                }
                columns.push(column);
            }
            Ok(None) => {}
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() && !columns.iter().any(|column| column.given == ConfigurationQuantity::Position) {
        let fault =
            Diagnostic::error(codes::configurations::TABLE, "no column gives the position of a joint");
        faults.push(fault.with_help("name columns <joint>_deg, <joint>_rad, <joint>_mm or <joint>_m"));
    }
    let placed = |fault: Diagnostic| fault.at(header.row.span.clone());
    if faults.is_empty() { Ok(columns) } else { Err(faults.into_iter().map(placed).collect()) }
}

/// The column with this name; `None` if it is one of a run's table that is not needed.
fn column<'a>(cell: usize, name: &'a str, robot: &Robot) -> Result<Option<Column<'a>>, Diagnostic> {
    let refused = |message: String| Diagnostic::error(codes::configurations::TABLE, message);
    if let Some((joint, quantity)) =
        name.rsplit_once('.').filter(|(joint, _)| robot.find_joint(joint).is_some())
    {
        let given = match quantity {
            // What followers do follows from their masters.
            "qd_rad_s" | "qd_m_s" if is_follower(joint, robot) => return Ok(None),
            "qd_rad_s" | "qd_m_s" => ConfigurationQuantity::Velocity,
            "effort_n_m" | "effort_n" => ConfigurationQuantity::Effort,
            _ => {
                return position(cell, joint, quantity.strip_prefix(&format!("{POSITION}_")), robot)
                    .map_err(|why| refused(format!("column \"{name}\": {why}")));
            }
        };
        return Ok(Some(Column { cell, joint, given, unit: None }));
    }
    let split = WrittenUnit::split(name).filter(|(joint, _)| robot.find_joint(joint).is_some());
    match split {
        Some((joint, unit)) => position(cell, joint, Some(unit.name()), robot)
            .map_err(|why| refused(format!("column \"{name}\": {why}"))),
        None if robot.find_joint(name).is_none() && is_other_quantity(name) => Ok(None),
        None if robot.find_joint(name).is_some() => {
            Err(refused(format!("column \"{name}\" has no unit in its name"))
                .with_help("add _deg or _rad for an angle, _mm or _m for a length"))
        }
        None => {
            let stem = WrittenUnit::split(name).map_or(name, |(stem, _)| stem);
            let message = format!("column \"{name}\" is no joint of robot \"{}\"", robot.name());
            let joints: Vec<&str> = robot.movable_joint_names().collect();
            let known = || known_names(stem, "joints (with _deg, _rad, _mm or _m)", joints);
            Err(refused(message).with_help(separated_with_commas(name).unwrap_or_else(known)))
        }
    }
}

/// A column of positions in this unit; `None` for another quantity of the joint in a run's table.
fn position<'a>(
    cell: usize,
    name: &'a str,
    unit: Option<&str>,
    robot: &Robot,
) -> Result<Option<Column<'a>>, String> {
    let unit = unit.and_then(|unit| WrittenUnit::ALL.into_iter().find(|known| known.name() == unit));
    let (Some(unit), Some(joint)) = (unit, robot.find_joint(name)) else { return Ok(None) };
    let joint = robot.joint(joint);
    let turns = unit.unit == Unit::Angle;
    if joint.kind.is_angular() != turns {
        let (what, keys) = if turns { ("slides", "_mm or _m") } else { ("turns", "_deg or _rad") };
        return Err(format!("the joint {what}, so its column must end in {keys}"));
    }
    let column = Column { cell, joint: name, given: ConfigurationQuantity::Position, unit: Some(unit) };
    // After the check of its unit, which applies to a follower's column as well.
    Ok((!is_follower(name, robot)).then_some(column))
}

fn is_follower(name: &str, robot: &Robot) -> bool {
    robot.find_joint(name).is_some_and(|joint| robot.joint(joint).mimic.is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Configurations, read_configurations, read_states};
    use congruent_description::parse_urdf;

    fn robot() -> Robot {
        parse_urdf(
            r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
            <joint name="turn" type="continuous"><parent link="a"/><child link="b"/></joint>
            <joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><limit lower="0" upper="1" velocity="1" effort="1"/></joint>
            </robot>"#,
        )
        .unwrap()
    }

    fn file(text: &str) -> tempfile::TempPath {
        let file = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
        std::fs::write(file.path(), text).unwrap();
        file.into_temp_path()
    }

    #[test]
    fn columns_have_units() {
        let file = file("# by hand\nturn_deg, slide_mm\n180, 250\n\n-90, 0\n");
        let Configurations { entries, warning, .. } = read_configurations(&file, &robot()).unwrap();
        let found: Vec<Vec<f64>> = entries.iter().map(|q| q.to_vec()).collect();
        let (turn, half) = (std::f64::consts::PI, std::f64::consts::FRAC_PI_2);
        assert_eq!(found, [vec![turn, 0.25], vec![-half, 0.0]]);
        assert_eq!(warning, None);
    }

    #[test]
    fn a_table_of_a_run_has_positions_velocities_and_efforts() {
        let file = file(
            "time_s,step,turn.q_rad,turn.qd_rad_s,turn.effort_n_m,turn.reference_q_rad,slide.q_m,slide.effort_n,clearance_m,clearance_pair\n\
             0.1,1,0.5,-2,3,0.4,0.1,7,,\n",
        );
        let states = read_states(&file, &robot()).unwrap().entries;
        let state = states.iter().next().unwrap();
        assert_eq!(
            (&state.q[..], &state.qd[..], &state.tau[..]),
            (&[0.5, 0.1][..], &[-2.0, 0.0][..], &[3.0, 7.0][..])
        );
    }

    #[test]
    fn what_is_no_configuration_is_reported_with_its_line_and_column() {
        for (text, message) in [
            ("turn_deg,trun_deg\n1,2\n", "column \"trun_deg\" is no joint of robot \"r\""),
            ("turn\n1\n", "column \"turn\" has no unit in its name"),
            ("turn_mm\n1\n", "column \"turn_mm\": the joint turns, so its column must end in _deg or _rad"),
            ("turn_deg,turn_rad\n1,2\n", "joint \"turn\" has two columns"),
            ("turn_deg\n1\nx\n", "line 3, column \"turn_deg\": \"x\" is not a finite number"),
            ("turn_deg,slide_m\n1\n", "line 2: 1 cells, the header has 2"),
            ("time_s\n1\n", "no column gives the position of a joint"),
            ("turn_deg\n", "the list has no configurations"),
        ] {
            let findings = read_configurations(&file(text), &robot()).unwrap_err();
            let found: Vec<String> = findings.iter().map(|found| found.message.clone()).collect();
            assert!(found.iter().any(|found| found.contains(message)), "{text}: {found:?}");
        }
    }
}
