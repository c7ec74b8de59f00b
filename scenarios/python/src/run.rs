//! `run`: a whole run of a scenario.

use super::cache::{Cache, opened, tell_fault};
use super::columns::MachineColumns;
use super::controllers::{Decider, aground, given, take_over, unanswered};
use super::error::{FirstError, apart, other, scenario_error, warn_of, warn_of_run, whole};
use super::result::{FigureSource, FinishedRun, PyRunResult};
use super::scenario::PyScenario;
use super::signals::Signals;
use output::files::begin_run;
use output::follow::Follower;
use output::report::is_result;
use pyo3::Borrowed;
use pyo3::prelude::*;
use rheotaxis::cache::SpinUps;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, Trial, Wants, consulted};
use std::path::PathBuf;

/// Follows a run: its results, its columns, and Ctrl-C.
struct Watcher {
    results: Follower,
    robots: Vec<MachineColumns>,
    gantries: Vec<MachineColumns>,
    signals: Signals,
    raised: FirstError,
}

impl Observer for Watcher {
    fn see(&mut self, event: &Event) {
        self.results.see(event);
        match event {
            Event::Frame(frame) => {
                MachineColumns::push_robots(&mut self.robots, frame);
                MachineColumns::push_gantries(&mut self.gantries, frame);
            }
            Event::Exchange(exchange) => self.raised.look_at(exchange),
            _ => {}
        }
    }

    fn goes_on(&mut self) -> bool {
        self.results.well() && self.raised.quiet() && self.signals.quiet()
    }

    fn wants(&self) -> Wants {
        self.results.wants()
    }
}

/// What a run is asked for.
struct RunOptions {
    seed: u64,
    files: Option<PathBuf>,
    recording: bool,
    threads: usize,
    /// Who decides, by machine.
    controllers: Vec<(String, Decider)>,
}

/// Makes the run; an exception that a signal has raised comes with it.
fn made(loaded: &Loaded, asked: RunOptions, kept: Option<&SpinUps>) -> PyResult<FinishedRun> {
    let mut trial = Trial::assemble(loaded, asked.seed).map_err(other)?;
    if asked.threads != 1 {
        trial.simulation.ocean_mut().use_threads(asked.threads);
    }
    let raised = FirstError::default();
    take_over(&mut trial, asked.controllers, &raised)?;
    let mut results = Follower::new(loaded, asked.seed.into()).map_err(other)?;
    // The folder comes last: a run that cannot start must not remove the files of an earlier run.
    if let Some(files) = &asked.files {
        let own = |name: &str| is_result(&loaded.scenario, name);
        let out = begin_run(files, Some(&own)).map_err(other)?;
        results.write_into(&out, asked.recording).map_err(other)?;
    }
    let mut watcher = Watcher {
        robots: results.robots().iter().map(MachineColumns::of_robot).collect(),
        gantries: Vec::new(),
        results,
        signals: Signals::default(),
        raised: raised.clone(),
    };
    if let Some(kept) = kept {
        trial.spin_up_with(kept, &mut watcher);
    }
    let ended = trial.run(&mut watcher);
    let mut gathered = watcher.results.finish(&trial, &ended);
    let written = gathered.write(trial.simulation.ocean());
    if let Some(raised) = watcher.signals.raised().or_else(|| raised.take()) {
        return Err(raised);
    }
    written.map_err(other)?;
    let kept = FigureSource { gathered, ocean: trial };
    Ok(FinishedRun { ended, kept, robots: watcher.robots, gantries: watcher.gantries })
}

/// Most threads that a run may be asked to use.
const MOST_THREADS: u64 = 1024;

/// The seed of a run.
pub(crate) struct Seed(u64);

/// So many threads; 0 means one for each core.
pub(crate) struct Threads(usize);

impl<'a, 'py> FromPyObject<'a, 'py> for Seed {
    type Error = PyErr;
    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        whole("seed", &given, u64::MAX).map(Self)
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Threads {
    type Error = PyErr;
    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        whole("threads", &given, MOST_THREADS).map(|n| Self(n as usize))
    }
}

/// Runs a scenario to its end.
#[pyfunction]
#[pyo3(signature = (
    scenario, seed = Seed(1), *, controllers = None, files = None, recording = true, cache = None,
    threads = Threads(0)
))]
pub(crate) fn run(
    scenario: &Bound<'_, PyAny>,
    seed: Seed,
    controllers: Option<&Bound<'_, PyAny>>,
    files: Option<PathBuf>,
    recording: bool,
    cache: Option<Cache>,
    threads: Threads,
) -> PyResult<PyRunResult> {
    let py = scenario.py();
    let loaded = PyScenario::meant(scenario)?;
    let odd = loaded.check().map_err(|error| scenario_error(py, error))?;
    warn_of(py, odd)?;
    let asking = consulted(&loaded.scenario);
    let deciders = given(controllers, &asking)?;
    if !controllers.is_some_and(|c| c.len().is_ok_and(|n| n == 0)) {
        warn_of_run(py, &unanswered(&asking, &deciders))?;
    }
    let kept = opened(py, cache)?;
    let asked = RunOptions { seed: seed.0, files, recording, threads: threads.0, controllers: deciders };
    let made = apart(py, || made(&loaded, asked, kept.as_ref()))?;
    tell_fault(py, kept.and_then(|kept| kept.fault()))?;
    let events = &made.kept.gathered.summary.abnormal;
    warn_of_run(py, &aground(&asking, events))?;
    PyRunResult::new(py, made)
}
