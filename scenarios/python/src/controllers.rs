//! Controllers in Python: functions and policies that decide for the robots and gantries of a run.

use super::error::FirstError;
use crate::batch::Pilot;
use output::results::AbnormalSummary;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyMapping;
use rheotaxis::control::{Controller, Question, Response, question_json, read_answer};
use rheotaxis::incidents::IncidentKind;
use rheotaxis::trial::Trial;
use robots::handoff::ExchangeTiming;

/// A machine that has touched the bed without a pause for longer than this lies there, s.
const AGROUND_S: f64 = 60.0;

/// A function of Python that is asked for a machine.
struct Function {
    ask: Py<PyAny>,
    raised: FirstError,
}

impl Controller for Function {
    fn answer(&mut self, question: &Question) -> Response {
        if !self.raised.quiet() {
            return Response::Gone;
        }
        let text = question_json(question).to_string();
        let told = Python::attach(|py| -> PyResult<String> { self.ask.bind(py).call1((text,))?.extract() });
        match told {
            Ok(text) => read_answer(text.as_bytes(), question.number, question.t_s)
                .map_or_else(Response::Nonsense, Response::Answer),
            Err(error) => {
                self.raised.keep(error);
                Response::Gone
            }
        }
    }
}

/// The controller of a machine.
pub(crate) enum Decider {
    /// A function of Python: the question as a text in, the answer as a text out.
    Function(Py<PyAny>),
    /// A policy that sees and acts as in an environment.
    Policy(Py<Pilot>),
}

/// The decider that an argument means for a machine; `period_s` is the time between two questions, if it asks.
fn decider(id: &str, period_s: Option<f64>, of: &Bound<'_, PyAny>) -> PyResult<Decider> {
    if of.hasattr("_pilot")? {
        let pilot = of.call_method1("_pilot", (id, period_s))?;
        return Ok(Decider::Policy(pilot.cast::<Pilot>()?.clone().unbind()));
    }
    let asked = (of.py().import("rheotaxis._controllers")?).getattr("asked")?;
    Ok(Decider::Function(asked.call1((of,))?.unbind()))
}

/// The deciders that a run was given, by machine: of a dict, or one for all machines that ask.
pub(crate) fn given(
    controllers: Option<&Bound<'_, PyAny>>,
    asking: &[(String, ExchangeTiming)],
) -> PyResult<Vec<(String, Decider)>> {
    let Some(controllers) = controllers else {
        return Ok(Vec::new());
    };
    if let Ok(each) = controllers.cast::<PyMapping>() {
        let each = each.items()?;
        let each = each.iter().map(|pair| {
            let (id, of): (String, Bound<'_, PyAny>) = pair.extract()?;
            let own = asking.iter().find(|(name, _)| *name == id);
            let decides = decider(&id, own.map(|(_, asks)| asks.period_s), &of)?;
            Ok((id, decides))
        });
        return each.collect();
    }
    if controllers.is_callable() || controllers.hasattr("_pilot")? {
        let each = asking.iter().map(|(id, asks)| {
            let decides = decider(id, Some(asks.period_s), controllers)?;
            Ok((id.clone(), decides))
        });
        return each.collect();
    }
    Err(PyTypeError::new_err(format!(
        "controllers must be a function, or a dict of them by robot, got {}",
        controllers.get_type().name()?
    )))
}

/// A line for each machine that asks and has nobody to answer it; none if others were meant, which is a mistake.
pub(crate) fn unanswered(asking: &[(String, ExchangeTiming)], deciders: &[(String, Decider)]) -> Vec<String> {
    let has = |id: &str| deciders.iter().any(|(name, _)| name == id);
    let alone: Vec<&(String, ExchangeTiming)> = asking.iter().filter(|(id, _)| !has(id)).collect();
    if alone.len() + deciders.len() != asking.len() {
        return Vec::new();
    }
    let line = |(id, asks): &&(String, ExchangeTiming)| {
        format!(
            "{id} asks a controller every {} s and has none, so that its `on_late` decides: give \
             controllers={{\"{id}\": f}} (docs/interfaces.md), or controllers={{}} if that is meant",
            asks.period_s
        )
    };
    alone.iter().map(line).collect()
}

/// A line for each machine that asked and lay on the bed, or at an obstacle, for long.
pub(crate) fn aground(asking: &[(String, ExchangeTiming)], events: &[AbnormalSummary]) -> Vec<String> {
    let own = |event: &&AbnormalSummary| asking.iter().any(|(id, _)| *id == event.robot);
    let long = |event: &&AbnormalSummary| event.what == IncidentKind::Touched && event.lasted_s >= AGROUND_S;
    let events = events.iter().filter(own).filter(long);
    events
        .map(|event| {
            format!(
                "{} {}: do its controller's answers give a speed, and a depth or altitude that it can keep?",
                event.robot, event.line
            )
        })
        .collect()
}

/// Lets them decide in a run.
pub(crate) fn take_over(trial: &mut Trial, deciders: Vec<(String, Decider)>, raised: &FirstError) -> PyResult<()> {
    for (id, decider) in deciders {
        let raised = raised.clone();
        let done = match decider {
            Decider::Function(ask) => trial.control(&id, Function { ask, raised }),
            Decider::Policy(pilot) => {
                let piloting = Python::attach(|py| pilot.get().controller(py, raised));
                trial.control(&id, piloting)
            }
        };
        done.map_err(|error| {
            PyValueError::new_err(format!(
                "{error}; set it with scenario.with_({{\"robots.0.strategy\": Ron(\"External()\")}})"
            ))
        })?;
    }
    Ok(())
}
