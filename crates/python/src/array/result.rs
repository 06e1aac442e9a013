//! Results as arrays of numpy: without a dimension for the rows if one configuration was given.

use numpy::{Element, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

/// How many configurations were given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BatchShape {
    /// One, without a dimension of its own.
    One,
    /// So many, each a row.
    Rows(usize),
}

impl BatchShape {
    pub(crate) fn rows(self) -> usize {
        match self {
            Self::One => 1,
            Self::Rows(rows) => rows,
        }
    }

    /// The shape of an array with an entry of this shape for each configuration.
    pub(crate) fn shape(self, of_entry: &[usize]) -> Vec<usize> {
        match self {
            Self::One => of_entry.to_vec(),
            Self::Rows(rows) => [&[rows], of_entry].concat(),
        }
    }

    /// As in "q is one configuration".
    pub(crate) fn in_words(self) -> String {
        match self {
            Self::One => "is one configuration".to_owned(),
            Self::Rows(rows) => format!("has {rows} rows"),
        }
    }
}

/// An array of values that were computed elsewhere, an entry of this shape for each configuration.
pub(crate) fn array_of_rows<T: Element>(
    py: Python<'_>,
    values: Vec<T>,
    batch: BatchShape,
    of_entry: &[usize],
) -> PyResult<Py<PyArrayDyn<T>>> {
    let array = numpy::PyArray1::from_vec(py, values).reshape(batch.shape(of_entry))?;
    Ok(array.unbind())
}
