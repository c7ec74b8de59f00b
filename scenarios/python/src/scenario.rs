//! `Scenario`: read, checked, looked at and changed.

use super::error::{apart, other, scenario_error};
use super::tree::Tree;
use super::value::{of_tree, to_ron};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rheotaxis::explain as explained;
use rheotaxis::scenario::{CATALOG, Loaded, ScenarioError, load, load_text, parse, set_value};
use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;
use world::registry::Registry;

/// A scenario that has been read and checked.
#[pyclass(frozen, name = "Scenario", module = "rheotaxis")]
pub(crate) struct PyScenario {
    loaded: Arc<Loaded>,
}

impl PyScenario {
    /// Checks a scenario that was read.
    fn checked(py: Python<'_>, read: Result<Loaded, ScenarioError>) -> PyResult<Self> {
        let told = |error| scenario_error(py, error);
        let loaded = Arc::new(read.map_err(told)?);
        loaded.check().map_err(told)?;
        Ok(Self { loaded })
    }

    /// The scenario that an argument means: a `Scenario`, the name of one in the catalogue, a path, or a text.
    pub(crate) fn meant(from: &Bound<'_, PyAny>) -> PyResult<Arc<Loaded>> {
        if let Ok(one) = from.cast::<Self>() {
            return Ok(one.get().loaded.clone());
        }
        let text: PyResult<String> = from.extract();
        let one = match text {
            // No path holds a line break, and no path of a scenario begins with a bracket.
            Ok(text) if text.contains('\n') || text.trim_start().starts_with('(') => {
                Self::parse(from.py(), &text, "scenario")
            }
            _ => Self::load(from.py(), from.extract()?),
        };
        Ok(one?.loaded)
    }

    fn tree(&self) -> PyResult<Tree> {
        Tree::from_value(&self.loaded.scenario).map_err(other)
    }

    fn changed(&self, py: Python<'_>, changes: &Bound<'_, PyDict>) -> PyResult<Loaded> {
        let mut text = self.loaded.text().into_owned();
        for (path, value) in changes {
            let path: String = path.extract()?;
            let path = bracketed(parts(&path).filter(|p| !p.starts_with(char::is_uppercase)));
            text = set_value(&text, &path, &to_ron(&value)?).map_err(|problem| {
                let refused = ScenarioError::File {
                    path: self.loaded.path.display().to_string(),
                    problem: format!("`{path}` cannot be set: {problem}"),
                    help: Some("`rheotaxis.explain(path)` says what there is".to_string()),
                };
                scenario_error(py, refused)
            })?;
        }
        (self.loaded.with_text(&self.loaded.path, text)).map_err(|error| scenario_error(py, error))
    }
}

#[pymethods]
impl PyScenario {
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::checked(py, load(&path))
    }

    #[staticmethod]
    #[pyo3(signature = (text, name = "scenario"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        Self::checked(py, load_text(&Registry::default(), name, text))
    }

    /// As `parse`, with the folder to which paths in the scenario are relative: for copies in other processes.
    #[staticmethod]
    fn _restored(py: Python<'_>, text: &str, path: PathBuf, base_dir: PathBuf) -> PyResult<Self> {
        let name =
            path.file_stem().map_or_else(|| path.display().to_string(), |stem| stem.to_string_lossy().into_owned());
        let read = load_text(&Registry::default(), &name, text);
        let mut loaded = read.map_err(|error| scenario_error(py, error))?;
        (loaded.path, loaded.base_dir) = (path, base_dir);
        Self::checked(py, Ok(loaded))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Restoring)> {
        let loaded = &slf.get().loaded;
        let folder = loaded.base_dir.clone();
        let restored = slf.get_type().getattr("_restored")?;
        Ok((restored, (loaded.text().into_owned(), loaded.path.clone(), folder)))
    }

    #[getter]
    fn text(&self) -> Cow<'_, str> {
        self.loaded.text()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.loaded.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.loaded.scenario.title
    }

    fn check(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let loaded = self.loaded.clone();
        let found = apart(py, || Ok(loaded.check()))?;
        let found = found.map_err(|error| scenario_error(py, error))?;
        Ok(found.iter().map(|fault| fault.line()).collect())
    }

    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_tree(py, &self.tree()?)
    }

    fn __getitem__<'py>(&self, py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyAny>> {
        let whole = self.tree()?;
        let (mut here, mut place) = (&whole, String::new());
        for part in parts(path) {
            here = here.step(&part).ok_or_else(|| {
                let there = if place.is_empty() { "the scenario" } else { &place };
                PyKeyError::new_err(format!("{there} has no `{part}`; it has {}", here.has()))
            })?;
            place = if place.is_empty() { part } else { format!("{place}.{part}") };
        }
        of_tree(py, here)
    }

    fn with_(&self, py: Python<'_>, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let changed = self.changed(py, changes)?;
        Self::checked(py, Ok(changed))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| other.get().loaded.text() == self.loaded.text())
    }

    fn __hash__(&self) -> u64 {
        u64::from_str_radix(&self.loaded.hash()[..15], 16).unwrap_or_default()
    }

    fn __repr__(&self) -> String {
        format!("<rheotaxis.Scenario {}: {}>", self.loaded.name, self.loaded.scenario.title)
    }
}

/// Text, path and folder of a scenario.
type Restoring = (String, PathBuf, PathBuf);

/// The parts of a path: `robots.0.start` and `robots[0].start` mean the same.
fn parts(path: &str) -> impl Iterator<Item = String> {
    let parts = path.split(['.', '[', ']']).filter(|part| !part.is_empty());
    parts.map(str::to_string)
}

/// A path as the scenario's text knows it, with elements of lists in brackets.
fn bracketed(parts: impl Iterator<Item = String>) -> String {
    let mut written = String::new();
    for part in parts {
        if part.chars().all(|c| c.is_ascii_digit()) {
            written = format!("{written}[{part}]");
        } else if written.is_empty() {
            written = part;
        } else {
            written = format!("{written}.{part}");
        }
    }
    written
}

/// The scenarios that come with the program, in order, each with its title and citation.
#[pyfunction]
pub(crate) fn catalogue(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let all = PyDict::new(py);
    for template in CATALOG {
        let scenario = parse(template.name, template.text);
        let scenario = scenario.map_err(|error| scenario_error(py, error))?;
        let one = PyDict::new(py);
        one.set_item("title", scenario.title)?;
        one.set_item("citation", scenario.citation)?;
        let searchers = PyList::empty(py);
        for id in scenario.robots.iter().map(|r| r.id.as_str()) {
            searchers.append(id)?;
        }
        for id in scenario.gantries.iter().map(|g| g.id.as_str()) {
            searchers.append(id)?;
        }
        one.set_item("searchers", searchers)?;
        all.set_item(template.name, one)?;
    }
    Ok(all)
}

/// Explains a place of a scenario.
#[pyfunction]
#[pyo3(signature = (path = ""))]
pub(crate) fn explain(path: &str) -> PyResult<String> {
    explained::explain(&Registry::default(), &bracketed(parts(path)), &[]).map_err(|unknown| {
        let near = match unknown.near.as_slice() {
            [] => String::new(),
            near => format!("; the nearest are {}", near.join(", ")),
        };
        PyKeyError::new_err(format!("{unknown}{near}"))
    })
}
