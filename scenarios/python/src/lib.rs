//! `rheotaxis` for Python: scenarios, runs and their results. The package in `python/rheotaxis` is what users import;
//! this module is its engine.
//!
//! [`scenario`] reads, checks and changes scenarios, [`run`] makes a run and [`result`] holds what it left, with the
//! [`columns`] gathered on the way, as [`arrays`]. [`error`] turns mistakes and panics into exceptions, [`value`] values of a
//! scenario, a [`tree`], from one language into the other, and [`signals`] lets Ctrl-C end a run. [`batch`] holds the
//! environments for learning.
#![forbid(unsafe_code)]

mod arrays;
mod batch;
mod cache;
mod columns;
mod controllers;
mod error;
mod result;
mod run;
mod scenario;
mod signals;
mod tree;
mod value;

/// The engine of the Python package `rheotaxis`.
#[pyo3::pymodule]
mod _rheotaxis {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::batch::{Batch, Pilot};
    #[pymodule_export]
    use crate::error::{RunWarning, ScenarioError, ScenarioWarning, panic_of};
    #[pymodule_export]
    use crate::result::{PyFigure, PyRunResult};
    #[pymodule_export]
    use crate::run::run;
    #[pymodule_export]
    use crate::scenario::{PyScenario, catalogue, explain};

    #[pymodule_init]
    fn init(m: &Bound<'_, PyModule>) -> PyResult<()> {
        m.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
