//! Results as arrays of numpy: without a dimension for the rows if one configuration was given.

use std::ops::Range;

use congruent::input::Diagnostic;
use numpy::{Element, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

use super::parallel::{RowBlocks, fill_rows};

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

/// A new array with an entry of this shape for each configuration, filled by [`fill_rows`] in blocks of so many rows.
pub(crate) fn filled_array<'py, Worker>(
    py: Python<'py>,
    batch: BatchShape,
    of_entry: &[usize],
    rows: usize,
    worker: impl Fn() -> Worker + Sync,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>>
where
    Worker: FnMut(Range<usize>, &mut [f64]) -> Result<(), Diagnostic>,
{
    let array = PyArrayDyn::<f64>::zeros(py, batch.shape(of_entry), false);
    let mut writable = array.readwrite();
    let blocks = RowBlocks { out: writable.as_slice_mut()?, width: of_entry.iter().product(), rows };
    fill_rows(py, blocks, worker)?;
    drop(writable);
    Ok(array)
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
