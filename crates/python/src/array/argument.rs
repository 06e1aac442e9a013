//! An argument that numpy understands as an array of numbers: taken as it is if it is made of 64-bit floats one after another.

use congruent::{codes::python, input::Diagnostic};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods, get_array_module};
use pyo3::{intern, prelude::*};

use crate::error::refused;

/// Kinds of numbers that become 64-bit floats: floats, integers, unsigned integers.
const NUMBERS: [&str; 3] = ["f", "i", "u"];

/// Numbers in C order.
pub(crate) struct ArrayArgument<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    shape: Vec<usize>,
}

impl<'py> ArrayArgument<'py> {
    /// The array of an argument; its name is for messages.
    ///
    /// # Errors
    /// `CongruentError` if it is not made of numbers.
    pub(crate) fn new(argument: &Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        let py = argument.py();
        let as_it_is = argument.cast::<PyArrayDyn<f64>>().ok();
        // Columns one after another are contiguous, too, and would be read as rows.
        let array = match as_it_is.filter(|array| array.is_c_contiguous() && array.len() > 0) {
            Some(array) => array.clone(),
            None => converted(argument, name)?,
        };
        let shape = array.shape().to_vec();
        let array = array.try_readonly().map_err(|_| {
            refused_array(py, format!("{name} is written to at the same time"), "give a copy of it")
        })?;
        // An address that is no multiple of 8 is rare enough to be copied by the caller.
        if array.as_slice().is_err() {
            let message = format!("{name} is not aligned in memory");
            return Err(refused_array(py, message, "give numpy.array(...) of it"));
        }
        Ok(Self { array, shape })
    }

    pub(crate) fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// All numbers, rows one after another.
    pub(crate) fn values(&self) -> &[f64] {
        self.array.as_slice().unwrap_or_default()
    }

    /// The shape as Python writes it.
    pub(crate) fn shape_in_words(&self) -> String {
        match &self.shape[..] {
            [only] => format!("({only},)"),
            several => {
                let sizes: Vec<String> = several.iter().map(ToString::to_string).collect();
                format!("({})", sizes.join(", "))
            }
        }
    }
}

/// The numbers of a list, of another type of numbers or of another order in memory.
fn converted<'py>(argument: &Bound<'py, PyAny>, name: &str) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = argument.py();
    let numpy = get_array_module(py)?;
    let not_numbers = |why: String| {
        let help = "give a number, a list or a numpy array of numbers";
        refused_array(py, format!("{name} is not an array of numbers: {why}"), help)
    };
    let found = numpy.call_method1(intern!(py, "asarray"), (argument,));
    let found = found.map_err(|error| not_numbers(error.value(py).to_string()))?;
    let dtype = found.getattr(intern!(py, "dtype"))?;
    let kind: String = dtype.getattr(intern!(py, "kind"))?.extract()?;
    let is_empty: usize = found.getattr(intern!(py, "size"))?.extract()?;
    // Truth values, complex numbers, texts and objects are numbers by mistake alone; an empty list has no type.
    if !NUMBERS.contains(&kind.as_str()) && is_empty != 0 {
        return Err(not_numbers(format!("its type is {}", dtype.str()?)));
    }
    let shape = found.getattr(intern!(py, "shape"))?;
    let floats = numpy.call_method1(intern!(py, "ascontiguousarray"), (found, intern!(py, "float64")))?;
    // numpy gives a single number a dimension, which it did not have.
    let floats = floats.call_method1(intern!(py, "reshape"), (shape,))?;
    Ok(floats.cast_into::<PyArrayDyn<f64>>()?)
}

/// The exception for an array of a wrong shape or with a value that is refused.
pub(crate) fn refused_array(py: Python<'_>, message: impl Into<String>, help: impl Into<String>) -> PyErr {
    refused(py, Diagnostic::error(python::ARRAY, message).with_help(help))
}
