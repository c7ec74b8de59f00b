//! Controllers in Python: functions that decide for the robots and gantries of a run.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheotaxis::control::{Consultation, Controller, Heard, Question, question_json, read_answer};
use rheotaxis::trial::Trial;
use std::sync::{Arc, Mutex, PoisonError};

/// What went wrong first, in a controller or with an answer of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    fn keep(&self, error: PyErr) {
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
    pub(crate) fn look_at(&self, told: &Consultation) {
        if let Heard::Nonsense(why) = &told.heard {
            let (robot, number) = (&told.robot, told.number);
            let said = format!("the answer of {robot} to question {number}: {why}");
            self.keep(PyValueError::new_err(said));
        }
    }
}

/// A function of Python that is asked for a machine.
struct Function {
    ask: Py<PyAny>,
    raised: Raised,
}

impl Controller for Function {
    fn answer(&mut self, question: &Question) -> Heard {
        if !self.raised.quiet() {
            return Heard::Gone;
        }
        let text = question_json(question).to_string();
        let told = Python::attach(|py| -> PyResult<String> {
            self.ask.bind(py).call1((text,))?.extract()
        });
        match told {
            Ok(text) => read_answer(text.as_bytes(), question.number, question.t_s)
                .map_or_else(Heard::Nonsense, Heard::Answer),
            Err(error) => {
                self.raised.keep(error);
                Heard::Gone
            }
        }
    }
}

/// The functions that a run was given, by machine: of a dict, or one function for all machines that ask.
pub(crate) fn given(
    controllers: Option<&Bound<'_, PyAny>>,
    asking: &[String],
) -> PyResult<Vec<(String, Py<PyAny>)>> {
    let Some(controllers) = controllers else {
        return Ok(Vec::new());
    };
    let py = controllers.py();
    let asked = py.import("rheotaxis._controllers")?.getattr("asked")?;
    let function = |of: &Bound<'_, PyAny>| asked.call1((of,)).map(Bound::unbind);
    if let Ok(each) = controllers.cast::<PyDict>() {
        let each = each.iter();
        return each
            .map(|(id, of)| Ok((id.extract()?, function(&of)?)))
            .collect();
    }
    if controllers.is_callable() {
        let each = asking.iter();
        return each
            .map(|id| Ok((id.clone(), function(controllers)?)))
            .collect();
    }
    Err(PyTypeError::new_err(format!(
        "controllers must be a function, or a dict of them by robot, got {}",
        controllers.get_type().name()?
    )))
}

/// Lets them decide in a run.
pub(crate) fn take_over(
    trial: &mut Trial,
    functions: Vec<(String, Py<PyAny>)>,
    raised: &Raised,
) -> PyResult<()> {
    for (id, ask) in functions {
        let raised = raised.clone();
        let done = trial.control(&id, Function { ask, raised });
        done.map_err(|error| {
            PyValueError::new_err(format!(
                "{error}; set it with scenario.with_({{\"robots.0.strategy\": Ron(\"External()\")}})"
            ))
        })?;
    }
    Ok(())
}
