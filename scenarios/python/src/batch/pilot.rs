//! A policy as a controller: in a whole run it sees and does what it sees and does in an environment.

use super::Rules;
use super::searcher_state::SearcherState;
use crate::arrays::array;
use crate::error::FirstError;
use pyo3::prelude::*;
use rheotaxis::control::{Controller, Question, Response};
use std::sync::Arc;

/// Decides for one searcher of a run.
#[pyclass(frozen, name = "_Pilot", module = "rheotaxis._rheotaxis")]
pub(crate) struct Pilot {
    pub(super) rules: Arc<Rules>,
    /// Its place among the searchers.
    pub(super) agent: usize,
    /// From an observation, an array of one row, to the numbers of an action, as bytes.
    pub(super) decide: Py<PyAny>,
}

impl Pilot {
    /// It at the beginning of a run.
    pub(crate) fn controller(&self, py: Python<'_>, raised: FirstError) -> impl Controller + use<> {
        PolicyRun {
            mind: SearcherState::new(&self.rules.agents[self.agent]),
            rules: self.rules.clone(),
            agent: self.agent,
            decide: self.decide.clone_ref(py),
            raised,
        }
    }
}

/// A policy during a run.
struct PolicyRun {
    rules: Arc<Rules>,
    agent: usize,
    mind: SearcherState,
    decide: Py<PyAny>,
    raised: FirstError,
}

impl Controller for PolicyRun {
    fn answer(&mut self, question: &Question) -> Response {
        if !self.raised.quiet() {
            return Response::Gone;
        }
        let agent = &self.rules.agents[self.agent];
        self.mind.see(&self.rules, agent, question.clone(), 0.0);
        let seen = &self.mind.features;
        let decided = Python::attach(|py| -> PyResult<Vec<u8>> {
            let seen = array(py, seen, &[1, seen.len()])?;
            self.decide.bind(py).call1((seen,))?.extract()
        });
        match decided {
            Ok(bytes) => {
                let numbers = super::numbers(&bytes);
                Response::Answer(self.mind.answer(&self.rules, agent, &numbers))
            }
            Err(error) => {
                self.raised.keep(error);
                Response::Gone
            }
        }
    }
}
