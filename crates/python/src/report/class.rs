//! The class `congruent.Report`: the answer of a check or of a run. `_native.pyi` repeats its documentation for editors.

use std::path::PathBuf;

use pyo3::{prelude::*, types::PyDict};

/// The answer of ``check`` or ``run``. ``str`` is what the command prints, and so is what a notebook shows; it is true if ``ok``.
#[pyclass(frozen, name = "Report", module = "congruent")]
pub(crate) struct PythonReport {
    /// Exit code of the command: 0 as expected, 1 a check failed, 2 bad input, 3 broken, 4 nothing was checked.
    #[pyo3(get)]
    pub(super) exit_code: u8,
    /// How much alike the poses are: ``identical``, ``same_within_digits``, ``equal_after_mapping`` or ``different``; ``None`` for a
    /// run, or if nothing was compared. Of several comparisons the worst. Masses and limits have no part in it: ``ok`` has.
    #[pyo3(get)]
    pub(super) grade: Option<String>,
    /// The answer in a line, as ``--quiet`` prints it.
    #[pyo3(get)]
    pub(super) headline: String,
    /// What the command prints.
    pub(super) text: String,
    /// What the command prints with `--format json`.
    pub(super) document: String,
    /// The columns of what happened in a run.
    pub(super) series: Option<Py<PyDict>>,
    /// The folder of the results of a run, if they are kept.
    #[pyo3(get)]
    pub(super) folder: Option<PathBuf>,
}

#[pymethods]
impl PythonReport {
    /// Whether the exit code of the command is 0: the robots agree, or the run went as expected.
    #[getter]
    fn ok(&self) -> bool {
        self.exit_code == 0
    }

    /// What happened in a run: arrays of numbers by the name of the column with its unit, (samples,); lists of names for columns
    /// that have names. Empty for a check.
    #[getter]
    fn series<'py>(&self, py: Python<'py>) -> Bound<'py, PyDict> {
        match &self.series {
            Some(series) => series.bind(py).clone(),
            None => PyDict::new(py),
        }
    }

    /// The document that the command prints with ``--format json``.
    fn json<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (&self.document,))
    }

    fn __bool__(&self) -> bool {
        self.ok()
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self) -> &str {
        self.text.trim_end()
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        // Names in files of strangers are no HTML.
        let escaped = py.import("html")?.call_method1("escape", (&self.text,))?;
        Ok(format!("<pre>{}</pre>", escaped.extract::<String>()?))
    }
}
