//! A value for each joint, of one configuration or of many: an array in the order of the joints, or a dictionary by their names.

use congruent::{
    configurations::codes::configurations::UNKNOWN_JOINT,
    input::{Diagnostic, known_names},
};
use pyo3::{prelude::*, types::PyDict};

use super::{
    argument::{ArrayArgument, refused_array},
    result::BatchShape,
};
use crate::error::refused;

/// A value for each joint, a row for each configuration.
pub(crate) struct JointRows<'py> {
    name: &'static str,
    values: RowValues<'py>,
    batch: BatchShape,
}

enum RowValues<'py> {
    /// The memory of the caller's array.
    InPlace(ArrayArgument<'py>),
    /// Put together from a dictionary.
    Gathered(Vec<f64>),
}

impl<'py> JointRows<'py> {
    /// Values of these joints; a joint that a dictionary does not name is at 0.
    ///
    /// # Errors
    /// `CongruentError` if a joint is unknown, the shape is neither (joints,) nor (n, joints), or a value is not finite.
    pub(crate) fn new(argument: &Bound<'py, PyAny>, name: &'static str, joints: &[String]) -> PyResult<Self> {
        let rows = match argument.cast::<PyDict>() {
            Ok(by_name) => Self::by_name(by_name, name, joints)?,
            Err(_) => Self::in_order(argument, name, joints)?,
        };
        rows.refuse_not_finite(argument.py(), joints)?;
        Ok(rows)
    }

    pub(crate) fn batch(&self) -> BatchShape {
        self.batch
    }

    /// All values, rows one after another.
    pub(crate) fn values(&self) -> &[f64] {
        match &self.values {
            RowValues::InPlace(array) => array.values(),
            RowValues::Gathered(values) => values,
        }
    }

    fn in_order(argument: &Bound<'py, PyAny>, name: &'static str, joints: &[String]) -> PyResult<Self> {
        let array = ArrayArgument::new(argument, name)?;
        let batch = match *array.shape() {
            [columns] if columns == joints.len() => BatchShape::One,
            [rows, columns] if columns == joints.len() => BatchShape::Rows(rows),
            _ => {
                let (n, shape) = (joints.len(), array.shape_in_words());
                let message = format!("{name} has the shape {shape}, but the robot has {n} joints");
                let order = joints.join(", ");
                let help =
                    format!("give ({n},) for one configuration or (n, {n}) for many, in the order {order}");
                return Err(refused_array(argument.py(), message, help));
            }
        };
        Ok(Self { name, values: RowValues::InPlace(array), batch })
    }

    fn by_name(by_name: &Bound<'py, PyDict>, name: &'static str, joints: &[String]) -> PyResult<Self> {
        let py = by_name.py();
        let mut columns: Vec<(usize, ArrayArgument<'py>)> = Vec::new();
        let mut batch = BatchShape::One;
        for (key, value) in by_name {
            let joint: String = key.str()?.to_string();
            let Some(column) = joints.iter().position(|known| *known == joint) else {
                let known = joints.iter().map(String::as_str);
                let message = format!("{name} names joint \"{joint}\", which the robot does not have");
                let unknown = Diagnostic::error(UNKNOWN_JOINT, message);
                return Err(refused(py, unknown.with_help(known_names(&joint, "joints", known))));
            };
            let what = format!("{name}[\"{joint}\"]");
            let value = ArrayArgument::new(&value, &what)?;
            match (value.shape(), batch) {
                ([], _) => {}
                (&[rows], BatchShape::One) => batch = BatchShape::Rows(rows),
                (&[rows], BatchShape::Rows(others)) if rows == others => {}
                _ => {
                    let shape = value.shape_in_words();
                    let help = "give a number for each joint, or arrays of one length";
                    return Err(refused_array(py, format!("{what} has the shape {shape}"), help));
                }
            }
            columns.push((column, value));
        }
        let n = joints.len();
        let mut values = vec![0.0; n * batch.rows()];
        for (column, value) in columns {
            // One number is that of all rows.
            let numbers = value.values().iter().cycle();
            let places = values.iter_mut().skip(column).step_by(n);
            places.zip(numbers).for_each(|(place, &number)| *place = number);
        }
        Ok(Self { name, values: RowValues::Gathered(values), batch })
    }

    fn refuse_not_finite(&self, py: Python<'_>, joints: &[String]) -> PyResult<()> {
        let Some(at) = self.values().iter().position(|value| !value.is_finite()) else { return Ok(()) };
        let (row, column) = (at / joints.len(), at % joints.len());
        let (name, joint, value) = (self.name, &joints[column], self.values()[at]);
        let place = match self.batch {
            BatchShape::One => String::new(),
            BatchShape::Rows(_) => format!(" in row {row}"),
        };
        let message = format!("{name} of joint \"{joint}\"{place} is {value}, not a finite number");
        Err(refused_array(py, message, "give finite numbers: positions in rad or m, torques in N m or N"))
    }
}

/// Refuses arguments of one call that are not for the same configurations.
pub(crate) fn same_rows(py: Python<'_>, all: &[&JointRows<'_>]) -> PyResult<BatchShape> {
    let [first, others @ ..] = all else { return Ok(BatchShape::One) };
    match others.iter().find(|other| other.batch != first.batch) {
        None => Ok(first.batch),
        Some(other) => {
            let of = |rows: &JointRows<'_>| format!("{} {}", rows.name, rows.batch.in_words());
            let message = format!("{}, but {}", of(first), of(other));
            Err(refused_array(py, message, "give as many rows of each"))
        }
    }
}
