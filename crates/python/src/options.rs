//! Keyword arguments of functions that have many: each is taken by its name, and a name that is left over is an error of Python.

use congruent::input::nearest;
use pyo3::{
    conversion::FromPyObjectOwned,
    exceptions::PyTypeError,
    prelude::*,
    types::{PyDict, PyString},
};

/// The keyword arguments of one call.
pub(crate) struct KeywordOptions<'a, 'py> {
    function: &'static str,
    given: Option<&'a Bound<'py, PyDict>>,
    known: Vec<&'static str>,
}

impl<'a, 'py> KeywordOptions<'a, 'py> {
    pub(crate) fn new(function: &'static str, given: Option<&'a Bound<'py, PyDict>>) -> Self {
        Self { function, given, known: Vec::new() }
    }

    /// The value of an argument; `None` if it is not given or `None`.
    pub(crate) fn take<T: FromPyObjectOwned<'py>>(&mut self, name: &'static str) -> PyResult<Option<T>> {
        self.known.push(name);
        let value = self.given.map(|given| given.get_item(name)).transpose()?.flatten();
        let Some(value) = value.filter(|value| !value.is_none()) else { return Ok(None) };
        let found = value.extract::<T>().map_err(Into::into);
        found.map(Some).map_err(|error: PyErr| {
            PyTypeError::new_err(format!("argument '{name}': {}", error.value(value.py())))
        })
    }

    /// Refuses a name that was not taken.
    pub(crate) fn finish(self) -> PyResult<()> {
        for name in self.given.into_iter().flat_map(PyDictMethods::keys) {
            let name = name.cast::<PyString>()?.to_string();
            if !self.known.contains(&name.as_str()) {
                let guess = nearest(&name, self.known.iter().copied());
                let guess = guess.map_or_else(String::new, |guess| format!("; did you mean '{guess}'?"));
                let function = self.function;
                let message = format!("{function}() got an unexpected keyword argument '{name}'{guess}");
                return Err(PyTypeError::new_err(message));
            }
        }
        Ok(())
    }
}
