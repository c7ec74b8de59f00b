//! Searchers outside the program that decide in the runs of a campaign.

use super::work::one_run::RunName;
use rheotaxis::control::{Controller, Question};
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Trial, consulted};
use std::fmt;

/// Whoever decides for robots and gantries whose strategy is `External`.
///
/// A run whose searcher is not there, or goes away, has no row, and the campaign stops: what it would have done
/// otherwise says nothing of the searcher. A searcher that answers too late is answered by the scenario (`on_late`),
/// and its row counts.
pub trait Outside: Send + Sync {
    /// Who decides for a robot in a run; each question waits so long for an answer, s of real time.
    ///
    /// # Errors
    /// Says why nobody can.
    fn controller(&self, run: &RunName, robot: &str, deadline_s: f64) -> Result<Box<dyn Controller>, String>;
}

impl fmt::Debug for dyn Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Outside")
    }
}

/// Connects the robots of a run with those who decide for them.
pub(super) fn connect(outside: &dyn Outside, name: &RunName, loaded: &Loaded, trial: &mut Trial) -> Result<(), String> {
    for (robot, times) in consulted(&loaded.scenario) {
        let mut asked = outside.controller(name, &robot, times.deadline_s)?;
        let answer = move |question: &Question| asked.answer(question);
        trial.control(&robot, answer).map_err(|e| e.to_string())?;
    }
    Ok(())
}
