//! `Result` and `Figure`: what a run has left.

use super::columns::MachineColumns;
use super::error::{apart, other};
use output::follow::RunResults;
use output::report::Figure;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::trial::{RunEnd, Trial};
use std::path::PathBuf;
use std::sync::{Mutex, OnceLock, PoisonError};
use world::files;

/// What figures are drawn from. The trial is over; they look at its ocean.
pub(crate) struct FigureSource {
    pub(crate) gathered: RunResults,
    pub(crate) ocean: Trial,
}

/// A run that is over.
pub(crate) struct FinishedRun {
    pub(crate) ended: RunEnd,
    pub(crate) kept: FigureSource,
    pub(crate) robots: Vec<MachineColumns>,
    pub(crate) gantries: Vec<MachineColumns>,
}

/// The result of a run.
#[pyclass(frozen, name = "Result", module = "rheotaxis")]
pub(crate) struct PyRunResult {
    facts: Facts,
    files: Option<PathBuf>,
    /// Columns by robot, and by gantry. Whoever asks gets a copy.
    track: Py<PyAny>,
    probes: Py<PyAny>,
    /// Locked only without the interpreter's lock; `None` of a copy, which has its figures.
    kept: Option<Mutex<FigureSource>>,
    figures: OnceLock<Vec<Figure>>,
}

/// The texts and numbers of a result.
#[derive(Clone, FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
struct Facts {
    success: bool,
    outcome_words: String,
    digest: String,
    t_s: f64,
    steps: u64,
    name: String,
    seed: u64,
    summary: String,
}

/// A figure on its way to another process: name, title, and the drawing or the reason why there is none.
type SentFigure = (String, String, Option<String>, Option<String>);

/// A result on its way to another process.
type Sent = (Facts, Option<PathBuf>, Py<PyAny>, Py<PyAny>, Vec<SentFigure>);

impl PyRunResult {
    /// Of a run that is over.
    pub(crate) fn new(py: Python<'_>, made: FinishedRun) -> PyResult<Self> {
        let summary = &made.kept.gathered.summary;
        let by_id = |machines: &[MachineColumns]| {
            let dict = PyDict::new(py);
            machines.iter().try_for_each(|m| dict.set_item(&m.id, m.arrays(py)?))?;
            PyResult::Ok(dict.into_any().unbind())
        };
        let good = [RunOutcome::Found, RunOutcome::Completed];
        Ok(Self {
            facts: Facts {
                success: good.contains(&summary.outcome),
                outcome_words: summary.outcome.label().to_string(),
                digest: made.ended.digest,
                t_s: made.ended.t_s,
                steps: made.ended.steps,
                name: summary.scenario.clone(),
                seed: summary.seed,
                summary: summary.json(),
            },
            files: made.kept.gathered.out().map(|out| out.dir().to_owned()),
            track: by_id(&made.robots)?,
            probes: by_id(&made.gantries)?,
            kept: Some(Mutex::new(made.kept)),
            figures: OnceLock::new(),
        })
    }

    /// The figures, drawn when they are first asked for.
    fn drawn(&self, py: Python<'_>) -> PyResult<&[Figure]> {
        apart(py, || {
            Ok(&**self.figures.get_or_init(|| {
                let Some(kept) = &self.kept else {
                    return Vec::new();
                };
                let kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
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
        self.facts.success
    }

    #[getter]
    fn digest(&self) -> &str {
        &self.facts.digest
    }

    #[getter]
    fn t_s(&self) -> f64 {
        self.facts.t_s
    }

    #[getter]
    fn steps(&self) -> u64 {
        self.facts.steps
    }

    #[getter]
    fn files(&self) -> Option<&PathBuf> {
        self.files.as_ref()
    }

    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (&self.facts.summary,))
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
    fn track<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        copied(self.track.bind(py))
    }

    #[getter]
    fn probes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        copied(self.probes.bind(py))
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
            PyKeyError::new_err(format!("the run has no figure `{asked}`; it has {}", names.join(", ")))
        })?;
        Ok(PyFigure { name: found.name.clone(), title: found.title.clone(), svg: found.svg.clone().map_err(other)? })
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.plot(py, None)?._repr_png_(py)
    }

    /// All of it, with its figures: they are drawn now, for they need the run's ocean.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Sent)> {
        let (py, own) = (slf.py(), slf.get());
        let sent = |f: &Figure| {
            let (name, title) = (f.name.clone(), f.title.clone());
            (name, title, f.svg.clone().ok(), f.svg.clone().err())
        };
        let figures = own.drawn(py)?.iter().map(sent).collect();
        let (track, probes) = (own.track.clone_ref(py), own.probes.clone_ref(py));
        let all = (own.facts.clone(), own.files.clone(), track, probes, figures);
        Ok((slf.get_type().getattr("_restored")?, all))
    }

    /// What `__reduce__` has sent.
    #[staticmethod]
    fn _restored(
        facts: Facts,
        files: Option<PathBuf>,
        track: Py<PyAny>,
        probes: Py<PyAny>,
        figures: Vec<SentFigure>,
    ) -> Self {
        let figure = |(name, title, svg, why): SentFigure| Figure {
            name,
            title,
            svg: svg.ok_or_else(|| why.unwrap_or_default()),
        };
        Self {
            facts,
            files,
            track,
            probes,
            kept: None,
            figures: OnceLock::from(figures.into_iter().map(figure).collect::<Vec<_>>()),
        }
    }

    fn __repr__(&self) -> String {
        let facts = &self.facts;
        format!(
            "<rheotaxis.Result {} seed {}: {} after {:.1} s, digest {}>",
            facts.name, facts.seed, facts.outcome_words, facts.t_s, facts.digest
        )
    }
}

/// A copy of a dict of dicts of arrays: an array belongs to its owner.
fn copied<'py>(columns: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    (columns.py().import("copy")?).call_method1("deepcopy", (columns,))
}

/// A figure of a run.
#[pyclass(frozen, get_all, name = "Figure", module = "rheotaxis")]
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
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self._repr_png_(py)
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let bytes = match path.extension().and_then(|e| e.to_str()) {
            Some("svg") => self.svg.clone().into_bytes(),
            Some("png") => self.bytes(py)?,
            _ => {
                return Err(pyo3::exceptions::PyValueError::new_err("a figure is saved as .svg or .png"));
            }
        };
        files::write(&path, &bytes).map(drop).map_err(other)
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.bytes(py)?))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, String, String))> {
        let own = slf.get();
        let all = (own.name.clone(), own.title.clone(), own.svg.clone());
        Ok((slf.get_type().getattr("_restored")?, all))
    }

    /// What `__reduce__` has sent.
    #[staticmethod]
    fn _restored(name: String, title: String, svg: String) -> Self {
        Self { name, title, svg }
    }

    fn __repr__(&self) -> String {
        format!("<rheotaxis.Figure {}: {}>", self.name, self.title)
    }
}
