//! Mistakes and panics as Python's exceptions.

use output::shown::{self, PLAIN};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rheotaxis::control::{Exchange, Response};
use rheotaxis::lanes::caught;
use rheotaxis::scenario::{self, Fault};
use std::ffi::CString;
use std::sync::{Arc, Mutex, PoisonError};

pyo3::create_exception!(
    rheotaxis,
    ScenarioError,
    PyValueError,
    "A scenario cannot be used. The text shows each mistake with file, line, column, field, legal range and, where \
     known, the cure. `faults` lists them as dicts: path, message, help, line, column."
);

pyo3::create_exception!(
    rheotaxis,
    ScenarioWarning,
    PyUserWarning,
    "Something in a scenario is legal and probably not meant."
);

pyo3::create_exception!(
    rheotaxis,
    RunWarning,
    PyUserWarning,
    "Something in a run is probably not meant: nobody answers a robot, or it lay on the bed."
);

/// The exception for a scenario that cannot be used.
pub(crate) fn scenario_error(py: Python<'_>, error: scenario::ScenarioError) -> PyErr {
    let faults = match &error {
        scenario::ScenarioError::File { .. } => Ok(PyList::empty(py)),
        scenario::ScenarioError::Text(fault) => listed(py, std::slice::from_ref(&**fault)),
        scenario::ScenarioError::Many { faults, .. } => listed(py, faults),
    };
    let raised = ScenarioError::new_err(format!("\n{}", shown::all(&error, PLAIN).join("\n").trim_end()));
    match faults.and_then(|faults| raised.value(py).setattr("faults", faults)) {
        Ok(()) => raised,
        Err(error) => error,
    }
}

fn listed<'py>(py: Python<'py>, faults: &[Fault]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for fault in faults {
        let one = PyDict::new(py);
        one.set_item("path", &fault.path)?;
        one.set_item("message", &fault.message)?;
        one.set_item("help", &fault.help)?;
        one.set_item("line", fault.line)?;
        one.set_item("column", fault.column)?;
        list.append(one)?;
    }
    Ok(list)
}

/// Warns of what is probably not meant in a scenario.
pub(crate) fn warn_of(py: Python<'_>, faults: Vec<Fault>) -> PyResult<()> {
    let category = py.get_type::<ScenarioWarning>();
    for fault in &faults {
        warn(py, &category, shown::fault(fault, PLAIN).trim_end())?;
    }
    Ok(())
}

/// Warns of something by Python's own means.
pub(crate) fn warn(py: Python<'_>, category: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
    let text = CString::new(text.replace('\0', " "))?;
    PyErr::warn(py, category, &text, 1)
}

/// Does something without the interpreter's lock. A panic becomes a `RuntimeError`.
pub(crate) fn apart<T, F>(py: Python<'_>, work: F) -> PyResult<T>
where
    T: Send,
    F: Send + FnOnce() -> PyResult<T>,
{
    py.detach(|| caught(work)).unwrap_or_else(|said| Err(panicked(&said)))
}

/// Warns of what is probably not meant in a run.
pub(crate) fn warn_of_run(py: Python<'_>, lines: &[String]) -> PyResult<()> {
    let category = py.get_type::<RunWarning>();
    lines.iter().try_for_each(|line| warn(py, &category, line))
}

/// An argument that is a whole number from 0 to `most`.
pub(crate) fn whole(name: &str, given: &Bound<'_, PyAny>, most: u64) -> PyResult<u64> {
    let number = given.call_method0("__index__").map_err(|_| {
        let kind = given.get_type();
        PyTypeError::new_err(format!("{name} must be a whole number, got {kind}"))
    })?;
    let found = number.extract::<u64>().ok().filter(|n| *n <= most);
    found.ok_or_else(|| PyValueError::new_err(format!("{name} must be from 0 to {most}, got {number}")))
}

/// Panics where runs do, with these words: the tests make sure that it becomes an exception.
#[pyfunction(name = "_panic")]
pub(crate) fn panic_of(py: Python<'_>, words: String) -> PyResult<()> {
    apart(py, move || panic!("{words}"))
}

/// The exception for a panic.
pub(crate) fn panicked(said: &str) -> PyErr {
    PyRuntimeError::new_err(format!("rheotaxis: {said}"))
}

/// Any other error of the simulator, told by its own text.
pub(crate) fn other(error: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// What went wrong first, in a controller or with an answer of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct FirstError(Arc<Mutex<Option<PyErr>>>);

impl FirstError {
    /// Keeps what went wrong, if it is the first.
    pub(crate) fn keep(&self, error: PyErr) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }

    /// Whether nothing has gone wrong yet.
    pub(crate) fn quiet(&self) -> bool {
        let first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.is_none()
    }

    /// It.
    pub(crate) fn take(&self) -> Option<PyErr> {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.take()
    }

    /// Takes an answer that the machine could not carry out for an exception of the controller that gave it.
    pub(crate) fn look_at(&self, told: &Exchange) {
        if let Response::Nonsense(why) = &told.response {
            let (robot, number) = (&told.robot, told.number);
            let said = format!("the answer of {robot} to question {number}: {why}");
            self.keep(PyValueError::new_err(said));
        }
    }
}
