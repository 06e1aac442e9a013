//! A table of torques over time.

use congruent_description::Robot;
use congruent_input::{Diagnostic, SourceFile, known_names};
use congruent_tables::{Header, WrittenTable, run_columns::TIME};

use crate::codes;

/// Torques of all joints over time: interpolated between the rows, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueTable {
    times_s: Vec<f64>,
    /// One row for each time, one entry for each movable joint.
    torques: Vec<Vec<f64>>,
}

impl TorqueTable {
    /// Reads a table; joints without a column get no torque.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub(super) fn read(file: &SourceFile, robot: &Robot) -> Result<Self, Diagnostic> {
        let empty =
            |message: &str| Diagnostic::error(codes::scenario::TORQUE_FILE, message.to_owned()).at(0..0);
        let table = WrittenTable::read(&file.text, codes::scenario::TORQUE_FILE)
            .ok_or_else(|| empty("the file has no header"))?;
        let WrittenTable { header, rows } = table;
        let columns = columns(&header, robot)?;
        let mut table = Self { times_s: Vec::new(), torques: Vec::new() };
        for row in rows {
            let row = row?;
            let mut torques = vec![0.0; robot.dof()];
            for (at, column) in columns.iter().enumerate() {
                let value = header.needed_number(codes::scenario::TORQUE_FILE, &row, at)?;
                match column {
                    Some(coordinate) => torques[*coordinate] = value,
                    None if table.times_s.last().is_none_or(|&last| last < value) => {
                        table.times_s.push(value);
                    }
                    None => {
                        let message = format!("time {value} s is not after that of the row before");
                        return Err(row.fault(codes::scenario::TORQUE_FILE, &message));
                    }
                }
            }
            table.torques.push(torques);
        }
        if table.times_s.is_empty() { Err(empty("the file has no row below its header")) } else { Ok(table) }
    }

    /// Adds the torques at a time.
    pub(crate) fn add_at(&self, time_s: f64, torque: &mut [f64]) {
        // The row after the instant, or the last one; at both ends `before` and `share` then give the first and the
        // last row.
        let after = self.times_s.partition_point(|&row_s| row_s <= time_s).min(self.times_s.len() - 1);
        let before = after.saturating_sub(1);
        let gap_s = self.times_s[after] - self.times_s[before];
        let share = if gap_s > 0.0 { ((time_s - self.times_s[before]) / gap_s).clamp(0.0, 1.0) } else { 0.0 };
        for (torque, (before, after)) in
            torque.iter_mut().zip(self.torques[before].iter().zip(&self.torques[after]))
        {
            *torque += before + share * (after - before);
        }
    }
}

/// The coordinate of each column, `None` for the time.
fn columns(header: &Header, robot: &Robot) -> Result<Vec<Option<usize>>, Diagnostic> {
    let mut columns = Vec::new();
    for (at, name) in header.names().enumerate() {
        // A mimic joint has no actuator that could exert a torque.
        let coordinate = robot.find_joint(name).filter(|&joint| robot.joint(joint).mimic.is_none());
        let column = match coordinate.and_then(|joint| robot.coordinate(joint)) {
            Some(coordinate) => Some(coordinate),
            None if name == TIME => None,
            None => {
                let message = format!("robot \"{}\" has no actuated joint \"{name}\"", robot.name());
                let known = robot.movable_joint_names().chain([TIME]);
                let fault = header
                    .row
                    .fault(codes::scenario::TORQUE_FILE, &message)
                    .at(header.row.cells[at].span.clone());
                return Err(fault.with_help(known_names(name, "columns", known)));
            }
        };
        if columns.contains(&column) {
            return Err(header
                .row
                .fault(codes::scenario::TORQUE_FILE, &format!("column \"{name}\" occurs twice")));
        }
        columns.push(column);
    }
    if columns.contains(&None) {
        Ok(columns)
    } else {
        Err(header.row.fault(codes::scenario::TORQUE_FILE, &format!("the table has no column {TIME}")))
    }
}

#[cfg(test)]
mod tests {
    use congruent_description::parse_urdf;

    use super::*;

    fn robot() -> Robot {
        parse_urdf(
            r#"<robot name="two"><link name="a"/><link name="b"/><link name="c"/>
               <joint name="j1" type="continuous"><parent link="a"/><child link="b"/></joint>
               <joint name="j2" type="continuous"><parent link="b"/><child link="c"/></joint></robot>"#,
        )
        .unwrap()
    }

    fn read(text: &str) -> Result<TorqueTable, Diagnostic> {
        TorqueTable::read(
            &SourceFile { path: "t.csv".into(), text: text.to_owned(), is_foreign: false },
            &robot(),
        )
    }

    #[test]
    fn torques_between_before_and_after_the_rows() {
        let table = read("# a comment\ntime_s, j2\n0.5, 1\n1.5, 3\n").unwrap();
        for (time_s, expected) in [(0.0, 1.0), (0.5, 1.0), (1.0, 2.0), (1.5, 3.0), (9.0, 3.0)] {
            let mut torque = [10.0, 10.0];
            table.add_at(time_s, &mut torque);
            assert!((torque[1] - 10.0 - expected).abs() < 1e-15, "{torque:?} at {time_s}");
            assert_eq!(torque[0].to_bits(), 10.0_f64.to_bits());
        }
    }

    #[test]
    fn what_is_wrong_with_a_table() {
        for (text, expected) in [
            ("", "the file has no header"),
            ("time_s,j1\n", "no row"),
            ("j1\n1\n", "no column time_s"),
            ("time_s,j3\n0,1\n", "no actuated joint \"j3\""),
            ("time_s,j1,j1\n0,1,1\n", "twice"),
            ("time_s,j1\n0,nan\n", "line 2, column \"j1\": \"nan\" is not a finite number"),
            ("time_s,j1\n0,1\n0,1\n", "line 3: time 0 s is not after"),
            ("time_s,j1\n0\n", "1 cells"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.message.contains(expected), "{}", error.message);
        }
    }
}
