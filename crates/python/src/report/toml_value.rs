//! A value of Python as one of TOML, for the values of a scenario that are replaced.

use std::path::PathBuf;

use pyo3::{
    exceptions::PyTypeError,
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyInt},
};

/// Values within values. Kind: choice; a scenario has four, and a list that contains itself has no end.
const DEEPEST: usize = 16;

/// The value as TOML writes it: numbers, truth values, texts, and lists and dictionaries of these. Arrays of numpy are lists.
///
/// # Errors
/// `TypeError` for any other value.
pub(super) fn toml_value(value: &Bound<'_, PyAny>) -> PyResult<String> {
    written(value, DEEPEST)
}

fn written(value: &Bound<'_, PyAny>, deepest: usize) -> PyResult<String> {
    let refused = || {
        let kind = value.get_type().name().map_or_else(|_| "this type".to_owned(), |name| name.to_string());
        PyTypeError::new_err(format!("set: a scenario has no value of type {kind}"))
    };
    let Some(deepest) = deepest.checked_sub(1) else { return Err(refused()) };
    // A truth value is a whole number for Python, too.
    if value.is_instance_of::<PyBool>() {
        return Ok(value.str()?.to_string().to_lowercase());
    }
    if value.is_instance_of::<PyInt>() || value.is_instance_of::<PyFloat>() {
        return Ok(value.str()?.to_string());
    }
    if let Ok(text) = value.extract::<PathBuf>() {
        return quoted(&text.to_string_lossy());
    }
    if let Ok(table) = value.cast::<PyDict>() {
        let entry = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| -> PyResult<String> {
            Ok(format!("{} = {}", quoted(&key.str()?.to_string())?, written(&value, deepest)?))
        };
        let entries = table.iter().map(entry).collect::<PyResult<Vec<String>>>()?;
        return Ok(format!("{{ {} }}", entries.join(", ")));
    }
    // Arrays and numbers of numpy become those of Python.
    if let Ok(plain) = value.call_method0("tolist") {
        return written(&plain, deepest);
    }
    let entries = value.try_iter().map_err(|_| refused())?;
    let entries = entries.map(|entry| written(&entry?, deepest)).collect::<PyResult<Vec<String>>>()?;
    Ok(format!("[{}]", entries.join(", ")))
}

/// A text in quotes: those of JSON are those of TOML.
fn quoted(text: &str) -> PyResult<String> {
    serde_json::to_string(text).map_err(|error| PyTypeError::new_err(error.to_string()))
}
