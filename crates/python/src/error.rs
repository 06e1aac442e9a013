//! Findings of the library as the one exception of the package, `congruent.CongruentError`.

use congruent::input::{Diagnostic, Finding, Findings, Severity, serde_name};
use pyo3::{
    intern,
    prelude::*,
    types::{PyDict, PyList},
};

/// The Python module that has the exception and its findings: classes of Python, so that they can be pickled and subclassed.
const MODULE: &str = "congruent._errors";

/// The exception for an input that is refused.
pub(crate) fn refused(py: Python<'_>, findings: impl Into<Findings>) -> PyErr {
    let findings: Findings = findings.into();
    let errors: Vec<&Diagnostic> =
        findings.iter().filter(|found| found.severity == Severity::Error).collect();
    // Warnings alone refuse nothing; if there should be no error, all are better than an empty message.
    let shown = if errors.is_empty() { findings.iter().collect() } else { errors };
    let lines: Vec<String> = shown.into_iter().map(|found| Finding::from(found).to_string()).collect();
    exception(py, &lines.join("\n"), findings.iter()).unwrap_or_else(|error| error)
}

/// The exception for a failure that is about no input, such as a full disk.
pub(crate) fn failed(py: Python<'_>, message: &str) -> PyErr {
    exception(py, message, std::iter::empty()).unwrap_or_else(|error| error)
}

fn exception<'a>(
    py: Python<'_>,
    message: &str,
    findings: impl Iterator<Item = &'a Diagnostic>,
) -> PyResult<PyErr> {
    let class = py.import(MODULE)?.getattr(intern!(py, "CongruentError"))?;
    Ok(PyErr::from_value(class.call1((message, python_findings(py, findings)?))?))
}

/// Findings as instances of `congruent.Finding`.
pub(crate) fn python_findings<'py, 'a>(
    py: Python<'py>,
    findings: impl Iterator<Item = &'a Diagnostic>,
) -> PyResult<Bound<'py, PyList>> {
    let class = py.import(MODULE)?.getattr(intern!(py, "Finding"))?;
    let list = PyList::empty(py);
    for finding in findings {
        let Finding { severity, code, id, message, file, line, column, help, .. } = Finding::from(finding);
        let fields = PyDict::new(py);
        fields.set_item("severity", serde_name(&severity))?;
        fields.set_item("code", code.as_ref())?;
        fields.set_item("id", id)?;
        fields.set_item("message", message)?;
        fields.set_item("file", file)?;
        fields.set_item("line", line)?;
        fields.set_item("column", column)?;
        fields.set_item("help", help)?;
        list.append(class.call((), Some(&fields))?)?;
    }
    Ok(list)
}
