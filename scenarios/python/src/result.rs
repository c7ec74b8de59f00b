//! `Result` and `Figure`: what a run has left.

use super::columns::RobotColumns;
use super::columns_gantry::GantryColumns;
use super::error::{apart, other};
use output::follow::Gathered;
use output::report::Figure;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::trial::{Ended, Trial};
use std::path::PathBuf;
use std::sync::{Mutex, OnceLock, PoisonError};
use world::files;

/// All that is kept of a run. The trial is over; figures look at its ocean.
pub(crate) struct Kept {
    pub(crate) ended: Ended,
    pub(crate) gathered: Gathered,
    pub(crate) ocean: Trial,
}

/// The result of a run.
#[pyclass(frozen, name = "Result", module = "rheotaxis")]
pub(crate) struct PyRunResult {
    outcome: RunOutcome,
    digest: String,
    t_s: f64,
    steps: u64,
    name: String,
    seed: u64,
    summary: String,
    files: Option<PathBuf>,
    robots: Vec<RobotColumns>,
    gantries: Vec<GantryColumns>,
    /// Locked only without the interpreter's lock.
    kept: Mutex<Kept>,
    figures: OnceLock<Vec<Figure>>,
}

impl PyRunResult {
    /// Of a run that is over.
    pub(crate) fn new(kept: Kept, robots: Vec<RobotColumns>, gantries: Vec<GantryColumns>) -> Self {
        let (ended, summary) = (&kept.ended, &kept.gathered.summary);
        Self {
            outcome: summary.outcome,
            digest: ended.digest.clone(),
            t_s: ended.t_s,
            steps: ended.steps,
            name: summary.scenario.clone(),
            seed: summary.seed,
            summary: summary.json(),
            files: kept.gathered.out().map(|out| out.dir().to_owned()),
            robots,
            gantries,
            kept: Mutex::new(kept),
            figures: OnceLock::new(),
        }
    }

    /// The figures, drawn when they are first asked for.
    fn drawn(&self, py: Python<'_>) -> PyResult<&[Figure]> {
        apart(py, || {
            Ok(&**self.figures.get_or_init(|| {
                let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
                kept.gathered.figures(kept.ocean.simulation.ocean())
            }))
        })
    }
}

#[pymethods]
impl PyRunResult {
    #[getter]
    fn outcome<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.summary(py)?.get_item("outcome")
    }

    #[getter]
    fn success(&self) -> bool {
        matches!(self.outcome, RunOutcome::Found | RunOutcome::Completed)
    }

    #[getter]
    fn digest(&self) -> &str {
        &self.digest
    }

    #[getter]
    fn t_s(&self) -> f64 {
        self.t_s
    }

    #[getter]
    fn steps(&self) -> u64 {
        self.steps
    }

    #[getter]
    fn files(&self) -> Option<&PathBuf> {
        self.files.as_ref()
    }

    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (&self.summary,))
    }

    #[getter]
    fn declarations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let summary = self.summary(py)?;
        let list = PyList::empty(py);
        let add = |searcher: &Bound<'py, PyAny>, made: &Bound<'py, PyAny>| {
            let one = PyDict::new(py);
            one.set_item("searcher", searcher.get_item("id")?)?;
            one.update(made.cast()?)?;
            list.append(one)
        };
        for robot in summary.get_item("robots")?.try_iter()? {
            let robot = robot?;
            for made in robot.get_item("declarations")?.try_iter()? {
                add(&robot, &made?)?;
            }
        }
        for gantry in summary.get_item("gantries")?.try_iter()? {
            let gantry = gantry?;
            let made = gantry.get_item("declaration")?;
            if !made.is_none() {
                add(&gantry, &made)?;
            }
        }
        Ok(list)
    }

    #[getter]
    fn track<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for robot in &self.robots {
            all.set_item(robot.id(), robot.arrays(py)?)?;
        }
        Ok(all)
    }

    #[getter]
    fn probes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for gantry in &self.gantries {
            all.set_item(gantry.id(), gantry.arrays(py)?)?;
        }
        Ok(all)
    }

    #[getter]
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(self.drawn(py)?.iter().map(|f| f.name.clone()).collect())
    }

    #[pyo3(signature = (name = None))]
    fn plot(&self, py: Python<'_>, name: Option<&str>) -> PyResult<PyFigure> {
        let all = self.drawn(py)?;
        let found = match name {
            Some(name) => all.iter().find(|f| f.name == name),
            None => all.first(),
        };
        let names: Vec<&str> = all.iter().map(|f| f.name.as_str()).collect();
        let found = found.ok_or_else(|| {
            let asked = name.unwrap_or("any");
            PyKeyError::new_err(format!(
                "the run has no figure `{asked}`; it has {}",
                names.join(", ")
            ))
        })?;
        Ok(PyFigure {
            name: found.name.clone(),
            title: found.title.clone(),
            svg: found.svg.clone().map_err(other)?,
        })
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.plot(py, None)?._repr_png_(py)
    }

    fn __repr__(&self) -> String {
        format!(
            "<rheotaxis.Result {} seed {}: {} after {:.1} s, digest {}>",
            self.name,
            self.seed,
            self.outcome.words(),
            self.t_s,
            self.digest
        )
    }
}

/// A figure of a run.
#[pyclass(frozen, name = "Figure", module = "rheotaxis")]
pub(crate) struct PyFigure {
    name: String,
    title: String,
    svg: String,
}

impl PyFigure {
    fn bytes(&self, py: Python<'_>) -> PyResult<Vec<u8>> {
        apart(py, || output::charts::png(&self.svg).map_err(other))
    }
}

#[pymethods]
impl PyFigure {
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.title
    }

    #[getter]
    fn svg(&self) -> &str {
        &self.svg
    }

    #[getter]
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self._repr_png_(py)
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let bytes = match path.extension().and_then(|e| e.to_str()) {
            Some("svg") => self.svg.clone().into_bytes(),
            Some("png") => self.bytes(py)?,
            _ => {
                return Err(pyo3::exceptions::PyValueError::new_err(
                    "a figure is saved as .svg or .png",
                ));
            }
        };
        files::write(&path, &bytes).map(drop).map_err(other)
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.bytes(py)?))
    }

    fn __repr__(&self) -> String {
        format!("<rheotaxis.Figure {}: {}>", self.name, self.title)
    }
}
