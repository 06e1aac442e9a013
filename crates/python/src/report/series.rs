//! What happened in a run, column by column.

use std::path::Path;

use congruent::results::trajectory_file::{TableError, Value, open};
use numpy::PyArray1;
use pyo3::{
    prelude::*,
    types::{PyDict, PyList},
};

/// The columns of a table, in its order.
#[derive(Debug, Default)]
pub(super) struct Series(Vec<(String, SeriesColumn)>);

#[derive(Debug)]
enum SeriesColumn {
    /// A cell that is missing is NaN.
    Numbers(Vec<f64>),
    /// A column with a name in some row, such as the nearest link.
    Names(Vec<Option<String>>),
}

/// Reads a table of a run.
///
/// # Errors
/// It is none, or cannot be read to its end.
pub(super) fn read_series(path: &Path) -> Result<Series, TableError> {
    let mut rows = open(path)?;
    let mut columns: Vec<Vec<Value>> = vec![Vec::new(); rows.columns().len()];
    let names = rows.columns().to_vec();
    let mut row = Vec::new();
    let broken = |message| TableError { path: path.to_owned(), message };
    while rows.next_row(&mut row).map_err(broken)? {
        columns.iter_mut().zip(row.drain(..)).for_each(|(column, value)| column.push(value));
    }
    Ok(Series(names.into_iter().zip(columns.into_iter().map(SeriesColumn::from)).collect()))
}

impl From<Vec<Value>> for SeriesColumn {
    fn from(values: Vec<Value>) -> Self {
        if values.iter().any(|value| matches!(value, Value::Name(_))) {
            let name = |value| match value {
                Value::Name(name) => Some(name),
                Value::Number(_) | Value::Missing => None,
            };
            return Self::Names(values.into_iter().map(name).collect());
        }
        let number = |value: Value| if let Value::Number(number) = value { number } else { f64::NAN };
        Self::Numbers(values.into_iter().map(number).collect())
    }
}

impl Series {
    /// A dictionary of arrays of numbers and lists of names.
    pub(super) fn into_python(self, py: Python<'_>) -> PyResult<Py<PyDict>> {
        let columns = PyDict::new(py);
        for (name, column) in self.0 {
            match column {
                SeriesColumn::Numbers(numbers) => columns.set_item(name, PyArray1::from_vec(py, numbers))?,
                SeriesColumn::Names(names) => columns.set_item(name, PyList::new(py, names)?)?,
            }
        }
        Ok(columns.unbind())
    }
}
